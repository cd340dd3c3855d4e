//! A law with its numbers, and what the catalogue in [`super::laws`] knows of each law.

use super::damping_formula::DampingFormula;
use super::force::EpisodeForce;
use super::law_kind::LawKind;

/// A law with its numbers. Numbers that the law does not have keep their neutral value.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ImpactLaw {
    /// Which law.
    pub kind: LawKind,
    /// k, N/m^exponent.
    pub stiffness: f64,
    /// n, exponent of the penetration (neutral: 1).
    pub exponent: f64,
    /// e, restitution of a free impact that the law aims at (neutral: 1).
    pub restitution: f64,
    /// Where the law has one.
    pub damping_formula: Option<DampingFormula>,
}

impl ImpactLaw {
    /// A law with neutral numbers, a stiffness of 1 and no damping formula: set those that it has.
    pub const fn new(kind: LawKind) -> ImpactLaw {
        ImpactLaw { kind, stiffness: 1.0, exponent: 1.0, restitution: 1.0, damping_formula: None }
    }
}

/// What is known of one law: all that is particular to it stands in its file. The texts are for a person and stand in
/// docs/reference.md and in docs/laws.md as they are here.
///
/// Symbols that all laws share: penetration d, m, its rate v, m/s, and the approach velocity V, m/s, which is v at the
/// entry; the reduced mass m of the two floors, kg; the coefficient of restitution e, the speed after a free impact
/// relative to that before.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct LawInfo {
    /// Name in a scene, and of the law's file.
    pub name: &'static str,
    /// The force while d > 0.
    pub force: &'static str,
    /// Symbols of its own with their units; k is the stiffness, in [`LawInfo::stiffness_unit`].
    pub symbols: &'static str,
    /// Where it comes from: entries of REFERENCES.bib.
    pub source: &'static str,
    /// Restitution of a free impact.
    pub returns: &'static str,
    /// Range of validity.
    pub valid: &'static str,
    /// What is wrong with it.
    pub defect: &'static str,
    /// The keys that the law has, all required but `exponent`.
    pub keys: &'static [LawKey],
    /// Whether its force can be tension.
    pub pulls: bool,
    /// Whether the law has the key `damping_formula`.
    pub has_damping_formula: bool,
    /// Unit of k; `None` for rigid floors, which cannot overlap.
    pub stiffness_unit: Option<StiffnessUnit>,
    /// The law in one episode: see [`EpisodeForce::new`].
    pub episode: fn(law: &ImpactLaw, mass: f64, approach: Option<f64>) -> EpisodeForce,
}

/// A number that a law takes from the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum LawKey {
    /// `stiffness` k, N/m^exponent, > 0
    Stiffness,
    /// `exponent` n of the penetration, 1 <= n <= 3
    Exponent,
    /// `restitution` e, 0 < e <= 1
    Restitution,
    /// `restitution` e of an instantaneous impact, 0 <= e <= 1
    ImpulseRestitution,
}

/// Unit of the stiffness k.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StiffnessUnit {
    /// A linear spring.
    NewtonPerMetre,
    /// A spring of exponent 1.5.
    NewtonPerMetreToTheThreeHalves,
    /// A spring whose exponent is a number of the law.
    NewtonPerMetreToTheExponent,
}

impl StiffnessUnit {
    /// As it is written.
    pub const fn name(self) -> &'static str {
        match self {
            StiffnessUnit::NewtonPerMetre => "N/m",
            StiffnessUnit::NewtonPerMetreToTheThreeHalves => "N/m^1.5",
            StiffnessUnit::NewtonPerMetreToTheExponent => "N/m^exponent",
        }
    }
}
