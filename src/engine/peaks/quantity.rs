//! One quantity as rows over the motion: its values, its power series, and the largest magnitude of a series.

use crate::collocation::AtNodes;
use crate::contact::onset::{MOST_TERMS, derivatives};
use crate::engine::base::Coordinates;
use crate::engine::onset::series::OnsetSeries;
use crate::engine::peaks::PeakFinder;
use crate::engine::quantities::rows::{PeakOf, PeakRows};
use crate::engine::window::quantity::Share;
use crate::numerics::polynomial::{Coefficients, MAX_TERMS, larger};
use crate::numerics::powers::{Evaluation, Powers};
use crate::numerics::roots;
use crate::numerics::substitution::Substitution;
use crate::structure::{ImpulseResponse, LANES, LinearGround, MotionSeries, dot};
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
    /// What is added to the product of its rows and the motion, and its rate: its value at rest and what a master's
    /// pushes add at once. Accelerations have both in their motion.
    pub added: [f64; 2],
    /// From the start of the series on.
    pub ground: LinearGround,
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
        if self.has_dashpots() { dot(&self.rows[1], rate) } else { 0.0 }
    }

    /// Whether the rate of the motion is part of it.
    fn has_dashpots(&self) -> bool {
        matches!(self.of, PeakOf::BaseShear(_) | PeakOf::LinkForce(_))
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
        if self.oscillates || self.has_dashpots() {
            let mut of_rates = [0.0; MAX_TERMS];
            series.dot_each_in(self.span(), &self.rows[1], 0, &mut of_rates);
            (0..order).for_each(|n| terms[n] += (n + 1) as f64 * of_rates[n + 1] * per_unit);
            order -= 1;
        }
        let [value, rate] = match self.of {
            PeakOf::Acceleration(..) => {
                (2..=order).for_each(|n| terms[n - 2] = (n * (n - 1)) as f64 * (terms[n] * per_unit * per_unit));
                order -= 2;
                [self.ground.acceleration, self.ground.slope]
            }
            _ => self.added,
        };
        terms[0] += value;
        terms[1] += rate * series.scale;
        if series.time_map.is_curved()
            && let Some(substitution) = substitution
        {
            substitution.apply_to_one(&mut terms[..=order]);
        }
        (terms, order)
    }

    /// What the force of a pair, by its row over the modes, does to it in a window, by its moments of so many `powers`.
    pub fn share(&self, (response, powers): (&ImpulseResponse, usize), pair: &[f64]) -> Share {
        // Each derivative takes one power more.
        let of_row = |row: &[f64]| Share::of_kernel(&response.kernel_in((self.span(), powers + 2), row, pair));
        let share = of_row(&self.rows[0]);
        match self.of {
            PeakOf::Acceleration(..) => share.rate().rate(),
            _ if self.has_dashpots() => share.plus(&of_row(&self.rows[1]).rate()),
            _ => share,
        }
    }

    /// Its values at times of an onset step, s.
    pub fn in_onset(&self, onset: &OnsetSeries, times: &AtNodes) -> Option<AtNodes> {
        let (grid, per_unit) = (onset.grid.as_ref()?, 1.0 / onset.scale);
        let (x, [added, rate]) = (times.map(|time| time * per_unit), self.added);
        let mut terms = [0.0; MOST_TERMS];
        for (index, term) in terms.iter_mut().enumerate().take(grid.terms()) {
            *term = self.of_motion(onset.term(index));
        }
        if let PeakOf::Acceleration(..) = self.of {
            let [_, _, second] = derivatives(grid, &terms, &x);
            let ground = times.map(|time| self.ground.after(time));
            return Some(std::array::from_fn(|i| second[i] * per_unit * per_unit + ground[i]));
        }
        let [mut values] = derivatives(grid, &terms, &x);
        values.iter_mut().zip(times).for_each(|(value, time)| *value += added + rate * time);
        if self.has_dashpots() {
            (0..grid.terms()).for_each(|index| terms[index] = self.of_rate(onset.term(index)));
            let [_, slopes] = derivatives(grid, &terms, &x);
            values.iter_mut().zip(&slopes).for_each(|(value, slope): (&mut f64, &f64)| *value += slope * per_unit);
        }
        Some(values)
    }
}

impl PeakFinder<'_> {
    /// The first lane of a body in some coordinates, and the one after its last.
    pub(in crate::engine) fn span_of(&self, body: usize, coordinates: Coordinates) -> (usize, usize) {
        let body = &self.system.structure.bodies[body];
        let lanes = match coordinates {
            Coordinates::Modes => &body.range,
            Coordinates::Floors => &body.lanes,
        };
        (lanes.start, lanes.end)
    }

    /// Sets the rows of a quantity in some coordinates; returns the lanes of their entries if these are only 1 and -1.
    pub(in crate::engine) fn set_rows(
        &self,
        of: PeakOf,
        coordinates: Coordinates,
        rows: &mut [Vec<f64>; 2],
    ) -> Option<(usize, Option<usize>)> {
        rows.iter_mut().for_each(|row| row.fill(0.0));
        if coordinates == Coordinates::Floors {
            return self.set_rows_of_floors(of, rows);
        }
        self.set_rows_of_modes(of, &self.watched.rows, rows);
        None
    }

    /// The same for a flight.
    pub(super) fn set_flight_rows(&self, of: PeakOf, rows: &mut [Vec<f64>; 2]) {
        rows.iter_mut().for_each(|row| row.fill(0.0));
        self.set_rows_of_modes(of, self.watched.in_flight(), rows);
    }

    /// The same over modes or oscillators, from rows of zeros.
    fn set_rows_of_modes(&self, of: PeakOf, all: &PeakRows, [row, row_v]: &mut [Vec<f64>; 2]) {
        let place = all.place(match of {
            PeakOf::Acceleration(id, floor) => PeakOf::Displacement(id, floor),
            _ => of,
        });
        let (body, block) = all.block_of(place);
        for (m, a) in body.modes.clone().zip(&block.on_q) {
            row[m] = a[place % LANES];
        }
        for (m, b) in body.modes.clone().zip(&block.on_v) {
            row_v[m] = b[place % LANES];
        }
    }

    /// The same over the floors, from rows of zeros.
    fn set_rows_of_floors(&self, of: PeakOf, [row, row_v]: &mut [Vec<f64>; 2]) -> Option<(usize, Option<usize>)> {
        let floors = &self.system.structure.floors;
        match of {
            PeakOf::Displacement(id, floor) | PeakOf::Acceleration(id, floor) => Some((floors.lane(id, floor), None)),
            PeakOf::Drift(id, storey) => {
                let lane = floors.lane(id, storey);
                Some((lane, storey.checked_sub(1).map(|_| lane - 1)))
            }
            PeakOf::BaseShear(id) => {
                self.watched.resistance.set_shear_rows(id, floors.lanes_of(id), row, row_v);
                None
            }
            PeakOf::StoreyShear(id, storey) => {
                let number = self.system.number_of_correction((id, storey));
                let stiffness = number.and_then(|number| self.system.corrections[number].stiffness).unwrap_or(0.0);
                let lane = floors.lane(id, storey);
                row[lane] = stiffness;
                storey.checked_sub(1).iter().for_each(|_| row[lane - 1] = -stiffness);
                None
            }
            // Linked buildings move in modes.
            PeakOf::LinkDisplacement(_) | PeakOf::LinkForce(_) => None,
        }
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
