//! Folding logged flights into the peaks, largest spans first.
//!
//! Each body's flights are read in spans of some flights (`bounds/span.rs`). A block of quantities
//! whose bound over a span is below its peaks is done with; the others are read at the ends of the flights, which gives a
//! lower bound on each peak and an upper bound on each flight. Only the flights that may exceed a peak are read at
//! their ends, and searched for turning points: of many thousands a few. All peaks come from there; spans only tell where to
//! look, so that no result depends on when, and how often, the log is folded.

use crate::engine::base::Coordinates;
use crate::engine::base::peaks::Peaks;
use crate::engine::bounds::flights::{Flights, Load};
use crate::engine::bounds::span::{BlockBounds, Span};
use crate::engine::bounds::stretch::Stretch;
use crate::engine::peaks::PeakFinder;
use crate::engine::peaks::fold_room::{FoldRoom, OpenBlock, SHORT, SpanRoom, Survivor};
use crate::engine::peaks::room::PeakWork;
use crate::engine::quantities::rows::{BodyRows, values_of};
use crate::engine::quantities::span_rows::{FourModes, SpanBody};
use crate::numerics::polynomial::{each, larger};
use crate::structure::{LANES, Lane, LinearLoad, Motion};
use std::ops::Range;

/// Flights, and one body's rows to be read over them.
struct Fold<'a> {
    flights: &'a Flights<'a>,
    /// The fours of all bodies.
    fours: &'a [FourModes],
    rows: &'a BodyRows,
    of_spans: &'a SpanBody,
    /// The quantities at rest.
    rest: &'a [Lane],
}

