//! One bilinear oscillator under a constant force, from switch to switch, each phase in closed form.

use std::f64::consts::PI;

/// q'' = load - w^2 (r q + (1 - r) z), with z = q - plastic drift between -limit and limit.
#[derive(Clone, Copy, Debug)]
pub struct Oscillator {
    /// rad/s, while elastic.
    pub w: f64,
    /// Yield drift, m.
    pub limit: f64,
    pub ratio: f64,
    /// m/s2.
    pub load: f64,
    /// s.
    pub time: f64,
    /// The elastic part z of the drift.
    pub elastic: f64,
    pub rate: f64,
    pub plastic: f64,
    /// Sum of the magnitudes of all changes of the plastic drift, m.
    pub cumulative: f64,
    /// Largest magnitude of the plastic drift, m.
    pub furthest: f64,
    /// The sense in which it yields, 0 while it is elastic.
    pub sense: f64,
}

impl Oscillator {
    /// At its rest position at time 0.
    pub fn new(w: f64, limit: f64, ratio: f64) -> Oscillator {
        let (load, time, elastic, rate, plastic) = (0.0, 0.0, 0.0, 0.0, 0.0);
        Oscillator { w, limit, ratio, load, time, elastic, rate, plastic, cumulative: 0.0, furthest: 0.0, sense: 0.0 }
    }

    /// m.
    pub fn drift(&self) -> f64 {
        self.plastic + self.elastic
    }

    /// Force over mass, m/s2.
    pub fn force(&self) -> f64 {
        self.w * self.w * (self.ratio * self.plastic + self.elastic)
    }

    /// The phase of its present state and, s, how long it lasts.
    fn phase(&self) -> (f64, f64) {
        if self.sense != 0.0 {
            return (self.sense, self.until_turn());
        }
        let (centre, v) = (self.centre(), self.rate / self.w);
        let y = self.elastic - centre;
        let until = |sense: f64| {
            let (y, v, limit) = (sense * y, sense * v, self.limit - sense * centre);
            let size = f64::hypot(y, v);
            if y >= limit && (v > 0.0 || v == 0.0 && y < 0.0) {
                return 0.0;
            }
            // A graze is none.
            if size <= limit + 1e-12 * (self.limit + size) || v == 0.0 && y == limit {
                return f64::INFINITY;
            }
            let angle = f64::atan2(v, y) - f64::acos((limit / size).max(-1.0));
            angle.rem_euclid(2.0 * PI) / self.w
        };
        let (up, down) = (until(1.0), until(-1.0));
        if up < down { (0.0, up) } else { (0.0, -down) }
    }

    /// The elastic part with which an elastic oscillator would stand still.
    fn centre(&self) -> f64 {
        self.load / (self.w * self.w) - self.ratio * self.plastic
    }

    /// Acceleration, m/s2, from now on if it yields in its sense.
    fn yielding_acceleration(&self) -> f64 {
        self.load - self.w * self.w * (self.ratio * self.plastic + self.sense * self.limit)
    }

    fn until_turn(&self) -> f64 {
        let (nu, v, a) = (self.w * self.ratio.sqrt(), self.rate.abs(), self.sense * self.yielding_acceleration());
        match nu > 0.0 {
            true => f64::atan2(nu * v, -a) / nu,
            false if a < 0.0 => -v / a,
            false => f64::INFINITY,
        }
    }

    /// Within the present phase.
    fn moved(mut self, t: f64) -> Oscillator {
        self.time += t;
        if self.sense == 0.0 {
            let (centre, v, (sin, cos)) = (self.centre(), self.rate / self.w, (self.w * t).sin_cos());
            let y = self.elastic - centre;
            self.elastic = centre + y * cos + v * sin;
            self.rate = self.w * (v * cos - y * sin);
            return self;
        }
        let (nu, a) = (self.w * self.ratio.sqrt(), self.yielding_acceleration());
        let (cos, s, c) = match nu > 0.0 {
            true => ((nu * t).cos(), (nu * t).sin() / nu, 2.0 * ((0.5 * nu * t).sin() / nu).powi(2)),
            false => (1.0, t, 0.5 * t * t),
        };
        let step = self.rate * s + a * c;
        self.rate = self.rate * cos + a * s;
        self.plastic += step;
        self.cumulative += step.abs();
        self.furthest = self.furthest.max(self.plastic.abs());
        self.elastic = self.sense * self.limit;
        self
    }

    /// The state just after its next switch; `None` if there is none.
    pub fn after_switch(self) -> Option<Oscillator> {
        let (phase, duration) = self.phase();
        if !duration.is_finite() {
            return None;
        }
        let mut next = self.moved(duration.abs());
        if phase == 0.0 {
            next.sense = if duration.is_sign_negative() { -1.0 } else { 1.0 };
            next.elastic = next.sense * next.limit;
        } else {
            (next.sense, next.rate) = (0.0, 0.0);
        }
        Some(next)
    }

    /// At a later time.
    pub fn at(self, time: f64) -> Oscillator {
        let mut now = self;
        while let Some(next) = now.after_switch().filter(|next| next.time <= time) {
            now = next;
        }
        now.moved(time - now.time)
    }

    /// The states just after all switches up to a time.
    pub fn switches(self, until: f64) -> Vec<Oscillator> {
        let switches = std::iter::successors(self.after_switch(), |now| now.after_switch());
        switches.take_while(|now| now.time <= until).collect()
    }
}
