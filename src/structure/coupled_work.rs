//! Work over a flight of modes that damping couples, as quadratic forms of the motion at its start.
//!
//! With z = (q, v, a, s), displacements and velocities of the modes and the ground's acceleration and slope,
//!
//! ```text
//! z' = A z:   q' = v,   v' = -w^2 q - C v - p a,   a' = s,   s' = 0
//! ```
//!
//! and the work of a damping matrix D over h seconds is z' W z with W the integral of exp(A t)' D exp(A t), whose power
//! series has the terms L of L <- A' L + L A. A short time is doubled with the exact motion: W(2h) = W(h) + T' W(h) T, where
//! z becomes T z over h. Where oscillators move in flights (`flight_modes.rs`) their coordinates and rates stand in z. The work is found from velocities, never from the energies at both ends, so that the balance of
//! energy still tests the motion.

use super::bodies::Body;
use super::equations::Structure;
use super::form::Form;
use super::lanes::{LANES, dot};
use super::modes::ModalDamping;
use nalgebra::{DMatrix, RowDVector};

/// (Fastest rate) x (length) of the time whose forms come from power series.
const REACH: f64 = 0.5;

/// Terms of these series: 2^24 REACH^24 / 24! is 2e-24.
const TERMS: u32 = 24;

/// The work over a flight of one length, of one body.
#[derive(Clone, Debug)]
pub(super) struct CoupledWork {
    /// First mode and number of modes.
    offset: usize,
    count: usize,
    /// Work of all damping.
    viscous: Form,
    /// Work of the dashpots of links, each with the number of its link.
    links: Vec<(usize, Form)>,
    /// Work of the ground motion: rows over z that are multiplied by its acceleration and its slope.
    input: [RowDVector<f64>; 2],
}

/// The same as matrices over z, while a short time is doubled.
struct Matrices {
    viscous: DMatrix<f64>,
    links: Vec<(usize, DMatrix<f64>)>,
    input: [RowDVector<f64>; 2],
}

impl CoupledWork {
    /// For flights of a `length`, s; `None` where damping couples no modes of the body.
    pub(super) fn of(structure: &Structure, body: &Body, number: usize, length: f64) -> Option<CoupledWork> {
        let ModalDamping::Coupled(damping) = &body.modes.damping else { return None };
        let (range, n) = (body.range.clone(), body.range.len());
        let rates = Rates {
            omega2: &structure.omega2[range.clone()],
            participation: &structure.participation[range.clone()],
            damping,
        };
        let doublings = libm::log2(structure.fastest * length / REACH).ceil().clamp(0.0, 1000.0) as i32;
        let mut h = libm::ldexp(length, -doublings);
        let own = structure.links.iter().enumerate().filter(|(_, link)| link.body == number && link.dashpot > 0.0);
        let forms = own.map(|(l, link)| {
            let row = RowDVector::from_row_slice(&link.row[range.clone()]);
            (l, rates.form(&(link.dashpot * row.transpose() * row), h))
        });
        let mut work = Matrices { links: forms.collect(), viscous: rates.form(damping, h), input: rates.input(h) };
        let mut onward = rates.transition(h);
        for _ in 0..doublings {
            work.double(&onward, h);
            onward = &onward * &onward;
            h *= 2.0;
        }
        if let Some(to_modes) = structure.oscillators().and_then(|flight| flight.map_of(range.start)) {
            let mut over = DMatrix::identity(rates.size(), rates.size());
            over.view_mut((0, 0), (2 * n, 2 * n)).copy_from(to_modes);
            work.change_coordinates(&over);
        }
        Some(CoupledWork {
            offset: range.start,
            count: n,
            links: work.links.iter().map(|(l, matrix)| (*l, Form::of(matrix, 0))).collect(),
            viscous: Form::of(&work.viscous, 0),
            input: work.input,
        })
    }

