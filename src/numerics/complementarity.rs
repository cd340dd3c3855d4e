//! Forces that can only push, between floors that touch: a linear complementarity problem.
//!
//! Sought are x >= 0 with w = G x - b >= 0 and x . w = 0. G = J M^-1 J' gives the relative acceleration (velocity) of
//! each pair per unit force (impulse) of another; b is the relative acceleration (velocity) at which the pairs would
//! close without any, positive towards each other. G is symmetric and positive semidefinite, so that x minimises x . G
//! x / 2 - b . x over x >= 0: Gauss's principle of least constraint. It is solved by the active-set method for
//! non-negative least squares \[LawsonHanson1974, ch. 23\], which ends after finitely many exchanges, also where pairs
//! depend on each other (four pairs of two floors a side): a pair whose column depends on those of the active pairs
//! stays inactive.

use nalgebra::DMatrix;

/// A pivot below this share of its diagonal entry is taken as 0: the pair depends linearly on those before it.
const DEPENDENT: f64 = 1e-10;

/// The problem for some pairs, its solution, and the factors of the active pairs' matrix.
#[derive(Clone, Debug, Default)]
pub(crate) struct Complementarity {
    /// The pairs in question, as row numbers of G.
    pub pairs: Vec<usize>,
    /// b, one per pair in question.
    pub known: Vec<f64>,
    /// x, one per pair in question: N where b is in m/s2, N s where it is in m/s.
    pub found: Vec<f64>,
    /// Rounding error of b, one per pair in question: a pair needs no force against less.
    pub noise: Vec<f64>,
    /// Positions in `pairs` that may carry a force.
    active: Vec<usize>,
    /// Solution of the equations of the active pairs, which may hold negative forces.
    trial: Vec<f64>,
    /// L below the diagonal and D on it, by rows, in the order of the active positions; D is 0 for a dependent pair.
    factor: Vec<f64>,
}

impl Complementarity {
    /// Allocates for at most `most` pairs.
    pub(crate) fn new(most: usize) -> Complementarity {
        let numbers = || Vec::with_capacity(most);
        Complementarity {
            pairs: Vec::with_capacity(most),
            known: numbers(),
            found: numbers(),
            noise: numbers(),
            active: Vec::with_capacity(most),
            trial: vec![0.0; most],
            factor: vec![0.0; most * most],
        }
    }

    /// Forgets all pairs.
    pub(crate) fn clear(&mut self) {
        self.pairs.clear();
        self.known.clear();
        self.found.clear();
        self.noise.clear();
    }

    /// Adds a pair with b and the rounding error of b.
    pub(crate) fn add(&mut self, pair: usize, known: f64, noise: f64) {
        self.pairs.push(pair);
        self.known.push(known);
        self.found.push(0.0);
        self.noise.push(noise);
    }

    /// Solves for bilateral contact: makes all pairs active, so that G x = b from the next `solve` on; x of either
    /// sign.
    pub(crate) fn close_all(&mut self, matrix: &DMatrix<f64>) {
        self.active.clear();
        self.active.extend(0..self.pairs.len());
        self.factorise(matrix);
    }

    /// `found` from `known` for the active pairs; 0 for the others.
    pub(crate) fn solve(&mut self) {
        self.try_active();
        self.found.fill(0.0);
        for (i, &position) in self.active.iter().enumerate() {
            self.found[position] = self.trial[i];
        }
    }

    /// Solves the complementarity problem: forces x >= 0 that only push.
    pub(crate) fn push(&mut self, matrix: &DMatrix<f64>) {
        self.close_all(matrix);
        self.solve();
        if self.found.iter().all(|x| *x >= 0.0) {
            return;
        }
        self.active.clear();
        self.found.fill(0.0);
        // Every round lowers the minimised function; by rounding the last rounds may leave it as it is.
        for _ in 0..3 * self.pairs.len() + 3 {
            let Some(next) = self.most_violated(matrix) else { break };
            self.active.push(next);
            while !self.step_to_active(matrix) {}
        }
    }

    /// The inactive pair that violates w >= 0 most, relative to b.
    fn most_violated(&self, matrix: &DMatrix<f64>) -> Option<usize> {
        let mut worst = (0.0, None);
        for position in (0..self.pairs.len()).filter(|position| !self.active.contains(position)) {
            let row = self.pairs[position];
            let held: f64 = self.pairs.iter().zip(&self.found).map(|(&column, x)| matrix[(row, column)] * x).sum();
            let missing = self.known[position] - held;
            let force = missing / matrix[(row, row)];
            if missing > self.noise[position] && force > worst.0 {
                worst = (force, Some(position));
            }
        }
        worst.1
    }

    /// Moves x towards the solution of the active pairs until the first force would become negative, and makes that
    /// pair inactive; returns whether the whole way was possible.
    fn step_to_active(&mut self, matrix: &DMatrix<f64>) -> bool {
        self.factorise(matrix);
        self.try_active();
        // The largest admissible share of the way, and the pair whose force would be negative beyond it.
        let mut stop: Option<(f64, usize)> = None;
        for (i, &position) in self.active.iter().enumerate().filter(|&(i, _)| self.trial[i] <= 0.0) {
            let here = self.found[position];
            let share = if here > 0.0 { here / (here - self.trial[i]) } else { 0.0 };
            if stop.is_none_or(|(least, _)| share < least) {
                stop = Some((share, position));
            }
        }
        let share = stop.map_or(1.0, |(share, _)| share);
        for (i, &position) in self.active.iter().enumerate() {
            let here = self.found[position];
            self.found[position] = if share < 1.0 { here + share * (self.trial[i] - here) } else { self.trial[i] };
        }
        let Some((_, stopped)) = stop else { return true };
        self.found[stopped] = 0.0;
        let found = &mut self.found;
        self.active.retain(|&position| found[position] > 0.0);
        false
    }

