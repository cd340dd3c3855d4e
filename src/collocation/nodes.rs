//! The nodes of a window and polynomials through them.

use crate::numerics::roots::Knot;
use std::sync::OnceLock;

/// Most nodes of a window.
pub(crate) const NODES: usize = 16;

/// A number at each node; 0 beyond those of the rule.
pub(crate) type AtNodes = [f64; NODES];

/// A number for each two nodes, column by column: entry `[j][i]` is what node j adds at node i.
pub(super) type Matrix = [AtNodes; NODES];

/// How many nodes a window has: sixteen for long ones, fewer for those that samples of the record or events cut short.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum NodeCount {
    Eight,
    Twelve,
    #[default]
    Sixteen,
}

impl NodeCount {
    pub(crate) const ALL: [NodeCount; 3] = [NodeCount::Eight, NodeCount::Twelve, NodeCount::Sixteen];

    /// Number of nodes.
    pub(crate) const fn count(self) -> usize {
        match self {
            NodeCount::Eight => 8,
            NodeCount::Twelve => 12,
            NodeCount::Sixteen => NODES,
        }
    }

    /// With more nodes, if there is one.
    pub(crate) fn next(self) -> Option<NodeCount> {
        NodeCount::ALL.get(self as usize + 1).copied()
    }
}

/// Nodes and weights of a Gauss rule on 0..=1, from Newton's method on the Legendre polynomials.
pub(super) fn rule(count: usize) -> Vec<(f64, f64)> {
    let node = |i: usize| {
        let mut x = -libm::cos(std::f64::consts::PI * (i as f64 + 0.75) / (count as f64 + 0.5));
        let mut slope = 1.0;
        for _ in 0..8 {
            let (value, before) = legendre(count, x);
            slope = count as f64 * (x * value - before) / (x * x - 1.0);
            let better = x - value / slope;
            if better == x {
                break;
            }
            x = better;
        }
        (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..count).map(node).collect()
}

/// P_n and P_(n-1) at x in -1..=1.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut last, mut before) = (1.0, 0.0);
    for k in 0..n {
        let k = k as f64;
        (last, before) = (((2.0 * k + 1.0) * x * last - k * before) / (k + 1.0), last);
    }
    (last, before)
}

/// The nodes of a rule, and what leads from values at them to polynomials.
pub(crate) struct Nodes {
    pub count: usize,
    /// x of each node in 0..=1.
    pub x: AtNodes,
    /// Its weight.
    pub weight: AtNodes,
    /// Row n: the factors of the values in the coefficient of the Legendre polynomial P_n(2 x - 1).
    pub legendre: [AtNodes; NODES],
    /// The same, column by column.
    to_legendre: Matrix,
    /// Derivatives by x at the nodes of the polynomial through values at them.
    pub derivative: Matrix,
}

/// Sum of products in a fixed order.
#[inline(always)]
pub(crate) fn dot(a: &AtNodes, b: &AtNodes) -> f64 {
    let mut sum = [0.0; 4];
    for (a, b) in a.as_chunks::<4>().0.iter().zip(b.as_chunks::<4>().0) {
        for i in 0..4 {
            sum[i] += a[i] * b[i];
        }
    }
    (sum[0] + sum[2]) + (sum[1] + sum[3])
}

/// Those of a rule, computed once.
pub(crate) fn nodes(rule: NodeCount) -> &'static Nodes {
    static OF_RULES: [OnceLock<Nodes>; 3] = [const { OnceLock::new() }; 3];
    OF_RULES[rule as usize].get_or_init(|| Nodes::compute(rule.count()))
}

