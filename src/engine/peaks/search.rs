//! The largest magnitude of one quantity in the power series of a motion: of a flight, piece by piece, or of a step in
//! contact.

use super::flight::{Flight, course_of};
use super::{PeakOf, larger};
use crate::clock::Bend;
use crate::engine::model::Model;
use crate::engine::roots;
use crate::engine::state::{Coordinates, Workspace};
use crate::polynomial::{Coefficients, MAX_ORDER, Powers, ROOM, Reading};
use crate::structure::{EXACT, LANES, MotionSeries, flight_order};

/// (Fastest rate) x (time) that one series reaches.
const REACH: f64 = 1.5;

/// Pieces of a flight are halved so often at most: then they are as short as rounding.
const MOST_HALVINGS: u32 = 40;

/// A piece of a flight: from one time of it to another, s, and how often it may be halved.
#[derive(Clone, Copy)]
struct Piece {
    from: f64,
    to: f64,
    halvings: u32,
}

/// A quantity as rows over a series in some coordinates.
pub(super) struct Quantity<'a> {
    pub of: PeakOf,
    /// Over its terms, and over those of its rate; of an acceleration, those of the floor's displacement.
    pub rows: &'a [Vec<f64>; 2],
    /// m/s2 and m/s3, of the ground at the start of the series.
    pub ground: (f64, f64),
}

impl Model {
    /// The largest magnitude of a quantity over a flight, or `known` if that is larger.
    pub(super) fn highest_in_flight(&self, flight: &Flight, of: PeakOf, known: f64, work: &mut Workspace) -> f64 {
        let mut rows = std::mem::take(&mut work.peaks.rows);
        self.set_rows(of, Coordinates::Modes, &mut rows);
        let quantity = Quantity { of, rows: &rows, ground: flight.ground };
        let whole = Piece { from: 0.0, to: flight.length, halvings: MOST_HALVINGS };
        let peak = self.highest_in_piece(flight, &quantity, whole, known, work);
        work.peaks.rows = rows;
        peak
    }

    /// The same over a piece: where the modes are too fast for one series, halves are looked at, unless the ends show that
    /// there is nothing to be found.
    fn highest_in_piece(
        &self,
        flight: &Flight,
        quantity: &Quantity,
        piece: Piece,
        known: f64,
        work: &mut Workspace,
    ) -> f64 {
        let Piece { from, to, halvings } = piece;
        let reach = self.structure.fastest * (to - from);
        self.fly_to(flight, from, [0, 1], work);
        if reach > REACH && halvings > 0 {
            self.fly_to(flight, to, [2, 3], work);
            let (known, may_be_higher) = self.compare_ends(flight, quantity.of, piece, known, work);
            if !may_be_higher {
                return known;
            }
            let (middle, halvings) = (from + 0.5 * (to - from), halvings - 1);
            let known = self.highest_in_piece(flight, quantity, Piece { from, to: middle, halvings }, known, work);
            return self.highest_in_piece(flight, quantity, Piece { from: middle, to, halvings }, known, work);
        }
        let order = flight_order(reach, EXACT).unwrap_or(MAX_ORDER);
        self.set_load(flight, from, work);
        let Workspace { series, peaks, .. } = work;
        let ([q, v, ..], load) = (&peaks.pieces, &peaks.load);
        series.expand_flight(&self.structure, (q, v), (load, flight.loads.1), (to - from, order));
        let (ground, slope) = quantity.ground;
        let (terms, order) = Quantity { ground: (ground + slope * from, slope), ..*quantity }.terms(series, None);
        highest(&terms, (1.0, order), known)
    }

    /// The motion at a time of a flight, into two vectors of the room.
    fn fly_to(&self, flight: &Flight, time: f64, into: [usize; 2], work: &mut Workspace) {
        let Workspace { interval, scratch, peaks, .. } = work;
        let Ok([q, v]) = peaks.pieces.get_disjoint_mut(into) else { return };
        let known = match time {
            _ if time == 0.0 => flight.start,
            _ if time == flight.length => flight.end,
            _ => {
                interval.prepare(&self.structure, time);
                return interval.fly(flight.start, flight.loads, (q, v), scratch);
            }
        };
        q.copy_from_slice(known.0);
        v.copy_from_slice(known.1);
    }

    /// The modal load at a time of a flight, into the room.
    fn set_load(&self, flight: &Flight, time: f64, work: &mut Workspace) {
        let (start, slope) = flight.loads;
        for (load, (start, slope)) in work.peaks.load.iter_mut().zip(start.iter().zip(slope)) {
            *load = start + slope * time;
        }
    }

