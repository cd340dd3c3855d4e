//! `units = "kN-t"`: the same scene in t and kN gives the same doubles, the same variables and the same run.

use super::{SHORT, edited, messages};
use crate::two_and_three_storeys::{RECORD_SCENE, RICH, SCENE as DRIVEN};
use pounding::contact::LawKind;
use pounding::engine::{BuildingId, Episode, Model, Output, Point};
use pounding::scene::{Package, PackagedRecord, Scene, Units, law_key};
use pounding::variables::{Parameter, Settings, Value};
use proptest::prelude::*;

/// A decimal number with its point moved to the left by three digits.
fn thousandth(number: &str) -> String {
    let (digits, exponent) = number.split_once('e').unwrap_or((number, "0"));
    format!("{digits}e{}", exponent.parse::<i32>().unwrap() - 3)
}

/// A scene in t and kN: the values of the keys that have a mass or a force in their units, and no others.
fn in_kn_t(text: &str) -> String {
    let is_scaled = |key: &str| {
        let is_force = key.trim_end().ends_with("yield_force");
        is_force || key.trim_end().ends_with("mass") || key.contains("stiffness") || key.contains("matrix")
    };
    let line = |line: &str| {
        let Some((key, value)) = line.split_once('=').filter(|(key, value)| is_scaled(key) || value.contains("matrix"))
        else {
            return format!("{line}\n");
        };
        let (before, value) = value.split_at(value.rfind("matrix").map_or(0, |place| place + "matrix =".len()));
        let mut moved = String::new();
        for part in value.split_inclusive(['[', ']', ',', ' ']) {
            let number = part.trim_end_matches(['[', ']', ',', ' ']);
            let is_number = number.parse::<f64>().is_ok_and(f64::is_finite);
            moved += &if is_number { thousandth(number) } else { number.to_owned() };
            moved += &part[number.len()..];
        }
        format!("{key}={before}{moved}\n")
    };
    format!("units = \"kN-t\"\n{}", text.lines().map(line).collect::<String>())
}

/// Both texts, with all that is in SI units.
fn read_both(text: &str) -> [Scene; 2] {
    let thousandths = in_kn_t(text);
    let [si, mut kn_t] =
        [text, &thousandths].map(|text| Scene::from_toml(text).unwrap_or_else(|e| panic!("{e}\n{text}")));
    assert_eq!((si.units, kn_t.units), (Units::Si, Units::KilonewtonTonne));
    kn_t.units = Units::Si;
    [si, kn_t]
}

fn contact(law: LawKind) -> String {
    let keys = law.info().keys.iter().map(|&key| match law_key::number(key).name {
        "stiffness" => "stiffness = 1.23e6\n".to_owned(),
        "exponent" => "exponent = 1.4\n".to_owned(),
        name => format!("{name} = 0.65\n"),
    });
    let formula = if law.info().has_damping_formula { "damping_formula = \"exact\"\n" } else { "" };
    let head = format!("[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 0.001\nlaw = \"{}\"\n", law.info().name);
    head + &keys.collect::<String>() + formula
}

/// All numbers with a unit that changes are no multiples of 1000 in binary, and those of other units would show a factor.
fn frames(stiffness: &str, damping: &str, law: LawKind) -> String {
    format!(
        "name = \"Frames\"\nstop_time = 3.0\n[left]\nmass = [3.65, 4.1]\n{stiffness}\n{damping}\n\
         initial_velocity = [0.3, 0.5]\ninitial_displacement = [0.001, 0.002]\n[right]\nmass = [3.7]\n\
         stiffness = [2910.7]\ndamping = {{ ratio = 0.02 }}\n{}[outputs]\nenergy = true\n[solver]\n\
         min_approach_velocity = 1e-3\n",
        contact(law)
    )
}

const SHEAR: &str = "stiffness = [2910.3, 2.87e3]";
const MATRIX: &str = "stiffness_matrix = [[5820.1, -2910.3], [-2910.3, 2910.3]]";
const RATIO: &str = "damping = { ratio = 0.01 }";
const DASHPOTS: &str = "damping = { matrix = [[11.3, -5.1], [-5.1, 6.3]] }";