impl Nodes {
    fn compute(count: usize) -> Nodes {
        let mut all = Nodes {
            count,
            x: [0.0; NODES],
            weight: [0.0; NODES],
            legendre: [[0.0; NODES]; NODES],
            to_legendre: [[0.0; NODES]; NODES],
            derivative: [[0.0; NODES]; NODES],
        };
        for (i, (x, weight)) in rule(count).into_iter().enumerate() {
            (all.x[i], all.weight[i]) = (x, weight);
            for n in 0..count {
                all.legendre[n][i] = (2 * n + 1) as f64 * weight * legendre(n, 2.0 * x - 1.0).0;
                all.to_legendre[i][n] = all.legendre[n][i];
            }
        }
        for j in 0..count {
            let mut unit = [0.0; NODES];
            unit[j] = 1.0;
            let basis = all.interpolant(&unit);
            for i in 0..count {
                all.derivative[j][i] = basis.knot(all.x[i]).slope;
            }
        }
        all
    }

    /// Coefficient n of the Legendre series through values at the nodes.
    #[inline(always)]
    pub(crate) fn coefficient(&self, values: &AtNodes, n: usize) -> f64 {
        dot(values, &self.legendre[n])
    }

    /// The polynomial through values at the nodes.
    #[inline(always)]
    pub(crate) fn interpolant(&self, values: &AtNodes) -> Interpolant {
        let mut legendre = [0.0; NODES];
        for (column, value) in self.to_legendre.iter().zip(values).take(self.count) {
            for (c, share) in legendre.iter_mut().zip(column) {
                *c += share * value;
            }
        }
        Interpolant { legendre, count: self.count }
    }
}

/// The polynomials through rows of values at the nodes of a rule.
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub(crate) fn interpolants<const K: usize>(nodes: &Nodes, rows: [&AtNodes; K]) -> [Interpolant; K] {
    rows.map(|row| nodes.interpolant(row))
}

/// (2 n + 1) / (n + 1) and n / (n + 1): P_(n+1) = rising z P_n - falling P_(n-1).
const RECURRENCE: [(f64, f64); NODES] = {
    let (mut all, mut n) = ([(0.0, 0.0); NODES], 0);
    while n < NODES {
        let k = n as f64;
        all[n] = ((2.0 * k + 1.0) / (k + 1.0), k / (k + 1.0));
        n += 1;
    }
    all
};

/// A polynomial through values at nodes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Interpolant {
    legendre: AtNodes,
    count: usize,
}

impl Interpolant {
    /// Its values at points x of 0..=1.
    #[inline(always)]
    pub(crate) fn at<const N: usize>(&self, x: &[f64; N]) -> [f64; N] {
        let z = x.map(|x| 2.0 * x - 1.0);
        let (mut last, mut before, mut sum) = ([1.0; N], [0.0; N], [0.0; N]);
        for (c, (rising, falling)) in self.legendre[..self.count].iter().zip(&RECURRENCE) {
            for i in 0..N {
                sum[i] += c * last[i];
                let next = rising * (z[i] * last[i]) - falling * before[i];
                (before[i], last[i]) = (last[i], next);
            }
        }
        sum
    }

    /// Value and slope at x.
    #[inline(always)]
    pub(crate) fn knot(&self, x: f64) -> Knot {
        let [knot] = Interpolant::knots([self], x);
        knot
    }

    /// The same of some polynomials through the same nodes.
    #[inline(always)]
    pub(crate) fn knots<const K: usize>(all: [&Interpolant; K], x: f64) -> [Knot; K] {
        let z = 2.0 * x - 1.0;
        let (mut last, mut before, mut sums) = ([1.0, 0.0], [0.0; 2], [[0.0; 2]; K]);
        for (n, (rising, falling)) in RECURRENCE.iter().enumerate().take(all[0].count) {
            for (sum, of) in sums.iter_mut().zip(&all) {
                *sum = std::array::from_fn(|i| sum[i] + of.legendre[n] * last[i]);
            }
            let products = [z * last[0], z * last[1] + 2.0 * last[0]];
            let next = std::array::from_fn(|i| rising * products[i] - falling * before[i]);
            (before, last) = (last, next);
        }
        sums.map(|[value, slope]| Knot { x, value, slope })
    }
}
