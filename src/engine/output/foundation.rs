//! Foundations at the observed time. The soil under one is a link of the structure, as which all but its acceleration is read.

use crate::engine::model::Model;
use crate::engine::output::outputs::{FoundationOutput, LinkOutput, Output};
use crate::engine::quantities::rows::PeakOf;
use crate::structure::{BuildingId, SoilRows};

impl Model {
    /// The output of a spring of the soil that a quantity of a foundation is; none of an acceleration, and of a motion that the
    /// foundation has not.
    pub(super) fn soil_output(&self, id: BuildingId, of: FoundationOutput) -> Option<Output> {
        use FoundationOutput as F;
        let SoilRows { sway, rocking } = self.system.structure.soil[id.index()];
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

    /// The springs of the soil under both foundations, as links.
    pub(super) fn soil_springs(&self) -> impl Iterator<Item = usize> {
        self.system.structure.soil.iter().flat_map(|SoilRows { sway, rocking }| [*sway, *rocking]).flatten()
    }
}
