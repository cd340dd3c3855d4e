//! Folding logged flights into the peaks, largest spans first.
//!
//! Each building's flights are read in spans of some flights over its slow modes (`bounds/span.rs`). A block of quantities
//! whose bound over a span is below its peaks is done with; the others are read at the ends of the flights, which gives a
//! lower bound on each peak and an upper bound on each flight. Only the flights that may exceed a peak are read with all
//! modes, and searched for turning points: of many thousands a few. All peaks come from there; the slow modes only tell where
//! to look, so that no result depends on when, and how often, the log is folded.

use crate::engine::base::peaks::Peaks;
use crate::engine::bounds::span::{BlockBounds, ModeSizes, PART, Span};
use crate::engine::bounds::stretch::Stretch;
use crate::engine::model::Model;
use crate::engine::peaks::log::{Flights, Load};
use crate::engine::peaks::room::PeakWork;
use crate::engine::quantities::rows::{BuildingRows, values_of};
use crate::engine::quantities::truncated::{Mode, TruncatedBuilding};
use crate::numerics::polynomial::larger;
use crate::structure::{LANES, Lane};
use std::ops::Range;

/// Times in a span of a long log, and of one or two flights.
const LONG: usize = 16;
const SHORT: usize = 2;

/// Scratch memory of a fold.
#[derive(Clone, Debug, Default)]
pub struct FoldRoom {
    long: SpanRoom<LONG>,
    short: SpanRoom<SHORT>,
    survivors: Vec<Survivor>,
}

/// The same of one building, for spans of N times.
#[derive(Clone, Debug, Default)]
struct SpanRoom<const N: usize> {
    /// The slow modes in one span.
    motion: Vec<[[f64; N]; 2]>,
    /// Bounds on the slow modes and on the groups of the quick ones, span by span.
    sizes: Vec<ModeSizes>,
    quick: Vec<f64>,
    /// Sizes and numbers of the spans, largest first.
    order: Vec<(f64, usize)>,
    open: Vec<OpenBlock>,
}

/// A block of quantities that may exceed its peaks within a span.
#[derive(Clone, Copy, Debug)]
struct OpenBlock {
    span: usize,
    /// Number of the block among those of its building.
    block: usize,
    coarse: Lane,
    upper: Lane,
}

/// A block of quantities that may exceed its peaks within a flight.
#[derive(Clone, Copy, Debug)]
struct Survivor {
    flight: usize,
    /// Number of the block among those of both buildings.
    block: usize,
    upper: Lane,
    /// By how much it may exceed a peak at most.
    excess: f64,
    /// The values at both ends.
    ends: [Lane; 2],
}

/// Flights, and one building's rows to be read over them.
struct Fold<'a> {
    flights: &'a Flights<'a>,
    rows: &'a BuildingRows,
    truncated: &'a TruncatedBuilding,
    /// The quantities at rest.
    rest: &'a [Lane],
}

