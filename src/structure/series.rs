//! Power series in time of all modes: the dense solution of a step.

use super::{LANES, Structure};
use crate::polynomial::Powers;

/// Powers that a series may have.
const MOST_POWERS: usize = 40;

/// 1 / ((n + 1) (n + 2)).
const RECIPROCAL: [f64; MOST_POWERS] = {
    let mut table = [0.0; MOST_POWERS];
    let mut n = 0;
    while n < MOST_POWERS {
        table[n] = 1.0 / ((n + 1) * (n + 2)) as f64;
        n += 1;
    }
    table
};

/// Remainder of a series that is exact to rounding.
pub const EXACT: f64 = 1e-19;

/// Order at which the flight series over `reach` = (fastest rate) x (time) is good to a relative `remainder`; `None`
/// where the interval is too long for a series.
pub fn flight_order(reach: f64, remainder: f64) -> Option<usize> {
    if reach > 2.0 {
        return None;
    }
    let (mut term, mut order) = (1.0, 0);
    while term > remainder || order < 4 {
        order += 1;
        term *= reach / order as f64;
    }
    Some(order)
}

/// The forces of pairs while a series is expanded, power by power.
pub trait PairForces {
    /// Power n of the force of pair number k, in units of the load.
    fn force(&mut self, k: usize, n: usize) -> f64;
    /// Takes power n of the penetration of pair number k; `term` is that of all modes.
    fn advance(&mut self, k: usize, n: usize, penetration: f64, term: &[f64]);
}

/// q(x) = sum of `rows[n]` x^n with x = t / scale, of all modes.
#[derive(Clone, Debug, Default)]
pub struct ModalSeries {
    lanes: usize,
    /// s, unit of x: near the length of the step, so that the terms tell the error and never overflow.
    pub scale: f64,
    /// Highest power.
    pub order: usize,
    coefficients: Vec<f64>,
}

impl ModalSeries {
    /// Room for powers up to `highest`.
    pub fn new(lanes: usize, highest: usize) -> ModalSeries {
        ModalSeries { lanes, scale: 1.0, order: 0, coefficients: vec![0.0; lanes * (highest + 1)] }
    }

    /// Starts a series from a state.
    pub fn start(&mut self, scale: f64, q: &[f64], v: &[f64]) {
        self.scale = scale;
        self.order = 1;
        let (first, rest) = self.coefficients.split_at_mut(self.lanes);
        first.copy_from_slice(q);
        for (c, v) in rest.iter_mut().zip(v) {
            *c = v * scale;
        }
    }

    /// The coefficients of power `n`.
    pub fn term(&self, n: usize) -> &[f64] {
        &self.coefficients[n * self.lanes..(n + 1) * self.lanes]
    }

    /// Appends power n + 2 from the load's power n (in 1/scale^n), by (n+1)(n+2) q_{n+2} = load_n - c (n+1) q_{n+1} - w^2 q_n.
    ///
    /// `load` adds the modal load of power n to its argument, which holds zeros, in units of the load itself, and
    /// `constrain` may change the modal accelerations that follow from it.
    pub fn extend(&mut self, structure: &Structure, load: impl FnOnce(&mut [f64]), constrain: impl FnOnce(&mut [f64])) {
        let n = self.order - 1;
        let lanes = self.lanes;
        let (known, next) = self.coefficients.split_at_mut((n + 2) * lanes);
        let (q0, q1) = (&known[n * lanes..(n + 1) * lanes], &known[(n + 1) * lanes..]);
        let next = &mut next[..lanes];
        next.fill(0.0);
        load(next);
        let (k1, k2) = ((n + 1) as f64, (n + 2) as f64);
        let rate = k1 / self.scale;
        for m in 0..lanes {
            next[m] -= rate * structure.damping[m] * q1[m] + structure.omega2[m] * q0[m];
        }
        structure.subtract_coupling(q1, rate, next);
        constrain(next);
        let factor = self.scale * self.scale / (k1 * k2);
        for value in next.iter_mut() {
            *value *= factor;
        }
        self.order += 1;
    }

