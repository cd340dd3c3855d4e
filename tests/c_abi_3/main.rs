//! The C interface of FMI 3.0, as a master uses it and as it should not.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "../support/linked_3.rs"]
mod linked_3;
#[path = "../support/mod.rs"]
mod support;

mod arguments;
mod derivatives;
mod events;
mod instantiation;
mod life;
mod logging;
mod refused;
mod sequence;
mod states;
mod stepping;
mod updates;
mod values;
mod versions;
