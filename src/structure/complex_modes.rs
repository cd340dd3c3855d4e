//! Complex modes: where damping couples the modes of a body, its complex modes do not couple, and a flight takes no
//! matrices.
//!
//! Free motion is a sum of shapes phi times exp(lambda t), with
//!
//! ```text
//! (lambda^2 + lambda C + w^2) phi = 0        C: modal damping, w: frequencies without damping     [TisseurMeerbergen2001]
//! ```
//!
//! Two shapes make an oscillator: those of lambda and its conjugate, or of two real ones. Its coordinate x and the rate y of
//! it move as a mode does, x'' + c x' + w^2 x = -p ground acceleration, with w^2 the product of both lambdas and c minus their
//! sum, and the modes are
//!
//! ```text
//! q = A x + B y,   v = q' = -w^2 B x + (A - c B) y        A + lambda B = phi
//! ```
//!
//! In general a load pushes x as well as y. The phase of phi is free, and is chosen so that the ground pushes y only: then an
//! oscillator is like a mode in all that a flight needs, and only rows over the modes become rows over x and y. Other loads
//! act on the modes themselves, not here. The coordinates come back from the modes by
//! z = phi' ((lambda + C) q + v) / phi' (2 lambda + C) phi, of which x is twice the real part.

use super::modes::{ModalDamping, Modes};
use nalgebra::{Complex, DMatrix, DVector, Schur};

/// Largest condition number of the shapes: beyond it the modes are better left coupled. It is large where the ground hardly pushes
/// one of two real modes that make an oscillator, as in the rotation of a foundation with heavy dashpots: what the ground moves
/// loses nothing by that. At some thousand, runs of 30 s differed by 1e-14 from those of coupled modes, and with 43 impacts by
/// 8e-13.
const MOST_CONDITION: f64 = 2e4;

/// Largest number of modes of a body: the work grows with the cube.
const MOST_MODES: usize = 256;

/// The imaginary unit.
const I: Complex<f64> = Complex::new(0.0, 1.0);

/// A push of the ground on a shape that is no more than rounding, relative to the shape and the participation.
const NO_PUSH: f64 = 1e-16;

/// The oscillators of one body.
#[derive(Clone, Debug)]
pub(super) struct Oscillators {
    /// w, rad/s, ascending.
    pub omega: Vec<f64>,
    /// c, 1/s.
    pub damping: Vec<f64>,
    /// p, kg^1/2.
    pub participation: Vec<f64>,
    /// (q, v) from (x, y).
    pub to_modes: DMatrix<f64>,
    /// (x, y) from (q, v).
    pub from_modes: DMatrix<f64>,
    /// The energy of the modes is at most so many times the sum of (y^2 + w^2 x^2) / 2.
    pub most_energy: f64,
}

/// One of them, with A and B, and the rows that give x and y from (q, v).
struct Oscillator {
    omega: f64,
    damping: f64,
    participation: f64,
    a: DVector<f64>,
    b: DVector<f64>,
    rows: [DVector<f64>; 2],
}

/// A complex mode: lambda, phi, the row that gives z from (q, v), and the z' that the ground pushes with.
struct ComplexMode {
    lambda: Complex<f64>,
    shape: DVector<Complex<f64>>,
    row: DVector<Complex<f64>>,
    push: Complex<f64>,
}

/// Modes that damping couples.
struct Coupled<'a> {
    omega: &'a [f64],
    participation: &'a [f64],
    damping: &'a DMatrix<f64>,
}

impl Oscillators {
    /// Those of modes that damping couples; `None` where it couples none, or where the shapes are nearly dependent.
    pub(super) fn of(modes: &Modes) -> Option<Oscillators> {
        let ModalDamping::Coupled(damping) = &modes.damping else { return None };
        let coupled = Coupled { omega: &modes.omega, participation: &modes.participation, damping };
        let mut all = coupled.oscillators()?;
        all.sort_by(|one, other| one.omega.total_cmp(&other.omega));
        let n = all.len();
        let (mut to_modes, mut from_modes) = (DMatrix::zeros(2 * n, 2 * n), DMatrix::zeros(2 * n, 2 * n));
        for (k, Oscillator { omega, damping: c, a, b, rows, .. }) in all.iter().enumerate() {
            to_modes.view_mut((0, k), (n, 1)).copy_from(a);
            to_modes.view_mut((0, n + k), (n, 1)).copy_from(b);
            to_modes.view_mut((n, k), (n, 1)).copy_from(&(b * -(omega * omega)));
            to_modes.view_mut((n, n + k), (n, 1)).copy_from(&(a - b * *c));
            for (part, row) in rows.iter().enumerate() {
                from_modes.row_mut(part * n + k).copy_from(&row.transpose());
            }
        }
        let oscillators = Oscillators {
            omega: all.iter().map(|one| one.omega).collect(),
            damping: all.iter().map(|one| one.damping).collect(),
            participation: all.iter().map(|one| one.participation).collect(),
            to_modes,
            from_modes,
            most_energy: f64::NAN,
        };
        oscillators.sharpened(&modes.omega)
    }

