//! The largest magnitude of a quantity by power series of the motion: of a flight piece by piece, or of a step in
//! contact.

use crate::engine::base::Coordinates;
use crate::engine::base::peaks::Peaks;
use crate::engine::bounds::cubic::course_of;
use crate::engine::bounds::envelope::stay_below;
use crate::engine::bounds::stretch::{ModeBounds, Stretch};
use crate::engine::model::Model;
use crate::engine::peaks::room::{MOST_FLOWN, PeakWork, Suspect};
use crate::engine::quantities::rows::{BuildingRows, PeakOf};
use crate::engine::system::buffers::Buffers;
use crate::numerics::polynomial::{Coefficients, MAX_ORDER, MAX_TERMS, larger};
use crate::numerics::powers::{Powers, Reading};
use crate::numerics::roots;
use crate::numerics::substitution::Substitution;
use crate::structure::{EXACT, LANES, MotionSeries, Side, dot, flight_order};
use std::ops::Range;

/// Length of a piece, in units of 1 / (fastest rate), that one series reaches.
const REACH: f64 = 1.5;

/// Largest number of halvings of pieces of a flight: then they are as short as rounding.
const MOST_HALVINGS: u32 = 40;

/// A piece of a flight, from one time since its start to another, s, and the number of times that it may be halved.
#[derive(Clone, Copy)]
struct Piece {
    from: f64,
    to: f64,
    halvings: u32,
}

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
}

impl Model {
    /// Raises the peaks of the quantities that may exceed theirs within a flight. They are searched for in the whole
    /// flight, so that a turning point has the same bits whatever part is asked for, and all together: many of them
    /// turn at about the same time.
    pub(in crate::engine) fn search_flight(&self, flight: &Stretch, peaks: &mut Peaks, work: &mut PeakWork) {
        if work.peaks.suspects.is_empty() {
            return;
        }
        let mut suspects = std::mem::take(&mut work.peaks.suspects);
        let (until, flight) = (flight.length, flight.whole.unwrap_or(flight));
        let whole = Piece { from: 0.0, to: flight.length, halvings: MOST_HALVINGS };
        self.search_piece(flight, whole, until, &mut suspects, work);
        suspects.drain(..).for_each(|suspect| peaks.raise(suspect.place, suspect.peak));
        work.peaks.suspects = suspects;
    }

    /// Searches a piece, as far as it lies in the first `until` seconds of the flight. A piece too long for one series
    /// is halved, for the quantities that its ends do not prove to stay below their peaks in it.
    fn search_piece(&self, flight: &Stretch, piece: Piece, until: f64, suspects: &mut [Suspect], work: &mut PeakWork) {
        let Piece { from, to, halvings } = piece;
        if from >= until {
            return;
        }
        // Those that are cleared here are open again in the next piece.
        for suspect in suspects.iter_mut().filter(|suspect| suspect.cleared_in.is_none()) {
            match suspect.pieces_left {
                0 => suspect.cleared_in = Some(halvings),
                _ => suspect.pieces_left -= 1,
            }
        }
        let is_long = self.system.structure.fastest * (to - from) > REACH && halvings > 0;
        if is_long && are_any_left(suspects) {
            self.fly_to(flight, from, [0, 1], work);
            self.fly_to(flight, to, [2, 3], work);
            self.compare_ends(flight, piece, until, suspects, work);
        }
        if are_any_left(suspects) {
            match is_long {
                true => {
                    let (middle, halvings) = (from + 0.5 * (to - from), halvings - 1);
                    self.search_piece(flight, Piece { from, to: middle, halvings }, until, suspects, work);
                    self.search_piece(flight, Piece { from: middle, to, halvings }, until, suspects, work);
                }
                false => self.read_piece(flight, piece, until, suspects, work),
            }
        }
        for suspect in suspects.iter_mut().filter(|suspect| suspect.cleared_in == Some(halvings)) {
            suspect.cleared_in = None;
        }
    }

    /// Finds the largest magnitudes within a piece by its series.
    fn read_piece(&self, flight: &Stretch, piece: Piece, until: f64, suspects: &mut [Suspect], work: &mut PeakWork) {
        let Piece { from, to, .. } = piece;
        let (mut rows, (ground, slope)) = (std::mem::take(&mut work.peaks.rows), flight.ground);
        let end = if until < to { (until - from) / (to - from) } else { 1.0 };
        self.expand_piece(flight, (from, to), work);
        for suspect in suspects.iter_mut().filter(|suspect| suspect.cleared_in.is_none()) {
            let of = suspect.of;
            let lanes = self.set_rows(of, Coordinates::Modes, &mut rows);
            let span = self.span_of(of.side(), Coordinates::Modes);
            let at_rest = flight.rest[suspect.place];
            let quantity = Quantity { of, rows: &rows, lanes, span, at_rest, ground: (ground + slope * from, slope) };
            let (terms, order) = quantity.terms(&work.buffers.series, None);
            suspect.peak = highest(&terms, (end, order), suspect.peak, &mut work.buffers.powers);
        }
        work.peaks.rows = rows;
    }

