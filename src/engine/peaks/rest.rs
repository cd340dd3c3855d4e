//! The part of displacements and drifts by the position of rest, to which the motion is relative.

use crate::engine::base::{Base, Coordinates};
use crate::engine::model::Model;
use crate::engine::peaks::ahead::values_of;
use crate::engine::watched::rows::{BuildingRows, PeakOf};
use crate::engine::yielding::storey::YieldingStorey;
use crate::numerics::polynomial::each;
use crate::structure::{LANES, Lane};

impl Model {
    /// The values of block `b` of a building in a motion relative to that position of rest.
    pub(in crate::engine) fn values_at(
        &self,
        (building, b): (&BuildingRows, usize),
        rest: &[f64],
        (q, v): (&[f64], &[f64]),
    ) -> Lane {
        let (values, at_rest) = (values_of(&building.blocks[b], q, v), self.values_at_rest((building, b), rest));
        each(|i| values[i] + at_rest[i])
    }

    /// The values of block `b` of a building at rest.
    pub(in crate::engine) fn values_at_rest(&self, (building, b): (&BuildingRows, usize), rest: &[f64]) -> Lane {
        if self.system.storeys.is_empty() {
            return [0.0; LANES];
        }
        let place = (building.first + b) * LANES;
        each(|i| self.peak_rows.at(place + i).map_or(0.0, |of| self.value_at_rest(of, rest)))
    }

    /// Takes from the row of a base shear what the lowest storey does not resist with if it yields in a step; returns the
    /// part of the base shear that this row leaves out.
    pub(in crate::engine) fn soften_row(&self, of: PeakOf, base: &Base, rows: &mut [Vec<f64>; 2]) -> f64 {
        let PeakOf::BaseShear(side) = of else { return 0.0 };
        let is_lowest = |of: &YieldingStorey| of.side == side && of.storey == 0;
        let lowest = self.system.storeys.iter().zip(&base.storeys).find(|(of, _)| is_lowest(of));
        let Some((of, _)) = lowest.filter(|(_, storey)| storey.yields.is_some()) else { return 0.0 };
        match base.coordinates {
            Coordinates::Modes => rows[0].iter_mut().zip(&of.row).for_each(|(entry, row)| *entry -= of.lost * row),
            Coordinates::Floors => rows[0][of.floors.0] -= of.lost,
        }
        of.lost * of.drift(base.coordinates, &base.q)
    }

    /// The value of a quantity at rest: 0 for accelerations and base shears.
    pub(in crate::engine) fn value_at_rest(&self, of: PeakOf, rest: &[f64]) -> f64 {
        let lane = |floor: usize| self.system.structure.floors.lane(of.side() as usize, floor);
        match of {
            PeakOf::Displacement(_, floor) => rest[lane(floor)],
            PeakOf::Drift(_, storey) => {
                rest[lane(storey)] - storey.checked_sub(1).map_or(0.0, |below| rest[lane(below)])
            }
            PeakOf::Acceleration(..) | PeakOf::BaseShear(_) => 0.0,
        }
    }
}
