//! Every scene of the project with stops and without: the same bits of all outputs at all times, and of all episodes.

use super::runs::{Subject, Watched, all_scenes, differing, scene_named};
use proptest::prelude::*;
use std::path::Path;

/// What has happened in a run with stops.
#[derive(Default)]
struct Stops {
    times: Vec<f64>,
    /// Stops at which no discrete output has changed.
    without_change: usize,
}

/// Compares a run with stops with one without at these times. At each stop `interfere` is called before the event is handled
/// and after.
fn compare(file: &Path, times: &[f64], mut interfere: impl FnMut(&mut Watched<'_>)) -> Stops {
    let subject = Subject::new(file);
    let (mut plain, mut stopping, mut stops) = (subject.start(), subject.start(), Stops::default());
    let at_start = stopping.read();
    let mut discrete = stopping.discrete(&at_start);
    for &until in times {
        subject.drive(&mut plain.state);
        subject.drive(&mut stopping.state);
        plain.advance(until);
        let mut goal = until;
        while stopping.advance_to_event(goal) {
            stops.times.push(stopping.state.time());
            assert!(stopping.state.time() <= until, "{}: beyond {until}", file.display());
            interfere(&mut stopping);
            let before = stopping.read();
            assert_eq!(stopping.discrete(&before), discrete, "{}: at {}", file.display(), stopping.state.time());
            stopping.handle_event();
            interfere(&mut stopping);
            let after = stopping.read();
            stops.without_change += usize::from(stopping.discrete(&after) == discrete);
            discrete = stopping.discrete(&after);
            // As masters ask for the rest of a step.
            goal = stopping.state.time() + (until - stopping.state.time());
        }
        let (one, other) = (plain.read(), stopping.read());
        assert_eq!(differing(&subject, &one, &other), [""; 0], "{}: at {until}", file.display());
        assert_eq!(stopping.discrete(&other), discrete, "{}: up to {until}", file.display());
    }
    assert_eq!(plain.episodes, stopping.episodes, "{}", file.display());
    stops
}

fn grid(file: &Path) -> Vec<f64> {
    let stop = Subject::new(file).stop;
    (1..=(stop / 0.01).round() as usize).map(|k| k as f64 * 0.01).collect()
}

#[test]
fn stops_change_no_bit_of_any_scene() {
    let mut count = 0;
    for file in all_scenes() {
        let stops = compare(&file, &grid(&file), |_| ());
        assert_eq!(stops.without_change, 0, "{}: an event that changes nothing", file.display());
        count += stops.times.len();
    }
    assert!(count > 4000, "only {count} stops");
}

/// Floors that stand against each other at the start, in one row: one impact sets off the next, all at the same instant.
#[test]
fn events_at_one_instant_are_one_stop() {
    let subject = Subject::new(&scene_named("leaning"));
    let mut run = subject.start();
    let mut times = Vec::new();
    while run.advance_to_event(subject.stop) {
        times.push(run.state.time());
        run.handle_event();
    }
    assert!(times.len() > 3 && times.windows(2).all(|pair| pair[0] < pair[1]), "{times:?}");
}

#[test]
fn a_run_that_goes_on_elsewhere_at_each_stop_has_the_same_bits() {
    for file in all_scenes() {
        compare(&file, &grid(&file), |run| run.go_on_elsewhere());
    }
}

/// A master may set its inputs again at each stop.
#[test]
fn an_input_that_is_set_to_the_value_that_it_has_changes_nothing() {
    let mut set = 0;
    compare(&scene_named("two_blocks_with_inputs"), &grid(&scene_named("two_blocks_with_inputs")), |run| {
        if !run.state.has_event() {
            let inputs = run.state.inputs().clone();
            for &input in &run.subject.inputs {
                run.state.set_input(input, inputs.get(input).at(run.state.time()));
            }
            set += 1;
        }
    });
    assert!(set > 20, "only {set} stops");
}

#[test]
fn each_stop_is_an_onset_an_end_or_a_switch() {
    for name in ["feup", "yielding", "feup_stereomechanical", "leaning_on_columns"] {
        let file = scene_named(name);
        let subject = Subject::new(&file);
        let mut run = subject.start();
        run.state.note_switches();
        run.advance(subject.stop);
        let ends = run.episodes.iter().flat_map(|episode| [Some(episode.start), episode.end]).flatten();
        let mut expected: Vec<f64> = ends.chain(run.state.switches().iter().copied()).collect();
        expected.sort_by(f64::total_cmp);
        expected.dedup();
        let mut stops = compare(&file, &[subject.stop], |_| ()).times;
        stops.dedup();
        let opened = stops.iter().filter(|stop| !expected.contains(stop)).count();
        assert!(opened <= run.subject.model.contacts(), "{name}: {opened} stops are at no event but open contacts");
        assert!(expected.iter().all(|event| stops.contains(event)), "{name}: events at which it has not stopped");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn stops_change_no_bit_whatever_the_steps(
        scene in prop::sample::select(vec!["feup", "yielding", "two_blocks_with_inputs", "columns_stereomechanical"]),
        steps in prop::collection::vec(1e-9..0.3_f64, 20..60),
        elsewhere in any::<bool>(),
    ) {
        let mut time = 0.0;
        let times: Vec<f64> = steps.iter().map(|step| { time += step; time }).collect();
        compare(&scene_named(scene), &times, |run| if elsewhere { run.go_on_elsewhere() });
    }
}
