//! Rows of more than two buildings: what does not reach the others moves as it does without them.

use crate::common::{Run, record};
use pounding::engine::{BuildingId, Output, PeakOf};
use pounding::record::Record;
use pounding::scene::{Face, Link, Scene};
use pounding::variables::Table;

const LINEAR: &str = "law = \"linear\"\nstiffness = 2e8\n";
const DAMPED: &str = "law = \"kelvin_voigt\"\nstiffness = 2e8\nrestitution = 0.6\n";
const HERTZ: &str = "law = \"hertz\"\nstiffness = 5e9\n";
const RIGID: &str = "law = \"stereomechanical\"\nrestitution = 0.6\n";
/// m, and further than any building goes.
const NEAR: f64 = 0.002;
const FAR: f64 = 1e3;

/// A shear building; `keys` are further ones.
fn building(floors: usize, stiffness: f64, keys: &str) -> String {
    let of = |value: f64| vec![value; floors];
    format!("mass = {:?}\nstiffness = {:?}\ndamping = {{ ratio = 0.03 }}\n{keys}", of(3e4), of(stiffness))
}

/// Two neighbours that may meet with their first floors.
fn pair([left, right]: [&str; 2], gap: f64, law: &str) -> Scene {
    let text = format!(
        "name = \"Row\"\n[ground]\nrecord = \"r.csv\"\n[outputs]\nenergy = true\n[left]\n{left}[right]\n{right}[[contact]]\n\
         left_floor = 1\nright_floor = 1\ngap = {gap:?}\n{law}"
    );
    crate::common::scene(&text)
}

/// The row of which these are the neighbours, from left to right.
fn row(pairs: &[Scene]) -> Scene {
    let mut row = pairs[0].clone();
    for (shift, pair) in pairs.iter().enumerate().skip(1) {
        let shifted = |id: BuildingId| BuildingId::new(id.index() + shift);
        row.buildings.push(pair.buildings[1].clone());
        row.contacts.extend(pair.contacts.iter().cloned().map(|mut contact| {
            for face in [&mut contact.left, &mut contact.right] {
                if let Face::Floor(id, _) = face {
                    *id = shifted(*id);
                }
            }
            contact
        }));
        let end = |end: Option<(BuildingId, _)>| end.map(|(id, place)| (shifted(id), place));
        row.links.extend(pair.links.iter().map(|of| Link { left: end(of.left), right: end(of.right), ..of.clone() }));
    }
    let names = (0..row.buildings.len()).map(|place| format!("b{}", place + 1));
    row.buildings.iter_mut().zip(names).for_each(|(building, name)| building.name = name);
    row
}

/// A ground motion that is strong enough for impacts and yields.
fn shaking() -> Record {
    record(
        0.02,
        &(0..400).map(|k| 6.0 * f64::sin(0.17 * f64::from(k)) * f64::cos(0.031 * f64::from(k))).collect::<Vec<_>>(),
    )
}

/// Everything of some buildings at uneven times, with the size of each quantity.
fn history(scene: &Scene, buildings: &[usize]) -> (Vec<Vec<f64>>, usize) {
    let mut run = Run::new(scene, Some(&shaking()));
    let of_floor = |id: BuildingId, i: usize| {
        let peaks = [PeakOf::Displacement(id, i), PeakOf::Drift(id, i), PeakOf::Acceleration(id, i)].map(Output::Peak);
        [Output::Displacement(id, i), Output::Velocity(id, i), Output::Acceleration(id, i)].into_iter().chain(peaks)
    };
    let of_building = |id: BuildingId| {
        let floors = (0..run.model.floors(id)).flat_map(move |i| of_floor(id, i));
        floors.chain([Output::BaseShear(id), Output::Peak(PeakOf::BaseShear(id))])
    };
    let outputs: Vec<Output> = buildings.iter().flat_map(|place| of_building(BuildingId::new(*place))).collect();
    let mut rows = Vec::new();
    for k in 1..=60 {
        run.to(0.13 * f64::from(k));
        rows.push(outputs.iter().map(|of| run.read(*of)).collect());
        let residual = run.energy().residual.abs();
        assert!(residual < 1e-12, "energy residual {residual:e}");
    }
    (rows, run.episodes.len())
}

