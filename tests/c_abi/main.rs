//! The compiled library through its C interface, as a master uses it and as it should not.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "../problems/mod.rs"]
mod problems;
#[path = "../support/mod.rs"]
mod support;

mod arguments;
mod derivatives;
mod directional;
mod instantiation;
mod limits;
mod logging;
mod outputs;
mod rollback;
mod sequence;
mod serialized;
mod state;
mod stepping;
mod symbols;
mod values;
mod warnings;
