//! What both versions share: nothing here has a name in C.

pub(super) mod arguments;
pub(super) mod derivatives;
pub(super) mod fence;
pub(super) mod instance;
pub(super) mod logger;
mod panics;
pub(super) mod state;
#[cfg(test)]
mod test_support;
pub(super) mod types;
pub(super) mod updater;
pub(super) mod values;
