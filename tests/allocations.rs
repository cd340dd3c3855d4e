//! No memory is asked for once a run has started, and a description of tall buildings asks for little, as it lists no more
//! than what depends on each other; so does a parameter that is set.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::{Run, record, scene};
use pounding::FmiVersion;
use pounding::description::Package;
use pounding::engine::{BuildingId, PointRates};
use pounding::slave::{Interface, Log, Slave};
use pounding::variables::{Settings, Slot, Table, Value};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

struct Counting;

thread_local! {
    /// Of this thread alone: the thread of the test harness allocates whenever it likes.
    static CALLS: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: every call goes to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // A thread that is ending has no count any more.
        let _ = CALLS.try_with(|calls| calls.set(calls.get() + 1));
        // SAFETY: the caller's contract is that of the system's allocator.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: as above.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Peaks of a long flight of modes that damping couples: all instants at which it is searched share a few matrices.
#[test]
fn a_search_needs_no_matrix_for_each_instant() {
    let mut scene = scene(include_str!("problems/peaks/long_coupled_flight.toml"));
    scene.ground.record = Some("r.csv".into());
    let still = pounding::record::Record::new(vec![0.0, 5.0], vec![0.0, 0.0]);
    let calls = [false, true].map(|reads_peaks| {
        let mut run = Run::new(&scene, Some(&still));
        let before = CALLS.get();
        for k in 1..=100 {
            run.to(0.01 * f64::from(k));
            if reads_peaks {
                run.peak(pounding::engine::PeakOf::Drift(BuildingId::RIGHT, 1));
            }
        }
        CALLS.get() - before
    });
    // Measured: 18,790 and 21,468; a matrix takes some hundred, and each read has its own for what is shown.
    assert!(calls[1] < calls[0] + calls[0] / 2, "{calls:?}");
}

#[test]
fn a_run_allocates_nothing_after_its_start() {
    let building = |mass: f64| {
        format!(
            "mass = [{mass:?}, {mass:?}, {mass:?}]\nstiffness = [2910.0, 2910.0, 2910.0]\ndamping = {{ ratio = 0.01 }}"
        )
    };
    for (law, with_record, forces) in [
        ("law = \"kelvin_voigt_no_tension\"\nstiffness = 1.0e6\nrestitution = 0.6", true, false),
        ("law = \"hertz\"\nstiffness = 1.0e7", true, false),
        ("law = \"hertz\"\nstiffness = 1.0e7", true, true),
        ("law = \"hertz\"\nstiffness = 1.0e7", false, true),
        ("law = \"stereomechanical\"\nrestitution = 0.2", true, false),
        ("law = \"stereomechanical\"\nrestitution = 0.2", false, true),
    ] {
        let contact = |floor| format!("[[contact]]\nleft_floor = {floor}\nright_floor = {floor}\ngap = 0.005\n{law}");
        let text = format!(
            "name = \"A\"\n[inputs]\nfloor_forces = {forces}\n[left]\n{}\n[right]\n{}\n{}\n{}\n[outputs]\nenergy = true",
            building(3.65),
            building(5.0),
            contact(2),
            contact(3)
        );
        let mut scene = scene(&text);
        let motion = record(0.02, &(0..500).map(|k| 3.0 * (f64::from(k) * 0.21).sin()).collect::<Vec<_>>());
        if with_record {
            scene.ground.record = Some("r.csv".into());
        }
        let mut run = Run::new(&scene, with_record.then_some(&motion));
        run.episodes.reserve(10_000);
        // The first reading makes the buffers of the point.
        run.to(0.01);
        let mut rates = PointRates::default();
        run.now().differentiate(&mut rates);
        let before = CALLS.get();
        for k in 2..=1000 {
            run.state.set_ground_acceleration(motion.accelerations[k / 2 % 500]);
            run.state.set_ground_acceleration_rate(f64::from(k as u32 % 3) - 1.0);
            run.state.set_floor_force(BuildingId::LEFT, 1, 0.1 * f64::from(k as u32 % 7));
            run.state.set_floor_force_rate(BuildingId::LEFT, 1, 2.0 - f64::from(k as u32 % 5));
            run.to(k as f64 * 0.01);
            run.now().differentiate(&mut rates);
        }
        let calls = CALLS.get() - before;
        assert!(run.point.impacts > 10, "{law}: {} impacts", run.point.impacts);
        assert_eq!(calls, 0, "{law}, record inside: {with_record}, forces: {forces}");
    }
}

/// Tall buildings, whose windows have prepared rows, and damping that couples modes, for which flights between samples
/// make no matrices.
#[test]
fn many_modes_and_coupled_modes_allocate_nothing_either() {
    let many = |mass: f64, stiffness: f64| {
        let damping = "damping = { rayleigh = { ratio = 0.05, modes = [1, 2] } }";
        format!("mass = {:?}\nstiffness = {:?}\n{damping}", vec![mass; 45], vec![stiffness; 45])
    };
    let coupled = |mass: f64, stiffness: f64| {
        let damping = "damping = { matrix = [[9.0e6, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 3.0e7]] }";
        format!("mass = {:?}\nstiffness = {:?}\n{damping}", vec![mass; 3], vec![stiffness; 3])
    };
    let contact = "[[contact]]\nleft_floor = 3\nright_floor = 3\ngap = 0.001\nlaw = \"hertz\"\nstiffness = 2.0e9";
    for (left, right) in [(many(3e5, 2.5e9), many(4e5, 1.5e9)), (coupled(3e5, 8e7), coupled(4e5, 4e7))] {
        let mut scene = scene(&format!("name = \"A\"\n[left]\n{left}\n[right]\n{right}\n{contact}\n"));
        scene.ground.record = Some("r.csv".into());
        scene.peaks = scene.buildings[0].mass.len() < 45;
        let motion = record(0.01, &(0..800).map(|k| 3.0 * (f64::from(k) * 0.09).sin()).collect::<Vec<_>>());
        let mut run = Run::new(&scene, Some(&motion));
        run.episodes.reserve(10_000);
        run.to(0.01);
        let before = CALLS.get();
        for k in 3..=1800 {
            run.to(0.0043 * f64::from(k));
        }
        assert!(run.point.impacts > 3, "{} impacts", run.point.impacts);
        assert_eq!(CALLS.get() - before, 0);
    }
}

/// Two buildings of that many floors, all of which may collide.
fn facing(floors: usize, law: &str) -> String {
    let building =
        format!("mass = {:?}\nstiffness = {:?}\ndamping = {{ ratio = 0.02 }}", vec![1e5; floors], vec![1e9; floors]);
    let contact = |floor| format!("[[contact]]\nleft_floor = {floor}\nright_floor = {floor}\ngap = 0.1\n{law}\n");
    let contacts: String = (1..=floors).map(contact).collect();
    format!("name = \"T\"\n[inputs]\nfloor_forces = true\n[left]\n{building}\n[right]\n{building}\n{contacts}")
}

/// How often memory is asked for to describe them.
fn calls_of_a_description(floors: usize, law: &str) -> usize {
    let package = Package::from_scene_text(facing(floors, law), ".".as_ref()).unwrap();
    let before = CALLS.get();
    let description = package.model_description(FmiVersion::V2);
    let calls = CALLS.get() - before;
    assert!(description.contains(&format!("contact[{floors}].gap")), "{law}");
    calls
}

/// Where each unknown looks at each contact for each known, twice the floors ask for memory eight times as often.
#[test]
fn describing_twice_the_floors_takes_twice_the_work() {
    for law in ["law = \"linear\"\nstiffness = 1.0e9", "law = \"stereomechanical\"\nrestitution = 0.5"] {
        let [low, tall] = [15, 30].map(|floors| calls_of_a_description(floors, law));
        assert!(tall < 3 * low, "{law}: {low} and {tall} calls");
    }
}

/// Instances of two such buildings: how often memory is asked for when all numbers are set one after the other.
fn calls_of_settings(floors: usize) -> usize {
    let package = Package::from_scene_text(facing(floors, "law = \"hertz\"\nstiffness = 1.0e9"), ".".as_ref()).unwrap();
    let table = Table::of_fmu(&package.scene);
    let settings = Settings::new(package.scene.clone(), None);
    let numbers: Vec<(u32, f64)> = table
        .iter()
        .filter_map(|(reference, row)| match row.slot {
            Slot::Parameter(parameter) => Some((reference, 1.01 * settings.read(parameter).real()?)),
            _ => None,
        })
        .collect();
    let mut slave = Slave::new(package, Interface::V2, Log::new(FmiVersion::V2, false));
    let mut set = |(reference, value): (u32, f64)| slave.set(&[reference], |_| Value::Real(value)).unwrap();
    // The first one takes its own copy of what the scene says.
    set(numbers[0]);
    let before = CALLS.get();
    numbers.iter().for_each(|number| set(*number));
    let calls = CALLS.get() - before;
    assert!(calls <= 4 * numbers.len(), "{calls} calls for {} numbers", numbers.len());
    calls
}

/// A parameter is set in its place and looked at by its own rule: the others have no part in that.
#[test]
fn setting_twice_the_parameters_takes_twice_the_work() {
    let [low, tall] = [15, 30].map(calls_of_settings);
    assert!(tall <= 2 * low, "{low} and {tall} calls");
}
