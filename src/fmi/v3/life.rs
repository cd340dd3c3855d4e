//! Version, logging, the life of an instance.

use super::types::Boolean;
use crate::FmiVersion::V3;
use crate::fmi::common::fence::functions;
use crate::fmi::common::instance::{Request, choose_logging, create, free, set_up};
use crate::fmi::common::logger::{LogMessage, Logger};
use crate::fmi::common::types::{Component, ComponentEnvironment, Text, ValueReference};
use crate::fmi::common::updater::{IntermediateUpdate, Updater};
use crate::slave::Interface;

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub extern "C" fn fmi3GetVersion() -> Text {
    c"3.0".as_ptr()
}

/// Variables of intermediate updates without a function for them are not looked at: some masters name them all the same.
#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi3InstantiateCoSimulation(
    instance_name: Text,
    token: Text,
    resource_path: Text,
    _visible: Boolean,
    logging_on: Boolean,
    event_mode_used: Boolean,
    early_return_allowed: Boolean,
    required: *const ValueReference,
    n_required: usize,
    environment: ComponentEnvironment,
    log_message: Option<LogMessage>,
    intermediate_update: Option<IntermediateUpdate>,
) -> Component {
    // SAFETY: as the module says.
    let is_empty = !resource_path.is_null() && unsafe { resource_path.read() } == 0;
    let request = Request {
        version: V3,
        function: "fmi3InstantiateCoSimulation",
        instance_name,
        guid: ("instantiationToken", token),
        resources: ("resourcePath", resource_path),
        problem: is_empty.then(|| "resourcePath is empty: expected that of the resources".to_owned()),
        flags: [
            ("loggingOn", logging_on.into()),
            ("eventModeUsed", event_mode_used.into()),
            ("earlyReturnAllowed", early_return_allowed.into()),
        ],
        updates: intermediate_update.map(|function| (Updater { function, environment }, required, n_required)),
    };
    // SAFETY: as the module says.
    unsafe {
        create(&request, Logger::v3(log_message, environment), |[logging_on, event_mode_used, early_return_allowed]| {
            (Interface::V3 { event_mode_used, early_return_allowed }, logging_on)
        })
    }
}

#[cfg_attr(fmi_exports, unsafe(no_mangle))]
pub unsafe extern "C" fn fmi3FreeInstance(c: Component) {
    // SAFETY: as the module says.
    unsafe { free(c) }
}

functions! { v3:
    fmi3SetDebugLogging = SetDebugLogging(on: Boolean, n: usize, categories: *const Text) |instance| {
        choose_logging(instance, on, (categories, n))
    };
    /// What `fmi2SetupExperiment` is in FMI 2.0 belongs to it.
    fmi3EnterInitializationMode = EnterInitializationMode(
        tolerance_defined: Boolean, tolerance: f64, start_time: f64, stop_time_defined: Boolean, stop_time: f64
    ) |instance| {
        set_up(instance, (tolerance_defined, tolerance), start_time, (stop_time_defined, stop_time))?;
        Ok(instance.slave.enter_initialization())
    };
    fmi3ExitInitializationMode = ExitInitializationMode() |instance| instance.slave.exit_initialization();
    fmi3Terminate = Terminate() |instance| Ok(instance.slave.terminate());
    fmi3Reset = Reset() |instance| Ok(instance.slave.reset());
}
