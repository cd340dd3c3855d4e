//! The integral equation of a window, and its matrices for a length.

use super::nodes::{AtNodes, Matrix, NODES};
use super::rows::{NOTHING, combine, combined, fours, value, values};
use super::tables::{POWERS, Tables};
use crate::contact::Force;
use crate::numerics::polynomial::{COUNT, Coefficients, MAX_TERMS, each, value_and_slope};

/// Pairs that a window is solved for at once: those in contact, and those that may come into contact.
pub(crate) const MOST_PAIRS: usize = 4;

/// All that is known before a window is solved.
#[derive(Clone, Debug)]
pub(crate) struct Equation {
    /// Number of pairs.
    pub pairs: usize,
    /// How many of them are in contact: the first. The others are watched.
    pub closed: usize,
    /// Force of each that is in contact.
    pub forces: [Force; MOST_PAIRS],
    /// Penetration of each without contact forces from the start of the window on, m, in powers of t / `scale`.
    pub free: [Coefficients; MOST_PAIRS],
    /// Number of those powers.
    pub terms: usize,
    /// s.
    pub scale: f64,
    /// G_pq in powers of t: m per N s at t; from t^0, which is 0.
    pub kernels: [[[f64; POWERS]; MOST_PAIRS]; MOST_PAIRS],
    /// Number of powers of the kernels that matter over the longest window.
    pub powers: usize,
    /// Error that a kernel may have, relative to G_pp.
    pub remainder: f64,
    /// Angular frequency of the oscillation that the first guess takes each contact for, rad/s.
    pub omega: [f64; MOST_PAIRS],
}

impl Default for Equation {
    fn default() -> Equation {
        Equation {
            pairs: 0,
            closed: 0,
            forces: [Force::None; MOST_PAIRS],
            free: [[0.0; MAX_TERMS]; MOST_PAIRS],
            terms: 2,
            scale: 1.0,
            kernels: [[[0.0; POWERS]; MOST_PAIRS]; MOST_PAIRS],
            powers: 2,
            remainder: 0.0,
            omega: [0.0; MOST_PAIRS],
        }
    }
}

/// The response of the penetration of one pair to the force of another, which is the same in both directions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairResponse {
    /// From node to node, of pairs in contact: on the penetration, m/N, or on its rate, m/(N s), see
    /// [`Equation::by_rates`].
    pub between: Matrix,
    /// On the penetration and on its rate at the end.
    pub depth_end: AtNodes,
    pub rate_end: AtNodes,
}

/// The motion of a pair without contact forces, m and m/s.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Free {
    pub depth: AtNodes,
    pub rate: AtNodes,
    pub end: (f64, f64),
}

/// What a window is solved with.
#[derive(Clone, Debug)]
pub(crate) struct WindowWorkspace {
    /// Pair by pair, see [`WindowWorkspace::response`], for a window of length `assembled`.
    responses: Vec<PairResponse>,
    pub assembled: f64,
    /// See [`Equation::error_rate`].
    error_rate: f64,
    pub free: [Free; MOST_PAIRS],
}

impl WindowWorkspace {
    /// For scenes with that many pairs.
    pub(crate) fn new(pairs: usize) -> WindowWorkspace {
        let (row, matrix) = ([0.0; NODES], [[0.0; NODES]; NODES]);
        let response = PairResponse { between: matrix, depth_end: row, rate_end: row };
        let free = Free { depth: row, rate: row, end: (0.0, 0.0) };
        let most = pairs.min(MOST_PAIRS);
        let responses = vec![response; most * (most + 1) / 2];
        WindowWorkspace { responses, assembled: 0.0, error_rate: 0.0, free: [free; MOST_PAIRS] }
    }

    /// Estimated error of the penetrations, m, by responses assembled for another length of the window, of which only
    /// the first power follows its change.
    pub(crate) fn error(&self, length: f64) -> f64 {
        self.error_rate * (length - self.assembled).abs()
    }

    /// Index of the response of two pairs: a triangular matrix row by row.
    fn index(p: usize, q: usize) -> usize {
        let (later, earlier) = (p.max(q), p.min(q));
        later * (later + 1) / 2 + earlier
    }

