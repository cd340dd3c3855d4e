//! Buildings whose foundations sway and rock: against an independent solution in quadruple precision, closed forms,
//! matrices, and the same run told in another way.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod closed_forms;
#[path = "../common/mod.rs"]
mod common;
mod frames;
mod inputs;
mod invariants;
#[path = "../physics/piecewise/mod.rs"]
mod piecewise;
mod random;
#[path = "../problems/random_frames.rs"]
mod random_frames;
#[path = "../problems/random_soil.rs"]
mod random_soil;
mod reference;
mod soil;