    /// The largest of `known` and the magnitudes at the ends of a piece, whose motions are in the room, and whether the
    /// quantity may exceed it in between.
    fn compare_ends(&self, flight: &Flight, of: PeakOf, piece: Piece, known: f64, work: &mut Workspace) -> (f64, bool) {
        let Piece { from, to, .. } = piece;
        self.set_load(flight, from, work);
        let Workspace { peaks, node_v: jerk, .. } = work;
        let building = &self.peak_rows.buildings[of.side() as usize];
        let place = self.peak_rows.place(of);
        let (block, lane) = (&building.blocks[place / LANES - building.first], place % LANES);
        let [q, v, end_q, end_v] = &peaks.pieces;
        let own = Flight { start: (q, v), end: (end_q, end_v), loads: (&peaks.load, flight.loads.1), length: to - from, ..*flight };
        self.bound_modes(building, &own, &mut peaks.piece, jerk);
        let mut course = course_of(block, &own, &peaks.piece, building.modes.clone());
        if self.floor_forces {
            course.add(&peaks.direct[place - lane..], from, own.length);
        }
        let known = larger(known, larger(course.start[0][lane].abs(), course.end[0][lane].abs()));
        (known, course.may_turn_above(lane, own.length, known))
    }

    /// The rows of a quantity in some coordinates.
    pub(super) fn set_rows(&self, of: PeakOf, coordinates: Coordinates, rows: &mut [Vec<f64>; 2]) {
        let structure = &self.structure;
        let side = of.side() as usize;
        let [row, row_v] = rows;
        row.fill(0.0);
        row_v.fill(0.0);
        let of_shape = match of {
            PeakOf::Acceleration(side, floor) => PeakOf::Displacement(side, floor),
            _ => of,
        };
        match (coordinates, of_shape) {
            (Coordinates::Modes, _) => {
                let (building, place) = (&self.peak_rows.buildings[side], self.peak_rows.place(of_shape));
                let (block, lane) = (&building.blocks[place / LANES - building.first], place % LANES);
                for (m, a) in building.modes.clone().zip(&block.on_q) {
                    row[m] = a[lane];
                }
                for (m, b) in building.modes.clone().zip(&block.on_v) {
                    row_v[m] = b[lane];
                }
            }
            (Coordinates::Floors, PeakOf::BaseShear(_)) => {
                self.resistance.set_shear_rows(side, structure.floors.lanes_of(side), row, row_v);
            }
            (Coordinates::Floors, PeakOf::Drift(_, floor)) => {
                let lane = structure.floors.lane(side, floor);
                row[lane] = 1.0;
                if floor > 0 {
                    row[lane - 1] = -1.0;
                }
            }
            (Coordinates::Floors, PeakOf::Displacement(_, floor) | PeakOf::Acceleration(_, floor)) => {
                row[structure.floors.lane(side, floor)] = 1.0;
            }
        }
    }
}

impl Quantity<'_> {
    /// The power series of the quantity in the x of a motion's, and its highest power; `bend` is room for what makes it one,
    /// where a clock does.
    pub fn terms(&self, series: &MotionSeries, bend: Option<&mut Bend>) -> (Coefficients, usize) {
        let [row, row_v] = self.rows;
        let (count, per_unit) = (series.order + 1, 1.0 / series.scale);
        let (mut of_q, mut terms) = ([0.0; ROOM], [0.0; ROOM]);
        series.dot_each(row, 0, &mut of_q);
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
                let mut of_v = [0.0; ROOM];
                series.dot_each(row_v, 0, &mut of_v);
                for n in 0..series.order {
                    terms[n] = of_q[n] + (n + 1) as f64 * of_v[n + 1] * per_unit;
                }
                series.order - 1
            }
        };
        if series.clock.is_bent()
            && let Some(bend) = bend
        {
            bend.set(&series.clock, count);
            bend.apply_to_one(&mut terms[..=order]);
        }
        (terms, order)
    }
}

/// The largest magnitude of a polynomial over 0..=x, or `known` if that is larger.
pub(super) fn highest(terms: &Coefficients, (x, order): (f64, usize), known: f64) -> f64 {
    let mut powers = Powers::default();
    powers.set(x, order);
    let Reading { value, slope, fourth } = powers.read(terms);
    let mut peak = known;
    for sign in [1.0, -1.0] {
        let copy = |out: &mut Coefficients| {
            out.iter_mut().zip(terms).for_each(|(out, term)| *out = sign * term);
            order + 1
        };
        let end = Reading { value: sign * value, slope: sign * slope, fourth };
        if let Some((_, value)) = roots::maximum_above((sign * terms[0], sign * terms[1]), x, &end, peak, copy) {
            peak = value;
        }
    }
    peak
}
