//! Links at the observed time.

use crate::engine::model::Model;
use crate::engine::output::outputs::{LinkOutput, Rates};
use crate::engine::output::point::Point;
use crate::engine::output::point_rates::PointRates;

impl Model {
    /// A quantity of a link, counted from 0.
    pub(in crate::engine) fn link(&self, point: &Point, l: usize, of: LinkOutput) -> f64 {
        let (system, rate) = (&self.system, self.system.link_closing(l, &point.v));
        let closing = || {
            let at_rest = if point.storeys.is_empty() { 0.0 } else { system.link_closing_of_floors(l, &point.rest) };
            system.link_closing(l, &point.q) + at_rest
        };
        match of {
            LinkOutput::Displacement => closing(),
            LinkOutput::Velocity => rate,
            LinkOutput::Force => system.link_force(&point.storeys, l, (closing(), rate)),
        }
    }

    /// Its rates.
    pub(in crate::engine) fn link_rates(&self, point: &Point, rates: &PointRates, l: usize, of: LinkOutput) -> Rates {
        let system = &self.system;
        let [velocity, acceleration, jerk] =
            [&point.v, &rates.acceleration, &rates.jerk].map(|motion| system.link_closing(l, motion));
        let jerk = if rates.is_beginning { 0.0 } else { jerk };
        let link = &system.structure.links[l];
        let stiffness = link.stiffness - system.stiffness_lost_by_link(&point.storeys, l);
        match of {
            LinkOutput::Displacement => [velocity, acceleration],
            LinkOutput::Velocity => [acceleration, jerk],
            LinkOutput::Force => {
                [stiffness * velocity + link.dashpot * acceleration, stiffness * acceleration + link.dashpot * jerk]
            }
        }
    }
}
