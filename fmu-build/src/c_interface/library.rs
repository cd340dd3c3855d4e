//! A library, and an instance in it as both versions have one.

use crate::functions::functions;
use crate::log::Log;
use anyhow::{Context, Result, bail};
use libloading::Library;
use pounding::FmiVersion;
use std::ffi::{CStr, c_char, c_int, c_void};
use std::path::Path;

pub(super) type Component = *mut c_void;
type Simple = unsafe extern "C" fn(Component) -> c_int;
type Free = unsafe extern "C" fn(Component);

pub(super) const OK: c_int = 0;
const WARNING: c_int = 1;
pub(super) const DISCARD: c_int = 2;

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

    /// Functions of a version that the library does not export.
    pub fn missing_functions(&self, version: FmiVersion) -> Vec<&'static str> {
        functions(version).iter().copied().filter(|name| self.function::<Simple>(name).is_err()).collect()
    }

    pub(super) fn function<F: Copy>(&self, name: &str) -> Result<F> {
        // SAFETY: `F` is the type that the standard gives to the function of that name (see the callers).
        let symbol = unsafe { self.library.get::<F>(name) };
        Ok(*symbol.with_context(|| format!("the library does not export {name}"))?)
    }
}

/// # Safety
/// `string` is null or a C string that lives during the call.
pub(super) unsafe fn text(string: *const c_char) -> String {
    if string.is_null() {
        return String::new();
    }
    // SAFETY: as above.
    unsafe { CStr::from_ptr(string) }.to_string_lossy().into_owned()
}

/// An instance that is there; freed when dropped.
pub(super) struct Handle<'a> {
    pub binary: &'a Binary,
    pub component: Component,
    pub log: Box<Log>,
    /// How the names of the functions begin.
    pub prefix: &'static str,
}

impl Handle<'_> {
    /// What a call of the function without its prefix has come to.
    pub fn call(&self, name: &str, call: impl FnOnce() -> c_int) -> Result<()> {
        match call() {
            OK | WARNING => Ok(()),
            status => bail!("{}{name} returns {}{}", self.prefix, self.status_name(status), self.log.explanation()),
        }
    }

    /// Calls a function that takes nothing else.
    pub fn simple(&self, name: &str) -> Result<()> {
        let function: Simple = self.function(name)?;
        // SAFETY: the component is alive until `self` is dropped.
        self.call(name, || unsafe { function(self.component) })
    }

    pub fn function<F: Copy>(&self, name: &str) -> Result<F> {
        self.binary.function(&format!("{}{name}", self.prefix))
    }

    fn status_name(&self, status: c_int) -> String {
        let names = ["OK", "Warning", "Discard", "Error", "Fatal", "Pending"];
        let known = usize::try_from(status).ok().and_then(|index| names.get(index));
        known.map_or_else(|| format!("status {status}"), |name| format!("{}{name}", self.prefix))
    }
}

impl Drop for Handle<'_> {
    fn drop(&mut self) {
        if let Ok(free) = self.function::<Free>("FreeInstance") {
            // SAFETY: the component is alive and is not used again.
            unsafe { free(self.component) };
        }
    }
}