    /// With an inverse that is one to rounding; `None` where the shapes are nearly dependent, as sizes of energies go.
    fn sharpened(mut self, omega: &[f64]) -> Option<Oscillators> {
        let n = omega.len();
        let unit = DMatrix::<f64>::identity(2 * n, 2 * n);
        let correction = &unit * 2.0 - &self.from_modes * &self.to_modes;
        self.from_modes = correction * &self.from_modes;
        let size = |of: &[f64], i: usize| if i < n { of[i] } else { 1.0 };
        let scaled =
            DMatrix::from_fn(2 * n, 2 * n, |i, k| self.to_modes[(i, k)] * size(omega, i) / size(&self.omega, k));
        let off = &self.from_modes * &self.to_modes - unit;
        let off = DMatrix::from_fn(2 * n, 2 * n, |i, k| off[(i, k)] * size(&self.omega, i) / size(&self.omega, k));
        let values = scaled.try_svd(false, false, f64::EPSILON, 1000)?.singular_values;
        let condition = values.max() / values.min();
        self.most_energy = (1.0 + 1e-9) * values.max() * values.max();
        // Written so that a NaN is not good.
        (condition <= MOST_CONDITION && off.amax() <= 1e-11).then_some(self)
    }
}

impl Coupled<'_> {
    fn oscillators(&self) -> Option<Vec<Oscillator>> {
        let n = self.omega.len();
        if n > MOST_MODES {
            return None;
        }
        let state = DMatrix::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
            (true, false) if j == n + i => self.omega[i],
            (false, true) if i == n + j => -self.omega[j],
            (false, false) => -self.damping[(i - n, j - n)],
            _ => 0.0,
        });
        let rates = Schur::try_new(state, f64::EPSILON, 10_000)?.complex_eigenvalues();
        let mut real: Vec<f64> = rates.iter().filter(|rate| rate.im == 0.0).map(|rate| rate.re).collect();
        let swinging = rates.iter().filter(|rate| rate.im > 0.0);
        let mut all: Vec<Oscillator> =
            swinging.map(|rate| Some(self.swinging(self.mode(*rate)?))).collect::<Option<_>>()?;
        // The slowest of the real ones with the fastest, and so on.
        real.sort_by(f64::total_cmp);
        let (fast, slow) = real.split_at(real.len() / 2);
        for (fast, slow) in fast.iter().zip(slow.iter().rev()) {
            let [fast, slow] = [fast, slow].map(|rate| self.mode(Complex::new(*rate, 0.0)));
            all.push(self.creeping([fast?, slow?]));
        }
        (all.len() == n).then_some(all)
    }

    /// The complex mode near an eigenvalue of about 13 digits, by inverse iteration, and its eigenvalue by the Rayleigh
    /// quotient of the quadratic pencil: components that are small are as exact as others.
    fn mode(&self, near: Complex<f64>) -> Option<ComplexMode> {
        let n = self.omega.len();
        let square = |x: f64| Complex::from(x * x);
        let pencil = DMatrix::from_fn(n, n, |i, j| {
            let own = if i == j { near * near + square(self.omega[i]) } else { Complex::from(0.0) };
            own + near * self.damping[(i, j)]
        });
        let decomposed = pencil.lu();
        let mut lambda = near;
        let mut shape = DVector::from_fn(n, |i, _| Complex::from(1.0 / (1.0 + i as f64)));
        for _ in 0..3 {
            shape = decomposed.solve(&self.steepness(lambda, &shape))?;
            shape /= Complex::from(shape.iter().map(Complex::l1_norm).fold(0.0, f64::max));
            lambda -= self.excess(lambda, &shape) / shape.dot(&self.steepness(lambda, &shape));
        }
        if near.im == 0.0 {
            lambda.im = 0.0;
        }
        let norm = shape.dot(&self.steepness(lambda, &shape));
        let damped = self.damped(&shape);
        let row = DVector::from_fn(2 * n, |i, _| match i < n {
            true => (lambda * shape[i] + damped[i]) / norm,
            false => shape[i - n] / norm,
        });
        let push = (0..n).map(|i| row[n + i] * self.participation[i]).sum();
        let is_finite = row.iter().all(|entry| entry.re.is_finite() && entry.im.is_finite());
        is_finite.then_some(ComplexMode { lambda, shape, row, push })
    }

    /// C phi.
    fn damped(&self, shape: &DVector<Complex<f64>>) -> DVector<Complex<f64>> {
        let sum = |i: usize| shape.iter().enumerate().map(|(j, of)| *of * self.damping[(i, j)]).sum();
        DVector::from_fn(shape.len(), |i, _| sum(i))
    }

    /// (2 lambda + C) phi.
    fn steepness(&self, lambda: Complex<f64>, shape: &DVector<Complex<f64>>) -> DVector<Complex<f64>> {
        self.damped(shape) + shape * (lambda * 2.0)
    }

    /// phi' (lambda^2 + lambda C + w^2) phi.
    fn excess(&self, lambda: Complex<f64>, shape: &DVector<Complex<f64>>) -> Complex<f64> {
        let damped = self.damped(shape);
        let of = |i: usize| {
            let own = shape[i] * (lambda * lambda + Complex::from(self.omega[i] * self.omega[i]));
            shape[i] * (own + lambda * damped[i])
        };
        (0..shape.len()).map(of).sum()
    }

    /// The oscillator of a complex mode and its conjugate.
    fn swinging(&self, mut mode: ComplexMode) -> Oscillator {
        let n = self.omega.len();
        let ComplexMode { lambda, .. } = mode;
        let omega = size(lambda);
        let strain = mode.shape.iter().zip(self.omega).map(|(of, w)| (omega * omega + w * w) * of.norm_sqr());
        let turn = self.turn(&mode) * (std::f64::consts::SQRT_2 * omega / strain.sum::<f64>().sqrt());
        mode.shape *= turn;
        mode.row /= turn;
        mode.push /= turn;
        let [x, y] = [Complex::from(2.0), lambda * 2.0];
        Oscillator {
            omega,
            damping: (-2.0 * lambda.re).max(0.0),
            participation: (y * mode.push).re,
            a: mode.shape.map(|of| of.re - of.im * (lambda.re / lambda.im)),
            b: mode.shape.map(|of| of.im / lambda.im),
            rows: [x, y].map(|factor| DVector::from_fn(2 * n, |i, _| (factor * mode.row[i]).re)),
        }
    }

    /// The factor of a shape, of magnitude 1, with which the ground does not push x; where it pushes neither x nor y, the one
    /// with which x is most like a mode.
    fn turn(&self, mode: &ComplexMode) -> Complex<f64> {
        let n = self.omega.len();
        let sizes = |of: &mut dyn Iterator<Item = f64>| of.sum::<f64>().sqrt();
        let row = sizes(&mut (n..2 * n).map(|i| mode.row[i].norm_sqr()));
        let whole = sizes(&mut self.participation.iter().map(|p| p * p));
        if size(mode.push) > NO_PUSH * row * whole {
            return I * mode.push / size(mode.push);
        }
        let norm = mode.shape.dot(&self.steepness(mode.lambda, &mode.shape));
        let twice = I * size(norm) / norm;
        match twice + 1.0 {
            sum if size(sum) > 1e-8 => sum / size(sum),
            _ => I,
        }
    }

    /// The oscillator of two real modes.
    fn creeping(&self, modes: [ComplexMode; 2]) -> Oscillator {
        let n = self.omega.len();
        let [one, other] = &modes;
        let rates = [one.lambda.re, other.lambda.re];
        let pushes = [one.push.re, other.push.re];
        let largest = pushes[0].abs().max(pushes[1].abs());
        let same = one.shape.iter().zip(other.shape.iter()).map(|(a, b)| a.re * b.re).sum::<f64>();
        let shares = match largest > 0.0 {
            true => [pushes[1] / largest, -pushes[0] / largest],
            false => [1.0, f64::copysign(1.0, same)],
        };
        let shape = |k: usize| modes[k].shape.map(|of| of.re / shares[k]);
        let b = (shape(0) - shape(1)) / (rates[0] - rates[1]);
        let a = shape(0) - &b * rates[0];
        let omega = (rates[0] * rates[1]).sqrt();
        let strained = a.iter().zip(self.omega).map(|(a, w)| (a * w / omega) * (a * w / omega)).sum::<f64>();
        let scale = 1.0 / (strained + b.norm_squared() * omega * omega).sqrt();
        let of_rows = |factors: [f64; 2]| {
            DVector::from_fn(2 * n, |i, _| {
                (0..2).map(|k| factors[k] * shares[k] * modes[k].row[i].re / scale).sum::<f64>()
            })
        };
        Oscillator {
            omega,
            damping: -(rates[0] + rates[1]),
            participation: (0..2).map(|k| rates[k] * shares[k] * pushes[k] / scale).sum(),
            a: a * scale,
            b: b * scale,
            rows: [of_rows([1.0, 1.0]), of_rows(rates)],
        }
    }
}

