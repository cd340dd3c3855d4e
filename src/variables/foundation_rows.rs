//! The rows of foundations.

use super::number::number;
use super::part::{ACCELERATED, DISPLACEMENT, MOVED, MOVING, NEWTON, RATIO, Scale, VELOCITY};
use super::slot::{Calculated, Parameter};
use super::table::{SharedRule, Table, Type};
use super::unit::Unit;
use crate::engine::{BuildingId, FoundationOutput, Output};
use crate::scene::{FoundationKey, Scene, Soil, rule};

/// Rad and rad/s, at the edge of a foundation of some metres.
const ROTATION: f64 = 1e-3;
const ROTATION_RATE: f64 = 1e-2;

type OfFoundation = (FoundationOutput, &'static str, Scale, &'static str);

impl Table {
    /// What the foundation of a building has, in the ways in which it moves.
    pub(super) fn add_foundation(&mut self, scene: &Scene, id: BuildingId) {
        use FoundationKey as K;
        let building = scene.building(id);
        let Some(foundation) = &building.foundation else { return };
        let mut rows = self.of_foundation(building);
        for (key, unit, rule, about) in [
            (K::Mass, Unit::Kilogram, rule::MASS, "mass of the foundation"),
            (
                K::Inertia,
                Unit::KilogramMetreSquared,
                rule::MOMENT_OF_INERTIA,
                "moment of inertia of foundation and floors about their own centres",
            ),
            (K::SwayStiffness, Unit::NewtonPerMetre, rule::STOREY_STIFFNESS, "stiffness of the soil against sway"),
            (K::SwayDashpot, Unit::NewtonSecondPerMetre, rule::DASHPOT, "dashpot of the soil against sway"),
            (
                K::RockingStiffness,
                Unit::NewtonMetrePerRadian,
                rule::ROCKING_STIFFNESS,
                "stiffness of the soil against rocking",
            ),
            (
                K::RockingDashpot,
                Unit::NewtonMetreSecondPerRadian,
                rule::ROCKING_DASHPOT,
                "dashpot of the soil against rocking",
            ),
        ] {
            let parameter = Parameter::Foundation(id, key);
            let Some(value) = number(scene, parameter) else { continue };
            let row = rows.add(parameter, key.name(), (Type::Real(unit), value), about).under(rule);
            if matches!(key, K::SwayStiffness | K::RockingStiffness) {
                row.sharing(SharedRule::Springs);
            }
        }
        let of_sway = foundation.sway.iter().flat_map(|soil| sway(*soil));
        let outputs = of_sway.chain(foundation.rocking.iter().flat_map(|soil| rocking(*soil)));
        for (of, name, scale, about) in outputs {
            let Some(quantity) = name.strip_prefix("peak_") else {
                rows.add(Output::Foundation(id, of), name, scale, about);
                continue;
            };
            if scene.peaks {
                let when = "of either sign, between communication points and in impacts too";
                let about = format!("largest {quantity} of the foundation so far, {when}");
                rows.add(Output::Foundation(id, of), name, scale, &about);
            }
        }
        let about = "first period on the soil, without damping, over that on a fixed base";
        rows.add(Calculated::PeriodRatio(id), "period_ratio", RATIO, about);
    }
}

/// What there is of a foundation that sways; what is said of peaks goes without saying.
fn sway(soil: Soil) -> [OfFoundation; 6] {
    use FoundationOutput as F;
    let force = (NEWTON, soil.stiffness * DISPLACEMENT + soil.dashpot * VELOCITY);
    [
        (F::Displacement, "displacement", MOVED, "displacement of the foundation, relative to the ground"),
        (F::Velocity, "velocity", MOVING, "velocity of the foundation, relative to the ground"),
        (F::Acceleration, "acceleration", ACCELERATED, "acceleration of the foundation, absolute"),
        (F::Force, "force", force, "force on the soil, of its spring and its dashpot"),
        (F::PeakDisplacement, "peak_displacement", MOVED, ""),
        (F::PeakForce, "peak_force", force, ""),
    ]
}

/// What there is of one that rocks.
fn rocking(soil: Soil) -> [OfFoundation; 5] {
    use FoundationOutput as F;
    let rotation = (Type::Real(Unit::Radian), ROTATION);
    let rate = (Type::Real(Unit::RadianPerSecond), ROTATION_RATE);
    let moment = (Type::Real(Unit::NewtonMetre), soil.stiffness * ROTATION + soil.dashpot * ROTATION_RATE);
    let about = "rotation of the foundation, positive where the building leans to the right";
    [
        (F::Rotation, "rotation", rotation, about),
        (F::RotationRate, "rotation_rate", rate, "rate of the rotation of the foundation"),
        (F::Moment, "moment", moment, "moment on the soil, of its spring and its dashpot"),
        (F::PeakRotation, "peak_rotation", rotation, ""),
        (F::PeakMoment, "peak_moment", moment, ""),
    ]
}
