//! The co-simulation object, in safe Rust and without a word of C.
//!
//! The caller asks [`Slave::check`] before each call (`sequence.rs` has the table), reports what comes back with
//! [`Slave::report`] and hands the messages of [`Slave::take_messages`] to the master. `instance.rs` has its life and its
//! steps. Values go through `access.rs`, which walks the table of variables, derivatives through `derivatives.rs`;
//! `states.rs` records what the master wants to come back to, `snapshots.rs` keeps it, `serialized.rs` turns it into bytes
//! and back.

mod access;
mod derivatives;
mod instance;
mod instantiate;
mod log;
mod resource_location;
mod run;
mod sequence;
mod serialized;
mod simulation;
mod snapshots;
mod states;
mod status;

pub use instance::Slave;
pub use instantiate::instantiate;
pub use log::{Log, Message};
pub use sequence::{Call, Phase};
pub use snapshots::Handle;
pub use status::{Refusal, Status, StatusKind};