impl PeakFinder<'_> {
    /// Raises peaks over some flights on the ground's motion, with these quantities at rest. If they are the first part of
    /// one flight, it is searched as a `whole`, so that turning points have the same bits whatever part is read.
    pub(in crate::engine) fn fold(
        &self,
        flights: &Flights,
        rest: &[f64],
        whole: Option<&Stretch>,
        peaks: &mut Peaks,
        work: &mut PeakWork,
    ) {
        self.find_survivors(flights, rest, peaks, &mut work.peaks.fold);
        if work.peaks.fold.survivors.is_empty() {
            return;
        }
        let mut survivors = std::mem::take(&mut work.peaks.fold.survivors);
        self.read_survivors((flights, rest, whole), &mut survivors, peaks, work);
        work.peaks.fold.survivors = survivors;
    }

    /// Notes the blocks and flights that may exceed the peaks, which are raised to lower bounds over the flights on the way.
    fn find_survivors(&self, flights: &Flights, rest: &[f64], peaks: &mut Peaks, room: &mut FoldRoom) {
        room.survivors.clear();
        let is_short = flights.count() < SHORT;
        let fours = &self.watched.of_spans.fours[..];
        match is_short {
            true => room.short.start(flights, fours),
            false => room.long.start(flights, fours),
        }
        for (rows, of_spans) in self.watched.in_flight().bodies.iter().zip(&self.watched.of_spans.bodies) {
            let of_body = rows.first..rows.first + rows.blocks.len();
            let fold = Fold { flights, fours, rows, of_spans, rest: &rest.as_chunks::<LANES>().0[of_body.clone()] };
            let known = &mut peaks.values.as_chunks_mut::<LANES>().0[of_body];
            match is_short {
                true => fold.find_survivors(known, &mut room.short, &mut room.survivors),
                false => fold.find_survivors(known, &mut room.long, &mut room.survivors),
            }
        }
    }

    /// Raises peaks over the blocks and flights that may exceed them.
    fn read_survivors(
        &self,
        (flights, rest, whole): (&Flights, &[f64], Option<&Stretch>),
        survivors: &mut Vec<Survivor>,
        peaks: &mut Peaks,
        work: &mut PeakWork,
    ) {
        self.read_ends(flights, rest, peaks, survivors);
        survivors.sort_unstable_by_key(|survivor| (survivor.flight, survivor.block));
        for of_flight in survivors.chunk_by(|one, next| one.flight == next.flight) {
            self.search_one((flights, rest, whole), of_flight, peaks, work);
        }
    }

    /// Raises peaks to both ends of the flights that may exceed them, and leaves only those that still may in between.
    fn read_ends(&self, flights: &Flights, rest: &[f64], peaks: &mut Peaks, survivors: &mut Vec<Survivor>) {
        let all = peaks.values.as_chunks_mut::<LANES>().0;
        // Block by block, and the flight first that may exceed by most: then few others have to be read.
        survivors.sort_unstable_by(|one, other| {
            let by_excess = other.excess.total_cmp(&one.excess);
            one.block.cmp(&other.block).then(by_excess).then(one.flight.cmp(&other.flight))
        });
        survivors.retain_mut(|survivor| {
            let known = &mut all[survivor.block];
            if is_below(&survivor.upper, known) {
                return false;
            }
            let rows = &self.watched.in_flight().bodies[self.watched.rows.body_of(survivor.block)];
            let at_rest = &rest.as_chunks::<LANES>().0[survivor.block];
            let [push, rate] = self.pushes(flights, survivor);
            let times = [0.0, flights.load(survivor.flight).length];
            for (end, (flight, time)) in survivor.ends.iter_mut().zip((survivor.flight..).zip(times)) {
                let Motion { q, v } = flights.motion(flight);
                *end = values_of(
                    &rows.blocks[survivor.block - rows.first],
                    &q[rows.modes.clone()],
                    &v[rows.modes.clone()],
                );
                for i in 0..LANES {
                    end[i] += at_rest[i];
                    if self.system.is_pushed {
                        end[i] += push[i] + rate[i] * time;
                    }
                    known[i] = larger(known[i], end[i].abs());
                }
            }
            true
        });
        survivors.retain(|survivor| !is_below(&survivor.upper, &all[survivor.block]));
    }

    /// What a master's pushes add to a block's quantities at the start of a flight, and its rate.
    fn pushes(&self, flights: &Flights, survivor: &Survivor) -> [Lane; 2] {
        let Some(acting) = flights.forces.and_then(|forces| forces.acting(survivor.flight)) else {
            return [[0.0; LANES]; 2];
        };
        let Some(pushed) = self.watched.pushed(survivor.block) else { return [[0.0; LANES]; 2] };
        [acting.0, acting.1].map(|numbers| pushed.add_up(|i| numbers[i]))
    }

    /// Searches one flight for turning points of some blocks of quantities above their peaks.
    fn search_one(
        &self,
        (flights, rest, whole): (&Flights, &[f64], Option<&Stretch>),
        survivors: &[Survivor],
        peaks: &mut Peaks,
        work: &mut PeakWork,
    ) {
        let Some(flight) = survivors.first().map(|survivor| survivor.flight) else { return };
        let Load { ground, length } = flights.load(flight);
        let forces = flights.forces.and_then(|forces| forces.acting(flight));
        let mut own = None;
        let loads = whole.map_or_else(
            || {
                let (load, slope) =
                    own.insert((std::mem::take(&mut work.buffers.load), std::mem::take(&mut work.buffers.slope)));
                self.system.load_in_flight(ground, load, slope);
                if let Some((forces, rates)) = forces {
                    self.system.add_push_numbers(forces.iter().copied(), Coordinates::Modes, load);
                    self.system.add_push_numbers(rates.iter().copied(), Coordinates::Modes, slope);
                }
                LinearLoad { load, slope }
            },
            |whole| whole.loads,
        );
        if self.system.is_pushed {
            for survivor in survivors {
                let [push, rate] = self.pushes(flights, survivor);
                for (i, direct) in work.peaks.direct[survivor.block * LANES..][..LANES].iter_mut().enumerate() {
                    *direct = [push[i], rate[i]];
                }
            }
        }
        let (start, end) = (flights.motion(flight), flights.motion(flight + 1));
        self.search_stretch(
            &Stretch { start, end, loads, rest, ground, length, is_suspect: true, whole },
            survivors,
            peaks,
            work,
        );
        if let Some(own) = own {
            (work.buffers.load, work.buffers.slope) = own;
        }
    }

    fn search_stretch(&self, stretch: &Stretch, survivors: &[Survivor], peaks: &mut Peaks, work: &mut PeakWork) {
        work.peaks.start_flight();
        for body in &self.watched.in_flight().bodies {
            let own = body.first..body.first + body.blocks.len();
            let mut is_bounded = false;
            for survivor in survivors.iter().filter(|survivor| own.contains(&survivor.block)) {
                if !std::mem::replace(&mut is_bounded, true) {
                    work.peaks.bounds.set(self.system.structure.in_flight(), body.modes.clone(), stretch);
                }
                let known_ends = Some(survivor.ends);
                self.check_block(body, survivor.block - body.first, (stretch, known_ends), peaks, work);
            }
        }
        self.search_flight(stretch, peaks, work);
    }
}

