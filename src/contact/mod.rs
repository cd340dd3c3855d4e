//! Contact of two floors: the laws of the impact force and what is known of them.

pub mod law;

pub use law::{ImpactLaw, LawKey, LawKind};
