//! The contact force as the engine integrates it: each law, with its episode's numbers filled in, is one of a few
//! analytic [`Force`]s on either side of a [`Guard`].

use serde::{Deserialize, Serialize};

/// One analytic piece of a contact force. d is the penetration, m, v its rate, m/s.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Force {
    /// F = 0.
    None,
    /// F = k d + c v.
    Linear {
        /// k, N/m.
        stiffness: f64,
        /// c, N s/m.
        damping: f64,
    },
    /// F = k d^n (1 + b v).
    Power {
        /// k, N/m^n.
        stiffness: f64,
        /// n.
        exponent: f64,
        /// b, s/m.
        damping: f64,
    },
    /// F = k d^1.5 + b d^0.25 v.
    Root {
        /// k, N/m^1.5.
        stiffness: f64,
        /// b, N s/m^1.25.
        damping: f64,
    },
}

impl Force {
    /// N.
    pub fn value(&self, d: f64, v: f64) -> f64 {
        match *self {
            Force::None => 0.0,
            Force::Linear { stiffness, damping } => stiffness * d + damping * v,
            Force::Power { stiffness, exponent, damping } => stiffness * power(d, exponent) * (1.0 + damping * v),
            Force::Root { stiffness, damping } => stiffness * power(d, 1.5) + damping * power(d, 0.25) * v,
        }
    }

    /// N s/m, by how much the force grows with the rate at penetration d, m.
    pub fn dashpot(&self, d: f64) -> f64 {
        self.value(d, 1.0) - self.value(d, 0.0)
    }

    /// W, power of the damping part at some penetrations and rates.
    #[inline(always)]
    pub fn damping_powers<const N: usize>(&self, d: &[f64; N], v: &[f64; N]) -> [f64; N] {
        match *self {
            Force::None => [0.0; N],
            Force::Linear { damping, .. } => std::array::from_fn(|i| damping * v[i] * v[i]),
            Force::Power { stiffness, exponent, damping } => {
                let power = powers(d, exponent);
                std::array::from_fn(|i| stiffness * power[i] * damping * v[i] * v[i])
            }
            Force::Root { damping, .. } => {
                let power = powers(d, 0.25);
                std::array::from_fn(|i| damping * power[i] * v[i] * v[i])
            }
        }
    }

    /// Stiffness k, exponent n and damping factor for series in powers of t / `scale`: the factor multiplies the
    /// derivative by t / `scale` of d, or of d^1.25 under [`Force::Root`].
    pub fn in_units_of(&self, scale: f64) -> (f64, f64, f64) {
        match *self {
            Force::None => (0.0, 1.0, 0.0),
            Force::Linear { stiffness, damping } => (stiffness, 1.0, damping / scale),
            Force::Power { stiffness, exponent, damping } => (stiffness, exponent, damping / scale),
            Force::Root { stiffness, damping } => (stiffness, 1.5, 0.8 * damping / scale),
        }
    }

    /// Whether it is what [`Force::Root`] is but for damping.
    pub fn is_like_root(&self) -> bool {
        matches!(*self, Force::Root { .. } | Force::Power { exponent: 1.5, damping: 0.0, .. })
    }

    /// Whether the force has a damping part.
    pub fn is_damped(&self) -> bool {
        match *self {
            Force::None => false,
            Force::Linear { damping, .. } | Force::Power { damping, .. } | Force::Root { damping, .. } => {
                damping != 0.0
            }
        }
    }

    /// J, energy that the elastic part holds at penetration d and would give back.
    pub fn stored_energy(&self, d: f64) -> f64 {
        match *self {
            Force::None => 0.0,
            Force::Linear { stiffness, .. } => 0.5 * stiffness * d * d,
            Force::Power { stiffness, exponent, .. } => stiffness * power(d, exponent + 1.0) / (exponent + 1.0),
            Force::Root { stiffness, .. } => stiffness * power(d, 2.5) / 2.5,
        }
    }

    /// Whether the force is a polynomial in d and v, so that nothing is singular at d = 0.
    pub fn is_regular(&self) -> bool {
        matches!(self, Force::None | Force::Linear { .. })
    }
}