impl Fold<'_> {
    /// Raises peaks to lower bounds over the flights, and notes blocks and flights that may exceed them.
    fn find_survivors<const N: usize>(
        &self,
        known: &mut [Lane],
        room: &mut SpanRoom<N>,
        survivors: &mut Vec<Survivor>,
    ) {
        if known.is_empty() || room.spans.is_empty() {
            return;
        }
        let (spans, order) = (std::mem::take(&mut room.spans), std::mem::take(&mut room.order));
        room.motion.resize(self.of_spans.fours.len() * LANES, [[0.0; N]; 2]);
        for &(_, number) in &order {
            self.read_span((number, &spans[number]), known, room);
        }
        let mut open = std::mem::take(&mut room.open);
        let mut read = None;
        for one in open.iter().filter(|open| !is_below(&open.upper, &known[open.block])) {
            let span = (one.span, &spans[one.span]);
            if read.replace(one.span) != Some(one.span) {
                self.read_modes(span.1, room);
            }
            self.read_block(span, one, known, room, survivors);
        }
        open.clear();
        (room.spans, room.order, room.open) = (spans, order, open);
    }

    fn read_modes<const N: usize>(&self, span: &Span<N>, room: &mut SpanRoom<N>) {
        span.read_modes(self.flights, &self.fours[self.of_spans.fours.clone()], &mut room.motion);
    }

    /// Reads the blocks that may exceed their peaks over a span at the ends of its flights.
    fn read_span<const N: usize>(&self, span: (usize, &Span<N>), known: &mut [Lane], room: &mut SpanRoom<N>) {
        let (mut is_read, mut coarse) = (false, std::mem::take(&mut room.coarse));
        coarse.resize(self.of_spans.blocks.len(), [0.0; LANES]);
        let sizes = &room.sizes[self.sizes_of(span.0)];
        span.1.bound_coarsely(self.flights, (&self.of_spans.blocks, self.rest), sizes, &mut coarse);
        for (b, &coarse) in coarse.iter().enumerate() {
            if is_below(&coarse, &known[b]) {
                continue;
            }
            if !std::mem::replace(&mut is_read, true) {
                self.read_modes(span.1, room);
            }
            let mut open = OpenBlock { span: span.0, block: b, coarse, upper: coarse };
            let [least, upper] = self.bound(span.1, &open, room).extremes(span.1.count);
            known[b] = each(|i| larger(known[b][i], least[i]));
            if !is_below(&upper, &known[b]) {
                open.upper = upper;
                room.open.push(open);
            }
        }
        room.coarse = coarse;
    }

    /// Notes the flights of a span in which a block may exceed its peaks.
    fn read_block<const N: usize>(
        &self,
        (_, span): (usize, &Span<N>),
        open: &OpenBlock,
        known: &[Lane],
        room: &SpanRoom<N>,
        survivors: &mut Vec<Survivor>,
    ) {
        let (bounds, known) = (self.bound(span, open, room), &known[open.block]);
        for k in (0..span.count).filter(|k| self.flights.load(span.from + k).length > 0.0) {
            let upper = bounds.upper(k);
            if !is_below(&upper, known) {
                let excess = (0..LANES).fold(0.0, |most, i| larger(most, upper[i] - known[i]));
                let (flight, block) = (span.from + k, self.rows.first + open.block);
                survivors.push(Survivor { flight, block, upper, excess, ends: [[0.0; LANES]; 2] });
            }
        }
    }

    fn bound<const N: usize>(&self, span: &Span<N>, open: &OpenBlock, room: &SpanRoom<N>) -> BlockBounds<N> {
        let read = (&room.motion[..], &room.sizes[self.sizes_of(open.span)]);
        span.bound(self.flights, (&self.of_spans.blocks[open.block], &self.rest[open.block]), read, &open.coarse)
    }

    fn sizes_of(&self, span: usize) -> Range<usize> {
        let (from, of) = (span * self.fours.len(), &self.of_spans.fours);
        from + of.start..from + of.end
    }
}

/// Whether bounds leave all peaks of a block as they are; a NaN leaves none.
fn is_below(upper: &Lane, peaks: &Lane) -> bool {
    (0..LANES).all(|i| upper[i] <= peaks[i])
}
