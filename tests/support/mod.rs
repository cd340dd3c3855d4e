//! The compiled library as a master sees it: symbols, a resources directory, a logger. Shared by the tests of the
//! C interface; each uses a part of it.
#![allow(dead_code, unused_imports, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod scenes;
mod state;

use fmi::model_description::fmi2::ModelDescription;
use libloading::Library;
use pounding::description::Package;
pub use scenes::{LINKED, NO_CONTACT, RECORD_SCENE, RICH, SCENE, UNEVEN, YIELDING, record};
pub use state::State;
use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::path::{Path, PathBuf};
use std::ptr;
use std::sync::OnceLock;
use tempfile::TempDir;

pub const OK: c_int = 0;
pub const DISCARD: c_int = 2;
pub const ERROR: c_int = 3;

/// Tells a process that a test starts where the library is.
pub const LIBRARY: &str = "POUNDING_LIBRARY";

/// The shared library in the FMUs of `cargo fmu`.
pub fn library_path() -> &'static Path {
    static PATH: OnceLock<PathBuf> = OnceLock::new();
    PATH.get_or_init(|| std::env::var_os(LIBRARY).map_or_else(compiled_library, PathBuf::from))
}

fn compiled_library() -> PathBuf {
    let compiled = fmu_start::compile(Path::new(env!("CARGO_MANIFEST_DIR")), true, |_| {}).unwrap();
    compiled.library().unwrap().to_path_buf()
}

/// An unpacked FMU.
pub struct Fmu {
    library: Library,
    pub directory: TempDir,
    pub package: Package,
    pub guid: String,
    pub description: ModelDescription,
}

impl Fmu {
    /// Lays out the resources of a scene and describes it; a record that the scene names is [`record`].
    pub fn new(scene: &str) -> Fmu {
        Fmu::with_record(scene, record().as_bytes())
    }

    /// The same with another record in CSV.
    pub fn with_record(scene: &str, record: &[u8]) -> Fmu {
        let directory = TempDir::new().unwrap();
        let resources = directory.path().join("resources");
        std::fs::create_dir(&resources).unwrap();
        std::fs::write(resources.join("scene.toml"), scene).unwrap();
        if scene.contains("record =") {
            std::fs::write(resources.join("record.csv"), record).unwrap();
        }
        let package = Package::from_resources(&resources).unwrap();
        let description = ModelDescription::from_string(&package.model_description(pounding::FmiVersion::V2)).unwrap();
        // SAFETY: the library has no initialisers of its own.
        let library = unsafe { Library::new(library_path()) }.unwrap();
        Fmu { library, directory, guid: package.guid(pounding::FmiVersion::V2), package, description }
    }

    pub fn resources(&self) -> PathBuf {
        self.directory.path().join("resources")
    }

    /// The value reference of a variable.
    pub fn vr(&self, name: &str) -> u32 {
        self.description.variable_by_name(name).unwrap().valueReference
    }

    pub fn symbol<T: Copy>(&self, name: &str) -> T {
        // SAFETY: every caller states the type that the standard gives the function.
        unsafe { *self.library.get::<T>(name).unwrap_or_else(|error| panic!("{name}: {error}")) }
    }

    /// A master's usual call, with logging.
    pub fn instance(&self) -> Instance<'_> {
        let (instance, log) = self.instantiate(&Arguments::of(self));
        instance.unwrap_or_else(|| panic!("{log:?}"))
    }

    /// Any call of `fmi2Instantiate`; what it logs comes back where there is no instance to ask.
    pub fn instantiate(&self, arguments: &Arguments) -> (Option<Instance<'_>>, Vec<Line>) {
        type Instantiate = unsafe extern "C" fn(
            *const c_char,
            c_int,
            *const c_char,
            *const c_char,
            *const Callbacks,
            c_int,
            c_int,
        ) -> *mut c_void;
        let log = Box::new(Log::default());
        let logger = arguments.with_logger.then_some(note as Logger);
        let environment = ptr::from_ref(&*log).cast_mut().cast();
        let callbacks =
            Callbacks { logger, allocate: ptr::null(), free: ptr::null(), finished: ptr::null(), environment };
        let text = |text: &Option<CString>| text.as_ref().map_or(ptr::null(), |text| text.as_ptr());
        // SAFETY: the signature is that of the standard, the strings and callbacks outlive the call.
        let component = unsafe {
            self.symbol::<Instantiate>("fmi2Instantiate")(
                text(&arguments.name),
                arguments.kind,
                text(&arguments.guid),
                text(&arguments.location),
                if arguments.with_callbacks { &raw const callbacks } else { ptr::null() },
                0,
                arguments.logging_on,
            )
        };
        if component.is_null() {
            return (None, log.lines.take());
        }
        (Some(Instance { fmu: self, component, log }), Vec::new())
    }
}

