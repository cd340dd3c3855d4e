//! What begins, or does not, while another pair is in contact; each with an answer in closed form.

use crate::common::{Run, record, scene};
use pounding::engine::BuildingId;
use pounding::scene::Scene;

/// Two floors a side on springs so soft that they are free; the left floors move, the right ones are at rest.
fn two_free_floors(gaps: [f64; 2], laws: [&str; 2]) -> Scene {
    let building = |mass: f64, speed: f64| {
        format!(
            "mass = [{mass:?}, {mass:?}]\nstiffness = [1.0e-20, 1.0e-20]\ndamping = {{ ratio = 0.0 }}
            initial_velocity = [{speed:?}, {speed:?}]"
        )
    };
    let contact = |floor: usize, gap: f64, law: &str| {
        format!("[[contact]]\nleft_floor = {floor}\nright_floor = {floor}\ngap = {gap:?}\n{law}")
    };
    scene(&format!(
        "name = \"Free\"\n[left]\n{}\n[right]\n{}\n{}\n{}\n[outputs]\nenergy = true",
        building(5.0e4, 0.5),
        building(7.5e4, 0.0),
        contact(1, gaps[0], laws[0]),
        contact(2, gaps[1], laws[1])
    ))
}

#[test]
fn an_entry_is_seen_however_soon_after_another() {
    // The first step of an episode is short, but the unit of time of its series is not known yet and far too long.
    let linear = "law = \"linear\"\nstiffness = 3.0e11";
    let rigid = "law = \"stereomechanical\"\nrestitution = 0.5";
    for laws in [[linear, linear], [linear, rigid], [rigid, linear], [rigid, rigid]] {
        for later in [1e-9, 1e-7, 1e-5, 1e-3] {
            let mut run = Run::new(&two_free_floors([0.001, 0.001 + later], laws), None);
            run.to(0.5);
            let start = |p: usize| run.episodes.iter().find(|e| e.contact == p).unwrap().start;
            // The penetration is the difference of positions of 0.001 m, rounded to their last digit.
            assert!((start(0) - 0.002).abs() < 1e-17, "{} first", start(0));
            let error = (start(1) - (0.002 + 2.0 * later)).abs();
            assert!(error < 4e-18, "{} instead of {}: {error:e}, {laws:?}", start(1), 0.002 + 2.0 * later);
            assert!(run.energy().residual.abs() < 1e-14, "{:?}", run.energy());
        }
    }
}

/// A floor's ripple of some picometres while another floor's contact goes on: a step of that contact lasts about as long
/// as a swing of the ripple, which is at the bottom at the ends of the step and touches in between. Its amplitude is what
/// the tolerance leaves to a step of that length.
///
/// `left`, `right`: masses and stiffnesses of the buildings, whose floor `upper` is in the contact `closed` from the start,
/// and whose floor 1 swings.
fn ripple((left, right): (&str, &str), (upper, closed): (usize, &str), amplitude: f64, gap: f64) -> Scene {
    let at_rest = vec!["0.0"; upper - 1].join(", ");
    let above = vec!["0.0"; upper - 2].join(", ");
    scene(&format!(
        "name = \"Ripple\"
        [left]
        {left}
        damping = {{ ratio = 0.0 }}
        initial_displacement = [{:?}, {above}{} 0.0]
        initial_velocity = [{at_rest}, 100.0]
        [right]
        {right}
        damping = {{ ratio = 0.0 }}
        [[contact]]
        left_floor = {upper}
        right_floor = {upper}
        {closed}
        [[contact]]
        left_floor = 1
        right_floor = 1
        gap = {gap:?}
        law = \"linear\"
        stiffness = 1.0",
        -amplitude,
        if upper > 2 { "," } else { "" }
    ))
}

const SPRING: &str = "gap = -0.01\nlaw = \"linear\"\nstiffness = 200.0";

/// So deep that its series reaches far.
const POWER_LAW: &str = "gap = -10.0\nlaw = \"hertz\"\nexponent = 1.7\nstiffness = 1.0";

