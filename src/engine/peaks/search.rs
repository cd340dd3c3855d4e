//! The largest magnitudes of quantities within a flight, searched for piece by piece, at last by power series of the motion.

use crate::engine::base::Coordinates;
use crate::engine::base::peaks::Peaks;
use crate::engine::bounds::envelope::stay_below;
use crate::engine::bounds::stretch::{ModeBounds, Stretch};
use crate::engine::peaks::PeakFinder;
use crate::engine::peaks::quantity::{Quantity, highest};
use crate::engine::peaks::room::{LEAVES, Latest, PeakWork, Suspect};
use crate::engine::quantities::rows::{BodyRows, RowBlock, values_of};
use crate::engine::system::buffers::Buffers;
use crate::numerics::polynomial::{MAX_ORDER, larger};
use crate::structure::{EXACT, Interval, LANES, Lane, LinearLoad, Motion, MotionMut, Scratch, Structure, flight_order};

/// Least order of the series over a leaf. An acceleration loses three powers of it, and where a record jumps within a short time
/// its terms are relative to the jump: 12 leave 5e-14 of that at any length.
const LEAST_ORDER: usize = 12;

/// Largest (fastest rate) x (time), rad, of a leaf: its series has no more than [`MAX_ORDER`] powers.
pub(super) const LEAF_ANGLE: f64 = 2.7;

/// The same of a piece, from which on it is worth bounding the amplitudes at its start.
const LONG: f64 = 40.0 * LEAF_ANGLE;

/// What `cleared_in` is for a quantity that is left out of a single leaf: no piece may be halved so often.
const OF_LEAF: u32 = u32::MAX;

/// Largest number of halvings of pieces of a flight: then they are as short as rounding.
const MOST_HALVINGS: u32 = 40;

/// A piece of a flight, from one time since its start to another, s, in which quantities of one body are searched.
#[derive(Clone, Copy)]
pub(super) struct Piece {
    pub(super) from: f64,
    pub(super) to: f64,
    /// The number of times that it may be halved.
    halvings: u32,
    /// The fastest rate of the body's modes, 1/s.
    fastest: f64,
    /// Whether that is the fastest of those which have not settled, as the room notes them (`settled.rs`).
    is_settled: bool,
}

impl Piece {
    fn halves(self) -> [Piece; 2] {
        let (middle, halvings) = (self.from + 0.5 * (self.to - self.from), self.halvings - 1);
        [Piece { to: middle, halvings, ..self }, Piece { from: middle, halvings, ..self }]
    }

    /// (Fastest rate) x (length), rad.
    fn angle(self) -> f64 {
        self.fastest * (self.to - self.from)
    }

    /// The number of leaves, and the times at their ends.
    fn leaves(self) -> (usize, [f64; LEAVES + 1]) {
        let mut count = 1;
        while count < LEAVES && self.angle() > count as f64 * LEAF_ANGLE {
            count *= 2;
        }
        let mut times = [self.to; LEAVES + 1];
        times[0] = self.from;
        let mut width = count;
        while width > 1 {
            for k in (0..count).step_by(width) {
                times[k + width / 2] = times[k] + 0.5 * (times[k + width] - times[k]);
            }
            width /= 2;
        }
        (count, times)
    }
}

