//! The integral equation of a window: what is known of it, and its matrices for a length.

use super::nodes::{Matrix, NODES, Row};
use super::rows::{combine, combined, values};
use super::tables::{POWERS, Tables};
use crate::contact::Force;
use crate::polynomial::{COUNT, Coefficients, ROOM};

/// Pairs that a window is solved for at once: those in contact, and those that may come into contact.
pub const MOST_PAIRS: usize = 4;

/// What is known before a window is solved.
#[derive(Clone, Debug)]
pub struct Equation {
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
    /// Powers of these that matter over the longest window.
    pub powers: usize,
    /// How far a kernel may be off, relative to G_pp.
    pub remainder: f64,
    /// 1/s, what a first guess takes for the speed of each contact.
    pub omega: [f64; MOST_PAIRS],
}

impl Default for Equation {
    fn default() -> Equation {
        Equation {
            pairs: 0,
            closed: 0,
            forces: [Force::None; MOST_PAIRS],
            free: [[0.0; ROOM]; MOST_PAIRS],
            terms: 2,
            scale: 1.0,
            kernels: [[[0.0; POWERS]; MOST_PAIRS]; MOST_PAIRS],
            powers: 2,
            remainder: 0.0,
            omega: [0.0; MOST_PAIRS],
        }
    }
}

/// What the force of one pair does to the penetration of another.
#[derive(Clone, Copy, Debug)]
pub struct Response {
    /// m/N, from node to node.
    pub depth: Matrix,
    /// m/(N s), on the rate; only where a force is damped.
    pub rate: Matrix,
    /// The same at the end.
    pub depth_end: Row,
    pub rate_end: Row,
}

/// The motion of a pair without contact forces, m and m/s.
#[derive(Clone, Copy, Debug)]
pub struct Free {
    pub depth: Row,
    pub rate: Row,
    pub end: (f64, f64),
}

/// Room to solve in.
#[derive(Clone, Debug)]
pub struct Room {
    /// Pair by pair, for a window of length `assembled`.
    pub responses: Vec<Response>,
    pub assembled: f64,
    pub free: [Free; MOST_PAIRS],
}

impl Room {
    /// For scenes with that many pairs.
    pub fn new(pairs: usize) -> Room {
        let (row, matrix) = ([0.0; NODES], [[0.0; NODES]; NODES]);
        let response = Response { depth: matrix, rate: matrix, depth_end: row, rate_end: row };
        let free = Free { depth: row, rate: row, end: (0.0, 0.0) };
        let most = pairs.min(MOST_PAIRS);
        Room { responses: vec![response; most * most], assembled: 0.0, free: [free; MOST_PAIRS] }
    }
}

impl Equation {
    /// What the powers of a kernel come to over a window of that length, for penetrations and for rates.
    #[inline(always)]
    pub fn factors(&self, p: usize, q: usize, length: f64) -> ([f64; POWERS], [f64; POWERS]) {
        let kernel = &self.kernels[p][q];
        let (mut depth, mut rate) = ([0.0; POWERS], [0.0; POWERS]);
        let mut power = length;
        for k in 1..self.powers.min(POWERS) {
            rate[k - 1] = kernel[k] * (k as f64 * power);
            power *= length;
            depth[k] = kernel[k] * power;
        }
        (depth, rate)
    }

    /// How many of these factors for penetrations matter.
    #[inline(always)]
    pub fn powers_over(&self, p: usize, depth: &[f64; POWERS], length: f64) -> usize {
        let negligible = self.remainder * self.kernels[p][p][1] * (length * length);
        let last = (2..self.powers.min(POWERS)).rev().find(|k| (COUNT[*k] * depth[*k]).abs() > negligible);
        last.unwrap_or(1) + 1
    }

    /// The responses over a window of that length.
    #[inline(always)]
    pub fn assemble<const N: usize>(&self, tables: &Tables, length: f64, room: &mut Room) {
        room.assembled = length;
        for p in 0..self.pairs {
            for q in 0..self.closed {
                let (depth, rate) = self.factors(p, q, length);
                let powers = self.powers_over(p, &depth, length);
                let response = &mut room.responses[p * self.closed + q];
                let (depth, rate) = (&depth[1..powers], &rate[..powers - 1]);
                if p < self.closed {
                    combine::<N>(&tables.inner[1..], depth, &mut response.depth);
                    if self.forces[p].is_damped() {
                        combine::<N>(&tables.inner, rate, &mut response.rate);
                    }
                }
                response.depth_end = combined::<N>(&tables.whole[1..], depth);
                response.rate_end = combined::<N>(&tables.whole, rate);
            }
        }
    }

    /// The motion without contact forces over a window of that length.
    #[inline(always)]
    pub fn fly<const N: usize>(&self, tables: &Tables, length: f64, room: &mut Room) {
        let x = length / self.scale;
        let at: [f64; N] = std::array::from_fn(|i| tables.theta[i] * x);
        for p in 0..self.pairs {
            let terms = &self.free[p][..self.terms.min(ROOM)];
            let free = &mut room.free[p];
            let (depth, rate) = values(terms, &at, self.scale);
            free.depth[..N].copy_from_slice(&depth);
            free.rate[..N].copy_from_slice(&rate);
            let ([d], [v]) = values(terms, &[x], self.scale);
            free.end = (d, v);
        }
    }

    /// m, roughly: responses that were made for another length of the window follow its change in their first power only.
    pub fn error_of_responses(&self, length: f64, room: &Room) -> f64 {
        let of_pair = |p: usize| {
            let kernel = &self.kernels[p][p];
            let (mut power, mut sum) = (1.0, 0.0);
            for (k, g) in kernel.iter().enumerate().take(self.powers).skip(2) {
                sum += (k - 1) as f64 * g.abs() * power;
                power *= length;
            }
            sum / kernel[1] * (self.free[p][0].abs() + self.free[p][1].abs())
        };
        (length - room.assembled).abs() * (0..self.closed).map(of_pair).sum::<f64>()
    }
}
