//! The storeys that can yield at an observed time.

use crate::engine::base::storey::{Sense, Storey};
use crate::engine::model::Model;
use crate::engine::output::outputs::{Rates, YieldingOf};
use crate::engine::output::point::Point;
use crate::engine::output::point_rates::{PEAK_ROUNDING, PointRates};
use crate::engine::quantities::rows::PeakOf;
use crate::engine::quantities::storeys::StoreyPeak;
use crate::engine::state::State;
use crate::engine::yielding::element::{Element, Present};
use crate::structure::Side;

impl Model {
    /// A quantity of a storey, counted from 0. Of one that cannot yield, as its yield force has been made infinite, the shear
    /// is that of its drift, everything else 0.
    pub(in crate::engine) fn of_yielding(
        &self,
        state: &State,
        point: &Point,
        of: YieldingOf,
        place: (Side, usize),
    ) -> f64 {
        let Some((storey, present)) = self.yielding_storey(point, place) else {
            let elastic = self.storeys.per_drift(StoreyPeak::Shear, place);
            return if of == YieldingOf::Shear { elastic * self.drift(point, place) } else { 0.0 };
        };
        let now = present.0;
        match of {
            YieldingOf::Shear => storey.shear(present, storey.drift(point.coordinates, &point.q)),
            YieldingOf::PlasticDrift => now.plastic,
            YieldingOf::ResidualDrift => storey.residual_drift(now, &point.storeys),
            YieldingOf::Ductility => {
                storey.largest_drift(now, self.peak(state, point, PeakOf::Drift(place.0, place.1))) / storey.limit
            }
            YieldingOf::PeakStabilityIndex => {
                let peak = self.peak(state, point, PeakOf::Drift(place.0, place.1));
                storey.critical.map_or(0.0, |critical| storey.largest_drift(now, peak) / critical)
            }
            YieldingOf::HystereticEnergy => storey.hysteretic_energy(now),
            YieldingOf::CumulativePlasticDrift => now.cumulative.exact(),
        }
    }

    /// The sense in which a storey yields, 1 or -1; 0 while it is elastic.
    pub(in crate::engine) fn yielding(&self, point: &Point, place: (Side, usize)) -> f64 {
        self.yielding_storey(point, place).and_then(|(_, (now, _))| now.yields).map_or(0.0, Sense::sign)
    }

    /// Rates of a quantity of a storey.
    pub(in crate::engine) fn yielding_rates(
        &self,
        point: &Point,
        rates: &PointRates,
        of: YieldingOf,
        place: (Side, usize),
    ) -> Rates {
        let Some((storey, (now, _))) = self.yielding_storey(point, place) else {
            let elastic = self.storeys.per_drift(StoreyPeak::Shear, place);
            let factor = if of == YieldingOf::Shear { elastic } else { 0.0 };
            return self.drift_rates(point, rates, place).map(|rate| factor * rate);
        };
        let motions = [&point.v, &rates.acceleration];
        let drift = motions.map(|motion| storey.drift(point.coordinates, motion));
        let flow = now.yields.map_or(0.0, Sense::sign);
        let factor = match of {
            YieldingOf::Shear => storey.stiffness(now),
            YieldingOf::PlasticDrift => flow.abs(),
            YieldingOf::ResidualDrift => {
                let own = drift.map(|rate| flow.abs() * rate);
                let rate = |order: usize| {
                    storey.residual_rate((now, &point.storeys), own[order], self.flows(point, motions[order]))
                };
                return [0, 1].map(rate);
            }
            YieldingOf::HystereticEnergy => flow * storey.kept() * storey.force,
            YieldingOf::CumulativePlasticDrift => flow,
            // While the storey has not yielded they are shares of its peak drift.
            YieldingOf::Ductility | YieldingOf::PeakStabilityIndex => {
                let drift = drift_of_share(storey, of).filter(|_| is_furthest(now));
                drift.map_or(0.0, |drift| flow / drift)
            }
        };
        drift.map(|rate| factor * rate)
    }

    /// The drift, m, of which a quantity of a storey that can yield and has not is the share that the peak drift has reached.
    pub(in crate::engine) fn unused_drift(&self, point: &Point, of: YieldingOf, place: (Side, usize)) -> Option<f64> {
        let (storey, (now, _)) = self.yielding_storey(point, place)?;
        drift_of_share(storey, of).filter(|_| now.furthest == 0.0)
    }

    /// The largest shear so far of a storey that has yielded, N, and its rates.
    pub(in crate::engine) fn yielded_shear(&self, point: &Point, place: (Side, usize)) -> Option<f64> {
        let (storey, (now, _)) = self.yielding_storey(point, place)?;
        (now.furthest > 0.0).then(|| storey.peak_shear(now))
    }

    /// Rates of the largest shear so far of a storey that has yielded, N/s and N/s2.
    pub(in crate::engine) fn yielded_shear_rates(
        &self,
        point: &Point,
        rates: &PointRates,
        place: (Side, usize),
    ) -> Option<Rates> {
        let (storey, (now, _)) = self.yielding_storey(point, place).filter(|(_, (now, _))| now.furthest > 0.0)?;
        let sign = now.yields.filter(|_| is_furthest(now)).map_or(0.0, Sense::sign);
        let rate = |motion: &[f64]| sign * storey.stiffness(now) * storey.drift(point.coordinates, motion);
        Some([rate(&point.v), rate(&rates.acceleration)])
    }

    /// Rates of the plastic drifts of all elements, from those of the motion.
    fn flows<'a>(&'a self, point: &'a Point, motion: &'a [f64]) -> impl Iterator<Item = f64> {
        self.system.storeys.iter().zip(&point.storeys).map(|(of, storey)| match storey.yields {
            Some(_) => of.drift(point.coordinates, motion),
            None => 0.0,
        })
    }

    fn yielding_storey<'a>(&'a self, point: &'a Point, place: (Side, usize)) -> Option<(&'a Element, Present<'a>)> {
        let i = self.system.number_of_storey(place)?;
        (i < point.storeys.len()).then(|| self.system.element(i, &point.storeys))
    }
}

/// The drift, m, of which a quantity is the share that the largest drift has reached.
fn drift_of_share(storey: &Element, of: YieldingOf) -> Option<f64> {
    match of {
        YieldingOf::Ductility => Some(storey.limit),
        YieldingOf::PeakStabilityIndex => storey.critical,
        _ => None,
    }
}

/// Whether a storey that yields has never been further.
fn is_furthest(now: &Storey) -> bool {
    now.yields.is_some_and(|sense| sense.sign() * now.plastic >= (1.0 - PEAK_ROUNDING) * now.furthest)
}
