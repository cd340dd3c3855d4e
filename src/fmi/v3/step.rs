//! The communication step.

use super::types::Boolean;
use crate::FmiVersion::V3;
use crate::fmi::common::arguments::{Place, boolean};
use crate::fmi::common::fence::{v3, with_instance};
use crate::fmi::common::types::Component;
use crate::slave::Call;
use std::ffi::c_int;

/// What the master says about its plans for earlier states is not used. The results are written after a step that the
/// engine has given up too: the time that it has reached is among them.
#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi3DoStep(
    c: Component,
    current: f64,
    step: f64,
    no_set_state_before: Boolean,
    event_handling_needed: *mut Boolean,
    terminate_simulation: *mut Boolean,
    early_return: *mut Boolean,
    last_successful_time: *mut f64,
) -> c_int {
    // SAFETY: as the module says.
    unsafe {
        with_instance(c, v3(Call::DoStep), |instance| {
            boolean(V3, "noSetFMUStatePriorToCurrentPoint", no_set_state_before)?;
            let event = Place::new("eventHandlingNeeded", event_handling_needed)?;
            let terminate = Place::new("terminateSimulation", terminate_simulation)?;
            let early = Place::new("earlyReturn", early_return)?;
            let last = Place::new("lastSuccessfulTime", last_successful_time)?;
            let result = instance.slave.do_step(current, step);
            let stepped = result.as_ref();
            event.write(stepped.is_ok_and(|step| step.needs_event_mode).into());
            early.write(stepped.is_ok_and(|step| step.is_early).into());
            terminate.write(instance.slave.is_over().into());
            last.write(instance.slave.last_successful_time());
            result.map(|step| step.status)
        })
    }
}
