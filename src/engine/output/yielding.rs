//! The storeys that can yield at an observed time.

use crate::engine::base::element::{ElementState, Sense};
use crate::engine::excitation::inputs::LinearInput;
use crate::engine::model::Model;
use crate::engine::output::instant::Instant;
use crate::engine::output::outputs::{Rates, YieldingOf};
use crate::engine::output::point_rates::{PEAK_ROUNDING, PointRates};
use crate::engine::quantities::rows::PeakOf;
use crate::engine::quantities::storeys::StoreyPeak;
use crate::engine::yielding::element::{Element, Present};
use crate::structure::Storey;

impl<'a> Instant<'a> {
    /// A quantity of a storey, counted from 0. Of one that cannot yield, as its yield force has been made infinite, or
    /// as it can only be corrected, the shear is that of its drift, everything else 0.
    pub(super) fn of_yielding(&self, of: YieldingOf, place: Storey) -> f64 {
        let correction =
            if of == YieldingOf::Shear { self.correction_of(place, |line| line.at(self.state.time)) } else { 0.0 };
        self.of_storey(of, place) - correction
    }

    /// The same without correction.
    fn of_storey(&self, of: YieldingOf, place: Storey) -> f64 {
        let Some((storey, present)) = self.yielding_storey(place) else {
            return if of == YieldingOf::Shear { self.elastic_stiffness(place) * self.drift(place) } else { 0.0 };
        };
        let (now, point) = (present.0, self.point);
        let largest_drift = || storey.largest_drift(now, self.peak(PeakOf::Drift(place.0, place.1)));
        match of {
            YieldingOf::Shear => storey.shear(present, storey.drift(point.coordinates, self.motion().q)),
            YieldingOf::PlasticDrift => now.plastic,
            YieldingOf::ResidualDrift => storey.residual_drift(now, &point.elements),
            YieldingOf::Ductility => largest_drift() / storey.limit,
            YieldingOf::PeakStabilityIndex => storey.critical.map_or(0.0, |critical| largest_drift() / critical),
            YieldingOf::HystereticEnergy => storey.hysteretic_energy(now),
            YieldingOf::CumulativePlasticDrift => now.cumulative.exact(),
        }
    }

    /// The sense in which a storey yields, 1 or -1; 0 while it is elastic.
    pub(super) fn yielding(&self, place: Storey) -> f64 {
        self.yielding_storey(place).map_or(0.0, |(_, (now, _))| flow(now))
    }

    /// A correction, or its rate, of a storey or floor; 0 where the scene has none.
    fn correction_of(&self, place: Storey, part: impl Fn(&LinearInput) -> f64) -> f64 {
        self.model.system.number_of_correction(place).map_or(0.0, |number| part(&self.state.inputs.corrections[number]))
    }

    /// Rates of a quantity of a storey.
    pub(super) fn yielding_rates(&self, rates: &PointRates, of: YieldingOf, place: Storey) -> Rates {
        let [first, second] = self.storey_rates(rates, of, place);
        let correction = if of == YieldingOf::Shear { self.correction_of(place, LinearInput::slope) } else { 0.0 };
        [first - correction, second]
    }

    fn storey_rates(&self, rates: &PointRates, of: YieldingOf, place: Storey) -> Rates {
        let Some((storey, (now, _))) = self.yielding_storey(place) else {
            let factor = if of == YieldingOf::Shear { self.elastic_stiffness(place) } else { 0.0 };
            return self.drift_rates(rates, place).map(|rate| factor * rate);
        };
        let motions = [self.motion().v, &rates.acceleration];
        let drift = motions.map(|motion| storey.drift(self.point.coordinates, motion));
        let flow = flow(now);
        let factor = match of {
            YieldingOf::Shear => storey.stiffness(now),
            YieldingOf::PlasticDrift => flow.abs(),
            YieldingOf::ResidualDrift => {
                let own = drift.map(|rate| flow.abs() * rate);
                let present = (now, &self.point.elements[..]);
                return [0, 1].map(|order| storey.residual_rate(present, own[order], self.flows(motions[order])));
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
    pub(super) fn unused_drift(&self, of: YieldingOf, place: Storey) -> Option<f64> {
        let (storey, (now, _)) = self.yielding_storey(place)?;
        drift_of_share(storey, of).filter(|_| now.furthest == 0.0)
    }

    /// The largest shear so far of a storey that has yielded, N.
    pub(super) fn yielded_shear(&self, place: Storey) -> Option<f64> {
        let (storey, (now, _)) = self.yielding_storey(place)?;
        (now.furthest > 0.0).then(|| storey.peak_shear(now))
    }

    /// Its rates, N/s and N/s2.
    pub(super) fn yielded_shear_rates(&self, rates: &PointRates, place: Storey) -> Option<Rates> {
        let (storey, (now, _)) = self.yielding_storey(place).filter(|(_, (now, _))| now.furthest > 0.0)?;
        let sign = if is_furthest(now) { flow(now) } else { 0.0 };
        let rate = |motion: &[f64]| sign * storey.stiffness(now) * storey.drift(self.point.coordinates, motion);
        Some([rate(self.motion().v), rate(&rates.acceleration)])
    }

    /// Rates of the plastic drifts of all elements, from those of the motion.
    fn flows(&self, motion: &'a [f64]) -> impl Iterator<Item = f64> {
        let Instant { model, point, .. } = *self;
        model.system.elements.iter().zip(&point.elements).map(|(of, element)| match element.yields {
            Some(_) => of.drift(point.coordinates, motion),
            None => 0.0,
        })
    }

    /// Shear of a storey that cannot yield over its drift, N/m.
    fn elastic_stiffness(&self, place: Storey) -> f64 {
        self.model.storeys.per_drift(StoreyPeak::Shear, place)
    }

    fn yielding_storey(&self, place: Storey) -> Option<(&'a Element, Present<'a>)> {
        let Instant { model: Model { system, .. }, point, .. } = *self;
        let i = system.number_of_storey(place)?;
        (i < point.elements.len()).then(|| system.element_at(i, &point.elements))
    }
}

/// The sense in which a storey or a spring yields, 1 or -1; 0 while it is elastic.
pub(super) fn flow(now: &ElementState) -> f64 {
    now.yields.map_or(0.0, Sense::sign)
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
fn is_furthest(now: &ElementState) -> bool {
    now.yields.is_some_and(|sense| sense.sign() * now.plastic >= (1.0 - PEAK_ROUNDING) * now.furthest)
}
