//! The life of an instance, from its making to `fmi2FreeInstance` or `fmi3FreeInstance`.

use super::arguments::{boolean, bytes_in, slice_in, str_in, strs_in};
use super::logger::Logger;
use super::panics::caught;
use super::types::{Component, Text, ValueReference};
use super::updater::Updater;
use crate::FmiVersion;
use crate::description::Category;
use crate::slave::{Interface, Log, Message, Refusal, Slave, instantiate};
use std::ffi::{CString, c_int};
use std::mem;
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
    /// Whom steps give a turn.
    pub updater: Option<Updater>,
    /// The master has its turn within a call.
    is_lent: bool,
    /// It has freed the component in it.
    is_given_up: bool,
}

impl Instance {
    /// A fresh one.
    pub(in crate::fmi) fn new(slave: Slave, logger: Logger, updater: Option<Updater>) -> Instance {
        let strings = Vec::new();
        Instance { slave, logger, is_poisoned: false, strings, updater, is_lent: false, is_given_up: false }
    }
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
    /// Whom steps give a turn, and for the sake of which variables.
    pub updates: Option<(Updater, *const ValueReference, usize)>,
}

/// A new component, or null with messages to the logger. The flags say which interface the instance has, and whether it
/// logs.
///
/// # Safety
/// The strings are null or end with a zero, references are as many as is said; logger and updater can be called for as long
/// as the component lives.
pub(in crate::fmi) unsafe fn create<const N: usize>(
    request: &Request<N>,
    logger: Logger,
    interface: impl FnOnce([bool; N]) -> (Interface, bool),
) -> Component {
    // SAFETY: the caller's promise.
    let outcome = caught(|| unsafe { slave(request, interface) });
    let (category, problems) = match outcome {
        Ok(Ok(slave)) => {
            let updater = request.updates.map(|(updater, ..)| updater);
            return Box::into_raw(Box::new(Instance::new(slave, logger, updater))).cast();
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
            let log = Log::new(request.version, logging_on);
            let mut slave = instantiate(interface, guid, location.to_bytes(), log)?;
            if let Some((_, references, n)) = request.updates {
                // SAFETY: the caller's promise.
                slave.want_updates(unsafe { slice_in("requiredIntermediateVariables", references, n) }?)?;
            }
            Ok(slave)
        }
        _ => Err(Refusal { problems }),
    }
}

/// Chooses the log categories.
///
/// # Safety
/// As `fmi/mod.rs` says, with as many categories as they are counted.
pub(in crate::fmi) unsafe fn choose_logging(
    instance: &mut Instance,
    on: impl Into<c_int>,
    (categories, n): (*const Text, usize),
) -> Result<(), Refusal> {
    // SAFETY: the caller's promise.
    let categories = unsafe { strs_in("categories", categories, n) }?;
    instance.slave.set_debug_logging(boolean(instance.slave.version(), "loggingOn", on)?, &categories)
}

/// Tolerance, start and end of a run, the first and the last where they are defined.
pub(in crate::fmi) fn set_up(
    instance: &mut Instance,
    (has_tolerance, tolerance): (impl Into<c_int>, f64),
    start: f64,
    (has_stop, stop): (impl Into<c_int>, f64),
) -> Result<(), Refusal> {
    let version = instance.slave.version();
    let tolerance = boolean(version, "toleranceDefined", has_tolerance)?.then_some(tolerance);
    let stop = boolean(version, "stopTimeDefined", has_stop)?.then_some(stop);
    instance.slave.setup_experiment(tolerance, start, stop)
}

/// Does the work of a call in which the master has turns, or messages that it may answer. A component that it frees
/// meanwhile ends with the outermost such call, which has no more use for it.
///
/// # Safety
/// `component` is null or a live one of which nothing is borrowed.
pub(in crate::fmi) unsafe fn lend<T>(component: Component, work: impl FnOnce() -> T) -> T {
    let instance = component.cast::<Instance>();
    if instance.is_null() {
        return work();
    }
    // SAFETY: the caller's promise; each borrow ends with its statement.
    let is_within_another = unsafe { mem::replace(&mut (*instance).is_lent, true) };
    let done = work();
    // SAFETY: as above; `free` has only noted that the master gives it up. It does not use it any more then, and neither
    // does the call that ends here.
    unsafe {
        (*instance).is_lent = is_within_another;
        if (*instance).is_given_up {
            free(component);
        }
    }
    done
}

/// Whether the master has freed a component that is lent.
///
/// # Safety
/// `component` is a live one of which nothing is borrowed.
pub(in crate::fmi) unsafe fn is_given_up(component: Component) -> bool {
    // SAFETY: the caller's promise; the borrow ends here.
    unsafe { (*component.cast::<Instance>()).is_given_up }
}

/// Ends the life of a component.
///
/// # Safety
/// `component` is null or a live one; it is not used afterwards.
pub(in crate::fmi) unsafe fn free(component: Component) {
    if component.is_null() {
        return;
    }
    let instance = component.cast::<Instance>();
    // SAFETY: alive, and borrowed by nobody.
    if unsafe { (*instance).is_lent } {
        // SAFETY: as above.
        unsafe { (*instance).is_given_up = true };
        return;
    }
    // SAFETY: the pointer comes from `Box::into_raw` in `create`, and the caller gives it up.
    let instance = unsafe { Box::from_raw(instance) };
    // A panic has nobody to be reported to any more, but it may not leave this library either.
    let _ = caught(|| drop(instance));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fmi::common::test_support::Logged;

    #[test]
    fn what_is_freed_in_a_call_within_a_call_lives_to_the_end_of_both() {
        let logged = Logged::new(Interface::PLAIN_V3);
        let c = logged.component;
        // SAFETY: a live component of this thread, of which nothing is borrowed.
        let is_lent = || unsafe { (*c.cast::<Instance>()).is_lent };
        // SAFETY: a live component of this thread, which ends with the outer call.
        unsafe {
            lend(c, || {
                lend(c, || assert!(is_lent()));
                assert!(is_lent(), "by the outer call");
                lend(c, || free(c));
                assert!(is_lent() && is_given_up(c));
            });
        }
        logged.without_component();
    }
}