/// The touch of -amplitude cos(rate t) is found whatever the length of the step relative to the swing, from 0.8 of it to
/// the whole, and a miss is none.
#[track_caller]
fn assert_ripple_touches(scene_of: impl Fn(f64, f64, f64) -> Scene) {
    let speeds = (0..8).map(|k| 1e-9 / 2.0_f64.powi(k));
    for (rate, speed) in speeds.flat_map(|speed| (80..160).step_by(10).map(move |rate| (f64::from(rate), speed))) {
        let amplitude = speed / rate;
        let begin = |share: f64| {
            let mut run = Run::new(&scene_of(rate, amplitude, share * amplitude), None);
            run.to(0.1);
            assert!(run.contact(0).active, "the other contact goes on");
            (run.contact(1).impacts > 0).then(|| run.episodes.iter().find(|e| e.contact == 1).unwrap().start)
        };
        let (found, expected) = (begin(0.99), (-0.99_f64).acos() / rate);
        let what = format!("{speed:e} m/s, {rate}/s: {found:?} instead of {expected}");
        assert!(found.is_some_and(|found| (found - expected).abs() < 0.01 / rate), "{what}");
        assert_eq!(begin(1.01), None, "{speed:e} m/s, {rate}/s");
    }
}

#[test]
fn a_touch_in_the_middle_of_another_contacts_step_is_found() {
    // Beside a power law the pair that is apart shares the block of the other.
    for closed in [SPRING, POWER_LAW] {
        assert_ripple_touches(|rate, amplitude, gap| {
            let left = format!("mass = [1.0, 1.0]\nstiffness_matrix = [[{:?}, 0.0], [0.0, 1.0]]", rate * rate);
            let right = "mass = [1.0, 1.0]\nstiffness_matrix = [[1.0, 0.0], [0.0, 1.0]]";
            ripple((&left, right), (2, closed), amplitude, gap)
        });
    }
}

#[test]
fn a_touch_in_the_middle_of_another_contacts_step_is_found_floor_by_floor() {
    // Tall buildings whose storeys hold next to nothing but the ground floor's.
    let storeys = 12;
    let soft = vec!["1.0e-20"; storeys - 1].join(", ");
    let mass = vec!["1.0"; storeys].join(", ");
    assert_ripple_touches(|rate, amplitude, gap| {
        let left = format!("mass = [{mass}]\nstiffness = [{:?}, {soft}]", rate * rate);
        let right = format!("mass = [{mass}]\nstiffness = [1.0, {soft}]");
        ripple((&left, &right), (storeys, SPRING), amplitude, gap)
    });
}

/// Floors of buildings whose masses and stiffnesses have the same ratio move alike, and touch at rest; the sign of a
/// rounding error must not bring them into contact while others, here the top floors, are pressed together.
#[test]
fn floors_that_move_alike_do_not_meet_beside_another_contact() {
    for storeys in [2, 12] {
        let building = |factor: f64, speed: f64| {
            let mass = vec![format!("{factor:?}"); storeys].join(", ");
            let soft = ", 1.0e-20".repeat(storeys - 1);
            let rest = "0.0, ".repeat(storeys - 1);
            format!(
                "mass = [{mass}]\nstiffness = [{:?}{soft}]\ndamping = {{ ratio = 0.0 }}
                initial_velocity = [{rest}{speed:?}]",
                400.0 * factor
            )
        };
        let contact = |floor: usize, gap: f64| {
            format!(
                "[[contact]]\nleft_floor = {floor}\nright_floor = {floor}\ngap = {gap:?}\nlaw = \"linear\"\n\
                 stiffness = 100.0"
            )
        };
        let mut scene = scene(&format!(
            "name = \"Alike\"\n[left]\n{}\n[right]\n{}\n{}\n{}",
            building(1.0, 1.0),
            building(2.0, 0.0),
            contact(storeys, -0.01),
            contact(1, 0.0)
        ));
        scene.ground.record = Some("r.csv".into());
        let motion: Vec<f64> = (0..50).map(|k| (f64::from(k) * 0.31).sin()).collect();
        let mut run = Run::new(&scene, Some(&record(0.02, &motion)));
        run.in_steps(0.02, 0.2);
        assert!(run.contact(0).active, "the top floors are still pressed");
        assert!(run.displacement(BuildingId::LEFT, 0).abs() > 1e-3, "they move");
        assert_eq!(run.contact(1).impacts, 0, "{storeys} storeys");
    }
}

