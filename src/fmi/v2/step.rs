//! Functions of co-simulation: the step and its status.

use super::types::Boolean;
use crate::fmi::common::arguments::store;
use crate::fmi::common::fence::{v2, with_instance};
use crate::fmi::common::types::{Component, Text};
use crate::slave::{Call, Refusal, Status, StatusKind};
use std::ffi::c_int;

/// What the master says about its plans for earlier states is not used: masters say it wrongly.
#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2DoStep(c: Component, current: f64, step: f64, _no_set_state_before: Boolean) -> c_int {
    // SAFETY: as the module says.
    unsafe {
        with_instance(c, v2(Call::DoStep), |instance| instance.slave.do_step(current, step).map(|step| step.status))
    }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2GetStatus(c: Component, kind: c_int, _value: *mut c_int) -> c_int {
    // SAFETY: as the module says.
    unsafe {
        with_instance(c, v2(Call::GetStatus), |instance| {
            Ok(instance.slave.no_status(Call::GetStatus, status_kind(kind)?))
        })
    }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2GetRealStatus(c: Component, kind: c_int, value: *mut f64) -> c_int {
    // SAFETY: as the module says.
    unsafe {
        with_instance(c, v2(Call::GetRealStatus), |instance| match status_kind(kind)? {
            StatusKind::LastSuccessfulTime => {
                store("value", value, instance.slave.last_successful_time()).map(Status::from)
            }
            other => Ok(instance.slave.no_status(Call::GetRealStatus, other)),
        })
    }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2GetIntegerStatus(c: Component, kind: c_int, _value: *mut c_int) -> c_int {
    // SAFETY: as the module says.
    unsafe {
        with_instance(c, v2(Call::GetIntegerStatus), |instance| {
            Ok(instance.slave.no_status(Call::GetIntegerStatus, status_kind(kind)?))
        })
    }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2GetBooleanStatus(c: Component, kind: c_int, value: *mut Boolean) -> c_int {
    // SAFETY: as the module says.
    unsafe {
        with_instance(c, v2(Call::GetBooleanStatus), |instance| match status_kind(kind)? {
            StatusKind::Terminated => store("value", value, Boolean::from(instance.slave.is_over())).map(Status::from),
            other => Ok(instance.slave.no_status(Call::GetBooleanStatus, other)),
        })
    }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2GetStringStatus(c: Component, kind: c_int, _value: *mut Text) -> c_int {
    // SAFETY: as the module says.
    unsafe {
        with_instance(c, v2(Call::GetStringStatus), |instance| {
            Ok(instance.slave.no_status(Call::GetStringStatus, status_kind(kind)?))
        })
    }
}

/// For asynchronous steps, which the description does not declare: no step is ever in progress.
#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2CancelStep(c: Component) -> c_int {
    let refusal = || Refusal::from("this FMU does not declare canRunAsynchronuously".to_owned());
    // SAFETY: as the module says.
    unsafe { with_instance::<()>(c, v2(Call::CancelStep), |_| Err(refusal())) }
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
