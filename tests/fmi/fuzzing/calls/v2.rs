//! Sequences of calls of FMI 2.0.

use super::{Again, Functions, POINTS, Session, Shared, bits, experiment, planned_step};
use super::{Error, Initialization, Instantiated, MOST_CALLS, StepComplete, Terminated};
use crate::linked::*;
use crate::two_and_three_storeys::CALLS;
use pounding::variables::Slot;
use std::ffi::c_int;
use std::ptr::null;
use std::sync::OnceLock;

const FUNCTIONS: Functions = Functions {
    common: COMMON_2,
    directional: |c, unknown, known, change| {
        (COMMON_2.directional)(c, &[unknown], &[known], &[1.0], std::slice::from_mut(change))
    },
    to_read: &[Initialization, StepComplete, Terminated, Error],
    to_set: &[Instantiated, Initialization, StepComplete],
    to_differentiate: &[StepComplete, Terminated, Error],
};

fn shared() -> &'static Shared {
    static SHARED: OnceLock<Shared> = OnceLock::new();
    SHARED.get_or_init(|| {
        Shared::new(CALLS, |shared| {
            let component = shared.resources.instantiate();
            let bits = run(component, shared);
            // SAFETY: alive, and not used afterwards.
            unsafe { fmi2FreeInstance(component) };
            bits
        })
    })
}

/// The bits of a short run with impacts.
fn run(c: Component, shared: &Shared) -> Vec<(String, u64)> {
    let mut all = Vec::new();
    // SAFETY: a live component.
    unsafe {
        assert_eq!(fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0), OK);
        assert_eq!(fmi2EnterInitializationMode(c), OK);
        assert_eq!(fmi2ExitInitializationMode(c), OK);
        for points in POINTS.windows(2) {
            assert_eq!(fmi2DoStep(c, points[0], points[1] - points[0], 1), OK);
            all.extend(bits(c, &FUNCTIONS, &shared.table));
        }
    }
    all
}

/// Panics where a call returns what the model does not expect, or where the instance or a reset is not at the bits of a
/// fresh one.
pub fn check(first: u8, calls: &[u8]) {
    let shared = shared();
    let mut session = Session::new(shared.resources.instantiate(), shared, &FUNCTIONS, first % 2 == 1);
    calls.chunks_exact(2).take(MOST_CALLS).for_each(|call| session.call(call[0], call[1]));
    session.do_again();
    // SAFETY: alive, and not used after its end.
    unsafe {
        assert_eq!(fmi2Reset(session.c), OK);
        assert!(run(session.c, shared) == shared.reference, "after a reset: not the bits of a fresh instance");
        fmi2FreeInstance(session.c);
    }
}

impl Session {
    #[rustfmt::skip] // a table
    fn call(&mut self, call: u8, argument: u8) {
        let slot = usize::from(argument % 2);
        match call % 20 {
            0 => self.setup(argument),
            1 => drop(self.change("enter", &[Instantiated], Initialization, fmi2EnterInitializationMode)),
            2 => drop(self.change("exit", &[Initialization], StepComplete, fmi2ExitInitializationMode)),
            3 if argument.is_multiple_of(4) => drop(self.change("terminate", &[StepComplete], Terminated, fmi2Terminate)),
            3 => {}
            4 if argument.is_multiple_of(4) => self.reset(0),
            4 => drop(self.change("cancel", &[], Error, fmi2CancelStep)),
            5 => self.get(argument),
            6 | 7 => self.set_real(argument, call),
            8 => self.set_others(argument),
            9..=11 => self.step(argument),
            12 => self.status(argument),
            13 => self.record(slot),
            14 => self.restore(slot),
            15 => self.free(slot),
            16 => self.copy(slot),
            17 => self.derivatives(argument),
            18 => self.directional(argument),
            _ => self.logging(argument),
        }
    }

