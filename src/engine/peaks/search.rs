//! The largest magnitude of one quantity in the power series of a motion: of a flight, piece by piece, or of a step in
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

/// (Fastest rate) x (time) that one series reaches.
const REACH: f64 = 1.5;

/// Pieces of a flight are halved so often at most: then they are as short as rounding.
const MOST_HALVINGS: u32 = 40;

/// Pieces in which one flight is searched for one quantity. Only free vibration without end has more, of several modes that
/// nothing damps, over thousands of periods in one communication step: what it may reach later is not looked for.
const MOST_PIECES: u32 = 10_000;

/// A piece of a flight: from one time of it to another, s, and how often it may be halved.
#[derive(Clone, Copy)]
struct Piece {
    from: f64,
    to: f64,
    halvings: u32,
}

/// A quantity as rows over a motion in some coordinates.
pub struct Quantity<'a> {
    pub of: PeakOf,
    /// Over the motion, and over its rate; of an acceleration, those of the floor's displacement.
    pub rows: &'a [Vec<f64>; 2],
    /// The first row where it is 1 in one lane, and -1 in another one perhaps.
    pub lanes: Option<(usize, Option<usize>)>,
    /// m/s2 and m/s3, of the ground at the start of the series.
    pub ground: (f64, f64),
}

impl Model {
    /// The largest magnitude of a quantity over the first seconds of a flight, `until` then, or `known` if that is larger.
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

    /// The same over a piece: where the modes are too fast for one series, halves are looked at, unless the ends show that
    /// there is nothing to be found.
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

    /// The motion at a time of a flight, into two vectors of the room.
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

    /// The modal load at a time of a flight, into the room.
    fn set_load(&self, flight: &Stretch, time: f64, work: &mut PeakWork) {
        let (start, slope) = flight.loads;
        for (load, (start, slope)) in work.peaks.load.iter_mut().zip(start.iter().zip(slope)) {
            *load = start + slope * time;
        }
    }

    /// The largest of `known` and the magnitudes at the ends of a piece, whose motions are in the room, and whether the
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

    /// The rows of a quantity in some coordinates; or the lanes that say the same.
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
    /// What the first row makes of a vector of motion.
    pub fn of_motion(&self, motion: &[f64]) -> f64 {
        match self.lanes {
            Some((lane, below)) => motion[lane] - below.map_or(0.0, |below| motion[below]),
            None => dot(&self.rows[0], motion),
        }
    }

    /// What the second row makes of a vector of its rate.
    pub fn of_rate(&self, rate: &[f64]) -> f64 {
        match self.of {
            PeakOf::BaseShear(_) => dot(&self.rows[1], rate),
            PeakOf::Displacement(..) | PeakOf::Drift(..) | PeakOf::Acceleration(..) => 0.0,
        }
    }

    /// The power series of the quantity in the x of a motion's, and its highest power; `substitution` makes it one where a
    /// time map does.
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
        // Derivatives are known to fewer powers.
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

/// The largest magnitude of a polynomial over 0..=x, or `known` if that is larger; `powers` is room to work in.
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
