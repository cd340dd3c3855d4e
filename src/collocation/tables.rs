//! Integrals over a window of powers of the time left, times the polynomials through its nodes.

use super::nodes::{AtNodes, Matrix, NODES, NodeCount, Nodes, nodes, rule};
use super::rows::{NOTHING, fours, row};
use crate::numerics::polynomial::each;
use crate::structure::RESPONSE_POWERS;
use std::sync::OnceLock;

/// Powers of the time left that are tabulated.
pub(crate) const POWERS: usize = RESPONSE_POWERS;

/// G of one pair under the force of another, in powers of t.
pub(crate) type Kernel = [f64; POWERS];

/// How the time of a window goes with x, both from 0 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Map {
    /// theta = x.
    #[default]
    Plain,
    /// theta = x^2: square roots of the time since the start are polynomials.
    SquareStart,
    /// theta = x^4: fourth roots are.
    FourthStart,
    /// theta = 1 - (1 - x)^2: square roots of the time until the end are.
    SquareEnd,
    /// theta = x^2 (3 - 2 x): square roots of either.
    SquareBoth,
    /// theta = x^4 (5 - 4 x): fourth roots from the start, square roots until the end.
    FourthBoth,
}

impl Map {
    /// theta and its derivative at x.
    pub(crate) fn at(self, x: f64) -> (f64, f64) {
        match self {
            Map::Plain => (x, 1.0),
            Map::SquareStart => (x * x, 2.0 * x),
            Map::FourthStart => (x * x * (x * x), 4.0 * x * (x * x)),
            Map::SquareEnd => (x * (2.0 - x), 2.0 * (1.0 - x)),
            Map::SquareBoth => (x * x * (3.0 - 2.0 * x), 6.0 * x * (1.0 - x)),
            Map::FourthBoth => (x * x * (x * x) * (5.0 - 4.0 * x), 20.0 * x * (x * x) * (1.0 - x)),
        }
    }

    /// x of a theta in 0..=1.
    pub(crate) fn inverse(self, theta: f64) -> f64 {
        match self {
            Map::Plain => theta,
            Map::SquareStart => theta.sqrt(),
            Map::FourthStart => theta.sqrt().sqrt(),
            Map::SquareEnd => theta / (1.0 + (1.0 - theta).max(0.0).sqrt()),
            Map::SquareBoth | Map::FourthBoth => self.search(theta),
        }
    }

    /// x of a theta by halving, to the last bit.
    fn search(self, theta: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        loop {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                return if theta < 1.0 { low } else { 1.0 };
            }
            if self.at(middle).0 <= theta {
                low = middle;
            } else {
                high = middle;
            }
        }
    }

    /// The same map without square roots at the end.
    pub(crate) fn without_end(self) -> Map {
        Map::ALL[self as usize % 3]
    }

    /// The same map with polynomials for square roots of the time left until the end.
    pub(crate) fn with_end(self) -> Map {
        Map::ALL[self as usize % 3 + 3]
    }

    /// Without fourth roots.
    pub(crate) const SQUARE: [Map; 4] = [Map::Plain, Map::SquareStart, Map::SquareEnd, Map::SquareBoth];

    /// In the order of their numbers: the three without square roots at the end, and the same with them.
    pub(crate) const ALL: [Map; 6] =
        [Map::Plain, Map::SquareStart, Map::FourthStart, Map::SquareEnd, Map::SquareBoth, Map::FourthBoth];
}

/// The integrals of one map and rule.
pub(crate) struct Tables {
    /// theta of each node.
    pub theta: AtNodes,
    /// theta / (d theta / dx): by how much x of an instant falls per relative growth of the window.
    pub lag: AtNodes,
    /// d theta / dx there, times the weight of the node.
    pub weight: AtNodes,
    /// Of power k: the integral over 0..x_i of (theta_i - theta)^k l_j(x) theta' dx.
    pub inner: [Matrix; POWERS],
    /// The same over the whole window.
    pub whole: [AtNodes; POWERS],
}

