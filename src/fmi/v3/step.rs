//! The communication step, and the turns that it gives the master.

use super::types::Boolean;
use crate::FmiVersion::V3;
use crate::fmi::common::arguments::{Place, boolean};
use crate::fmi::common::fence::{Function, go_on, v3, with_instance};
use crate::fmi::common::instance::{Instance, is_given_up, lend};
use crate::fmi::common::types::Component;
use crate::fmi::common::updater::Updater;
use crate::slave::{Call, Refusal, Status, StepPart, Update};
use std::ffi::c_int;

const STEP: Function = v3(Call::DoStep);

/// What the master says about its plans for earlier states is not used.
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
    // SAFETY: as the module says; nothing of the instance is borrowed where the master has its turn.
    unsafe {
        lend(c, || {
            let (mut results, mut turn) = (None, None);
            let mut status = with_instance(c, STEP, |instance| {
                boolean(V3, "noSetFMUStatePriorToCurrentPoint", no_set_state_before)?;
                let results = results.insert(Results {
                    event: Place::new("eventHandlingNeeded", event_handling_needed)?,
                    terminate: Place::new("terminateSimulation", terminate_simulation)?,
                    early: Place::new("earlyReturn", early_return)?,
                    last: Place::new("lastSuccessfulTime", last_successful_time)?,
                });
                let part = instance.slave.begin_step(current, step);
                results.settle(instance, part, &mut turn)
            });
            while let (Some((updater, update)), Some(results)) = (turn.take(), &results) {
                if !is_given_up(c) {
                    updater.call(update);
                }
                if is_given_up(c) {
                    return Status::Error as c_int;
                }
                status = go_on(c, STEP, |instance| {
                    let part = instance.slave.go_on();
                    results.settle(instance, part, &mut turn)
                });
            }
            status
        })
    }
}

/// The places for what a step has come to.
struct Results {
    event: Place<Boolean>,
    terminate: Place<Boolean>,
    early: Place<Boolean>,
    last: Place<f64>,
}

impl Results {
    /// Notes the turn that a part of a step has come to, or else writes the results: after a step that the engine has given
    /// up too, since the time that it has reached is among them.
    ///
    /// # Safety
    /// As for [`Place::write`].
    unsafe fn settle(
        &self,
        instance: &Instance,
        part: Result<StepPart, Refusal>,
        turn: &mut Option<(Updater, Update)>,
    ) -> Result<Status, Refusal> {
        let stepped = match part {
            Ok(StepPart::Update(update)) => {
                *turn = instance.updater.map(|updater| (updater, update));
                return Ok(Status::Ok);
            }
            Ok(StepPart::Done(stepped)) => Ok(stepped),
            Err(refusal) => Err(refusal),
        };
        let (needs_event_mode, is_early) =
            stepped.as_ref().map_or((false, false), |step| (step.needs_event_mode, step.is_early));
        // SAFETY: the caller's promise.
        unsafe {
            self.event.write(needs_event_mode.into());
            self.early.write(is_early.into());
            self.terminate.write(instance.slave.is_over().into());
            self.last.write(instance.slave.last_successful_time());
        }
        stepped.map(|step| step.status)
    }
}
