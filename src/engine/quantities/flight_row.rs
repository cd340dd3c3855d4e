//! A quantity in a flight, as rows over what moves there: modes, or the oscillators of complex modes.
//!
//! Of modes one row is enough, y = A q and y' = A q'. Of oscillators there is a row over the coordinates and one over their
//! rates: with x'' = -c x' - w^2 x and a part by the ground that cancels in the sum over all oscillators, as the rate of no
//! displacement jumps with the ground's acceleration,
//!
//! ```text
//! y = A x + B x',    y' = -w^2 B x + (A - c B) x'
//! ```
//!
//! For bounds by amplitudes e = sqrt(x'^2 + w^2 x^2) the size |A| + (w + c) |B| stands for |A|: it times e bounds |y'|, it
//! times (w + c) e bounds |y''|, and so on.

use crate::structure::{Motion, MotionSeries, Structure, difference, dot};

/// The rows of a quantity over oscillators.
#[derive(Clone, Debug)]
pub(crate) struct OscillatorRows {
    /// A and B.
    value: [Vec<f64>; 2],
    /// The same of its rate, and of its second derivative without the ground.
    rate: [Vec<f64>; 2],
    pull: [Vec<f64>; 2],
    sizes: Vec<f64>,
}

/// A row over displacements of the modes, with those over the oscillators, if these move in flights.
#[derive(Clone, Copy)]
pub(crate) enum FlightRow<'a> {
    OfModes(&'a [f64]),
    OfOscillators(&'a OscillatorRows),
}

impl OscillatorRows {
    /// Of a row over displacements of the modes; `None` where modes move in flights.
    pub(crate) fn of(structure: &Structure, row: &[f64]) -> Option<OscillatorRows> {
        let flight = structure.oscillators()?;
        let value = flight.rows([row, &vec![0.0; row.len()]]);
        let Structure { omega2, damping, quickness, .. } = structure.in_flight();
        let rate_of = |[a, b]: &[Vec<f64>; 2]| {
            let of = |m: usize| [-omega2[m] * b[m], a[m] - damping[m] * b[m]];
            [0, 1].map(|part| (0..row.len()).map(|m| of(m)[part]).collect::<Vec<f64>>())
        };
        let rate = rate_of(&value);
        let pull = rate_of(&rate);
        let sizes = (0..row.len()).map(|m| value[0][m].abs() + quickness[m] * value[1][m].abs()).collect();
        Some(OscillatorRows { value, rate, pull, sizes })
    }

    /// Its second derivative, without the part by the ground.
    #[inline(always)]
    pub(crate) fn pull(&self, motion: Motion) -> f64 {
        both(&self.pull, motion)
    }

    /// The row over the rates in its second derivative, which dashpots and springs make of the ground's push.
    pub(crate) fn pull_by_rates(&self) -> &[f64] {
        &self.pull[1]
    }
}

#[inline(always)]
fn both([a, b]: &[Vec<f64>; 2], Motion { q, v }: Motion) -> f64 {
    dot(a, q) + dot(b, v)
}

impl<'a> FlightRow<'a> {
    /// A row over the modes, or that over the oscillators, where they move in flights.
    pub(crate) fn of(row: &'a [f64], oscillating: Option<&'a OscillatorRows>) -> FlightRow<'a> {
        oscillating.map_or(FlightRow::OfModes(row), FlightRow::OfOscillators)
    }

    #[inline(always)]
    pub(crate) fn value(self, motion: Motion) -> f64 {
        match self {
            FlightRow::OfModes(row) => dot(row, motion.q),
            FlightRow::OfOscillators(rows) => both(&rows.value, motion),
        }
    }

    #[inline(always)]
    pub(crate) fn rate(self, motion: Motion) -> f64 {
        match self {
            FlightRow::OfModes(row) => dot(row, motion.v),
            FlightRow::OfOscillators(rows) => both(&rows.rate, motion),
        }
    }

    /// Entries for bounds by amplitudes; of modes with signs.
    pub(crate) fn sizes(self) -> &'a [f64] {
        match self {
            FlightRow::OfModes(row) => row,
            FlightRow::OfOscillators(rows) => &rows.sizes,
        }
    }

    /// A and B of one mode or oscillator.
    #[inline(always)]
    pub(crate) fn entries(self, m: usize) -> [f64; 2] {
        match self {
            FlightRow::OfModes(row) => [row[m], 0.0],
            FlightRow::OfOscillators(rows) => [rows.value[0][m], rows.value[1][m]],
        }
    }

    /// Sum of the magnitudes that a value is made of.
    pub(crate) fn size(self, Motion { q, v }: Motion) -> f64 {
        match self {
            FlightRow::OfModes(row) => difference(row, q).1,
            FlightRow::OfOscillators(rows) => difference(&rows.value[0], q).1 + difference(&rows.value[1], v).1,
        }
    }

    /// The same at the start of a series.
    pub(crate) fn size_at_start(self, series: &MotionSeries) -> f64 {
        match self {
            FlightRow::OfModes(row) => difference(row, series.term(0)).1,
            FlightRow::OfOscillators(rows) => {
                difference(&rows.sizes, series.term(0)).1 + difference(&rows.value[1], series.term(1)).1 / series.scale
            }
        }
    }

    /// Writes the power series of the quantity; returns the sum of the magnitudes of all that was added up, each term times
    /// its factor. Of oscillators the last term lacks the next one of their series, which is rounding in a flight.
    pub(crate) fn project(self, series: &MotionSeries, factors: &[f64], out: &mut [f64]) -> f64 {
        match self {
            FlightRow::OfModes(row) => series.project(row, factors, out),
            FlightRow::OfOscillators(rows) => {
                let mut whole = 0.0;
                for (n, (out, factor)) in out.iter_mut().zip(factors).enumerate().take(series.order + 1) {
                    let (mut value, mut size) = difference(&rows.value[0], series.term(n));
                    if n < series.order {
                        let (rate, of_rate) = difference(&rows.value[1], series.term(n + 1));
                        let per_time = (n + 1) as f64 / series.scale;
                        (value, size) = (value + per_time * rate, size + per_time * of_rate);
                    }
                    *out = if value.abs() <= 4.0 * f64::EPSILON * size { 0.0 } else { value };
                    whole += size * factor.abs();
                }
                whole
            }
        }
    }
}
