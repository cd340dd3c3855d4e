//! The life of an instance, from its making to `fmi2FreeInstance` or `fmi3FreeInstance`.

use super::arguments::{boolean, bytes_in, str_in};
use super::logger::Logger;
use super::panics::caught;
use super::types::{Component, Text};
use crate::FmiVersion;
use crate::description::Category;
use crate::slave::{Interface, Log, Message, Refusal, Slave, instantiate};
use std::ffi::{CString, c_int};
use std::ptr;

/// What a component points to.
#[derive(Debug)]
pub(in crate::fmi) struct Instance {
    /// The instance itself.
    pub slave: Slave,
    /// Where its messages go.
    pub logger: Logger,
    /// A call has panicked.
    pub is_poisoned: bool,
    /// The strings that the last `fmi2GetString` or `fmi3GetString` has handed out.
    pub strings: Vec<CString>,
}

/// What every instantiation takes, with the names of its version.
pub(in crate::fmi) struct Request<const N: usize> {
    pub version: FmiVersion,
    /// Name of the C function.
    pub function: &'static str,
    pub instance_name: Text,
    pub guid: (&'static str, Text),
    pub resources: (&'static str, Text),
    /// What is wrong with anything else.
    pub problem: Option<String>,
    /// Booleans.
    pub flags: [(&'static str, c_int); N],
}

/// A new component, or null with messages to the logger. The flags say which interface the instance has, and whether it
/// logs.
///
/// # Safety
/// The strings are null or end with a zero; the logger can be called for as long as the component lives.
pub(in crate::fmi) unsafe fn create<const N: usize>(
    request: &Request<N>,
    logger: Logger,
    interface: impl FnOnce([bool; N]) -> (Interface, bool),
) -> Component {
    // SAFETY: the caller's promise.
    let outcome = caught(|| unsafe { slave(request, interface) });
    let (category, problems) = match outcome {
        Ok(Ok(slave)) => {
            let instance = Instance { slave, logger, is_poisoned: false, strings: Vec::new() };
            return Box::into_raw(Box::new(instance)).cast();
        }
        Ok(Err(refusal)) => (Category::StatusError, refusal.problems),
        Err(panic) => (Category::StatusFatal, vec![format!("internal failure: {panic}")]),
    };
    let message = |problem| Message { category, text: format!("{}: {problem}", request.function) };
    logger.send(&problems.into_iter().map(message).collect::<Vec<_>>());
    ptr::null_mut()
}

/// # Safety
/// As for [`create`].
unsafe fn slave<const N: usize>(
    request: &Request<N>,
    interface: impl FnOnce([bool; N]) -> (Interface, bool),
) -> Result<Slave, Refusal> {
    // SAFETY: the caller's promise.
    let (name, guid, location) = unsafe {
        (
            bytes_in("instanceName", request.instance_name),
            str_in(request.guid.0, request.guid.1),
            bytes_in(request.resources.0, request.resources.1),
        )
    };
    let mut problems = Vec::new();
    if name.as_ref().is_ok_and(|name| name.is_empty()) {
        problems.push("instanceName is empty: expected a name".to_owned());
    }
    problems.extend(request.problem.clone());
    let mut note = |refusal: Refusal| problems.extend(refusal.problems);
    let strings = (name.map_err(&mut note), guid.map_err(&mut note), location.map_err(&mut note));
    let flags = request.flags.map(|(name, flag)| boolean(request.version, name, flag).map_err(&mut note));
    match strings {
        (Ok(_), Ok(guid), Ok(location)) if problems.is_empty() => {
            let (interface, logging_on) = interface(flags.map(|flag| flag == Ok(true)));
            instantiate(interface, guid, location.to_bytes(), Log::new(request.version, logging_on))
        }
        _ => Err(Refusal { problems }),
    }
}

/// Ends the life of a component.
///
/// # Safety
/// `component` is null or a live one; it is not used afterwards.
pub(in crate::fmi) unsafe fn free(component: Component) {
    if component.is_null() {
        return;
    }
    // SAFETY: the pointer comes from `Box::into_raw` in `create`, and the caller gives it up.
    let instance = unsafe { Box::from_raw(component.cast::<Instance>()) };
    // A panic has nobody to be reported to any more, but it may not leave this library either.
    let _ = caught(|| drop(instance));
}
