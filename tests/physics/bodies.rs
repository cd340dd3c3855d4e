//! Free masses that touch or meet, and what rigid contacts do to them by an enumeration of all sets of acting pairs.

use crate::common::{Run, scene};
use nalgebra::{DMatrix, DVector};
use pounding::engine::BuildingId;
use pounding::scene::Scene;

/// Free masses, kg and m/s, and the pairs (left floor, right floor, gap, e) between them.
#[derive(Clone)]
pub struct Bodies {
    pub left: Vec<(f64, f64)>,
    pub right: Vec<(f64, f64)>,
    pub pairs: Vec<(usize, usize, f64, f64)>,
}

impl Bodies {
    /// `soft`: the floors of a building are storeys on springs of 1e-20 N/m; else each floor hangs by itself.
    pub fn scene(&self, soft: bool) -> Scene {
        let mut toml = String::from("name = \"Bodies\"\n[inputs]\nfloor_forces = true\n[outputs]\nenergy = true\n");
        for (side, bodies) in [("left", &self.left), ("right", &self.right)] {
            let (mass, velocity): (Vec<f64>, Vec<f64>) = bodies.iter().copied().unzip();
            let floors = bodies.len();
            let row = |i: usize| (0..floors).map(|j| if i == j { 1e-20 } else { 0.0 }).collect::<Vec<f64>>();
            let stiffness = if soft {
                format!("stiffness = {:?}", vec![1e-20; floors])
            } else {
                format!("stiffness_matrix = {:?}", (0..floors).map(row).collect::<Vec<_>>())
            };
            toml += &format!(
                "[{side}]\nmass = {mass:?}\n{stiffness}\ndamping = {{ ratio = 0.0 }}\ninitial_velocity = {velocity:?}\n"
            );
        }
        for (left, right, gap, e) in &self.pairs {
            toml += &format!(
                "[[contact]]\nleft_floor = {}\nright_floor = {}\ngap = {gap:?}
                law = \"stereomechanical\"\nrestitution = {e:?}\n",
                left + 1,
                right + 1
            );
        }
        scene(&toml)
    }

    pub fn masses(&self) -> Vec<f64> {
        self.left.iter().chain(&self.right).map(|body| body.0).collect()
    }

    pub fn velocities(&self) -> DVector<f64> {
        DVector::from_iterator(self.masses().len(), self.left.iter().chain(&self.right).map(|body| body.1))
    }

    /// Row p: what turns floor velocities into the approach rate of pair p.
    pub fn rows(&self, pairs: &[usize]) -> DMatrix<f64> {
        let mut rows = DMatrix::zeros(pairs.len(), self.masses().len());
        for (k, &p) in pairs.iter().enumerate() {
            rows[(k, self.pairs[p].0)] = 1.0;
            rows[(k, self.left.len() + self.pairs[p].1)] = -1.0;
        }
        rows
    }

    /// What p >= 0, q - W p <= 0, p . (q - W p) = 0 does to the floors: M^-1 B^T p, with W = B M^-1 B^T for the given
    /// pairs. Every set of acting pairs is tried; where several fit (redundant pairs), they do the same to the floors.
    pub fn complementary(&self, pairs: &[usize], q: &DVector<f64>) -> DVector<f64> {
        let rows = self.rows(pairs);
        let inverse_mass = DMatrix::from_diagonal(&DVector::from_vec(self.masses().iter().map(|m| 1.0 / m).collect()));
        let w = &rows * &inverse_mass * rows.transpose();
        for set in 0..1_usize << pairs.len() {
            let acting: Vec<usize> = (0..pairs.len()).filter(|k| set >> k & 1 == 1).collect();
            let part = DMatrix::from_fn(acting.len(), acting.len(), |i, j| w[(acting[i], acting[j])]);
            let wanted = DVector::from_iterator(acting.len(), acting.iter().map(|&k| q[k]));
            // nalgebra does not take empty systems; redundant pairs are singular.
            let solved = if acting.is_empty() { Some(wanted) } else { part.lu().solve(&wanted) };
            let Some(solved) = solved else { continue };
            let mut p = DVector::zeros(pairs.len());
            acting.iter().zip(solved.iter()).for_each(|(&k, value)| p[k] = *value);
            let rest = q - &w * &p;
            let small = 1e-13 * q.amax();
            if p.iter().all(|p| *p >= -small) && rest.iter().all(|rest| *rest <= small) {
                return inverse_mass * rows.transpose() * p;
            }
        }
        panic!("no set of pairs fits")
    }

    /// Velocities after the impact of all pairs that touch and do not part: w = v+ + e v- <= 0 (Moreau).
    pub fn after_impact(&self) -> DVector<f64> {
        let before = self.velocities();
        let all: Vec<usize> = (0..self.pairs.len()).collect();
        let rate = self.rows(&all) * &before;
        let closing: Vec<usize> = all.into_iter().filter(|&p| rate[p] >= 0.0).collect();
        let q = closing.iter().map(|&p| (1.0 + self.pairs[p].3) * rate[p]);
        let q = DVector::from_iterator(closing.len(), q);
        before - self.complementary(&closing, &q)
    }

    pub fn momentum(&self, velocities: &DVector<f64>) -> f64 {
        self.masses().iter().zip(velocities).map(|(m, v)| m * v).sum()
    }

    pub fn energy(&self, velocities: &DVector<f64>) -> f64 {
        self.masses().iter().zip(velocities).map(|(m, v)| 0.5 * m * v * v).sum()
    }
}

/// Of all floors, left ones first.
pub fn velocities(run: &Run) -> DVector<f64> {
    let floors =
        [BuildingId::LEFT, BuildingId::RIGHT].map(|side| (0..run.model.floors(side)).map(move |floor| (side, floor)));
    let all: Vec<f64> = floors.into_iter().flatten().map(|(side, floor)| run.velocity(side, floor)).collect();
    DVector::from_vec(all)
}

#[track_caller]
pub fn assert_same(got: &DVector<f64>, expected: &DVector<f64>, tolerance: f64, what: &str) {
    let error = (got - expected).amax() / expected.amax();
    assert!(error <= tolerance, "{what}: {got:?} instead of {expected:?}, off by {error:.1e}");
}
