//! Instances of FMI 3.0 through the exported functions, linked rather than loaded, with what they log.
#![allow(dead_code, clippy::unwrap_used, clippy::panic)] // each test uses its share

#[path = "steps_3.rs"]
mod steps;

use pounding::FmiVersion;
use pounding::description::Package;
pub use pounding::fmi::*;
use pounding::variables::{Slot, Table, Type};
use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::path::PathBuf;
use std::ptr::{null, null_mut};
pub use steps::*;
use tempfile::TempDir;

pub const OK: c_int = 0;
pub const DISCARD: c_int = 2;
pub const ERROR: c_int = 3;

/// The unpacked resources of a scene, to make instances of.
pub struct Fmu {
    pub directory: TempDir,
    pub package: Package,
    pub table: Table,
    pub token: String,
}

impl Fmu {
    /// A record that the scene names is that of the other tests.
    pub fn new(scene: &str) -> Fmu {
        let directory = TempDir::new().unwrap();
        let resources = directory.path().join("resources");
        std::fs::create_dir(&resources).unwrap();
        std::fs::write(resources.join("scene.toml"), scene).unwrap();
        if scene.contains("record =") {
            std::fs::write(resources.join("record.csv"), super::support::record()).unwrap();
        }
        let package = Package::from_resources(&resources).unwrap();
        let (table, token) = (Table::new(&package.scene), package.guid(FmiVersion::V3));
        Fmu { directory, package, table, token }
    }

    pub fn resources(&self) -> PathBuf {
        self.directory.path().join("resources")
    }

    /// The value reference of a variable.
    pub fn vr(&self, name: &str) -> u32 {
        let named = |row: &str| row == name;
        let found = self.table.iter().find(|(_, row)| named(&row.name)).map(|(reference, _)| reference);
        found.or((name == "time").then(|| self.table.time_reference())).unwrap_or_else(|| panic!("no variable {name}"))
    }

    /// The value references of all outputs of a type.
    pub fn outputs(&self, is_type: fn(Type) -> bool) -> Vec<u32> {
        let rows = self.table.iter().filter(|(_, row)| matches!(row.slot, Slot::Output(_)) && is_type(row.ty));
        rows.map(|(reference, _)| reference).collect()
    }

    /// An instance that logs everything, with these two flags.
    pub fn instance(&self, event_mode_used: bool, early_return_allowed: bool) -> Instance<'_> {
        let flags = [1, event_mode_used.into(), early_return_allowed.into()];
        let (instance, log) = self.instantiate(&Arguments { flags, ..Arguments::of(self) });
        instance.unwrap_or_else(|| panic!("{log:?}"))
    }

    /// Any call of `fmi3InstantiateCoSimulation`; what it logs comes back where there is no instance to ask.
    pub fn instantiate(&self, arguments: &Arguments) -> (Option<Instance<'_>>, Vec<Line>) {
        let log = Box::<Log>::default();
        let text = |text: &Option<CString>| text.as_ref().map_or(null(), |text| text.as_ptr());
        let [logging_on, event_mode_used, early_return_allowed] = arguments.flags;
        let required = arguments.required.as_ref().map_or(null(), |required| required.as_ptr());
        // SAFETY: strings that end with a zero or null, and a log that outlives the instance.
        let component = unsafe {
            fmi3InstantiateCoSimulation(
                text(&arguments.name),
                text(&arguments.token),
                text(&arguments.path),
                arguments.visible,
                logging_on,
                event_mode_used,
                early_return_allowed,
                required,
                arguments.n_required,
                environment(&log),
                arguments.with_logger.then_some(note),
                arguments.with_updates.then_some(update),
            )
        };
        if component.is_null() {
            return (None, log.lines.take());
        }
        (Some(Instance { fmu: self, component, log }), Vec::new())
    }
}

/// The arguments of `fmi3InstantiateCoSimulation`.
pub struct Arguments {
    pub name: Option<CString>,
    pub token: Option<CString>,
    pub path: Option<CString>,
    pub visible: u8,
    /// `loggingOn`, `eventModeUsed`, `earlyReturnAllowed`
    pub flags: [u8; 3],
    pub required: Option<Vec<u32>>,
    pub n_required: usize,
    pub with_logger: bool,
    /// With a function for intermediate updates.
    pub with_updates: bool,
}

impl Arguments {
    pub fn of(fmu: &Fmu) -> Arguments {
        let c_string = |text: &str| Some(CString::new(text).unwrap());
        Arguments {
            name: c_string("buildings"),
            token: c_string(&fmu.token),
            path: c_string(&format!("{}/", fmu.resources().to_str().unwrap())),
            visible: 0,
            flags: [1, 1, 1],
            required: None,
            n_required: 0,
            with_logger: true,
            with_updates: false,
        }
    }
}

/// What arrives at the logger.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    pub status: c_int,
    pub category: String,
    pub message: String,
}