impl PeakFinder<'_> {
    /// Raises the peaks of the quantities that may exceed theirs within a flight. They are searched for in the whole
    /// flight, so that a turning point has the same bits whatever part is asked for, and all together: many of them
    /// turn at about the same time. The bounds on the modes have to be those of the flight.
    pub(in crate::engine) fn search_flight(&self, flight: &Stretch, peaks: &mut Peaks, work: &mut PeakWork) {
        if work.peaks.suspects.is_empty() {
            return;
        }
        let mut suspects = std::mem::take(&mut work.peaks.suspects);
        let (until, flight) = (flight.length, flight.whole.unwrap_or(flight));
        for of_body in suspects.chunk_by_mut(|one, next| self.body_of(one) == self.body_of(next)) {
            let modes = &self.watched.in_flight().bodies[self.body_of(&of_body[0])].modes;
            let fastest = self.system.structure.in_flight().fastest_of(modes.clone());
            let whole = Piece { from: 0.0, to: flight.length, halvings: MOST_HALVINGS, fastest, is_settled: false };
            if whole.angle() > LEAF_ANGLE {
                self.bound_bends(of_body, &work.peaks.bounds);
            }
            self.search_piece(flight, whole, until, of_body, work);
        }
        work.peaks.cut_short += suspects.iter().filter(|suspect| suspect.pieces_left == 0).count() as u64;
        suspects.drain(..).for_each(|suspect| peaks.raise(suspect.place, suspect.peak));
        work.peaks.suspects = suspects;
    }

    /// Searches a piece, as far as it lies in the first `until` seconds of the flight. A very long one is halved, for the
    /// quantities that the amplitudes at its start do not keep below their peaks.
    fn search_piece(&self, flight: &Stretch, piece: Piece, until: f64, suspects: &mut [Suspect], work: &mut PeakWork) {
        let halvings = piece.halvings;
        if piece.from >= until {
            return;
        }
        // Those that are cleared here are open again in the next piece.
        for suspect in suspects.iter_mut().filter(|suspect| suspect.cleared_in.is_none()) {
            match suspect.pieces_left {
                0 => suspect.cleared_in = Some(halvings),
                _ => suspect.pieces_left -= 1,
            }
        }
        if are_any_left(suspects) && piece.angle() > LONG && halvings > 0 {
            self.clear_by_amplitudes(flight, piece, suspects, work);
            self.clear_by_chords(flight, piece, until, suspects, work);
            let fastest =
                if are_any_left(suspects) { self.find_settled(flight, piece, suspects, work) } else { piece.fastest };
            let settled = Piece { fastest, is_settled: true, ..piece };
            if are_any_left(suspects) && settled.angle() <= LONG {
                self.search_leaves(flight, settled, until, suspects, work);
            } else if are_any_left(suspects) {
                piece.halves().into_iter().for_each(|half| self.search_piece(flight, half, until, suspects, work));
            }
        } else if are_any_left(suspects) {
            self.search_leaves(flight, piece, until, suspects, work);
        }
        open_again(suspects, halvings);
    }

    /// Searches a piece, in leaves that one series reaches. The peaks are raised to the values at ends of leaves first: then few
    /// leaves are left that may exceed them.
    fn search_leaves(&self, flight: &Stretch, piece: Piece, until: f64, suspects: &mut [Suspect], work: &mut PeakWork) {
        if piece.from >= until {
            return;
        }
        if piece.angle() > LEAVES as f64 * LEAF_ANGLE && piece.halvings > 0 {
            self.clear_by_chords(flight, piece, until, suspects, work);
            if are_any_left(suspects) {
                piece.halves().into_iter().for_each(|half| self.search_leaves(flight, half, until, suspects, work));
            }
            open_again(suspects, piece.halvings);
            return;
        }
        let (count, times) = piece.leaves();
        let asked = times[..count].partition_point(|start| *start < until);
        match count {
            // Both ends of the flight and a sharper bound have not ruled them out (`flight.rs`).
            1 => suspects.iter_mut().for_each(|suspect| suspect.leaves = 1),
            _ => self.find_open_leaves(flight, &times[..=count], (asked, until), suspects, work),
        }
        for k in 0..asked {
            leave_out(suspects, bits(k, 1), OF_LEAF);
            self.read_leaf(flight, Piece { from: times[k], to: times[k + 1], ..piece }, until, suspects, work);
            open_again(suspects, OF_LEAF);
        }
    }

    /// Notes for each quantity the leaves in which it may turn above its peak, among the first `asked` of those between some
    /// times: halves are cleared by chords before their values in the middle are read. Peaks rise to all that is read.
    fn find_open_leaves(
        &self,
        flight: &Stretch,
        times: &[f64],
        (asked, until): (usize, f64),
        suspects: &mut [Suspect],
        work: &mut PeakWork,
    ) {
        let count = times.len() - 1;
        suspects.iter_mut().for_each(|suspect| suspect.leaves = (1 << asked) - 1);
        for k in [0, count] {
            self.read_at(flight, (k, times[k]), until, suspects, work);
        }
        let mut width = count;
        loop {
            for k in (0..count).step_by(width) {
                clear_chords(suspects, [k, k + width], times[k + width] - times[k]);
            }
            if width == 1 {
                return;
            }
            for k in (0..count).step_by(width) {
                leave_out(suspects, bits(k, width), OF_LEAF);
                self.read_at(flight, (k + width / 2, times[k + width / 2]), until, suspects, work);
                open_again(suspects, OF_LEAF);
            }
            width /= 2;
        }
    }

    /// Reads the quantities that are left at the end `k` of a leaf, and raises their peaks to that.
    fn read_at(
        &self,
        flight: &Stretch,
        (k, time): (usize, f64),
        until: f64,
        suspects: &mut [Suspect],
        work: &mut PeakWork,
    ) {
        if !are_any_left(suspects) {
            return;
        }
        self.fly_to(flight, time, [2, 3], work);
        for suspects in suspects.chunk_by_mut(are_of_one_block).filter(|suspects| are_any_left(suspects)) {
            let (body, block) = self.block_of(suspects[0].place);
            let [q, v] = [2, 3].map(|place| &work.peaks.pieces[place][body.modes.clone()]);
            let values = values_of(block, q, v);
            for suspect in suspects.iter_mut().filter(|suspect| suspect.cleared_in.is_none()) {
                let [direct, rate] = work.peaks.direct[suspect.place];
                let value = values[suspect.place % LANES] + flight.rest[suspect.place] + (direct + rate * time);
                suspect.values[k] = value;
                suspect.peak = if time <= until { larger(suspect.peak, value.abs()) } else { suspect.peak };
            }
        }
    }

    /// Raises peaks to the values at both ends of a piece, and clears the quantities that do not turn above theirs in between: a
    /// piece of many leaves in which dashpots are fast and the motion is slow.
    fn clear_by_chords(
        &self,
        flight: &Stretch,
        piece: Piece,
        until: f64,
        suspects: &mut [Suspect],
        work: &mut PeakWork,
    ) {
        suspects.iter_mut().for_each(|suspect| suspect.leaves = 1);
        for (k, time) in [piece.from, piece.to].into_iter().enumerate() {
            self.read_at(flight, (k, time), until, suspects, work);
        }
        clear_chords(suspects, [0, 1], piece.to - piece.from);
        leave_out(suspects, 1, piece.halvings);
    }

    /// Works out bounds on |y''| from the start of some bounds on the modes on: |q''| <= E / w, |q'''| <= E.
    fn bound_bends(&self, suspects: &mut [Suspect], bounds: &ModeBounds) {
        for suspects in suspects.chunk_by_mut(are_of_one_block) {
            let (body, block) = self.block_of(suspects[0].place);
            let [energy, over_w] = [&bounds.energy, &bounds.energy_over_w].map(|all| &all[body.modes.clone()]);
            let bends = bend_of(block, energy, over_w);
            suspects.iter_mut().for_each(|suspect| suspect.bend = bends[suspect.place % LANES]);
        }
    }

    /// Clears the quantities that the amplitudes of the modes at the start of a piece keep below their peaks; bounds the
    /// second derivatives of the others anew.
    fn clear_by_amplitudes(&self, flight: &Stretch, piece: Piece, suspects: &mut [Suspect], work: &mut PeakWork) {
        self.fly_to(flight, piece.from, [0, 1], work);
        self.fly_to(flight, piece.to, [2, 3], work);
        self.set_load(flight, piece.from, work);
        let peaks = &mut *work.peaks;
        let [q, v, end_q, end_v] = &peaks.pieces;
        let (loads, length) = (LinearLoad { load: &peaks.load, slope: flight.loads.slope }, piece.to - piece.from);
        let (start, end) = (Motion { q, v }, Motion { q: end_q, v: end_v });
        let own = Stretch { start, end, loads, length, is_suspect: false, whole: None, ..*flight };
        let modes = self.watched.in_flight().bodies[self.body_of(&suspects[0])].modes.clone();
        peaks.piece.set(self.system.structure.in_flight(), modes, &own);
        for suspects in suspects.chunk_by_mut(are_of_one_block) {
            let (place, (body, block)) = (suspects[0].place / LANES * LANES, self.block_of(suspects[0].place));
            let mut known = [f64::INFINITY; LANES];
            suspects.iter().for_each(|suspect| known[suspect.place % LANES] = suspect.peak);
            let direct = self.system.is_pushed.then_some((&peaks.direct[place..], piece.from, length));
            let at_rest = &flight.rest.as_chunks::<LANES>().0[place / LANES];
            let are_below = stay_below(&known, (block, at_rest), (&peaks.piece, &body.modes), direct);
            for suspect in suspects.iter_mut().filter(|suspect| suspect.cleared_in.is_none()) {
                suspect.cleared_in = are_below[suspect.place % LANES].then_some(piece.halvings);
            }
        }
        self.bound_bends(suspects, &peaks.piece);
    }

    /// The body and the block of a quantity.
    pub(super) fn block_of(&self, place: usize) -> (&BodyRows, &RowBlock) {
        self.watched.in_flight().block_of(place)
    }

    /// Finds the largest magnitudes within a leaf by its series, of quantities of one body.
    fn read_leaf(&self, flight: &Stretch, leaf: Piece, until: f64, suspects: &mut [Suspect], work: &mut PeakWork) {
        if !are_any_left(suspects) {
            return;
        }
        let Piece { from, to, .. } = leaf;
        let (mut rows, ground) = (std::mem::take(&mut work.peaks.rows), flight.ground.later(from));
        let oscillates = self.watched.oscillates();
        let end = if until < to { (until - from) / (to - from) } else { 1.0 };
        let span = self.span_of(self.body_of(&suspects[0]), Coordinates::Modes);
        self.expand_leaf(flight, leaf, span, work);
        for suspect in suspects.iter_mut().filter(|suspect| suspect.cleared_in.is_none()) {
            let of = suspect.of;
            self.set_flight_rows(of, &mut rows);
            let [direct, rate] = work.peaks.direct[suspect.place];
            let added = [flight.rest[suspect.place] + (direct + rate * from), rate];
            let quantity = Quantity { of, rows: &rows, lanes: None, span, added, ground, oscillates };
            let (terms, order) = quantity.terms(&work.buffers.series, None);
            suspect.peak = highest(&terms, (end, order), suspect.peak, &mut work.buffers.powers);
        }
        work.peaks.rows = rows;
    }

    /// Expands a piece of a flight into a power series, for the modes of one body.
    fn expand_leaf(&self, flight: &Stretch, leaf: Piece, modes: (usize, usize), work: &mut PeakWork) {
        self.fly_to(flight, leaf.from, [0, 1], work);
        self.set_load(flight, leaf.from, work);
        let order = flight_order(leaf.angle(), EXACT).map_or(MAX_ORDER, |order| order.max(LEAST_ORDER));
        let PeakWork { buffers: Buffers { series, .. }, peaks } = work;
        let ([q, v, ..], load) = (&peaks.pieces, &peaks.load);
        series.expand_flight_of(
            modes.0..modes.1,
            self.system.structure.in_flight(),
            Motion { q, v },
            LinearLoad { load, slope: flight.loads.slope },
            (leaf.to - leaf.from, order),
        );
        if leaf.is_settled {
            self.expand_settled(modes.0..modes.1, flight.loads.slope, work);
        }
    }

    /// Works out the motion at a time of a flight in two of the vectors `pieces`.
    fn fly_to(&self, flight: &Stretch, time: f64, into: [usize; 2], work: &mut PeakWork) {
        let moving = self.system.structure.in_flight();
        let by_halves = !moving.is_classical() && moving.fastest * flight.length > LEAVES as f64 * LEAF_ANGLE;
        let PeakWork { buffers: Buffers { scratch, .. }, peaks } = work;
        let Ok([q, v]) = peaks.pieces.get_disjoint_mut(into) else {
            return debug_assert!(false, "a motion is two vectors of the pieces");
        };
        let known = match time {
            _ if time == 0.0 => flight.start,
            _ if time == flight.length => flight.end,
            _ => {
                let ([flown_q, flown_v], is_known) = peaks.flown.of(time);
                peaks.motions += u64::from(!is_known);
                if !is_known && by_halves {
                    fly_by_halves(moving, flight, time, (&mut peaks.parts, scratch), [flown_q, flown_v, q, v]);
                } else if !is_known {
                    let (interval, is_prepared) = peaks.parts.of(time);
                    if !is_prepared {
                        interval.prepare(moving, time);
                    }
                    interval.fly(flight.start, flight.loads, MotionMut { q: flown_q, v: flown_v }, scratch);
                }
                Motion { q: flown_q, v: flown_v }
            }
        };
        MotionMut { q, v }.copy_from(known);
    }

    /// Works out the modal load at a time of a flight.
    pub(super) fn set_load(&self, flight: &Stretch, time: f64, work: &mut PeakWork) {
        let LinearLoad { load: start, slope } = flight.loads;
        for (load, (start, slope)) in work.peaks.load.iter_mut().zip(start.iter().zip(slope)) {
            *load = start + slope * time;
        }
    }

    /// The number of the body to which a quantity belongs.
    pub(super) fn body_of(&self, suspect: &Suspect) -> usize {
        self.watched.rows.body_of(suspect.place / LANES)
    }
}

