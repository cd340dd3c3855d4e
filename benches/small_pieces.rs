//! What the pieces of a run cost: `cargo bench --bench small_pieces`.
//!
//! Whole earthquakes, and other solvers beside ours, are measured by `benchmarks/work_precision.py`.
#![allow(missing_docs, clippy::panic, clippy::unwrap_used)]

#[path = "../tests/problems/mod.rs"]
mod problems;
#[path = "../tests/support/mod.rs"]
mod support;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use pounding::engine::{Model, Output, State};
use pounding::record::Record;
use pounding::scene::Scene;
use pounding::variables::{Slot, Table, Type};
use problems::laws::{Laws, contact};
use problems::two_masses::{Mass, TwoMasses};
use std::fmt::Write;
use std::time::{Duration, Instant};
use support::{Component, Fmu, Instance, OK, fmi2DoStep, fmi2GetReal};

const GROUND_STEP: f64 = 0.01;
const SAMPLES: usize = 2001;

const LAWS: Laws = Laws { spring: 2.75e9, hertz: 2.75e9, exponent: 1.5, restitution: 0.65 };

fn laws() -> [String; 5] {
    let formula = "lankarani_nikravesh";
    [LAWS.linear(), LAWS.kelvin_voigt(), LAWS.hertz(), LAWS.jankowski(), LAWS.hertz_damped(formula)]
}

/// Two buildings with as many contacts of a law as wanted. Without a record their first floors move towards each other
/// at 0.5 m/s each.
fn scene_text(floors: [usize; 2], contacts: usize, gap: f64, law: &str, record: bool) -> String {
    let mut text = String::from("name = \"Pieces\"\nstop_time = 20.0\n");
    for (side, floors, velocity) in [("left", floors[0], 0.5), ("right", floors[1], -0.5)] {
        let list = |value: f64| format!("{:?}", vec![value; floors]);
        let mut initial = vec![0.0; floors];
        initial[0] = if record { 0.0 } else { velocity };
        writeln!(text, "[{side}]\nmass = {}\nstiffness = {}", list(3e5), list(5e8)).unwrap();
        writeln!(text, "damping = {{ ratio = 0.05 }}\ninitial_velocity = {initial:?}").unwrap();
    }
    if record {
        text += "[ground]\nrecord = \"record.csv\"\n";
    }
    for floor in 1..=contacts {
        text += &contact((floor, floor), gap, law);
    }
    text
}

fn record_text(peak: f64) -> String {
    let mut text = String::from("time_s,accel_m_s2\n");
    for k in 0..SAMPLES {
        writeln!(text, "{},{}", k as f64 * GROUND_STEP, peak * (k as f64 * 0.21).sin()).unwrap();
    }
    text
}

fn record(peak: f64) -> Record {
    Record::parse("record.csv", record_text(peak).as_bytes()).unwrap()
}

fn model(text: &str, record: Option<&Record>) -> Model {
    Model::new(&Scene::from_toml(text).unwrap(), record).unwrap()
}

fn advance(model: &Model, state: &mut State, time: f64) {
    model.advance(state, time, &mut |_| ()).unwrap();
}

/// From one sample of the record to the next without contact; with contacts listed, but far away, and without.
fn flight_knot(criterion: &mut Criterion) {
    let record = record(3.0);
    let mut group = criterion.benchmark_group("flight_knot");
    for (modes, contacts) in [(2, 0), (6, 0), (50, 0), (200, 0), (2, 1), (6, 3), (50, 20)] {
        let floors = [modes / 2, modes - modes / 2];
        let model = model(&scene_text(floors, contacts, 100.0, &LAWS.hertz(), true), Some(&record));
        let start = model.start(0.0);
        group.bench_function(format!("{modes} modes, {contacts} contacts"), |bencher| {
            bencher.iter_custom(|knots| {
                let (mut state, mut knot, mut spent) = (start.clone(), 0, Duration::ZERO);
                for _ in 0..knots {
                    knot += 1;
                    if knot == SAMPLES {
                        state.clone_from(&start);
                        knot = 1;
                    }
                    let clock = Instant::now();
                    advance(&model, &mut state, knot as f64 * GROUND_STEP);
                    spent += clock.elapsed();
                }
                spent
            });
        });
    }
    // All knots in one communication step: without the cost of asking for each.
    for modes in [2, 6, 50, 200] {
        let model = model(&scene_text([modes / 2, modes - modes / 2], 0, 0.0, &LAWS.hertz(), true), Some(&record));
        group.throughput(Throughput::Elements(SAMPLES as u64 - 1));
        group.bench_function(format!("{modes} modes, whole record"), |bencher| {
            let start = model.start(0.0);
            let run = |state: &mut State| advance(&model, state, 20.0);
            bencher.iter_batched_ref(|| start.clone(), run, BatchSize::SmallInput);
        });
    }
    group.finish();
}

