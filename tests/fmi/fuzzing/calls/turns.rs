//! Turns of the master within steps of FMI 3.0, which read, set, call what they may not, or free the instance.

use super::{Shared, bits, v3::FUNCTIONS};
use crate::linked::*;
use pounding::variables::Slot;
use std::any::Any;
use std::cell::{Cell, RefCell};
use std::ffi::{c_int, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::ptr::null_mut;

/// What is done in the turns of a step, and what has come of it.
pub struct Turns {
    c: Cell<Component>,
    pub shared: Cell<Option<&'static Shared>>,
    /// Which call, with which arguments.
    plan: Cell<u8>,
    only_legal: Cell<bool>,
    /// For calls that have no place in a turn.
    state: Cell<State>,
    /// Inputs at the end of the step: those that are to be set, and those that have been.
    pub ends: RefCell<Vec<(u32, f64)>>,
    is_busy: Cell<bool>,
    pub has_failed: Cell<bool>,
    pub is_freed: Cell<bool>,
    panic: Cell<Option<Box<dyn Any + Send>>>,
}

impl Default for Turns {
    fn default() -> Turns {
        Turns {
            c: Cell::new(null_mut()),
            shared: Cell::default(),
            plan: Cell::default(),
            only_legal: Cell::new(true),
            state: Cell::new(null_mut()),
            ends: RefCell::default(),
            is_busy: Cell::default(),
            has_failed: Cell::default(),
            is_freed: Cell::default(),
            panic: Cell::default(),
        }
    }
}

impl Turns {
    pub fn environment(&self) -> *mut c_void {
        std::ptr::from_ref(self).cast_mut().cast()
    }

    /// What to do in the turns of the next step.
    pub fn prepare(&self, plan: u8, only_legal: bool, state: State) {
        self.plan.set(plan);
        self.only_legal.set(only_legal);
        self.state.set(state);
        self.ends.take();
    }

    /// Makes a step.
    pub fn step(&self, c: Component, current: f64, length: f64) -> (c_int, Stepped) {
        self.c.set(c);
        self.has_failed.set(false);
        let found = step(c, current, length);
        if let Some(panic) = self.panic.take() {
            resume_unwind(panic);
        }
        found
    }

    fn take(&self, sets: bool) {
        assert!(!self.has_failed.get(), "a turn after a call that has failed");
        let (c, plan, Some(shared)) = (self.c.get(), self.plan.get(), self.shared.get()) else { return };
        for &(vr, value) in &*self.ends.borrow() {
            if sets {
                assert_eq!((COMMON_3.set_reals)(c, &[vr], &[value]), OK);
            }
        }
        match plan % 8 {
            2 | 3 => drop(bits(c, &FUNCTIONS, &shared.table)),
            4 | 5 if sets => self.set(c, shared, plan / 8),
            4 | 5 if !self.only_legal.get() => self.fail((COMMON_3.set_reals)(c, &[shared.find(GROUND)], &[1.0])),
            6 if !self.only_legal.get() => self.misuse(c, shared, plan / 8),
            7 if !self.only_legal.get() && plan / 8 > 24 => self.free(c),
            7 => {
                let mut rate = [f64::NAN];
                let vr = shared.find("left.displacement[1]");
                assert_eq!((COMMON_3.output_derivatives)(c, &[vr], &[1], &mut rate), OK);
                assert!(rate[0].is_finite());
            }
            _ => {}
        }
    }

    /// An input at the end of the step.
    fn set(&self, c: Component, shared: &Shared, which: u8) {
        let inputs = shared.table.iter().filter(|(_, row)| matches!(row.slot, Slot::Input(_)));
        let inputs: Vec<u32> = inputs.map(|(vr, _)| vr).collect();
        let end = (inputs[usize::from(which) % inputs.len()], 3.0 + f64::from(which) / 100.0);
        assert_eq!((COMMON_3.set_reals)(c, &[end.0], &[end.1]), OK);
        self.ends.borrow_mut().push(end);
    }

    fn fail(&self, status: c_int) {
        assert_eq!(status, ERROR);
        self.has_failed.set(true);
    }

    /// A call that has no place in a turn, and then those that an instance takes after an error.
    fn misuse(&self, c: Component, shared: &Shared, which: u8) {
        let (mut place, state) = (null_mut(), self.state.get());
        // SAFETY: a live component, places for what is written; states are never followed.
        unsafe {
            self.fail(match which % 8 {
                0 => step(c, 0.0, 0.01).0,
                1 => fmi3GetFMUState(c, &raw mut place),
                2 => fmi3Reset(c),
                3 => fmi3Terminate(c),
                4 => (COMMON_3.set_reals)(c, &[shared.find(GROUND)], &[f64::NAN]),
                5 => (COMMON_3.set_reals)(c, &[shared.find("left.mass[1]")], &[1.0]),
                6 => fmi3SetFMUState(c, state),
                _ => fmi3EnterEventMode(c),
            });
            match which / 8 {
                0 => {}
                1 => assert_eq!(fmi3Reset(c), OK),
                more => {
                    fmi3SetFMUState(c, state);
                    let mut now = [0.0];
                    assert_eq!((COMMON_3.get_reals)(c, &[shared.table.time_reference()], &mut now), OK);
                    step(c, now[0], 0.01);
                    if more == 3 {
                        self.free(c);
                    }
                }
            }
        }
    }

    fn free(&self, c: Component) {
        // SAFETY: alive, and not used afterwards by the test.
        unsafe { fmi3FreeInstance(c) };
        self.is_freed.set(true);
        self.has_failed.set(true);
    }
}

const GROUND: &str = "ground.acceleration";

/// `fmi3IntermediateUpdateCallback`; it asks to return early, which nothing may come of.
pub unsafe extern "C" fn update(
    environment: *mut c_void,
    time: f64,
    sets: u8,
    gets: u8,
    is_finished: u8,
    can_return: u8,
    requested: *mut u8,
    early_return_time: *mut f64,
) {
    // SAFETY: the environment that was given at instantiation, and places for two values.
    let turns = unsafe {
        (*requested, *early_return_time) = (1, time);
        &*environment.cast::<Turns>()
    };
    if turns.is_busy.replace(true) {
        return; // a turn of a step within a turn
    }
    let result = catch_unwind(AssertUnwindSafe(|| {
        assert_eq!((sets + gets, is_finished, can_return), (1, gets, 0));
        turns.take(sets == 1);
    }));
    turns.panic.set(result.err().or(turns.panic.take()));
    turns.is_busy.set(false);
}
