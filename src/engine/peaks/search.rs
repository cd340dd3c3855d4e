//! The largest magnitude of a quantity by power series of the motion: of a flight piece by piece, or of a step in
//! contact.

use crate::engine::base::Coordinates;
use crate::engine::model::Model;
use crate::engine::peaks::flight::{Stretch, course_of, stays_below};
use crate::engine::peaks::room::{MOST_FLOWN, PeakWork};
use crate::engine::system::buffers::Buffers;
use crate::engine::watched::rows::PeakOf;
use crate::numerics::polynomial::{Coefficients, MAX_ORDER, MAX_TERMS, larger};
use crate::numerics::powers::{Powers, Reading};
use crate::numerics::roots;
use crate::numerics::substitution::Substitution;
use crate::structure::{EXACT, LANES, MotionSeries, dot, flight_order};

/// Length of a piece, in units of 1 / (fastest rate), that one series reaches.
const REACH: f64 = 1.5;

/// Largest number of halvings of pieces of a flight: then they are as short as rounding.
const MOST_HALVINGS: u32 = 40;

/// Largest number of pieces in which a flight is searched for one quantity. Only the undamped free vibration of several
/// modes over thousands of periods in one communication step needs more; maxima that it reaches later are missed.
const MOST_PIECES: u32 = 10_000;

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
    /// Ground acceleration at the start of the series, m/s2, and its slope, m/s3.
    pub ground: (f64, f64),
}

impl Model {
    /// The largest magnitude of a quantity over the first `until` seconds of a flight, or `known` if that is larger.
    pub(in crate::engine) fn highest_in_flight(
        &self,
        flight: &Stretch,
        of: PeakOf,
        (known, until): (f64, f64),
        work: &mut PeakWork,
    ) -> f64 {
        let mut rows = std::mem::take(&mut work.peaks.rows);
        let lanes = self.set_rows(of, Coordinates::Modes, &mut rows);
        let quantity = Quantity { of, rows: &rows, lanes, ground: flight.ground };
        let whole = Piece { from: 0.0, to: flight.length, halvings: MOST_HALVINGS };
        work.peaks.pieces_left = MOST_PIECES;
        let peak = self.highest_in_piece(flight, &quantity, whole, (known, until), work);
        work.peaks.rows = rows;
        peak
    }

    /// The largest magnitude over a piece, or `known` if that is larger. A piece too long for one series is halved,
    /// unless its ends prove that the quantity does not exceed `known` in it.
    fn highest_in_piece(
        &self,
        flight: &Stretch,
        quantity: &Quantity,
        piece: Piece,
        (known, until): (f64, f64),
        work: &mut PeakWork,
    ) -> f64 {
        let Piece { from, to, halvings } = piece;
        let reach = self.system.structure.fastest * (to - from);
        if from >= until || work.peaks.pieces_left == 0 {
            return known;
        }
        work.peaks.pieces_left -= 1;
        if reach > REACH && halvings > 0 {
            self.fly_to(flight, from, [0, 1], work);
            self.fly_to(flight, to, [2, 3], work);
            let (known, may_be_higher) = self.compare_ends(flight, quantity.of, piece, (known, until), work);
            if !may_be_higher {
                return known;
            }
            let (middle, halvings) = (from + 0.5 * (to - from), halvings - 1);
            let first = Piece { from, to: middle, halvings };
            let known = self.highest_in_piece(flight, quantity, first, (known, until), work);
            return self.highest_in_piece(flight, quantity, Piece { from: middle, to, halvings }, (known, until), work);
        }
        if work.peaks.expanded != Some((from, to)) {
            self.expand_piece(flight, (from, to), work);
        }
        let (series, (ground, slope)) = (&work.buffers.series, quantity.ground);
        let (terms, order) = Quantity { ground: (ground + slope * from, slope), ..*quantity }.terms(series, None);
        let end = if until < to { (until - from) / (to - from) } else { 1.0 };
        highest(&terms, (end, order), known, &mut work.buffers.powers)
    }

    /// Expands a piece of a flight into a power series.
    fn expand_piece(&self, flight: &Stretch, (from, to): (f64, f64), work: &mut PeakWork) {
        self.fly_to(flight, from, [0, 1], work);
        self.set_load(flight, from, work);
        let order = flight_order(self.system.structure.fastest * (to - from), EXACT).unwrap_or(MAX_ORDER);
        let PeakWork { buffers: Buffers { series, .. }, peaks } = work;
        let ([q, v, ..], load) = (&peaks.pieces, &peaks.load);
        series.expand_flight(&self.system.structure, (q, v), (load, flight.loads.1), (to - from, order));
        peaks.expanded = Some((from, to));
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

    /// The largest of `known` and the magnitudes at the ends of a piece, whose motions are in `pieces`, and whether the
    /// quantity may exceed it in between.
    fn compare_ends(
        &self,
        flight: &Stretch,
        of: PeakOf,
        piece: Piece,
        (known, until): (f64, f64),
        work: &mut PeakWork,
    ) -> (f64, bool) {
        let Piece { from, to, .. } = piece;
        self.set_load(flight, from, work);
        let PeakWork { buffers: Buffers { node_v: jerk, .. }, peaks } = work;
        let building = &self.peak_rows.buildings[of.side() as usize];
        let place = self.peak_rows.place(of);
        let (block, lane) = (&building.blocks[place / LANES - building.first], place % LANES);
        let [q, v, end_q, end_v] = &peaks.pieces;
        let own = Stretch {
            start: (q, v),
            end: (end_q, end_v),
            loads: (&peaks.load, flight.loads.1),
            length: to - from,
            whole: None,
            ..*flight
        };
        self.bound_modes(building, &own, &mut peaks.piece, jerk);
        let direct = &peaks.direct[place - lane..];
        let (known_lane, modes) =
            (std::array::from_fn(|i| if i == lane { known } else { f64::INFINITY }), &building.modes);
        let added = self.system.floor_forces.then_some((direct, from, own.length));
        if stays_below(&known_lane, block, (&peaks.piece, modes), added) {
            return (known, false);
        }
        let mut course = course_of(block, &own, &peaks.piece, building.modes.clone());
        if self.system.floor_forces {
            course.add(direct, from, own.length);
        }
        let end = if to <= until { course.end[0][lane].abs() } else { 0.0 };
        let known = larger(known, larger(course.start[0][lane].abs(), end));
        (known, course.may_turn_above(lane, own.length, known))
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

impl Quantity<'_> {
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
            None => series.dot_each(&self.rows[0], 0, &mut of_q),
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
                series.dot_each(&self.rows[1], 0, &mut of_v);
                for n in 0..series.order {
                    terms[n] = of_q[n] + (n + 1) as f64 * of_v[n + 1] * per_unit;
                }
                series.order - 1
            }
        };
        if series.time_map.is_curved()
            && let Some(substitution) = substitution
        {
            substitution.apply_to_one(&mut terms[..=order]);
        }
        (terms, order)
    }
}

/// The largest magnitude of a polynomial over 0..=x, or `known` if that is larger; `powers` is scratch.
pub fn highest(terms: &Coefficients, (x, order): (f64, usize), known: f64, powers: &mut Powers) -> f64 {
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
        peak = top.map_or(peak, |(_, value)| value);
    }
    peak
}
