//! Storeys that yield and links that slip, against the independent solution in quadruple precision (tests/reference), which knows no position
//! of rest: plastic drifts are unknowns of its own. Displacements, velocities, energies and impacts of the same scenes are
//! compared in `golden.rs`.

use crate::common::{Run, other};
use pounding::engine::{BuildingId, LinkOutput, Output, YieldingOf};
use pounding::scene;
use std::collections::HashMap;
use std::path::Path;

/// A CSV file with comments: one map of column to field for each row.
fn table(name: &str) -> Vec<HashMap<String, String>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join("tests/reference/golden").join(name);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    let row = |line: &str| header.iter().zip(line.split(',')).map(|(n, f)| ((*n).to_owned(), f.to_owned())).collect();
    lines.map(row).collect()
}

fn number(row: &HashMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap()
}

fn run_of(name: &str) -> Run {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .unwrap()
        .join("tests/reference/scenes")
        .join(format!("{name}.toml"));
    let (scene, record) = scene::load(&path).unwrap();
    Run::new(&scene, record.as_ref())
}

/// What yields or slips, counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Place {
    Storey(BuildingId, usize),
    Link(usize),
}

impl Place {
    /// Of a building, or `link`, and a number from 1.
    fn new(of: &str, number: &str) -> Place {
        let number = number.parse::<usize>().unwrap() - 1;
        match of {
            "link" => Place::Link(number),
            "left" => Place::Storey(BuildingId::LEFT, number),
            "right" => Place::Storey(BuildingId::RIGHT, number),
            _ => panic!("{of}"),
        }
    }

    /// The sense in which it yields or slips.
    fn sense(self) -> Output {
        match self {
            Place::Storey(side, storey) => Output::Yielding(side, storey),
            Place::Link(link) => Output::Link(link, LinkOutput::Slipping),
        }
    }
}

/// The quantity of a column; `None`: links do not show it. The links of these scenes that slip have no dashpots.
fn output(place: Place, quantity: &str) -> Option<Output> {
    let (of_storey, of_link) = match quantity {
        "yielding" => return Some(place.sense()),
        "storey_shear" => (YieldingOf::Shear, Some(LinkOutput::Force)),
        "plastic_drift" => (YieldingOf::PlasticDrift, Some(LinkOutput::Slip)),
        "cumulative_plastic_drift" => (YieldingOf::CumulativePlasticDrift, Some(LinkOutput::SlipTravel)),
        "hysteretic_energy" => (YieldingOf::HystereticEnergy, Some(LinkOutput::DissipatedEnergy)),
        "ductility" => (YieldingOf::Ductility, None),
        _ => panic!("{quantity}"),
    };
    match place {
        Place::Storey(side, storey) => Some(Output::OfYielding(of_storey, side, storey)),
        Place::Link(link) => of_link.map(|of| Output::Link(link, of)),
    }
}

/// What yields or slips, and what is between a dot and a bracket of a column's name.
fn parts(column: &str) -> (Place, &str) {
    let (of, rest) = column.split_once('.').unwrap();
    let (quantity, number) = rest.trim_end_matches(']').split_once('[').unwrap();
    (Place::new(of, number), quantity)
}

/// Worst error of all quantities of all storeys, each relative to its largest value.
fn worst_of_storeys(name: &str) -> f64 {
    let rows = table(&format!("{name}.storeys.csv"));
    let columns: Vec<&String> = rows[0].keys().filter(|column| column.contains('[')).collect();
    let largest = |column: &str| rows.iter().map(|row| number(row, column).abs()).fold(f64::MIN_POSITIVE, f64::max);
    let (mut run, mut worst) = (run_of(name), 0.0_f64);
    for row in &rows {
        run.to(number(row, "time"));
        for column in &columns {
            let (place, quantity) = parts(column);
            let Some(of) = output(place, quantity) else { continue };
            let (got, exact) = (run.read(of), number(row, column));
            if of == place.sense() {
                assert_eq!(got, exact, "{column} at {}", row["time"]);
            }
            worst = worst.max((got - exact).abs() / largest(column));
        }
    }
    worst
}

/// A yield or a turn.
struct Switch {
    place: Place,
    time: f64,
    /// The sense in which it yields or slips afterwards.
    sense: i32,
}

/// Those of all plastic steps above 1e-9 m, in the order of time.
fn switches(name: &str) -> Vec<Switch> {
    let mut begun: HashMap<Place, (Switch, f64)> = HashMap::new();
    let mut found = Vec::new();
    for row in table(&format!("{name}.yields.csv")) {
        let place = Place::new(&row["building"], &row["storey"]);
        let (time, plastic) = (number(&row, "time_s"), number(&row, "plastic_drift_m"));
        match row["kind"].as_str() {
            "collapses +" | "collapses -" => {}
            "unloads" => {
                let (begin, from) = begun.remove(&place).unwrap();
                if (plastic - from).abs() > 1e-9 {
                    found.extend([begin, Switch { place, time, sense: 0 }]);
                }
            }
            kind => {
                let sense = if kind == "yields +" { 1 } else { -1 };
                begun.insert(place, (Switch { place, time, sense }, plastic));
            }
        }
    }
    found.sort_by(|a, b| a.time.total_cmp(&b.time));
    found
}

