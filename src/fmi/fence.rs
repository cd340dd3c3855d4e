//! The fence between C and the slave: every call that takes a component goes through it.

use super::instance::Instance;
use super::panics::caught;
use super::types::Component;
use crate::slave::{Call, Refusal, Status};
use std::ffi::c_int;

/// Checks component and call sequence, runs the body, turns its result or its panic into a status, and logs.
///
/// A panic is `fmi2Fatal` and the instance answers `fmi2Fatal` from then on: the state that the panic broke is never
/// used again. Rust writes the panic message to stderr before anyone can catch it; the only way to prevent that is a
/// process-wide hook, which a library inside another program leaves alone.
///
/// # Safety
/// `component` is null or a live one that no other thread uses.
pub(super) unsafe fn with_instance<T: Into<Status>>(
    component: Component,
    call: Call,
    body: impl FnOnce(&mut Instance) -> Result<T, Refusal>,
) -> c_int {
    let (status, messages, logger) = {
        // SAFETY: null is answered here, the rest is the caller's promise. The borrow ends before the logger is called.
        let Some(instance) = (unsafe { component.cast::<Instance>().as_mut() }) else {
            return Status::Error as c_int;
        };
        let status = run(instance, call, body);
        let messages = instance.slave.take_messages();
        if messages.is_empty() {
            return status as c_int;
        }
        (status, messages, instance.logger.clone())
    };
    logger.send(&messages);
    status as c_int
}

fn run<T: Into<Status>>(
    instance: &mut Instance,
    call: Call,
    body: impl FnOnce(&mut Instance) -> Result<T, Refusal>,
) -> Status {
    if instance.is_poisoned {
        return Status::Fatal;
    }
    let outcome = caught(|| {
        let result = instance.slave.check(call).and_then(|()| body(instance));
        instance.slave.report(call, result.map(Into::into))
    });
    outcome.unwrap_or_else(|panic| {
        instance.is_poisoned = true;
        instance.slave.report_fatal(call, &panic)
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::panic)]
    use super::*;
    use crate::fmi::test_support::Logged;

    fn call(component: Component, call: Call, body: impl FnOnce()) -> c_int {
        // SAFETY: the component is live, and of this thread only.
        unsafe {
            with_instance(component, call, |_| {
                body();
                Ok(())
            })
        }
    }

    #[test]
    fn a_panic_is_fatal_and_stays_so() {
        let logged = Logged::new();
        let c = logged.component;
        assert_eq!(call(c, Call::SetReal, || ()), Status::Ok as c_int);
        assert_eq!(call(c, Call::SetReal, || panic!("at 100%")), Status::Fatal as c_int);
        assert_eq!(logged.messages(), ["fmi2SetReal: internal failure: at 100%%"]);
        for after in [Call::SetReal, Call::Reset] {
            assert_eq!(call(c, after, || panic!("the instance is poisoned")), Status::Fatal as c_int);
        }
    }

    #[test]
    fn a_call_out_of_sequence_does_not_reach_the_body() {
        let logged = Logged::new();
        let status = call(logged.component, Call::DoStep, || panic!("not allowed yet"));
        assert_eq!(status, Status::Error as c_int);
        assert_eq!(logged.messages(), ["fmi2DoStep: called in phase Instantiated: expected in StepComplete"]);
    }

    #[test]
    fn no_component_is_an_error() {
        assert_eq!(call(std::ptr::null_mut(), Call::Reset, || panic!("no instance")), Status::Error as c_int);
    }
}
