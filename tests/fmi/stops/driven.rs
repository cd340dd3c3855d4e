//! A master that changes its mind at a stop, with other inputs or another step: the run is then that of a master with a
//! communication point there.

use super::runs::{Subject, Watched, scene_named};
use pounding::engine::{BuildingId, Input};

/// Runs both masters; `change` is called after each event and gives the time to go on to.
fn compare(change: impl Fn(&mut Watched<'_>, f64) -> f64) {
    let subject = Subject::new(&scene_named("two_blocks_with_inputs"));
    let (mut stopping, mut plain) = (subject.start(), subject.start());
    let (mut stops, mut time) = (0, 0.0);
    while time < 5.0 {
        subject.drive(&mut stopping.state);
        subject.drive(&mut plain.state);
        let mut goal = time + 0.02;
        while stopping.advance_to_event(goal) {
            stops += 1;
            plain.advance(stopping.state.time());
            stopping.handle_event();
            change(&mut plain, goal);
            goal = change(&mut stopping, goal);
        }
        plain.advance(goal);
        time = goal;
        let (one, other) = (stopping.read(), plain.read());
        for ((row, _), (one, other)) in subject.outputs.iter().zip(one.into_iter().zip(other)) {
            let (one, other) = (f64::from_bits(one), f64::from_bits(other));
            let nominal = row.nominal.unwrap_or(1.0);
            assert!((one - other).abs() <= 1e-10 * other.abs().max(nominal), "{} at {time}: {one}, {other}", row.name);
        }
    }
    assert!(stops > 10, "{stops} stops");
}

#[test]
fn an_input_that_is_set_after_an_event_counts_from_there() {
    compare(|run, goal| {
        let push = 1e5 * (9.0 * run.state.time()).sin();
        run.state.set_input(Input::Force(BuildingId::LEFT, 0), push);
        run.state.set_ground_acceleration(0.5);
        goal
    });
}

#[test]
fn after_an_event_a_step_may_be_longer_or_shorter_than_what_is_left_of_it() {
    compare(|_, goal| goal + 0.013);
    compare(|run, goal| run.state.time() + 0.3 * (goal - run.state.time()));
}
