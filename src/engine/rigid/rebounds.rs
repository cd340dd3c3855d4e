//! Rigid pairs near the surface: the step length up to the next rebound, and their penetration and rate at its end.

use crate::engine::base::Base;
use crate::engine::base::contact::Contact;
use crate::engine::base::planned::{Event, Tracked};
use crate::engine::excitation::inputs::Inputs;
use crate::engine::pairs::pair::Pair;
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::numerics::polynomial::{MAX_TERMS, value_and_slope};
use crate::numerics::powers::Powers;
use crate::structure::{MotionSeries, difference};

/// Share of the remaining time for which floors are held together when rounding cannot tell them from free ones.
const SHORT_WHILE: f64 = 1e-3;

impl System {
    /// Upper bound on the step length, s, so that the next rebound of every pair near the surface takes a good part of
    /// the step; from the modal accelerations at the base.
    pub(crate) fn rebound_step_limit(&self, base: &Base, acceleration: &[f64]) -> f64 {
        let apart = base.contacts.iter().zip(&self.pairs).filter(|(contact, _)| contact.tracked);
        let bounce = |(contact, pair): (&Contact, &Pair)| {
            // Not `dot`: for floors that have just been let go, hardly apart yet, a relative acceleration by rounding is a
            // rebound after a time that no clock resolves, and none in the series of their penetration.
            let towards = difference(&pair.row.modes, acceleration).0;
            4.0 * time_to_surface(contact.penetration, contact.rate, towards)
        };
        apart.map(bounce).fold(f64::INFINITY, f64::min)
    }

    /// (length, is cut): the step length, s, near rigid contacts, at most `remaining`; or the release that comes first.
    /// Leaves the pairs that are held together in `work.rigid`, all active.
    pub(crate) fn time_for_rigid_pairs(
        &self,
        base: &Base,
        inputs: &Inputs,
        work: &mut Buffers,
        remaining: f64,
    ) -> Result<(f64, bool), Event> {
        if !self.has_close_rigid_pair(base) {
            work.rigid.clear();
            return Ok((remaining, false));
        }
        if let Some(p) = self.solve_reactions(base, inputs, work) {
            return Err(Event::Release(p));
        }
        work.rigid.close_all(&self.rigid.matrix);
        let mut time = self.rebound_step_limit(base, &work.q);
        if base.contacts.iter().any(|contact| contact.undecided) {
            time = time.min(SHORT_WHILE * remaining);
        }
        Ok((remaining.min(time), time < remaining))
    }

    /// Whether rigid floors are held together or about to collide again.
    pub(crate) fn has_close_rigid_pair(&self, base: &Base) -> bool {
        self.rigid.pairs.iter().any(|&p| base.contacts[p].is_held() || base.contacts[p].tracked)
    }

    /// Writes penetration and rate of each tracked pair at the x of the powers of a series in time.
    pub(crate) fn track(&self, base: &Base, series: &MotionSeries, powers: &Powers, tracked: &mut Tracked) {
        tracked.fill(None);
        for &p in &self.rigid.pairs {
            let (contact, pair) = (&base.contacts[p], &self.pairs[p]);
            tracked[p] = contact.tracked.then(|| {
                let terms = &mut [0.0; MAX_TERMS][..=series.order];
                let noise = pair.noise(pair.row.project(base.coordinates, series, powers.in_time().0, terms));
                contact.begin_flight(terms, series.scale, noise);
                let (penetration, slope) = value_and_slope(terms, powers.x);
                (penetration, slope / series.scale)
            });
        }
    }
}

/// The smallest t > 0 with d + v t + a t^2 / 2 = 0, s, for d <= 0.
fn time_to_surface(d: f64, v: f64, a: f64) -> f64 {
    let square = v * v - 2.0 * a * d;
    let time = match () {
        _ if square < 0.0 => f64::INFINITY,
        _ if v > 0.0 => -2.0 * d / (v + square.sqrt()),
        _ if a > 0.0 => (square.sqrt() - v) / a,
        _ => f64::INFINITY,
    };
    if time > 0.0 { time } else { f64::INFINITY }
}
