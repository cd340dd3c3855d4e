//! The life of an instance, from `fmi2Instantiate` to `fmi2FreeInstance`.

use super::arguments::{boolean, bytes_in, str_in};
use super::logger::Logger;
use super::panics::caught;
use super::types::{Boolean, CO_SIMULATION, CallbackFunctions, Component, Text};
use crate::FmiVersion;
use crate::description::Category;
use crate::slave::{Interface, Log, Message, Refusal, Slave, instantiate};
use std::ffi::{CStr, CString, c_int};
use std::ptr;

/// What a component points to.
#[derive(Debug)]
pub(super) struct Instance {
    /// The instance itself.
    pub slave: Slave,
    /// Where its messages go.
    pub logger: Logger,
    /// A call has panicked.
    pub is_poisoned: bool,
    /// The strings that the last `fmi2GetString` has handed out.
    pub strings: Vec<CString>,
}

/// The arguments of `fmi2Instantiate`.
pub(super) struct Request {
    pub instance_name: Text,
    pub fmu_type: c_int,
    pub guid: Text,
    pub resource_location: Text,
    pub functions: *const CallbackFunctions,
    pub logging_on: Boolean,
}

/// A new component, or null with messages to the logger.
///
/// # Safety
/// The strings are null or end with a zero; `functions` is null or points to callbacks that can be called for as long
/// as the component lives.
pub(super) unsafe fn create(request: &Request) -> Component {
    // SAFETY: null is answered here; the rest is the caller's promise. The struct is not needed after this call.
    let Some(functions) = (unsafe { request.functions.as_ref() }) else { return ptr::null_mut() };
    // SAFETY: the caller's promise.
    let name = unsafe { bytes_in("instanceName", request.instance_name) };
    // SAFETY: the caller's promise.
    let logger = unsafe {
        let name = name.as_ref().copied().unwrap_or_default();
        Logger::new(functions.logger, functions.component_environment, name)
    };
    // SAFETY: the caller's promise.
    let outcome = caught(|| unsafe { slave(request, name) });
    let (category, problems) = match outcome {
        Ok(Ok(slave)) => {
            let instance = Instance { slave, logger, is_poisoned: false, strings: Vec::new() };
            return Box::into_raw(Box::new(instance)).cast();
        }
        Ok(Err(refusal)) => (Category::StatusError, refusal.problems),
        Err(panic) => (Category::StatusFatal, vec![format!("internal failure: {panic}")]),
    };
    let message = |problem| Message { category, text: format!("fmi2Instantiate: {problem}") };
    logger.send(&problems.into_iter().map(message).collect::<Vec<_>>());
    ptr::null_mut()
}

/// # Safety
/// As for [`create`].
unsafe fn slave(request: &Request, name: Result<&CStr, Refusal>) -> Result<Slave, Refusal> {
    let mut problems = Vec::new();
    // SAFETY: the caller's promise.
    let (guid, location) =
        unsafe { (str_in("fmuGUID", request.guid), bytes_in("fmuResourceLocation", request.resource_location)) };
    let logging_on = boolean("loggingOn", request.logging_on);
    if name.as_ref().is_ok_and(|name| name.is_empty()) {
        problems.push("instanceName is empty: expected a name".to_owned());
    }
    if request.fmu_type != CO_SIMULATION {
        problems.push(format!("fmuType = {}: expected fmi2CoSimulation ({CO_SIMULATION})", request.fmu_type));
    }
    let mut note = |refusal: Refusal| problems.extend(refusal.problems);
    match (name.map_err(&mut note), guid.map_err(&mut note), location.map_err(&mut note), logging_on.map_err(&mut note))
    {
        (Ok(_), Ok(guid), Ok(location), Ok(logging_on)) if problems.is_empty() => {
            instantiate(Interface::V2, guid, location.to_bytes(), Log::new(FmiVersion::V2, logging_on))
        }
        _ => Err(Refusal { problems }),
    }
}

/// Ends the life of a component.
///
/// # Safety
/// `component` is null or a live one; it is not used afterwards.
pub(super) unsafe fn free(component: Component) {
    if component.is_null() {
        return;
    }
    // SAFETY: the pointer comes from `Box::into_raw` in `create`, and the caller gives it up.
    let instance = unsafe { Box::from_raw(component.cast::<Instance>()) };
    // A panic has nobody to be reported to any more, but it may not leave this library either.
    let _ = caught(|| drop(instance));
}
