//! The window to try first: as long as the laws in it allow, or up to the next event if that is near.

use crate::collocation::{Ending, Frame, Map, NodeCount};
use crate::contact::Force;
use crate::engine::base::Base;
use crate::engine::system::System;
use crate::engine::window::kernels::Windows;
use crate::engine::window::solution::Window;

/// Time since an entry, in the contact's time units, until which the singularity at the entry is felt.
const FRESH: f64 = 0.3;

/// Factor on the spring's time until the turn, for a dashpot: it helps to stop the approach.
const DASHPOT: f64 = 0.85;

/// A window without a release in it ends at most at this share of the time until the release, whose singularity it
/// would feel.
const BEFORE_RELEASE: f64 = 0.8;

/// Largest x = (rate of a dashpot) x (length) of a window that is tried: n sweeps leave an error of about x^n / n!, at
/// most 24 sweeps are made, and a window that has failed is halved at most four times: 12.5^24 / 24! is above 1.
const TOO_STIFF: f64 = 200.0;

/// Largest (fastest rate) x (length) of a window where motion and kernels are power series.
const MODES_ANGLE: f64 = 1.0;

/// A window to be tried.
#[derive(Clone, Copy, Debug)]
pub struct Trial {
    /// Map from x in 0..1 to the share of the length: nodes are denser at a singularity.
    pub map: Map,
    /// The smallest rule that it may use.
    pub least: NodeCount,
    /// Length, s; with an event, the estimate of its time.
    pub length: f64,
    /// The event at its end.
    pub ending: Ending,
    /// Length of the longest window that may be tried, s.
    pub longest: f64,
    /// Length, s, to which [`reach_of_fewer`] is relative.
    pub reach: f64,
    /// Whether a longer one could not be proved free of events.
    pub halved: bool,
}

impl Trial {
    /// The window as the solver takes it.
    pub fn frame(self) -> Frame {
        let Trial { map, length, ending, .. } = self;
        let [eight, twelve] = reach_of_fewer(map);
        let rule = match length / self.reach {
            share if share < eight => NodeCount::Eight,
            share if share < twelve => NodeCount::Twelve,
            _ => NodeCount::Sixteen,
        };
        Frame { map, rule: rule.max(self.least), length, ending }
    }

    /// Largest length that it may have when it is solved, s.
    pub fn room(&self) -> f64 {
        match self.ending {
            Ending::Given => self.length,
            _ => self.longest.max(1.5 * self.length),
        }
    }

    /// The power of the length with which the error of sixteen nodes grows, roughly and found by measurement: lower where
    /// they are nodes in a fourth root of the time.
    pub fn order(&self) -> f64 {
        if matches!(self.map, Map::FourthStart | Map::FourthBoth) { 5.0 } else { 10.0 }
    }

    /// A window without an event, of that share of the length.
    pub fn shorter(self, share: f64) -> Trial {
        Trial { map: self.map.without_end(), length: share * self.length, ending: Ending::Given, ..self }
    }

    /// A window of that length up to an event.
    pub fn until(self, ending: Ending, length: f64) -> Trial {
        Trial { length, ending, ..self }
    }
}

impl Windows {
    /// Length of the longest window for which terms of the motion and kernels are good, s.
    pub fn longest(&self, system: &System) -> f64 {
        MODES_ANGLE / system.structure.fastest
    }

