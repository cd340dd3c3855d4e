//! Power series of contact forces from those of the penetrations, term by term, while a step is expanded.

mod block;
mod laws;
mod reading;

pub(crate) use super::force::Kind;
pub(crate) use block::{Each, PAIRS, PairBlock, ROOT};
pub(crate) use reading::{BlockReading, ForceReading};
