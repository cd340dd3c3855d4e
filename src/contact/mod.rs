//! Contact of two floors: the laws of the impact force and what is known of them.

mod catalogue;
pub mod damping_formula;
pub mod force;
pub mod law;
mod law_kind;
pub mod laws;
pub mod onset;
mod rates;
pub mod taylor;

pub use damping_formula::DampingFormula;
pub use force::{EpisodeForce, Force, Guard};
pub use law::{ImpactLaw, LawInfo, LawKey, StiffnessUnit};
pub use law_kind::LawKind;