impl Model {
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
        let mut room = std::mem::take(&mut work.peaks.fold);
        room.survivors.clear();
        for (rows, truncated) in self.peak_rows.buildings.iter().zip(&self.truncated.buildings) {
            let of_building = rows.first..rows.first + rows.blocks.len();
            let fold = Fold { flights, rows, truncated, rest: &rest.as_chunks::<LANES>().0[of_building.clone()] };
            let known = &mut peaks.values.as_chunks_mut::<LANES>().0[of_building];
            match flights.count() {
                0..SHORT => fold.find_survivors(known, &mut room.short, &mut room.survivors),
                _ => fold.find_survivors(known, &mut room.long, &mut room.survivors),
            }
        }
        self.read_ends(flights, rest, peaks, &mut room.survivors);
        room.survivors.sort_unstable_by_key(|survivor| (survivor.flight, survivor.block));
        for of_flight in room.survivors.chunk_by(|one, next| one.flight == next.flight) {
            self.search_one(flights, rest, whole, of_flight, peaks, work);
        }
        work.peaks.fold = room;
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
            let rows = &self.peak_rows.buildings[usize::from(survivor.block >= self.peak_rows.buildings[1].first)];
            let at_rest = &rest.as_chunks::<LANES>().0[survivor.block];
            for (end, flight) in survivor.ends.iter_mut().zip(survivor.flight..) {
                let (q, v) = flights.motion(flight);
                *end = values_of(&rows.blocks[survivor.block - rows.first], &q[rows.modes.clone()], &v[rows.modes.clone()]);
                for i in 0..LANES {
                    end[i] += at_rest[i];
                    known[i] = larger(known[i], end[i].abs());
                }
            }
            true
        });
        survivors.retain(|survivor| !is_below(&survivor.upper, &all[survivor.block]));
    }

    /// Searches one flight for turning points of some blocks of quantities above their peaks.
    fn search_one(
        &self,
        flights: &Flights,
        rest: &[f64],
        whole: Option<&Stretch>,
        survivors: &[Survivor],
        peaks: &mut Peaks,
        work: &mut PeakWork,
    ) {
        let Some(flight) = survivors.first().map(|survivor| survivor.flight) else { return };
        let Load { acceleration, slope, length } = flights.load(flight);
        for (share, (load, rate)) in
            self.system.structure.participation.iter().zip(work.buffers.load.iter_mut().zip(&mut work.buffers.slope))
        {
            (*load, *rate) = (-share * acceleration, -share * slope);
        }
        let (load, rate) = (std::mem::take(&mut work.buffers.load), std::mem::take(&mut work.buffers.slope));
        let stretch = Stretch {
            start: flights.motion(flight),
            end: flights.motion(flight + 1),
            loads: (&load, &rate),
            rest,
            ground: (acceleration, slope),
            length,
            is_watched: true,
            whole,
        };
        work.peaks.start_flight();
        for building in &self.peak_rows.buildings {
            let own = |survivor: &&Survivor| (building.first..building.first + building.blocks.len()).contains(&survivor.block);
            let mut is_bounded = false;
            for survivor in survivors.iter().filter(own) {
                if !std::mem::replace(&mut is_bounded, true) {
                    let jerk = &mut work.buffers.node_v;
                    work.peaks.bounds.set(&self.system.structure, building.modes.clone(), &stretch, jerk);
                }
                self.check_block(building, survivor.block - building.first, (&stretch, Some(survivor.ends)), peaks, work);
            }
        }
        self.search_flight(&stretch, peaks, work);
        (work.buffers.load, work.buffers.slope) = (load, rate);
    }
}

