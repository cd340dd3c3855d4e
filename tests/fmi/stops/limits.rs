//! Both sides of an event: what must be equal, what must jump, and by how much.

use super::runs::{Subject, all_scenes, scene_named};
use pounding::engine::{BuildingId, ContactOutput, Output};

/// Displacements, and velocities where no impulse acts, relative to their largest magnitude.
#[test]
fn displacements_go_on_through_every_event_and_velocities_where_no_impulse_acts() {
    for file in all_scenes() {
        let subject = Subject::new(&file);
        let text = std::fs::read_to_string(&file).unwrap();
        let has_impulses = text.contains("stereomechanical");
        let goes_on = |output: &Output| {
            matches!(output, Output::Displacement(..)) || !has_impulses && matches!(output, Output::Velocity(..))
        };
        let (mut run, mut largest, mut worst) = (subject.start(), 0.0_f64, 0.0_f64);
        subject.drive(&mut run.state);
        while run.advance_to_event(subject.stop.min(8.0)) {
            let before = run.read();
            run.handle_event();
            let after = run.read();
            for ((_, output), (before, after)) in subject.outputs.iter().zip(before.iter().zip(&after)) {
                if goes_on(output) {
                    let (before, after) = (f64::from_bits(*before), f64::from_bits(*after));
                    (largest, worst) = (largest.max(before.abs()), worst.max((before - after).abs()));
                }
            }
        }
        assert!(worst <= 1e-13 * largest.max(1e-3), "{}: a jump of {worst:e} of {largest:e}", file.display());
    }
}

#[test]
fn faces_touch_at_onsets_and_ends() {
    let subject = Subject::new(&scene_named("feup"));
    let (mut run, mut met) = (subject.start(), 0);
    while run.advance_to_event(subject.stop) {
        let before: Vec<bool> = (0..subject.model.contacts()).map(|p| run.value(active(p)) != 0.0).collect();
        let penetrations: Vec<f64> = (0..before.len()).map(|p| run.value(penetration(p))).collect();
        run.handle_event();
        for (p, was_active) in before.into_iter().enumerate() {
            if (run.value(active(p)) != 0.0) != was_active {
                met += 1;
                assert!(penetrations[p].abs() < 1e-15, "{} m before", penetrations[p]);
                assert!(run.value(penetration(p)).abs() < 1e-15, "{} m after", run.value(penetration(p)));
            }
        }
    }
    assert!(met >= 200, "{met} onsets and ends");
}

/// Newton's law of impact, for a pair that meets alone: v+ = -e v-.
#[test]
fn impulses_send_the_floors_back_with_the_coefficient_of_restitution() {
    let subject = Subject::new(&scene_named("feup_stereomechanical"));
    let text = std::fs::read_to_string(scene_named("feup_stereomechanical")).unwrap();
    let restitution: f64 =
        text.lines().find_map(|line| line.strip_prefix("restitution = ")).unwrap().trim().parse().unwrap();
    let (mut run, mut met) = (subject.start(), 0);
    while run.advance_to_event(subject.stop) {
        let before: Vec<(f64, f64)> =
            (0..subject.model.contacts()).map(|p| (run.value(impacts(p)), rate(&mut run, p))).collect();
        run.handle_event();
        let hit: Vec<usize> = (0..before.len()).filter(|&p| run.value(impacts(p)) > before[p].0).collect();
        if let &[p] = &hit[..] {
            let (approach, after) = (before[p].1, rate(&mut run, p));
            if run.value(active(p)) == 0.0 && run.value(impacts(p)) == before[p].0 + 1.0 {
                met += 1;
                assert!((after + restitution * approach).abs() < 1e-13 * approach, "{approach} m/s, {after} m/s");
            }
        }
    }
    assert!(met > 20, "{met} impulses");
}

fn active(p: usize) -> Output {
    Output::Contact(p, ContactOutput::Active)
}

fn impacts(p: usize) -> Output {
    Output::Contact(p, ContactOutput::Impacts)
}

fn penetration(p: usize) -> Output {
    Output::Contact(p, ContactOutput::Penetration)
}

/// The rate of the penetration of the p-th contact of the frames, which joins the floors of that number.
fn rate(run: &mut super::runs::Watched<'_>, p: usize) -> f64 {
    run.value(Output::Velocity(BuildingId::LEFT, p)) - run.value(Output::Velocity(BuildingId::RIGHT, p))
}
