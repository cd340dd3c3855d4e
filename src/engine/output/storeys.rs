//! What is checked storey by storey: the peak drift as a share of the height, the peak storey shear, and the largest force
//! of a slab on the columns.

use crate::engine::output::instant::Instant;
use crate::engine::output::outputs::Rates;
use crate::engine::output::point_rates::PointRates;
use crate::engine::quantities::rows::PeakOf;
use crate::engine::quantities::storeys::StoreyPeak;
use crate::scene::{Place, Places};
use crate::structure::{BuildingId, Storey};

impl<'a> Instant<'a> {
    /// The value of a storey's quantity; 0 where the scene does not have what it is made of.
    pub(super) fn storey_peak(&self, of: StoreyPeak, place: Storey) -> f64 {
        if of == StoreyPeak::Shear && self.is_corrected(place) {
            return self.peak(PeakOf::StoreyShear(place.0, place.1));
        }
        if let (StoreyPeak::Shear, Some(shear)) = (of, self.yielded_shear(place)) {
            return shear;
        }
        match of {
            StoreyPeak::DriftRatio | StoreyPeak::Shear => {
                self.model.storeys.per_drift(of, place) * self.peak(PeakOf::Drift(place.0, place.1))
            }
            StoreyPeak::ColumnForce => self.hardest_on(place).map_or(0.0, |(_, force)| force),
        }
    }

    /// Whether a storey can be corrected: then its shear is watched by itself.
    pub(super) fn is_corrected(&self, place: Storey) -> bool {
        self.model.system.number_of_correction(place).is_some()
    }

    /// Drift of a storey, m.
    pub(super) fn drift(&self, (id, storey): Storey) -> f64 {
        self.sum_of(id, self.places(id).drift(storey))
    }

    /// Rates of a drift, m/s and m/s2.
    pub(super) fn drift_rates(&self, rates: &PointRates, (id, storey): Storey) -> Rates {
        self.rates_of_sum(rates, id, self.places(id).drift(storey))
    }

    /// Lean of a storey, m: its drift, and by how much its foundation has turned.
    pub(super) fn lean(&self, (id, storey): Storey) -> f64 {
        self.sum_of(id, self.places(id).lean(storey))
    }

    /// Rates of a lean, m/s and m/s2.
    pub(super) fn lean_rates(&self, rates: &PointRates, (id, storey): Storey) -> Rates {
        self.rates_of_sum(rates, id, self.places(id).lean(storey))
    }

    fn places(&self, id: BuildingId) -> &'a Places {
        self.model.system.structure.floors.places(id)
    }

    /// The sum of some displacements of a building, each with its weight.
    fn sum_of(&self, id: BuildingId, weights: impl Iterator<Item = (Place, f64)>) -> f64 {
        let floors = &self.model.system.structure.floors;
        weights.filter_map(|(place, weight)| Some(weight * self.displacement(floors.lane_of(id, place)?))).sum()
    }

    fn rates_of_sum(&self, rates: &PointRates, id: BuildingId, weights: impl Iterator<Item = (Place, f64)>) -> Rates {
        let floors = &self.model.system.structure.floors;
        weights.fold([0.0; 2], |sum, (place, weight)| {
            let of = floors.lane_of(id, place).map_or([0.0; 2], |lane| self.displacement_rates(rates, lane));
            [sum[0] + weight * of[0], sum[1] + weight * of[1]]
        })
    }

    /// The contact that has pressed hardest on the columns of a storey, and its largest force.
    pub(super) fn hardest_on(&self, storey: Storey) -> Option<(usize, f64)> {
        let contacts = (0..).zip(&self.model.storeys.struck).filter(|(_, struck)| **struck == Some(storey));
        let forces = contacts.map(|(p, _)| (p, self.contact(p).peak_force));
        forces.max_by(|(_, one), (_, other)| one.total_cmp(other))
    }
}