/// The arguments of `fmi2Instantiate`.
pub struct Arguments {
    pub name: Option<CString>,
    pub kind: c_int,
    pub guid: Option<CString>,
    pub location: Option<CString>,
    pub with_callbacks: bool,
    pub with_logger: bool,
    pub logging_on: c_int,
}

impl Arguments {
    pub fn of(fmu: &Fmu) -> Arguments {
        let c_string = |text: &str| Some(CString::new(text).unwrap());
        Arguments {
            name: c_string("buildings"),
            kind: 1,
            guid: c_string(&fmu.guid),
            location: c_string(&uri(&fmu.resources())),
            with_callbacks: true,
            with_logger: true,
            logging_on: 1,
        }
    }
}

/// The way most masters write it.
pub fn uri(path: &Path) -> String {
    format!("file:///{}", path.to_str().unwrap().replace('\\', "/").trim_start_matches('/'))
}

/// `fmi2CallbackFunctions`. The logger is variadic in C; the FMU passes no variable arguments.
#[repr(C)]
struct Callbacks {
    logger: Option<Logger>,
    allocate: *const c_void,
    free: *const c_void,
    finished: *const c_void,
    environment: *mut c_void,
}

type Logger = unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char);

/// What arrives at the logger.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    pub instance: String,
    pub status: c_int,
    pub category: String,
    pub message: String,
}

/// The component environment: messages, and what to do in the middle of one.
#[derive(Default)]
pub struct Log {
    lines: RefCell<Vec<Line>>,
    call_back: RefCell<Option<Box<dyn FnMut()>>>,
}

unsafe extern "C" fn note(
    environment: *mut c_void,
    instance: *const c_char,
    status: c_int,
    category: *const c_char,
    message: *const c_char,
) {
    // SAFETY: the environment that was given at instantiation, and strings that end with a zero.
    let (log, text) = unsafe {
        let text = |text| CStr::from_ptr(text).to_str().unwrap().to_owned();
        (&*environment.cast::<Log>(), (text(instance), text(category), text(message)))
    };
    let (instance, category, message) = text;
    log.lines.borrow_mut().push(Line { instance, status, category, message });
    if let Some(mut call_back) = log.call_back.take() {
        call_back();
    }
}

/// A live component; its methods are the functions of the standard.
pub struct Instance<'f> {
    pub fmu: &'f Fmu,
    pub component: *mut c_void,
    log: Box<Log>,
}

impl Drop for Instance<'_> {
    fn drop(&mut self) {
        let free = self.fmu.symbol::<unsafe extern "C" fn(*mut c_void)>("fmi2FreeInstance");
        // SAFETY: alive, and not used afterwards.
        unsafe { free(self.component) }
    }
}

type Component = *mut c_void;
type Get<T> = unsafe extern "C" fn(Component, *const u32, usize, *mut T) -> c_int;
type Set<T> = unsafe extern "C" fn(Component, *const u32, usize, *const T) -> c_int;