/// The environment of an instance: messages, and what to do in the middle of one.
#[derive(Default)]
pub struct Log {
    pub lines: RefCell<Vec<Line>>,
    call_back: RefCell<Option<Box<dyn FnMut()>>>,
    on_update: RefCell<Option<OnUpdate>>,
}

type OnUpdate = Box<dyn FnMut(Turn)>;

/// What a turn of the master in a step says about itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    pub time: f64,
    /// Inputs are asked for.
    pub sets: u8,
    /// Outputs can be read.
    pub gets: u8,
    pub is_finished: u8,
    pub can_return: u8,
}

pub fn environment(log: &Log) -> *mut c_void {
    std::ptr::from_ref(log).cast_mut().cast()
}

/// `fmi3LogMessageCallback`
pub unsafe extern "C" fn note(
    environment: *mut c_void,
    status: c_int,
    category: *const c_char,
    message: *const c_char,
) {
    // SAFETY: the environment that was given at instantiation, and strings that end with a zero.
    let (log, category, message) = unsafe {
        let text = |text| CStr::from_ptr(text).to_str().unwrap().to_owned();
        (&*environment.cast::<Log>(), text(category), text(message))
    };
    log.lines.borrow_mut().push(Line { status, category, message });
    if let Some(mut call_back) = log.call_back.take() {
        call_back();
    }
}

/// `fmi3IntermediateUpdateCallback`; it asks to return early at once, which nothing may come of.
unsafe extern "C" fn update(
    environment: *mut c_void,
    time: f64,
    sets: u8,
    gets: u8,
    is_finished: u8,
    can_return: u8,
    requested: *mut u8,
    early_return_time: *mut f64,
) {
    // SAFETY: the environment that was given at instantiation, and places for two values.
    let log = unsafe {
        (*requested, *early_return_time) = (1, time);
        &*environment.cast::<Log>()
    };
    let mut on_update = log.on_update.take();
    if let Some(turn) = &mut on_update {
        turn(Turn { time, sets, gets, is_finished, can_return });
    }
    log.on_update.replace(on_update);
}

/// A live instance; its methods are the functions of the standard.
pub struct Instance<'f> {
    pub fmu: &'f Fmu,
    pub component: Component,
    log: Box<Log>,
}

impl Drop for Instance<'_> {
    fn drop(&mut self) {
        // SAFETY: alive, and not used afterwards.
        unsafe { fmi3FreeInstance(self.component) }
    }
}

/// A function that takes the instance alone.
pub type Plain = unsafe extern "C" fn(Component) -> c_int;
/// A function that gets values of a type.
pub type Get<T> = unsafe extern "C" fn(Component, *const u32, usize, *mut T, usize) -> c_int;

