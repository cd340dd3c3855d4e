//! Many instances, of both versions: side by side and in many threads at once each gives the bits of one alone, and ten
//! thousand leave nothing behind.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "support/linked.rs"]
mod linked;
#[path = "support/scenes.rs"]
mod scenes;

use linked::*;
use pounding::variables::{Slot, Table, Type};
use std::alloc::{GlobalAlloc, Layout, System};
use std::ptr::null_mut;
use std::sync::Barrier;
use std::sync::atomic::{AtomicIsize, AtomicUsize, Ordering::Relaxed};
use std::thread;

struct Counting;

/// Bytes that are held and blocks that are, of all threads.
static HELD: (AtomicIsize, AtomicIsize) = (AtomicIsize::new(0), AtomicIsize::new(0));

// SAFETY: every call goes to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        HELD.0.fetch_add(layout.size().cast_signed(), Relaxed);
        HELD.1.fetch_add(1, Relaxed);
        // SAFETY: the caller's contract is that of the system's allocator.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        HELD.0.fetch_sub(layout.size().cast_signed(), Relaxed);
        HELD.1.fetch_sub(1, Relaxed);
        // SAFETY: as above.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// The Real variables of a table that are computed, and its inputs.
fn references(table: &Table) -> (Vec<u32>, Vec<u32>) {
    let reals = || table.iter().filter(|(_, row)| matches!(row.ty, Type::Real(_)));
    let outputs = reals().filter(|(_, row)| matches!(row.slot, Slot::Output(_))).map(|(vr, _)| vr).collect();
    (outputs, reals().filter(|(_, row)| matches!(row.slot, Slot::Input(_))).map(|(vr, _)| vr).collect())
}

/// FMI 2.0, and FMI 3.0 with the two flags in all ways.
const KINDS: [Option<[bool; 2]>; 5] =
    [None, Some([false, false]), Some([true, false]), Some([false, true]), Some([true, true])];

/// An instance of one of the kinds, with inputs of its own: those of its number.
struct Life {
    c: Component,
    common: Common,
    kind: Option<[bool; 2]>,
    number: u32,
    outputs: Vec<u32>,
    inputs: Vec<u32>,
    /// Of all outputs after each step so far.
    bits: Vec<u64>,
}

impl Drop for Life {
    fn drop(&mut self) {
        // SAFETY: alive, and not used afterwards.
        unsafe { (self.common.free_instance)(self.c) }
    }
}

impl Life {
    fn new(resources: &Resources, kind: Option<[bool; 2]>, number: u32) -> Life {
        let (outputs, inputs) = references(&Table::new(&resources.package.scene));
        let (c, common) = match kind {
            None => (resources.instantiate(), COMMON_2),
            Some([events, early]) => (resources.instantiate_3(&Choices::flags(events, early)), COMMON_3),
        };
        let life = Life { c, common, kind, number, outputs, inputs, bits: Vec::new() };
        // SAFETY: a live component of this thread.
        unsafe {
            if kind.is_none() {
                assert_eq!((fmi2EnterInitializationMode(c), fmi2ExitInitializationMode(c)), (OK, OK));
            } else {
                assert_eq!(fmi3EnterInitializationMode(c, 0, 0.0, 0.0, 0, 0.0), OK);
                assert_eq!(fmi3ExitInitializationMode(c), OK);
            }
        }
        life.leave_event_mode();
        life
    }

    fn leave_event_mode(&self) {
        if self.kind.is_some_and(|[has_event_mode, _]| has_event_mode) {
            // SAFETY: a live component of this thread.
            assert_eq!(unsafe { fmi3EnterStepMode(self.c) }, OK);
        }
    }

    /// Sets all inputs, makes the step of that number and reads all outputs.
    fn step(&mut self, k: u32) {
        let forces: Vec<f64> = (0..self.inputs.len()).map(|i| (f64::from(k + self.number) + i as f64).sin()).collect();
        let mut values = vec![0.0_f64; self.outputs.len()];
        let (inputs, n, forces) = (self.inputs.as_ptr(), self.inputs.len(), forces.as_ptr());
        let (outputs, m, read) = (self.outputs.as_ptr(), self.outputs.len(), values.as_mut_ptr());
        let time = f64::from(k) * 0.01;
        // SAFETY: a live component of this thread, arrays of as many elements as the calls say.
        unsafe {
            if self.kind.is_none() {
                assert_eq!(fmi2SetReal(self.c, inputs, n, forces), OK);
                assert_eq!(fmi2DoStep(self.c, time, 0.01, 1), OK);
                assert_eq!(fmi2GetReal(self.c, outputs, m, read), OK);
            } else {
                assert_eq!(fmi3SetFloat64(self.c, inputs, n, forces, n), OK);
                self.step_over_events(time, time + 0.01);
                assert_eq!(fmi3GetFloat64(self.c, outputs, m, read, m), OK);
            }
        }
        self.bits.extend(values.iter().map(|value| value.to_bits()));
    }

