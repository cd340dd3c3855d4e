//! Peaks in continuous time: against closed forms, against ever denser readings of the same run, at any communication steps.

use crate::common::{Run, assert_close, record, scene};
use pounding::engine::{BuildingId, Input, LinearInput, Output, PeakOf, YieldingOf};
use pounding::record::Record;
use pounding::scene::Scene;
use std::f64::consts::PI;

/// All peaks of a model, with what they are.
fn all_of(run: &Run) -> Vec<PeakOf> {
    let of_side = |side: BuildingId| {
        let floors = 0..run.model.floors(side);
        let is_corrected = run.state.inputs().get(Input::Correction(side, 0)) != LinearInput::default();
        let corrected =
            floors.clone().filter(move |_| is_corrected).map(move |storey| PeakOf::StoreyShear(side, storey));
        let of_floor = move |floor| {
            [PeakOf::Displacement(side, floor), PeakOf::Drift(side, floor), PeakOf::Acceleration(side, floor)]
        };
        floors.flat_map(of_floor).chain([PeakOf::BaseShear(side)]).chain(corrected)
    };
    [BuildingId::LEFT, BuildingId::RIGHT].into_iter().flat_map(of_side).collect()
}

fn peaks(run: &Run) -> Vec<f64> {
    all_of(run).into_iter().map(|of| run.peak(of)).collect()
}

/// What the peaks are of, at the present time.
fn now(run: &Run) -> Vec<f64> {
    let value = |of| match of {
        PeakOf::Displacement(side, floor) => run.displacement(side, floor),
        PeakOf::Drift(side, 0) => run.displacement(side, 0),
        PeakOf::Drift(side, storey) => run.displacement(side, storey) - run.displacement(side, storey - 1),
        PeakOf::Acceleration(side, floor) => run.read(Output::Acceleration(side, floor)),
        PeakOf::BaseShear(side) => run.read(Output::BaseShear(side)),
        PeakOf::StoreyShear(side, storey) => run.read(Output::OfYielding(YieldingOf::Shear, side, storey)),
        _ => panic!("{of:?}"),
    };
    all_of(run).into_iter().map(|of| f64::abs(value(of))).collect()
}

/// A run at its start; what can be corrected is, by lines that no motion follows.
fn begin(scene: &Scene, record: Option<&Record>) -> Run {
    let mut run = Run::new(scene, record);
    for side in [BuildingId::LEFT, BuildingId::RIGHT].into_iter().filter(|_| scene.restoring_corrections) {
        for storey in 0..run.model.floors(side) {
            let size = 0.3 * scene.building(side).mass[storey] * (1.0 + storey as f64);
            run.state.set_input(Input::Correction(side, storey), size);
            run.state.set_input_rate(Input::Correction(side, storey), -1.7 * size);
        }
    }
    run
}

/// The largest magnitudes of a run: read `count` times, then again around the largest of them, ever denser.
fn dense(scene: &Scene, record: Option<&Record>, stop: f64, count: usize) -> Vec<f64> {
    let mut run = begin(scene, record);
    run.to(0.0);
    let mut largest: Vec<(f64, f64)> = now(&run).into_iter().map(|value| (value, 0.0)).collect();
    let step = stop / count as f64;
    // States from which to read again.
    let mut saved = vec![run.save()];
    for k in 1..=count {
        run.to(k as f64 * step);
        saved.push(run.save());
        for (largest, value) in largest.iter_mut().zip(now(&run)) {
            if value > largest.0 {
                *largest = (value, k as f64);
            }
        }
    }
    for (i, (value, at)) in largest.iter_mut().enumerate() {
        let first = &saved[f64::max(*at - 1.0, 0.0) as usize];
        *at *= step;
        let mut width = 2.0 * step;
        for _ in 0..6 {
            let from = f64::max(*at - 0.5 * width, first.time());
            run.model.restore(first, &mut run.state);
            for k in 0..=60 {
                let time = from + width * f64::from(k) / 60.0;
                if time > stop {
                    break;
                }
                run.to(time);
                let read = now(&run)[i];
                if read > *value {
                    (*value, *at) = (read, time);
                }
            }
            width /= 30.0;
        }
    }
    largest.into_iter().map(|(value, _)| value).collect()
}