#[test]
fn every_number_is_the_same_double() {
    for &law in LawKind::ALL {
        for (stiffness, damping) in [(SHEAR, RATIO), (MATRIX, RATIO), (SHEAR, DASHPOTS), (MATRIX, DASHPOTS)] {
            let [si, kn_t] = read_both(&frames(stiffness, damping, law));
            assert_eq!(si.buildings[0].mass, kn_t.buildings[0].mass);
            assert_eq!(si.buildings[0].stiffness, kn_t.buildings[0].stiffness);
            assert_eq!(si.buildings[0].damping, kn_t.buildings[0].damping);
            assert_eq!(si.contacts, kn_t.contacts);
            assert_eq!(si, kn_t);
        }
    }
    for text in [DRIVEN, RICH, RECORD_SCENE, super::SCENE] {
        let [si, kn_t] = read_both(text);
        assert_eq!(si, kn_t);
    }
    let yielding =
        frames(&format!("{SHEAR}\nyield_force = [13.7, inf]\npost_yield_ratio = 0.031"), RATIO, LawKind::Linear);
    let [si, kn_t] = read_both(&yielding);
    assert_eq!(si.buildings[0].yielding.as_ref().unwrap().force, [13.7, f64::INFINITY]);
    assert_eq!(si, kn_t);
}

#[test]
fn whole_numbers_of_any_base_are_numbers() {
    let masses = |text: &str| Scene::from_toml(&format!("units = \"kN-t\"\n{}", SHORT.replacen("[1]", text, 1)));
    for (text, kilograms) in
        [("[2]", 2000.0), ("[0x1F]", 31e3), ("[1_0]", 1e4), ("[1_0.5_0]", 10_500.0), ("[+2E-3]", 2.0)]
    {
        assert_eq!(masses(text).unwrap().buildings[0].mass, [kilograms], "{text}");
    }
}

proptest! {
    /// However many digits, and however large or small.
    #[test]
    fn the_same_digits_are_the_same_double(digits in 1_u64..=u64::MAX, point in -280_i32..280) {
        let mass = |units: &str, power: i32| {
            let mass = format!("[{digits}e{power}]");
            Scene::from_toml(&format!("units = \"{units}\"\n{}", SHORT.replacen("[1]", &mass, 1))).unwrap()
        };
        let [si, kn_t] = [mass("SI", point), mass("kN-t", point - 3)].map(|scene| scene.buildings[0].mass[0]);
        prop_assert_eq!(si.to_bits(), kn_t.to_bits());
        prop_assert_eq!(Units::Si.written(si).to_bits(), si.to_bits());
    }

    /// As many digits as every double keeps.
    #[test]
    fn what_is_shown_is_what_is_written(digits in 1_u64..1_000_000_000_000_000, point in -280_i32..280) {
        let number: f64 = format!("{digits}e{point}").parse().unwrap();
        let si: f64 = format!("{digits}e{}", point + 3).parse().unwrap();
        prop_assert_eq!(Units::KilonewtonTonne.written(si).to_bits(), number.to_bits());
    }
}

/// Whatever the model shows of a run.
fn run(scene: &Scene) -> Vec<u64> {
    let model = Model::new(scene, None).unwrap();
    let (mut state, mut point, mut seen) = (model.start(0.0), Point::default(), Vec::new());
    for k in 1..=30 {
        let mut end = |episode: &Episode| seen.push(episode.peak_force.to_bits());
        model.advance(&mut state, 0.1 * f64::from(k), &mut end).unwrap();
        let now = model.observe(&state, &mut point);
        for (side, floor) in [(BuildingId::LEFT, 0), (BuildingId::LEFT, 1)] {
            seen.push(now.read(Output::Displacement(side, floor)).to_bits());
        }
        let contact = now.contact(0);
        seen.extend([contact.force, contact.impulse, contact.dissipated_energy].map(f64::to_bits));
    }
    seen
}

