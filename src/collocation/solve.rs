//! The forces at the nodes of a window, by iteration: each sweep makes penetrations of forces and forces of
//! penetrations.
//!
//! A sweep is an integral over time twice, so errors fall like the terms of the series of a cosine: faster and faster.
//! Where a window ends with an event, its length is an unknown too and is corrected in between.

use super::equation::{Equation, MOST_PAIRS, WindowWorkspace};
use super::nodes::{AtNodes, NODES, NodeCount, dot, nodes};
use super::rows::{NOTHING, add_product, combine, forces, fours, fours_mut, product, row, second_derivative};
use super::tables::{Map, Tables};
use crate::numerics::polynomial::{each, larger};

/// Sweeps after which a window is given up: it is too long for this, or its damping too stiff.
const MOST_SWEEPS: usize = 24;

/// What a window ends with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ending {
    /// Its length is given.
    Given,
    /// Penetration of a pair is back at 0.
    Release(usize),
    /// A pair does not approach any more.
    Turn(usize),
    /// A watched pair comes into contact.
    Touch(usize),
}

impl Ending {
    /// The pair whose event it is.
    fn pair(self) -> Option<usize> {
        match self {
            Ending::Given => None,
            Ending::Release(p) | Ending::Turn(p) | Ending::Touch(p) => Some(p),
        }
    }
}

/// The map, nodes, length and end that a window is to have.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    pub map: Map,
    pub rule: NodeCount,
    /// s; roughly where it ends with an event.
    pub length: f64,
    pub ending: Ending,
}

/// A solved window.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SolvedWindow {
    /// Of the time.
    pub map: Map,
    /// Its nodes.
    pub rule: NodeCount,
    /// s.
    pub length: f64,
    /// m, at the nodes.
    pub depth: [AtNodes; MOST_PAIRS],
    /// m/s; of pairs whose force is damped.
    pub rate: [AtNodes; MOST_PAIRS],
    /// N.
    pub force: [AtNodes; MOST_PAIRS],
    /// Penetration, m, and rate, m/s, at the end.
    pub end: [(f64, f64); MOST_PAIRS],
}

impl SolvedWindow {
    /// Solves an equation over a window until penetrations are right within `tolerance`, m; whether a solution has been
    /// found. It begins with the one that it holds, if that `is_known` and of a longer window.
    pub(crate) fn solve(
        &mut self,
        equation: &Equation,
        work: &mut WindowWorkspace,
        (frame, is_known): (Frame, bool),
        tolerance: f64,
    ) -> bool {
        let is_known = is_known && frame.length <= self.length && self.map == self.map.without_end();
        iterate_by_rule(self, equation, work, (frame, is_known), tolerance)
    }

    /// Makes room for a window, whose rows are 0 beyond the nodes of its rule.
    fn frame(&mut self, pairs: usize, frame: Frame) {
        (self.map, self.rule, self.length) = (frame.map, frame.rule, frame.length);
        let rows = self.depth[..pairs].iter_mut().chain(&mut self.rate[..pairs]).chain(&mut self.force[..pairs]);
        rows.for_each(|row| row[frame.rule.count()..].fill(0.0));
    }

    /// Takes the solution over a longer window to the nodes of another one.
    #[inline(always)]
    fn shorten<const N: usize>(&mut self, equation: &Equation, tables: &Tables, frame: Frame) {
        let (share, nodes) = (frame.length / self.length, nodes(self.rule));
        let x: [f64; N] = std::array::from_fn(|i| self.map.inverse(share * tables.theta[i]));
        for p in 0..equation.closed {
            let law = equation.forces[p];
            let depth = nodes.interpolant(&self.depth[p]).at(&x);
            self.depth[p][..N].copy_from_slice(&depth);
            if law.is_damped() {
                let rate = nodes.interpolant(&self.rate[p]).at(&x);
                self.rate[p][..N].copy_from_slice(&rate);
            }
            forces::<N>(&law, &self.depth[p], &self.rate[p], &mut self.force[p]);
        }
    }

