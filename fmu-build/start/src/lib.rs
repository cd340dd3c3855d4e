//! What `cargo fmu` compiles and how, for the program that starts it and for itself; and a line that says how far that is.
//!
//! The command and the library of FMUs are compiled at once, from one compilation of the engine.

mod compile;
mod line;
mod watch;

pub use compile::{Compiled, cargo, compile};
pub use line::Line;
pub use watch::{Done, watch};