#[test]
fn the_run_is_the_same() {
    for &law in LawKind::ALL {
        let [si, kn_t] = read_both(&frames(MATRIX, DASHPOTS, law));
        let [si, kn_t] = [&si, &kn_t].map(run);
        assert!(si.len() > 150, "there are impacts: {}", si.len());
        assert!(si == kn_t, "{}", law.info().name);
    }
}

/// Variables are in SI units, whatever those of the scene; the text in the FMU is as it was written.
#[test]
fn the_description_is_the_same() {
    let thousandths = in_kn_t(RICH);
    let [si, kn_t] = [RICH, &thousandths].map(|text| {
        let record = PackagedRecord::parse("motion.csv", b"time_s,accel_m_s2\n0,1\n1,2\n".to_vec()).unwrap();
        let package =
            Package { scene_text: text.to_owned(), scene: Scene::from_toml(text).unwrap(), record: Some(record) };
        package.model_description(pounding::FmiVersion::V2).replace(&package.guid(pounding::FmiVersion::V2), "GUID")
    });
    let other = si.lines().zip(kn_t.lines()).find(|(si, kn_t)| si != kn_t);
    assert_eq!((other, si.len()), (None, kn_t.len()));
    assert!(si.contains("\"GUID\""));
}

#[test]
fn problems_are_shown_in_the_units_of_the_scene() {
    let said = |from: &str, to: &str| messages(&format!("units = \"kN-t\"\n{}", edited(from, to)));
    for (from, to, expected) in [
        ("[3.0, 4.0]", "[3.0, -0.00365]", "left.mass[2] = -0.00365: expected a finite mass > 0 t"),
        ("[3.0, 4.0]", "[3.0, inf]", "left.mass[2] = inf: expected a finite mass > 0 t"),
        ("mass = [3.0, 4.0]\n", "", "left.mass: expected a list of masses in t, one per floor (missing)"),
        (
            "[3.0, 4.0]",
            "[3.0, 2e305]",
            "left.mass[2] = 2e305: expected a number that double precision holds, up to 1.8e305",
        ),
        ("[2910.0, 2920.0]", "[2910.0, -0.3]", "left.stiffness[2] = -0.3: expected a finite stiffness > 0 kN/m"),
        ("[2910.0, 2920.0]", "[2.91]", "left.stiffness = [2.91]: expected 2 numbers, one per storey, not 1"),
        (
            "stiffness = [2910.0, 2920.0]\n",
            "",
            "left.stiffness: expected a list in kN/m, one per storey, or stiffness_matrix (missing)",
        ),
        (
            "stiffness = [2910.0, 2920.0]",
            "stiffness_matrix = [[4.1, -1.3], [-1.2, 3]]",
            "left.stiffness_matrix[2][1] = -1.2: expected -1.3, as in [1][2]: a symmetric matrix",
        ),
        (
            "stiffness = [2910.0, 2920.0]",
            "stiffness_matrix = [[-4.1, 0], [0, 3]]",
            "left.stiffness_matrix = [[-4.1, 0.0], [0.0, 3.0]]: expected a positive definite matrix, but its eigenvalues go \
             from -4.1 to 3.0 kN/m",
        ),
        (
            "stiffness = [2910.0, 2920.0]",
            "stiffness_matrix = [[4.1, 0, 1], [0, 3]]",
            "left.stiffness_matrix[1] = [4.1, 0.0, 1.0]: expected 2 numbers, one per floor, not 3",
        ),
        (
            "{ ratio = 0.01 }",
            "{ matrix = [[-4.1, 0], [0, 3]] }",
            "left.damping.matrix = [[-4.1, 0.0], [0.0, 3.0]]: expected a positive semidefinite matrix, but its eigenvalues \
             go from -4.1 to 3.0 kN s/m",
        ),
        (
            "stiffness = 1.0e6",
            "stiffness = -0.7",
            "contact[1].stiffness = -0.7: expected a finite stiffness > 0 kN/m^n",
        ),
        ("stiffness = 1.0e6\n", "", "contact[1].stiffness: expected a finite stiffness > 0 kN/m^n (missing)"),
        (
            "stiffness = [2910.0, 2920.0]",
            "stiffness = [2910.0, 2920.0]\nyield_force = [inf, -0.3]",
            "left.yield_force[2] = -0.3: expected a force > 0 kN, or inf for a storey that stays elastic",
        ),
        (
            "stiffness = [2910.0, 2920.0]",
            "stiffness = [2910.0, 2920.0]\nyield_force = [4.1]",
            "left.yield_force = [4.1]: expected 2 numbers, one per storey, not 1",
        ),
        // Neither a mass nor a force: as ever.
        (
            "stiffness = [2910.0, 2920.0]",
            "stiffness = [2910.0, 2920.0]\nyield_force = [4.1, inf]\npost_yield_ratio = 1.2",
            "left.post_yield_ratio = 1.2: expected 0 <= r < 1",
        ),
        ("gap = 0.002", "gap = inf", "contact[1].gap = inf: expected a finite distance in m"),
        ("restitution = 0.65", "restitution = 1.4", "contact[1].restitution = 1.4: expected 0 < e <= 1"),
    ] {
        assert_eq!(said(from, to), [expected], "{to}");
    }
}

