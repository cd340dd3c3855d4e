//! The rows of foundations.

use super::rows::{
    ACCELERATION, DISPLACEMENT, METRE, METRE_PER_SECOND, METRE_PER_SECOND_SQUARED, NEWTON, ONE, VELOCITY,
};
use super::slot::{Calculated, Parameter, Slot};
use super::table::{Table, Type};
use super::unit::Unit;
use crate::engine::{FoundationOutput, Output, Side};
use crate::scene::{Building, Foundation, FoundationKey, Soil};

/// Rad and rad/s, at the edge of a foundation of some metres.
const ROTATION: f64 = 1e-3;
const ROTATION_RATE: f64 = 1e-2;

impl Table {
    /// What the foundation of a building has, in the ways in which it moves.
    pub(super) fn add_foundation(&mut self, building: &Building, side: Side, peaks: bool) {
        let Some(foundation) = &building.foundation else { return };
        self.add_foundation_parameters(foundation, side);
        foundation.sway.iter().for_each(|soil| self.add_sway(*soil, side, peaks));
        foundation.rocking.iter().for_each(|soil| self.add_rocking(*soil, side, peaks));
        let about = "first period on the soil, without damping, over that on a fixed base";
        let name = format!("{side}.foundation.period_ratio");
        self.add(Calculated::PeriodRatio(side), &name, ONE, about).at_least(0.0).nominal(1.0);
    }

    fn add_foundation_parameters(&mut self, foundation: &Foundation, side: Side) {
        use FoundationKey as K;
        for (key, unit, about) in [
            (K::Mass, Unit::Kilogram, "mass of the foundation"),
            (
                K::Inertia,
                Unit::KilogramMetreSquared,
                "moment of inertia of foundation and floors about their own centres",
            ),
            (K::SwayStiffness, Unit::NewtonPerMetre, "stiffness of the soil against sway"),
            (K::SwayDashpot, Unit::NewtonSecondPerMetre, "dashpot of the soil against sway"),
            (K::RockingStiffness, Unit::NewtonMetrePerRadian, "stiffness of the soil against rocking"),
            (K::RockingDashpot, Unit::NewtonMetreSecondPerRadian, "dashpot of the soil against rocking"),
        ] {
            let Some(value) = foundation.get(key) else { continue };
            let name = format!("{side}.foundation.{}", key.name());
            self.add(Parameter::Foundation(side, key), &name, Type::Real(unit), about).at_least(0.0).nominal(value);
        }
    }

    fn add_sway(&mut self, soil: Soil, side: Side, peaks: bool) {
        use FoundationOutput as F;
        let force = soil.stiffness * DISPLACEMENT + soil.dashpot * VELOCITY;
        for (of, quantity, ty, nominal, about) in [
            (
                F::Displacement,
                "displacement",
                METRE,
                DISPLACEMENT,
                "displacement of the foundation, relative to the ground",
            ),
            (F::Velocity, "velocity", METRE_PER_SECOND, VELOCITY, "velocity of the foundation, relative to the ground"),
            (
                F::Acceleration,
                "acceleration",
                METRE_PER_SECOND_SQUARED,
                ACCELERATION,
                "acceleration of the foundation, absolute",
            ),
            (F::Force, "force", NEWTON, force, "force on the soil, of its spring and its dashpot"),
        ] {
            self.add_of_foundation((side, of), quantity, (ty, nominal), about);
        }
        let peak_force = (F::PeakForce, "force", NEWTON, force);
        let of_peaks = [(F::PeakDisplacement, "displacement", METRE, DISPLACEMENT), peak_force];
        of_peaks.into_iter().filter(|_| peaks).for_each(|row| self.add_foundation_peak(side, row));
    }

    fn add_rocking(&mut self, soil: Soil, side: Side, peaks: bool) {
        use FoundationOutput as F;
        let moment = soil.stiffness * ROTATION + soil.dashpot * ROTATION_RATE;
        let [radian, rate, newton_metre] = [Unit::Radian, Unit::RadianPerSecond, Unit::NewtonMetre].map(Type::Real);
        for (of, quantity, ty, nominal, about) in [
            (
                F::Rotation,
                "rotation",
                radian,
                ROTATION,
                "rotation of the foundation, positive where the building leans to the right",
            ),
            (F::RotationRate, "rotation_rate", rate, ROTATION_RATE, "rate of the rotation of the foundation"),
            (F::Moment, "moment", newton_metre, moment, "moment on the soil, of its spring and its dashpot"),
        ] {
            self.add_of_foundation((side, of), quantity, (ty, nominal), about);
        }
        let peak_moment = (F::PeakMoment, "moment", newton_metre, moment);
        let of_peaks = [(F::PeakRotation, "rotation", radian, ROTATION), peak_moment];
        of_peaks.into_iter().filter(|_| peaks).for_each(|row| self.add_foundation_peak(side, row));
    }

    fn add_of_foundation(
        &mut self,
        (side, of): (Side, FoundationOutput),
        quantity: &str,
        (ty, nominal): (Type, f64),
        about: &str,
    ) {
        let slot = Slot::Output(Output::Foundation(side, of));
        self.add(slot, &format!("{side}.foundation.{quantity}"), ty, about).nominal(nominal);
    }

    fn add_foundation_peak(&mut self, side: Side, (of, quantity, ty, nominal): (FoundationOutput, &str, Type, f64)) {
        let about = format!(
            "largest {quantity} of the foundation so far, of either sign, between communication points and in impacts too"
        );
        let slot = Slot::Output(Output::Foundation(side, of));
        let row = self.add(slot, &format!("{side}.foundation.peak_{quantity}"), ty, &about);
        row.at_least(0.0).nominal(nominal);
    }
}
