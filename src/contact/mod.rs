//! Contact of two floors: the laws of the impact force and what is known of them.
//!
//! ```
//! use pounding::contact::{EpisodeForce, ImpactLaw, LawKind};
//!
//! // Which laws there are, and what is known of each.
//! for law in LawKind::ALL {
//!     println!("{}: {}", law.info().name, law.info().force);
//! }
//! let mut law = ImpactLaw::new(LawKind::from_name("linear").expect("a law of the catalogue"));
//! law.stiffness = 2e6; // N/m
//! // In an episode between floors with a reduced mass of 1 t that meet at 0.1 m/s, 1 mm deep.
//! assert_eq!(EpisodeForce::new(&law, 1e3, Some(0.1)).value(1e-3, 0.0), 2e3);
//! ```

mod catalogue;
pub(crate) mod damping_formula;
pub(crate) mod force;
pub(crate) mod law;
mod law_kind;
pub mod laws;
pub(crate) mod onset;
mod rates;
pub(crate) mod taylor;

pub use damping_formula::DampingFormula;
pub use force::{EpisodeForce, Force, Guard};
pub use law::{ImpactLaw, LawInfo, LawKey, StiffnessUnit};
pub use law_kind::LawKind;
