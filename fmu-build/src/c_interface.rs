//! The C interface of FMI 2.0: as much of it as running a co-simulation takes.
//!
//! All `unsafe` code of this program is here. Its ground is the standard's promise of what each function reads and
//! writes; a library that breaks that promise can break this process.

use crate::experiment::CoSimulation;
use crate::functions::FUNCTIONS;
use crate::log::Log;
use anyhow::{Context, Result, bail};
use libloading::Library;
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::path::Path;
use std::ptr;

type Component = *mut c_void;
type Get<T> = unsafe extern "C" fn(Component, *const u32, usize, *mut T) -> c_int;
type Simple = unsafe extern "C" fn(Component) -> c_int;
type SetupExperiment = unsafe extern "C" fn(Component, c_int, f64, f64, c_int, f64) -> c_int;
type DoStep = unsafe extern "C" fn(Component, f64, f64, c_int) -> c_int;
type GetStatus<T> = unsafe extern "C" fn(Component, c_int, *mut T) -> c_int;
type Free = unsafe extern "C" fn(Component);
type Instantiate = unsafe extern "C" fn(
    *const c_char,
    c_int,
    *const c_char,
    *const c_char,
    *const Callbacks,
    c_int,
    c_int,
) -> Component;
/// The standard's logger takes further arguments for the placeholders of a message. They are not declared here, since
/// Rust cannot define such a function; our FMUs send finished text, and a caller's surplus arguments do no harm.
type Logger = unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char);

/// `fmi2CallbackFunctions`. The memory functions may be null where the FMU declares that it does not use them.
#[repr(C)]
struct Callbacks {
    logger: Logger,
    allocate_memory: *const c_void,
    free_memory: *const c_void,
    step_finished: *const c_void,
    environment: *mut c_void,
}

const CO_SIMULATION: c_int = 1;
const OK: c_int = 0;
const WARNING: c_int = 1;
const DISCARD: c_int = 2;
const LAST_SUCCESSFUL_TIME: c_int = 2;
const TERMINATED: c_int = 3;

/// The library of an FMU.
pub struct Binary {
    library: Library,
}

impl Binary {
    /// Loads the library, which runs what it does when it is loaded.
    pub fn load(path: &Path) -> Result<Binary> {
        // SAFETY: the user asked for this FMU to be run; loading its code is what that means.
        let library = unsafe { Library::new(path) }.with_context(|| format!("cannot load {}", path.display()))?;
        Ok(Binary { library })
    }

    /// Functions of the standard that the library does not export.
    pub fn missing_functions(&self) -> Vec<&'static str> {
        FUNCTIONS.into_iter().filter(|name| self.function::<Simple>(name).is_err()).collect()
    }

    fn function<F: Copy>(&self, name: &str) -> Result<F> {
        // SAFETY: `F` is the type that the standard gives to the function of that name (see the callers).
        let symbol = unsafe { self.library.get::<F>(name) };
        Ok(*symbol.with_context(|| format!("the library does not export {name}"))?)
    }
}

unsafe extern "C" fn logger(
    environment: *mut c_void,
    _instance: *const c_char,
    status: c_int,
    category: *const c_char,
    message: *const c_char,
) {
    // SAFETY: the environment is the `Log` that `Instance::new` passed and that outlives the instance.
    let Some(log) = (unsafe { environment.cast::<Log>().as_ref() }) else { return };
    // SAFETY: the FMU passes null or strings that live during the call.
    let (category, message) = unsafe { (text(category), text(message)) };
    if status != OK {
        // The message is a format: a percent sign is doubled in it, and so is the mark of a variable.
        log.note(&category, &message.replace("%%", "%").replace("##", "#"));
    }
}

/// # Safety
/// `string` is null or a C string that lives during the call.
unsafe fn text(string: *const c_char) -> String {
    if string.is_null() {
        return String::new();
    }
    // SAFETY: as above.
    unsafe { CStr::from_ptr(string) }.to_string_lossy().into_owned()
}

/// One instance of an FMU; freed when dropped.
pub struct Instance<'a> {
    binary: &'a Binary,
    component: Component,
    log: Box<Log>,
    /// The FMU may keep the pointer to it.
    _callbacks: Box<Callbacks>,
}

