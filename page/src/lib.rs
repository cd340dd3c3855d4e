//! The engine for a browser page. A page asks it by messages: bytes in, bytes and numbers out; the module imports nothing.
//!
//! | file | holds |
//! |---|---|
//! | `exports.rs` | the C functions of the module: room for a message, the call, where the answer is (the only unsafe code) |
//! | `message.rs` | questions, answers and refusals as bytes |
//! | `desk.rs` | what is asked, and who answers it |
//! | `scene.rs` | the scene of a question; what is wrong and odd in it, with lines |
//! | `look.rs` | what can be drawn of a scene before it is run |
//! | `job.rs` | what takes long, in slices: after each the page can show how far it is |
//! | `close.rs` | the name that may have been meant |
//! | `run.rs`, `study.rs`, `spectrum.rs` | the jobs: a run, the same scene with many gaps, the spectrum of a record |
//! | `motion.rs` | what is in a record |
//! | `files.rs` | FMU, tables and report of a scene, as the commands write them |
//! | `edit/` | values of a scene's text, set by path |
//! | `laws.rs` | the laws of contact, to choose from |
#![deny(unsafe_code)]

mod close;
pub mod desk;
mod edit;
#[allow(unsafe_code)]
mod exports;
mod files;
mod job;
mod laws;
mod look;
pub mod message;
mod motion;
mod run;
mod scene;
mod spectrum;
mod study;