fn compare(what: &str, scene: &Scene, record: Option<&Record>, stop: f64, count: usize) {
    let mut run = begin(scene, record);
    run.to(stop);
    let got = peaks(&run);
    let dense = dense(scene, record, stop, count);
    for ((of, got), dense) in all_of(&run).into_iter().zip(&got).zip(&dense) {
        let error = got / dense - 1.0;
        assert!(
            *got == *dense || error.abs() < 1e-10,
            "{what}, {of:?}: {got:e}, while a dense reading has {dense:e}, off by {error:.1e}"
        );
    }
    for step in [stop / 7.0, stop / 101.0, stop / 1013.7] {
        let mut run = begin(scene, record);
        run.in_steps(step, stop);
        for ((of, got), other) in all_of(&run).into_iter().zip(&got).zip(peaks(&run)) {
            assert!((got - other).abs() <= 1e-12 * got, "{what}, {of:?}: {got:e} and {other:e} in steps of {step} s");
        }
    }
}

fn frame(side: &str, storeys: usize, mass: f64, frequency: f64, ratio: f64) -> String {
    let w = 2.0 * PI * frequency;
    let masses: Vec<f64> = (0..storeys).map(|i| mass * (1.0 - 0.05 * i as f64)).collect();
    let stiffness: Vec<f64> = (0..storeys).map(|i| mass * w * w * (1.0 + 0.1 * i as f64)).collect();
    format!("[{side}]\nmass = {masses:?}\nstiffness = {stiffness:?}\ndamping = {{ ratio = {ratio:?} }}\n")
}

fn shaking(step: f64, count: i32, peak: f64) -> Record {
    let sample = |k: i32| f64::from((k * 37 + k * k % 53) % 64 - 32) / 32.0;
    let envelope = |k: i32| libm::sin(PI * f64::from(k) / f64::from(count - 1));
    let samples: Vec<f64> = (0..count).map(|k| peak * envelope(k) * sample(k)).collect();
    record(step, &samples)
}

const LAWS: [&str; 8] = [
    "law = \"stereomechanical\"\nrestitution = 0.6",
    "law = \"linear\"\nstiffness = 2e7",
    "law = \"kelvin_voigt\"\nstiffness = 2e7\nrestitution = 0.5",
    "law = \"kelvin_voigt_no_tension\"\nstiffness = 2e7\nrestitution = 0.5",
    "law = \"hertz\"\nstiffness = 3e8",
    "law = \"hertz\"\nstiffness = 3e8\nexponent = 2.2",
    "law = \"jankowski\"\nstiffness = 3e8\nrestitution = 0.6",
    "law = \"hertz_damped\"\nstiffness = 3e8\nrestitution = 0.6\ndamping_formula = \"exact\"",
];

fn with_record(text: &str) -> Scene {
    let mut scene = scene(text);
    scene.ground.record = Some("r.csv".into());
    scene
}

#[test]
fn free_vibration_has_the_peaks_of_a_textbook() {
    // 1 m/s on an oscillator of 1 Hz: u = v / w, a = v w, V = m v w.
    let w = 2.0 * PI;
    for ratio in [0.0_f64, 0.05] {
        let building = format!(
            "mass = [1000.0]\nstiffness = [{:?}]\ndamping = {{ ratio = {ratio:?} }}\ninitial_velocity = [1.0]\n",
            1000.0 * w * w
        );
        let scene = scene(&format!("name = \"Free\"\n[left]\n{building}[right]\n{building}"));
        for step in [10.0, 1.0, 0.37, 0.01] {
            let mut run = Run::new(&scene, None);
            run.in_steps(step, 10.0);
            let wd = w * (1.0 - ratio * ratio).sqrt();
            // tan(wd t) = wd / (z w).
            let t = libm::atan2(wd, ratio * w) / wd;
            let u = libm::exp(-ratio * w * t) * libm::sin(wd * t) / wd;
            assert_close(run.peak(PeakOf::Displacement(BuildingId::LEFT, 0)), u, 1e-13, "displacement");
            assert_close(run.peak(PeakOf::Drift(BuildingId::RIGHT, 0)), u, 1e-13, "drift");
            if ratio == 0.0 {
                assert_close(run.peak(PeakOf::Acceleration(BuildingId::LEFT, 0)), w, 1e-13, "acceleration");
                assert_close(run.peak(PeakOf::BaseShear(BuildingId::LEFT)), 1000.0 * w, 1e-13, "base shear");
            }
        }
    }
}

