//! The forces at the nodes of a window, by iteration: each sweep makes penetrations of forces and forces of penetrations.
//!
//! A sweep is an integral over time twice, so errors fall like the terms of the series of a cosine: faster and faster.
//! Where a window ends with an event, its length is an unknown too and is corrected in between.

use super::nodes::{Matrix, NODES, Row, coefficient, dot, nodes};
use super::tables::{Map, POWERS, Tables};
use crate::contact::Force;
use crate::polynomial::{COUNT, Coefficients, ROOM};

/// Pairs that a window is solved for at once: those in contact, and those that may come into contact.
pub const MOST_PAIRS: usize = 4;

/// Sweeps after which a window is given up: it is too long for this, or its damping too stiff.
const MOST_SWEEPS: usize = 24;

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

/// What a window ends with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// Its length is given.
    Given,
    /// Penetration of a pair is back at 0.
    Release(usize),
    /// A pair does not approach any more.
    Turn(usize),
    /// A watched pair comes into contact.
    Touch(usize),
}

/// A solved window.
#[derive(Clone, Copy, Debug, Default)]
pub struct Solution {
    /// Of the time.
    pub map: Map,
    /// s.
    pub length: f64,
    /// m, at the nodes.
    pub depth: [Row; MOST_PAIRS],
    /// m/s; of pairs whose force is damped.
    pub rate: [Row; MOST_PAIRS],
    /// N.
    pub force: [Row; MOST_PAIRS],
    /// Penetration, m, and rate, m/s, at the end.
    pub end: [(f64, f64); MOST_PAIRS],
}

/// What the force of one pair does to the penetration of another.
#[derive(Clone, Copy, Debug)]
struct Response {
    /// m/N, from node to node.
    depth: Matrix,
    /// m/(N s), on the rate; only where a force is damped.
    rate: Matrix,
    /// The same at the end.
    depth_end: Row,
    rate_end: Row,
}

/// The motion of a pair without contact forces, m and m/s.
#[derive(Clone, Copy, Debug)]
struct Free {
    depth: Row,
    rate: Row,
    end: (f64, f64),
}

/// Room to solve in.
#[derive(Clone, Debug)]
pub struct Room {
    /// Pair by pair, for a window of length `assembled`.
    responses: Vec<Response>,
    assembled: f64,
    free: [Free; MOST_PAIRS],
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

impl Solution {
    /// Solves an equation over a window of about `length`, s, until penetrations are right within `tolerance`, m; whether
    /// a solution has been found.
    pub fn solve(
        &mut self,
        equation: &Equation,
        room: &mut Room,
        (map, length, ending): (Map, f64, Ending),
        tolerance: f64,
    ) -> bool {
        self.map = map;
        self.length = length;
        iterate(self, equation, room, ending, tolerance)
    }

    /// Takes the solution to another length of the window: the same motion at the times of the new nodes.
    #[inline(always)]
    fn stretch(&mut self, equation: &Equation, tables: &Tables, length: f64) {
        let nodes = nodes();
        let share = (length - self.length) / self.length;
        for p in 0..equation.closed {
            let law = equation.forces[p];
            let rows = if law.is_damped() {
                &mut [&mut self.depth[p], &mut self.rate[p]][..]
            } else {
                &mut [&mut self.depth[p]]
            };
            for row in rows {
                let mut slope = [0.0; NODES];
                add_product(&mut slope, &nodes.derivative, row);
                for i in 0..NODES {
                    row[i] += share * tables.lag[i] * slope[i];
                }
            }
            forces(&law, &self.depth[p], &self.rate[p], &mut self.force[p]);
        }
        self.length = length;
    }