    /// Expands a piece of a flight into a power series.
    fn expand_piece(&self, flight: &Stretch, (from, to): (f64, f64), work: &mut PeakWork) {
        self.fly_to(flight, from, [0, 1], work);
        self.set_load(flight, from, work);
        let order = flight_order(self.system.structure.fastest * (to - from), EXACT).unwrap_or(MAX_ORDER);
        let PeakWork { buffers: Buffers { series, .. }, peaks } = work;
        let ([q, v, ..], load) = (&peaks.pieces, &peaks.load);
        series.expand_flight(&self.system.structure, (q, v), (load, flight.loads.1), (to - from, order));
    }

    /// Works out the motion at a time of a flight in two of the vectors `pieces`.
    fn fly_to(&self, flight: &Stretch, time: f64, into: [usize; 2], work: &mut PeakWork) {
        let PeakWork { buffers: Buffers { interval, scratch, .. }, peaks } = work;
        let Ok([q, v]) = peaks.pieces.get_disjoint_mut(into) else { return };
        let known = match time {
            _ if time == 0.0 => flight.start,
            _ if time == flight.length => flight.end,
            _ => {
                let place = peaks.flown.iter().position(|flown| flown.time == time).unwrap_or_else(|| {
                    let place = peaks.next_flown;
                    peaks.next_flown = (place + 1) % MOST_FLOWN;
                    let flown = &mut peaks.flown[place];
                    interval.prepare(&self.system.structure, time);
                    interval.fly(flight.start, flight.loads, (&mut flown.q, &mut flown.v), scratch);
                    flown.time = time;
                    place
                });
                (&peaks.flown[place].q[..], &peaks.flown[place].v[..])
            }
        };
        q.copy_from_slice(known.0);
        v.copy_from_slice(known.1);
    }

    /// Works out the modal load at a time of a flight.
    fn set_load(&self, flight: &Stretch, time: f64, work: &mut PeakWork) {
        let (start, slope) = flight.loads;
        for (load, (start, slope)) in work.peaks.load.iter_mut().zip(start.iter().zip(slope)) {
            *load = start + slope * time;
        }
    }

    /// Raises the peaks to the ends of a piece, whose motions are in `pieces`, and clears the quantities that cannot
    /// exceed theirs in between.
    fn compare_ends(&self, flight: &Stretch, piece: Piece, until: f64, suspects: &mut [Suspect], work: &mut PeakWork) {
        self.set_load(flight, piece.from, work);
        let PeakWork { buffers: Buffers { node_v: jerk, .. }, peaks } = work;
        let [q, v, end_q, end_v] = &peaks.pieces;
        let own = Stretch {
            start: (q, v),
            end: (end_q, end_v),
            loads: (&peaks.load, flight.loads.1),
            length: piece.to - piece.from,
            is_watched: false,
            whole: None,
            ..*flight
        };
        let mut bounded = None;
        for suspects in suspects.chunk_by_mut(|one, next| one.place / LANES == next.place / LANES) {
            let Some(side) = suspects.iter().find(|s| s.cleared_in.is_none()).map(|s| s.of.side()) else { continue };
            let building = &self.peak_rows.buildings[side as usize];
            if bounded.replace(side) != Some(side) {
                peaks.piece.set(&self.system.structure, building.modes.clone(), &own, jerk);
            }
            self.compare_block(building, (&own, piece, until), suspects, (&peaks.piece, &peaks.direct));
        }
    }

    /// The same for the quantities of one block.
    fn compare_block(
        &self,
        building: &BuildingRows,
        (own, piece, until): (&Stretch, Piece, f64),
        suspects: &mut [Suspect],
        (bounds, direct): (&ModeBounds, &[[f64; 2]]),
    ) {
        let (number, modes) = (suspects[0].place / LANES, &building.modes);
        let block = &building.blocks[number - building.first];
        let direct = self.system.floor_forces.then_some((&direct[number * LANES..], piece.from, own.length));
        let mut known = [f64::INFINITY; LANES];
        let is_open = |suspect: &&mut Suspect| suspect.cleared_in.is_none();
        suspects.iter_mut().filter(is_open).for_each(|suspect| known[suspect.place % LANES] = suspect.peak);
        let at_rest = own.rest.as_chunks::<LANES>().0[number];
        let are_below = stay_below(&known, (block, &at_rest), (bounds, modes), direct);
        if are_below == [true; LANES] {
            suspects.iter_mut().filter(is_open).for_each(|suspect| suspect.cleared_in = Some(piece.halvings));
            return;
        }
        let mut course = course_of((block, &at_rest), (own, None), bounds, modes.clone());
        if let Some((direct, from, length)) = direct {
            course.add(direct, from, length);
        }
        for suspect in suspects.iter_mut().filter(is_open) {
            let lane = suspect.place % LANES;
            if !are_below[lane] {
                let end = if piece.to <= until { course.end[0][lane].abs() } else { 0.0 };
                suspect.peak = larger(suspect.peak, larger(course.start[0][lane].abs(), end));
            }
            if are_below[lane] || !course.may_turn_above(lane, own.length, suspect.peak) {
                suspect.cleared_in = Some(piece.halvings);
            }
        }
    }

