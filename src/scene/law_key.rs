//! The keys that impact laws have, as the scene sees them: the catalogue of laws says which law has which.

use super::rule::{self, Rule};
use crate::contact::{ImpactLaw, LawKey, LawKind};

/// A number that a law takes from the scene.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct LawNumber {
    /// Key in the scene.
    pub name: &'static str,
    /// Which values are allowed.
    pub rule: Rule,
    /// Value where the scene gives none; `None`: the key is required.
    pub default: Option<f64>,
    /// Reads the number of a law.
    pub get: fn(&ImpactLaw) -> f64,
    /// Changes the number of a law.
    pub set: fn(&mut ImpactLaw, f64),
}

/// What the scene knows of a key.
pub fn number(key: LawKey) -> LawNumber {
    match key {
        LawKey::Stiffness => LawNumber {
            name: "stiffness",
            rule: rule::CONTACT_STIFFNESS,
            default: None,
            get: |law| law.stiffness,
            set: |law, value| law.stiffness = value,
        },
        LawKey::Exponent => LawNumber {
            name: "exponent",
            rule: rule::EXPONENT,
            default: Some(1.5),
            get: |law| law.exponent,
            set: |law, value| law.exponent = value,
        },
        LawKey::Restitution => restitution(rule::RESTITUTION),
        LawKey::ImpulseRestitution => restitution(rule::IMPULSE_RESTITUTION),
    }
}

fn restitution(rule: Rule) -> LawNumber {
    LawNumber {
        name: "restitution",
        rule,
        default: None,
        get: |law| law.restitution,
        set: |law, value| law.restitution = value,
    }
}

/// Every key that some law has, once.
pub(super) fn all() -> Vec<LawKey> {
    let mut keys = Vec::new();
    for &key in LawKind::ALL.iter().flat_map(|kind| kind.info().keys) {
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    keys
}