impl Fold<'_> {
    /// Raises peaks to lower bounds over the flights, and notes blocks and flights that may exceed them.
    fn find_survivors<const N: usize>(&self, known: &mut [Lane], room: &mut SpanRoom<N>, survivors: &mut Vec<Survivor>) {
        if self.rows.blocks.is_empty() {
            return;
        }
        self.read_spans(room);
        let mut order = std::mem::take(&mut room.order);
        order.sort_unstable_by(|one, other| other.0.total_cmp(&one.0).then(one.1.cmp(&other.1)));
        room.open.clear();
        for &(_, span) in &order {
            self.read_span(span, known, room);
        }
        room.order = order;
        let mut read = None;
        let open = std::mem::take(&mut room.open);
        for one in open.iter().filter(|open| !is_below(&open.upper, &known[open.block])) {
            let span = self.span::<N>(one.span);
            if read.replace(one.span) != Some(one.span) {
                span.read(self.slow(), &mut room.motion, &mut room.sizes[self.sizes_of(one.span)]);
            }
            let bounds = self.bound(&span, one.span, one.block, &one.coarse, room);
            for k in 0..span.count {
                let upper = bounds.upper(k);
                if !is_below(&upper, &known[one.block]) {
                    let excess = (0..LANES).fold(0.0, |most, i| larger(most, upper[i] - known[one.block][i]));
                    let (flight, block) = (one.span * (N - 1) + k, self.rows.first + one.block);
                    survivors.push(Survivor { flight, block, upper, excess, ends: [[0.0; LANES]; 2] });
                }
            }
        }
        room.open = open;
    }

    /// Works out the bounds on the modes over all spans.
    fn read_spans<const N: usize>(&self, room: &mut SpanRoom<N>) {
        let spans = self.flights.count().div_ceil(N - 1);
        let (slow, groups) = (self.truncated.slow, self.truncated.groups.len());
        room.motion.resize(slow, [[0.0; N]; 2]);
        room.sizes.resize(spans * slow, ModeSizes::default());
        room.quick.resize(spans * N.div_ceil(PART) * groups, 0.0);
        room.order.clear();
        for number in 0..spans {
            let span = self.span::<N>(number);
            let size = span.read(self.slow(), &mut room.motion, &mut room.sizes[self.sizes_of(number)]);
            room.order.push((size, number));
            if groups > 0 {
                let from = number * N.div_ceil(PART) * groups;
                span.bound_quick(self.truncated, &mut room.quick[from..][..span.parts() * groups]);
            }
        }
    }

    /// Reads the blocks that may exceed their peaks over a span at the ends of its flights.
    fn read_span<const N: usize>(&self, number: usize, known: &mut [Lane], room: &mut SpanRoom<N>) {
        let span = self.span::<N>(number);
        let mut is_read = room.order.len() == 1;
        for (b, block) in self.truncated.blocks.iter().enumerate() {
            let sizes = &room.sizes[self.sizes_of(number)];
            let coarse = span.bound_coarsely(block, &self.rest[b], sizes, self.quick_of::<N>(number, room));
            if is_below(&coarse, &known[b]) {
                continue;
            }
            if !std::mem::replace(&mut is_read, true) {
                span.read(self.slow(), &mut room.motion, &mut room.sizes[self.sizes_of(number)]);
            }
            let [least, upper] = self.bound(&span, number, b, &coarse, room).extremes(span.count);
            for i in 0..LANES {
                known[b][i] = larger(known[b][i], least[i]);
            }
            if !is_below(&upper, &known[b]) {
                room.open.push(OpenBlock { span: number, block: b, coarse, upper });
            }
        }
    }

    fn bound<const N: usize>(
        &self,
        span: &Span<N>,
        number: usize,
        block: usize,
        coarse: &Lane,
        room: &SpanRoom<N>,
    ) -> BlockBounds<N> {
        let read = (&room.motion[..], &room.sizes[self.sizes_of(number)]);
        span.bound(&self.truncated.blocks[block], &self.rest[block], read, (self.quick_of::<N>(number, room), coarse))
    }

    fn slow(&self) -> &[Mode] {
        &self.truncated.modes[..self.truncated.slow]
    }

    fn sizes_of(&self, span: usize) -> Range<usize> {
        span * self.truncated.slow..(span + 1) * self.truncated.slow
    }

    fn quick_of<'r, const N: usize>(&self, span: usize, room: &'r SpanRoom<N>) -> &'r [f64] {
        let each = N.div_ceil(PART) * self.truncated.groups.len();
        &room.quick[span * each..(span + 1) * each]
    }

    /// A span by its number.
    fn span<const N: usize>(&self, number: usize) -> Span<'_, N> {
        let from = number * (N - 1);
        let count = (self.flights.count() - from).min(N - 1);
        let modes = self.rows.modes.clone();
        let loads: [Load; N] = std::array::from_fn(|t| self.flights.load(from + t.min(count)));
        let flown = &loads[..count];
        Span {
            motions: std::array::from_fn(|t| {
                let (q, v) = self.flights.motion(from + t.min(count));
                (&q[modes.clone()], &v[modes.clone()])
            }),
            ground: loads.map(|load| load.acceleration),
            slopes: loads.map(|load| load.slope),
            count,
            longest: flown.iter().fold(0.0, |longest, load| larger(longest, load.length)),
            has_gap: flown.iter().any(|load| load.length == 0.0),
        }
    }
}

/// Whether bounds leave all peaks of a block as they are; a NaN leaves none.
fn is_below(upper: &Lane, peaks: &Lane) -> bool {
    (0..LANES).all(|i| upper[i] <= peaks[i])
}
