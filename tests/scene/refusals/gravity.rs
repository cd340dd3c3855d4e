//! Gravity on storeys that lean.

use super::{DAMPING, STIFFNESS, said};
use crate::{edited, messages};
use pounding::scene::Scene;

/// Of a scene whose floors weigh 29.4 and 39.2 N.
const FRAME: &str = "height = [0.5, 0.5]\np_delta = true\n";

#[test]
fn the_keys_of_gravity() {
    for fine in [
        FRAME,
        "height = [0.5, 0.5]\np_delta = [false, true]",
        "p_delta = false",
        "height = [0.5, 0.5]\np_delta = true\ngravity_load = [0, 1e3]",
        "height = [0.5, 0.5]\np_delta = true\nyield_force = [40.0, inf]\ncollapse_drift_ratio = 0.1",
    ] {
        assert_eq!(said(fine), [""; 0], "{fine}");
    }
    const HEIGHT: &str =
        "expected height as well, the heights of the storeys: a weight pushes on with its share of drift over height";
    const LOAD: &str = "expected a finite weight >= 0 N";
    for (keys, expected) in [
        ("p_delta = true", format!("left.p_delta = true: {HEIGHT}")),
        ("p_delta = [false, true]", format!("left.p_delta = [false, true]: {HEIGHT}")),
        (
            "height = [0.5, 0.5]\np_delta = [true]",
            "left.p_delta = [true]: expected true, false or a list of 2 of them, one per storey, not 1".to_owned(),
        ),
        ("height = [0.5, 0.5]\np_delta = 1", "left.p_delta = 1: expected true or false".to_owned()),
        (
            "gravity_load = [1, 2]",
            "left.gravity_load = [1, 2]: expected p_delta as well, the storeys that gravity pushes on as they lean"
                .to_owned(),
        ),
    ] {
        assert_eq!(said(keys), [expected], "{keys}");
    }
    for (keys, expected) in [
        ("gravity_load = [1]", "left.gravity_load = [1.0]: expected 2 numbers, one per floor, not 1".to_owned()),
        ("gravity_load = [30, -1]", format!("left.gravity_load[2] = -1.0: {LOAD}")),
        ("gravity_load = [inf, 1]", format!("left.gravity_load[1] = inf: {LOAD}")),
        (
            "collapse_drift_ratio = 0.5",
            "left.collapse_drift_ratio = 0.5: expected yield_force as well: only storeys that yield collapse"
                .to_owned(),
        ),
        (
            "yield_force = [40, inf]\ncollapse_drift_ratio = 0",
            "left.collapse_drift_ratio = 0.0: expected a finite share of the height > 0".to_owned(),
        ),
    ] {
        assert_eq!(said(&format!("{FRAME}{keys}")), [expected], "{keys}");
    }
}

/// The weights of 3 and 4 kg over 10 mm, and loads of 20 and 30 N over as much.
#[test]
fn a_building_that_gravity_pushes_over() {
    const STANDS: &str = "left.p_delta: expected storeys that stand: gravity on storey";
    let low = "height = [0.01, 0.02]\np_delta = true";
    assert_eq!(said(low), [format!("{STANDS} 1 (g = 6864.65 N/m) is not below its stiffness, 2910.0 N/m")]);
    assert_eq!(said("height = [0.01, 0.01]\np_delta = true").len(), 2);
    assert_eq!(said("height = [0.01, 0.02]\np_delta = [false, true]"), [""; 0]);
    assert_eq!(said(&format!("{low}\ngravity_load = [9.0, 20.0]")), [""; 0]);
    // As much as its stiffness is too much.
    let exact = said(&format!("{low}\ngravity_load = [9.1, 20.0]"));
    assert_eq!(exact, [format!("{STANDS} 1 (g = 2910.0 N/m) is not below its stiffness, 2910.0 N/m")]);

    let matrix = |heights: &str| {
        let keys = "stiffness_matrix = [[5830.0, -2920.0], [-2920.0, 2920.0]]\np_delta = true\nheight = ";
        messages(&edited(STIFFNESS, &format!("{keys}{heights}")))
    };
    assert_eq!(matrix("[0.1, 0.1]"), [""; 0]);
    let expected = "left.p_delta: expected a building that stands: less the stiffness that gravity takes, the eigenvalues of \
                    stiffness_matrix go from";
    let fallen = matrix("[0.01, 0.02]");
    assert!(fallen.len() == 1 && fallen[0].starts_with(expected), "{fallen:?}");
}

#[test]
fn in_kilonewtons() {
    let scene = edited(DAMPING, &format!("{DAMPING}\n{FRAME}gravity_load = [30.0, 40.0]"));
    let in_kn = scene
        .replacen("name", "units = \"kN-t\"\nname", 1)
        .replace("[3.0, 4.0]", "[3e-3, 4e-3]")
        .replace("[2910.0, 2920.0]", "[2.91, 2.92]")
        .replace("[30.0, 40.0]", "[0.03, 0.04]");
    let [si, kn] = [&scene, &in_kn].map(|text| Scene::from_toml(text).unwrap().buildings.remove(0));
    assert_eq!(si.p_delta, kn.p_delta);
    assert_eq!(si.net_stiffness(), kn.net_stiffness());
    let said = |from: &str, to: &str| messages(&in_kn.replace(from, to));
    assert_eq!(
        said("[0.03, 0.04]", "[-0.03, 0.04]"),
        ["left.gravity_load[1] = -0.03: expected a finite weight >= 0 kN"]
    );
    let expected = "left.p_delta: expected storeys that stand: gravity on storey 1 (g = 7.0 kN/m) is not below its stiffness, 2.91 kN/m";
    assert_eq!(said("height = [0.5, 0.5]", "height = [0.01, 0.02]"), [expected]);
}

/// A yield drift of 13.7 mm, of heights of 0.5 m 0.0275.
#[test]
fn a_collapse_before_anything_yields() {
    let with = |ratio: &str, more: &str| {
        said(&format!("{FRAME}yield_force = [40.0, inf]\ncollapse_drift_ratio = {ratio}\n{more}"))
    };
    assert_eq!(with("0.028", ""), [""; 0]);
    let expected = "left.collapse_drift_ratio = 0.027: expected more than 0.0274914: storey 1 would have collapsed at a drift of \
                    0.0135 m, before it yields or at the start";
    assert_eq!(with("0.027", ""), [expected]);
    let start = "initial_displacement = [-0.05, 0.3]";
    assert_eq!(with("0.11", start), [""; 0]);
    let told = with("0.1", start);
    assert!(told.len() == 1 && told[0].contains("more than 0.1: storey 1"), "{told:?}");
}