impl Instance<'_> {
    /// The messages so far; there are none afterwards.
    pub fn log(&self) -> Vec<Line> {
        self.log.lines.take()
    }

    /// The only message so far, of an error.
    pub fn only_error(&self) -> String {
        let log = self.log();
        let [line] = &log[..] else { panic!("one message: {log:?}") };
        assert_eq!((line.status, line.category.as_str()), (ERROR, "logStatusError"));
        line.message.clone()
    }

    /// Does something in the middle of the next message.
    pub fn in_next_message(&self, call_back: impl FnMut() + 'static) {
        *self.log.call_back.borrow_mut() = Some(Box::new(call_back));
    }

    /// Does something in each turn that a step gives, from now on; not in turns within turns.
    pub fn in_turns(&self, turn: impl FnMut(Turn) + 'static) {
        *self.log.on_update.borrow_mut() = Some(Box::new(turn));
    }

    pub fn call(&self, function: Plain) -> c_int {
        // SAFETY: a live instance.
        unsafe { function(self.component) }
    }

    /// Calls that must go well.
    pub fn calls(&self, functions: &[Plain]) {
        for (i, function) in functions.iter().enumerate() {
            assert_eq!(self.call(*function), OK, "call {i}: {:?}", self.log());
        }
    }

    pub fn enter(&self, start: f64, stop: Option<f64>) -> c_int {
        let (defined, stop) = (stop.is_some().into(), stop.unwrap_or_default());
        // SAFETY: a live instance.
        unsafe { fmi3EnterInitializationMode(self.component, 0, 0.0, start, defined, stop) }
    }

    /// To what follows initialisation, at 0 s: Event Mode or Step Mode.
    pub fn initialize(&self) {
        assert_eq!(self.enter(0.0, None), OK, "{:?}", self.log());
        self.calls(&[fmi3ExitInitializationMode]);
    }

    /// To Step Mode at 0 s, of an instance with Event Mode.
    pub fn start_with_events(&self) {
        self.initialize();
        assert_eq!(self.update(), (OK, [0; 5], 0.0));
        self.calls(&[fmi3EnterStepMode]);
    }

    pub fn step(&self, current: f64, step: f64) -> (c_int, Stepped) {
        steps::step(self.component, current, step)
    }

    /// `fmi3UpdateDiscreteStates`: status, Booleans in the order of the arguments, time.
    pub fn update(&self) -> (c_int, [u8; 5], f64) {
        let (mut flags, mut next) = ([77; 5], -77.0);
        let [need, terminate, nominals, values, defined] = &mut flags;
        // SAFETY: a live instance and places for the results.
        let status = unsafe {
            fmi3UpdateDiscreteStates(self.component, need, terminate, nominals, values, defined, &raw mut next)
        };
        (status, flags, next)
    }

    /// Through Event Mode and back.
    pub fn handle(&self) {
        self.calls(&[fmi3EnterEventMode]);
        assert_eq!(self.update().0, OK);
        self.calls(&[fmi3EnterStepMode]);
    }

    pub fn get<T: Clone>(&self, function: Get<T>, vr: &[u32], fill: T) -> Result<Vec<T>, c_int> {
        let mut values = vec![fill; vr.len()];
        // SAFETY: arrays of as many elements as announced.
        let status = unsafe { function(self.component, vr.as_ptr(), vr.len(), values.as_mut_ptr(), values.len()) };
        if status == OK { Ok(values) } else { Err(status) }
    }

    pub fn real(&self, name: &str) -> f64 {
        let value = self.get(fmi3GetFloat64, &[self.fmu.vr(name)], 0.0);
        value.unwrap_or_else(|status| panic!("{name}: status {status}, {:?}", self.log()))[0]
    }

    pub fn integer(&self, name: &str) -> i32 {
        self.get(fmi3GetInt32, &[self.fmu.vr(name)], -1).unwrap()[0]
    }

    pub fn boolean(&self, name: &str) -> u8 {
        self.get(fmi3GetBoolean, &[self.fmu.vr(name)], 77).unwrap()[0]
    }

    pub fn set_real(&self, name: &str, value: f64) -> c_int {
        // SAFETY: one reference and one value.
        unsafe { fmi3SetFloat64(self.component, &self.fmu.vr(name), 1, &raw const value, 1) }
    }

    pub fn set_string(&self, name: &str, value: &str) -> c_int {
        let (vr, text) = (self.fmu.vr(name), CString::new(value).unwrap());
        // SAFETY: one reference and one string.
        unsafe { fmi3SetString(self.component, &raw const vr, 1, &text.as_ptr(), 1) }
    }

    /// The bits of every output.
    pub fn outputs(&self) -> Vec<u64> {
        let reals = self.get(fmi3GetFloat64, &self.fmu.outputs(|ty| matches!(ty, Type::Real(_))), 0.0).unwrap();
        reals.into_iter().map(f64::to_bits).chain(self.discrete()).collect()
    }

    /// Every Int32 and Boolean output.
    pub fn discrete(&self) -> Vec<u64> {
        let integers = self.get(fmi3GetInt32, &self.fmu.outputs(|ty| ty == Type::Integer), 0).unwrap();
        let booleans = self.get(fmi3GetBoolean, &self.fmu.outputs(|ty| ty == Type::Boolean), 0).unwrap();
        let integers = integers.into_iter().map(|value| u64::from(value.unsigned_abs()));
        integers.chain(booleans.into_iter().map(u64::from)).collect()
    }

    /// A new snapshot.
    pub fn recorded(&self) -> FmuState {
        let mut state = null_mut();
        // SAFETY: a live instance, and a place without a state.
        assert_eq!(unsafe { fmi3GetFMUState(self.component, &raw mut state) }, OK, "{:?}", self.log());
        assert!(!state.is_null());
        state
    }

    pub fn set_state(&self, state: FmuState) -> c_int {
        // SAFETY: a live instance; the pointer is never followed.
        unsafe { fmi3SetFMUState(self.component, state) }
    }

    /// The bytes of a snapshot.
    pub fn serialized(&self, state: FmuState) -> Vec<u8> {
        let mut size = 0;
        // SAFETY: a live instance, and a place for the size.
        assert_eq!(unsafe { fmi3SerializedFMUStateSize(self.component, state, &raw mut size) }, OK);
        let mut bytes = vec![0; size];
        // SAFETY: room for as many bytes as announced.
        assert_eq!(unsafe { fmi3SerializeFMUState(self.component, state, bytes.as_mut_ptr(), size) }, OK);
        bytes
    }

    /// A snapshot of bytes that are whole.
    pub fn deserialized(&self, bytes: &[u8]) -> FmuState {
        let mut state = null_mut();
        // SAFETY: as many bytes as announced, and a place without a state.
        let status = unsafe { fmi3DeserializeFMUState(self.component, bytes.as_ptr(), bytes.len(), &raw mut state) };
        assert_eq!(status, OK, "{:?}", self.log());
        state
    }
}
