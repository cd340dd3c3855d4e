//! The fence between C and the slave: every call that takes an instance goes through it.

use super::instance::Instance;
use super::panics::caught;
use super::types::Component;
use crate::FmiVersion;
use crate::slave::{Call, Refusal, Status};
use std::ffi::c_int;

/// A function of one version of the standard.
#[derive(Clone, Copy, Debug)]
pub(in crate::fmi) struct Function {
    pub version: FmiVersion,
    pub call: Call,
}

/// That of FMI 2.0.
pub(in crate::fmi) const fn v2(call: Call) -> Function {
    Function { version: FmiVersion::V2, call }
}

/// That of FMI 3.0.
pub(in crate::fmi) const fn v3(call: Call) -> Function {
    Function { version: FmiVersion::V3, call }
}

/// The functions of a version that take an instance: name and call, the other arguments, and what is done with the
/// instance behind the fence. That may rely on what the module says of a caller: it is within an `unsafe` block.
macro_rules! functions {
    ($version:ident: $(
        $(#[$about:meta])*
        $name:ident = $call:ident($($argument:ident: $ty:ty),* $(,)?) |$instance:ident| $body:expr;
    )+) => {$(
        $(#[$about])*
        #[cfg_attr(fmi_exports, unsafe(no_mangle))]
        pub unsafe extern "C" fn $name(
            c: $crate::fmi::common::types::Component, $($argument: $ty),*
        ) -> std::ffi::c_int {
            let function = $crate::fmi::common::fence::$version($crate::slave::Call::$call);
            // SAFETY: as the module says.
            unsafe { $crate::fmi::common::fence::with_instance(c, function, |$instance| $body) }
        }
    )+};
}
pub(in crate::fmi) use functions;

/// The functions of a version for what these FMUs do not offer, with the types of all that comes after the instance, below the
/// reason for which they are refused. Masters look for every function of the standard, so each is there.
macro_rules! refused {
    ($version:ident: $($reason:literal: { $($name:ident($($argument:ty),* $(,)?);)+ })+) => {
        $($(
            #[cfg_attr(fmi_exports, unsafe(no_mangle))]
            pub unsafe extern "C" fn $name(
                c: $crate::fmi::common::types::Component $(, _: $argument)*
            ) -> std::ffi::c_int {
                let function = $crate::fmi::common::fence::$version($crate::slave::Call::NotOffered(stringify!($name)));
                // SAFETY: as the module says.
                unsafe { $crate::fmi::common::fence::refuse(c, function, $reason) }
            }
        )+)+
    };
}
pub(in crate::fmi) use refused;

/// Checks instance, version and call sequence, runs the body, turns its result or its panic into a status, and logs.
///
/// A panic is `fmi2Fatal` (`fmi3Fatal`) and the instance answers so from then on: the state that the panic broke is never
/// used again. Rust writes the panic message to stderr before anyone can catch it; the only way to prevent that is a
/// process-wide hook, which a library inside another program leaves alone.
///
/// # Safety
/// `component` is null or a live one that no other thread uses.
#[inline(always)]
pub(in crate::fmi) unsafe fn with_instance<T: Into<Status>>(
    component: Component,
    function: Function,
    body: impl FnOnce(&mut Instance) -> Result<T, Refusal>,
) -> c_int {
    // SAFETY: the caller's promise.
    unsafe {
        fenced(component, function, |instance| {
            instance.slave.check(function.call)?;
            body(instance)
        })
    }
}

/// Goes on with a call in which the master has had a turn: the call sequence has been checked when it began.
///
/// # Safety
/// As for [`with_instance`].
pub(in crate::fmi) unsafe fn go_on<T: Into<Status>>(
    component: Component,
    function: Function,
    body: impl FnOnce(&mut Instance) -> Result<T, Refusal>,
) -> c_int {
    // SAFETY: the caller's promise.
    unsafe { fenced(component, function, body) }
}

/// Refuses a function that these FMUs do not offer, in every phase.
///
/// # Safety
/// As for [`with_instance`].
pub(in crate::fmi) unsafe fn refuse(component: Component, function: Function, reason: &str) -> c_int {
    // SAFETY: the caller's promise.
    unsafe { fenced::<()>(component, function, |_| Err(Refusal::from(reason.to_owned()))) }
}

/// # Safety
/// As for [`with_instance`].
#[inline(always)]
unsafe fn fenced<T: Into<Status>>(
    component: Component,
    function: Function,
    body: impl FnOnce(&mut Instance) -> Result<T, Refusal>,
) -> c_int {
    let (status, messages, logger) = {
        // SAFETY: null is answered here, the rest is the caller's promise. The borrow ends before the logger is called.
        let Some(instance) = (unsafe { component.cast::<Instance>().as_mut() }) else {
            return Status::Error as c_int;
        };
        let status = run(instance, function, body);
        if !instance.slave.has_messages() {
            return status as c_int;
        }
        (status, instance.slave.take_messages(), instance.logger.clone())
    };
    logger.send(&messages);
    status as c_int
}

#[inline(always)]
fn run<T: Into<Status>>(
    instance: &mut Instance,
    function: Function,
    body: impl FnOnce(&mut Instance) -> Result<T, Refusal>,
) -> Status {
    if instance.is_poisoned {
        return Status::Fatal;
    }
    let call = function.call;
    if function.version != instance.slave.version() {
        return refuse_version(instance, function);
    }
    let outcome = caught(|| {
        let result = body(instance);
        instance.slave.report(call, result.map(Into::into))
    });
    outcome.unwrap_or_else(|panic| {
        instance.is_poisoned = true;
        instance.slave.report_fatal(call, &panic)
    })
}

/// A function of one version with an instance of the other, which has no name for the call or another one.
#[cold]
fn refuse_version(instance: &mut Instance, function: Function) -> Status {
    let of_instance = instance.slave.version().name();
    let problem = format!("the instance is one of FMI {of_instance}: expected one of FMI {}", function.version.name());
    instance.slave.report(Call::NotOffered(function.call.name(function.version)), Err(Refusal::from(problem)))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::panic)]
    use super::*;
    use crate::fmi::common::test_support::Logged;
    use crate::slave::Interface;

    fn call(component: Component, function: Function, body: impl FnOnce()) -> c_int {
        // SAFETY: the component is live, and of this thread only.
        unsafe {
            with_instance(component, function, |_| {
                body();
                Ok(())
            })
        }
    }

    #[test]
    fn a_panic_is_fatal_and_stays_so() {
        for (interface, of, message) in [
            (Interface::V2, v2 as fn(Call) -> Function, "fmi2SetReal: internal failure: at 100%%"),
            (Interface::PLAIN_V3, v3, "fmi3SetFloat64: internal failure: at 100%"),
        ] {
            let logged = Logged::new(interface);
            let c = logged.component;
            assert_eq!(call(c, of(Call::SetReal), || ()), Status::Ok as c_int);
            assert_eq!(call(c, of(Call::SetReal), || panic!("at 100%")), Status::Fatal as c_int);
            assert_eq!(logged.messages(), [message]);
            for after in [v2(Call::SetReal), v3(Call::SetReal), v2(Call::Reset), v3(Call::Reset)] {
                assert_eq!(call(c, after, || panic!("the instance is poisoned")), Status::Fatal as c_int);
            }
            // SAFETY: as in `call`.
            assert_eq!(unsafe { refuse(c, of(Call::NotOffered("refused")), "never") }, Status::Fatal as c_int);
        }
    }

    #[test]
    fn a_call_out_of_sequence_does_not_reach_the_body() {
        for (interface, function, message) in [
            (Interface::V2, v2(Call::DoStep), "fmi2DoStep: called in phase Instantiated: expected in StepComplete"),
            (Interface::PLAIN_V3, v3(Call::DoStep), "fmi3DoStep: called in phase Instantiated: expected in Step Mode"),
        ] {
            let logged = Logged::new(interface);
            assert_eq!(call(logged.component, function, || panic!("not allowed yet")), Status::Error as c_int);
            assert_eq!(logged.messages(), [message]);
        }
    }

    #[test]
    fn a_function_of_the_other_version_does_not_reach_the_body() {
        for (interface, function, message) in [
            (
                Interface::PLAIN_V3,
                v2(Call::GetReal),
                "fmi2GetReal: the instance is one of FMI 3.0: expected one of FMI 2.0",
            ),
            (Interface::PLAIN_V3, v2(Call::SetupExperiment), "fmi2SetupExperiment: the instance is one of FMI 3.0"),
            (
                Interface::V2,
                v3(Call::SetReal),
                "fmi3SetFloat64: the instance is one of FMI 2.0: expected one of FMI 3.0",
            ),
            (Interface::V2, v3(Call::EnterEventMode), "fmi3EnterEventMode: the instance is one of FMI 2.0"),
            (Interface::V2, v3(Call::Reset), "fmi3Reset: the instance is one of FMI 2.0"),
        ] {
            let logged = Logged::new(interface);
            let status = call(logged.component, function, || panic!("an instance of the other version"));
            assert_eq!(status, Status::Error as c_int);
            let [found] = logged.messages() else { panic!("one message: {:?}", logged.messages()) };
            assert!(found.starts_with(message), "{found}");
        }
    }

    #[test]
    fn no_component_is_an_error() {
        for function in [v2(Call::Reset), v3(Call::Reset)] {
            assert_eq!(call(std::ptr::null_mut(), function, || panic!("no instance")), Status::Error as c_int);
        }
    }
}