    /// Expands from a started series to `order` where damping couples no modes, under a load, its slope and the forces
    /// of some pairs; `rows` holds the rows of all pairs, LANES entries after LANES entries.
    pub fn expand_in_contact(
        &mut self,
        structure: &Structure,
        order: usize,
        (load, slope): (&[f64], &[f64]),
        (rows, active): (&[f64], &[usize]),
        forces: &mut impl PairForces,
        (force, gathered): (&mut [f64], &mut [[f64; LANES]]),
    ) {
        let width = self.lanes / LANES;
        let scale2 = self.scale * self.scale;
        let [(damping, _), (omega2, _), (rows, _), (load, _), (slope, _)] =
            [&structure.damping, &structure.omega2, rows, load, slope].map(<[f64]>::as_chunks::<LANES>);
        let (damping, omega2, load, slope) = (&damping[..width], &omega2[..width], &load[..width], &slope[..width]);
        let (terms, _) = self.coefficients.as_chunks_mut::<LANES>();
        for n in 0..order - 1 {
            for (k, force) in force.iter_mut().enumerate() {
                *force = forces.force(k, n);
            }
            gathered.fill([0.0; LANES]);
            let (known, next_terms) = terms.split_at_mut((n + 2) * width);
            let (q0, q1) = known[n * width..].split_at(width);
            let next_terms = &mut next_terms[..width];
            let rate = (n + 1) as f64 / self.scale;
            let factor = scale2 * RECIPROCAL[n];
            for c in 0..width {
                let mut next = match n {
                    0 => load[c],
                    1 => slope[c].map(|slope| slope * self.scale),
                    _ => [0.0; LANES],
                };
                for i in 0..LANES {
                    next[i] -= rate * damping[c][i] * q1[c][i] + omega2[c][i] * q0[c][i];
                }
                for (&p, &force) in active.iter().zip(&*force) {
                    let row = &rows[p * width + c];
                    for i in 0..LANES {
                        next[i] -= row[i] * force;
                    }
                }
                for next in &mut next {
                    *next *= factor;
                }
                next_terms[c] = next;
                for (&p, sum) in active.iter().zip(gathered.iter_mut()) {
                    let row = &rows[p * width + c];
                    for i in 0..LANES {
                        sum[i] += row[i] * next[i];
                    }
                }
            }
            for (k, gathered) in gathered.iter().enumerate() {
                forces.advance(k, n + 2, gathered.iter().sum(), next_terms.as_flattened());
            }
        }
        self.order = order;
    }

    /// Expands a flight: load and slope only.
    pub fn expand_flight(
        &mut self,
        structure: &Structure,
        (q, v): (&[f64], &[f64]),
        (load, slope): (&[f64], &[f64]),
        (scale, order): (f64, usize),
    ) {
        if structure.is_classical() {
            return self.expand_single_modes(structure, (q, v), (load, slope), (scale, order));
        }
        self.start(scale, q, v);
        while self.order < order.max(2) {
            let n = self.order - 1;
            let load_of_power = |out: &mut [f64]| match n {
                0 => out.copy_from_slice(load),
                1 => out.iter_mut().zip(slope).for_each(|(out, slope)| *out = slope * scale),
                _ => {}
            };
            self.extend(structure, load_of_power, |_| {});
        }
    }

    /// A flight without coupling: each mode by itself, a few at a time, which then stay in registers.
    fn expand_single_modes(
        &mut self,
        structure: &Structure,
        (q, v): (&[f64], &[f64]),
        (load, slope): (&[f64], &[f64]),
        (scale, order): (f64, usize),
    ) {
        self.scale = scale;
        self.order = order.max(3);
        let width = self.lanes / LANES;
        let scale2 = scale * scale;
        let [(q, _), (v, _), (load, _), (slope, _), (damping, _), (omega2, _)] =
            [q, v, load, slope, &structure.damping, &structure.omega2].map(|vector| vector.as_chunks::<LANES>());
        let (terms, _) = self.coefficients.as_chunks_mut::<LANES>();
        for c in 0..width {
            let a = damping[c].map(|damping| damping * scale);
            let b = omega2[c].map(|omega2| omega2 * scale2);
            let mut before = q[c];
            let mut last = v[c].map(|v| v * scale);
            terms[c] = before;
            terms[width + c] = last;
            for n in 0..self.order - 1 {
                let mut next = match n {
                    0 => load[c].map(|load| load * scale2),
                    1 => slope[c].map(|slope| slope * (scale2 * scale)),
                    _ => [0.0; LANES],
                };
                let (k1, factor) = ((n + 1) as f64, RECIPROCAL[n]);
                for i in 0..LANES {
                    next[i] = (next[i] - (k1 * a[i] * last[i] + b[i] * before[i])) * factor;
                }
                terms[(n + 2) * width + c] = next;
                (before, last) = (last, next);
            }
        }
    }

