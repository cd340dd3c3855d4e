//! Panics end here: none may leave this library.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// The value of a call, or what its panic says. The caller sees to it that nothing which the panic has left half done is
/// used again.
#[inline(always)]
pub(super) fn caught<T>(call: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(call)).map_err(|panic| text_of(&*panic))
}

#[cold]
fn text_of(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "panic".to_owned())
}
