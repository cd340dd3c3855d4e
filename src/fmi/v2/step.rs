//! Functions of co-simulation: the step and its status.

use super::types::Boolean;
use crate::fmi::common::arguments::store;
use crate::fmi::common::fence::functions;
use crate::fmi::common::instance::Instance;
use crate::fmi::common::types::Text;
use crate::slave::{Call, Refusal, Status, StatusKind};
use std::ffi::c_int;

functions! { v2:
    /// What the master says about its plans for earlier states is not used: masters say it wrongly.
    fmi2DoStep = DoStep(current: f64, step: f64, _no_set_state_before: Boolean) |instance| {
        instance.slave.do_step(current, step).map(|step| step.status)
    };
    fmi2GetStatus = GetStatus(kind: c_int, _value: *mut c_int) |instance| {
        no_status(instance, Call::GetStatus, status_kind(kind)?)
    };
    fmi2GetRealStatus = GetRealStatus(kind: c_int, value: *mut f64) |instance| match status_kind(kind)? {
        StatusKind::LastSuccessfulTime => {
            store("value", value, instance.slave.last_successful_time()).map(Status::from)
        }
        other => no_status(instance, Call::GetRealStatus, other),
    };
    fmi2GetIntegerStatus = GetIntegerStatus(kind: c_int, _value: *mut c_int) |instance| {
        no_status(instance, Call::GetIntegerStatus, status_kind(kind)?)
    };
    fmi2GetBooleanStatus = GetBooleanStatus(kind: c_int, value: *mut Boolean) |instance| match status_kind(kind)? {
        StatusKind::Terminated => store("value", value, Boolean::from(instance.slave.is_over())).map(Status::from),
        other => no_status(instance, Call::GetBooleanStatus, other),
    };
    fmi2GetStringStatus = GetStringStatus(kind: c_int, _value: *mut Text) |instance| {
        no_status(instance, Call::GetStringStatus, status_kind(kind)?)
    };
    /// For asynchronous steps, which the description does not declare: no step is ever in progress.
    fmi2CancelStep = CancelStep() |_instance| {
        Err::<(), _>(Refusal::from("this FMU does not declare canRunAsynchronuously".to_owned()))
    };
}

fn no_status(instance: &mut Instance, call: Call, kind: StatusKind) -> Result<Status, Refusal> {
    Ok(instance.slave.no_status(call, kind))
}

/// `fmi2StatusKind`
fn status_kind(value: c_int) -> Result<StatusKind, Refusal> {
    match value {
        0 => Ok(StatusKind::DoStepStatus),
        1 => Ok(StatusKind::PendingStatus),
        2 => Ok(StatusKind::LastSuccessfulTime),
        3 => Ok(StatusKind::Terminated),
        _ => Err(Refusal::from(format!("fmi2StatusKind {value}: expected 0 to 3"))),
    }
}