    /// Takes the solution to another length of the window: the same motion at the times of the new nodes.
    #[inline(always)]
    fn stretch<const N: usize>(&mut self, equation: &Equation, tables: &Tables, length: f64) {
        let nodes = nodes(self.rule);
        let share = (length - self.length) / self.length;
        for p in 0..equation.closed {
            let law = equation.forces[p];
            let rows = if law.is_damped() {
                &mut [&mut self.depth[p], &mut self.rate[p]][..]
            } else {
                &mut [&mut self.depth[p]]
            };
            for row in rows {
                let slope = product::<N>(&nodes.derivative, row);
                let rows = fours_mut(row).iter_mut().zip(fours(&tables.lag)).zip(&slope).take(N / 4);
                rows.for_each(|((row, lag), slope)| *row = each(|i| row[i] + share * lag[i] * slope[i]));
            }
            forces::<N>(&law, &self.depth[p], &self.rate[p], &mut self.force[p]);
        }
        self.length = length;
    }

    /// By how much the window is too long, s, and the speed by which that becomes an error of a penetration, m/s.
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

    /// First guess: the forces of an oscillation at the angular frequency of the contact that begins with the right
    /// penetration, rate and acceleration.
    #[inline(always)]
    fn guess<const N: usize>(&mut self, equation: &Equation, tables: &Tables) {
        let theta = &tables.theta;
        for p in 0..equation.closed {
            let (free, omega, law) = (&equation.free[p], equation.omega[p], equation.forces[p]);
            let (d, v, scale) = (free[0], free[1] / equation.scale, equation.scale);
            let acceleration = 2.0 * free[2] / (scale * scale) - equation.kernels[p][p][1] * law.value(d, v);
            let (length, omega2) = (self.length, omega * omega);
            let (depth, rate) = (fours_mut(&mut self.depth[p]), fours_mut(&mut self.rate[p]));
            for ((depth, rate), theta) in depth.iter_mut().zip(rate).zip(fours(theta)).take(N / 4) {
                let t = each(|i| theta[i] * length);
                let s = each(|i| omega2 * (t[i] * t[i]));
                let sine = each(|i| t[i] * (1.0 - s[i] * ((1.0 / 6.0) - s[i] * (1.0 / 120.0))));
                let turned = each(|i| t[i] * t[i] * (0.5 - s[i] * (1.0 / 24.0)));
                *depth = each(|i| d + v * sine[i] + acceleration * turned[i]);
                *rate = each(|i| v * (1.0 - omega2 * turned[i]) + acceleration * sine[i]);
            }
            forces::<N>(&law, &self.depth[p], &self.rate[p], &mut self.force[p]);
        }
    }

    /// Penetrations from forces, pair by pair, and forces from these; the largest change of a penetration, m.
    #[inline(always)]
    fn sweep<const N: usize>(&mut self, equation: &Equation, tables: &Tables, work: &WindowWorkspace) -> f64 {
        // The length may have changed since the responses were assembled: they go as its square and as itself.
        let ratio = self.length / work.assembled;
        let mut changes = [0.0; 4];
        for p in 0..equation.closed {
            let (free, law) = (&work.free[p], equation.forces[p]);
            let mut taken = product::<N>(&work.response(p, 0).between, &self.force[0]);
            for (q, force) in self.force.iter().enumerate().take(equation.closed).skip(1) {
                taken = add_product::<N>(&taken, &work.response(p, q).between, force);
            }
            let scale = match equation.by_rates() {
                true => {
                    let rates = fours_mut(&mut self.rate[p]).iter_mut().zip(fours(&free.rate));
                    for ((rate, free), taken) in rates.zip(&taken).take(N / 4) {
                        *rate = each(|i| free[i] - ratio * taken[i]);
                    }
                    taken = product::<N>(&tables.inner[0], &row(&taken));
                    ratio * self.length
                }
                false => ratio * ratio,
            };
            let depths = fours_mut(&mut self.depth[p]).iter_mut().zip(fours(&free.depth));
            for ((known, free), taken) in depths.zip(&taken).take(N / 4) {
                let new = each(|i| free[i] - scale * taken[i]);
                changes = each(|i| larger(changes[i], (new[i] - known[i]).abs()));
                *known = new;
            }
            forces::<N>(&law, &self.depth[p], &self.rate[p], &mut self.force[p]);
        }
        changes.into_iter().fold(0.0, larger)
    }

    /// Penetrations and rates at the end, of all pairs or of one.
    #[inline(always)]
    fn close(&mut self, equation: &Equation, work: &WindowWorkspace, only: Option<usize>) {
        let ratio = self.length / work.assembled;
        for p in only.map_or(0..equation.pairs, |p| p..p + 1) {
            let (mut d, mut v) = (0.0, 0.0);
            for (q, force) in self.force.iter().enumerate().take(equation.closed) {
                let response = work.response(p, q);
                d += dot(&response.depth_end, force);
                v += dot(&response.rate_end, force);
            }
            let free = work.free[p].end;
            self.end[p] = (free.0 - ratio * ratio * d, free.1 - ratio * v);
        }
    }

