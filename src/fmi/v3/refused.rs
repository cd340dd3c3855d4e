//! What these FMUs do not offer: each answers with an error and the reason.

use super::types::{Binary, Boolean, Clock, ClockUpdate, DependencyKind, IntervalQualifier, Preemption};
use crate::description::Category;
use crate::fmi::common::fence::refused;
use crate::fmi::common::logger::{LogMessage, Logger};
use crate::fmi::common::types::{Component, ComponentEnvironment, Text, ValueReference};
use crate::slave::Message;
use std::ptr::null_mut;

refused! { v3:
    "this FMU has no variables of this type": {
        fmi3GetFloat32(*const ValueReference, usize, *mut f32, usize);
        fmi3GetInt8(*const ValueReference, usize, *mut i8, usize);
        fmi3GetUInt8(*const ValueReference, usize, *mut u8, usize);
        fmi3GetInt16(*const ValueReference, usize, *mut i16, usize);
        fmi3GetUInt16(*const ValueReference, usize, *mut u16, usize);
        fmi3GetUInt32(*const ValueReference, usize, *mut u32, usize);
        fmi3GetInt64(*const ValueReference, usize, *mut i64, usize);
        fmi3GetUInt64(*const ValueReference, usize, *mut u64, usize);
        fmi3GetBinary(*const ValueReference, usize, *mut usize, *mut Binary, usize);
        fmi3SetFloat32(*const ValueReference, usize, *const f32, usize);
        fmi3SetInt8(*const ValueReference, usize, *const i8, usize);
        fmi3SetUInt8(*const ValueReference, usize, *const u8, usize);
        fmi3SetInt16(*const ValueReference, usize, *const i16, usize);
        fmi3SetUInt16(*const ValueReference, usize, *const u16, usize);
        fmi3SetUInt32(*const ValueReference, usize, *const u32, usize);
        fmi3SetInt64(*const ValueReference, usize, *const i64, usize);
        fmi3SetUInt64(*const ValueReference, usize, *const u64, usize);
        fmi3SetBinary(*const ValueReference, usize, *const usize, *const Binary, usize);
    }
    "this FMU has no variables of this type that can be set": {
        fmi3SetInt32(*const ValueReference, usize, *const i32, usize);
        fmi3SetBoolean(*const ValueReference, usize, *const Boolean, usize);
    }
    "this FMU has no clocks": {
        fmi3GetClock(*const ValueReference, usize, *mut Clock);
        fmi3SetClock(*const ValueReference, usize, *const Clock);
        fmi3GetIntervalDecimal(*const ValueReference, usize, *mut f64, *mut IntervalQualifier);
        fmi3GetIntervalFraction(*const ValueReference, usize, *mut u64, *mut u64, *mut IntervalQualifier);
        fmi3GetShiftDecimal(*const ValueReference, usize, *mut f64);
        fmi3GetShiftFraction(*const ValueReference, usize, *mut u64, *mut u64);
        fmi3SetIntervalDecimal(*const ValueReference, usize, *const f64);
        fmi3SetIntervalFraction(*const ValueReference, usize, *const u64, *const u64);
        fmi3SetShiftDecimal(*const ValueReference, usize, *const f64);
        fmi3SetShiftFraction(*const ValueReference, usize, *const u64, *const u64);
    }
    "this FMU does not declare providesPerElementDependencies": {
        fmi3GetNumberOfVariableDependencies(ValueReference, *mut usize);
        fmi3GetVariableDependencies(
            ValueReference, *mut usize, *mut ValueReference, *mut usize, *mut DependencyKind, usize
        );
    }
    "this FMU has no structural parameters": {
        fmi3EnterConfigurationMode();
        fmi3ExitConfigurationMode();
    }
    "this FMU does not declare providesEvaluateDiscreteStates": {
        fmi3EvaluateDiscreteStates();
    }
    "this FMU has no Model Exchange": {
        fmi3EnterContinuousTimeMode();
        fmi3CompletedIntegratorStep(Boolean, *mut Boolean, *mut Boolean);
        fmi3SetTime(f64);
        fmi3SetContinuousStates(*const f64, usize);
        fmi3GetContinuousStateDerivatives(*mut f64, usize);
        fmi3GetEventIndicators(*mut f64, usize);
        fmi3GetContinuousStates(*mut f64, usize);
        fmi3GetNominalsOfContinuousStates(*mut f64, usize);
        fmi3GetNumberOfEventIndicators(*mut usize);
        fmi3GetNumberOfContinuousStates(*mut usize);
    }
    "this FMU has no Scheduled Execution": {
        fmi3ActivateModelPartition(ValueReference, f64);
    }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi3InstantiateModelExchange(
    _instance_name: Text,
    _token: Text,
    _resource_path: Text,
    _visible: Boolean,
    _logging_on: Boolean,
    environment: ComponentEnvironment,
    log_message: Option<LogMessage>,
) -> Component {
    // SAFETY: as the module says.
    let logger = unsafe { Logger::v3(log_message, environment) };
    no_instance("fmi3InstantiateModelExchange", "Model Exchange", &logger)
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi3InstantiateScheduledExecution(
    _instance_name: Text,
    _token: Text,
    _resource_path: Text,
    _visible: Boolean,
    _logging_on: Boolean,
    environment: ComponentEnvironment,
    log_message: Option<LogMessage>,
    _clock_update: Option<ClockUpdate>,
    _lock_preemption: Option<Preemption>,
    _unlock_preemption: Option<Preemption>,
) -> Component {
    // SAFETY: as the module says.
    let logger = unsafe { Logger::v3(log_message, environment) };
    no_instance("fmi3InstantiateScheduledExecution", "Scheduled Execution", &logger)
}

fn no_instance(function: &str, kind: &str, logger: &Logger) -> Component {
    let text = format!("{function}: this FMU has no {kind}: expected fmi3InstantiateCoSimulation");
    logger.send(&[Message { category: Category::StatusError, text }]);
    null_mut()
}
