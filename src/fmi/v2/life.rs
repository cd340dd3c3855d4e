//! Functions of all kinds of FMU: versions, logging, the life of an instance.

use super::types::{Boolean, CO_SIMULATION, CallbackFunctions};
use crate::FmiVersion;
use crate::fmi::common::arguments::{boolean, bytes_in, strs_in};
use crate::fmi::common::fence::{v2, with_instance};
use crate::fmi::common::instance::{Request, create, free};
use crate::fmi::common::logger::Logger;
use crate::fmi::common::types::{Component, Text};
use crate::slave::{Call, Interface};
use std::ffi::c_int;
use std::ptr::null_mut;

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
        with_instance(c, v2(Call::SetDebugLogging), |instance| {
            let categories = strs_in("categories", categories, n)?;
            instance.slave.set_debug_logging(boolean(FmiVersion::V2, "loggingOn", on)?, &categories)
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
    // SAFETY: null is answered here; the rest is the caller's promise. The struct is not needed after this call.
    let Some(functions) = (unsafe { functions.as_ref() }) else { return null_mut() };
    // SAFETY: as the module says.
    let logger = unsafe {
        let name = bytes_in("instanceName", instance_name).unwrap_or_default();
        Logger::v2(functions.logger, functions.component_environment, name)
    };
    let expected = format!("fmuType = {fmu_type}: expected fmi2CoSimulation ({CO_SIMULATION})");
    let request = Request {
        version: FmiVersion::V2,
        function: "fmi2Instantiate",
        instance_name,
        guid: ("fmuGUID", guid),
        resources: ("fmuResourceLocation", resource_location),
        problem: (fmu_type != CO_SIMULATION).then_some(expected),
        flags: [("loggingOn", logging_on)],
        updates: None,
    };
    // SAFETY: as the module says.
    unsafe { create(&request, logger, |[logging_on]| (Interface::V2, logging_on)) }
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
        with_instance(c, v2(Call::SetupExperiment), |instance| {
            let tolerance = boolean(FmiVersion::V2, "toleranceDefined", tolerance_defined)?.then_some(tolerance);
            let stop_time = boolean(FmiVersion::V2, "stopTimeDefined", stop_time_defined)?.then_some(stop_time);
            instance.slave.setup_experiment(tolerance, start_time, stop_time)
        })
    }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2EnterInitializationMode(c: Component) -> c_int {
    // SAFETY: as the module says.
    unsafe { with_instance(c, v2(Call::EnterInitializationMode), |instance| Ok(instance.slave.enter_initialization())) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2ExitInitializationMode(c: Component) -> c_int {
    // SAFETY: as the module says.
    unsafe { with_instance(c, v2(Call::ExitInitializationMode), |instance| instance.slave.exit_initialization()) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2Terminate(c: Component) -> c_int {
    // SAFETY: as the module says.
    unsafe { with_instance(c, v2(Call::Terminate), |instance| Ok(instance.slave.terminate())) }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi2Reset(c: Component) -> c_int {
    // SAFETY: as the module says.
    unsafe { with_instance(c, v2(Call::Reset), |instance| Ok(instance.slave.reset())) }
}
