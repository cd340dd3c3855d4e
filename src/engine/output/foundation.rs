//! Foundations at the observed time. The soil under one is a link of the structure, as which all but its acceleration is read.

use crate::engine::model::Model;
use crate::engine::output::outputs::{FoundationOutput, LinkOutput, Output, Rates};
use crate::engine::output::point::Point;
use crate::engine::output::point_rates::PointRates;
use crate::engine::quantities::rows::PeakOf;
use crate::scene::Place;
use crate::structure::{Side, SoilRows};

impl Model {
    /// The output of a spring of the soil that a quantity of a foundation is; none of an acceleration, and of a motion that the
    /// foundation has not.
    pub(in crate::engine) fn soil_output(&self, side: Side, of: FoundationOutput) -> Option<Output> {
        use FoundationOutput as F;
        let SoilRows { sway, rocking } = self.system.structure.soil[side as usize];
        let spring = match of {
            F::Displacement | F::Velocity | F::Force | F::PeakDisplacement | F::PeakForce => sway?,
            F::Rotation | F::RotationRate | F::Moment | F::PeakRotation | F::PeakMoment => rocking?,
            F::Acceleration => return None,
        };
        Some(match of {
            F::Displacement | F::Rotation => Output::Link(spring, LinkOutput::Displacement),
            F::Velocity | F::RotationRate => Output::Link(spring, LinkOutput::Velocity),
            F::PeakDisplacement | F::PeakRotation => Output::Peak(PeakOf::LinkDisplacement(spring)),
            F::PeakForce | F::PeakMoment => Output::Peak(PeakOf::LinkForce(spring)),
            F::Acceleration | F::Force | F::Moment => Output::Link(spring, LinkOutput::Force),
        })
    }

    /// Absolute acceleration of a foundation, m/s2; 0 of one that does not sway.
    pub(in crate::engine) fn foundation_acceleration(&self, point: &Point, side: Side) -> f64 {
        let lane = self.system.structure.floors.lane_of(side, Place::Foundation);
        lane.map_or(0.0, |lane| self.acceleration_of(point, lane))
    }

    /// Its rates, m/s3 and m/s4.
    pub(in crate::engine) fn foundation_acceleration_rates(
        &self,
        point: &Point,
        rates: &PointRates,
        side: Side,
    ) -> Rates {
        let lane = self.system.structure.floors.lane_of(side, Place::Foundation);
        lane.map_or([0.0; 2], |lane| self.acceleration_rates_of(point, rates, lane))
    }

    /// Energy dissipated by the soil, J, from that of the dashpots of all links.
    pub(in crate::engine) fn energy_of_soil(&self, dashpots: &[f64]) -> f64 {
        self.soil_springs().map(|spring| dashpots[spring]).sum()
    }

    /// Its rates, W and W/s.
    pub(in crate::engine) fn energy_rates_of_soil(&self, point: &Point, rates: &PointRates) -> Rates {
        let of = |spring: usize| self.link_rates(point, rates, spring, LinkOutput::DissipatedEnergy);
        self.soil_springs().map(of).fold([0.0; 2], |sum, of| [sum[0] + of[0], sum[1] + of[1]])
    }

    fn soil_springs(&self) -> impl Iterator<Item = usize> {
        self.system.structure.soil.iter().flat_map(|SoilRows { sway, rocking }| [*sway, *rocking]).flatten()
    }
}