/// From 1 us before an entry to 1 ns after it.
fn entry(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("entry");
    let meeting = TwoMasses::new(Mass::free(3e5, 0.5), Mass::free(3e5, -0.5), 1e-6, "");
    for law in &laws() {
        let model = model(&scene_text([3, 3], 1, 1e-6, law, false), None);
        let start = model.start(0.0);
        let run = |state: &mut State| advance(&model, state, 1.001e-6);
        let mut entered = start.clone();
        run(&mut entered);
        let began = model.open_episode(&entered, 0).map(|episode| episode.start);
        // Free masses meet then; over 1 us springs and damping move them by some millionths of the gap.
        assert!(began.is_some_and(|began| (began / meeting.entry() - 1.0).abs() < 1e-5), "{law}: {began:?}");
        group.bench_function(name(law), |bencher| {
            bencher.iter_batched_ref(|| start.clone(), run, BatchSize::SmallInput);
        });
    }
    group.finish();
}

/// A whole contact with its entry and release; `elem/s` counts the contact steps.
fn episode(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("episode");
    for floors in [[1, 1], [3, 3], [20, 30]] {
        for law in &laws() {
            let model = model(&scene_text(floors, 1, 1e-6, law, false), None);
            let start = model.start(0.0);
            let end = release(&model, start.clone());
            let mut finished = start.clone();
            advance(&model, &mut finished, end);
            group.throughput(Throughput::Elements(finished.counters().contact_steps()));
            let run = |state: &mut State| advance(&model, state, end);
            group.bench_function(format!("{} on {}+{} storeys", name(law), floors[0], floors[1]), |bencher| {
                bencher.iter_batched_ref(|| start.clone(), run, BatchSize::SmallInput);
            });
        }
    }
    group.finish();
}

/// s, end of the first contact.
fn release(model: &Model, mut state: State) -> f64 {
    let mut end = None;
    for step in 1..1000 {
        let time = f64::from(step) * 1e-3;
        model.advance(&mut state, time, &mut |episode| end = end.or(episode.end)).unwrap();
        if let Some(end) = end {
            return end;
        }
    }
    panic!("the contact lasts for ever");
}

fn name(law: &str) -> &str {
    law.split('"').nth(1).unwrap()
}

/// The FMU's own calls through its C interface: for the scene that `cargo fmu` packs, and on 20 and 30 storeys with 20
/// contacts.
fn fmu(criterion: &mut Criterion) {
    let (scene, record) =
        (include_str!("../examples/scenes/feup.toml"), include_bytes!("../examples/records/el_centro_1940_ns.csv"));
    let feup = Quiet { fmu: Fmu::with_record(scene, record), steps: 1000 };
    let tall = Quiet { fmu: Fmu::new(&scene_text([20, 30], 20, 100.0, &LAWS.hertz(), true)), steps: 20_000 };
    for (name, quiet) in [("fmu_feup", feup), ("fmu_20_30_storeys", tall)] {
        calls(criterion, name, &quiet);
    }
}

/// An FMU without contact for so many steps of 1 ms from the start.
struct Quiet {
    fmu: Fmu,
    steps: u32,
}

