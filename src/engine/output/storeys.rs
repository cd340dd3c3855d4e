//! What is checked storey by storey: the peak drift as a share of the height, the peak storey shear, and the largest force
//! of a slab on the columns.

use crate::engine::model::Model;
use crate::engine::output::outputs::Rates;
use crate::engine::output::point::Point;
use crate::engine::output::point_rates::PointRates;
use crate::engine::quantities::rows::PeakOf;
use crate::engine::quantities::storeys::StoreyPeak;
use crate::engine::state::State;
use crate::scene::Place;
use crate::structure::Side;

impl Model {
    /// The value of a storey's quantity; 0 where the scene does not have what it is made of.
    pub(in crate::engine) fn storey_peak(
        &self,
        state: &State,
        point: &Point,
        of: StoreyPeak,
        (side, storey): (Side, usize),
    ) -> f64 {
        if let (StoreyPeak::Shear, Some(shear)) = (of, self.yielded_shear(point, (side, storey))) {
            return shear;
        }
        match of {
            StoreyPeak::DriftRatio | StoreyPeak::Shear => {
                self.storeys.per_drift(of, (side, storey)) * self.peak(state, point, PeakOf::Drift(side, storey))
            }
            StoreyPeak::ColumnForce => self.hardest_on(state, point, (side, storey)).map_or(0.0, |(_, force)| force),
        }
    }

    /// Drift of a storey, m.
    pub(in crate::engine) fn drift(&self, point: &Point, (side, storey): (Side, usize)) -> f64 {
        self.sum_of(point, side, self.system.structure.floors.places(side).drift(storey))
    }

    /// Rates of a drift, m/s and m/s2.
    pub(in crate::engine) fn drift_rates(
        &self,
        point: &Point,
        rates: &PointRates,
        (side, storey): (Side, usize),
    ) -> Rates {
        self.rates_of_sum((point, rates), side, self.system.structure.floors.places(side).drift(storey))
    }

    /// Lean of a storey, m: its drift, and by how much its foundation has turned.
    pub(in crate::engine) fn lean(&self, point: &Point, (side, storey): (Side, usize)) -> f64 {
        self.sum_of(point, side, self.system.structure.floors.places(side).lean(storey))
    }

    /// Rates of a lean, m/s and m/s2.
    pub(in crate::engine) fn lean_rates(
        &self,
        point: &Point,
        rates: &PointRates,
        (side, storey): (Side, usize),
    ) -> Rates {
        self.rates_of_sum((point, rates), side, self.system.structure.floors.places(side).lean(storey))
    }

    /// The sum of some displacements of a building, each with its weight.
    fn sum_of(&self, point: &Point, side: Side, weights: impl Iterator<Item = (Place, f64)>) -> f64 {
        let floors = &self.system.structure.floors;
        let of = |(place, weight)| Some(weight * self.motion_of(point, floors.lane_of(side, place)?, 0));
        weights.filter_map(of).sum()
    }

    fn rates_of_sum(
        &self,
        (point, rates): (&Point, &PointRates),
        side: Side,
        weights: impl Iterator<Item = (Place, f64)>,
    ) -> Rates {
        let floors = &self.system.structure.floors;
        weights.fold([0.0; 2], |sum, (place, weight)| {
            let lane = floors.lane_of(side, place);
            let of = lane.map_or([0.0; 2], |lane| self.displacement_rates_of(point, rates, lane));
            [sum[0] + weight * of[0], sum[1] + weight * of[1]]
        })
    }

    /// The contact that has pressed hardest on the columns of a storey, and its largest force.
    pub(in crate::engine) fn hardest_on(
        &self,
        state: &State,
        point: &Point,
        storey: (Side, usize),
    ) -> Option<(usize, f64)> {
        let contacts = (0..).zip(&self.storeys.struck).filter(|(_, struck)| **struck == Some(storey));
        let forces = contacts.map(|(p, _)| (p, self.contact(state, point, p).peak_force));
        forces.max_by(|(_, one), (_, other)| one.total_cmp(other))
    }
}
