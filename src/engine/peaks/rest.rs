//! The part of displacements and drifts by the position of rest, to which the motion is relative.

use crate::engine::base::{Base, Coordinates};
use crate::engine::model::Model;
use crate::engine::quantities::rows::{BodyRows, PeakOf, values_of};
use crate::engine::yielding::storey::YieldingStorey;
use crate::numerics::polynomial::each;
use crate::structure::{LANES, Lane};

impl Model {
    /// The values of block `b` of a body in a motion, with those at rest.
    pub(in crate::engine) fn values_at(
        &self,
        (body, b): (&BodyRows, usize),
        rest: &[f64],
        (q, v): (&[f64], &[f64]),
    ) -> Lane {
        let (values, at_rest) = (values_of(&body.blocks[b], q, v), &rest.as_chunks::<LANES>().0[body.first + b]);
        each(|i| values[i] + at_rest[i])
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
}
