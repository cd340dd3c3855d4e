//! Frames with storeys that yield, links and contacts that are linear, another way: between events the floors obey y' = A y with a
//! constant matrix that has the stiffness of the storeys as they are then, and y is the exponential of A t. Displacements are
//! total ones, steps are short, events are found by bisection. Foundations are there as a sway and a rotation after the floors of
//! their building.

mod compare;
mod events;
mod system;

pub use compare::assert_same_motion;

use nalgebra::{DMatrix, DVector};
use pounding::record::Record;
use pounding::scene::Scene;
use system::{Places, Storey, System};

/// Up to so many steps of one length a matrix of them is not worth its while.
const FEW_STEPS: u32 = 32;

/// The motion and all that is remembered of it.
pub struct Piecewise<'r> {
    system: System,
    record: &'r Record,
    /// Displacements, velocities, 1, and the time since the last sample.
    y: DVector<f64>,
    pub time: f64,
    pub plastic: Vec<f64>,
    pub cumulative: Vec<f64>,
    sense: Vec<f64>,
    closed: Vec<bool>,
    /// The latest impulse of each pair, s.
    struck: Vec<f64>,
    /// Set where impulses of a pair follow each other at once: floors that come to rest on each other are not followed.
    pub is_over: bool,
    /// How often storeys have begun to yield, and pairs to touch.
    pub yields: usize,
    pub impacts: usize,
    /// s.
    step: f64,
}

