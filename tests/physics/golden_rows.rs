//! Rows of three and four buildings, and what yields and slips in them, against the independent solution in quadruple
//! precision (tests/reference), as in `golden.rs`. Its columns have the names of the FMU's variables: they are read by these.

use crate::common::Run;
use crate::golden::{Golden, load, table, worst_of_contacts};
use pounding::engine::Output;
use pounding::scene::Scene;
use pounding::variables::{Slot, Table};
use std::collections::HashMap;
use std::path::Path;

/// What is shown, by its name.
struct Shown(HashMap<String, Output>);

impl Shown {
    fn new(scene: &Scene) -> Shown {
        let output = |slot| if let Slot::Output(output) = slot { Some(output) } else { None };
        let rows = Table::new(scene).rows.into_iter();
        Shown(rows.filter_map(|row| Some((row.name, output(row.slot)?))).collect())
    }

    /// What a column is of. Those of links that slip are called as if they were storeys; `None`: a link does not show it.
    fn of(&self, column: &str) -> Option<Output> {
        let name = match column.strip_prefix("link.").and_then(|rest| rest.split_once('[')) {
            None => column.to_owned(),
            Some((quantity, number)) => {
                let of_link = match quantity {
                    "storey_shear" => "force",
                    "plastic_drift" => "slip",
                    "cumulative_plastic_drift" => "slip_travel",
                    "hysteretic_energy" => "dissipated_energy",
                    "yielding" => "slipping",
                    _ => return None,
                };
                format!("link[{number}.{of_link}")
            }
        };
        Some(*self.0.get(&name).unwrap_or_else(|| panic!("no variable {name}")))
    }
}

/// The error of a column is told relative to the largest value of all that have the same scale.
fn scale(golden: &Golden, column: &str) -> f64 {
    if column.contains(".foundation.") {
        golden.largest(column)
    } else {
        ["displacement[", "velocity[", "energy"]
            .into_iter()
            .find(|quantity| column.contains(quantity))
            .map(|quantity| golden.largest(quantity))
            .unwrap_or_else(|| panic!("{column}"))
    }
}

/// Worst error per unit of sensitivity of displacements, velocities and energies.
fn worst_motion(golden: &Golden, run: &mut Run, shown: &Shown) -> f64 {
    let is_value = |column: &&String| !["time", "sensitivity"].contains(&column.as_str());
    let columns = golden.rows[0].keys().filter(is_value);
    let columns: Vec<_> = columns.map(|c| (c, shown.of(c).unwrap(), scale(golden, c))).collect();
    let mut worst = 0.0_f64;
    for row in &golden.rows {
        run.to(row["time"]);
        let error = |(column, of, scale): &(&String, Output, f64)| (run.read(*of) - row[*column]).abs() / scale;
        let errors = columns.iter().map(error).inspect(|error| assert!(error.is_finite()));
        worst = worst.max(errors.fold(0.0, f64::max) / row["sensitivity"].max(1.0));
    }
    worst
}

/// Worst error of all that is shown of storeys that yield and links that slip, each relative to its largest value.
fn worst_of_storeys(name: &str, run: &mut Run, shown: &Shown) -> f64 {
    let rows = table(&format!("{name}.storeys.csv"));
    let largest = |column: &str| rows.iter().map(|row| row[column].abs()).fold(f64::MIN_POSITIVE, f64::max);
    let columns = rows[0].keys().filter(|column| *column != "time");
    let columns: Vec<_> = columns.filter_map(|c| Some((c, shown.of(c)?, largest(c)))).collect();
    let mut worst = 0.0_f64;
    for row in &rows {
        run.to(row["time"]);
        for (column, of, largest) in &columns {
            worst = worst.max((run.read(*of) - row[*column]).abs() / largest);
        }
    }
    worst
}

#[track_caller]
fn compare(name: &str, contacts: usize, allowed: f64) {
    let (scene, record) = load(&format!("tests/reference/scenes/{name}.toml"));
    assert_eq!(scene.contacts.len(), contacts, "{name}: number of contacts");
    let (golden, shown) = (Golden::new(name), Shown::new(&scene));
    let mut run = Run::new(&scene, Some(&record));
    let motion = worst_motion(&golden, &mut run, &shown);
    let impacts = worst_of_contacts(&golden, &scene, &run, name);
    println!("{name}: {motion:.1e}, episodes {impacts:.1e} per unit of sensitivity");
    assert!(motion <= allowed, "{name}: {motion:.1e} per unit of sensitivity in displacements, velocities or energies");
    assert!(impacts <= allowed, "{name}: {impacts:.1e} per unit of sensitivity in the episodes");
}

#[test]
fn soft_contacts_on_both_sides_of_a_building() {
    compare("row_soft", 4, 2e-14);
}

#[test]
fn impulses_on_a_mass_from_both_sides() {
    compare("row_rigid", 2, 2e-14);
}

#[test]
fn impulses_on_a_building_from_both_sides() {
    compare("row_rigid_floors", 2, 9e-14);
}

#[test]
fn a_row_facing_each_other_between_walls() {
    compare("row_facing", 12, 5e-14);
}

#[test]
fn a_row_on_soil_with_links_that_yields() {
    compare("row_soil_yielding", 4, 3e-13);
}

#[test]
fn what_yields_and_slips_in_a_row() {
    let name = "row_soil_yielding";
    let (scene, record) = load(&format!("tests/reference/scenes/{name}.toml"));
    let (shown, start) = (Shown::new(&scene), || Run::new(&scene, Some(&record)));
    let worst = worst_of_storeys(name, &mut start(), &shown);
    println!("{name}: {worst:.1e} of the largest");
    assert!(worst <= 1.3e-13, "{name}: {worst:.1e} of the largest");
    let (mut run, mut count) = (start(), 0);
    for Switch { column, time, sense } in switches(name) {
        // 1e-11 s before and after.
        for (at, is_after) in [(time - 1e-11, false), (time + 1e-11, true)] {
            if at > run.state.time() {
                run.to(at);
                let is_there = run.read(shown.of(&column).unwrap()) == sense;
                assert_eq!(is_there, is_after, "{column} at {time} s, sense {sense}");
            }
        }
        count += 1;
    }
    assert_eq!(count, 226, "number of yields and turns");
}

/// A yield or a turn: what yields, s, and the sense in which it yields afterwards.
struct Switch {
    column: String,
    time: f64,
    sense: f64,
}

/// Those of all plastic steps above 1e-9 m, in the order of time.
fn switches(name: &str) -> Vec<Switch> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .unwrap()
        .join(format!("tests/reference/golden/{name}.yields.csv"));
    let text = std::fs::read_to_string(path).unwrap();
    let (mut begun, mut found) = (HashMap::new(), Vec::new());
    for line in text.lines().filter(|line| !line.starts_with('#')).skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let [time, plastic] = [3, 5].map(|field| fields[field].parse::<f64>().unwrap());
        let column = format!("{}.yielding[{}]", fields[0], fields[1]);
        let sense =
            ["yields -", "unloads", "yields +"].iter().position(|kind| *kind == fields[2]).unwrap() as f64 - 1.0;
        let switch = Switch { column: column.clone(), time, sense };
        if sense != 0.0 {
            begun.insert(column, (switch, plastic));
        } else if let Some((begin, from)) = begun.remove(&column)
            && (plastic - from).abs() > 1e-9
        {
            found.extend([begin, switch]);
        }
    }
    found.sort_by(|one, other| one.time.total_cmp(&other.time));
    found
}
