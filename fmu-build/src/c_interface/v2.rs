//! FMI 2.0.

use super::library::{Binary, Component, DISCARD, Handle, OK, text};
use crate::archive;
use crate::experiment::CoSimulation;
use crate::log::Log;
use anyhow::{Result, bail};
use std::ffi::{CString, c_char, c_int, c_void};
use std::path::Path;
use std::ptr;

type Get<T> = unsafe extern "C" fn(Component, *const u32, usize, *mut T) -> c_int;
type SetupExperiment = unsafe extern "C" fn(Component, c_int, f64, f64, c_int, f64) -> c_int;
type DoStep = unsafe extern "C" fn(Component, f64, f64, c_int) -> c_int;
type GetStatus<T> = unsafe extern "C" fn(Component, c_int, *mut T) -> c_int;
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
const LAST_SUCCESSFUL_TIME: c_int = 2;
const TERMINATED: c_int = 3;

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

/// One instance of an FMU; freed when dropped.
pub(super) struct Instance<'a> {
    handle: Handle<'a>,
    /// The FMU may keep the pointer to it.
    _callbacks: Box<Callbacks>,
}

impl<'a> Instance<'a> {
    /// `fmi2Instantiate` of the FMU that is unpacked there.
    pub fn new(binary: &'a Binary, name: &str, guid: &str, root: &Path) -> Result<Instance<'a>> {
        let instantiate: Instantiate = binary.function("fmi2Instantiate")?;
        let resources = CString::new(archive::resource_uri(root))?;
        let (name, guid) = (CString::new(name)?, CString::new(guid)?);
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
        Ok(Instance { handle: Handle { binary, component, log, prefix: "fmi2" }, _callbacks: callbacks })
    }

    fn get<T: Clone>(&self, name: &str, references: &[u32], neutral: T) -> Result<Vec<T>> {
        let function: Get<T> = self.handle.function(name)?;
        let mut values = vec![neutral; references.len()];
        // SAFETY: both arrays have the length that is passed.
        self.handle.call(name, || unsafe {
            function(self.handle.component, references.as_ptr(), references.len(), values.as_mut_ptr())
        })?;
        Ok(values)
    }

    fn status<T: Default>(&self, name: &str, kind: c_int) -> Result<T> {
        let function: GetStatus<T> = self.handle.function(name)?;
        let mut value = T::default();
        // SAFETY: the component is alive until `self` is dropped, and the value has the type that the function writes.
        self.handle.call(name, || unsafe { function(self.handle.component, kind, &mut value) })?;
        Ok(value)
    }
}

impl CoSimulation for Instance<'_> {
    fn set_up(&self, start: f64, stop: f64) -> Result<()> {
        let setup: SetupExperiment = self.handle.function("SetupExperiment")?;
        // SAFETY: the component is alive until `self` is dropped.
        self.handle.call("SetupExperiment", || unsafe { setup(self.handle.component, 0, 0.0, start, 1, stop) })?;
        self.handle.simple("EnterInitializationMode")
    }

    fn begin(&self) -> Result<()> {
        self.handle.simple("ExitInitializationMode")
    }

    fn do_step(&self, time: f64, step: f64) -> Result<Option<f64>> {
        let do_step: DoStep = self.handle.function("DoStep")?;
        // SAFETY: the component is alive until `self` is dropped.
        let status = unsafe { do_step(self.handle.component, time, step, 1) };
        let is_over = status == DISCARD && self.status::<c_int>("GetBooleanStatus", TERMINATED)? != 0;
        match is_over {
            true => self.status("GetRealStatus", LAST_SUCCESSFUL_TIME).map(Some),
            false => self.handle.call("DoStep", || status).map(|()| None),
        }
    }

    fn reals(&self, references: &[u32]) -> Result<Vec<f64>> {
        self.get("GetReal", references, 0.0)
    }

    fn integers(&self, references: &[u32]) -> Result<Vec<i32>> {
        self.get("GetInteger", references, 0)
    }

    fn booleans(&self, references: &[u32]) -> Result<Vec<bool>> {
        Ok(self.get::<c_int>("GetBoolean", references, 0)?.into_iter().map(|value| value != 0).collect())
    }

    fn strings(&self, references: &[u32]) -> Result<Vec<String>> {
        let pointers = self.get::<*const c_char>("GetString", references, ptr::null())?;
        // SAFETY: the FMU keeps the strings until the next call.
        Ok(pointers.into_iter().map(|string| unsafe { text(string) }).collect())
    }

    fn end(&self) -> Result<Vec<String>> {
        self.handle.simple("Terminate")?;
        Ok(self.handle.log.take())
    }
}
