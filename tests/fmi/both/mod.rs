//! What both versions are asked.

mod calls;
mod derivatives;
mod directional;
mod instantiation;
mod logging;
mod numbers_only;
mod refused;
mod sequence;
mod serialized;
mod states;
mod stepping;
mod values;
mod warnings;

pub use calls::{TABLE_3, call};