impl Tables {
    /// Those of a map and a rule, computed once: in memory of the library itself, which goes with it when it is
    /// unloaded.
    pub(crate) fn of(map: Map, rule: NodeCount) -> &'static Tables {
        place(map, rule).get_or_init(|| compute(map, &Fine::new(rule, self::rule(FINE))))
    }

    /// Computes those of some maps and all rules, as far as that has not been done: not in the middle of a run.
    pub(crate) fn prepare(maps: &[Map]) {
        let is_missing = |map: Map, rule| place(map, rule).get().is_none();
        let mut points = Vec::new();
        for rule in NodeCount::ALL.into_iter().filter(|rule| maps.iter().any(|map| is_missing(*map, *rule))) {
            if points.is_empty() {
                points = self::rule(FINE);
            }
            let fine = Fine::new(rule, points);
            for map in maps {
                place(*map, rule).get_or_init(|| compute(*map, &fine));
            }
            points = fine.points;
        }
    }

    /// Number of tables that the process has computed.
    pub(crate) fn count() -> usize {
        Map::ALL
            .into_iter()
            .flat_map(|map| NodeCount::ALL.map(|rule| place(map, rule)))
            .filter(|one| one.get().is_some())
            .count()
    }
}

/// Where the tables of a map and a rule are kept.
fn place(map: Map, rule: NodeCount) -> &'static OnceLock<Tables> {
    static ALL: [[OnceLock<Tables>; 6]; 3] = [const { [const { OnceLock::new() }; 6] }; 3];
    &ALL[rule as usize][map as usize]
}

/// Points of a rule that is exact for the highest degree: 15 of the polynomial, 4 of the map's derivative, 5 for each
/// power.
const FINE: usize = (NODES + 4 + 5 * POWERS) / 2 + 1;

/// A fine rule from 0 to each node and to 1, with the polynomials l_j that are 1 at node j and 0 at the others.
struct Fine {
    rule: NodeCount,
    /// Points and weights on 0..=1.
    points: Vec<(f64, f64)>,
    /// Of each end, the polynomials at each point.
    basis: Vec<[AtNodes; FINE]>,
}

impl Fine {
    fn new(rule: NodeCount, points: Vec<(f64, f64)>) -> Fine {
        let nodes = nodes(rule);
        let mut basis = vec![[[0.0; NODES]; FINE]; nodes.count + 1];
        basis.iter_mut().enumerate().for_each(|(i, basis)| fill_basis(nodes, end(nodes, i), &points, basis));
        Fine { rule, points, basis }
    }
}

/// Where the integrals to a node end, or those over the whole window.
fn end(nodes: &Nodes, i: usize) -> f64 {
    if i < nodes.count { nodes.x[i] } else { 1.0 }
}

/// The polynomials at the points of a rule up to an end.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn fill_basis(nodes: &Nodes, end: f64, points: &[(f64, f64)], all: &mut [AtNodes; FINE]) {
    for (all, (y, _)) in all.iter_mut().zip(points) {
        let z = 2.0 * (end * y) - 1.0;
        let (mut last, mut before, mut sum) = (1.0, 0.0, NOTHING);
        for (n, factors) in nodes.legendre[..nodes.count].iter().enumerate() {
            for (sum, factors) in sum.iter_mut().zip(fours(factors)) {
                *sum = each(|i| sum[i] + factors[i] * last);
            }
            let k = n as f64;
            (last, before) = (((2.0 * k + 1.0) * z * last - k * before) / (k + 1.0), last);
        }
        *all = row(&sum);
    }
}