    /// The response of two pairs to each other.
    pub(crate) fn response(&self, p: usize, q: usize) -> &PairResponse {
        &self.responses[WindowWorkspace::index(p, q)]
    }
}

impl Equation {
    /// The factors of the tables over a window of that length, for penetrations and for rates: each power of a kernel,
    /// from the first on, times that power of the length.
    #[inline(always)]
    pub(crate) fn factors(&self, p: usize, q: usize, length: f64) -> ([f64; POWERS], [f64; POWERS]) {
        let mut reach = [0.0; POWERS];
        let kernel = &self.kernels[p][q][..self.powers.min(POWERS)];
        let mut power = length;
        for (reach, g) in reach.iter_mut().zip(&kernel[1..]) {
            *reach = g * power;
            power *= length;
        }
        let (mut depth, mut rate) = (reach, reach);
        for (k, (depth, rate)) in depth.iter_mut().zip(&mut rate).enumerate() {
            *depth *= length;
            *rate *= COUNT[k + 1];
        }
        (depth, rate)
    }

    /// How many of these factors for penetrations matter.
    #[inline(always)]
    pub(crate) fn count_over(&self, p: usize, depth: &[f64; POWERS], length: f64) -> usize {
        let negligible = self.remainder * self.kernels[p][p][1] * (length * length);
        let last = (2..self.powers.min(POWERS)).rev().find(|k| (COUNT[*k] * depth[*k - 1]).abs() > negligible);
        last.unwrap_or(1)
    }

    /// Whether penetrations are integrals of rates, which then come first: one matrix does for both. Where no force
    /// needs the rates penetrations come from forces at once.
    #[inline(always)]
    pub(crate) fn by_rates(&self) -> bool {
        self.forces[..self.closed].iter().any(Force::is_damped)
    }

    /// The responses over a window of that length.
    #[inline(always)]
    pub(crate) fn assemble<const N: usize>(&self, tables: &Tables, length: f64, work: &mut WindowWorkspace) {
        (work.assembled, work.error_rate) = (length, self.error_rate(length));
        let by_rates = self.by_rates();
        for p in 0..self.pairs {
            for q in 0..self.closed.min(p + 1) {
                let (depth, rate) = self.factors(p, q, length);
                let count = self.count_over(p, &depth, length);
                let response = &mut work.responses[WindowWorkspace::index(p, q)];
                response.depth_end = combined::<N>(&tables.whole[1..], &depth[..count]);
                response.rate_end = combined::<N>(&tables.whole, &rate[..count]);
                if p < self.closed {
                    let (factors, tables) =
                        if by_rates { (&rate, &tables.inner[..]) } else { (&depth, &tables.inner[1..]) };
                    combine::<N>(tables, &factors[..count], &mut response.between);
                }
            }
        }
    }

    /// The motion without contact forces over a window of that length: rates where they are asked for, and the end.
    #[inline(always)]
    pub(crate) fn fly<const N: usize>(&self, tables: &Tables, length: f64, work: &mut WindowWorkspace) {
        let x = length / self.scale;
        let mut at = NOTHING;
        for (at, theta) in at.iter_mut().zip(fours(&tables.theta)).take(N / 4) {
            *at = each(|i| theta[i] * x);
        }
        let by_rates = self.by_rates();
        for (free, terms) in work.free.iter_mut().zip(&self.free).take(self.pairs) {
            let terms = &terms[..self.terms.min(MAX_TERMS)];
            match by_rates {
                true => (free.depth, free.rate) = values::<N>(terms, &at, self.scale),
                false => free.depth = value::<N>(terms, &at),
            }
            let (d, v) = value_and_slope(terms, x);
            free.end = (d, v / self.scale);
        }
    }

    /// The free motion of all pairs over the longest window times the relative change of their responses with the
    /// length beyond the first power, m/s.
    #[inline(always)]
    fn error_rate(&self, length: f64) -> f64 {
        let of_pair = |p: usize| {
            let (free, kernel) = (&self.free[p], &self.kernels[p][p]);
            let later = (2..self.powers.min(POWERS)).rev();
            let later = later.fold(0.0, |sum, k| sum * length + COUNT[k - 1] * kernel[k].abs());
            (free[0].abs() + free[1].abs()) * later / kernel[1]
        };
        (0..self.closed).map(of_pair).sum()
    }
}