#[test]
fn a_motion_that_starts_at_its_peak_has_it_at_once() {
    let building = "mass = [2.0]\nstiffness = [50.0]\ndamping = { ratio = 0.1 }\ninitial_displacement = [-0.02]\n";
    let scene = scene(&format!("name = \"Still\"\n[left]\n{building}[right]\n{building}"));
    for step in [1.0, 0.1] {
        let mut run = Run::new(&scene, None);
        run.to(0.0);
        let expected = [0.02, 0.02, 0.5, 1.0];
        for (got, expected) in peaks(&run).into_iter().zip(expected) {
            assert_close(got, expected, 1e-15, "at the start");
        }
        let first = peaks(&run);
        run.in_steps(step, 3.0);
        assert_eq!(peaks(&run)[..2], first[..2]);
    }
}

/// The contact force is there from the start: no state without it counts.
#[test]
fn floors_that_are_pressed_at_the_start_have_the_acceleration_of_that() {
    let building = |displacement: f64| {
        format!(
            "mass = [1e5]\nstiffness = [1e7]\ndamping = {{ ratio = 0.0 }}\ninitial_displacement = [{displacement:?}]\n"
        )
    };
    let contact = "[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 0.0\nlaw = \"linear\"\nstiffness = 1e8\n";
    let scene = scene(&format!(
        "name = \"P\"\n[left]\n{}initial_velocity = [0.1]\n[right]\n{}{contact}",
        building(-0.02),
        building(-0.022)
    ));
    let mut run = Run::new(&scene, None);
    run.to(0.0);
    // u = -0.02 and -0.022 m, pressed together by 2 mm: a = -100 u -+ 1e3 x 2e-3.
    assert!(run.peak(PeakOf::Acceleration(BuildingId::LEFT, 0)) < 1e-14);
    assert_close(run.peak(PeakOf::Acceleration(BuildingId::RIGHT, 0)), 4.2, 1e-14, "right");
}

/// The acceleration turns within a short ramp of the record, beside a building whose damping couples modes.
#[test]
fn a_ramp_of_any_length_has_the_peaks_of_its_readings() {
    let scene = with_record(
        "name = \"R\"\n[left]\nmass = [2725.0]\nstiffness = [497951.0]\ndamping = { ratio = 0.035 }\n\
         [right]\nmass = [10685.0, 6735.0]\nstiffness = [832163.0, 1079692.0]\n\
         damping = { dashpots = [3419.0, 2601.0] }\n",
    );
    for exponent in 5..=9 {
        let (start, length) = (0.1358, 0.1_f64.powi(exponent));
        let times = vec![0.0, start, start + length, 0.3];
        let record = Record::new(times, vec![-0.28, -0.28, 5.7, 5.7]);
        let mut run = Run::new(&scene, Some(&record));
        let mut largest = 0.0_f64;
        for k in 0..=2000 {
            run.to(start + length * f64::from(k) / 2000.0);
            largest = largest.max(run.read(Output::Acceleration(BuildingId::LEFT, 0)).abs());
        }
        let peak = run.peak(PeakOf::Acceleration(BuildingId::LEFT, 0));
        assert!((peak - largest).abs() <= 2e-11 * largest, "{length:e} s: {peak}, not {largest}");
    }
}

#[test]
fn peaks_without_contact_are_those_of_a_dense_reading() {
    for (storeys, spacing) in [([1, 2], 0.01), ([2, 3], 0.02), ([5, 7], 0.02), ([1, 1], 0.3), ([3, 20], 0.01)] {
        let text = format!(
            "name = \"Flight\"\n{}{}",
            frame("left", storeys[0], 1e5, 6.0, 0.03),
            frame("right", storeys[1], 2e5, 4.0, 0.05)
        );
        let record = shaking(spacing, 200, 4.0);
        compare(&format!("{storeys:?}"), &with_record(&text), Some(&record), 250.0 * spacing, 5000);
    }
}