    /// The window to try first within the `remaining` seconds; `None` where numbers of a contact overflow or its
    /// damping is too stiff.
    pub fn trial(&self, system: &System, base: &Base, window: &mut Window, remaining: f64) -> Option<Trial> {
        let (mut longest, mut map) = (f64::INFINITY, Map::Plain);
        let (mut time, mut ending) = (f64::INFINITY, Ending::Given);
        let mut dashpot = 0.0_f64;
        for place in 0..window.equation.closed {
            let p = window.contacts[place];
            let (contact, force) = (&base.contacts[p], window.equation.forces[place]);
            let d = contact.penetration.max(0.0);
            let stored = force.stored_energy(d) / system.pairs[p].mass;
            let forecast = self.springs[p]?.forecast(d, contact.rate, stored)?;
            window.equation.omega[place] = 1.0 / forecast.unit;
            if force.is_damped() {
                dashpot = dashpot.max(force.dashpot(d) / system.pairs[p].mass);
            }
            let is_root = matches!(force, Force::Root { .. });
            let since = if contact.penetration > 0.0 { contact.age } else { 0.0 };
            let is_fresh = since < FRESH * forecast.unit;
            longest = longest.min(self.length_factor * longest_window(&force, is_fresh) * forecast.unit);
            if is_fresh && is_root && since > 0.0 {
                longest = longest.min(8.0 * since);
            }
            map = match (is_fresh, is_root) {
                (true, true) => Map::FourthStart,
                (true, false) if map == Map::Plain => Map::SquareStart,
                _ => map,
            };
            let event = match is_root && contact.rate > 0.0 {
                true => (DASHPOT * forecast.turn, Ending::Turn(place)),
                false => (forecast.release, Ending::Release(place)),
            };
            if event.0 < time {
                (time, ending) = event;
            }
        }
        // With fewer nodes the length depends on a higher power of the tolerance.
        let (reach, least) = (self.length_factor * longest, NodeCount::Eight);
        longest = longest.min(self.longest(system));
        if dashpot * time.min(longest).min(remaining) > TOO_STIFF {
            return None;
        }
        let trial = Trial { map, least, length: time, ending, longest: longest.min(remaining), reach, halved: false };
        let trial = match ending {
            Ending::Turn(_) if time <= longest => trial,
            Ending::Release(_) if time <= longest => Trial { map: map.with_end(), ..trial },
            _ => trial.until(Ending::Given, (time / (time / longest).ceil().max(2.0)).min(longest)),
        };
        if trial.length <= remaining {
            return Some(trial);
        }
        let is_before_release = matches!(ending, Ending::Release(_));
        let length = if is_before_release { remaining.min(BEFORE_RELEASE * time) } else { remaining };
        Some(Trial { length, ..trial.shorter(1.0) })
    }
}

/// Largest length of a window in the contact's time units, found by measurement; half of a Hertz contact takes 1.61.
fn longest_window(force: &Force, is_fresh: bool) -> f64 {
    match (force, is_fresh) {
        (Force::Root { .. }, true) => 0.62,
        (Force::Root { .. }, false) => 1.0,
        (_, true) if force.is_damped() => 0.95,
        (_, false) if force.is_damped() => 1.3,
        _ => 1.65,
    }
}

/// Largest length for eight and for twelve nodes, relative to that for sixteen; found by measurement. In the few
/// windows of a hundred where these are too few, the next rule is used.
fn reach_of_fewer(map: Map) -> [f64; 2] {
    match map {
        Map::Plain => [0.22, 0.65],
        Map::SquareStart => [0.09, 0.4],
        Map::SquareEnd => [0.12, 0.43],
        Map::FourthStart => [0.05, 0.5],
        Map::SquareBoth | Map::FourthBoth => [0.045, 0.27],
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::engine::base::contact::ContactPhase;
    use crate::engine::base::peaks::Peaks;
    use crate::scene::Scene;

    /// 1 mm deep in each other: the dashpot's rate is some 1e2/s for e = 0.5, and 1e14/s for 1e-12, for which windows
    /// of 0.01 s cannot be halved often enough.
    #[test]
    fn no_window_is_tried_where_none_can_succeed() {
        for (restitution, is_tried) in [(0.5, true), (1e-12, false)] {
            let building = "mass = [1e3]\nstiffness = [1e5]\ndamping = { ratio = 0.05 }\n";
            let scene = format!(
                "name = \"Two\"\n[right]\n{building}[left]\n{building}initial_velocity = [0.1]\n[[contact]]\nleft_floor = 1\n\
                 right_floor = 1\ngap = -1e-3\nlaw = \"jankowski\"\nstiffness = 1e8\nrestitution = {restitution:?}\n"
            );
            let system = System::of(&Scene::from_toml(&scene).unwrap(), None).unwrap();
            let (base, mut window) = (system.start(0.0, Peaks::default(), None), Window::default());
            assert_eq!(base.contacts[0].phase, ContactPhase::Engaged);
            let windows = Windows::of(&system).unwrap();
            let equation = &mut window.equation;
            (equation.closed, equation.forces[0]) = (1, base.contacts[0].branch());
            assert_eq!(windows.trial(&system, &base, &mut window, 0.01).is_some(), is_tried, "{restitution}");
        }
    }
}
