//! Slips are told, sound scenes are not: what `pounding::warnings` finds in scenes that are all allowed.

mod buildings;
mod gravity;
mod levels;
mod links;
mod order;
mod rows;
mod soil;
mod yielding;

use pounding::record::Record;
use pounding::scene::{Scene, Units, load};
use pounding::warnings::{self, Warning};
use std::fs;
use std::path::PathBuf;

const FEUP: &str = include_str!("../../../examples/scenes/feup.toml");
const OFFICES: &str = include_str!("../../problems/offices_pair_by_pair.toml");
const ISOLATED: &str = include_str!("../../problems/isolated_beside_a_stiff_mass.toml");
const FILIATRAULT: &str = include_str!("../../../examples/paper/scenes/filiatrault.toml");

fn root() -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

fn el_centro() -> Record {
    let name = "examples/records/el_centro_1940_ns.csv";
    Record::parse(name, &fs::read(root().join(name)).unwrap()).unwrap()
}

/// El Centro with other numbers.
fn changed(change: impl Fn(f64, f64) -> (f64, f64)) -> Record {
    let Record { times, accelerations, .. } = el_centro();
    let (times, accelerations) = times.into_iter().zip(accelerations).map(|(t, a)| change(t, a)).unzip();
    Record::new(times, accelerations)
}

/// A scene with changes; each text must be there, and is changed wherever it is.
fn edited(scene: &str, changes: &[(&str, &str)]) -> String {
    changes.iter().fold(scene.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "{from:?} is not in the scene");
        text.replace(from, to)
    })
}

