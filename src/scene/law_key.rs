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
    /// The number of a law, to be read or changed.
    of: fn(&mut ImpactLaw) -> &mut f64,
}

impl LawNumber {
    const fn new(
        name: &'static str,
        rule: Rule,
        default: Option<f64>,
        of: fn(&mut ImpactLaw) -> &mut f64,
    ) -> LawNumber {
        LawNumber { name, rule, default, of }
    }

    /// Reads the number of a law.
    pub fn get(&self, law: &ImpactLaw) -> f64 {
        *(self.of)(&mut law.clone())
    }

    /// Changes the number of a law.
    pub fn set(&self, law: &mut ImpactLaw, value: f64) {
        *(self.of)(law) = value;
    }
}

/// What the scene knows of a key.
pub fn number(key: LawKey) -> LawNumber {
    match key {
        LawKey::Stiffness => LawNumber::new("stiffness", rule::CONTACT_STIFFNESS, None, |law| &mut law.stiffness),
        LawKey::Exponent => LawNumber::new("exponent", rule::EXPONENT, Some(1.5), |law| &mut law.exponent),
        LawKey::Restitution => LawNumber::new("restitution", rule::RESTITUTION, None, |law| &mut law.restitution),
        LawKey::ImpulseRestitution => LawNumber { rule: rule::IMPULSE_RESTITUTION, ..number(LawKey::Restitution) },
    }
}

/// The key of each name, as the law that allows it the most has it.
pub(super) fn widest() -> impl Iterator<Item = LawNumber> {
    // A restitution of 0 is that of an impulse alone.
    all().into_iter().filter(|key| *key != LawKey::Restitution).map(number)
}

/// Every key that some law has, once.
fn all() -> Vec<LawKey> {
    let mut keys = Vec::new();
    for &key in LawKind::ALL.iter().flat_map(|kind| kind.info().keys) {
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    keys
}
