//! Links at the observed time.

use crate::engine::base::storey::{Sense, Storey};
use crate::engine::model::Model;
use crate::engine::output::outputs::{LinkOutput, Rates};
use crate::engine::output::point::Point;
use crate::engine::output::point_rates::PointRates;
use crate::engine::quantities::rows::PeakOf;
use crate::engine::state::State;
use crate::engine::yielding::element::Element;

impl Model {
    /// A quantity of a link, counted from 0.
    pub(in crate::engine) fn link(&self, state: &State, point: &Point, l: usize, of: LinkOutput) -> f64 {
        let (system, rate) = (&self.system, self.system.link_closing(l, &point.v));
        let closing = || {
            let at_rest = if point.storeys.is_empty() { 0.0 } else { system.link_closing_of_floors(l, &point.rest) };
            system.link_closing(l, &point.q) + at_rest
        };
        let of_slip =
            |value: fn(&Element, &Storey) -> f64| self.slip_of(point, l).map_or(0.0, |(of, storey)| value(of, storey));
        match of {
            LinkOutput::Displacement => closing(),
            LinkOutput::Velocity => rate,
            LinkOutput::Force => match self.slipping_force(point, l) {
                Some(force) => force + system.structure.links[l].dashpot * rate,
                None => system.link_force(&point.storeys, l, (closing(), rate)),
            },
            LinkOutput::DissipatedEnergy => {
                let of_dashpot = self.energy(state, point).map_or(0.0, |_| point.dashpots.borrow()[l]);
                of_dashpot + of_slip(Element::hysteretic_energy)
            }
            LinkOutput::Slip => of_slip(|_, storey| storey.plastic),
            LinkOutput::SlipTravel => of_slip(|_, storey| storey.cumulative.exact()),
            LinkOutput::Slipping => of_slip(|_, storey| storey.yields.map_or(0.0, Sense::sign)),
        }
    }

    /// Force of the spring of a link that slips now, N: exactly on its yield line.
    fn slipping_force(&self, point: &Point, l: usize) -> Option<f64> {
        let i = self.system.number_of_link(l)?;
        point.storeys.get(i).filter(|storey| storey.yields.is_some())?;
        let (of, present) = self.system.element(i, &point.storeys);
        Some(of.shear(present, 0.0))
    }

    /// The largest magnitude so far of a quantity; that of the force of a spring that has slipped is no less than its yield
    /// line, on which no sum rounds.
    pub(in crate::engine) fn peak_shown(&self, state: &State, point: &Point, of: PeakOf) -> f64 {
        let peak = self.peak(state, point, of);
        let PeakOf::LinkForce(l) = of else { return peak };
        let has_slipped = |storey: &Storey| storey.furthest > 0.0 && self.system.structure.links[l].dashpot == 0.0;
        let line = self.slip_of(point, l).filter(|(_, storey)| has_slipped(storey) && !self.peak_rows.are_none());
        line.map_or(peak, |(of, storey)| peak.max(of.peak_shear(storey)))
    }

    /// Its rates.
    pub(in crate::engine) fn link_rates(&self, point: &Point, rates: &PointRates, l: usize, of: LinkOutput) -> Rates {
        let system = &self.system;
        let [velocity, acceleration, jerk] =
            [&point.v, &rates.acceleration, &rates.jerk].map(|motion| system.link_closing(l, motion));
        let jerk = if rates.is_beginning { 0.0 } else { jerk };
        let link = &system.structure.links[l];
        let stiffness = link.stiffness - system.stiffness_lost_by_link(&point.storeys, l);
        let slip = self.slip_of(point, l);
        let flow = slip.and_then(|(_, storey)| storey.yields).map_or(0.0, Sense::sign);
        match of {
            LinkOutput::Displacement => [velocity, acceleration],
            LinkOutput::Velocity => [acceleration, jerk],
            LinkOutput::Force => {
                [stiffness * velocity + link.dashpot * acceleration, stiffness * acceleration + link.dashpot * jerk]
            }
            LinkOutput::DissipatedEnergy => {
                let slipping = slip.map_or(0.0, |(of, _)| flow * of.kept() * of.force);
                let dashpot = if self.energy { link.dashpot } else { 0.0 };
                let of_dashpot = [dashpot * velocity * velocity, 2.0 * dashpot * velocity * acceleration];
                [slipping * velocity + of_dashpot[0], slipping * acceleration + of_dashpot[1]]
            }
            LinkOutput::Slip => [velocity, acceleration].map(|rate| flow.abs() * rate),
            LinkOutput::SlipTravel => [velocity, acceleration].map(|rate| flow * rate),
            // Held from one event to the next.
            LinkOutput::Slipping => [0.0; 2],
        }
    }

    /// The spring of a link that slips.
    fn slip_of<'a>(&'a self, point: &'a Point, l: usize) -> Option<(&'a Element, &'a Storey)> {
        let i = self.system.number_of_link(l)?;
        Some((&self.system.storeys[i], point.storeys.get(i)?))
    }
}