/// Which terms a force has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Kind {
    /// No force.
    #[default]
    None,
    /// [`Force::Linear`].
    Linear,
    /// [`Force::Power`] without damping.
    Spring,
    /// [`Force::Power`] with damping.
    Damped,
    /// [`Force::Root`].
    Root,
}

impl Kind {
    /// Of a force.
    pub(crate) fn of(force: &Force) -> Kind {
        match *force {
            Force::None => Kind::None,
            Force::Linear { .. } => Kind::Linear,
            Force::Power { damping: 0.0, .. } => Kind::Spring,
            Force::Power { .. } => Kind::Damped,
            Force::Root { .. } => Kind::Root,
        }
    }
}

/// d^n for d >= 0, from the same function on every platform.
pub(crate) fn power(d: f64, exponent: f64) -> f64 {
    if d <= 0.0 {
        return 0.0;
    }
    // Roots are exact to rounding and several times cheaper than a general power.
    match exponent {
        0.25 => d.sqrt().sqrt(),
        1.25 => d * d.sqrt().sqrt(),
        1.5 => d * d.sqrt(),
        2.5 => d * d * d.sqrt(),
        _ => libm::pow(d, exponent),
    }
}

/// The same of some d side by side.
#[inline(always)]
fn powers<const N: usize>(d: &[f64; N], exponent: f64) -> [f64; N] {
    let inside = d.map(|d| if d <= 0.0 { 0.0 } else { d });
    match exponent {
        0.25 => inside.map(|d| d.sqrt().sqrt()),
        1.5 => inside.map(|d| d * d.sqrt()),
        _ => inside.map(|d| power(d, exponent)),
    }
}

/// Where the force passes from one branch to the other: engaged while constant + stiffness d + damping v > 0.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Guard {
    /// Term without d and v.
    pub constant: f64,
    /// Factor of d.
    pub stiffness: f64,
    /// Factor of v.
    pub damping: f64,
}

impl Guard {
    /// The quantity whose sign decides.
    pub fn value(&self, d: f64, v: f64) -> f64 {
        self.constant + self.stiffness * d + self.damping * v
    }
}

/// A law in one episode.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EpisodeForce {
    /// While the guard is positive, or always where there is none.
    pub engaged: Force,
    /// While the guard is not positive.
    pub slack: Force,
    /// The condition that decides between the two.
    pub guard: Option<Guard>,
}

impl EpisodeForce {
    /// A law of one piece.
    pub const fn always(force: Force) -> EpisodeForce {
        EpisodeForce { engaged: force, slack: Force::None, guard: None }
    }

    /// N, the force at penetration d > 0 and rate v.
    ///
    /// ```
    /// use pounding::contact::{DampingFormula, EpisodeForce, ImpactLaw, LawKind};
    ///
    /// let mut law = ImpactLaw::new(LawKind::HertzDamped);
    /// (law.stiffness, law.exponent, law.restitution) = (3e7, 1.5, 0.5); // N/m^1.5
    /// law.damping_formula = Some(DampingFormula::HuGuo); // a = 1.5
    /// let force = EpisodeForce::new(&law, 3e4, Some(0.5));
    /// assert!((force.value(0.01, 0.2) - 3e7 * 1e-3 * (1.0 + 1.5 * 0.2 / 0.5)).abs() < 1e-9);
    /// // Pulled apart by something else, faster than V/a: no contact pulls under this law.
    /// assert_eq!(force.value(0.01, -0.4), 0.0);
    /// ```
    pub fn value(&self, d: f64, v: f64) -> f64 {
        self.branch(self.is_engaged(d, v)).value(d, v)
    }

    /// The branch for a guard that is positive (or absent) or not.
    pub fn branch(&self, engaged: bool) -> Force {
        if engaged { self.engaged } else { self.slack }
    }

    /// Whether the force is engaged at d and v.
    pub fn is_engaged(&self, d: f64, v: f64) -> bool {
        self.guard.is_none_or(|guard| guard.value(d, v) > 0.0)
    }
}
