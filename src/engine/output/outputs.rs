//! What can be read of a run: each output is named here, and nowhere else by hand.

use crate::engine::quantities::rows::PeakOf;
use crate::engine::quantities::storeys::StoreyPeak;
use crate::structure::BuildingId;
use std::ops::{Index, IndexMut};

/// First and second derivative with respect to time.
pub type Rates = [f64; 2];

/// A quantity that a run shows. Floors, storeys and contacts are counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Output {
    /// Ground acceleration, m/s2.
    GroundAcceleration,
    /// Displacement of a floor relative to the ground, m.
    Displacement(BuildingId, usize),
    /// Velocity of a floor relative to the ground, m/s.
    Velocity(BuildingId, usize),
    /// Absolute acceleration of a floor, m/s2.
    Acceleration(BuildingId, usize),
    /// Force of a building on the ground, N.
    BaseShear(BuildingId),
    /// The largest magnitude so far.
    Peak(PeakOf),
    /// The largest so far of a quantity of a storey.
    OfStorey(StoreyPeak, BuildingId, usize),
    /// Of a storey that can yield.
    OfYielding(YieldingOf, BuildingId, usize),
    /// The sense in which a storey yields now: 1 or -1, or 0 while it is elastic.
    Yielding(BuildingId, usize),
    /// Whether a storey of a building has collapsed, which ends the run.
    Collapsed(BuildingId),
    /// The time of that, s; -1 until then.
    CollapseTime(BuildingId),
    /// One contact.
    Contact(usize, ContactOutput),
    /// One link.
    Link(usize, LinkOutput),
    /// A foundation on soil.
    Foundation(BuildingId, FoundationOutput),
    /// Contact episodes begun so far, of all contacts.
    Impacts,
    /// One term of the energy account.
    Energy(EnergyOutput),
}

/// A quantity of a storey that can yield.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum YieldingOf {
    /// Storey shear, N, without damping: also of one that can be corrected and does not yield.
    Shear,
    /// Plastic drift, m.
    PlasticDrift,
    /// Drift at which the storey would come to rest, m: plastic drift times 1 - post-yield ratio.
    ResidualDrift,
    /// Largest drift so far over the yield drift; where no peaks are watched, 0 until the storey yields.
    Ductility,
    /// Energy dissipated by yielding so far, J.
    HystereticEnergy,
    /// Sum of the magnitudes of all changes of the plastic drift so far, m.
    CumulativePlasticDrift,
    /// Largest drift so far over the critical drift, beyond which gravity pushes a storey that yields on; where no peaks
    /// are watched, 0 until the storey yields.
    PeakStabilityIndex,
}

/// A quantity of a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum LinkOutput {
    /// Force, N, positive where it pushes the ends apart.
    Force,
    /// By how much the ends have come nearer, m.
    Displacement,
    /// How fast they do, m/s.
    Velocity,
    /// Energy dissipated so far, J: by its spring where that slips, and, with an energy account, by its dashpot.
    DissipatedEnergy,
    /// Of one that slips: by how much the spring has slipped, m.
    Slip,
    /// The sum of the magnitudes of all slips so far, m.
    SlipTravel,
    /// The sense in which the spring slips now: 1 or -1, or 0.
    Slipping,
}

/// A quantity of a foundation on soil.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum FoundationOutput {
    /// Displacement relative to the ground far away, m.
    Displacement,
    /// Rotation, rad, positive where the building leans to the right.
    Rotation,
    /// Velocity relative to the ground far away, m/s.
    Velocity,
    /// Rate of the rotation, rad/s.
    RotationRate,
    /// Absolute acceleration, m/s2: the motion under the building.
    Acceleration,
    /// Force on the soil, N, of its spring and its dashpot.
    Force,
    /// Moment on the soil, N m, likewise.
    Moment,
    /// Largest magnitude so far of the displacement, m.
    PeakDisplacement,
    /// Of the rotation, rad.
    PeakRotation,
    /// Of the force, N.
    PeakForce,
    /// Of the moment, N m.
    PeakMoment,
}

