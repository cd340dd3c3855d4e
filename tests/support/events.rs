//! What FMI 3.0 has alone: Event Mode, early returns, turns of the master within steps.

use super::{Instance, OK, Stepped, Turn, step};
use pounding::fmi::*;
use std::ffi::c_int;

impl Instance<'_> {
    /// A step, and all that it has written.
    pub fn stepped(&self, current: f64, length: f64) -> (c_int, Stepped) {
        step(self.component, current, length)
    }

    /// `fmi3UpdateDiscreteStates`: status, Booleans in the order of the arguments, time.
    pub fn update(&self) -> (c_int, [u8; 5], f64) {
        let (mut flags, mut next) = ([77; 5], -77.0);
        let [need, terminate, nominals, values, defined] = &mut flags;
        // SAFETY: a live instance and places for the results.
        let status = unsafe {
            fmi3UpdateDiscreteStates(self.component, need, terminate, nominals, values, defined, &raw mut next)
        };
        (status, flags, next)
    }

    /// Through Event Mode and back.
    pub fn handle(&self) {
        self.calls(&[fmi3EnterEventMode]);
        assert_eq!(self.update().0, OK);
        self.calls(&[fmi3EnterStepMode]);
    }

    /// Does something in each turn that a step gives, from now on; not in turns within turns.
    pub fn in_turns(&self, turn: impl FnMut(Turn) + 'static) {
        *self.log.on_update.borrow_mut() = Some(Box::new(turn));
    }
}