#[test]
fn peaks_with_contacts_are_those_of_a_dense_reading() {
    for law in LAWS {
        for storeys in [[1, 1], [2, 3], [9, 8]] {
            let contact = |floor: usize| {
                format!("[[contact]]\nleft_floor = {floor}\nright_floor = {floor}\ngap = 0.004\n{law}\n")
            };
            let contacts: String = (1..=storeys[0].min(storeys[1]).min(3)).map(contact).collect();
            let text = format!(
                "name = \"Contacts\"\n{}{}{contacts}",
                frame("left", storeys[0], 1e3, 3.0, 0.03),
                frame("right", storeys[1], 2e3, 5.0, 0.05)
            );
            let record = shaking(0.02, 100, 6.0);
            compare(&format!("{law} {storeys:?}"), &with_record(&text), Some(&record), 2.5, 20_000);
        }
    }
}

/// Two contacts so soft that steps go from sample to sample, over much of a swing of the quicker modes.
fn soft_contacts(law: &str) -> String {
    let pair = |floor: usize| format!("[[contact]]\nleft_floor = {floor}\nright_floor = {floor}\ngap = 0.004\n{law}\n");
    [5, 9].map(|floor| pair(floor) + "stiffness = 1e5\n").concat()
}

#[test]
fn peaks_within_long_steps_of_many_storeys_are_those_of_a_dense_reading() {
    let buildings = frame("left", 10, 1e3, 14.0, 0.01) + &frame("right", 9, 2e3, 11.0, 0.01);
    // Which keeps contacts floor by floor.
    let buildings = buildings.replace("{ ratio = 0.01 }", "{ rayleigh = { ratio = 0.01, modes = [1, 2] } }");
    let text = format!("name = \"Long\"\n{buildings}{}", soft_contacts("law = \"linear\""));
    compare("long steps", &with_record(&text), Some(&shaking(0.02, 100, 6.0)), 2.5, 20_000);
}

/// Power laws, whose steps are in the x of a time map: over rough ground, accelerations turn within them.
#[test]
fn peaks_within_steps_in_a_time_map_are_those_of_a_dense_reading() {
    let building = |side: &str, storeys: usize, mass: f64, frequency: f64| {
        let stiffness = mass * (2.0 * PI * frequency) * (2.0 * PI * frequency);
        let damping = "damping = { rayleigh = { ratio = 0.01, modes = [1, 2] } }";
        format!("[{side}]\nmass = {:?}\nstiffness = {:?}\n{damping}\n", vec![mass; storeys], vec![stiffness; storeys])
    };
    let buildings = building("left", 10, 1e3, 14.0) + &building("right", 9, 2e3, 11.0);
    let samples: Vec<f64> = (0..100).map(f64::from).map(|k| 6.0 * libm::sin(k * (0.7 * k + 1.0))).collect();
    for law in ["law = \"hertz\"", "law = \"jankowski\"\nrestitution = 0.6"] {
        let text = format!("name = \"Map\"\n{buildings}{}", soft_contacts(law));
        compare(law, &with_record(&text), Some(&record(0.02, &samples)), 2.5, 20_000);
    }
}

/// The drift of one storey is largest just after another floor has been met, within the first step of that contact.
#[test]
fn a_peak_just_after_an_entry_is_that_of_a_dense_reading() {
    let buildings = frame("left", 10, 1e3, 14.0, 0.01) + &frame("right", 9, 2e3, 5.0, 0.01);
    let buildings = buildings.replace("{ ratio = 0.01 }", "{ rayleigh = { ratio = 0.01, modes = [1, 2] } }");
    let pair = |floor: usize| {
        format!(
            "[[contact]]\nleft_floor = {floor}\nright_floor = {floor}\ngap = 0.018\nlaw = \"hertz\"\nstiffness = 1e6\n"
        )
    };
    let text = format!("name = \"Entry\"\n{buildings}{}", (1..=9).map(pair).collect::<String>());
    compare("just after an entry", &with_record(&text), Some(&shaking(0.02, 100, 6.0)), 2.5, 20_000);
}