/// Every yield and every turn is where it should be, to some seconds; returns how many there are.
fn check_switches(name: &str, allowed: f64) -> usize {
    let (mut run, switches) = (run_of(name), switches(name));
    for Switch { place, time, sense } in &switches {
        for (at, is_after) in [(time - allowed, false), (time + allowed, true)] {
            if at > run.state.time() {
                run.to(at);
                let is_there = run.read(place.sense()) == f64::from(*sense);
                assert_eq!(is_there, is_after, "{name}, {place:?} at {time} s, sense {sense}");
            }
        }
    }
    switches.len()
}

#[track_caller]
fn compare(name: &str, allowed: f64, count: usize) {
    let worst = worst_of_storeys(name);
    println!("{name}: {worst:.1e} of the largest");
    assert!(worst <= allowed, "{name}: {worst:.1e} of the largest");
    assert_eq!(check_switches(name, 1e-11), count, "{name}: number of yields and turns");
}

/// The storey that falls, the way it falls and, s, when; every scene that ends so tells it last.
fn collapse(name: &str) -> Option<(BuildingId, usize, f64, f64)> {
    let rows = table(&format!("{name}.yields.csv"));
    let row = rows.last().filter(|row| row["kind"].starts_with("collapses"))?;
    let side = if row["building"] == "left" { BuildingId::LEFT } else { BuildingId::RIGHT };
    let sign = if row["kind"].ends_with('+') { 1.0 } else { -1.0 };
    Some((side, row["storey"].parse::<usize>().unwrap() - 1, sign, number(row, "time_s")))
}

/// Where no peaks are watched the motion is the same, and so is the ductility of storeys that have yielded.
#[test]
fn without_peaks() {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join("tests/reference/scenes/yielding_columns.toml");
    let (mut scene, record) = scene::load(&path).unwrap();
    let runs = [true, false].map(|peaks| {
        scene.peaks = peaks;
        let mut run = Run::new(&scene, record.as_ref());
        run.in_steps(0.37, 7.4);
        let ductility = |storey| run.read(Output::OfYielding(YieldingOf::Ductility, BuildingId::LEFT, storey));
        ([0, 1, 2].map(|floor| run.displacement(BuildingId::LEFT, floor).to_bits()), [0, 1, 2].map(ductility))
    });
    assert_eq!(runs[0].0, runs[1].0);
    let pairs: Vec<(f64, f64)> = runs[0].1.into_iter().zip(runs[1].1).collect();
    assert!(pairs.iter().any(|(with, _)| *with > 1.0));
    for (with, without) in pairs {
        assert_eq!(without, if with > 1.0 { with } else { 0.0 });
    }
}

#[test]
fn elastic_perfectly_plastic_storeys_under_jankowski_contacts() {
    compare("yielding", 1.5e-13, 156);
}

#[test]
fn impulses_turn_storeys_that_yield() {
    compare("yielding_impulses", 2e-14, 60);
}

#[test]
fn columns_a_wall_and_storeys_that_stay_elastic() {
    compare("yielding_columns", 3e-14, 210);
}

#[test]
fn a_bilinear_isolator_with_dashpots_between_walls() {
    compare("yielding_isolator", 4e-14, 82);
}

#[test]
fn a_friction_damper_and_storeys_that_yield() {
    compare("linked_friction", 4e-14, 190);
}

#[test]
fn devices_that_slip_between_floors_and_to_the_ground() {
    compare("linked_walls", 7e-14, 226);
}

#[test]
fn storeys_that_yield_on_coupled_foundations() {
    compare("soil_yielding", 2e-13, 234);
}

#[test]
fn a_bearing_of_a_foundation_that_slips() {
    compare("soil_leaning", 8e-15, 12);
}

#[test]
fn a_building_that_gravity_makes_lean_on_its_neighbour() {
    compare("p_delta", 4e-14, 100);
    assert_eq!(collapse("p_delta"), None);
    let mut run = run_of("p_delta");
    run.to(20.0);
    assert_eq!([BuildingId::LEFT, BuildingId::RIGHT].map(|side| run.read(Output::Collapsed(side))), [0.0; 2]);
}

#[test]
fn a_storey_that_gravity_lets_fall() {
    // The last row is read at the engine's own time of the fall, 2e-14 s before the exact one: 2e-14 of the drift at its speed
    // then. The shear of the other building changes by 20 times its largest a second, which is 4e-13 of it until then.
    compare("p_delta_fall", 1.2e-12, 70);
    let (side, storey, sign, time) = collapse("p_delta_fall").unwrap();
    let mut run = run_of("p_delta_fall");
    run.to(20.0);
    let got = run.model.collapse(&run.state).unwrap();
    assert_eq!((got.building, got.storey), (side, storey));
    let error = (got.time - time).abs() / time;
    println!("collapse: off by {error:.1e} of its time");
    assert!(error < 1e-14, "collapse at {} s, not {time}: off by {error:.1e}", got.time);
    assert_eq!([side, other(side)].map(|side| run.read(Output::Collapsed(side))), [1.0, 0.0]);
    assert_eq!([side, other(side)].map(|side| run.read(Output::CollapseTime(side))), [got.time, -1.0]);
    assert!((run.storey(side, storey).plastic * sign) > 1.0);
}