    fn step_over_events(&self, mut now: f64, end: f64) {
        loop {
            let (status, stepped) = step(self.c, now, step_to(now, end));
            assert_eq!(status, OK);
            if stepped.event == 1 {
                // SAFETY: a live component of this thread.
                assert_eq!(unsafe { fmi3EnterEventMode(self.c) }, OK);
                self.leave_event_mode();
            }
            if stepped.early == 0 {
                return assert_eq!(stepped.last, end);
            }
            now = stepped.last;
        }
    }

    fn run(&mut self, steps: std::ops::Range<u32>) {
        steps.for_each(|k| self.step(k));
    }
}

/// A life: made, driven, saved, run on, brought back, run on again, copied through bytes, freed. The bits of all outputs on
/// the way.
fn live(resources: &Resources, kind: Option<[bool; 2]>, number: u32, steps: u32) -> Vec<u64> {
    let mut life = Life::new(resources, kind, number);
    let (c, Common { record, restore, deserialize, free, .. }) = (life.c, life.common);
    let mut state = null_mut();
    life.run(0..steps);
    // SAFETY: a live component of this thread, room for what the calls write.
    unsafe {
        assert_eq!(record(c, &raw mut state), OK);
        life.run(steps..2 * steps);
        assert_eq!(restore(c, state), OK);
        life.run(steps..2 * steps);
        let bytes = life.common.bytes(c, state);
        assert_eq!(deserialize(c, bytes.as_ptr(), bytes.len(), &raw mut state), OK);
        // Every other one leaves its snapshot to the instance.
        if number.is_multiple_of(2) {
            assert_eq!(free(c, &raw mut state), OK);
        }
    }
    std::mem::take(&mut life.bits)
}

/// One test, for the other would count what this one holds.
#[test]
fn many_instances() {
    let resources = Resources::new(scenes::SCENE);
    side_by_side_they_give_the_bits_of_one(&resources);
    threads_give_the_bits_of_one(&resources);
    ten_thousand_leave_nothing(&resources);
}

/// All kinds in one thread, step by step in turn.
fn side_by_side_they_give_the_bits_of_one(resources: &Resources) {
    const STEPS: u32 = 60;
    let mut alone = Life::new(resources, None, 7);
    alone.run(0..STEPS);
    let mut lives = KINDS.map(|kind| Life::new(resources, kind, 7));
    let mut other = Life::new(resources, None, 8);
    for k in 0..STEPS {
        lives.iter_mut().for_each(|life| life.step(k));
        other.step(k);
    }
    lives.iter().for_each(|life| assert!(life.bits == alone.bits, "{:?}", life.kind));
    assert!(other.bits != alone.bits, "each life is one of its own");
}

fn threads_give_the_bits_of_one(resources: &Resources) {
    const THREADS: usize = 8;
    const LIVES: u32 = 25;
    let alone: Vec<_> = (0..LIVES).map(|number| live(resources, None, number, 20)).collect();
    assert_ne!(alone[0], alone[1], "each life is one of its own");
    let different = AtomicUsize::new(0);
    let together = Barrier::new(THREADS);
    let work = |first: usize| {
        together.wait();
        for k in 0..LIVES {
            // Each number is lived by every kind.
            let (number, kind) = ((k + first as u32) % LIVES, KINDS[first % KINDS.len()]);
            if live(resources, kind, number, 20) != alone[number as usize] {
                different.fetch_add(1, Relaxed);
            }
        }
    };
    thread::scope(|scope| {
        (0..THREADS).for_each(|first| {
            drop(scope.spawn({
                let work = &work;
                move || work(first)
            }))
        })
    });
    assert_eq!(different.into_inner(), 0, "of {} lives", THREADS as u32 * LIVES);
}

fn ten_thousand_leave_nothing(resources: &Resources) {
    // What is made once in a process is made now.
    (0..100).for_each(|number| drop(live(resources, KINDS[number as usize % KINDS.len()], number, 1)));
    let held = || (HELD.0.load(Relaxed), HELD.1.load(Relaxed));
    let (before, resident) = (held(), resident_kilobytes());
    (0..10_000).for_each(|number| drop(live(resources, KINDS[number as usize % KINDS.len()], number, 1)));
    let (bytes, blocks) = (held().0 - before.0, held().1 - before.1);
    // The harness may hold a few more or less; a byte each would be ten thousand.
    assert!(bytes.abs() < 5_000 && blocks.abs() < 100, "{bytes} bytes in {blocks} blocks");
    let grown = resident_kilobytes().saturating_sub(resident);
    assert!(grown < 2_000, "{grown} kB of memory more");
}

/// Physical memory of this process; 0 where the system does not tell.
fn resident_kilobytes() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    line.and_then(|line| line.split_whitespace().next()?.parse().ok()).unwrap_or_default()
}
