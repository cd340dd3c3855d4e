//! Forged states of dampers that slip are refused, and those of other links; a point reads several models.

use super::devices::{between, linked, of_link, shaken, slipping, to_wall};
use crate::common::{Run, record};
use pounding::engine::{BuildingId, LinkOutput, Output, Point, SavedState};
use pounding::record::Record;
use pounding::scene::Scene;

/// 4 s at 64 Hz that begin with 0.
fn shaking() -> Record {
    let t = |k: i32| f64::from(k) / 64.0;
    record(1.0 / 64.0, &(0..=256).map(|k| 4.0 * (9.0 * t(k)).sin() + 2.0 * (31.0 * t(k)).sin()).collect::<Vec<_>>())
}

/// A friction damper, and a device to the ground that yields.
fn scene(law: &str) -> Scene {
    let text = format!(
        "[left]\nmass = [4e4, 3e4]\nstiffness = [3e7, 2e7]\ndamping = {{ ratio = 0.03 }}\n\
         [right]\nmass = [3e4, 2e4]\nstiffness = [5e7, 3e7]\ndamping = {{ ratio = 0.05 }}\n\
         [[contact]]\nleft_floor = 2\nright_floor = 2\ngap = 0.008\n{law}\n"
    );
    let damper = slipping(between(2, 2, 3e7, 0.0), 4e4, 0.0);
    linked(&text, &[damper, slipping(to_wall(BuildingId::LEFT, 1, 1e7, 1e5), 3e4, 0.1)])
}

const LAWS: [&str; 2] =
    ["law = \"kelvin_voigt\"\nstiffness = 2e8\nrestitution = 0.65", "law = \"stereomechanical\"\nrestitution = 0.6"];

/// The state with a value changed, as its bytes tell it: at the first place where its eight bytes are.
fn forged(saved: &SavedState, value: f64, other: f64) -> Option<SavedState> {
    let mut bytes = postcard::to_allocvec(saved).unwrap();
    let place = bytes.windows(8).position(|part| part == value.to_le_bytes())?;
    bytes[place..place + 8].copy_from_slice(&other.to_le_bytes());
    Some(postcard::from_bytes(&bytes).unwrap())
}

#[track_caller]
fn assert_refused(run: &Run, saved: &SavedState, what: &str) {
    let Err(error) = run.model.check_saved(saved) else { panic!("{what} at {} s is taken", saved.time()) };
    println!("{what}: {error}");
}

/// A damper that would be beyond its slip force, or slip without being at it; one whose way is negative. A slip
/// moves the rest of all floors too, which takes a share of it from what stretches the spring. A state is that of the
/// start of a step, in which the slip may have been another.
#[test]
fn forged_slips_are_refused() {
    for law in LAWS {
        let mut run = shaken(scene(law), &shaking());
        let (mut tried, mut while_slipping) = (0, 0);
        for k in 50..200 {
            run.to(0.02 * f64::from(k));
            let saved = run.save();
            for (link, limit) in [4e4 / 3e7, 3e4 / 1e7].into_iter().enumerate() {
                let [slip, travel, sense] =
                    [LinkOutput::Slip, LinkOutput::SlipTravel, LinkOutput::Slipping].map(|of| of_link(&run, link, of));
                let moved = [20.0, -20.0, 1e300, f64::NAN].map(|by| (slip, slip + by * limit));
                let nudged = [1e-6, -1e-6].map(|by| (slip, slip + by * limit)).into_iter().filter(|_| sense != 0.0);
                let changes = moved.into_iter().chain(nudged).chain([(travel, -travel), (travel, f64::INFINITY)]);
                for (value, other) in changes.filter(|(value, _)| *value != 0.0) {
                    let Some(state) = forged(&saved, value, other) else { continue };
                    assert_refused(&run, &state, &format!("{law}: link {link}, {value:e} as {other:e}"));
                    tried += 1;
                    while_slipping += i32::from(sense != 0.0);
                }
            }
        }
        assert!(tried > 500 && while_slipping > 20, "{law}: {tried} tried, {while_slipping} of them while slipping");
    }
}

/// A state of the same buildings with other links.
#[test]
fn states_of_other_links_are_refused() {
    let mut run = shaken(scene(LAWS[0]), &shaking());
    let saved = run.to(1.0).save();
    let mut fewer = scene(LAWS[0]);
    fewer.links.pop();
    let mut rigid = scene(LAWS[0]);
    rigid.links[0].slip = None;
    let mut more = scene(LAWS[0]);
    more.links.push(between(1, 1, 1e6, 0.0));
    let mut none = scene(LAWS[0]);
    none.links.clear();
    for (scene, what) in [(fewer, "fewer"), (rigid, "one that does not slip"), (more, "more"), (none, "none")] {
        assert_refused(&shaken(scene, &shaking()), &saved, what);
    }
    run.model.check_saved(&saved).unwrap();
}

/// A state of oscillators is refused where damping couples no modes, so that none move.
#[test]
fn oscillators_that_a_scene_does_not_have_are_refused() {
    let (law, free) =
        ("law = \"linear\"\nstiffness = 1e7", "mass = [4e4]\nstiffness = [3e7]\ndamping = { ratio = 0.03 }");
    let buildings =
        format!("[left]\n{free}\n[right]\n{free}\n[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 1.0\n{law}\n");
    for (links, is_taken) in [(vec![between(1, 1, 0.0, 1e5)], true), (vec![], false)] {
        let mut run = shaken(linked(&buildings, &links), &shaking());
        run.to(1.0);
        let mut told = serde_json::to_value(run.save()).unwrap();
        told["base"]["oscillates"] = true.into();
        let forged: SavedState = serde_json::from_value(told).unwrap();
        assert_eq!(run.model.check_saved(&forged).is_ok(), is_taken, "{links:?}");
    }
}

/// What a point has worked out for one model is nothing to another of the same size.
#[test]
fn a_point_reads_one_model_after_another() {
    let buildings = "[left]\nmass = [4e4]\nstiffness = [3e7]\ndamping = { ratio = 0.03 }\n\
                     [right]\nmass = [3e4]\nstiffness = [5e7]\ndamping = { ratio = 0.05 }\n";
    let scenes =
        [vec![], vec![between(1, 1, 1e6, 1e5)], vec![between(1, 1, 1e6, 1e5), to_wall(BuildingId::LEFT, 1, 0.0, 2e5)]];
    let mut runs = scenes.map(|links| shaken(linked(buildings, &links), &shaking()));
    let mut point = Point::default();
    for (links, run) in runs.iter_mut().enumerate() {
        // Within a sample, so that the work since its start is read.
        run.to(1.01);
        let own = run.model.observe(&run.state, &mut point);
        let read: Vec<f64> =
            (0..links).map(|link| own.read(Output::Link(link, LinkOutput::DissipatedEnergy))).collect();
        let expected: Vec<f64> = (0..links).map(|link| of_link(run, link, LinkOutput::DissipatedEnergy)).collect();
        assert!(read == expected && read.iter().all(|energy| *energy > 0.0), "{read:?} instead of {expected:?}");
    }
}
