//! The master's function for intermediate updates, of FMI 3.0 alone.

use super::types::ComponentEnvironment;
use crate::slave::Update;

/// `fmi3IntermediateUpdateCallback`: environment, time, whether inputs are asked for, whether outputs can be read, whether an
/// internal step is finished, whether the step can return early, and the two places for what the master wants of that.
pub(in crate::fmi) type IntermediateUpdate =
    unsafe extern "C" fn(ComponentEnvironment, f64, u8, u8, u8, u8, *mut u8, *mut f64);

/// The function with what the master wants to get back at each call.
#[derive(Clone, Copy, Debug)]
pub(in crate::fmi) struct Updater {
    pub function: IntermediateUpdate,
    pub environment: ComponentEnvironment,
}

impl Updater {
    /// Gives the master its turn. Nothing of the instance may be borrowed: the master calls back into the FMU. Steps return
    /// early at events and for nothing else, so what it writes into the two places is not looked at.
    ///
    /// # Safety
    /// The function must be callable with the environment.
    pub(in crate::fmi) unsafe fn call(self, update: Update) {
        let (sets, reads) = (update.sets_inputs.into(), (!update.sets_inputs).into());
        let (mut requested, mut time) = (0, update.time);
        // SAFETY: the caller's promise; the places live until the call returns.
        unsafe {
            (self.function)(self.environment, update.time, sets, reads, reads, 0, &raw mut requested, &raw mut time)
        };
    }
}
