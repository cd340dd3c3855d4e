//! What a user may write.

use super::{SCENE, SHORT, edited, messages};
use pounding::contact::{DampingFormula, ImpactLaw, LawKind};
use pounding::record::Record;
use pounding::scene::{Damping, Scaling, Scene, Stiffness};

#[test]
fn every_key_arrives() {
    let scene = Scene::from_toml(SCENE).unwrap();
    assert_eq!(scene.name, "TwoFrames");
    assert_eq!(scene.description, "a test");
    assert_eq!(scene.stop_time, Some(20.0));
    assert_eq!(scene.buildings[0].mass, [3.0, 4.0]);
    assert_eq!(scene.buildings[0].stiffness, Stiffness::Shear(vec![2910.0, 2920.0]));
    assert_eq!(scene.buildings[0].damping, Damping::Ratio(0.01));
    assert_eq!(scene.buildings[0].initial_displacement, [0.0, 0.0]);
    assert_eq!(scene.buildings[0].initial_velocity, [0.0, 0.0]);
    assert_eq!(scene.buildings[1].damping, Damping::Rayleigh { ratio: 0.05, modes: [1, 3] });
    assert_eq!(scene.buildings[1].initial_displacement, [0.0, 0.001, 0.002]);
    assert_eq!(scene.buildings[1].initial_velocity, [0.0, 0.1, 0.2]);
    assert_eq!(scene.ground.record, None);
    assert!(scene.floor_forces && scene.energy);
    let [first, second] = scene.contacts.as_slice() else { panic!("two contacts") };
    assert_eq!((first.floors(), first.gap), (Some([1, 1]), 0.002));
    let mut law = ImpactLaw::new(LawKind::KelvinVoigt);
    (law.stiffness, law.exponent, law.restitution, law.damping_formula) = (1e6, 1.0, 0.65, None);
    assert_eq!(first.law, law);
    assert_eq!((second.floors(), second.gap), (Some([2, 2]), -0.001));
    let mut law = ImpactLaw::new(LawKind::Hertz);
    (law.stiffness, law.exponent, law.restitution, law.damping_formula) = (2e6, 1.5, 1.0, None);
    assert_eq!(second.law, law);
    assert_eq!((scene.solver.relative_tolerance, scene.solver.min_approach_velocity), (1e-10, 1e-3));
    assert_eq!(scene.check(), Ok(()));
}

#[test]
fn every_law_of_the_catalogue_is_read_with_its_keys() {
    for &kind in LawKind::ALL {
        let mut table = format!("law = \"{}\"\n", kind.info().name);
        for &key in kind.info().keys {
            // 1 is allowed for each of them, and is not the default of `exponent`.
            table += &format!("{} = 1.0\n", pounding::scene::law_key::number(key).name);
        }
        let damping_formula = kind.info().has_damping_formula.then_some(DampingFormula::HuGuo);
        if damping_formula.is_some() {
            table += "damping_formula = \"hu_guo\"\n";
        }
        let text = format!("{SHORT}\n[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 0.1\n{table}");
        let law = Scene::from_toml(&text).unwrap().contacts[0].law;
        assert_eq!((law.kind, law.damping_formula), (kind, damping_formula));
        assert_eq!((law.stiffness, law.exponent, law.restitution), (1.0, 1.0, 1.0));
    }
}

#[test]
fn every_damping_formula_is_read_by_its_name() {
    for &formula in DampingFormula::ALL {
        let text = format!(
            "{SHORT}\n[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 0.1\nlaw = \"hertz_damped\"\n\
             stiffness = 1.0\nrestitution = 0.5\ndamping_formula = \"{}\"\n",
            formula.info().name
        );
        let law = Scene::from_toml(&text).unwrap().contacts[0].law;
        assert_eq!((law.damping_formula, law.exponent), (Some(formula), 1.5));
    }
}

#[test]
fn what_is_left_out_has_its_default_and_whole_numbers_are_numbers() {
    let scene = Scene::from_toml(SHORT).unwrap();
    assert_eq!((scene.description.as_str(), scene.stop_time), ("", None));
    assert_eq!(
        (scene.buildings[0].mass.as_slice(), &scene.buildings[0].stiffness),
        ([1.0].as_slice(), &Stiffness::Shear(vec![2.0]))
    );
    assert_eq!((scene.ground.record, scene.ground.scaling), (None, Scaling::Scale(1.0)));
    assert!(!scene.floor_forces && !scene.restoring_corrections && !scene.energy && scene.contacts.is_empty());
    let corrected = Scene::from_toml(&format!("{SHORT}\n[inputs]\nrestoring_corrections = true\n")).unwrap();
    assert!(corrected.restoring_corrections && !corrected.floor_forces);
    assert!(scene.peaks && !scene.numbers_only);
    let other = Scene::from_toml(&format!("{SHORT}\n[outputs]\npeaks = false\nnumbers_only = true\n")).unwrap();
    assert!(!other.peaks && other.numbers_only && !other.energy);
    assert_eq!((scene.solver.relative_tolerance, scene.solver.min_approach_velocity), (1e-12, 1e-4));
    let hexadecimal = Scene::from_toml(&SHORT.replacen("[1]", "[0x1F]", 1)).unwrap();
    assert_eq!(hexadecimal.buildings[0].mass, [31.0]);
}

