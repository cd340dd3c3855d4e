//! Functions of all kinds of FMU: versions, logging, the life of an instance.

use super::arguments::{boolean, strs_in};
use super::fence::with_instance;
use super::instance::{Request, create, free};
use super::types::{Boolean, CallbackFunctions, Component, Text};
use crate::slave::Call;
use std::ffi::c_int;

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub extern "C" fn fmi2GetTypesPlatform() -> Text {
    c"default".as_ptr()
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub extern "C" fn fmi2GetVersion() -> Text {
    c"2.0".as_ptr()
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2SetDebugLogging(c: Component, on: Boolean, n: usize, categories: *const Text) -> c_int {
    // SAFETY: as the module says.
    unsafe {
        with_instance(c, Call::SetDebugLogging, |instance| {
            let categories = strs_in("categories", categories, n)?;
            instance.slave.set_debug_logging(boolean("loggingOn", on)?, &categories)
        })
    }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2Instantiate(
    instance_name: Text,
    fmu_type: c_int,
    guid: Text,
    resource_location: Text,
    functions: *const CallbackFunctions,
    _visible: Boolean,
    logging_on: Boolean,
) -> Component {
    let request = Request { instance_name, fmu_type, guid, resource_location, functions, logging_on };
    // SAFETY: as the module says.
    unsafe { create(&request) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2FreeInstance(c: Component) {
    // SAFETY: as the module says.
    unsafe { free(c) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2SetupExperiment(
    c: Component,
    tolerance_defined: Boolean,
    tolerance: f64,
    start_time: f64,
    stop_time_defined: Boolean,
    stop_time: f64,
) -> c_int {
    // SAFETY: as the module says.
    unsafe {
        with_instance(c, Call::SetupExperiment, |instance| {
            let tolerance = boolean("toleranceDefined", tolerance_defined)?.then_some(tolerance);
            let stop_time = boolean("stopTimeDefined", stop_time_defined)?.then_some(stop_time);
            instance.slave.setup_experiment(tolerance, start_time, stop_time)
        })
    }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2EnterInitializationMode(c: Component) -> c_int {
    // SAFETY: as the module says.
    unsafe { with_instance(c, Call::EnterInitializationMode, |instance| Ok(instance.slave.enter_initialization())) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2ExitInitializationMode(c: Component) -> c_int {
    // SAFETY: as the module says.
    unsafe { with_instance(c, Call::ExitInitializationMode, |instance| instance.slave.exit_initialization()) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2Terminate(c: Component) -> c_int {
    // SAFETY: as the module says.
    unsafe { with_instance(c, Call::Terminate, |instance| Ok(instance.slave.terminate())) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2Reset(c: Component) -> c_int {
    // SAFETY: as the module says.
    unsafe { with_instance(c, Call::Reset, |instance| Ok(instance.slave.reset())) }
}
