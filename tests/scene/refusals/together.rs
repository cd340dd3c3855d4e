//! A key that lacks another one, or that excludes it, and what is wrong with its value are told together.

use super::{STIFFNESS, said};
use crate::{SHORT, edited, messages};

const MATRIX: &str = "stiffness_matrix = [[3, -1], [-1, 2]]";
const COLLAPSE: &str = "left.collapse_drift_ratio = -0.5: expected";
const NO_LOAD: &str = "expected p_delta as well, the storeys that gravity pushes on as they lean";
const NO_FORCE: &str = "expected yield_force as well, the storey shears at first yield";
const NO_MATRIX: &str = "expected a shear building, with stiffness instead of stiffness_matrix";
const FORCE: &str = "expected a force > 0 N, or inf for a storey that stays elastic";

#[test]
fn keys_of_gravity() {
    assert_eq!(
        said("collapse_drift_ratio = -0.5"),
        [
            format!("{COLLAPSE} p_delta as well: without gravity no storey collapses"),
            format!("{COLLAPSE} yield_force as well: only storeys that yield collapse"),
            format!("{COLLAPSE} a finite share of the height > 0"),
        ]
    );
    assert_eq!(
        said("height = [0.5, 0.5]\np_delta = true\ncollapse_drift_ratio = nan"),
        [
            "left.collapse_drift_ratio = nan: expected yield_force as well: only storeys that yield collapse",
            "left.collapse_drift_ratio = nan: expected a finite share of the height > 0",
        ]
    );
    assert_eq!(
        said("gravity_load = [-1]"),
        [
            format!("left.gravity_load = [-1]: {NO_LOAD}"),
            "left.gravity_load = [-1]: expected 2 numbers, one per floor, not 1".to_owned(),
            "left.gravity_load[1] = -1: expected a finite weight >= 0 N".to_owned(),
        ]
    );
    assert_eq!(
        said("base_level = nan"),
        [
            "left.base_level = nan: expected height as well, the heights of the storeys above that level",
            "left.base_level = nan: expected a finite level in m",
        ]
    );
}

#[test]
fn keys_of_storeys_that_yield() {
    assert_eq!(
        said("post_yield_ratio = 1.5"),
        [
            format!("left.post_yield_ratio = 1.5: {NO_FORCE}"),
            "left.post_yield_ratio = 1.5: expected 0 <= r < 1".to_owned()
        ]
    );
    assert_eq!(
        said("post_yield_ratio = [0.1, \"a\", 2]"),
        [
            format!("left.post_yield_ratio = [0.1, \"a\", 2]: {NO_FORCE}"),
            "left.post_yield_ratio = [0.1, \"a\", 2]: expected 2 numbers, one per storey, not 3".to_owned(),
            "left.post_yield_ratio[2] = \"a\": expected a number".to_owned(),
            "left.post_yield_ratio[3] = 2: expected 0 <= r < 1".to_owned(),
        ]
    );
    let matrix = |keys: &str| messages(&edited(STIFFNESS, &format!("{MATRIX}\n{keys}")));
    assert_eq!(
        matrix("yield_force = [-1, inf, 3]\npost_yield_ratio = 1"),
        [
            format!("left.yield_force = [-1, inf, 3]: {NO_MATRIX}: only storeys yield"),
            "left.yield_force = [-1, inf, 3]: expected 2 numbers, one per storey, not 3".to_owned(),
            format!("left.yield_force[1] = -1: {FORCE}"),
            "left.post_yield_ratio = 1: expected 0 <= r < 1".to_owned(),
        ]
    );
}

#[test]
fn foundations() {
    let matrix = |foundation: &str| messages(&edited(STIFFNESS, &format!("{MATRIX}\nfoundation = {foundation}")));
    assert_eq!(
        matrix("{ mass = -1, inertia = 0 }"),
        [
            "left.foundation: expected sway, rocking or both: the springs and dashpots of the soil, without which it is a \
             fixed base"
                .to_owned(),
            format!("left.foundation: {NO_MATRIX}: its storeys lean with the foundation"),
            "left.foundation: expected height as well, the heights of the storeys that lean with the foundation".to_owned(),
            "left.foundation.mass = -1.0: expected a finite mass > 0 kg".to_owned(),
            "left.foundation.inertia = 0: expected rocking as well: a foundation that does not rock turns no inertia"
                .to_owned(),
            "left.foundation.inertia = 0: expected a finite moment of inertia > 0 kg m2".to_owned(),
        ]
    );
}

#[test]
fn a_law_that_there_is_not() {
    let contact = "left_floor = 1\nright_floor = 1\ngap = nan\nlaw = \"x\"";
    let said = |keys: &str| messages(&format!("{SHORT}\n[[contact]]\n{contact}\n{keys}"));
    let told = said("stiffness = -1\nrestitution = 7\nexponent = 4");
    assert!(told[1].starts_with("contact[1].law = \"x\": expected a known law"), "{told:?}");
    assert_eq!(told[0], "contact[1].gap = nan: expected a finite distance in m");
    assert_eq!(
        told[2..],
        [
            "contact[1].stiffness = -1: expected a finite stiffness > 0",
            "contact[1].restitution = 7: expected 0 <= e <= 1",
            "contact[1].exponent = 4: expected 1 <= n <= 3",
        ]
    );
    // Some law takes each of these.
    assert_eq!(said("stiffness = 1\nrestitution = 0\nexponent = 3").len(), 2);
}

#[test]
fn scales_of_the_record() {
    assert_eq!(
        messages(&format!("{SHORT}\n[ground]\nrecord = \"a.csv\"\nscale = 1\npga = nan")),
        [
            "ground.pga = nan: expected either scale or pga, not both",
            "ground.pga = nan: expected a finite peak acceleration > 0 m/s2",
        ]
    );
}
