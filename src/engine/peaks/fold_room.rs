//! Scratch memory of a fold.

use crate::engine::bounds::flights::Flights;
use crate::engine::bounds::span::{ModeSizes, Span};
use crate::engine::quantities::rows::PeakRows;
use crate::engine::quantities::span_rows::{FourModes, SpanRows};
use crate::structure::{LANES, Lane};

/// Times in a span of a long log, and of one or two flights.
pub(super) const LONG: usize = 16;
pub(super) const SHORT: usize = 2;

/// Blocks and flights, per block, for which there is room from the start.
const SURVIVORS: usize = 64;

/// Scratch memory of a fold.
#[derive(Clone, Debug, Default)]
pub(in crate::engine) struct FoldRoom {
    pub(super) long: SpanRoom<LONG>,
    pub(super) short: SpanRoom<SHORT>,
    pub(super) survivors: Vec<Survivor>,
}

/// The same of one body, for spans of N times.
#[derive(Clone, Debug, Default)]
pub(super) struct SpanRoom<const N: usize> {
    pub(super) spans: Vec<Span<N>>,
    /// The modes of a body in one span.
    pub(super) motion: Vec<[[f64; N]; 2]>,
    /// Bounds on the modes, span by span.
    pub(super) sizes: Vec<ModeSizes>,
    /// Bounds on the blocks of a body over one span.
    pub(super) coarse: Vec<Lane>,
    /// Sizes and numbers of the spans, largest first.
    pub(super) order: Vec<(f64, usize)>,
    pub(super) open: Vec<OpenBlock>,
}

/// A block of quantities that may exceed its peaks within a span.
#[derive(Clone, Copy, Debug)]
pub(super) struct OpenBlock {
    pub(super) span: usize,
    /// Number of the block among those of its body.
    pub(super) block: usize,
    pub(super) coarse: Lane,
    pub(super) upper: Lane,
}

/// A block of quantities that may exceed its peaks within a flight.
#[derive(Clone, Copy, Debug)]
pub(super) struct Survivor {
    pub(super) flight: usize,
    /// Number of the block among those of all bodies.
    pub(super) block: usize,
    pub(super) upper: Lane,
    /// By how much it may exceed a peak at most.
    pub(super) excess: f64,
    /// The values at both ends.
    pub(super) ends: [Lane; 2],
}

impl FoldRoom {
    /// Room for folds of so many flights over these rows.
    pub fn new(rows: &PeakRows, of_spans: &SpanRows, flights: usize) -> FoldRoom {
        let survivors = if flights == 0 { 0 } else { SURVIVORS * rows.blocks() };
        let (long, short) = (SpanRoom::new(rows, of_spans, flights), SpanRoom::new(rows, of_spans, flights.min(1)));
        FoldRoom { long, short, survivors: Vec::with_capacity(survivors) }
    }
}

impl<const N: usize> SpanRoom<N> {
    fn new(rows: &PeakRows, of_spans: &SpanRows, flights: usize) -> SpanRoom<N> {
        let spans = flights.div_ceil(N - 1);
        let fours = of_spans.bodies.iter().map(|body| body.fours.len()).max().unwrap_or(0);
        let blocks = rows.bodies.iter().map(|body| body.blocks.len()).max().unwrap_or(0);
        SpanRoom {
            spans: Vec::with_capacity(spans),
            motion: Vec::with_capacity(LANES * fours),
            sizes: Vec::with_capacity(spans * of_spans.fours.len()),
            coarse: Vec::with_capacity(blocks),
            order: Vec::with_capacity(spans),
            open: Vec::with_capacity(spans * blocks),
        }
    }

    /// Divides flights into spans, and works out bounds on the modes over them.
    pub(super) fn start(&mut self, flights: &Flights, fours: &[FourModes]) {
        let SpanRoom { spans, sizes, order, .. } = self;
        spans.clear();
        spans.extend((0..flights.count()).step_by(N - 1).map(|from| Span::of(flights, from)));
        sizes.resize(spans.len() * fours.len(), ModeSizes::default());
        order.clear();
        let of_spans = spans.iter().zip(sizes.chunks_exact_mut(fours.len().max(1))).enumerate();
        order.extend(of_spans.map(|(number, (span, sizes))| (span.bound_modes(flights, fours, sizes), number)));
        order.sort_unstable_by(|one, other| other.0.total_cmp(&one.0).then(one.1.cmp(&other.1)));
    }
}
