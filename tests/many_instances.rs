//! Many instances: in many threads at once each gives the bits of one thread, and ten thousand leave nothing behind.
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

/// A life: made, driven with inputs of its own, saved, run on, brought back, run on again, copied through bytes, freed.
/// The bits of all outputs on the way.
fn live(resources: &Resources, number: u32, steps: u32) -> Vec<u64> {
    let (outputs, inputs) = references(&Table::new(&resources.package.scene));
    let c = resources.instantiate();
    let mut bits = Vec::new();
    let mut values = vec![0.0_f64; outputs.len()];
    let mut run = |from: u32| {
        for k in from..from + steps {
            let forces: Vec<f64> = (0..inputs.len()).map(|i| (f64::from(k + number) + i as f64).sin()).collect();
            // SAFETY: a live component of this thread, arrays of as many elements as the calls say.
            unsafe {
                assert_eq!(fmi2SetReal(c, inputs.as_ptr(), inputs.len(), forces.as_ptr()), OK);
                assert_eq!(fmi2DoStep(c, f64::from(k) * 0.01, 0.01, 1), OK);
                assert_eq!(fmi2GetReal(c, outputs.as_ptr(), outputs.len(), values.as_mut_ptr()), OK);
            }
            bits.extend(values.iter().map(|value| value.to_bits()));
        }
    };
    let (mut state, mut size) = (null_mut(), 0);
    // SAFETY: a live component of this thread, room for what the calls write.
    unsafe {
        assert_eq!(fmi2EnterInitializationMode(c), OK);
        assert_eq!(fmi2ExitInitializationMode(c), OK);
        run(0);
        assert_eq!(fmi2GetFMUstate(c, &raw mut state), OK);
        run(steps);
        assert_eq!(fmi2SetFMUstate(c, state), OK);
        run(steps);
        assert_eq!(fmi2SerializedFMUstateSize(c, state, &raw mut size), OK);
        let mut bytes = vec![0; size];
        assert_eq!(fmi2SerializeFMUstate(c, state, bytes.as_mut_ptr(), size), OK);
        assert_eq!(fmi2DeSerializeFMUstate(c, bytes.as_ptr(), size, &raw mut state), OK);
        // Every other one leaves its snapshot to the instance.
        if number.is_multiple_of(2) {
            assert_eq!(fmi2FreeFMUstate(c, &raw mut state), OK);
        }
        fmi2FreeInstance(c);
    }
    bits
}

/// One test, for the other would count what this one holds.
#[test]
fn many_instances() {
    let resources = Resources::new(scenes::SCENE);
    threads_give_the_bits_of_one(&resources);
    ten_thousand_leave_nothing(&resources);
}

fn threads_give_the_bits_of_one(resources: &Resources) {
    const THREADS: usize = 8;
    const LIVES: u32 = 25;
    let alone: Vec<_> = (0..LIVES).map(|number| live(resources, number, 20)).collect();
    assert_ne!(alone[0], alone[1], "each life is one of its own");
    let different = AtomicUsize::new(0);
    let together = Barrier::new(THREADS);
    let work = |first: usize| {
        together.wait();
        for k in 0..LIVES {
            let number = (k + first as u32) % LIVES;
            if live(resources, number, 20) != alone[number as usize] {
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
    (0..100).for_each(|number| drop(live(resources, number, 1)));
    let held = || (HELD.0.load(Relaxed), HELD.1.load(Relaxed));
    let (before, resident) = (held(), resident_kilobytes());
    (0..10_000).for_each(|number| drop(live(resources, number, 1)));
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
