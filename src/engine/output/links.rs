//! Links at the observed time.

use crate::engine::base::element::ElementState;
use crate::engine::output::instant::Instant;
use crate::engine::output::outputs::{LinkOutput, Rates};
use crate::engine::output::point_rates::PointRates;
use crate::engine::output::yielding::flow;
use crate::engine::quantities::rows::PeakOf;
use crate::engine::yielding::element::Element;
use crate::structure::Motion;

impl<'a> Instant<'a> {
    /// A quantity of a link, counted from 0.
    pub(super) fn link(&self, l: usize, of: LinkOutput) -> f64 {
        let (system, point) = (&self.model.system, self.point);
        let Motion { q, v } = self.motion();
        let rate = system.link_closing(l, v);
        let closing = || {
            let at_rest = if point.elements.is_empty() { 0.0 } else { system.link_closing_of_floors(l, &point.rest) };
            system.link_closing(l, q) + at_rest
        };
        let of_slip =
            |value: fn(&Element, &ElementState) -> f64| self.slip_of(l).map_or(0.0, |(of, element)| value(of, element));
        match of {
            LinkOutput::Displacement => closing(),
            LinkOutput::Velocity => rate,
            LinkOutput::Force => match self.slipping_force(l) {
                Some(force) => force + system.structure.links[l].dashpot * rate,
                None => system.link_force(&point.elements, l, (closing(), rate)),
            },
            LinkOutput::DissipatedEnergy => {
                let of_dashpot = self.energy().map_or(0.0, |_| point.dashpots.borrow()[l]);
                of_dashpot + of_slip(Element::hysteretic_energy)
            }
            LinkOutput::Slip => of_slip(|_, element| element.plastic),
            LinkOutput::SlipTravel => of_slip(|_, element| element.cumulative.exact()),
            LinkOutput::Slipping => of_slip(|_, element| flow(element)),
        }
    }

    /// Force of the spring of a link that slips now, N: exactly on its yield line.
    fn slipping_force(&self, l: usize) -> Option<f64> {
        let (system, elements) = (&self.model.system, &self.point.elements);
        let i = system.number_of_link(l)?;
        elements.get(i).filter(|element| element.yields.is_some())?;
        let (of, present) = system.element_at(i, elements);
        Some(of.shear(present, 0.0))
    }

    /// The largest magnitude so far of a quantity; that of the force of a spring that has slipped is no less than its yield
    /// line, on which no sum rounds.
    pub(super) fn peak_shown(&self, of: PeakOf) -> f64 {
        let (model, peak) = (self.model, self.peak(of));
        let PeakOf::LinkForce(l) = of else { return peak };
        let has_slipped =
            |element: &ElementState| element.furthest > 0.0 && model.system.structure.links[l].dashpot == 0.0;
        let line = self.slip_of(l).filter(|(_, element)| has_slipped(element) && !model.watched.rows.are_none());
        line.map_or(peak, |(of, element)| peak.max(of.peak_shear(element)))
    }

    /// Rates of a quantity of a link.
    pub(super) fn link_rates(&self, rates: &PointRates, l: usize, of: LinkOutput) -> Rates {
        let (system, point) = (&self.model.system, self.point);
        let [velocity, acceleration, jerk] =
            [self.motion().v, &rates.acceleration, &rates.jerk].map(|motion| system.link_closing(l, motion));
        let jerk = if rates.is_beginning { 0.0 } else { jerk };
        let link = &system.structure.links[l];
        let stiffness = link.stiffness - system.stiffness_lost_by_link(&point.elements, l);
        let slip = self.slip_of(l);
        let flow = slip.map_or(0.0, |(_, element)| flow(element));
        match of {
            LinkOutput::Displacement => [velocity, acceleration],
            LinkOutput::Velocity => [acceleration, jerk],
            LinkOutput::Force => {
                [stiffness * velocity + link.dashpot * acceleration, stiffness * acceleration + link.dashpot * jerk]
            }
            LinkOutput::DissipatedEnergy => {
                let slipping = slip.map_or(0.0, |(of, _)| flow * of.kept() * of.force);
                let dashpot = if self.model.energy { link.dashpot } else { 0.0 };
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
    fn slip_of(&self, l: usize) -> Option<(&'a Element, &'a ElementState)> {
        let i = self.model.system.number_of_link(l)?;
        Some((&self.model.system.elements[i], self.point.elements.get(i)?))
    }
}