    /// Factors the active pairs' matrix into L D L'.
    fn factorise(&mut self, matrix: &DMatrix<f64>) {
        let n = self.active.len();
        for i in 0..n {
            let row = self.pairs[self.active[i]];
            for j in 0..=i {
                let mut rest = matrix[(row, self.pairs[self.active[j]])];
                for k in 0..j {
                    rest -= self.factor[i * n + k] * self.factor[k * n + k] * self.factor[j * n + k];
                }
                let pivot = self.factor[j * n + j];
                let independent = rest > DEPENDENT * matrix[(row, row)];
                self.factor[i * n + j] = match () {
                    _ if j == i && independent => rest,
                    _ if j < i && pivot > 0.0 => rest / pivot,
                    _ => 0.0,
                };
            }
        }
    }

    /// `trial` = solution of the equations of the active pairs.
    fn try_active(&mut self) {
        let n = self.active.len();
        for i in 0..n {
            let mut rest = self.known[self.active[i]];
            for k in 0..i {
                rest -= self.factor[i * n + k] * self.trial[k];
            }
            self.trial[i] = rest;
        }
        for i in (0..n).rev() {
            let pivot = self.factor[i * n + i];
            if pivot == 0.0 {
                self.trial[i] = 0.0;
                continue;
            }
            let mut rest = self.trial[i] / pivot;
            for k in i + 1..n {
                rest -= self.factor[k * n + i] * self.trial[k];
            }
            self.trial[i] = rest;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn push(matrix: &DMatrix<f64>, known: &[f64]) -> Vec<f64> {
        let mut problem = Complementarity::new(known.len());
        for (pair, known) in known.iter().enumerate() {
            problem.add(pair, *known, 1e-14);
        }
        problem.push(matrix);
        problem.found
    }

    /// Asserts the conditions that determine x uniquely (unless pairs depend on each other).
    fn assert_solves(matrix: &DMatrix<f64>, known: &[f64], x: &[f64]) {
        for (i, b) in known.iter().enumerate() {
            let w: f64 = (0..x.len()).map(|j| matrix[(i, j)] * x[j]).sum::<f64>() - b;
            assert!(x[i] >= 0.0 && w > -1e-11 && (x[i] * w).abs() < 1e-11, "pair {i}: x {}, w {w:e}", x[i]);
        }
    }

    #[test]
    fn pairs_of_different_floors_do_not_know_each_other() {
        let matrix = DMatrix::from_diagonal(&nalgebra::DVector::from_vec(vec![2.0, 4.0, 0.5]));
        assert_eq!(push(&matrix, &[1.0, -1.0, 3.0]), [0.5, 0.0, 6.0]);
    }

    #[test]
    fn a_pair_that_would_pull_is_left_out() {
        // One floor of mass 1 against two of mass 1: the force that one pair needs drives the other pair apart.
        let matrix = DMatrix::from_row_slice(2, 2, &[2.0, 1.0, 1.0, 2.0]);
        assert_eq!(push(&matrix, &[3.0, 1.0]), [1.5, 0.0]);
        let both = push(&matrix, &[3.0, 3.0]);
        assert!(both.iter().all(|x| (x - 1.0).abs() < 1e-15), "{both:?}");
    }

    #[test]
    fn pairs_that_depend_on_each_other_share() {
        // Two floors a side, each against each: four pairs, three independent.
        let rows = [[1.0, 0.0, -1.0, 0.0], [1.0, 0.0, 0.0, -1.0], [0.0, 1.0, -1.0, 0.0], [0.0, 1.0, 0.0, -1.0]];
        let row = |i: usize| nalgebra::DVector::from_row_slice(&rows[i]);
        let matrix = DMatrix::from_fn(4, 4, |i, j| row(i).dot(&row(j)));
        let known: Vec<f64> =
            (0..4).map(|i| row(i).dot(&nalgebra::DVector::from_vec(vec![1.0, 0.5, -0.2, -0.4]))).collect();
        assert_solves(&matrix, &known, &push(&matrix, &known));
    }

    proptest! {
        #[test]
        fn any_pairs_end_with_forces_that_push(
            pairs in proptest::collection::btree_set((0..4_usize, 0..4_usize), 1..=12),
            masses in proptest::collection::vec(0.1..10.0_f64, 8),
            pressing in proptest::collection::vec(-1.0..1.0_f64, 8),
        ) {
            let pairs: Vec<_> = pairs.into_iter().collect();
            let shared = |a: usize, b: usize, mass: f64| if a == b { 1.0 / mass } else { 0.0 };
            let matrix = DMatrix::from_fn(pairs.len(), pairs.len(), |i, j| {
                let ((a, b), (c, d)) = (pairs[i], pairs[j]);
                shared(a, c, masses[a]) + shared(b, d, masses[4 + b])
            });
            let known: Vec<f64> = pairs.iter().map(|(a, b)| pressing[*a] - pressing[4 + *b]).collect();
            assert_solves(&matrix, &known, &push(&matrix, &known));
        }
    }
}
