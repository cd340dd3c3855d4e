//! Snapshots keep no memory that nobody has: not after they are freed, not after their instance has ended.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "support/scenes.rs"]
mod scenes;

use pounding::slave::{Log, Slave};
use pounding::variables::{Table, Value};
use scenes::{RECORD_SCENE, package};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

struct Counting;

thread_local! {
    /// Bytes, of this thread alone.
    static HELD: Cell<isize> = const { Cell::new(0) };
}

fn note(bytes: usize, sign: isize) {
    // A thread that is ending has no count any more.
    let _ = HELD.try_with(|held| held.set(held.get() + sign * bytes.cast_signed()));
}

// SAFETY: every call goes to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        note(layout.size(), 1);
        // SAFETY: the caller's contract is that of the system's allocator.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        note(layout.size(), -1);
        // SAFETY: as above.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn in_motion() -> Slave {
    let mut slave =
        Slave::new(package(RECORD_SCENE), pounding::slave::Interface::V2, Log::new(pounding::FmiVersion::V2, false));
    let rows = Table::new(&package(RECORD_SCENE).scene).rows;
    let gap = rows.iter().position(|row| row.name == "contact[1].gap").unwrap();
    slave.set(&[u32::try_from(gap).unwrap()], |_| Value::Real(0.002)).unwrap();
    slave.enter_initialization();
    slave.exit_initialization().unwrap();
    slave.do_step(0.0, 0.7).unwrap();
    slave
}

#[test]
fn ten_thousand_snapshots_leave_nothing_behind() {
    let mut slave = in_motion();
    let cycle = |slave: &mut Slave, k: u32| {
        let state = slave.record_state(None).unwrap();
        assert_eq!(slave.record_state(Some(state)), Ok(state));
        slave.restore_state(Some(state)).unwrap();
        if k.is_multiple_of(100) {
            let bytes = slave.serialize_state(Some(state)).unwrap();
            // The gap is no longer what it was: the copy has a model of its own.
            slave.reset();
            let copy = slave.deserialize_state(&bytes, None).unwrap();
            slave.restore_state(Some(copy)).unwrap();
            slave.free_state(Some(copy)).unwrap();
        }
        slave.free_state(Some(state)).unwrap();
    };
    cycle(&mut slave, 0);
    let before = HELD.get();
    for k in 1..=10_000 {
        cycle(&mut slave, k);
    }
    let kept = HELD.get() - before;
    assert_eq!(kept, 0, "bytes");
}

#[test]
fn an_instance_takes_its_snapshots_with_it() {
    // What is made once in a process is made now.
    drop(in_motion());
    let before = HELD.get();
    let mut slave = in_motion();
    let alone = HELD.get() - before;
    for _ in 0..100 {
        slave.record_state(None).unwrap();
    }
    assert!(HELD.get() - before > alone + 100 * 500, "snapshots take memory");
    slave.reset();
    drop(slave);
    assert_eq!(HELD.get() - before, 0, "bytes");
}