#[test]
fn every_form_of_stiffness_damping_and_ground() {
    let matrix = vec![vec![4.0, -1.0], vec![-1.0, 3.0]];
    let scene = Scene::from_toml(&edited("stiffness = [2910.0, 2920.0]", "stiffness_matrix = [[4, -1], [-1, 3]]"));
    assert_eq!(scene.unwrap().buildings[0].stiffness, Stiffness::Matrix(matrix.clone()));
    let damping =
        |form: &str| Scene::from_toml(&edited("{ ratio = 0.01 }", form)).unwrap().buildings[0].damping.clone();
    assert_eq!(damping("{ ratios = [0.0, 0.02] }"), Damping::Ratios(vec![0.0, 0.02]));
    let rayleigh = Damping::Rayleigh { ratio: 0.05, modes: [2, 1] };
    assert_eq!(damping("{ rayleigh = { ratio = 0.05, modes = [2, 1] } }"), rayleigh);
    assert_eq!(damping("{ matrix = [[4, -1], [-1, 3]] }"), Damping::Matrix(matrix));
    // Singular, not classical, and no damping at all: semidefinite is enough.
    assert_eq!(damping("{ matrix = [[1, -1], [-1, 1]] }"), Damping::Matrix(vec![vec![1.0, -1.0], vec![-1.0, 1.0]]));
    assert_eq!(damping("{ matrix = [[0, 0], [0, 0]] }"), Damping::Matrix(vec![vec![0.0; 2]; 2]));
    let ground = |table: &str| Scene::from_toml(&format!("{SHORT}\n[ground]\n{table}")).unwrap().ground;
    assert_eq!(ground("record = \"a.AT2\"").record.as_deref(), Some("a.AT2"));
    assert_eq!(ground("record = \"a.csv\"\nscale = -2").scaling, Scaling::Scale(-2.0));
    assert_eq!(ground("record = \"a.csv\"\npga = 4.903325").scaling, Scaling::Pga(4.903325));
    assert_eq!(ground("").record, None);
}

#[test]
fn the_edges_of_every_range_are_allowed() {
    for (from, to) in [
        ("restitution = 0.65", "restitution = 1"),
        ("stiffness = 2.0e6", "stiffness = 2.0e6\nexponent = 1"),
        ("stiffness = 2.0e6", "stiffness = 2.0e6\nexponent = 3.0"),
        ("gap = 0.002", "gap = 0"),
        ("relative_tolerance = 1e-10", "relative_tolerance = 1e-2"),
        ("relative_tolerance = 1e-10", "relative_tolerance = 1.1e-15"),
        ("\"TwoFrames\"", "\"_2\""),
        ("\"TwoFrames\"", "\"Int\""),
        ("\"a test\"", "\"\"\"two\nlines\"\"\""),
        // The same floor may face two others.
        ("left_floor = 2\nright_floor = 2", "left_floor = 2\nright_floor = 3"),
        // Printed with rounding errors; as soft as can be told from rounding errors.
        ("stiffness = [2910.0, 2920.0]", "stiffness_matrix = [[3.0, -1.0000000000001], [-1.0, 3.0]]"),
        ("stiffness = [2910.0, 2920.0]", "stiffness_matrix = [[1.0, 0.0], [0.0, 2e-12]]"),
        ("stiffness = [2910.0, 2920.0]", "stiffness_matrix = [[2e300, 1e300], [1e300, 2e300]]"),
    ] {
        assert_eq!(messages(&edited(from, to)), Vec::<String>::new(), "{to}");
    }
    assert_eq!(messages(&format!("\u{feff}{}", SCENE.replace('\n', "\r\n"))), Vec::<String>::new());
}

#[test]
fn scaling_gives_one_factor() {
    let record = Record::new(vec![0.0, 1.0, 2.0], vec![1.0, -4.0, 2.0]);
    assert_eq!(Scaling::Scale(-2.5).factor(&record), Ok(-2.5));
    assert_eq!(Scaling::Pga(1.0).factor(&record), Ok(0.25));
    let flat = Record::new(vec![0.0, 1.0], vec![0.0, 0.0]);
    assert_eq!(Scaling::Scale(2.0).factor(&flat), Ok(2.0));
    let refused = |scaling: Scaling, record| scaling.factor(record).unwrap_err().to_string();
    let expected = "ground.pga = 3.0: expected a record with a peak, but all its accelerations are 0";
    assert_eq!(refused(Scaling::Pga(3.0), &flat), expected);
    let expected = "expected accelerations up to 1e6 m/s2 from a record with a peak of 4.0 m/s2";
    for scale in [1e308, -1e308, 250_001.0] {
        assert_eq!(refused(Scaling::Scale(scale), &record), format!("ground.scale = {scale:?}: {expected}"));
    }
    assert_eq!(refused(Scaling::Pga(1.1e6), &record), format!("ground.pga = 1100000.0: {expected}"));
    assert_eq!(Scaling::Scale(-250_000.0).factor(&record), Ok(-250_000.0));
}