    /// s, by how much the window is too long, and m/s, what that is weighed with.
    fn lateness(&self, equation: &Equation, ending: Ending) -> (f64, f64) {
        match ending {
            Ending::Given => (0.0, 0.0),
            Ending::Release(p) | Ending::Touch(p) => (self.end[p].0 / self.end[p].1, self.end[p].1.abs()),
            Ending::Turn(p) => {
                let (d, v) = self.end[p];
                let x = self.length / equation.scale;
                let free =
                    second_derivative(&equation.free[p][..equation.terms], x) / (equation.scale * equation.scale);
                let acceleration = free - equation.kernels[p][p][1] * equation.forces[p].value(d, v);
                (v / acceleration, d * equation.omega[p])
            }
        }
    }

    /// Forces of an oscillation as quick as the contact.
    #[inline(always)]
    fn guess(&mut self, equation: &Equation, tables: &Tables) {
        let theta = &tables.theta;
        for p in 0..equation.closed {
            let (d, v, omega) = (equation.free[p][0], equation.free[p][1] / equation.scale, equation.omega[p]);
            for (i, theta) in theta.iter().enumerate() {
                let t = theta * self.length;
                let s = (omega * t) * (omega * t);
                let cosine = 1.0 - s * (0.5 - s * (1.0 / 24.0));
                let sine = t * (1.0 - s * ((1.0 / 6.0) - s * (1.0 / 120.0)));
                self.depth[p][i] = d * cosine + v * sine;
                self.rate[p][i] = v * cosine - d * (omega * omega) * sine;
            }
            forces(&equation.forces[p], &self.depth[p], &self.rate[p], &mut self.force[p]);
        }
    }

    /// Penetrations from forces, pair by pair, and forces from these; the largest change of a penetration, m.
    #[inline(always)]
    fn sweep(&mut self, equation: &Equation, room: &Room) -> f64 {
        // A little longer or shorter than when the responses were made: they go as t^2 and t.
        let ratio = self.length / room.assembled;
        let mut change = 0.0_f64;
        for p in 0..equation.closed {
            let law = equation.forces[p];
            let responses = &room.responses[p * equation.closed..][..equation.closed];
            let mut depth = [0.0; NODES];
            for (response, force) in responses.iter().zip(&self.force) {
                add_product(&mut depth, &response.depth, force);
            }
            let (known, square) = (&mut self.depth[p], ratio * ratio);
            let mut changes = [0.0; 4];
            for i in 0..NODES {
                let new = room.free[p].depth[i] - square * depth[i];
                changes[i % 4] = larger((new - known[i]).abs(), changes[i % 4]);
                known[i] = new;
            }
            change = changes.into_iter().fold(change, larger);
            if law.is_damped() {
                let mut rate = [0.0; NODES];
                for (response, force) in responses.iter().zip(&self.force) {
                    add_product(&mut rate, &response.rate, force);
                }
                for (i, slowed) in rate.iter().enumerate() {
                    self.rate[p][i] = room.free[p].rate[i] - ratio * slowed;
                }
            }
            forces(&law, &self.depth[p], &self.rate[p], &mut self.force[p]);
        }
        change
    }

    /// Penetrations and rates at the end.
    #[inline(always)]
    fn close(&mut self, equation: &Equation, room: &Room) {
        let ratio = self.length / room.assembled;
        for p in 0..equation.pairs {
            let responses = &room.responses[p * equation.closed..][..equation.closed];
            let (mut d, mut v) = (0.0, 0.0);
            for (response, force) in responses.iter().zip(&self.force) {
                d += dot(&response.depth_end, force);
                v += dot(&response.rate_end, force);
            }
            let free = room.free[p].end;
            self.end[p] = (free.0 - ratio * ratio * d, free.1 - ratio * v);
        }
    }