#[test]
fn stiff_slow_and_coupled_buildings_have_the_peaks_of_a_dense_reading() {
    let record = shaking(0.02, 100, 5.0);
    let stiff = frame("left", 2, 1e4, 3000.0, 0.02) + &frame("right", 1, 1e4, 40.0, 0.0);
    let undamped = frame("left", 1, 1.0, 1.0, 0.0) + &frame("right", 3, 1.0, 0.3, 0.0);
    let mut coupled = frame("left", 2, 1e3, 4.0, 0.0) + &frame("right", 1, 1e3, 7.0, 0.3);
    coupled = coupled.replacen(
        "damping = { ratio = 0.0 }",
        "damping = { matrix = [[9000.0, -1000.0], [-1000.0, 1200.0]] }",
        1,
    );
    assert!(coupled.contains("matrix"));
    for (what, text) in [("stiff", stiff), ("undamped", undamped), ("coupled", coupled)] {
        compare(what, &with_record(&format!("name = \"B\"\n{text}")), Some(&record), 2.5, 20_000);
    }
}

/// A lowest storey that makes a mode up to a million times as fast as the others, which swings, settles or creeps.
#[test]
fn modes_that_settle_leave_the_peaks_of_a_dense_reading() {
    for (stiffness, damping) in
        [("1e11", "ratio = 0.02"), ("1e14", "ratio = 0.2"), ("1e14", "rayleigh = { ratio = 0.03, modes = [1, 2] }")]
    {
        let storeys =
            format!("mass = [1e4, 1e4, 9e3]\nstiffness = [{stiffness}, 3e7, 2e7]\ndamping = {{ {damping} }}\n");
        let text = format!("name = \"Stiff\"\n[left]\n{storeys}{}", frame("right", 1, 1e4, 4.0, 0.03));
        let what = format!("{stiffness} N/m, {damping}");
        compare(&what, &with_record(&text), Some(&shaking(0.02, 100, 5.0)), 2.5, 20_000);
    }
}

/// A record as an input that is linear from one communication point to the next has the same peaks, and so has one cut finer.
#[test]
fn peaks_under_inputs_are_those_under_a_record() {
    let contact = "[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 0.002\nlaw = \"hertz\"\nstiffness = 3e8\n";
    let text =
        format!("name = \"In\"\n{}{}{contact}", frame("left", 2, 1e3, 3.0, 0.03), frame("right", 1, 2e3, 5.0, 0.05));
    let (step, samples) = (1.0 / 64.0, shaking(1.0 / 64.0, 100, 6.0));
    let mut by_record = Run::new(&with_record(&text), Some(&samples));
    by_record.to(99.0 * step);
    let expected = peaks(&by_record);
    for parts in [1, 3] {
        let mut driven = Run::new(&scene(&text), None);
        for (k, ends) in samples.accelerations.windows(2).enumerate() {
            for part in 0..parts {
                let share = f64::from(part) / f64::from(parts);
                driven.state.set_ground_acceleration(ends[0] + share * (ends[1] - ends[0]));
                driven.state.set_ground_acceleration_rate((ends[1] - ends[0]) / step);
                driven.to((k as f64 + f64::from(part + 1) / f64::from(parts)) * step);
            }
        }
        for ((of, got), expected) in all_of(&driven).into_iter().zip(peaks(&driven)).zip(&expected) {
            assert_close(got, *expected, 1e-11, &format!("{of:?} in {parts} parts"));
        }
    }
}

