//! An onset step, the first after an entry under a power law: a double power series of the motion (see
//! [`crate::contact::onset`]).
//!
//! The step ends before any event - a turn, a release, another entry, an element that yields - is possible, as bounds on
//! the sums of its terms prove. So it has no event of its own.

pub mod certificate;
pub mod follow;
pub mod series;

use crate::contact::Force;
use crate::contact::onset::{Grid, MOST_TERMS};
use crate::engine::base::kinds::Refusal;
use crate::engine::base::planned::Planned;
use crate::engine::base::{Base, Coordinates, touching};
use crate::engine::onset::series::{OnsetSeries, expand};
use crate::engine::pairs::jacobian::{FloorJacobian, ModalJacobian};
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;

/// Highest power of x in the double series: its cost grows with the square of this, its reach hardly.
const HIGHEST: f64 = 8.0;

/// Plans the first step of an episode, under the load in `work`, or says why it cannot be this one.
pub fn plan(
    system: &System,
    base: &Base,
    remaining: f64,
    planned: &mut Planned,
    onset: &mut OnsetSeries,
    work: &mut Buffers,
) -> Result<(), Refusal> {
    if cfg!(without = "onset") {
        return Err(Refusal::SwitchedOff);
    }
    let (grid, scale) = system.onset_grid(base, work, remaining)?;
    onset.start(base, &system.pairs, grid, scale);
    let loads = work.loads();
    let (structure, coordinates) = (&system.structure, base.coordinates);
    match coordinates {
        Coordinates::Floors => expand(onset, structure, coordinates, loads, &FloorJacobian),
        Coordinates::Modes => expand(onset, structure, coordinates, loads, &ModalJacobian(&system.pairs)),
    }
    let reach = system.onset_reach(base, onset, &grid).min(remaining / scale);
    let x = system.certain_reach(base, onset, &mut work.node_q, reach).ok_or(Refusal::Uncertain)?;
    let reaches_limit = x * scale >= remaining;
    let length = if reaches_limit { remaining } else { x * scale };
    planned.plan(length, None, reaches_limit, Some(length));
    onset.read(length / scale);
    onset.evaluate(length / scale, &mut planned.q, &mut planned.v);
    Ok(())
}

impl System {
    /// The exponents of the series, common to all entering pairs, and its time scale, s: at most the shortest time in
    /// which one of these pairs would turn round.
    fn onset_grid(&self, base: &Base, work: &mut Buffers, remaining: f64) -> Result<(Grid, f64), Refusal> {
        if !touching(base).any(|(_, contact)| contact.is_singular()) {
            return Err(Refusal::NoEntry);
        }
        let mut found: Option<Grid> = None;
        let mut scale = self.series_scale(base, remaining);
        let allowed = self.tolerance.step * base.velocity_scale;
        self.accelerate(base.coordinates, base.motion(), &work.load, &mut work.q);
        for (p, contact) in base.contacts.iter().enumerate().filter(|(_, contact)| contact.is_singular()) {
            let force = contact.branch();
            let grid = Grid::of(&force, HIGHEST).ok_or(Refusal::MixedEntries)?;
            match () {
                _ if found.is_some_and(|other| other.beta != grid.beta) => return Err(Refusal::MixedEntries),
                _ if contact.rate <= 0.0 => return Err(Refusal::WeakEntry),
                _ => {}
            }
            found = Some(grid);
            let pair = &self.pairs[p];
            scale = scale.min(turning_time(&force, pair.mass, contact.rate));
            // If other accelerations change the approach velocity before the force matters, the velocity is too small.
            let overtaken = contact.rate / self.pairs[p].relative(base.coordinates, &work.q).abs();
            let gained = force.value(1.5 * contact.rate * overtaken, contact.rate) * overtaken / pair.mass;
            if gained < allowed {
                return Err(Refusal::WeakEntry);
            }
        }
        found.map(|grid| (grid, scale)).ok_or(Refusal::NoEntry)
    }

    /// The x up to which the last terms are below the tolerance. Free masses have only the terms x^(1 + beta j); so all
    /// terms within one power of x and one of z = x^beta below the highest are taken as the last.
    fn onset_reach(&self, base: &Base, onset: &OnsetSeries, grid: &Grid) -> f64 {
        let allowed = self.tolerance.step * base.velocity_scale * onset.scale;
        let mut last = [0.0; MOST_TERMS];
        grid.each(|index, exponent| {
            if exponent > HIGHEST - 1.0 - grid.beta {
                last[index] = exponent * self.floor_norm(base.coordinates, onset.term(index));
            }
        });
        // The sum is nearly a power of x: a few secant steps in logarithms.
        let mut x = 1.0;
        for _ in 0..3 {
            let error = grid.sum(&last, x) / x;
            if error <= 0.0 {
                return f64::INFINITY;
            }
            x *= libm::pow(allowed / error, 1.0 / (HIGHEST - 1.5));
        }
        0.9 * x
    }
}

/// The time in which a power force stops a mass, s: k (V t)^n t = m V.
fn turning_time(force: &Force, mass: f64, speed: f64) -> f64 {
    let (stiffness, exponent, _) = force.in_units_of(1.0);
    libm::pow(mass * libm::pow(speed, 1.0 - exponent) / stiffness, 1.0 / (exponent + 1.0))
}
