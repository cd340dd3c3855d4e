//! What the contact forces of a window do to a quantity of the whole motion, by rows over the moments of the forces.

use crate::collocation::{
    AtNodes, MOST_PAIRS, NODES, NodeCount, POWERS, Tables, combined, fours, nodes, product, row, value,
};
use crate::engine::window::solution::{Moments, Window};
use crate::numerics::polynomial::{COUNT, each};

/// Of each force: its factor, and those of its moments, integrals over time s of (time left)^k times the force.
#[derive(Clone, Copy, Debug, Default)]
pub struct Share([f64; 1 + POWERS]);

impl Share {
    /// That of a kernel, which is 0 at once.
    pub fn of_kernel(kernel: &[f64; POWERS]) -> Share {
        let mut share = [0.0; 1 + POWERS];
        share[1..].copy_from_slice(kernel);
        Share(share)
    }

    /// That of the rate of a quantity that no force moves at once.
    pub fn rate(&self) -> Share {
        let mut rate = [0.0; 1 + POWERS];
        rate[0] = self.0[1];
        (1..POWERS).for_each(|k| rate[k] = COUNT[k] * self.0[k + 1]);
        Share(rate)
    }

    /// That of a sum.
    pub fn plus(mut self, other: &Share) -> Share {
        self.0.iter_mut().zip(&other.0).for_each(|(sum, other)| *sum += other);
        self
    }
}

impl Window {
    /// Writes the force of each closed pair and its moments until each of sixteen nodes, N s^k, row by row: through its values
    /// goes one polynomial, whatever their number.
    pub fn set_moments(&self, rows: &mut Vec<AtNodes>) {
        rows.clear();
        for force in &self.solution.force[..self.equation.closed] {
            set_moments(self, force, rows);
        }
    }

    /// The moments in such rows until a node.
    pub fn moments_at_node(&self, rows: &[AtNodes], node: usize) -> Moments {
        let mut all = [[0.0; POWERS]; MOST_PAIRS];
        for (moments, rows) in all.iter_mut().zip(rows.chunks(1 + self.equation.powers)) {
            moments.iter_mut().zip(&rows[1..]).for_each(|(moment, row)| *moment = row[node]);
        }
        all
    }

    /// A quantity at sixteen nodes, from its `terms` in powers of t / scale without contact forces and the share of each force.
    pub fn quantity_at_nodes(&self, terms: &[f64], shares: &[Share], rows: &[AtNodes]) -> AtNodes {
        quantity_at_nodes(self, terms, shares, rows)
    }
}

#[multiversion::multiversion(targets("x86_64+avx2"))]
fn set_moments(window: &Window, force: &AtNodes, rows: &mut Vec<AtNodes>) {
    let (solution, powers) = (&window.solution, window.equation.powers);
    let force = match solution.rule {
        NodeCount::Sixteen => *force,
        rule => nodes(rule).interpolant(force).at(&nodes(NodeCount::Sixteen).x),
    };
    rows.push(force);
    let mut power = solution.length;
    for inner in &Tables::of(solution.map, NodeCount::Sixteen).inner[..powers] {
        rows.push(row(&product::<NODES>(inner, &force).map(|four| each(|i| power * four[i]))));
        power *= solution.length;
    }
}

#[multiversion::multiversion(targets("x86_64+avx2"))]
fn quantity_at_nodes(window: &Window, terms: &[f64], shares: &[Share], rows: &[AtNodes]) -> AtNodes {
    let (solution, equation) = (&window.solution, &window.equation);
    let x = solution.length / equation.scale;
    let mut at = [[0.0; 4]; NODES / 4];
    for (at, theta) in at.iter_mut().zip(fours(&Tables::of(solution.map, NodeCount::Sixteen).theta)) {
        *at = each(|i| theta[i] * x);
    }
    let mut quantity = value::<NODES>(terms, &at);
    for (Share(share), rows) in shares.iter().zip(rows.chunks(1 + equation.powers)) {
        let taken = combined::<NODES>(rows, share);
        quantity.iter_mut().zip(&taken).for_each(|(quantity, taken)| *quantity -= taken);
    }
    quantity
}