/// The largest difference of any quantity, relative to the largest that it has been.
fn apart(one: &[Vec<f64>], other: &[Vec<f64>]) -> f64 {
    let largest = |of: usize| one.iter().fold(0.0_f64, |largest, row| largest.max(row[of].abs()));
    let off = |of: usize| one.iter().zip(other).fold(0.0_f64, |off, (one, other)| off.max((one[of] - other[of]).abs()));
    assert!(one[0].len() == other[0].len() && one.len() == other.len());
    (0..one[0].len()).map(|of| off(of) / largest(of)).fold(0.0, f64::max)
}

/// Small and tall buildings, with storeys that yield, on soil.
fn buildings() -> [[String; 3]; 4] {
    let yielding = |floors: usize| format!("yield_force = {:?}\npost_yield_ratio = 0.05\n", vec![1.5e5; floors]);
    let soil = "height = [3.0, 3.0]\n[left.foundation]\nmass = 3e4\nsway = { stiffness = 1e8, dashpot = 1e5 }\n";
    [
        [building(2, 2e7, ""), building(3, 5e7, ""), building(1, 1e7, "")],
        [building(12, 6e7, ""), building(9, 9e7, ""), building(14, 5e7, "")],
        [building(2, 2e7, &yielding(2)), building(3, 5e7, ""), building(2, 3e7, &yielding(2))],
        [building(2, 2e7, soil), building(3, 5e7, ""), building(2, 1e7, "")],
    ]
}

#[test]
fn out_of_reach_is_as_if_not_there() {
    for [a, b, c] in &buildings() {
        for law in [LINEAR, DAMPED, HERTZ, RIGID] {
            let (near, far) = (pair([a, b], NEAR, law), pair([b, c], FAR, law));
            let (alone, episodes) = history(&near, &[0, 1]);
            let (in_row, as_many) = history(&row(&[near, far]), &[0, 1]);
            assert!(episodes > 1, "{episodes} impacts");
            let off = apart(&alone, &in_row);
            println!("right one out of reach, {law}: off by {off:.1e}");
            assert!(off < 1e-12 && as_many == episodes, "{law}: off by {off:e}, {as_many} impacts, not {episodes}");
            let (far, near) = (pair([a, b], FAR, law), pair([b, c], NEAR, law));
            let (alone, episodes) = history(&near, &[0, 1]);
            let (in_row, as_many) = history(&row(&[far, near]), &[1, 2]);
            let off = apart(&alone, &in_row);
            println!("left one out of reach, {law}: off by {off:.1e}");
            assert!(off < 1e-12 && as_many == episodes, "{law}: off by {off:e}, {as_many} impacts, not {episodes}");
        }
    }
}

#[test]
fn links_join_some_of_a_row() {
    let [a, b, c] = &buildings()[0];
    let linked = |pair: Scene| {
        let mut pair = pair;
        pair.links = crate::common::scene(&format!(
            "name = \"L\"\n[left]\n{b}[right]\n{c}[[link]]\nleft_floor = 1\nright_floor = 1\nstiffness = 2e7\ndashpot = 3e5\n"
        ))
        .links;
        pair
    };
    let (far, near) = (pair([a, b], FAR, LINEAR), linked(pair([b, c], FAR, LINEAR)));
    let (alone, _) = history(&near, &[0, 1]);
    let (in_row, _) = history(&row(&[far.clone(), near.clone()]), &[1, 2]);
    let off = apart(&alone, &in_row);
    assert!(off < 1e-12, "off by {off:e}");
    // And the one beside them by itself.
    let (alone, _) = history(&far, &[0]);
    let (in_row, _) = history(&row(&[far, near]), &[0]);
    let off = apart(&alone, &in_row);
    assert!(off < 1e-12, "off by {off:e}");
}

#[test]
fn a_row_has_the_variables_of_all_its_buildings() {
    let [a, b, c] = &buildings()[0];
    let table = Table::new(&row(&[pair([a, b], NEAR, LINEAR), pair([b, c], NEAR, LINEAR)]));
    let row = |name: &str| table.rows.iter().find(|row| row.name == name);
    for name in ["b1.displacement[2]", "b2.peak_drift[3]", "b3.base_shear", "contact[2].force"] {
        assert!(row(name).is_some(), "{name}");
    }
    let about = &row("contact[2].force").unwrap().description;
    assert!(about.ends_with("between b2 floor 1 and b3 floor 1"), "{about}");
}