/// A floor force that is set to F for one step on an oscillator at rest: u = F/k (1 - cos w t), and the acceleration jumps to
/// F/m at once and back when it ends.
#[test]
fn peaks_see_both_sides_of_a_jump_of_an_input() {
    let (m, w, force) = (10.0, 8.0, 30.0);
    let building = format!("mass = [{m:?}]\nstiffness = [{:?}]\ndamping = {{ ratio = 0.0 }}\n", m * w * w);
    let scene = scene(&format!("name = \"F\"\n[left]\n{building}[right]\n{building}[inputs]\nfloor_forces = true\n"));
    let mut run = Run::new(&scene, None);
    run.to(0.0);
    let acceleration = PeakOf::Acceleration(BuildingId::LEFT, 0);
    run.state.set_floor_force(BuildingId::LEFT, 0, force);
    run.model.observe(&run.state, &mut run.point);
    assert_eq!(run.peak(acceleration), 0.0, "nothing has acted yet");
    let short = 0.1;
    run.to(short);
    assert_close(run.peak(acceleration), force / m, 1e-14, "at the start of the step");
    assert_close(
        run.peak(PeakOf::Displacement(BuildingId::LEFT, 0)),
        force / (m * w * w) * (1.0 - libm::cos(w * short)),
        1e-12,
        "u",
    );
    run.state.set_floor_force(BuildingId::LEFT, 0, 0.0);
    run.to(2.0);
    // Swings freely then with the amplitude 2 F/k sin(w t / 2).
    let amplitude = 2.0 * force / (m * w * w) * libm::sin(0.5 * w * short);
    assert_close(run.peak(PeakOf::Displacement(BuildingId::LEFT, 0)), amplitude, 1e-12, "amplitude");
    assert_close(run.peak(PeakOf::BaseShear(BuildingId::LEFT)), m * w * w * amplitude, 1e-12, "base shear");
    assert_close(run.peak(acceleration), f64::max(w * w * amplitude, force / m), 1e-12, "acceleration");
}

/// No peak ever falls, read at steps finer than the engine's own, and none is below what is read beside it.
#[test]
fn no_peak_ever_falls() {
    let contact = |floor: usize, law: &str| {
        format!("[[contact]]\nleft_floor = {floor}\nright_floor = {floor}\ngap = 0.003\n{law}\n")
    };
    for (n, law) in LAWS.iter().enumerate() {
        let contacts = contact(1, law) + &contact(2, LAWS[(n + 3) % 8]);
        let text = format!(
            "name = \"Up\"\n{}{}{contacts}",
            frame("left", 2, 1e3, 3.0, 0.03),
            frame("right", 3, 2e3, 5.0, 0.05)
        );
        let mut run = Run::new(&with_record(&text), Some(&shaking(0.02, 100, 6.0)));
        let mut last: Vec<f64> = Vec::new();
        for k in 0..30_000 {
            run.to(2.3 * f64::from(k) / 30_000.0);
            let forces = run.contacts();
            let mut all = peaks(&run);
            // A drift that is read is a difference of displacements, with their rounding.
            let moved = run.displacement(BuildingId::LEFT, 1).abs().max(run.displacement(BuildingId::RIGHT, 2).abs());
            for (of, (peak, now)) in all_of(&run).into_iter().zip(all.iter().zip(now(&run))) {
                let rounding = 1e-13 * peak + if matches!(of, PeakOf::Drift(..)) { 1e-15 * moved } else { 0.0 };
                assert!(now <= peak + rounding, "{law}, {of:?} at step {k}: {now:e} above {peak:e}");
            }
            for contact in &forces {
                assert!(contact.force <= contact.peak_force * (1.0 + 1e-12), "{law} at step {k}: {contact:?}");
            }
            all.extend(forces.iter().map(|contact| contact.peak_force));
            for (i, (now, before)) in all.iter().zip(&last).enumerate() {
                assert!(now >= before, "{law}, number {i} falls at step {k}: {now:e} after {before:e}");
            }
            last = all;
        }
        assert!(run.point.impacts > 5, "{} impacts", run.point.impacts);
    }
}

/// The beginning of another contact just before a force is largest: reference in quadruple precision.
#[test]
fn the_peak_of_a_force_just_after_another_contact_begins_is_found() {
    let text = "name = \"Mini\"
        [left]
        mass = [1000.0]
        stiffness = [1.0]
        damping = { ratio = 0.0 }
        initial_velocity = [1.0]
        [right]
        mass = [1000.0, 1000.0]
        stiffness = [1.0, 1.0]
        damping = { ratio = 0.0 }
        [[contact]]
        left_floor = 1
        right_floor = 1
        gap = 1e-06
        law = \"kelvin_voigt\"
        stiffness = 100000000.0
        restitution = 0.3
        [[contact]]
        left_floor = 1
        right_floor = 2
        gap = 0.001
        law = \"jankowski\"
        stiffness = 1000000000.0
        restitution = 0.5";
    let quiet = record(0.02, &[0.0, 0.0]);
    for (scene, record) in [(scene(text), None), (with_record(text), Some(&quiet))] {
        for step in [0.003, 0.001, 0.0011057685, 0.00001] {
            let mut run = Run::new(&scene, record);
            run.in_steps(step, 0.003);
            assert_close(run.contact(0).peak_force, 186_529.182_577_949_95, 1e-12, &format!("steps of {step} s"));
        }
    }
}