    /// Penetrations of the watched pairs at the nodes.
    #[inline(always)]
    fn watch(&mut self, equation: &Equation, tables: &Tables, room: &Room) {
        for p in equation.closed..equation.pairs {
            let mut taken = [0.0; NODES];
            for q in 0..equation.closed {
                let (factors, _) = equation.factors(p, q, self.length);
                let mut response = [[0.0; NODES]; NODES];
                let powers = equation.powers_over(p, &factors, self.length);
                combine(&tables.inner[1..], &factors[1..powers], &mut response);
                add_product(&mut taken, &response, &self.force[q]);
            }
            for (i, taken) in taken.iter().enumerate() {
                self.depth[p][i] = room.free[p].depth[i] - taken;
            }
        }
    }

    /// m/s, what the forces between the nodes may leave open: from the last terms of their Legendre series.
    pub fn velocity_error(&self, equation: &Equation) -> f64 {
        let of_pair = |p: usize| {
            let last = (NODES - 3..NODES).map(|n| coefficient(&self.force[p], n).abs()).fold(0.0, f64::max);
            last * self.length * equation.kernels[p][p][1]
        };
        (0..equation.closed).map(of_pair).fold(0.0, f64::max)
    }
}

/// See [`Solution::solve`]. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn iterate(solution: &mut Solution, equation: &Equation, room: &mut Room, ending: Ending, tolerance: f64) -> bool {
    let tables = Tables::of(solution.map);
    solution.guess(equation, tables);
    equation.assemble(tables, solution.length, room);
    equation.fly(tables, solution.length, room);
    let mut last_change = f64::INFINITY;
    for sweep in 1..=MOST_SWEEPS {
        let change = solution.sweep(equation, room);
        // Each sweep takes off more than the one before.
        let left = if last_change.is_finite() { change * (change / last_change).min(1.0) } else { change };
        last_change = change;
        if sweep < 3 && left > tolerance {
            continue;
        }
        let mut missed = 0.0;
        if ending != Ending::Given {
            solution.close(equation, room);
            let (late, speed) = solution.lateness(equation, ending);
            missed = late.abs() * speed;
            if missed > tolerance && left <= (0.1 * missed).max(tolerance) {
                let length = (solution.length - late).clamp(0.6 * solution.length, 1.5 * solution.length);
                if length.is_nan() || length > equation.scale {
                    return false;
                }
                solution.stretch(equation, tables, length);
                equation.fly(tables, length, room);
            }
        }
        let is_found = left.max(missed) <= tolerance;
        let negligible = if is_found { tolerance } else { 0.1 * change.max(tolerance) };
        if equation.error_of_responses(solution.length, room) > negligible {
            equation.assemble(tables, solution.length, room);
        } else if is_found {
            solution.close(equation, room);
            solution.watch(equation, tables, room);
            return solution.end[..equation.pairs].iter().all(|(d, v)| (d + v).is_finite());
        }
    }
    false
}