/// Floor 2 swings by 10 mm at 100 rad/s while floor 1 is in contact for 30 ms: it rises and falls again beyond a gap of
/// 9.5 mm, above the chord between any two points at which it is apart.
#[test]
fn a_swing_beyond_the_gap_is_found_beside_a_contact() {
    let far = "[[contact]]\nleft_floor = 1\nright_floor = 2\ngap = 1.0\nlaw = \"stereomechanical\"\nrestitution = 0.5";
    let swing = |law: &str, before: &str| {
        let mut run = Run::new(
            &scene(&format!(
                "name = \"Swing\"
                [left]
                mass = [1000.0, 1000.0]
                stiffness_matrix = [[1.0, 0.0], [0.0, 1.0e7]]
                damping = {{ ratio = 0.0 }}
                initial_velocity = [0.5, 1.0]
                [right]
                mass = [1.0e6, 1.0e6]
                stiffness_matrix = [[1.0, 0.0], [0.0, 1.0]]
                damping = {{ ratio = 0.0 }}
                [[contact]]
                left_floor = 1
                right_floor = 1
                gap = 0.0
                law = \"hertz\"
                stiffness = 1.0e8
                {before}
                [[contact]]
                left_floor = 2
                right_floor = 2
                gap = 0.0095
                {law}"
            )),
            None,
        );
        run.to(0.02);
        let last = run.model.contacts() - 1;
        assert!(run.contact(0).active, "the other contact goes on");
        run.episodes.iter().find(|e| e.contact == last).copied().or_else(|| run.model.open_episode(&run.state, last))
    };
    for law in ["law = \"stereomechanical\"\nrestitution = 0.5", "law = \"hertz\"\nstiffness = 1.0e10"] {
        for before in ["", far] {
            let found = swing(law, before).map(|episode| episode.start);
            let expected = libm::asin(0.95) / 100.0;
            assert!(found.is_some_and(|found| (found - expected).abs() < 1e-12), "{law} {before}: {found:?}");
        }
    }
}

/// A mode that is not in the contact, so fast and so damped that it dies out within a window of it: each part of the
/// account is integrated to rounding.
#[test]
fn the_account_closes_beside_a_fast_damped_mode() {
    let laws = [
        "law = \"hertz\"\nstiffness = 1.0e7",
        "law = \"hertz_damped\"\nstiffness = 1.0e7\nrestitution = 0.6\ndamping_formula = \"exact\"",
        "law = \"jankowski\"\nstiffness = 1.0e7\nrestitution = 0.6",
    ];
    for law in laws {
        for (stiffness, ratio) in [1e9, 1e10, 1e11].into_iter().flat_map(|k| [0.05, 0.2].map(|ratio| (k, ratio))) {
            let scene = scene(&format!(
                "name = \"Fast\"
                [left]
                mass = [1000.0, 1000.0]
                stiffness_matrix = [[{stiffness:?}, 0.0], [0.0, 1.0]]
                damping = {{ ratio = {ratio:?} }}
                initial_velocity = [10.0, 0.5]
                [right]
                mass = [1.0e4]
                stiffness = [1.0e3]
                damping = {{ ratio = 0.05 }}
                [[contact]]
                left_floor = 2
                right_floor = 1
                gap = 1.0e-5
                {law}
                [outputs]
                energy = true"
            ));
            let mut run = Run::new(&scene, None);
            run.to(0.1);
            assert_eq!(run.contact(0).impacts, 1);
            let account = run.energy();
            assert!(account.residual.abs() < 1e-14, "{law}, {stiffness:e} N/m, {ratio}: {account:?}");
        }
    }
}