impl<'a> Instance<'a> {
    /// `fmi2Instantiate`; `resources` is the URI of the unpacked FMU's `resources` directory.
    pub fn new(binary: &'a Binary, name: &str, guid: &str, resources: &str) -> Result<Instance<'a>> {
        let instantiate: Instantiate = binary.function("fmi2Instantiate")?;
        let (name, guid, resources) = (CString::new(name)?, CString::new(guid)?, CString::new(resources)?);
        let log = Box::<Log>::default();
        let callbacks = Box::new(Callbacks {
            logger,
            allocate_memory: ptr::null(),
            free_memory: ptr::null(),
            step_finished: ptr::null(),
            environment: ptr::from_ref::<Log>(&log).cast_mut().cast(),
        });
        // SAFETY: strings and callbacks live during the call, and the latter longer than the instance.
        let component =
            unsafe { instantiate(name.as_ptr(), CO_SIMULATION, guid.as_ptr(), resources.as_ptr(), &*callbacks, 0, 1) };
        if component.is_null() {
            bail!("fmi2Instantiate refuses{}", log.explanation());
        }
        Ok(Instance { binary, component, log, _callbacks: callbacks })
    }

    fn call(&self, name: &str, call: impl FnOnce() -> c_int) -> Result<()> {
        match call() {
            OK | WARNING => Ok(()),
            status => bail!("{name} returns {}{}", status_name(status), self.log.explanation()),
        }
    }

    fn simple(&self, name: &str) -> Result<()> {
        let function: Simple = self.binary.function(name)?;
        // SAFETY: the component is alive until `self` is dropped.
        self.call(name, || unsafe { function(self.component) })
    }

    fn get<T: Clone>(&self, name: &str, references: &[u32], neutral: T) -> Result<Vec<T>> {
        let function: Get<T> = self.binary.function(name)?;
        let mut values = vec![neutral; references.len()];
        // SAFETY: both arrays have the length that is passed.
        self.call(name, || unsafe {
            function(self.component, references.as_ptr(), references.len(), values.as_mut_ptr())
        })?;
        Ok(values)
    }

    fn status<T: Default>(&self, name: &str, kind: c_int) -> Result<T> {
        let function: GetStatus<T> = self.binary.function(name)?;
        let mut value = T::default();
        // SAFETY: the component is alive until `self` is dropped, and the value has the type that the function writes.
        self.call(name, || unsafe { function(self.component, kind, &mut value) })?;
        Ok(value)
    }
}

impl CoSimulation for Instance<'_> {
    fn set_up(&self, start: f64, stop: f64) -> Result<()> {
        let setup: SetupExperiment = self.binary.function("fmi2SetupExperiment")?;
        // SAFETY: the component is alive until `self` is dropped.
        self.call("fmi2SetupExperiment", || unsafe { setup(self.component, 0, 0.0, start, 1, stop) })?;
        self.simple("fmi2EnterInitializationMode")
    }

    fn begin(&self) -> Result<()> {
        self.simple("fmi2ExitInitializationMode")
    }

    fn do_step(&self, time: f64, step: f64) -> Result<Option<f64>> {
        let do_step: DoStep = self.binary.function("fmi2DoStep")?;
        // SAFETY: the component is alive until `self` is dropped.
        let status = unsafe { do_step(self.component, time, step, 1) };
        let is_over = status == DISCARD && self.status::<c_int>("fmi2GetBooleanStatus", TERMINATED)? != 0;
        match is_over {
            true => self.status("fmi2GetRealStatus", LAST_SUCCESSFUL_TIME).map(Some),
            false => self.call("fmi2DoStep", || status).map(|()| None),
        }
    }

    fn reals(&self, references: &[u32]) -> Result<Vec<f64>> {
        self.get("fmi2GetReal", references, 0.0)
    }

    fn integers(&self, references: &[u32]) -> Result<Vec<i32>> {
        self.get("fmi2GetInteger", references, 0)
    }

    fn booleans(&self, references: &[u32]) -> Result<Vec<bool>> {
        Ok(self.get::<c_int>("fmi2GetBoolean", references, 0)?.into_iter().map(|value| value != 0).collect())
    }

    fn strings(&self, references: &[u32]) -> Result<Vec<String>> {
        let pointers = self.get::<*const c_char>("fmi2GetString", references, ptr::null())?;
        // SAFETY: the FMU keeps the strings until the next call.
        Ok(pointers.into_iter().map(|string| unsafe { text(string) }).collect())
    }

    fn end(&self) -> Result<Vec<String>> {
        self.simple("fmi2Terminate")?;
        Ok(self.log.take())
    }
}

impl Drop for Instance<'_> {
    fn drop(&mut self) {
        if let Ok(free) = self.binary.function::<Free>("fmi2FreeInstance") {
            // SAFETY: the component is alive and is not used again.
            unsafe { free(self.component) };
        }
    }
}

fn status_name(status: c_int) -> String {
    let names = ["fmi2OK", "fmi2Warning", "fmi2Discard", "fmi2Error", "fmi2Fatal", "fmi2Pending"];
    let known = usize::try_from(status).ok().and_then(|index| names.get(index));
    known.map_or_else(|| format!("status {status}"), |name| (*name).into())
}