/// Computes the tables of a map.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn compute(map: Map, fine: &Fine) -> Tables {
    let nodes = nodes(fine.rule);
    let mut tables = Tables {
        theta: [0.0; NODES],
        lag: [0.0; NODES],
        weight: [0.0; NODES],
        inner: [[[0.0; NODES]; NODES]; POWERS],
        whole: [[0.0; NODES]; POWERS],
    };
    for i in 0..nodes.count {
        let (theta, rate) = map.at(nodes.x[i]);
        tables.theta[i] = theta;
        tables.lag[i] = theta / rate;
        tables.weight[i] = rate * nodes.weight[i];
    }
    // Of the power at hand, at each point: the weight times (theta(end) - theta)^k theta'; theta(end) - theta.
    let (mut shares, mut left) = ([0.0; FINE], [0.0; FINE]);
    for (i, basis) in fine.basis.iter().enumerate() {
        let end = end(nodes, i);
        let until = map.at(end).0;
        for (((y, weight), share), left) in fine.points.iter().zip(&mut shares).zip(&mut left) {
            let (theta, rate) = map.at(end * y);
            (*share, *left) = (end * weight * rate, until - theta);
        }
        for k in 0..POWERS {
            let integrals = match fine.rule {
                NodeCount::Eight => integrals::<{ NodeCount::Eight.count() }>(&shares, basis),
                NodeCount::Twelve => integrals::<{ NodeCount::Twelve.count() }>(&shares, basis),
                NodeCount::Sixteen => integrals::<{ NodeCount::Sixteen.count() }>(&shares, basis),
            };
            match i < nodes.count {
                true => tables.inner[k].iter_mut().zip(&integrals).for_each(|(column, integral)| column[i] = *integral),
                false => tables.whole[k] = integrals,
            }
            shares.iter_mut().zip(&left).for_each(|(share, left)| *share *= left);
        }
    }
    tables
}

/// The sum of shares times polynomials.
#[inline(always)]
fn integrals<const N: usize>(shares: &[f64; FINE], basis: &[AtNodes; FINE]) -> AtNodes {
    let mut sum = NOTHING;
    let mut add = |share: f64, basis: &AtNodes| {
        for (sum, basis) in sum.iter_mut().zip(fours(basis)).take(N / 4) {
            *sum = each(|i| sum[i] + share * basis[i]);
        }
    };
    let ((shares, last_shares), (basis, last_basis)) = (shares.as_chunks::<4>(), basis.as_chunks::<4>());
    for (shares, basis) in shares.iter().zip(basis) {
        for i in 0..4 {
            add(shares[i], &basis[i]);
        }
    }
    last_shares.iter().zip(last_basis).for_each(|(share, basis)| add(*share, basis));
    row(&sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    impl Map {
        fn degree(self) -> usize {
            match self {
                Map::Plain => 1,
                Map::SquareStart | Map::SquareEnd => 2,
                Map::SquareBoth => 3,
                Map::FourthStart => 4,
                Map::FourthBoth => 5,
            }
        }
    }

    /// The integral of (theta_1 - theta)^k theta^m over 0..theta_1 is m! k! / (m + k + 1)! theta_1^(m + k + 1).
    #[test]
    fn powers_of_the_time_are_integrated_to_rounding() {
        for (map, rule) in Map::ALL.into_iter().flat_map(|map| NodeCount::ALL.map(|rule| (map, rule))) {
            let (tables, count) = (Tables::of(map, rule), rule.count());
            for k in 0..POWERS {
                // Of polynomials in x of a degree that the nodes hold.
                for m in 0..=(((count - 1) / map.degree()).min(3) as u32) {
                    let value = tables.theta.map(|theta| libm::pow(theta, f64::from(m)));
                    let mut beta = 1.0 / (k as f64 + 1.0);
                    for i in 1..=m {
                        beta *= f64::from(i) / (k as f64 + 1.0 + f64::from(i));
                    }
                    let whole: f64 = tables.whole[k].iter().zip(&value).take(count).map(|(w, v)| w * v).sum();
                    assert!((whole / beta - 1.0).abs() < 1e-12, "{map:?} {k} {m}: {whole} instead of {beta}");
                    for i in 0..count {
                        let sum: f64 = (0..count).map(|j| tables.inner[k][j][i] * value[j]).sum();
                        let exact = beta * libm::pow(tables.theta[i], k as f64 + 1.0 + f64::from(m));
                        assert!((sum - exact).abs() < 1e-15, "{map:?} {k} {m} {i}: {sum} instead of {exact}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_map_and_its_inverse_belong_together() {
        for map in Map::ALL {
            for x in [0.0, 1e-3, 0.3, 0.9, 1.0] {
                assert!((map.inverse(map.at(x).0) - x).abs() < 1e-12, "{map:?} at {x}");
                let difference = (map.at(x + 1e-7).0 - map.at(x - 1e-7).0) / 2e-7;
                assert!((difference - map.at(x).1).abs() < 1e-7, "{map:?} at {x}");
            }
        }
    }
}
