//! The parameters of foundations, and the period of the building on its soil.

use super::dependencies::{compare, declared, seen_at_start};
use super::effect::run_with;
use crate::support::{CORRECTED, ERROR, Fmu, OK, YIELDING};

pub(super) const SCENE: &str = "name = \"Soil\"\nstop_time = 2.0\n[outputs]\nenergy = true\n[ground]\n\
    record = \"record.csv\"\n\
    [left]\nmass = [4e4, 3e4]\nheight = [4.0, 3.0]\nstiffness = [3e7, 2e7]\ndamping = { ratio = 0.05 }\np_delta = true\n\
    initial_displacement = [0.01, 0.02]\n[left.foundation]\nmass = 3e4\ninertia = 3e5\n\
    sway = { stiffness = 9e7, dashpot = 1.5e6 }\nrocking = { stiffness = 1.2e9, dashpot = 4e6 }\n\
    [right]\nmass = [5e4]\nheight = [3.0]\nstiffness = [6e7]\ndamping = { ratio = 0.05 }\n\
    [[contact]]\nleft_storey = 1\nleft_position = 0.7\nright_floor = 1\ngap = 0.02\nlaw = \"linear\"\nstiffness = 1e8\n";

const CHANGES: [(&str, f64, &str, &str); 6] = [
    ("mass", 3.1e4, "mass = 3e4\ninertia", "mass = 3.1e4\ninertia"),
    ("inertia", 3.3e5, "inertia = 3e5", "inertia = 3.3e5"),
    ("sway_stiffness", 8e7, "= 9e7", "= 8e7"),
    ("sway_dashpot", 0.0, "= 1.5e6", "= 0.0"),
    ("rocking_stiffness", 1.1e9, "= 1.2e9", "= 1.1e9"),
    ("rocking_dashpot", 4.4e6, "= 4e6", "= 4.4e6"),
];

fn edited(from: &str, to: &str) -> String {
    assert_eq!(SCENE.matches(from).count(), 1, "{from:?} must be in the scene once");
    SCENE.replace(from, to)
}

#[test]
fn parameters_of_foundations_work_as_if_the_scene_had_said_so() {
    let fmu = Fmu::new(SCENE);
    let unchanged = run_with(&fmu, &[], false);
    for (name, value, from, to) in CHANGES {
        let name = format!("left.foundation.{name}");
        let expected = run_with(&Fmu::new(&edited(from, to)), &[], false);
        for in_initialization in [false, true] {
            assert!(run_with(&fmu, &[(&name, value)], in_initialization) == expected, "{name} {in_initialization}");
        }
        assert!(expected != unchanged, "{name} has no effect");
    }
}

#[test]
fn values_that_a_foundation_cannot_have() {
    let fmu = Fmu::new(SCENE);
    for (name, value, expected) in [
        ("mass", 0.0, "left.foundation.mass = 0.0: expected a finite mass > 0 kg"),
        ("inertia", -1.0, "left.foundation.inertia = -1.0: expected a finite moment of inertia > 0 kg m2"),
        ("sway_stiffness", 0.0, "left.foundation.sway_stiffness = 0.0: expected a finite stiffness > 0 N/m"),
        ("sway_dashpot", -1.0, "left.foundation.sway_dashpot = -1.0: expected a finite dashpot >= 0 N s/m"),
        ("rocking_stiffness", 0.0, "left.foundation.rocking_stiffness = 0.0: expected a finite stiffness > 0 N m/rad"),
        ("rocking_dashpot", -1.0, "left.foundation.rocking_dashpot = -1.0: expected a finite dashpot >= 0 N m s/rad"),
    ] {
        let instance = fmu.instance();
        assert_eq!(instance.set_real(&format!("left.foundation.{name}"), value), ERROR, "{name}");
        assert_eq!(instance.log().last().unwrap().message, format!("fmi2SetReal: {expected}"));
    }
    // With gravity it takes masses and springs together: set one after the other, and looked at when all are there.
    let instance = fmu.instance();
    assert_eq!(instance.set_real("left.foundation.rocking_stiffness", 3e6), OK);
    assert_eq!(instance.set_real("left.mass[2]", 1e3), OK);
}

#[test]
fn a_foundation_has_the_variables_of_the_ways_in_which_it_moves() {
    let of = |scene: &str, side: &str| {
        let prefix = format!("{side}.foundation.");
        let fmu = Fmu::new(scene);
        let variables = fmu.description.modelVariables.iter().filter(|v| v.name.starts_with(&prefix));
        variables.map(|v| v.name[prefix.len()..].to_owned()).collect::<Vec<_>>().join(" ")
    };
    const SWAY: &str = "displacement velocity acceleration force peak_displacement peak_force";
    const ROCKS: &str = "rotation rotation_rate moment peak_rotation peak_moment";
    let parameters = "mass inertia sway_stiffness sway_dashpot rocking_stiffness rocking_dashpot";
    assert_eq!(of(SCENE, "left"), format!("{parameters} {SWAY} {ROCKS} period_ratio"));
    assert_eq!(of(SCENE, "right"), "");
    let sways = edited("inertia = 3e5\n", "").replace("rocking = { stiffness = 1.2e9, dashpot = 4e6 }\n", "");
    assert_eq!(of(&sways, "left"), format!("mass sway_stiffness sway_dashpot {SWAY} period_ratio"));
    let rocks = edited("sway = { stiffness = 9e7, dashpot = 1.5e6 }\n", "");
    assert_eq!(of(&rocks, "left"), format!("mass inertia rocking_stiffness rocking_dashpot {ROCKS} period_ratio"));
    let plain = edited("energy = true", "peaks = false");
    assert!(!of(&plain, "left").contains("peak"));
}

