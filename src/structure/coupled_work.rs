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
use super::form::{Form, Squares};
use super::lanes::LANES;
use super::modes::ModalDamping;
use crate::numerics::quadrature::TWELVE_POINTS;
use nalgebra::{DMatrix, RowDVector};

/// (Fastest rate) x (length) of the time whose forms come from power series.
const REACH: f64 = 0.5;

/// The same of the rule of 12 points, as in `flight_work.rs`, and terms of the series at its points: 3^40 / 40! is 1e-29.
const POINTS_REACH: f64 = 3.0;
const POINTS_TERMS: u32 = 40;

/// Terms of these series: 2^24 REACH^24 / 24! is 2e-24.
const TERMS: u32 = 24;

/// Number of flights whose work is found together: each entry of a form is read once for all.
pub(super) const ABREAST: usize = 8;

/// One number of each of them.
pub(super) type Abreast = [f64; ABREAST];

/// Displacements and velocities at the start of a flight, and the ground's acceleration, m/s2, and its slope, m/s3.
pub(super) type Flying<'a> = ((&'a [f64], &'a [f64]), (f64, f64));

/// The work over a flight of one length, of one body.
#[derive(Clone, Debug)]
pub(super) struct CoupledWork {
    /// First mode and number of modes.
    offset: usize,
    count: usize,
    /// Work of all damping.
    viscous: Form,
    /// Work of the dashpots of links, each with the number of its link.
    links: Vec<(usize, Work)>,
    /// w^2 / 2 of what moves in flights, 1/s2.
    half_omega2: Vec<f64>,
    /// Work of the ground motion: rows over z that are multiplied by its acceleration and its slope.
    input: [RowDVector<f64>; 2],
}

/// The work of a dashpot.
#[derive(Clone, Debug)]
enum Work {
    /// Squares of its rate at the points of a quadrature, where these are few.
    Squares(Squares),
    Form(Form),
}

/// What several flights do, and the energies at their starts, J; where oscillators move, as if they were modes.
#[derive(Default)]
pub(super) struct CoupledEnergy {
    pub(super) input: Abreast,
    pub(super) viscous: Abreast,
    pub(super) kinetic: Abreast,
    pub(super) strain: Abreast,
}

impl CoupledEnergy {
    /// Adds those of another body.
    pub(super) fn add(&mut self, CoupledEnergy { input, viscous, kinetic, strain }: &CoupledEnergy) {
        let sums = [&mut self.input, &mut self.viscous, &mut self.kinetic, &mut self.strain];
        sums.into_iter().zip([input, viscous, kinetic, strain]).for_each(|(sums, numbers)| add(sums, numbers));
    }
}

impl Work {
    /// Of a rate, a row over the velocities of modes, whose square is the power, over z = P y instead of z.
    fn of_rate(rates: &Rates, rate: &RowDVector<f64>, length: f64, over: Option<&DMatrix<f64>>) -> Work {
        let doublings = rates.doublings(length, POINTS_REACH);
        if (TWELVE_POINTS.len() << doublings.min(16)) * 2 > rates.size() {
            return Work::Form(rates.form_over(&(rate.transpose() * rate), length, over));
        }
        let h = libm::ldexp(length, -doublings);
        let mut rows = rates.at_points(rate, h);
        let mut onward = rates.transition_over(h);
        for _ in 0..doublings {
            let later = &rows * &onward;
            rows = DMatrix::from_fn(2 * rows.nrows(), rows.ncols(), |i, j| {
                if i < rows.nrows() { rows[(i, j)] } else { later[(i - rows.nrows(), j)] }
            });
            onward = &onward * &onward;
        }
        Work::Squares(Squares::of(&over.map_or(rows.clone(), |over| rows * over)))
    }