/// The magnitude, by operations that are the same on all machines.
fn size(number: Complex<f64>) -> f64 {
    number.norm_sqr().sqrt()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::structure::{BuildingId, CoupledIncrement, ModeIncrement, Structure};

    /// Two buildings with dashpots between them, from light to so heavy that joint modes creep; and one whose own dashpots
    /// couple its modes.
    fn structures() -> Vec<Structure> {
        let building = |n: usize, stiffness: f64| {
            format!("mass = {:?}\nstiffness = {:?}\ndamping = {{ ratio = 0.05 }}", vec![2e4; n], vec![stiffness; n])
        };
        let linked = |(left, right): (usize, usize), dashpot: f64| {
            let links = (1..=left.min(right)).map(|floor| {
                format!(
                    "[[link]]\nleft_floor = {floor}\nright_floor = {floor}\nstiffness = 1e6\ndashpot = {dashpot:e}\n"
                )
            });
            let (one, other) = (building(left, 2.4e7), building(right, 5.1e7));
            format!("name = \"Two\"\n[left]\n{one}\n[right]\n{other}\n{}", links.collect::<String>())
        };
        let mut scenes: Vec<String> = [1e4, 3e5, 3e6].map(|dashpot| linked((2, 3), dashpot)).to_vec();
        scenes.push(linked((25, 25), 1e5));
        scenes.push(
            "name = \"One\"\n[left]\nmass = [2e4, 2e4, 2e4]\nstiffness = [2e6, 3e7, 3e7]\n\
             damping = { dashpots = [9e5, 2e4, 2e4] }"
                .to_string(),
        );
        scenes.iter().map(|scene| Structure::of(&Scene::from_toml(scene).unwrap()).unwrap()).collect()
    }

    /// Flown as oscillators, and by the matrix exponential of all modes together.
    #[test]
    fn they_fly_as_coupled_modes_do() {
        let mut creeping = 0;
        for structure in structures() {
            let modes = &structure.body(BuildingId::LEFT).modes;
            let (damping, of) = (modes.damping.matrix(), Oscillators::of(modes).unwrap());
            let (n, h) = (modes.omega.len(), 0.01);
            creeping += of.omega.iter().zip(&of.damping).filter(|(w, c)| **c > 2.0 * **w).count();
            let matrix = CoupledIncrement::new(&modes.omega, &damping, h);
            let start = DVector::from_fn(2 * n, |i, _| (1.0 + 1.7 * i as f64).sin());
            let (mut exact, mut flown) = (start.clone(), &of.from_modes * &start);
            for step in 0..2000 {
                let (load, slope) = ((0.3 * f64::from(step)).sin(), (0.7 * f64::from(step)).cos());
                let [loads, slopes] =
                    [load, slope].map(|a| modes.participation.iter().map(|p| -p * a).collect::<Vec<_>>());
                let mut change = vec![0.0; 2 * n];
                let (q, v) = exact.as_slice().split_at(n);
                matrix.step(0, [q, v, &loads, &slopes], &mut change);
                exact += DVector::from_vec(change);
                for k in 0..n {
                    let (x, y, p) = (flown[k], flown[n + k], of.participation[k]);
                    let by = ModeIncrement::new(of.omega[k], of.damping[k], h);
                    flown[k] += by.dqq * x + by.dqv * y - p * (by.rq0 * load + by.rq1 * slope);
                    flown[n + k] += by.dvq * x + by.dvv * y - p * (by.rv0 * load + by.rv1 * slope);
                }
                let back = &of.to_modes * &flown;
                let size = |i: usize| if i < n { modes.omega[i] } else { 1.0 };
                let off = (0..2 * n).map(|i| ((back[i] - exact[i]) * size(i)).abs()).fold(0.0, f64::max);
                let whole = (0..2 * n).map(|i| (start[i] * size(i)).abs()).fold(0.0, f64::max);
                assert!(off <= 2e-13 * whole, "{off:e} of {whole:e} after {step} steps of {n} modes");
            }
        }
        assert!(creeping > 0);
    }
}