    /// q and v at the x of the powers.
    pub fn evaluate(&self, powers: &Powers, q: &mut [f64], v: &mut [f64]) {
        let width = self.lanes / LANES;
        let rate = 1.0 / self.scale;
        let (terms, _) = self.coefficients.as_chunks::<LANES>();
        let [(q, _), (v, _)] = [q, v].map(|vector| vector.as_chunks_mut::<LANES>());
        let (power, slope) = powers.tables();
        for c in 0..width {
            // Even and odd powers apart: neither waits for the other.
            let (mut values, mut slopes) = ([[0.0; LANES]; 2], [[0.0; LANES]; 2]);
            for n in (0..=self.order).rev() {
                let term = &terms[n * width + c];
                let (value, derivative) = (&mut values[n % 2], &mut slopes[n % 2]);
                for i in 0..LANES {
                    value[i] += term[i] * power[n];
                    derivative[i] += term[i] * slope[n];
                }
            }
            for i in 0..LANES {
                q[c][i] = values[0][i] + values[1][i];
                v[c][i] = (slopes[0][i] + slopes[1][i]) * rate;
            }
        }
    }

    /// v alone at x.
    pub fn velocity(&self, x: f64, v: &mut [f64]) {
        let width = self.lanes / LANES;
        let rate = 1.0 / self.scale;
        let (terms, _) = self.coefficients.as_chunks::<LANES>();
        let (v, _) = v.as_chunks_mut::<LANES>();
        for c in 0..width {
            let mut slope = [0.0; LANES];
            for n in (1..=self.order).rev() {
                let (power, term) = (n as f64, &terms[n * width + c]);
                for i in 0..LANES {
                    slope[i] = slope[i] * x + power * term[i];
                }
            }
            v[c] = slope.map(|slope| slope * rate);
        }
    }

    /// v of one mode at many x at once.
    pub fn velocities<const N: usize>(&self, mode: usize, x: &[f64; N]) -> [f64; N] {
        let mut slope = [0.0; N];
        for n in (1..=self.order).rev() {
            let term = n as f64 * self.coefficients[n * self.lanes + mode];
            for i in 0..N {
                slope[i] = slope[i] * x[i] + term;
            }
        }
        let rate = 1.0 / self.scale;
        slope.map(|slope| slope * rate)
    }

    /// The scalar series row . q, written to `out[n]`. Returns the sum of the sizes of all that is added up at x, which
    /// tells the rounding error of a value within 0..=x.
    pub fn project(&self, row: &[f64], x: f64, out: &mut [f64]) -> f64 {
        let (mut sum, mut power) = (0.0, 1.0);
        for (n, out) in out.iter_mut().enumerate().take(self.order + 1) {
            let (value, size) = difference(row, self.term(n));
            *out = value;
            sum += size * power;
            power *= x;
        }
        sum
    }
}

/// The sum of products, 0 where its terms cancel but for rounding, and the sum of their sizes.
///
/// Two floors that move alike have a distance of 0 to rounding; the sign of that rounding must not decide what happens.
pub fn difference(row: &[f64], modal: &[f64]) -> (f64, f64) {
    let value = dot(row, modal);
    let size: f64 = row.iter().zip(modal).map(|(row, q)| (row * q).abs()).sum();
    if value.abs() <= 4.0 * f64::EPSILON * size { (0.0, size) } else { (value, size) }
}

/// Sum of products in a fixed order: one partial sum per lane, then the lanes from left to right.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    for (a, b) in a.chunks_exact(LANES).zip(b.chunks_exact(LANES)) {
        for i in 0..LANES {
            lanes[i] += a[i] * b[i];
        }
    }
    lanes.iter().sum()
}