impl Piecewise<'_> {
    pub fn new<'r>(scene: &Scene, record: &'r Record) -> Piecewise<'r> {
        let (system, places) = (System::of(scene), Places(scene));
        let n = places.count();
        let displacements = places.of_floors(|building| &building.initial_displacement);
        let mut y = DVector::zeros(2 * n + 2);
        y.rows_mut(0, n).copy_from(&displacements);
        y.rows_mut(n, n).copy_from(&places.of_floors(|building| &building.initial_velocity));
        y[2 * n] = 1.0;
        let plastic = system.storeys.iter().map(|storey| {
            let drift = storey.row.dot(&displacements);
            drift.signum() * (drift.abs() - storey.limit).max(0.0)
        });
        Piecewise {
            plastic: plastic.collect(),
            cumulative: vec![0.0; system.storeys.len()],
            sense: vec![0.0; system.storeys.len()],
            closed: vec![false; system.pairs.len()],
            struck: vec![f64::NEG_INFINITY; system.pairs.len()],
            is_over: false,
            step: system.short_step(),
            time: 0.0,
            yields: 0,
            impacts: 0,
            system,
            record,
            y,
        }
    }

    fn floors(&self) -> usize {
        self.system.mass.len()
    }

    fn drift(&self, i: usize, y: &DVector<f64>) -> f64 {
        self.system.storeys[i].row.dot(&y.rows(0, self.floors()))
    }

    fn drift_rate(&self, i: usize, y: &DVector<f64>) -> f64 {
        self.system.storeys[i].row.dot(&y.rows(self.floors(), self.floors()))
    }

    fn penetration(&self, p: usize, y: &DVector<f64>) -> f64 {
        self.system.pairs[p].row.dot(&y.rows(0, self.floors())) - self.system.pairs[p].gap
    }

    fn closing(&self, p: usize, y: &DVector<f64>) -> f64 {
        self.system.pairs[p].row.dot(&y.rows(self.floors(), self.floors()))
    }

    pub fn displacement(&self, floor: usize) -> f64 {
        self.y[floor]
    }

    pub fn velocity(&self, floor: usize) -> f64 {
        self.y[self.floors() + floor]
    }

    /// Plastic drift now, also while the storey yields.
    pub fn plastic_now(&self, i: usize) -> f64 {
        match self.sense[i] {
            0.0 => self.plastic[i],
            sense => self.drift(i, &self.y) - sense * self.system.storeys[i].limit,
        }
    }

    /// Force of a storey or a link, N, with a dashpot beside it.
    fn force(&self, i: usize, dashpot: f64) -> f64 {
        let (Storey { stiffness, ratio, .. }, drift) = (&self.system.storeys[i], self.drift(i, &self.y));
        let plastic = if self.system.storeys[i].can_yield { self.plastic_now(i) } else { 0.0 };
        stiffness * drift - (1.0 - ratio) * stiffness * plastic + dashpot * self.drift_rate(i, &self.y)
    }

    /// Drift of a storey where all would come to rest with the plastic drifts of now.
    fn residual(&self, i: usize) -> f64 {
        let n = self.floors();
        let (mut matrix, mut force) = (DMatrix::zeros(n, n), DVector::zeros(n));
        for (j, Storey { row, stiffness, ratio, can_yield, .. }) in self.system.storeys.iter().enumerate() {
            matrix += *stiffness * row * row.transpose();
            if *can_yield {
                force += (1.0 - ratio) * stiffness * self.plastic_now(j) * row;
            }
        }
        matrix.lu().solve(&force).map_or(f64::NAN, |rest| self.system.storeys[i].row.dot(&rest))
    }

    pub fn cumulative_now(&self, i: usize) -> f64 {
        self.cumulative[i] + (self.plastic_now(i) - self.plastic[i]).abs()
    }

    /// The matrix of the present phase; `slope` is that of the ground acceleration, from `start` at the last sample.
    fn matrix(&self, (start, slope): (f64, f64)) -> DMatrix<f64> {
        let n = self.floors();
        let mut force = DMatrix::zeros(n, 2 * n + 2);
        force.view_mut((0, n), (n, n)).copy_from(&-&self.system.damping);
        let mut add = |row: &DVector<f64>, stiffness: f64, damping: f64, constant: f64| {
            for i in (0..n).filter(|&i| row[i] != 0.0) {
                for j in 0..n {
                    force[(i, j)] -= row[i] * stiffness * row[j];
                    force[(i, n + j)] -= row[i] * damping * row[j];
                }
                force[(i, 2 * n)] -= row[i] * constant;
            }
        };
        for (i, storey) in self.system.storeys.iter().enumerate() {
            let &Storey { ref row, stiffness, limit, ratio, .. } = storey;
            let softened = (1.0 - ratio) * stiffness;
            match self.sense[i] {
                0.0 => add(row, stiffness, 0.0, -softened * self.plastic[i]),
                sense => add(row, ratio * stiffness, 0.0, softened * sense * limit),
            }
        }
        for (pair, _) in self.system.pairs.iter().zip(&self.closed).filter(|(_, closed)| **closed) {
            add(&pair.row, pair.stiffness, pair.damping, -pair.stiffness * pair.gap);
        }
        let mut matrix = DMatrix::zeros(2 * n + 2, 2 * n + 2);
        for i in 0..n {
            matrix[(i, n + i)] = 1.0;
            matrix.row_mut(n + i).copy_from(&(force.row(i) / self.system.mass[i]));
            matrix[(n + i, 2 * n)] -= start * self.system.pushed[i];
            matrix[(n + i, 2 * n + 1)] -= slope * self.system.pushed[i];
        }
        matrix[(2 * n + 1, 2 * n)] = 1.0;
        matrix
    }

    /// The ground acceleration at the last sample up to now, its slope, and the time of the next one.
    fn ground(&self, sample: usize) -> ((f64, f64), f64) {
        let Record { times, accelerations, .. } = self.record;
        match times.get(sample + 1) {
            Some(&next) => {
                let slope = (accelerations[sample + 1] - accelerations[sample]) / (next - times[sample]);
                ((accelerations[sample], slope), next)
            }
            None => ((0.0, 0.0), f64::INFINITY),
        }
    }

    pub fn to(&mut self, until: f64) {
        while self.time < until && !self.is_over {
            let sample = self.record.times.partition_point(|&time| time <= self.time) - 1;
            let (ground, next) = self.ground(sample);
            let end = next.min(until);
            let matrix = self.matrix(ground);
            let last = 2 * self.floors() + 1;
            self.y[last] = self.time - self.record.times[sample];
            // Equal steps: in a sum of a million rounded ones the time would be off by more than they make of the motion.
            let (start, count) = (self.time, ((end - self.time) / self.step).ceil() as u32);
            let step = (end - start) / f64::from(count);
            // One product for each of many steps in place of a series.
            let leap = (count > FEW_STEPS).then(|| leap(&matrix, step));
            for k in 1..=count {
                let after = match &leap {
                    Some(leap) => &self.y + leap * &self.y,
                    None => exponential(&matrix, &self.y, step),
                };
                if let Some((t, event)) = self.first_event(&matrix, &after, step) {
                    self.y = exponential(&matrix, &self.y, t);
                    self.time += t;
                    self.handle(event);
                    break;
                }
                self.y = after;
                self.time = if k == count { end } else { start + f64::from(k) * step };
            }
        }
    }
}

/// exp(A t) - 1, which is small: its rounding, the same in a million steps, is next to nothing of the motion.
fn leap(matrix: &DMatrix<f64>, t: f64) -> DMatrix<f64> {
    let mut term = matrix * t;
    let mut sum = term.clone();
    for k in 2..60 {
        term = matrix * term * (t / f64::from(k));
        sum += &term;
        if term.iter().zip(&sum).all(|(term, sum)| term.abs() <= 1e-18 * sum.abs()) {
            break;
        }
    }
    sum
}

/// exp(A t) y.
fn exponential(matrix: &DMatrix<f64>, y: &DVector<f64>, t: f64) -> DVector<f64> {
    let (mut sum, mut term) = (y.clone(), y.clone());
    for k in 1..60 {
        term = matrix * term * (t / f64::from(k));
        sum += &term;
        if term.iter().zip(&sum).all(|(term, sum)| term.abs() <= 1e-18 * sum.abs()) {
            break;
        }
    }
    sum
}