    /// Work of the ground motion and of damping over a flight from a motion, under the ground's acceleration, m/s2, and its
    /// slope, m/s3, at the start; adds that of the dashpots of links.
    pub(super) fn over(
        &self,
        (q, v): (&[f64], &[f64]),
        (a, s): (f64, f64),
        z: &mut Vec<f64>,
        dashpots: &mut [f64],
    ) -> [f64; 2] {
        let own = self.offset..self.offset + self.count;
        z.clear();
        z.extend(q[own.clone()].iter().chain(&v[own]).chain(&[a, s]));
        z.resize(z.len().next_multiple_of(LANES), 0.0);
        for (l, form) in &self.links {
            dashpots[*l] += form.of_vector(z);
        }
        let [held, rising] = self.input.each_ref().map(|row| dot(row.as_slice(), z));
        [a * held + s * rising, self.viscous.of_vector(z)]
    }
}

impl Matrices {
    /// Over z = P y instead of z.
    fn change_coordinates(&mut self, over: &DMatrix<f64>) {
        for form in self.links.iter_mut().map(|(_, form)| form).chain([&mut self.viscous]) {
            *form = over.tr_mul(&(&*form * over));
        }
        self.input.iter_mut().for_each(|row| *row = &*row * over);
    }

    fn double(&mut self, onward: &DMatrix<f64>, h: f64) {
        for form in self.links.iter_mut().map(|(_, form)| form).chain([&mut self.viscous]) {
            *form += onward.tr_mul(&(&*form * onward));
        }
        let [held, rising] = &mut self.input;
        *rising += (&*rising + &*held * h) * onward;
        *held += &*held * onward;
    }
}

/// A of one body.
struct Rates<'a> {
    omega2: &'a [f64],
    participation: &'a [f64],
    damping: &'a DMatrix<f64>,
}

impl Rates<'_> {
    /// Length of z, with zeros up to whole blocks.
    fn size(&self) -> usize {
        (2 * self.omega2.len() + 2).next_multiple_of(LANES)
    }

    /// X A, for a matrix X over z.
    fn times(&self, x: &DMatrix<f64>) -> DMatrix<f64> {
        let n = self.omega2.len();
        let mut out = DMatrix::zeros(x.nrows(), x.ncols());
        let of_v = x.columns(n, n);
        for (j, w2) in self.omega2.iter().enumerate() {
            out.column_mut(j).copy_from(&(of_v.column(j) * -w2));
        }
        out.columns_mut(n, n).copy_from(&(x.columns(0, n) - of_v * self.damping));
        for (j, p) in self.participation.iter().enumerate() {
            out.column_mut(2 * n).axpy(-p, &of_v.column(j), 1.0);
        }
        out.column_mut(2 * n + 1).copy_from(&x.column(2 * n));
        out
    }

    /// W of a damping matrix over a short time h.
    fn form(&self, damping: &DMatrix<f64>, h: f64) -> DMatrix<f64> {
        let n = self.omega2.len();
        let mut term = DMatrix::zeros(self.size(), self.size());
        term.view_mut((n, n), (n, n)).copy_from(&(damping * h));
        let mut sum = term.clone();
        for k in 2..=TERMS {
            let half = self.times(&term) * (h / f64::from(k));
            term = &half + half.transpose();
            sum += &term;
        }
        sum
    }

    /// The rows of the work of the ground motion over a short time h: integrals of -p v and of -p v t.
    fn input(&self, h: f64) -> [RowDVector<f64>; 2] {
        let n = self.omega2.len();
        let mut term = DMatrix::zeros(1, self.size());
        self.participation.iter().enumerate().for_each(|(j, p)| term[(0, n + j)] = -p * h);
        let (mut held, mut rising) = (term.row(0) * 1.0, term.row(0) * (0.5 * h));
        for k in 2..=TERMS {
            term = self.times(&term) * (h / f64::from(k));
            held += term.row(0);
            rising += term.row(0) * (h * f64::from(k) / f64::from(k + 1));
        }
        [held, rising]
    }

    /// T over a short time h.
    fn transition(&self, h: f64) -> DMatrix<f64> {
        let mut term = DMatrix::identity(self.size(), self.size());
        let mut sum = term.clone();
        for k in 1..=TERMS {
            term = self.times(&term) * (h / f64::from(k));
            sum += &term;
        }
        sum
    }
}