    fn of_vectors(&self, z: &[Abreast]) -> Abreast {
        match self {
            Work::Squares(squares) => squares.of_vectors(z),
            Work::Form(form) => form.of_vectors(z),
        }
    }
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
            fastest: structure.fastest,
        };
        let to_modes = structure.oscillators().and_then(|flight| flight.map_of(range.start));
        let over = to_modes.map(|to_modes| {
            let mut over = DMatrix::identity(rates.size(), rates.size());
            over.view_mut((0, 0), (2 * n, 2 * n)).copy_from(to_modes);
            over
        });
        let of_links = structure.links.iter().enumerate().filter(|(_, link)| link.body == number && link.dashpot > 0.0);
        let links = of_links.map(|(l, link)| {
            let rate = RowDVector::from_row_slice(&link.row[range.clone()]) * link.dashpot.sqrt();
            (l, Work::of_rate(&rates, &rate, length, over.as_ref()))
        });
        let input = rates.input_over(length);
        Some(CoupledWork {
            offset: range.start,
            count: n,
            links: links.collect(),
            half_omega2: structure.in_flight().omega2[range.clone()].iter().map(|w2| 0.5 * w2).collect(),
            viscous: rates.form_over(damping, length, over.as_ref()),
            input: over.as_ref().map_or(input.clone(), |over| input.map(|row| row * over)),
        })
    }

    /// What several flights do side by side; adds that of the dashpots of links.
    pub(super) fn over<'a>(
        &self,
        flights: impl Iterator<Item = Flying<'a>>,
        z: &mut Vec<Abreast>,
        dashpots: &mut [Abreast],
    ) -> CoupledEnergy {
        let n = self.count;
        z.clear();
        z.resize((2 * n + 2).next_multiple_of(LANES), [0.0; ABREAST]);
        let (of_q, rest) = z.split_at_mut(n);
        let (of_v, of_ground) = rest.split_at_mut(n);
        for (k, ((q, v), (a, s))) in flights.enumerate() {
            let own = self.offset..self.offset + n;
            of_q.iter_mut().zip(&q[own.clone()]).for_each(|(z, q)| z[k] = *q);
            of_v.iter_mut().zip(&v[own]).for_each(|(z, v)| z[k] = *v);
            (of_ground[0][k], of_ground[1][k]) = (a, s);
        }
        for (l, work) in &self.links {
            add(&mut dashpots[*l], &work.of_vectors(z));
        }
        let [held, rising] = self.input.each_ref().map(|row| times_vectors(row.as_slice(), z));
        CoupledEnergy {
            input: std::array::from_fn(|k| z[2 * n][k] * held[k] + z[2 * n + 1][k] * rising[k]),
            viscous: self.viscous.of_vectors(z),
            kinetic: squares(std::iter::repeat(&0.5), &z[n..2 * n]),
            strain: squares(self.half_omega2.iter(), &z[..n]),
        }
    }
}

/// Adds numbers to others.
fn add(sums: &mut Abreast, numbers: &Abreast) {
    sums.iter_mut().zip(numbers).for_each(|(sum, number)| *sum += number);
}

/// The sum of weights times squares, of several vectors side by side.
fn squares<'a>(weights: impl Iterator<Item = &'a f64>, z: &[Abreast]) -> Abreast {
    let mut sums = [0.0; ABREAST];
    for (weight, numbers) in weights.zip(z) {
        for k in 0..ABREAST {
            sums[k] += weight * numbers[k] * numbers[k];
        }
    }
    sums
}

/// A row times several vectors, side by side.
fn times_vectors(row: &[f64], z: &[Abreast]) -> Abreast {
    let mut sums = [0.0; ABREAST];
    for (entry, numbers) in row.iter().zip(z) {
        for k in 0..ABREAST {
            sums[k] += entry * numbers[k];
        }
    }
    sums
}

/// A of one body.
struct Rates<'a> {
    omega2: &'a [f64],
    participation: &'a [f64],
    damping: &'a DMatrix<f64>,
    /// Fastest rate of the structure, 1/s.
    fastest: f64,
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

    /// Number of doublings from a time within reach of a series or rule to a length, s.
    fn doublings(&self, length: f64, reach: f64) -> i32 {
        libm::log2(self.fastest * length / reach).ceil().clamp(0.0, 1000.0) as i32
    }

    /// W of a damping matrix over a length, s, over z = P y instead of z.
    fn form_over(&self, damping: &DMatrix<f64>, length: f64, over: Option<&DMatrix<f64>>) -> Form {
        let doublings = self.doublings(length, REACH);
        let h = libm::ldexp(length, -doublings);
        let (mut form, mut onward) = (self.form(damping, h), self.transition(h));
        for _ in 0..doublings {
            form += onward.tr_mul(&(&form * &onward));
            onward = &onward * &onward;
        }
        Form::of(&over.map_or(form.clone(), |over| over.tr_mul(&(&form * over))), 0)
    }

    /// The rows of the work of the ground motion over a length, s.
    fn input_over(&self, length: f64) -> [RowDVector<f64>; 2] {
        let doublings = self.doublings(length, REACH);
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
        let doublings = self.doublings(length, REACH);
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
