//! The co-simulation object, in safe Rust and without a word of C.
//!
//! The caller asks [`Slave::check`] before each call (`sequence.rs` has the table), reports what comes back with
//! [`Slave::report`] and hands the messages of [`Slave::take_messages`] to the master. `instance.rs` has its life,
//! `steps.rs` its steps and events, `updates.rs` the turns of the master within a step (`stepped.rs` what a step comes
//! to), `interface.rs` what the master has chosen of steps. Values go through `access.rs`, which walks the table of
//! variables, derivatives through `derivatives.rs`; `states.rs` records what the master wants to come back to,
//! `snapshots.rs` keeps it, `serialized.rs` turns it into bytes and back; `run.rs` holds time and inputs until a
//! simulation starts, and that from then on.
//!
//! ```
//! use pounding::description::Package;
//! use pounding::FmiVersion;
//! use pounding::slave::{Interface, Log, Slave};
//!
//! let text = "name = \"Mast\"\n\
//!     left = { mass = [1e3], stiffness = [1e5], damping = { ratio = 0.0 }, initial_velocity = [0.1] }";
//! let package = Package::from_scene_text(text.to_owned(), ".".as_ref())?;
//! let log = Log::new(FmiVersion::V2, false);
//! let mut slave = Slave::new(package, Interface::V2, log);
//! slave.enter_initialization();
//! slave.exit_initialization().expect("a sound scene");
//! slave.do_step(0.0, 2.0).expect("2 s of nothing but swinging");
//! assert_eq!(slave.last_successful_time(), 2.0);
//! # Ok::<(), pounding::scene::SceneError>(())
//! ```
//!
//! A [`Refusal`] lists everything that was wrong with a call. The call has then changed nothing, but for a step that
//! the engine has given up on its way.

mod access;
mod derivatives;
mod held;
mod instance;
mod instantiate;
mod interface;
mod log;
mod resource_location;
mod run;
mod sequence;
mod serialized;
mod simulation;
mod snapshots;
mod states;
mod status;
mod stepped;
mod steps;
mod updates;

pub use instance::Slave;
pub use instantiate::instantiate;
pub use interface::Interface;
pub use log::{Log, Message};
pub use sequence::{Call, Phase};
pub use snapshots::Handle;
pub use status::{Refusal, Status, StatusKind};
pub use stepped::{StepPart, Stepped, Update};
