//! Functions of all kinds of FMU: versions, logging, the life of an instance.

use super::types::{Boolean, CO_SIMULATION, CallbackFunctions};
use crate::FmiVersion;
use crate::fmi::common::arguments::bytes_in;
use crate::fmi::common::fence::functions;
use crate::fmi::common::instance::{Request, choose_logging, create, free, set_up};
use crate::fmi::common::logger::Logger;
use crate::fmi::common::types::{Component, Text};
use crate::slave::Interface;
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

functions! { v2:
    fmi2SetDebugLogging = SetDebugLogging(on: Boolean, n: usize, categories: *const Text) |instance| {
        choose_logging(instance, on, (categories, n))
    };
    fmi2SetupExperiment = SetupExperiment(
        tolerance_defined: Boolean, tolerance: f64, start_time: f64, stop_time_defined: Boolean, stop_time: f64
    ) |instance| set_up(instance, (tolerance_defined, tolerance), start_time, (stop_time_defined, stop_time));
    fmi2EnterInitializationMode = EnterInitializationMode() |instance| Ok(instance.slave.enter_initialization());
    fmi2ExitInitializationMode = ExitInitializationMode() |instance| instance.slave.exit_initialization();
    fmi2Terminate = Terminate() |instance| Ok(instance.slave.terminate());
    fmi2Reset = Reset() |instance| Ok(instance.slave.reset());
}