#[test]
fn the_period_on_the_soil_follows_its_parameters() {
    let fmu = Fmu::new(&edited("p_delta = true\n", ""));
    let instance = fmu.instance();
    instance.enter();
    let ratio = instance.real("left.foundation.period_ratio");
    // First modes: the system's is that of the left building, which is the slower one.
    let [alone, whole] = ["left.frequency[1]", "system.frequency[1]"].map(|name| instance.real(name));
    assert!((ratio - alone / whole).abs() < 1e-14 && ratio > 1.1, "{ratio}, {alone} Hz, {whole} Hz");
    assert_eq!(instance.set_real("left.foundation.sway_stiffness", 4.5e7), OK);
    assert!(instance.real("left.foundation.period_ratio") > 1.01 * ratio);
}

/// Small buildings that begin displaced and beyond their yield drifts, the left one on soil, with more in their scene.
fn displaced(gravity: &str, more: &str) -> String {
    let soil = format!(
        "{gravity}height = [0.5, 0.4]\n[left.foundation]\nmass = 2.0\ninertia = 0.3\nsway = {{ stiffness = 4e3, dashpot = 20 }}\n\
         rocking = {{ stiffness = 2e3, dashpot = 8 }}\n[right]"
    );
    YIELDING.replacen("[right]", &soil, 1) + more
}

#[test]
fn initial_unknowns_on_soil_depend_on_what_they_are_said_to_depend_on() {
    const COLUMNS: &str = "[[contact]]\nleft_storey = 1\nleft_position = 0.6\nright_floor = 1\ngap = 0.03\n\
                           law = \"kelvin_voigt\"\nstiffness = 1.0e4\nrestitution = 0.65\n\
                           [[link]]\nleft_floor = 0\nright_floor = 1\nstiffness = 300.0\ndashpot = 3.0\n";
    let corrected = CORRECTED.to_owned();
    for scene in [displaced("", ""), displaced("", COLUMNS), displaced("p_delta = true\n", ""), corrected] {
        let fmu = Fmu::new(&scene);
        let record = fmu.directory.path().join("other.csv");
        std::fs::write(&record, "time_s,accel_m_s2\n0.0,0.5\n1.0,0.0\n").unwrap();
        let mut seen = seen_at_start(&fmu, record.to_str().unwrap());
        let mut said = declared(&fmu.description, &fmu.description.initialUnknowns);
        match scene.contains("[[link]]") {
            // Of two buildings in one order: which has which is up to all numbers.
            false => {
                seen.retain(|unknown, _| !unknown.starts_with("system."));
                said.retain(|unknown, _| !unknown.starts_with("system."));
            }
            // What may depend on the links of a building that has yielded, and on where columns are hit, is said of all.
            true => said.iter_mut().for_each(|(unknown, knowns)| {
                let is_broad =
                    unknown.contains("residual") || unknown.contains("impacts") || unknown.contains("active");
                knowns.retain(|known| !is_broad || seen[unknown].contains(known));
            }),
        }
        compare(&seen, &said);
    }
}

#[test]
fn a_foundation_answers_at_once_to_forces_on_floors_that_are_held_against_its_columns() {
    let law = "gap = 0.0\nlaw = \"stereomechanical\"\nrestitution = 0.0\n";
    let held = SCENE
        .split_once("[[contact]]")
        .unwrap()
        .0
        .replace("[ground]\nrecord = \"record.csv\"\n", "[inputs]\nfloor_forces = true\n");
    let held = held.replace("initial_displacement = [0.01, 0.02]\n", "");
    let contact = format!("[[contact]]\nleft_storey = 1\nleft_position = 0.7\nright_floor = 1\n{law}");
    let fmu = Fmu::new(&(held + &contact));
    let said = declared(&fmu.description, &fmu.description.outputs);
    let knowns = ["left.force[1]", "left.force[2]", "right.force[1]", "ground.acceleration"];
    let instance = fmu.instance();
    instance.start();
    for (name, force) in [("left.force[1]", 4e5), ("right.force[1]", -4e5)] {
        assert_eq!(instance.set_real(name, force), OK);
    }
    assert_eq!(instance.step(0.0, 0.2), OK, "{:?}", instance.log());
    assert!(instance.real("contact[1].force") > 1.0);
    for unknown in
        ["left.foundation.acceleration", "left.acceleration[1]", "left.acceleration[2]", "right.acceleration[1]"]
    {
        let before = instance.real(unknown);
        for known in knowns {
            let value = instance.real(known);
            assert_eq!(instance.set_real(known, value + 500.0), OK);
            let answers = (instance.real(unknown) - before).abs() > 1e-9;
            assert_eq!(instance.set_real(known, value), OK);
            assert_eq!(said[unknown].contains(known), answers, "{unknown} and {known}");
        }
    }
}