    fn setup(&mut self, argument: u8) {
        let (start, stop, is_good) = experiment(argument);
        let expected = if is_good { self.is_in(&[Instantiated]) } else { ERROR };
        let with_stop = c_int::from(stop.is_some());
        // SAFETY: a live component.
        let call = move |c| unsafe { fmi2SetupExperiment(c, 0, 0.0, start, with_stop, stop.unwrap_or_default()) };
        if self.act("setup", expected, call) {
            (self.known.model.time, self.known.model.stop) = (start, stop);
        }
    }

    /// No variable of these types can be set here; nothing can be set to nothing.
    fn set_others(&mut self, argument: u8) {
        let (vr, n) = (u32::from(argument / 8), usize::from(argument / 4 % 2));
        let expected = if n == 0 { self.is_in(FUNCTIONS.to_set) } else { ERROR };
        self.expect("set others", expected, |c| {
            // SAFETY: a live component, one element.
            unsafe {
                match argument % 4 {
                    0 => fmi2SetInteger(c, &raw const vr, n, &0),
                    1 => fmi2SetBoolean(c, &raw const vr, n, &1),
                    2 => fmi2SetString(c, &raw const vr, n, &c"x".as_ptr()),
                    _ => fmi2SetReal(c, null(), n, &0.0),
                }
            }
        });
    }

    fn step(&mut self, argument: u8) {
        let (current, length, is_good) = planned_step(&self.known.model, argument);
        let expected = if is_good { self.is_in(&[StepComplete]) } else { ERROR };
        // SAFETY: a live component.
        if self.act("step", expected, move |c| unsafe { fmi2DoStep(c, current, length, 0) }) {
            self.known.model.time = current + length;
        }
    }

    fn status(&mut self, argument: u8) {
        let kind = c_int::from(argument / 8 % 6) - 1;
        let allowed = self.is_in(&[StepComplete, Terminated]);
        let time = self.known.model.time;
        let function = argument % 5;
        let expected = match (allowed, function, kind) {
            (OK, 1, 2) | (OK, 3, 3) => OK,
            (OK, _, 0..=3) => DISCARD,
            _ => ERROR,
        };
        self.expect(&format!("status {function} {kind}"), expected, |c| {
            let (mut real, mut integer, mut text) = (f64::NAN, -1, null());
            // SAFETY: a live component, room for one element.
            let status = unsafe {
                match function {
                    0 => fmi2GetStatus(c, kind, &raw mut integer),
                    1 => fmi2GetRealStatus(c, kind, &raw mut real),
                    2 => fmi2GetIntegerStatus(c, kind, &raw mut integer),
                    3 => fmi2GetBooleanStatus(c, kind, &raw mut integer),
                    _ => fmi2GetStringStatus(c, kind, &raw mut text),
                }
            };
            assert!(status != OK || real.to_bits() == time.to_bits() || integer == 0, "{real} at {time}");
            status
        });
    }

    /// Of inputs, or of outputs.
    fn derivatives(&mut self, argument: u8) {
        if !(argument / 2).is_multiple_of(2) {
            return self.output_derivative(argument);
        }
        let table = &self.shared.table;
        let (vr, order) = (u32::from(argument / 4) % (table.time_reference() + 1), c_int::from(argument % 2));
        let is_good = matches!(table.row(vr).map(|row| row.slot), Some(Slot::Input(_))) && order == 1;
        let expected = if is_good { self.is_in(FUNCTIONS.to_set) } else { ERROR };
        // SAFETY: a live component, one element.
        let call = move |c| unsafe { fmi2SetRealInputDerivatives(c, &raw const vr, 1, &raw const order, &5.0) };
        self.act("input derivative", expected, call);
    }

    /// The calls that were accepted, in a fresh instance: it comes to the same bits.
    fn do_again(&self) {
        // After an error this one can be read, and the other perhaps not.
        if self.is_in(&[Initialization, StepComplete, Terminated]) == OK {
            let mut again = Again::new(self.shared.resources.instantiate(), true);
            self.compare(&mut again);
            // SAFETY: alive, and not used afterwards.
            unsafe { fmi2FreeInstance(again.c) };
        }
    }
}
