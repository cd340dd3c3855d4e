//! Floors of different buildings that touch and move alike, or nearly: what lies between them is rounding for a while, and
//! rounding must neither bring them together and apart for ever nor end a contact that has begun.

use crate::common::{Run, record, scene};
use pounding::engine::BuildingId;

/// A frame of equal storeys without damping.
fn frame(storeys: usize, mass: f64, stiffness: f64) -> String {
    format!("mass = {:?}\nstiffness = {:?}\ndamping = {{ ratio = 0.0 }}", vec![mass; storeys], vec![stiffness; storeys])
}

fn contact(floor: usize, law: &str) -> String {
    format!("[[contact]]\nleft_floor = {floor}\nright_floor = {floor}\ngap = 0.0\n{law}\n")
}

/// From rest under a constant ground acceleration a all floors fall back alike, -a t^2/2, until they feel the storeys below:
/// floor n by a share of (k/m)^n t^(2n), more in the stiffer building, which stands on the left and so presses each pair
/// together, once.
#[test]
fn touching_frames_that_start_from_rest_meet_once() {
    let laws = [
        "law = \"jankowski\"\nstiffness = 1.0e10\nrestitution = 0.65",
        "law = \"kelvin_voigt_no_tension\"\nstiffness = 1.0e8\nrestitution = 0.65",
        "law = \"hertz_damped\"\nstiffness = 1.0e10\nrestitution = 0.65\ndamping_formula = \"exact\"",
        "law = \"hertz\"\nstiffness = 1.0e10",
    ];
    for (law, floors) in laws.into_iter().flat_map(|law| [[1, 3], [2, 4], [3, 4]].map(|floors| (law, floors))) {
        let contacts = floors.map(|floor| contact(floor, law)).concat();
        let text = format!(
            "name = \"Alike\"\n[left]\n{}\n[right]\n{}\n[ground]\nrecord = \"constant.csv\"\n{contacts}",
            frame(4, 2e4, 2e8),
            frame(13, 4e4, 5e7)
        );
        let mut run = Run::new(&scene(&text), Some(&record(1.0, &[0.25, 0.25])));
        run.to(0.02);
        let what = format!("{law}, floors {floors:?}");
        assert_eq!(run.point.impacts, 2, "{what}");
        assert!((0..2).all(|p| run.contact(p).active), "{what}");
        assert!(run.state.counters().contact_steps() < 200, "{what}: {:?}", run.state.counters());
    }
}

/// The same of single masses under an acceleration that rises from 0, at tolerances that leave more open than there is of
/// the penetration at first.
#[test]
fn a_contact_that_begins_below_the_tolerance_does_not_end_there() {
    for tolerance in [1e-4, 1e-5, 1e-6, 1e-7, 1e-9, 1e-12] {
        let text = format!(
            "name = \"Alike\"\n[left]\n{}\n[right]\nmass = [7.0e5]\nstiffness = [6.0e7]\ndamping = {{ matrix = [[87420.13513745305]] }}\n[ground]\nrecord = \"ramp.csv\"\n{}\n[solver]\nrelative_tolerance = {tolerance:?}",
            frame(1, 8e5, 2e9),
            contact(1, "law = \"jankowski\"\nstiffness = 7849739790623.42\nrestitution = 0.95")
        );
        let mut run = Run::new(&scene(&text), Some(&record(0.0526, &[0.0, 0.69])));
        run.to(0.01);
        assert_eq!(run.point.impacts, 1, "{tolerance:e}");
        assert!(run.contact(0).active, "{tolerance:e}");
    }
}

/// Frames that are alike to twelve digits meet or not as rounding has it; what they do to each other is rounding too.
#[test]
fn frames_that_are_nearly_alike_do_not_disturb_each_other() {
    let (mass, stiffness) = (43968.436497984054, [73206672.42140679; 3]);
    let other = [73206672.42137246, 73206672.42144398, 73206672.42147233];
    let frame = |stiffness: [f64; 3]| {
        format!("mass = [{mass:?}, {mass:?}, {mass:?}]\nstiffness = {stiffness:?}\ndamping = {{ ratio = 0.02 }}")
    };
    let run = |contact: &str| {
        let text = format!(
            "name = \"Alike\"\n[left]\n{}\n[right]\n{}\n[ground]\nrecord = \"ramp.csv\"\n{contact}\n[solver]\nrelative_tolerance = 1e-11",
            frame(stiffness),
            frame(other)
        );
        let mut run = Run::new(&scene(&text), Some(&record(0.05, &[0.0, 0.18])));
        run.to(0.05);
        run
    };
    let (touching, apart) = (run(&contact(1, "law = \"linear\"\nstiffness = 1.2e12")), run(""));
    assert!(touching.point.impacts < 1000, "{} impacts", touching.point.impacts);
    let size = apart.displacement(BuildingId::LEFT, 2).abs();
    for (side, floor) in
        [BuildingId::LEFT, BuildingId::RIGHT].into_iter().flat_map(|side| [0, 1, 2].map(|floor| (side, floor)))
    {
        let error = touching.displacement(side, floor) - apart.displacement(side, floor);
        assert!(error.abs() < 1e-11 * size, "{side:?} {floor}: {error:e} of {size:e}");
    }
}

/// What rounding leaves between floors that start at the same place is no overlap.
#[test]
fn frames_that_are_alike_do_not_meet() {
    for law in ["law = \"hertz\"\nstiffness = 1.0e10", "law = \"linear\"\nstiffness = 1.0e10"] {
        let frame = format!("{}\ninitial_displacement = [0.013, 0.017]", frame(2, 4e4, 7e7));
        let contacts = [1, 2].map(|floor| contact(floor, law)).concat();
        let mut run =
            Run::new(&scene(&format!("name = \"Alike\"\n[left]\n{frame}\n[right]\n{frame}\n{contacts}")), None);
        run.in_steps(0.01, 1.0);
        assert_eq!(run.point.impacts, 0, "{law}");
    }
}
