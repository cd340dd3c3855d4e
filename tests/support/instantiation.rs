//! How instances are made.

use super::log::{Line, Log, Logger, Variadic, environment, note_2, note_3, update};
use super::{Fmu, Instance};
use pounding::FmiVersion;
use pounding::fmi::{CallbackFunctions, Component, fmi2Instantiate, fmi3InstantiateCoSimulation};
use std::ffi::{CString, c_char, c_int};
use std::path::Path;
use std::ptr::null;

/// The arguments of `fmi2Instantiate` and of `fmi3InstantiateCoSimulation`.
pub struct Arguments {
    pub name: Option<CString>,
    /// GUID or token.
    pub guid: Option<CString>,
    /// URI or path.
    pub location: Option<CString>,
    pub with_logger: bool,
    pub logging_on: c_int,
    /// Of FMI 2.0.
    pub kind: c_int,
    pub with_callbacks: bool,
    /// Of FMI 3.0.
    pub visible: u8,
    pub event_mode_used: u8,
    pub early_return_allowed: u8,
    pub required: Option<Vec<u32>>,
    pub n_required: usize,
    /// With a function for intermediate updates.
    pub with_updates: bool,
}

impl Arguments {
    /// Those of a usual master, which has everything logged.
    pub fn of(fmu: &Fmu) -> Arguments {
        let path = fmu.resources();
        Arguments {
            name: c("buildings"),
            guid: c(&fmu.guid),
            location: c(&fmu.either(uri(&path), format!("{}/", path.to_str().unwrap()))),
            with_logger: true,
            logging_on: 1,
            kind: 1,
            with_callbacks: true,
            visible: 0,
            event_mode_used: 0,
            early_return_allowed: 0,
            required: None,
            n_required: 0,
            with_updates: false,
        }
    }
}

pub fn c(text: &str) -> Option<CString> {
    Some(CString::new(text).unwrap())
}

/// The way most masters of FMI 2.0 write it.
pub fn uri(path: &Path) -> String {
    format!("file:///{}", path.to_str().unwrap().replace('\\', "/").trim_start_matches('/'))
}

fn pointer(text: &Option<CString>) -> *const c_char {
    text.as_ref().map_or(null(), |text| text.as_ptr())
}

impl Fmu {
    /// A master's usual call; in FMI 3.0 without Event Mode and early returns.
    pub fn instance(&self) -> Instance<'_> {
        self.with_flags(false, false)
    }

    /// The same with these two flags of FMI 3.0.
    pub fn with_flags(&self, event_mode_used: bool, early_return_allowed: bool) -> Instance<'_> {
        let [event_mode_used, early_return_allowed] = [event_mode_used, early_return_allowed].map(u8::from);
        self.instance_with(&Arguments { event_mode_used, early_return_allowed, ..Arguments::of(self) })
    }

    /// An instance that must come to be.
    pub fn instance_with(&self, arguments: &Arguments) -> Instance<'_> {
        let (instance, log) = self.instantiate(arguments);
        instance.unwrap_or_else(|| panic!("{log:?}"))
    }

    /// Any call; what it logs comes back where there is no instance to ask.
    pub fn instantiate(&self, arguments: &Arguments) -> (Option<Instance<'_>>, Vec<Line>) {
        let log = Box::<Log>::default();
        let component = match self.version {
            FmiVersion::V2 => instantiate_2(arguments, &log),
            FmiVersion::V3 => instantiate_3(arguments, &log),
        };
        if component.is_null() {
            return (None, log.lines.take());
        }
        let event_mode_used = self.version == FmiVersion::V3 && arguments.event_mode_used == 1;
        (Some(Instance { fmu: self, component, event_mode_used, log }), Vec::new())
    }
}

fn instantiate_2(arguments: &Arguments, log: &Log) -> Component {
    // SAFETY: the logger is called without variable arguments.
    let logger = unsafe { std::mem::transmute::<Logger, Variadic>(note_2) };
    let callbacks = CallbackFunctions {
        logger: arguments.with_logger.then_some(logger),
        allocate_memory: null(),
        free_memory: null(),
        step_finished: null(),
        component_environment: environment(log),
    };
    // SAFETY: strings that end with a zero or null, callbacks that outlive the call, a log that outlives the instance.
    unsafe {
        fmi2Instantiate(
            pointer(&arguments.name),
            arguments.kind,
            pointer(&arguments.guid),
            pointer(&arguments.location),
            if arguments.with_callbacks { &raw const callbacks } else { null() },
            0,
            arguments.logging_on,
        )
    }
}

fn instantiate_3(arguments: &Arguments, log: &Log) -> Component {
    let required = arguments.required.as_ref().map_or(null(), |required| required.as_ptr());
    // SAFETY: strings that end with a zero or null, and a log that outlives the instance.
    unsafe {
        fmi3InstantiateCoSimulation(
            pointer(&arguments.name),
            pointer(&arguments.guid),
            pointer(&arguments.location),
            arguments.visible,
            arguments.logging_on.try_into().unwrap(),
            arguments.event_mode_used,
            arguments.early_return_allowed,
            required,
            arguments.n_required,
            environment(log),
            arguments.with_logger.then_some(note_3),
            arguments.with_updates.then_some(update),
        )
    }
}