#[test]
fn units_that_there_are_not() {
    let said = |units: &str| messages(&format!("units = {units}\n{SHORT}"));
    const TWO: &str =
        "expected SI (masses in kg, forces in N) or kN-t (masses in t, forces in kN); lengths are in m in both";
    for (units, meant) in [
        ("kn-t", "; did you mean kN-t?"),
        ("KN-T", "; did you mean kN-t?"),
        ("kN", "; did you mean kN-t?"),
        ("kN-m", "; did you mean kN-t?"),
        ("t-kN", "; did you mean kN-t?"),
        ("tonnes", "; did you mean kN-t?"),
        ("si", "; did you mean SI?"),
        ("kg-N", "; did you mean SI?"),
        ("mks", "; did you mean SI?"),
        ("kip-ft", ""),
        ("", ""),
    ] {
        assert_eq!(said(&format!("\"{units}\"")), [format!("units = \"{units}\": {TWO}{meant}")]);
    }
    assert_eq!(said("3"), ["units = 3: expected text in quotation marks"]);
    assert_eq!(said("\"SI\""), [""; 0]);
    // Nothing else is known to be wrong where the units are not known.
    let masses = messages(&format!("units = \"kn\"\n{}", SHORT.replacen("[1]", "[-1]", 1)));
    assert_eq!(masses.len(), 2, "{masses:?}");
    assert_eq!(masses[1], "left.mass[1] = -1.0: expected a finite mass > 0 kg");
    let slip = messages(&format!("unit = \"kN-t\"\n{SHORT}"));
    assert!(slip[0].ends_with("; did you mean units?"), "{slip:?}");
    for (mass, number) in [("3 t", "3"), ("3.5 kNs2/m", "3.5")] {
        let slip = messages(&edited("gap = 0.002", &format!("gap = {mass}")));
        let expected = format!(
            "a number alone, gap = {number}: units are fixed, see the documentation of the key; units = \
             \"kN-t\" at the top takes t and kN throughout"
        );
        assert!(slip[0].ends_with(&expected), "{slip:?}");
    }
}

/// Parameters are those of the FMU.
#[test]
fn parameters_are_in_si_units() {
    let scene = Scene::from_toml(&in_kn_t(DRIVEN)).unwrap();
    let mut settings = Settings::new(scene, None);
    assert_eq!(settings.read(Parameter::Mass(BuildingId::LEFT, 0)), Value::Real(3.65));
    settings.write(Parameter::Mass(BuildingId::LEFT, 0), Value::Real(-3.0)).unwrap();
    let error = settings.check().unwrap_err().to_string();
    assert_eq!(error, "left.mass[1] = -3.0: expected a finite mass > 0 kg");
    settings.write(Parameter::Mass(BuildingId::LEFT, 0), Value::Real(3.65e6)).unwrap();
    settings.check().unwrap();
    let warnings = settings.warnings();
    assert_eq!((warnings[0].path.as_str(), warnings[0].value.as_str()), ("left.mass[1]", "3.65e6"));
}