/// Works out the motion at a time of a flight, which is the end of a piece, in the first two of some vectors, by halves of the
/// flight, halves of these and so on: where damping couples modes, each length takes a matrix, and all times share these.
fn fly_by_halves(
    moving: &Structure,
    flight: &Stretch,
    time: f64,
    (parts, scratch): (&mut Latest<Interval>, &mut Scratch),
    [q, v, next_q, next_v]: [&mut Vec<f64>; 4],
) {
    let (mut from, mut to, mut length) = (0.0, flight.length, flight.length);
    MotionMut { q, v }.copy_from(flight.start);
    while from < time {
        let middle = from + 0.5 * (to - from);
        // No more than rounding is left.
        if middle <= from || middle >= to {
            return;
        }
        length *= 0.5;
        if middle > time {
            to = middle;
            continue;
        }
        let (interval, is_prepared) = parts.of(length);
        if !is_prepared {
            interval.prepare(moving, length);
        }
        interval.fly_from(from, Motion { q, v }, flight.loads, MotionMut { q: next_q, v: next_v }, scratch);
        std::mem::swap(q, next_q);
        std::mem::swap(v, next_v);
        from = middle;
    }
}

/// Bounds on the second derivatives of a block, from E and E / w of its modes.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn bend_of(block: &RowBlock, energy: &[f64], over_w: &[f64]) -> Lane {
    let mut bends = [0.0; LANES];
    for (row, bound) in block.on_q.iter().zip(over_w).chain(block.on_v.iter().zip(energy)) {
        for i in 0..LANES {
            bends[i] += row[i].abs() * bound;
        }
    }
    bends
}

