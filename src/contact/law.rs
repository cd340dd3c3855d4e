//! The catalogue of impact laws: their names in a scene, the keys that each one has and what each one is.
//!
//! A law is added here, with one line of [`LawKind`] and its row of [`LawKind::info`]; scene, FMU variables and
//! the test of the documents read this table.

use super::DampingFormula;

/// The impact laws, under their scene names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LawKind {
    /// `stereomechanical`: no force but an instantaneous exchange of momentum that returns e; held together where
    /// rebounds die out (seed paper, eqs. 1, 2)
    Stereomechanical,
    /// `linear`: F = k d; elastic, restitution 1 (seed paper, eq. 3)
    Linear,
    /// `kelvin_voigt`: F = k d + c v until d = 0, tension kept; restitution of a free impact exactly e (eqs. 4, 5)
    KelvinVoigt,
    /// `kelvin_voigt_no_tension`: F = max(0, k d + c v); returns more than e, 0.5503 for e = 0.5 (sec. 2.2)
    KelvinVoigtNoTension,
    /// `hertz`: F = k d^n; elastic, restitution 1 (eq. 6)
    Hertz,
    /// `jankowski`: F = k d^1.5 + c v while v > 0, k d^1.5 after; returns 0.4946 for e = 0.5 (eqs. 7, 8)
    Jankowski,
    /// `hertz_damped`: F = k d^n max(0, 1 + a v / V), a by damping_formula (eqs. 9-11, 14)
    HertzDamped,
}

/// A number that a law takes from the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
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

/// What the catalogue knows of one law.
#[derive(Clone, Copy, Debug)]
pub struct LawInfo {
    /// Name in a scene.
    pub name: &'static str,
    /// The keys that the law has, all required but `exponent`.
    pub keys: &'static [LawKey],
    /// Whether the law has the key `damping_formula`.
    pub has_damping_formula: bool,
}

impl LawKind {
    /// All laws, in the order in which the documentation shows them.
    pub const ALL: &'static [LawKind] = &[
        LawKind::Stereomechanical,
        LawKind::Linear,
        LawKind::KelvinVoigt,
        LawKind::KelvinVoigtNoTension,
        LawKind::Hertz,
        LawKind::Jankowski,
        LawKind::HertzDamped,
    ];

    /// The law's row of the catalogue.
    pub const fn info(self) -> LawInfo {
        match self {
            LawKind::Stereomechanical => {
                LawInfo { name: "stereomechanical", keys: &[LawKey::ImpulseRestitution], has_damping_formula: false }
            }
            LawKind::Linear => LawInfo { name: "linear", keys: &[LawKey::Stiffness], has_damping_formula: false },
            LawKind::KelvinVoigt => LawInfo {
                name: "kelvin_voigt",
                keys: &[LawKey::Stiffness, LawKey::Restitution],
                has_damping_formula: false,
            },
            LawKind::KelvinVoigtNoTension => LawInfo {
                name: "kelvin_voigt_no_tension",
                keys: &[LawKey::Stiffness, LawKey::Restitution],
                has_damping_formula: false,
            },
            LawKind::Hertz => {
                LawInfo { name: "hertz", keys: &[LawKey::Stiffness, LawKey::Exponent], has_damping_formula: false }
            }
            LawKind::Jankowski => LawInfo {
                name: "jankowski",
                keys: &[LawKey::Stiffness, LawKey::Restitution],
                has_damping_formula: false,
            },
            LawKind::HertzDamped => LawInfo {
                name: "hertz_damped",
                keys: &[LawKey::Stiffness, LawKey::Exponent, LawKey::Restitution],
                has_damping_formula: true,
            },
        }
    }

    /// The law of that name in a scene.
    pub fn from_name(name: &str) -> Option<LawKind> {
        Self::ALL.iter().copied().find(|kind| kind.info().name == name)
    }
}

/// A law with its numbers. Numbers that the law does not have keep their neutral value.
#[derive(Clone, Copy, Debug, PartialEq)]
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
    /// Whether the floors cannot overlap: impulses and reactions instead of a force of penetration.
    pub fn is_rigid(&self) -> bool {
        self.kind == LawKind::Stereomechanical
    }
}