impl Instance<'_> {
    /// The messages so far; there are none afterwards.
    pub fn log(&self) -> Vec<Line> {
        self.log.lines.take()
    }

    /// Does something in the middle of the next message.
    pub fn in_next_message(&self, call_back: impl FnMut() + 'static) {
        *self.log.call_back.borrow_mut() = Some(Box::new(call_back));
    }

    /// A function that takes the component alone.
    pub fn call(&self, name: &str) -> c_int {
        // SAFETY: a live component, and callers name functions of this signature.
        unsafe { self.fmu.symbol::<unsafe extern "C" fn(Component) -> c_int>(name)(self.component) }
    }

    pub fn setup(&self, start: f64, stop: Option<f64>) -> c_int {
        self.setup_with(None, start, stop)
    }

    pub fn setup_with(&self, tolerance: Option<f64>, start: f64, stop: Option<f64>) -> c_int {
        type Setup = unsafe extern "C" fn(Component, c_int, f64, f64, c_int, f64) -> c_int;
        let setup = self.fmu.symbol::<Setup>("fmi2SetupExperiment");
        let flag = |value: Option<f64>| c_int::from(value.is_some());
        let (tolerance, with_tolerance) = (tolerance.unwrap_or_default(), flag(tolerance));
        // SAFETY: a live component.
        unsafe { setup(self.component, with_tolerance, tolerance, start, flag(stop), stop.unwrap_or_default()) }
    }

    /// To initialization mode, from 0 s.
    pub fn enter(&self) {
        assert_eq!(self.setup(0.0, None), OK, "{:?}", self.log());
        assert_eq!(self.call("fmi2EnterInitializationMode"), OK, "{:?}", self.log());
    }

    /// To the first communication point, 0 s.
    pub fn start(&self) {
        self.enter();
        assert_eq!(self.call("fmi2ExitInitializationMode"), OK, "{:?}", self.log());
    }

    pub fn step(&self, current: f64, step: f64) -> c_int {
        let do_step = self.fmu.symbol::<unsafe extern "C" fn(Component, f64, f64, c_int) -> c_int>("fmi2DoStep");
        // SAFETY: a live component.
        unsafe { do_step(self.component, current, step, 1) }
    }

    pub fn get_raw<T>(&self, name: &str, vr: *const u32, n: usize, values: *mut T) -> c_int {
        // SAFETY: callers pass arrays of n elements, or null.
        unsafe { self.fmu.symbol::<Get<T>>(name)(self.component, vr, n, values) }
    }

    pub fn set_raw<T>(&self, name: &str, vr: *const u32, n: usize, values: *const T) -> c_int {
        // SAFETY: callers pass arrays of n elements, or null.
        unsafe { self.fmu.symbol::<Set<T>>(name)(self.component, vr, n, values) }
    }

    /// Values by value reference: `fmi2GetReal` and the like.
    pub fn get<T: Clone + Default>(&self, name: &str, vr: &[u32]) -> Result<Vec<T>, c_int> {
        let mut values = vec![T::default(); vr.len()];
        let status = self.get_raw(name, vr.as_ptr(), vr.len(), values.as_mut_ptr());
        if status == OK { Ok(values) } else { Err(status) }
    }

    pub fn real(&self, name: &str) -> f64 {
        let value = self.get("fmi2GetReal", &[self.fmu.vr(name)]);
        value.unwrap_or_else(|status| panic!("{name}: status {status}, {:?}", self.log()))[0]
    }

    pub fn integer(&self, name: &str) -> i32 {
        self.get("fmi2GetInteger", &[self.fmu.vr(name)]).unwrap()[0]
    }

    pub fn string(&self, name: &str) -> String {
        let mut text = ptr::null::<c_char>();
        assert_eq!(self.get_raw("fmi2GetString", &self.fmu.vr(name), 1, &raw mut text), OK);
        // SAFETY: a string of the FMU, which lives until the next call.
        unsafe { CStr::from_ptr(text) }.to_str().unwrap().to_owned()
    }

    pub fn set_real(&self, name: &str, value: f64) -> c_int {
        self.set_raw("fmi2SetReal", &self.fmu.vr(name), 1, &raw const value)
    }

    pub fn set_string(&self, name: &str, value: &str) -> c_int {
        let text = CString::new(value).unwrap();
        self.set_raw("fmi2SetString", &self.fmu.vr(name), 1, &text.as_ptr())
    }

    /// `fmi2GetRealStatus` and the like.
    pub fn status<T>(&self, name: &str, kind: c_int, value: *mut T) -> c_int {
        let get = self.fmu.symbol::<unsafe extern "C" fn(Component, c_int, *mut T) -> c_int>(name);
        // SAFETY: callers pass a place of the function's type, or null.
        unsafe { get(self.component, kind, value) }
    }

    /// The bits of every Real output and every Integer output.
    pub fn outputs(&self) -> Vec<u64> {
        use fmi::model_description::fmi2::{Causality, VariableType};
        let of_type = |wanted: fn(&VariableType) -> bool| {
            let variables = self.fmu.description.modelVariables.iter();
            let outputs = variables.filter(move |v| v.causality == Causality::Output && wanted(&v.variableType));
            outputs.map(|v| v.valueReference).collect::<Vec<_>>()
        };
        let reals = of_type(|ty| matches!(ty, VariableType::Real { .. }));
        let integers = of_type(|ty| matches!(ty, VariableType::Integer { .. }));
        let reals = self.get::<f64>("fmi2GetReal", &reals).unwrap().into_iter().map(f64::to_bits);
        let integers = self.get::<i32>("fmi2GetInteger", &integers).unwrap();
        reals.chain(integers.into_iter().map(|value| u64::from(value.unsigned_abs()))).collect()
    }

    /// Steps on from a communication point; the outputs after each step.
    pub fn run(&self, from: f64, step: f64, steps: u32) -> Vec<Vec<u64>> {
        (0..steps)
            .map(|k| {
                assert_eq!(self.step(from + f64::from(k) * step, step), OK, "{:?}", self.log());
                self.outputs()
            })
            .collect()
    }
}