fn calls(criterion: &mut Criterion, name: &str, quiet: &Quiet) {
    let Quiet { fmu, .. } = quiet;
    let mut group = criterion.benchmark_group(name);
    group.bench_function("instantiate and initialise", |bencher| {
        bencher.iter_with_large_drop(|| started(fmu));
    });
    group.bench_function("quiet communication step of 1 ms", |bencher| {
        bencher.iter_custom(|steps| at_each_step(quiet, steps, |_| ()).0);
    });

    let mut values = vec![0.0; 1000];
    let mut get = |component: Component, references: &[u32]| {
        // SAFETY: a live component, and room for all values.
        let status = unsafe { fmi2GetReal(component, references.as_ptr(), references.len(), values.as_mut_ptr()) };
        assert_eq!(status, OK);
    };
    let rows = Table::new(&fmu.package.scene);
    let outputs: Vec<(u32, Output)> = rows
        .iter()
        .filter(|(_, row)| matches!(row.ty, Type::Real(_)))
        .filter_map(
            |(reference, row)| if let Slot::Output(output) = row.slot { Some((reference, output)) } else { None },
        )
        .collect();
    let all: Vec<u32> = outputs.iter().map(|(reference, _)| *reference).collect();
    let displacements = outputs.iter().filter(|(_, output)| matches!(output, Output::Displacement(..)));
    let displacements: Vec<u32> = displacements.map(|(reference, _)| *reference).collect();
    for (title, references, at_once) in [
        ("all Real outputs at once", &all, all.len()),
        ("all Real outputs one by one", &all, 1),
        ("all displacements at once", &displacements, displacements.len()),
        ("one displacement", &displacements[..1].to_vec(), 1),
    ] {
        let title = format!("get at a new communication point: {title} ({})", references.len());
        group.bench_function(title, |bencher| {
            bencher.iter_custom(|steps| {
                let read = |component| references.chunks(at_once).for_each(|some| get(component, some));
                at_each_step(quiet, steps, read).1
            });
        });
    }
    let instance = started(fmu);
    assert_eq!(instance.step(0.0, 5.0), OK);
    let mut state = instance.recorded();
    group.bench_function("record a state in place of another", |bencher| {
        bencher.iter(|| assert_eq!(instance.get_state(&raw mut state), OK));
    });
    group.bench_function("go back to a state", |bencher| {
        bencher.iter(|| assert_eq!(instance.set_state(state), OK));
    });
    let bytes = instance.serialized(state);
    group.bench_function(format!("serialize a state, {} bytes", bytes.len()), |bencher| {
        let mut room = bytes.clone();
        bencher.iter(|| assert_eq!(instance.serialize_to(state, room.as_mut_ptr(), room.len()), OK));
    });
    group.bench_function("deserialize a state", |bencher| {
        bencher.iter(|| assert_eq!(instance.deserialize_from(bytes.as_ptr(), bytes.len(), &raw mut state), OK));
    });
    group.finish();
}

/// Does something after each step of 1 ms; the time of all steps, and that of what was done.
fn at_each_step(quiet: &Quiet, steps: u64, mut then: impl FnMut(Component)) -> (Duration, Duration) {
    let Quiet { fmu, steps: quiet_steps } = quiet;
    let (mut instance, mut step) = (started(fmu), 0);
    let (mut stepping, mut doing) = (Duration::ZERO, Duration::ZERO);
    for _ in 0..steps {
        if step == *quiet_steps {
            assert_eq!(instance.integer("impacts"), 0, "no impact in {step} steps");
            (instance, step) = (started(fmu), 0);
        }
        let start = Instant::now();
        // SAFETY: a live component.
        let status = unsafe { fmi2DoStep(instance.component, f64::from(step) * 1e-3, 1e-3, 1) };
        let stepped = Instant::now();
        then(instance.component);
        doing += stepped.elapsed();
        stepping += stepped - start;
        assert_eq!(status, OK);
        step += 1;
    }
    (stepping, doing)
}

/// An instance at its first communication point.
fn started(fmu: &Fmu) -> Instance<'_> {
    let instance = fmu.instance();
    instance.start();
    instance
}

criterion_group!(pieces, flight_knot, entry, episode, fmu);
criterion_main!(pieces);
