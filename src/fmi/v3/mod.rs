//! The 75 functions of FMI 3.0: 27 for co-simulation, of which `events.rs` and `step.rs` have what FMI 2.0 lacks, and 48
//! for what these FMUs do not offer (`refused.rs`), since masters look for all of them.

mod derivatives;
mod events;
mod life;
mod refused;
mod state;
mod step;
mod types;
mod values;

pub use derivatives::*;
pub use events::*;
pub use life::*;
pub use refused::*;
pub use state::*;
pub use step::*;
pub use values::*;