impl Equation {
    /// What the powers of a kernel come to over a window of that length, for penetrations and for rates.
    #[inline(always)]
    fn factors(&self, p: usize, q: usize, length: f64) -> ([f64; POWERS], [f64; POWERS]) {
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
    fn powers_over(&self, p: usize, depth: &[f64; POWERS], length: f64) -> usize {
        let negligible = self.remainder * self.kernels[p][p][1] * (length * length);
        let last = (2..self.powers.min(POWERS)).rev().find(|k| (COUNT[*k] * depth[*k]).abs() > negligible);
        last.unwrap_or(1) + 1
    }

    /// The responses over a window of that length.
    #[inline(always)]
    fn assemble(&self, tables: &Tables, length: f64, room: &mut Room) {
        room.assembled = length;
        for p in 0..self.pairs {
            for q in 0..self.closed {
                let (depth, rate) = self.factors(p, q, length);
                let powers = self.powers_over(p, &depth, length);
                let response = &mut room.responses[p * self.closed + q];
                let (depth, rate) = (&depth[1..powers], &rate[..powers - 1]);
                if p < self.closed {
                    combine(&tables.inner[1..], depth, &mut response.depth);
                    if self.forces[p].is_damped() {
                        combine(&tables.inner, rate, &mut response.rate);
                    }
                }
                response.depth_end = combined(&tables.whole[1..], depth);
                response.rate_end = combined(&tables.whole, rate);
            }
        }
    }

    /// The motion without contact forces over a window of that length.
    #[inline(always)]
    fn fly(&self, tables: &Tables, length: f64, room: &mut Room) {
        let x = length / self.scale;
        let at = tables.theta.map(|theta| theta * x);
        for p in 0..self.pairs {
            let terms = &self.free[p][..self.terms.min(ROOM)];
            let free = &mut room.free[p];
            (free.depth, free.rate) = values(terms, &at, self.scale);
            let ([d], [v]) = values(terms, &[x], self.scale);
            free.end = (d, v);
        }
    }

    /// m, roughly: responses that were made for another length of the window follow its change in their first power only.
    fn error_of_responses(&self, length: f64, room: &Room) -> f64 {
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

/// The sum of tables times factors.
#[inline(always)]
fn combine(tables: &[Matrix], factors: &[f64], out: &mut Matrix) {
    for (j, out) in out.iter_mut().enumerate() {
        let mut sum = [0.0; NODES];
        for (table, factor) in tables.iter().zip(factors) {
            let column = &table[j];
            for i in 0..NODES {
                sum[i] += column[i] * factor;
            }
        }
        *out = sum;
    }
}

#[inline(always)]
fn combined(rows: &[Row], factors: &[f64]) -> Row {
    let mut sum = [0.0; NODES];
    for (row, factor) in rows.iter().zip(factors) {
        for i in 0..NODES {
            sum[i] += row[i] * factor;
        }
    }
    sum
}

/// Adds a matrix times values.
#[inline(always)]
fn add_product(to: &mut Row, matrix: &Matrix, values: &Row) {
    let mut sum = *to;
    for j in 0..NODES {
        let (column, value) = (&matrix[j], values[j]);
        for i in 0..NODES {
            sum[i] += column[i] * value;
        }
    }
    *to = sum;
}

/// The larger of two numbers, in one instruction; the second where they are none.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Forces of penetrations and rates; none where floors are apart.
#[inline(always)]
fn forces(force: &Force, depth: &Row, rate: &Row, out: &mut Row) {
    match *force {
        Force::Power { stiffness, exponent: 1.5, damping: 0.0 } => {
            for i in 0..NODES {
                let d = larger(depth[i], 0.0);
                out[i] = stiffness * (d * d.sqrt());
            }
        }
        Force::Power { stiffness, exponent: 1.5, damping } => {
            for i in 0..NODES {
                let d = larger(depth[i], 0.0);
                out[i] = stiffness * (d * d.sqrt()) * (1.0 + damping * rate[i]);
            }
        }
        Force::Root { stiffness, damping } => {
            for i in 0..NODES {
                let d = larger(depth[i], 0.0);
                let root = d.sqrt();
                out[i] = stiffness * (d * root) + damping * root.sqrt() * rate[i];
            }
        }
        _ => {
            for i in 0..NODES {
                out[i] = force.value(larger(depth[i], 0.0), rate[i]);
            }
        }
    }
}

/// Values and derivatives by t of a polynomial in x = t / scale.
#[inline(always)]
fn values<const N: usize>(terms: &[f64], x: &[f64; N], scale: f64) -> ([f64; N], [f64; N]) {
    let (mut value, mut slope) = ([0.0; N], [0.0; N]);
    for term in terms.iter().rev() {
        for i in 0..N {
            slope[i] = slope[i] * x[i] + value[i];
            value[i] = value[i] * x[i] + term;
        }
    }
    let rate = 1.0 / scale;
    (value, slope.map(|slope| slope * rate))
}

fn second_derivative(terms: &[f64], x: f64) -> f64 {
    terms.iter().enumerate().skip(2).rev().fold(0.0, |sum, (n, c)| sum * x + (n * (n - 1)) as f64 * c)
}