/// What is found in a scene; a record that it names is El Centro unless it is given.
fn found(text: &str, record: Option<&Record>) -> Vec<Warning> {
    let scene = Scene::from_toml(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let own = scene.ground.record.as_ref().map(|_| record.cloned().unwrap_or_else(el_centro));
    warnings::of(&scene, own.as_ref())
}

fn paths(warnings: &[Warning]) -> Vec<&str> {
    warnings.iter().map(|warning| warning.path.as_str()).collect()
}

/// Scene, changes, and what is told: the paths, and words of the first text.
type Slip = (&'static str, &'static [(&'static str, &'static str)], &'static [&'static str], &'static str);

fn expect(slips: &[Slip]) {
    for (scene, changes, expected, words) in slips {
        let found = found(&edited(scene, changes), None);
        let told = found.iter().map(|warning| format!("\n  {warning}")).collect::<String>();
        assert_eq!(paths(&found), *expected, "{changes:?}{told}");
        assert!(found[0].text.contains(words), "{words:?} is not in{told}");
    }
}

#[test]
fn the_ground_and_the_end() {
    const PGA: &str = "pga = 3.43 ";
    const RECORD: &str = "record = \"../records/el_centro_1940_ns.csv\"\n";
    expect(&[
        (OFFICES, &[(PGA, "pga = 0.35 ")], &["ground.pga"], "was 0.35 g meant (3.43 m/s2)?"),
        (OFFICES, &[(PGA, "pga = 343 ")], &["ground.pga"], "was 343 cm/s2 meant (3.43 m/s2)?"),
        (OFFICES, &[(PGA, "pga = 35 ")], &["ground.pga"], "3.57 g"),
        (OFFICES, &[(PGA, "scale = 0.1 ")], &["ground.scale"], "weak, felt by people"),
        (OFFICES, &[(PGA, "scale = 9.81 ")], &["ground.scale"], "3.13 g"),
        (OFFICES, &[(PGA, "scale = 0 ")], &["ground.scale"], "stands still"),
        (FEUP, &[("stop_time = 20.0", "stop_time = 20e3")], &["stop_time"], "in ms?"),
        (FEUP, &[("stop_time = 20.0", "stop_time = 0.02")], &["stop_time"], "before the shaking"),
        (FEUP, &[("stop_time = 20.0", "stop_time = 2.0")], &["stop_time"], "its peak at 2.04 s, its end at 31.2 s"),
        (FEUP, &[("stop_time = 20.0", "stop_time = 400.0")], &["stop_time"], "stands still for 369 s after it"),
        (FEUP, &[("stop_time = 20.0", "stop_time = 20e3"), (RECORD, "")], &["stop_time"], "hours"),
        (FEUP, &[("stop_time = 20.0", "stop_time = 0.02"), (RECORD, "")], &["stop_time"], "shorter than a swing"),
    ]);
}

#[test]
fn the_record() {
    let g = 9.80665;
    for (record, words) in [
        (changed(|t, a| (t, a / g)), "is it in g (then scale = 9.80665)?"),
        (changed(|t, a| (t, 100.0 * a)), "is it in cm/s2 (then scale = 0.01)?"),
        (changed(|t, a| (t, 1000.0 * a)), "is it in mm/s2 (then scale = 0.001)?"),
        (changed(|t, _| (t, 0.0)), "all its samples are 0"),
        (changed(|t, a| (1000.0 * t, a)), "given in ms or counted?"),
        (changed(|t, a| (t / 0.02, a)), "given in ms or counted?"),
        (changed(|t, a| (t / 1000.0, a)), "one every 2e-5 s"),
        (changed(|t, a| (t + 1.6e9, a)), "begin at 0?"),
    ] {
        let found = found(FEUP, Some(&record));
        assert_eq!(paths(&found), ["ground.record"], "{words}: {found:?}");
        assert!(found[0].text.contains(words), "{words:?} is not in {}", found[0]);
        assert_eq!(found[0].value, "\"../records/el_centro_1940_ns.csv\"");
    }
    // In g, as the files of the PEER are: turned into m/s2 once more.
    let at2 = edited(FEUP, &[("el_centro_1940_ns.csv\"", "elcentro.AT2\"\nscale = 9.81")]);
    assert_eq!(paths(&found(&at2, Some(&changed(|t, a| (t, 0.5 * a))))), ["ground.scale"]);
}

#[test]
fn contacts() {
    const GAP: &str = "gap = 0.03\n";
    const STIFFNESS: &str = "stiffness = 2.75e9";
    expect(&[
        (OFFICES, &[(GAP, "gap = 30\n")], &["contact[1].gap"], "in mm (0.03 m)?"),
        (OFFICES, &[(GAP, "gap = 3.0\n")], &["contact[1].gap"], "3 m between the buildings"),
        (OFFICES, &[(GAP, "gap = -0.03\n")], &["contact[1].gap"], "was 0.03 m meant?"),
        (FEUP, &[("gap = 0.005", "gap = -0.04")], &["contact[1].gap"], "40 mm deep"),
        (FEUP, &[("gap = 0.005", "gap = -0.005")], &["contact[1].gap"], "5 mm deep"),
        (FEUP, &[("gap = 0.005", "gap = 0.5")], &["contact[1].gap"], "in mm or cm?"),
        (OFFICES, &[(STIFFNESS, "stiffness = 2.75e7")], &["contact[1].stiffness"], "pass deep into each other"),
        (OFFICES, &[(STIFFNESS, "stiffness = 2.75e11")], &["contact[1].stiffness"], "shorter than the floors"),
        (OFFICES, &[(STIFFNESS, "stiffness = 2.75e16")], &["contact[1].stiffness"], "power of ten"),
        (FEUP, &[("stiffness = 1.0e6", "stiffness = 1.0e8")], &["contact[1].stiffness"], "power of ten"),
        (FEUP, &[("stiffness = 1.0e6", "stiffness = 1.0e13")], &["contact[1].stiffness"], "power of ten"),
        (ISOLATED, &[("1.0e9\nrest", "1.0e11\nrest")], &["contact[1].stiffness"], "power of ten"),
        (OFFICES, &[(STIFFNESS, "stiffness = 2.75e6")], &["contact[1].stiffness"], "given in kN/m^exponent?"),
        (
            OFFICES,
            &[(STIFFNESS, "stiffness = 2.75e12")],
            &["contact[1].stiffness"],
            "(likewise 2 more, contact[2] to contact[3])",
        ),
        (FEUP, &[("stiffness = 1.0e6", "stiffness = 1.0e3")], &["contact[1].stiffness"], "given in kN/m?"),
        (FEUP, &[("stiffness = 1.0e6", "stiffness = 1.0e9")], &["contact[1].stiffness"], "power of ten"),
        (FILIATRAULT, &[("12.8e6", "12.8e3")], &["contact[1].stiffness"], "given in kN/m?"),
        (FILIATRAULT, &[("12.8e6", "12.8e9")], &["contact[1].stiffness"], "power of ten"),
        (ISOLATED, &[("1.0e9\nrest", "1.0e6\nrest")], &["contact[1].stiffness"], "given in kN/m?"),
        (ISOLATED, &[("1.0e9\nrest", "1.0e12\nrest")], &["contact[1].stiffness"], "power of ten"),
        (
            OFFICES,
            &[("stiffness = 2.75e9", "exponent = 3.0\nstiffness = 2.75e9")],
            &["contact[1].exponent"],
            "Hertz's is 1.5",
        ),
        (OFFICES, &[("restitution = 0.65", "restitution = 0.0065")], &["contact[1].restitution"], "decimal point"),
        (
            OFFICES,
            &[("[ground]", "[solver]\nmin_approach_velocity = 0.1\n[ground]")],
            &["solver.min_approach_velocity"],
            "mm/s",
        ),
    ]);
    let crossed = edited(OFFICES, &[("left_floor = 3\nright_floor = 3", "left_floor = 3\nright_floor = 1")]);
    let found_there = found(&crossed, None);
    assert_eq!(paths(&found_there), ["contact[3]"]);
    assert_eq!(found_there[0].value, "left_floor 3, right_floor 1");
    // Where many pairs cross, that is what is meant.
    let all = [(1, 1), (2, 2), (1, 2), (2, 1), (1, 3), (2, 3)].map(|(left, right)| {
        format!(
            "[[contact]]\nleft_floor = {left}\nright_floor = {right}\ngap = 0.03\nlaw = \"hertz\"\nstiffness = 2.75e9\n"
        )
    });
    let head = OFFICES.split("[[contact]]").next().unwrap();
    assert_eq!(paths(&found(&(head.to_owned() + &all.concat()), None)), [""; 0]);
    let without = OFFICES.split("[[contact]]").next().unwrap();
    let found = found(without, None);
    assert_eq!(paths(&found), ["contact"]);
    assert_eq!(found[0].value, "[]");
}

/// Single masses, whose contact has only one period to be compared with.
#[test]
fn the_contact_of_single_masses() {
    for (law, usual) in [("linear", 1e9), ("hertz", 2.75e9)] {
        for (factor, expected) in [(1e-3, &["contact[1].stiffness"][..]), (1.0, &[]), (1e3, &["contact[1].stiffness"])]
        {
            let contact = format!("gap = 0.05\nlaw = \"{law}\"\nstiffness = {:?}\n", usual * factor);
            let found = found(&pair(&tower(1, 330e3, 0.777), &tower(1, 330e3, 0.5), &contact), None);
            assert_eq!(paths(&found), expected, "{law}, {factor}: {found:?}");
        }
    }
}

/// A negative gap that is no slip by itself, where a displacement takes the floors deep into each other.
#[test]
fn an_overlap_by_the_initial_displacement() {
    let start = |gap: &str, displacement: &str| {
        let moved = format!("mass = [3.65, 3.65]\ninitial_displacement = {displacement}\n");
        found(&edited(FEUP, &[("gap = 0.005", gap), ("mass = [3.65, 3.65]\n", moved.as_str())]), None)
    };
    for gap in ["gap = -0.0001", "gap = 0.0"] {
        let told = start(gap, "[0.02, 0.02]");
        assert_eq!(paths(&told), ["contact[1].gap"], "{told:?}");
        assert!(told[0].text.contains("displacements, in m, take the floors 20 mm towards each other;"), "{}", told[0]);
    }
    let told = start("gap = -0.02", "[0.001, 0.001]");
    assert!(told[0].text.contains("was 0.02 m meant?"), "{told:?}");
    assert_eq!(start("gap = -0.02", "[-0.02, -0.02]"), []);
}

/// One of several contacts, and no other.
#[test]
fn one_contact_among_others() {
    let last = |from: &str, to: &str| {
        let place = OFFICES.rfind(from).unwrap();
        format!("{}{to}{}", &OFFICES[..place], &OFFICES[place + from.len()..])
    };
    for (from, to, path) in [
        ("gap = 0.03", "gap = 30", "contact[3].gap"),
        ("gap = 0.03", "gap = 0.00003", "contact[3].gap"),
        ("gap = 0.03", "gap = -0.03", "contact[3].gap"),
        ("stiffness = 2.75e9", "stiffness = 2.75e6", "contact[3].stiffness"),
        ("stiffness = 2.75e9", "stiffness = 2.75e12", "contact[3].stiffness"),
    ] {
        let found = found(&last(from, to), None);
        assert_eq!(paths(&found), [path], "{to}: {found:?}");
        assert!(!found[0].text.contains("likewise"), "{}", found[0]);
    }
}

/// Every scene of this repository that is meant to be looked at. Only the grounds of the two that lean hardly shake: they
/// tilt. And those that may fall say so,
/// one of them soft enough to be taken for isolated, with a floor that meets another above its level, as one on soil does.
#[test]
fn scenes_of_this_repository_are_sound() {
    let folders = ["examples/scenes", "examples/paper/scenes", "tests/reference/scenes"];
    let files = folders.iter().flat_map(|folder| fs::read_dir(root().join(folder)).unwrap());
    let scenes: Vec<PathBuf> =
        files.map(|file| file.unwrap().path()).filter(|path| path.extension().is_some_and(|e| e == "toml")).collect();
    assert!(scenes.len() > 15);
    for path in scenes {
        let (mut scene, record) = load(&path).unwrap();
        let expected: &[&str] = match path.strip_prefix(root()).unwrap().to_str().unwrap() {
            "tests/reference/scenes/leaning.toml" | "tests/reference/scenes/leaning_on_columns.toml" => {
                &["ground.record"]
            }
            "examples/scenes/leaning.toml" | "tests/reference/scenes/p_delta.toml" => &["left.p_delta"],
            "tests/reference/scenes/p_delta_fall.toml" => {
                &["right.damping.ratio", "right.p_delta", "contact[1].right_floor"]
            }
            // A bearing is soft for soil.
            "tests/reference/scenes/soil_leaning.toml" => &["ground.record", "left.foundation.sway.stiffness"],
            "tests/reference/scenes/soil_yielding.toml" => &["contact[2].right_floor"],
            _ => &[],
        };
        // The same numbers, whatever the units of the file.
        for units in Units::ALL {
            scene.units = units;
            let found = warnings::of(&scene, record.as_ref());
            assert_eq!(paths(&found), expected, "{}: {found:?}", path.display());
        }
    }
}

/// A shear building of equal storeys with a period.
fn tower(storeys: usize, mass: f64, period: f64) -> String {
    let omega = 2.0 * std::f64::consts::PI / period;
    let share = 2.0 * (std::f64::consts::PI / (4.0 * storeys as f64 + 2.0)).sin();
    let (mass, stiffness) = (vec![mass; storeys], vec![mass * (omega / share).powi(2); storeys]);
    format!("mass = {mass:?}\nstiffness = {stiffness:?}\n")
}

fn pair(left: &str, right: &str, contact: &str) -> String {
    let damping = "damping = { ratio = 0.05 }\n";
    format!(
        "name = \"Pair\"\n[left]\n{left}{damping}[right]\n{right}{damping}[ground]\nrecord = \"el_centro.csv\"\n\
         [[contact]]\nleft_floor = 1\nright_floor = 1\n{contact}"
    )
}

#[test]
fn unusual_buildings_are_sound() {
    const HERTZ: &str = "gap = 0.05\nlaw = \"hertz\"\nstiffness = 2.75e9\n";
    const LINEAR: &str = "gap = 0.05\nlaw = \"linear\"\nstiffness = 93.5e6\n";
    const RIGID: &str = "gap = 0.05\nlaw = \"stereomechanical\"\nrestitution = 0.6\n";
    let isolated = |period: f64| {
        let omega = 2.0 * std::f64::consts::PI / period;
        format!("mass = [300e3, 300e3, 300e3, 300e3]\nstiffness = [{:?}, 900e6, 900e6, 900e6]\n", 1.2e6 * omega * omega)
    };
    for (what, left, right) in [
        ("a tower", tower(80, 1.2e6, 8.0), tower(10, 400e3, 1.0)),
        ("a slender tower", tower(80, 1.2e6, 12.0), tower(40, 1e6, 4.0)),
        ("a stiff tower", tower(80, 1.2e6, 4.0), tower(3, 200e3, 0.2)),
        ("isolated, 2 s", isolated(2.0), tower(4, 300e3, 0.4)),
        ("isolated, 4 s", isolated(4.0), tower(4, 300e3, 0.4)),
        ("soft steel", tower(3, 150e3, 1.1), tower(10, 200e3, 2.8)),
        ("shear walls", tower(10, 500e3, 0.3), tower(5, 300e3, 0.3)),
        ("a cottage", tower(1, 60e3, 0.06), tower(5, 300e3, 0.5)),
        ("a wall, heavy", "mass = [1e9]\nstiffness = [1e16]\n".into(), tower(5, 300e3, 0.5)),
        ("a wall, stiff", "mass = [1e6]\nstiffness = [1e12]\n".into(), tower(4, 320e3, 2.0)),
        (
            "a wall of three floors",
            "mass = [1e9, 1e9, 1e9]\nstiffness = [1e15, 1e15, 1e15]\n".into(),
            tower(3, 300e3, 0.3),
        ),
        ("a light roof", "mass = [300e3, 300e3, 20e3]\nstiffness = [4e8, 4e8, 2e7]\n".into(), tower(3, 300e3, 0.3)),
        ("a soft storey", "mass = [300e3, 300e3, 300e3]\nstiffness = [1e8, 5e8, 5e8]\n".into(), tower(3, 300e3, 0.3)),
        ("a house beside a tower", tower(2, 80e3, 0.2), tower(50, 2e6, 5.0)),
        ("single masses", tower(1, 500e3, 1.2), tower(1, 800e3, 0.6)),
    ] {
        for contact in [HERTZ, LINEAR, RIGID] {
            let found = found(&pair(&left, &right, contact), None);
            assert!(found.is_empty(), "{what}, {contact}: {found:?}");
        }
    }
}

#[test]
fn unusual_numbers_are_sound() {
    for (scene, from, to) in [
        (FEUP, "gap = 0.005", "gap = 0.0"),
        (FEUP, "gap = 0.005", "gap = -0.0001"),
        (OFFICES, "gap = 0.03\n", "gap = -0.0001\n"),
        (OFFICES, "gap = 0.03\n", "gap = 0.3\n"),
        (OFFICES, "pga = 3.43 ", "pga = 1.0 "),
        (OFFICES, "pga = 3.43 ", "pga = 10.0 "),
        (OFFICES, "pga = 3.43 ", "scale = -1.0 "),
        (OFFICES, "stiffness = 2.75e9", "stiffness = 5.5e8"),
        (OFFICES, "stiffness = 2.75e9", "stiffness = 1.4e10"),
        (FEUP, "stiffness = 1.0e6", "stiffness = 1.0e7"),
        (FEUP, "stiffness = 1.0e6", "stiffness = 1.0e5"),
        (FEUP, "restitution = 0.65", "restitution = 1.0"),
        (FEUP, "ratio = 0.01", "ratio = 0.0"),
        (FEUP, "ratio = 0.01", "ratio = 0.25"),
        (FEUP, "stop_time = 20.0", "stop_time = 3.0"),
        (FEUP, "stop_time = 20.0", "stop_time = 5.0"),
        (FEUP, "stop_time = 20.0", "stop_time = 120.0"),
        (FEUP, "stop_time = 20.0", "stop_time = 300.0"),
        (FEUP, "mass = [3.65, 3.65]\n", "mass = [3.65, 3.65]\ninitial_velocity = [0.5, 0.5]\n"),
        (FEUP, "mass = [3.65, 3.65]\n", "mass = [3.65, 3.65]\ninitial_displacement = [-0.01, -0.02]\n"),
    ] {
        let found = found(&edited(scene, &[(from, to)]), None);
        assert!(found.is_empty(), "{to}: {found:?}");
    }
    // A sine that a user has made, a pulse drawn by hand, a record in the time of a model of 1/10.
    let sine = |step: f64| {
        let times: Vec<f64> = (0..2000).map(|k| f64::from(k) * step).collect();
        Record::new(times.clone(), times.iter().map(|t| 2.0 * (12.0 * t).sin()).collect())
    };
    // A run that ends after the peak, a long swing after a pulse drawn by hand.
    let spike = changed(|t, a| (t, if (t - 0.5).abs() < 0.005 { 5.0 } else { a }));
    assert_eq!(found(&edited(FEUP, &[("stop_time = 20.0", "stop_time = 2.0")]), Some(&spike)), []);
    let short = Record::new(vec![0.0, 0.2, 0.4], vec![0.0, 3.0, 0.0]);
    assert_eq!(found(&edited(FEUP, &[("stop_time = 20.0", "stop_time = 200.0")]), Some(&short)), []);
    let pulse = Record::new(vec![0.0, 0.2, 0.4, 10.0], vec![0.0, 3.0, 0.0, 0.0]);
    for record in [sine(0.01), sine(0.002), pulse, changed(|t, a| (t / 10_f64.sqrt(), a))] {
        let found = found(FEUP, Some(&record));
        assert!(found.is_empty(), "{found:?}");
    }
}
