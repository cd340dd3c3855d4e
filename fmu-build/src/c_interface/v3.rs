//! FMI 3.0, without events: the master takes neither early return nor Event Mode.

use super::library::{Binary, Component, DISCARD, Handle, OK, text};
use crate::experiment::CoSimulation;
use crate::log::Log;
use crate::steps::Stepped;
use anyhow::{Result, bail};
use std::ffi::{CString, c_char, c_int, c_void};
use std::path::Path;
use std::ptr;

/// `fmi3Boolean`: a `bool` of C, read as the byte that it is.
type Bool = u8;
type Get<T> = unsafe extern "C" fn(Component, *const u32, usize, *mut T, usize) -> c_int;
type EnterInitializationMode = unsafe extern "C" fn(Component, Bool, f64, f64, Bool, f64) -> c_int;
type DoStep = unsafe extern "C" fn(Component, f64, f64, Bool, *mut Bool, *mut Bool, *mut Bool, *mut f64) -> c_int;
type Logger = unsafe extern "C" fn(*mut c_void, c_int, *const c_char, *const c_char);
type InstantiateCoSimulation = unsafe extern "C" fn(
    *const c_char,
    *const c_char,
    *const c_char,
    Bool,
    Bool,
    Bool,
    Bool,
    *const u32,
    usize,
    *mut c_void,
    Logger,
    *const c_void,
) -> Component;

unsafe extern "C" fn logger(environment: *mut c_void, status: c_int, category: *const c_char, message: *const c_char) {
    // SAFETY: the environment is the `Log` that `Instance::new` passed and that outlives the instance.
    let Some(log) = (unsafe { environment.cast::<Log>().as_ref() }) else { return };
    // SAFETY: the FMU passes null or strings that live during the call.
    let (category, message) = unsafe { (text(category), text(message)) };
    if status != OK {
        // The mark of a variable is doubled.
        log.note(&category, &message.replace("##", "#"));
    }
}

/// One instance of an FMU; freed when dropped.
pub(super) struct Instance<'a>(Handle<'a>);

impl<'a> Instance<'a> {
    /// `fmi3InstantiateCoSimulation` of the FMU that is unpacked there.
    pub fn new(binary: &'a Binary, name: &str, token: &str, root: &Path) -> Result<Instance<'a>> {
        let instantiate: InstantiateCoSimulation = binary.function("fmi3InstantiateCoSimulation")?;
        // With the separator at its end, as the standard has it.
        let resources = std::path::absolute(root)?.join("resources").join("");
        let (name, token) = (CString::new(name)?, CString::new(token)?);
        let resources = CString::new(resources.to_string_lossy().into_owned())?;
        let log = Box::<Log>::default();
        let environment = ptr::from_ref::<Log>(&log).cast_mut().cast();
        let (strings, none) = ([name.as_ptr(), token.as_ptr(), resources.as_ptr()], ptr::null());
        // SAFETY: the strings live during the call, and the log longer than the instance.
        let component = unsafe {
            instantiate(strings[0], strings[1], strings[2], 0, 1, 0, 0, ptr::null(), 0, environment, logger, none)
        };
        if component.is_null() {
            bail!("fmi3InstantiateCoSimulation refuses{}", log.explanation());
        }
        Ok(Instance(Handle { binary, component, log, prefix: "fmi3" }))
    }

    fn get<T: Clone>(&self, name: &str, references: &[u32], neutral: T) -> Result<Vec<T>> {
        let function: Get<T> = self.0.function(name)?;
        let mut values = vec![neutral; references.len()];
        let count = references.len();
        // SAFETY: both arrays have the length that is passed.
        self.0.call(name, || unsafe {
            function(self.0.component, references.as_ptr(), count, values.as_mut_ptr(), count)
        })?;
        Ok(values)
    }
}

impl CoSimulation for Instance<'_> {
    fn set_up(&self, start: f64, stop: f64) -> Result<()> {
        let enter: EnterInitializationMode = self.0.function("EnterInitializationMode")?;
        // SAFETY: the component is alive until `self` is dropped.
        self.0.call("EnterInitializationMode", || unsafe { enter(self.0.component, 0, 0.0, start, 1, stop) })
    }

    fn begin(&self) -> Result<()> {
        self.0.simple("ExitInitializationMode")
    }

    fn do_step(&self, time: f64, step: f64) -> Result<Option<f64>> {
        let do_step: DoStep = self.0.function("DoStep")?;
        let (mut event, mut terminate, mut early, mut last) = (0, 0, 0, f64::NAN);
        // SAFETY: the component is alive until `self` is dropped, and the results have the types that are written.
        let status =
            unsafe { do_step(self.0.component, time, step, 1, &mut event, &mut terminate, &mut early, &mut last) };
        if !(status == DISCARD && terminate != 0) {
            self.0.call("DoStep", || status)?;
        }
        Stepped { event: event != 0, terminate: terminate != 0, early: early != 0, last }.without_events(time, step)
    }

    fn reals(&self, references: &[u32]) -> Result<Vec<f64>> {
        self.get("GetFloat64", references, 0.0)
    }

    fn integers(&self, references: &[u32]) -> Result<Vec<i32>> {
        self.get("GetInt32", references, 0)
    }

    fn booleans(&self, references: &[u32]) -> Result<Vec<bool>> {
        Ok(self.get::<Bool>("GetBoolean", references, 0)?.into_iter().map(|value| value != 0).collect())
    }

    fn strings(&self, references: &[u32]) -> Result<Vec<String>> {
        let pointers = self.get::<*const c_char>("GetString", references, ptr::null())?;
        // SAFETY: the FMU keeps the strings until the next call.
        Ok(pointers.into_iter().map(|string| unsafe { text(string) }).collect())
    }

    fn end(&self) -> Result<Vec<String>> {
        self.0.simple("Terminate")?;
        Ok(self.0.log.take())
    }
}
