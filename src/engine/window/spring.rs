//! Estimates of the time in which the spring of a power law alone makes a contact turn and releases it.

use crate::contact::force::power;
use crate::engine::pairs::pair::Pair;
use crate::numerics::quadrature::{EIGHT, gauss};

/// The spring of a pair under a power law: constants of its oscillation through a contact.
#[derive(Clone, Copy, Debug)]
pub struct Spring {
    /// Exponent n of the force k d^n.
    pub exponent: f64,
    /// Exponent of the velocity in the time unit: (1 - n) / (n + 1).
    pub power: f64,
    /// The time unit at a velocity of 1 m/s, s.
    pub unit: f64,
    /// Largest penetration, in units of velocity times time unit.
    pub deepest: f64,
    /// [`swing`] from the surface to the largest penetration.
    pub all: f64,
}

/// Estimated times for a contact under a spring alone, s.
pub struct Forecast {
    /// The time unit: (m V^(1-n) / k)^(1/(n+1)), with V the velocity that corresponds to all of the energy.
    pub unit: f64,
    /// Time until the penetration is largest.
    pub turn: f64,
    /// Time until the release.
    pub release: f64,
}

impl Spring {
    /// For a pair; `None` under other laws.
    pub fn of(pair: &Pair) -> Option<Spring> {
        let force = pair.force();
        if force.is_regular() {
            return None;
        }
        let (stiffness, n, _) = force.in_units_of(1.0);
        let root = |x: f64| libm::pow(x, 1.0 / (n + 1.0));
        Some(Spring {
            exponent: n,
            power: (1.0 - n) / (n + 1.0),
            unit: root(pair.mass / stiffness),
            deepest: root(0.5 * (n + 1.0)),
            all: swing(n, 0.0),
        })
    }

    /// The estimate from a penetration, m, its rate, m/s, and the elastic energy per unit of mass, J/kg; `None` if
    /// numbers overflow.
    pub fn forecast(&self, d: f64, rate: f64, stored: f64) -> Option<Forecast> {
        let speed = (rate * rate + 2.0 * stored).sqrt();
        let unit = self.unit * libm::pow(speed, self.power);
        let left = if d > 0.0 { swing(self.exponent, d / (self.deepest * unit * speed)) } else { self.all };
        let (turn, release) = if rate >= 0.0 { (left, self.all + left) } else { (0.0, self.all - left) };
        let time = self.deepest * unit;
        let is_sound = unit.is_finite() && unit > 0.0 && release > 0.0;
        is_sound.then_some(Forecast { unit, turn: turn * time, release: release * time })
    }
}

/// Estimate of the integral of 1 / sqrt(1 - u^(n+1)) over from..1: the time from a depth to the largest one, in units.
fn swing(n: f64, from: f64) -> f64 {
    let width = 1.0 - from.min(1.0);
    gauss(EIGHT, 1.0)
        .map(|(y, weight)| {
            let u = 1.0 - width * y * y;
            weight * 2.0 * width * y / (1.0 - power(u, n + 1.0)).max(f64::MIN_POSITIVE).sqrt()
        })
        .sum()
}
