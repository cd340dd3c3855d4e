//! How long the spring of a power law alone takes to turn a contact round and to release it.

use crate::contact::force::power;
use crate::contact::{EpisodeForce, Force};
use crate::engine::pairs::pair::Pair;
use crate::numerics::quadrature::{EIGHT, gauss};

/// The spring of a pair under a power law, which alone would let it swing through a contact.
#[derive(Clone, Copy, Debug)]
pub struct Spring {
    pub exponent: f64,
    /// Exponent of the speed in the unit of time: (1 - n) / (n + 1).
    pub power: f64,
    /// The unit of time for a speed of 1 m/s, s.
    pub unit: f64,
    /// Largest penetration in units of time and speed.
    pub deepest: f64,
    /// [`swing`] from the surface.
    pub all: f64,
}

/// When a spring alone would do what, s.
pub struct Forecast {
    /// Its time: (m V^(1-n) / k)^(1/(n+1)) for the speed V of all of its energy.
    pub unit: f64,
    /// Until it turns round.
    pub turn: f64,
    /// Until it is released.
    pub release: f64,
}

impl Spring {
    /// `None` for other laws.
    pub fn of(pair: &Pair) -> Option<Spring> {
        let (stiffness, n) = match EpisodeForce::new(&pair.law, pair.mass, None).engaged {
            Force::Power { stiffness, exponent, .. } => (stiffness, exponent),
            Force::Root { stiffness, .. } => (stiffness, 1.5),
            Force::None | Force::Linear { .. } => return None,
        };
        let root = |x: f64| libm::pow(x, 1.0 / (n + 1.0));
        Some(Spring {
            exponent: n,
            power: (1.0 - n) / (n + 1.0),
            unit: root(pair.mass / stiffness),
            deepest: root(0.5 * (n + 1.0)),
            all: swing(n, 0.0),
        })
    }

    /// From a penetration, m, its rate, m/s, and the energy stored per unit of mass, J/kg; `None` beyond all measure.
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

/// Integral of 1 / sqrt(1 - u^(n+1)) over from..1, roughly: the time from a depth to the deepest.
fn swing(n: f64, from: f64) -> f64 {
    let width = 1.0 - from.min(1.0);
    gauss(EIGHT, 1.0)
        .map(|(y, weight)| {
            let u = 1.0 - width * y * y;
            weight * 2.0 * width * y / (1.0 - power(u, n + 1.0)).max(f64::MIN_POSITIVE).sqrt()
        })
        .sum()
}