fn are_of_one_block(one: &Suspect, next: &Suspect) -> bool {
    one.place / LANES == next.place / LANES
}

/// Clears the leaves between two of their ends, which are `length` seconds apart, for the quantities that do not turn above
/// their peaks there: one deviates from its chord by at most h^2/8 max|y''|, and is monotonic if its ends differ by more than
/// 4 times that.
fn clear_chords(suspects: &mut [Suspect], [from, to]: [usize; 2], length: f64) {
    let (sag, between) = (0.125 * length * length * (1.0 + 1e-9), bits(from, to - from));
    for suspect in suspects.iter_mut().filter(|suspect| suspect.cleared_in.is_none() && suspect.leaves & between != 0) {
        let (start, end, sag) = (suspect.values[from], suspect.values[to], sag * suspect.bend);
        let is_below = larger(start.abs(), end.abs()) + sag <= suspect.peak;
        if is_below || (end - start).abs() > 4.0 * sag {
            suspect.leaves &= !between;
        }
    }
}

/// So many leaves from one on, as bits.
fn bits(from: usize, count: usize) -> u32 {
    ((1 << count) - 1) << from
}

/// Leaves the quantities out of a piece that are cleared in all of some leaves.
fn leave_out(suspects: &mut [Suspect], leaves: u32, piece: u32) {
    for suspect in suspects.iter_mut().filter(|suspect| suspect.cleared_in.is_none()) {
        suspect.cleared_in = (suspect.leaves & leaves == 0).then_some(piece);
    }
}

/// Opens the quantities again that were cleared in a piece.
fn open_again(suspects: &mut [Suspect], piece: u32) {
    for suspect in suspects.iter_mut().filter(|suspect| suspect.cleared_in == Some(piece)) {
        suspect.cleared_in = None;
    }
}

/// Whether any quantity may exceed its peak in the piece that is searched.
fn are_any_left(suspects: &[Suspect]) -> bool {
    suspects.iter().any(|suspect| suspect.cleared_in.is_none())
}