    /// The first lane of a building in some coordinates, and the one after its last.
    pub(in crate::engine) fn span_of(&self, side: Side, coordinates: Coordinates) -> (usize, usize) {
        let lanes = match coordinates {
            Coordinates::Modes => self.system.structure.range(side),
            Coordinates::Floors => self.system.structure.floors.lanes_of(side as usize),
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
        let structure = &self.system.structure;
        let side = of.side() as usize;
        if coordinates == Coordinates::Floors {
            let lane = |floor| structure.floors.lane(side, floor);
            match of {
                PeakOf::Displacement(_, floor) | PeakOf::Acceleration(_, floor) => return Some((lane(floor), None)),
                PeakOf::Drift(_, floor) => return Some((lane(floor), floor.checked_sub(1).map(lane))),
                PeakOf::BaseShear(_) => {}
            }
        }
        let [row, row_v] = rows;
        row.fill(0.0);
        row_v.fill(0.0);
        let of_shape = match of {
            PeakOf::Acceleration(side, floor) => PeakOf::Displacement(side, floor),
            _ => of,
        };
        match coordinates {
            Coordinates::Modes => {
                let (building, place) = (&self.peak_rows.buildings[side], self.peak_rows.place(of_shape));
                let (block, lane) = (&building.blocks[place / LANES - building.first], place % LANES);
                for (m, a) in building.modes.clone().zip(&block.on_q) {
                    row[m] = a[lane];
                }
                for (m, b) in building.modes.clone().zip(&block.on_v) {
                    row_v[m] = b[lane];
                }
            }
            Coordinates::Floors => self.resistance.set_shear_rows(side, structure.floors.lanes_of(side), row, row_v),
        }
        None
    }
}

/// Whether any quantity may exceed its peak in the piece that is searched.
fn are_any_left(suspects: &[Suspect]) -> bool {
    suspects.iter().any(|suspect| suspect.cleared_in.is_none())
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
            PeakOf::BaseShear(_) => dot(&self.rows[1], rate),
            PeakOf::Displacement(..) | PeakOf::Drift(..) | PeakOf::Acceleration(..) => 0.0,
        }
    }

    /// The power series of the quantity and its highest power, in the x of the motion's series; `substitution` changes
    /// the variable to that of a time map.
    pub fn terms(&self, series: &MotionSeries, substitution: Option<&Substitution>) -> (Coefficients, usize) {
        let (count, per_unit) = (series.order + 1, 1.0 / series.scale);
        let (mut of_q, mut terms) = ([0.0; MAX_TERMS], [0.0; MAX_TERMS]);
        match self.lanes {
            Some((lane, below)) => {
                let difference = |n: usize| series.term(n)[lane] - below.map_or(0.0, |below| series.term(n)[below]);
                of_q.iter_mut().enumerate().take(count).for_each(|(n, term)| *term = difference(n));
            }
            None => series.dot_each_in(self.span(), &self.rows[0], 0, &mut of_q),
        }
        // Each derivative loses a power.
        let order = match self.of {
            PeakOf::Displacement(..) | PeakOf::Drift(..) => {
                terms = of_q;
                series.order
            }
            PeakOf::Acceleration(..) => {
                for n in 2..count {
                    terms[n - 2] = (n * (n - 1)) as f64 * (of_q[n] * per_unit * per_unit);
                }
                terms[0] += self.ground.0;
                terms[1] += self.ground.1 * series.scale;
                series.order - 2
            }
            PeakOf::BaseShear(_) => {
                let mut of_v = [0.0; MAX_TERMS];
                series.dot_each_in(self.span(), &self.rows[1], 0, &mut of_v);
                for n in 0..series.order {
                    terms[n] = of_q[n] + (n + 1) as f64 * of_v[n + 1] * per_unit;
                }
                series.order - 1
            }
        };
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
    let Reading { value, slope, fourth } = powers.read(terms);
    let mut peak = known;
    for sign in [1.0, -1.0] {
        let copy = |out: &mut Coefficients| {
            out.iter_mut().zip(terms).for_each(|(out, term)| *out = sign * term);
            order + 1
        };
        let end = Reading { value: sign * value, slope: sign * slope, fourth };
        let top = roots::maximum_above((sign * terms[0], sign * terms[1]), x, &end, peak, copy);
        peak = top.map_or(peak, |(at, value)| larger(peak, value_at(at, value)));
    }
    peak
}
