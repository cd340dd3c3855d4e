//! The course of a contact through a window.

use crate::collocation::{Interpolant, NODES, SolvedWindow, Tables, interpolants, nodes};
use crate::engine::base::contact::Contact;
use crate::engine::follow::{Course, NEARLY, Nodes, Reached};
use crate::engine::window::solution::{Window, largest};
use std::cell::OnceCell;

/// A contact in a window.
pub struct WindowCourse<'a> {
    window: &'a Window,
    /// Its place in the window.
    place: usize,
    /// The polynomials through its penetration and its rate at the nodes, made when they are first asked for.
    interpolants: OnceCell<[Interpolant; 2]>,
}

impl Window {
    /// The course of a contact in this window.
    pub fn course(&self, contact: usize) -> Option<WindowCourse<'_>> {
        let place = self.place(contact);
        debug_assert!(place.is_some(), "a closed contact is in the window");
        place.map(|place| WindowCourse { window: self, place, interpolants: OnceCell::new() })
    }
}

impl WindowCourse<'_> {
    /// Where the contact is after a time, s.
    pub fn reached(&self, time: f64) -> Reached {
        let WindowCourse { window, place, .. } = *self;
        let mut room = None;
        let moments = window.moments(time, &mut room);
        let (penetration, rate) = match time == window.solution.length {
            true => window.solution.end[place],
            false => window.depth(place, time, moments),
        };
        Reached { time, penetration, rate, impulse: moments[place][0] }
    }
}

impl Course<NODES> for WindowCourse<'_> {
    fn last(&self) -> Reached {
        self.reached(self.window.solution.length)
    }

    /// From the polynomials through the nodes.
    fn near(&self, time: f64) -> [f64; 3] {
        let SolvedWindow { map, rule, length, ref depth, ref rate, .. } = self.window.solution;
        let x = map.inverse(time / length);
        let [depth, rate] =
            self.interpolants.get_or_init(|| interpolants(nodes(rule), [depth, rate].map(|rows| &rows[self.place])));
        read([depth, rate], x, length * map.at(x).1, self.window.equation.by_rates())
    }

    /// From the moments, which have more digits than what is interpolated between nodes.
    fn at(&self, time: f64) -> (f64, f64) {
        self.window.depth(self.place, time, self.window.moments(time, &mut None))
    }

    fn nodes(&self, until: &Reached) -> Nodes<NODES> {
        let SolvedWindow { map, rule, length, ref depth, ref rate, .. } = self.window.solution;
        let (of, depths, rates) = (nodes(rule), depth[self.place], rate[self.place]);
        if until.time < length {
            let part = self.window.part(until.time, rule);
            let [depths, rates] = [depths, rates].map(|row| of.interpolant(&row).at(&part.x));
            return Nodes { count: of.count, times: part.times, weights: part.weights, depths, rates };
        }
        let Tables { weight, theta, .. } = Tables::of(map, rule);
        let [times, weights] = [theta, weight].map(|of_unit| of_unit.map(|share| share * length));
        Nodes { count: of.count, times, weights, depths, rates }
    }

    fn may_turn(&self, contact: &Contact) -> [bool; 2] {
        let SolvedWindow { ref depth, ref force, ref end, .. } = self.window.solution;
        let (deepest, (last, rate)) = (largest(&depth[self.place]), end[self.place]);
        [
            deepest > NEARLY * contact.episode.peak_penetration && (deepest > last || rate < 0.0),
            contact.branch().is_damped() && largest(&force[self.place]) > NEARLY * contact.episode.peak_force,
        ]
    }
}

/// Penetration, rate and acceleration at x, where x passes by 1 in `per_x` seconds.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn read([depth, rate]: [&Interpolant; 2], x: f64, per_x: f64, is_damped: bool) -> [f64; 3] {
    if !is_damped {
        let depth = depth.knot(x);
        return [depth.value, depth.slope / per_x, 0.0];
    }
    let [depth, rate] = Interpolant::knots([depth, rate], x);
    [depth.value, rate.value, rate.slope / per_x]
}
