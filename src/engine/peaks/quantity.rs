//! One quantity as rows over the motion: its values, its power series, and the largest magnitude of a series.

use crate::engine::quantities::rows::PeakOf;
use crate::numerics::polynomial::{Coefficients, MAX_TERMS, larger};
use crate::numerics::powers::{Evaluation, Powers};
use crate::numerics::roots;
use crate::numerics::substitution::Substitution;
use crate::structure::{MotionSeries, dot};
use std::ops::Range;

/// A quantity as rows over the motion in some coordinates.
pub struct Quantity<'a> {
    pub of: PeakOf,
    /// A row over the motion and one over its rate; of an acceleration, the rows of the floor's displacement.
    pub rows: &'a [Vec<f64>; 2],
    /// The lanes of the first row's 1 and, for a drift, -1, where it has no other entries.
    pub lanes: Option<(usize, Option<usize>)>,
    /// The first of the lanes outside of which both rows are 0, and the one after the last.
    pub span: (usize, usize),
    /// What is added to the product of its rows and the motion: its value at rest.
    pub at_rest: f64,
    /// Ground acceleration at the start of the series, m/s2, and its slope, m/s3.
    pub ground: (f64, f64),
    /// Whether its rows are over oscillators: then the second one counts for every quantity.
    pub oscillates: bool,
}

impl Quantity<'_> {
    fn span(&self) -> Range<usize> {
        self.span.0..self.span.1
    }

    /// Product of the first row with a vector of motion.
    pub fn of_motion(&self, motion: &[f64]) -> f64 {
        match self.lanes {
            Some((lane, below)) => motion[lane] - below.map_or(0.0, |below| motion[below]),
            None => dot(&self.rows[0], motion),
        }
    }

    /// Product of the second row with a vector of the motion's rate.
    pub fn of_rate(&self, rate: &[f64]) -> f64 {
        match self.of {
            PeakOf::BaseShear(_) | PeakOf::LinkForce(_) => dot(&self.rows[1], rate),
            _ => 0.0,
        }
    }

    /// The power series of the quantity and its highest power, in the x of the motion's series; `substitution` changes
    /// the variable to that of a time map.
    pub fn terms(&self, series: &MotionSeries, substitution: Option<&Substitution>) -> (Coefficients, usize) {
        let (count, per_unit) = (series.order + 1, 1.0 / series.scale);
        let mut terms = [0.0; MAX_TERMS];
        match self.lanes {
            Some((lane, below)) => {
                let difference = |n: usize| series.term(n)[lane] - below.map_or(0.0, |below| series.term(n)[below]);
                terms.iter_mut().enumerate().take(count).for_each(|(n, term)| *term = difference(n));
            }
            None => series.dot_each_in(self.span(), &self.rows[0], 0, &mut terms),
        }
        // Each derivative loses a power.
        let mut order = series.order;
        if self.oscillates || matches!(self.of, PeakOf::BaseShear(_) | PeakOf::LinkForce(_)) {
            let mut of_rates = [0.0; MAX_TERMS];
            series.dot_each_in(self.span(), &self.rows[1], 0, &mut of_rates);
            (0..order).for_each(|n| terms[n] += (n + 1) as f64 * of_rates[n + 1] * per_unit);
            order -= 1;
        }
        if let PeakOf::Acceleration(..) = self.of {
            (2..=order).for_each(|n| terms[n - 2] = (n * (n - 1)) as f64 * (terms[n] * per_unit * per_unit));
            terms[0] += self.ground.0;
            terms[1] += self.ground.1 * series.scale;
            order -= 2;
        }
        terms[0] += self.at_rest;
        if series.time_map.is_curved()
            && let Some(substitution) = substitution
        {
            substitution.apply_to_one(&mut terms[..=order]);
        }
        (terms, order)
    }
}

/// The largest magnitude of a polynomial over 0..=x, or `known` if that is larger; `powers` is scratch.
pub fn highest(terms: &Coefficients, end: (f64, usize), known: f64, powers: &mut Powers) -> f64 {
    highest_by(terms, end, known, powers, |_, value| value)
}

/// The same of a quantity that the polynomial is not quite: `value` gives its magnitude where that of the polynomial is
/// largest, from the x and the magnitude there.
pub fn highest_by(
    terms: &Coefficients,
    (x, order): (f64, usize),
    known: f64,
    powers: &mut Powers,
    mut value_at: impl FnMut(f64, f64) -> f64,
) -> f64 {
    powers.set(x, order);
    let Evaluation { value, slope, fourth } = powers.read(terms);
    let mut peak = known;
    for sign in [1.0, -1.0] {
        let copy = |out: &mut Coefficients| {
            out.iter_mut().zip(terms).for_each(|(out, term)| *out = sign * term);
            order + 1
        };
        let end = Evaluation { value: sign * value, slope: sign * slope, fourth };
        let top = roots::maximum_above((sign * terms[0], sign * terms[1]), x, &end, peak, copy);
        peak = top.map_or(peak, |(at, value)| larger(peak, value_at(at, value)));
    }
    peak
}