/// Makes of one list of quantities an enum of them, a struct of their values, each of which can be had by its field or
/// by its variant, and a struct of their rates.
macro_rules! quantities {
    (
        $(#[$of_enum:meta])* $Of:ident, $(#[$of_values:meta])* $Values:ident, $(#[$of_rates:meta])* $Rates:ident:
        $($(#[$about:meta])* $Quantity:ident $name:ident: $ty:ty,)*
    ) => {
        $(#[$of_enum])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[non_exhaustive]
        pub enum $Of {
            $($(#[$about])* $Quantity,)*
        }

        $(#[$of_values])*
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        #[non_exhaustive]
        pub struct $Values {
            $($(#[$about])* pub $name: $ty,)*
        }

        $(#[$of_rates])*
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        pub struct $Rates([Rates; [$($Of::$Quantity),*].len()]);

        impl $Of {
            /// The last part of its name among the variables of the FMU.
            pub const fn name(self) -> &'static str {
                match self {
                    $($Of::$Quantity => stringify!($name),)*
                }
            }
        }

        impl $Values {
            /// A quantity as a number: what is true is 1.
            #[inline(always)]
            pub fn get(&self, of: $Of) -> f64 {
                match of {
                    $($Of::$Quantity => self.$name.number(),)*
                }
            }
        }

        impl Index<$Of> for $Rates {
            type Output = Rates;

            fn index(&self, of: $Of) -> &Rates {
                &self.0[of as usize]
            }
        }

        impl IndexMut<$Of> for $Rates {
            fn index_mut(&mut self, of: $Of) -> &mut Rates {
                &mut self.0[of as usize]
            }
        }
    };
}

quantities! {
    /// A quantity of one contact.
    ContactOutput,
    /// One contact at one time. Names and meanings as in the FMU variables `contact[p].*`.
    ContactPoint,
    /// The derivatives of the quantities of one contact; 0 of those that are held from one event to the next.
    ContactRates:
    /// Force, N, positive in compression.
    Force force: f64,
    /// Penetration, m, negative while apart.
    Penetration penetration: f64,
    /// Whether the floors are in contact now.
    Active active: bool,
    /// Number of episodes begun so far.
    Impacts impacts: u64,
    /// Largest force so far, N. Its rates are those of the force while it is at its peak and grows, else 0.
    PeakForce peak_force: f64,
    /// Integral of the force so far, N s.
    Impulse impulse: f64,
    /// Energy dissipated so far, J.
    DissipatedEnergy dissipated_energy: f64,
    /// Approach velocity at the start of the latest episode, m/s.
    ApproachVelocity approach_velocity: f64,
}

quantities! {
    /// A term of the energy account.
    EnergyOutput,
    /// The energy account for motion relative to the ground. Names and meanings as in the FMU variables `energy.*`.
    EnergyPoint,
    /// The derivatives of the terms of the energy account, W and W/s; the residual has none.
    EnergyRates:
    /// Work of the inertia forces of the ground motion, J.
    Input input: f64,
    /// Kinetic energy, J.
    Kinetic kinetic: f64,
    /// Strain energy of the storeys, J.
    Strain strain: f64,
    /// Energy dissipated by structural damping, J.
    Viscous viscous: f64,
    /// Work done on the contacts, J.
    Impact impact: f64,
    /// Work of the external floor forces, J.
    External external: f64,
    /// Work that the buildings have taken up by corrections so far, J: with `strain` that of what resists in their
    /// place.
    Correction correction: f64,
    /// Energy dissipated by storeys that have yielded, J.
    Hysteretic hysteretic: f64,
    /// Potential energy of the weights on storeys that lean, J: 0 or less.
    Gravity gravity: f64,
    /// The part of the viscous energy that the soil under foundations dissipates, J.
    Soil soil: f64,
    /// Imbalance of these terms divided by the largest magnitude that any of them has had.
    Residual residual: f64,
}

/// What an output can be, as a number.
trait Number {
    fn number(self) -> f64;
}

impl Number for f64 {
    #[inline(always)]
    fn number(self) -> f64 {
        self
    }
}

impl Number for bool {
    #[inline(always)]
    fn number(self) -> f64 {
        f64::from(self)
    }
}

impl Number for u64 {
    /// Exact up to 2^53.
    #[inline(always)]
    fn number(self) -> f64 {
        self as f64
    }
}