    /// Penetrations of the watched pairs at the nodes.
    #[inline(always)]
    fn watch<const N: usize>(&mut self, equation: &Equation, tables: &Tables, work: &WindowWorkspace) {
        for p in equation.closed..equation.pairs {
            let mut taken = NOTHING;
            for q in 0..equation.closed {
                let (factors, _) = equation.factors(p, q, self.length);
                let mut response = [[0.0; NODES]; NODES];
                let count = equation.count_over(p, &factors, self.length);
                combine::<N>(&tables.inner[1..], &factors[..count], &mut response);
                taken = add_product::<N>(&taken, &response, &self.force[q]);
            }
            let depths = fours_mut(&mut self.depth[p]).iter_mut().zip(fours(&work.free[p].depth)).zip(&taken);
            depths.take(N / 4).for_each(|((depth, free), taken)| *depth = each(|i| free[i] - taken[i]));
        }
    }

    /// Estimated error of the velocities, m/s: from the last terms of the Legendre series of the forces.
    pub(crate) fn velocity_error(&self, equation: &Equation) -> f64 {
        let nodes = nodes(self.rule);
        let of_pair = |p: usize| {
            let last = (nodes.count - 3..nodes.count).map(|n| nodes.coefficient(&self.force[p], n).abs());
            let last = last.fold(0.0, f64::max);
            last * self.length * equation.kernels[p][p][1]
        };
        (0..equation.closed).map(of_pair).fold(0.0, f64::max)
    }
}

/// See [`SolvedWindow::solve`].
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn iterate_by_rule(
    solution: &mut SolvedWindow,
    equation: &Equation,
    work: &mut WindowWorkspace,
    (frame, is_known): (Frame, bool),
    tolerance: f64,
) -> bool {
    let from = (frame, is_known);
    match frame.rule {
        NodeCount::Eight => iterate::<{ NodeCount::Eight.count() }>(solution, equation, work, from, tolerance),
        NodeCount::Twelve => iterate::<{ NodeCount::Twelve.count() }>(solution, equation, work, from, tolerance),
        NodeCount::Sixteen => iterate::<{ NodeCount::Sixteen.count() }>(solution, equation, work, from, tolerance),
    }
}

/// With N nodes.
#[inline(always)]
fn iterate<const N: usize>(
    solution: &mut SolvedWindow,
    equation: &Equation,
    work: &mut WindowWorkspace,
    (frame, is_known): (Frame, bool),
    tolerance: f64,
) -> bool {
    let (tables, ending) = (Tables::of(frame.map, frame.rule), frame.ending);
    if is_known {
        solution.shorten::<N>(equation, tables, frame);
    }
    solution.frame(equation.pairs, frame);
    if !is_known {
        solution.guess::<N>(equation, tables);
    }
    equation.assemble::<N>(tables, solution.length, work);
    equation.fly::<N>(tables, solution.length, work);
    let mut last_change = f64::INFINITY;
    for _ in 0..MOST_SWEEPS {
        let change = solution.sweep::<N>(equation, tables, work);
        // Convergence gets faster: the next change is smaller than this one by at least the last ratio.
        let left = if last_change.is_finite() { change * (change / last_change).min(1.0) } else { change };
        last_change = change;
        let mut missed = 0.0;
        if ending != Ending::Given {
            solution.close(equation, work, ending.pair());
            let (late, speed) = solution.lateness(equation, ending);
            missed = late.abs() * speed;
            if missed > tolerance && left <= (0.1 * missed).max(tolerance) {
                let length = (solution.length - late).clamp(0.6 * solution.length, 1.5 * solution.length);
                if length.is_nan() || length > equation.scale {
                    return false;
                }
                solution.stretch::<N>(equation, tables, length);
                equation.fly::<N>(tables, length, work);
            }
        }
        let is_found = left.max(missed) <= tolerance;
        let negligible = if is_found { tolerance } else { 0.1 * change.max(tolerance) };
        if work.error(solution.length) > negligible {
            equation.assemble::<N>(tables, solution.length, work);
        } else if is_found {
            solution.close(equation, work, None);
            solution.watch::<N>(equation, tables, work);
            return solution.end[..equation.pairs].iter().all(|(d, v)| (d + v).is_finite());
        }
    }
    false
}
