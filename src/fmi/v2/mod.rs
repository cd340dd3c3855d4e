//! The 44 functions of FMI 2.0: 34 for co-simulation, and 10 for Model Exchange, which these FMUs do not offer (`refused.rs`),
//! since there are importers that look for all of them.

mod derivatives;
mod life;
mod refused;
mod state;
mod step;
mod types;
mod values;

pub use derivatives::*;
pub use life::*;
pub use refused::*;
pub use state::*;
pub use step::*;
pub use types::CallbackFunctions;
pub use values::*;