/// A contact that has been pressed together at the start and parts: it only pulls.
#[test]
fn a_contact_that_only_pulls_has_no_peak() {
    let building = |speed: f64| {
        format!("mass = [1000.0]\nstiffness = [1e5]\ndamping = {{ ratio = 0.05 }}\ninitial_velocity = [{speed:?}]\n")
    };
    let contact = "[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = -1e-5\nlaw = \"kelvin_voigt\"\nstiffness = 1e7\nrestitution = 0.5\n";
    let scene = scene(&format!("name = \"Pull\"\n[left]\n{}[right]\n{}{contact}", building(-1.0), building(0.0)));
    let mut run = Run::new(&scene, None);
    run.to(1e-4);
    assert_eq!((run.episodes[0].peak_force, run.contact(0).peak_force), (0.0, 0.0));
}

/// Where the scene wants no peaks there are none, and the motion has the same bits.
#[test]
fn a_scene_without_peaks_moves_as_one_with_them() {
    let contact = "[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 0.002\nlaw = \"jankowski\"\nstiffness = 3e8\nrestitution = 0.6\n";
    let text =
        format!("name = \"No\"\n{}{}{contact}", frame("left", 2, 1e3, 3.0, 0.03), frame("right", 3, 2e3, 5.0, 0.05));
    let samples = shaking(0.02, 100, 6.0);
    let scenes = [with_record(&text), with_record(&format!("{text}[outputs]\npeaks = false\n"))];
    let mut runs = scenes.each_ref().map(|scene| Run::new(scene, Some(&samples)));
    for k in 1..=200 {
        let shown = runs.each_mut().map(|run| {
            run.to(0.01 * f64::from(k));
            (now(run).into_iter().map(f64::to_bits).collect::<Vec<_>>(), run.state.counters())
        });
        assert_eq!(shown[0], shown[1]);
    }
    assert!(runs[0].point.impacts > 3 && peaks(&runs[0]).iter().all(|peak| *peak > 0.0));
    assert!(peaks(&runs[1]).iter().all(|peak| *peak == 0.0));
    let names = scenes.map(|scene| {
        let rows = pounding::variables::Table::new(&scene).rows;
        rows.into_iter().filter(|row| row.name.contains("t.peak_")).count()
    });
    assert_eq!(names, [2 * 3 + 3 * 3 + 2, 0]);
}

/// Under a force that is held from the start, acceleration is largest at once: what is shown later is never without the force.
#[test]
fn a_held_force_is_a_part_of_the_acceleration() {
    let (m, w, force) = (10.0, 8.0, 30.0);
    let building = format!("mass = [{m:?}]\nstiffness = [{:?}]\ndamping = {{ ratio = 0.05 }}\n", m * w * w);
    let scene = scene(&format!("name = \"F\"\n[left]\n{building}[right]\n{building}[inputs]\nfloor_forces = true\n"));
    let mut run = Run::new(&scene, None);
    run.state.set_floor_force(BuildingId::LEFT, 0, force);
    for k in 1..=500 {
        run.to(0.005 * f64::from(k));
        assert_close(run.peak(PeakOf::Acceleration(BuildingId::LEFT, 0)), force / m, 1e-14, &format!("step {k}"));
    }
}

/// A contact within the first segment of a record ends what was known of the time to come.
#[test]
fn a_contact_in_the_first_segment_is_not_looked_past() {
    for law in LAWS {
        let contact = format!("[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 0.001\n{law}\n");
        let left = frame("left", 2, 1e3, 1.0, 0.03) + "initial_velocity = [0.8, 0.6]\n";
        let right = frame("right", 1, 2e3, 2.0, 0.05) + "initial_velocity = [-0.3]\n";
        let record = shaking(0.05, 30, 0.5);
        let scene = with_record(&format!("name = \"First\"\n{left}{right}{contact}"));
        compare(law, &scene, Some(&record), 1.2, 20_000);
    }
}
