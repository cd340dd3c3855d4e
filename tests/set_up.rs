//! What a scene does not need is not prepared for it: shown by the tables of windows that the process has computed.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::{Run, record, scene};
use pounding::engine::window_tables;
use pounding::record::Record;
use pounding::scene::Scene;

/// Two frames whose first floors face each other, 10 mm apart, under a ground motion that makes them meet.
fn frames(floors: [usize; 2], damping: &str, law: &str) -> (Scene, Record) {
    let frame = |floors: usize, stiffness: f64| {
        format!("mass = {:?}\nstiffness = {:?}\ndamping = {damping}", vec![3.65; floors], vec![stiffness; floors])
    };
    let mut scene = scene(&format!(
        "name = \"S\"\n[left]\n{}\n[right]\n{}\n[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 0.01\nlaw = {law}",
        frame(floors[0], 2910.0),
        frame(floors[1], 4400.0)
    ));
    scene.ground.record = Some("r.csv".into());
    (scene, record(0.02, &(0..500).map(|k| 6.0 * (f64::from(k) * 0.17).sin()).collect::<Vec<_>>()))
}

/// Number of tables after the model has been made and after it has run.
fn tables(floors: [usize; 2], damping: &str, law: &str) -> [usize; 2] {
    let (scene, record) = frames(floors, damping, law);
    let mut run = Run::new(&scene, Some(&record));
    let prepared = window_tables();
    assert!(run.to(10.0).point.impacts > 1, "{law} on {floors:?} storeys: {} impacts", run.point.impacts);
    [prepared, window_tables()]
}

/// One after the other, as the tables are kept for all models of the process.
#[test]
fn a_model_prepares_the_tables_of_its_windows_and_no_others() {
    let classical = "{ ratio = 0.01 }";
    let coupled = "{ matrix = [[0.8, -0.2], [-0.2, 0.5]] }";
    let hertz = "\"hertz\"\nstiffness = 1.0e7";
    for (floors, damping, law) in [
        // Contacts on floors.
        ([20, 30], "{ rayleigh = { ratio = 0.01, modes = [1, 3] } }", hertz),
        // Modes that damping couples.
        ([2, 2], coupled, hertz),
        // Forces that are no powers of a square root.
        ([2, 3], classical, "\"linear\"\nstiffness = 1.0e6"),
        ([2, 3], classical, "\"stereomechanical\"\nrestitution = 0.6"),
        ([2, 3], classical, "\"hertz\"\nstiffness = 1.0e7\nexponent = 1.7"),
    ] {
        assert_eq!(tables(floors, damping, law), [0, 0], "{law} on {floors:?} storeys with damping {damping}");
    }
    // Three rules with four maps, then also those of fourth roots.
    for (law, expected) in [
        (hertz, 12),
        ("\"hertz_damped\"\nstiffness = 1.0e7\nrestitution = 0.6\ndamping_formula = \"lankarani_nikravesh\"", 12),
        ("\"jankowski\"\nstiffness = 1.0e7\nrestitution = 0.6", 18),
        (hertz, 18),
    ] {
        assert_eq!(tables([2, 3], classical, law), [expected; 2], "{law}");
    }
}
