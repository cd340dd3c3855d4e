//! What differs between the commands that share this library.

use crate::libraries::Libraries;
use anyhow::Result;
use std::io;
use std::path::PathBuf;
use std::process::Command;

/// A command: `cargo fmu` in a checkout, or `pounding-fmu` where everything has been compiled before.
pub trait Face {
    /// What the user types.
    fn name(&self) -> &'static str;

    /// This command once more, for a process of its own.
    ///
    /// # Errors
    /// Where this program does not know what it is.
    fn again(&self) -> io::Result<Command>;

    /// Where it takes from and puts what nobody has named.
    ///
    /// # Errors
    /// Where there is no such place.
    fn home(&self) -> Result<Home>;
}

/// Where a command takes from and puts what nobody has named.
pub struct Home {
    /// The scene that is built when none is given.
    pub default_scene: PathBuf,
    /// The folder of FMUs.
    pub fmus: PathBuf,
    /// Whether a note beside such an FMU says of which scene it is.
    pub has_notes: bool,
    /// The libraries.
    pub libraries: Box<dyn Libraries>,
}
