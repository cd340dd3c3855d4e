//! The rates of a motion whose modes damping couples, and what they make over a flight.
//!
//! With z = (q, v, a, s), displacements and velocities of the modes and the ground's acceleration and slope,
//!
//! ```text
//! z' = A z:   q' = v,   v' = -w^2 q - C v - p a,   a' = s,   s' = 0
//! ```
//!
//! and the work of a damping matrix D over h seconds is z' W z with W the integral of exp(A t)' D exp(A t), whose power
//! series has the terms L of L <- A' L + L A. A short time is doubled with the exact motion: W(2h) = W(h) + T' W(h) T, where
//! z becomes T z over h. The work of one dashpot is also the sum of the squares of its rate, a row over z, at the points of a
//! quadrature.

use super::form::{Form, Squares};
use super::lanes::LANES;
use crate::numerics::quadrature::TWELVE_POINTS;
use nalgebra::{DMatrix, RowDVector};

/// (Fastest rate) x (length) of the time whose forms come from power series.
const SERIES_ANGLE: f64 = 0.5;

/// The same of the rule of 12 points, as in `flight_work.rs`, and terms of the series at its points: 3^40 / 40! is 1e-29.
const POINTS_ANGLE: f64 = 3.0;
const POINTS_TERMS: u32 = 40;

/// Terms of these series: 2^24 SERIES_ANGLE^24 / 24! is 2e-24.
const TERMS: u32 = 24;

/// A of one body.
pub(super) struct RateMatrix<'a> {
    pub(super) omega2: &'a [f64],
    pub(super) participation: &'a [f64],
    pub(super) damping: &'a DMatrix<f64>,
    /// Fastest rate of the structure, 1/s.
    pub(super) fastest: f64,
}

impl RateMatrix<'_> {
    /// Length of z, with zeros up to whole blocks.
    pub(super) fn size(&self) -> usize {
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

    /// Number of doublings from a time within reach of a series or rule to a length, s.
    fn doublings(&self, length: f64, angle: f64) -> i32 {
        libm::log2(self.fastest * length / angle).ceil().clamp(0.0, 1000.0) as i32
    }

    /// W of a damping matrix over a length, s, over z = P y instead of z.
    pub(super) fn form_over(&self, damping: &DMatrix<f64>, length: f64, over: Option<&DMatrix<f64>>) -> Form {
        let doublings = self.doublings(length, SERIES_ANGLE);
        let h = libm::ldexp(length, -doublings);
        let (mut form, mut onward) = (self.form(damping, h), self.transition(h));
        for _ in 0..doublings {
            form += onward.tr_mul(&(&form * &onward));
            onward = &onward * &onward;
        }
        Form::of(&over.map_or(form.clone(), |over| over.tr_mul(&(&form * over))), 0)
    }

    /// The work over a length, s, of a rate whose square is the power, as squares of rows over z = P y instead of z; `None` where
    /// these would be so many that a form is less.
    pub(super) fn squares_over(
        &self,
        rate: &RowDVector<f64>,
        length: f64,
        over: Option<&DMatrix<f64>>,
    ) -> Option<Squares> {
        let doublings = self.doublings(length, POINTS_ANGLE);
        if (TWELVE_POINTS.len() << doublings.min(16)) * 2 > self.size() {
            return None;
        }
        let h = libm::ldexp(length, -doublings);
        let mut rows = self.at_points(rate, h);
        let mut onward = self.transition_over(h);
        for _ in 0..doublings {
            let (count, later) = (rows.nrows(), &rows * &onward);
            rows = rows.resize_vertically(2 * count, 0.0);
            rows.rows_mut(count, count).copy_from(&later);
            onward = &onward * &onward;
        }
        Some(Squares::of(&over.map_or(rows.clone(), |over| rows * over)))
    }

    /// The rows of the work of the ground motion over a length, s.
    pub(super) fn input_over(&self, length: f64) -> [RowDVector<f64>; 2] {
        let doublings = self.doublings(length, SERIES_ANGLE);
        let mut h = libm::ldexp(length, -doublings);
        let ([mut held, mut rising], mut onward) = (self.input(h), self.transition(h));
        for _ in 0..doublings {
            rising += (&rising + &held * h) * &onward;
            held += &held * &onward;
            onward = &onward * &onward;
            h *= 2.0;
        }
        [held, rising]
    }

    /// T over a length, s.
    fn transition_over(&self, length: f64) -> DMatrix<f64> {
        let doublings = self.doublings(length, SERIES_ANGLE);
        let mut onward = self.transition(libm::ldexp(length, -doublings));
        for _ in 0..doublings {
            onward = &onward * &onward;
        }
        onward
    }

    /// Rows over z, the sum of whose squares is the work over a time h within reach of the rule of 12 points of a rate whose
    /// square is the power.
    fn at_points(&self, rate: &RowDVector<f64>, h: f64) -> DMatrix<f64> {
        let n = self.omega2.len();
        let mut term = DMatrix::zeros(TWELVE_POINTS.len(), self.size());
        for (mut row, (_, weight)) in term.row_iter_mut().zip(TWELVE_POINTS) {
            row.columns_mut(n, n).copy_from(&(rate * (weight * h).sqrt()));
        }
        let mut sum = term.clone();
        for k in 1..=POINTS_TERMS {
            term = self.times(&term);
            for (mut row, (x, _)) in term.row_iter_mut().zip(TWELVE_POINTS) {
                row *= x * h / f64::from(k);
            }
            sum += &term;
        }
        sum
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
