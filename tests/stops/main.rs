//! Stops at events: nothing that a run shows depends on whether it stops there, and what jumps does so at its event.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "../common/mod.rs"]
mod common;
mod driven;
mod limits;
mod runs;
mod same_bits;
