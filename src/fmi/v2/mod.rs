//! The 34 functions of FMI 2.0 for co-simulation.

mod derivatives;
mod life;
mod state;
mod step;
mod types;
mod values;

pub use derivatives::*;
pub use life::*;
pub use state::*;
pub use step::*;
pub use types::CallbackFunctions;
pub use values::*;
