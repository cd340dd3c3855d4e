//! The watched quantities in flights, over fours of modes side by side, as they are read over spans of flights
//! (`bounds/span.rs`).
//!
//! A quantity is a row A over q, or, where it pulls, as accelerations and base shears do, one over w^2 q + c q'. Where
//! oscillators move in flights each quantity is a row A over q and one B over q'.
//!
//! Where a master pushes on the buildings, what that adds at once is beside the rows (`pushed.rs`).

use crate::engine::quantities::pushed::{Pushed, Pushes};
use crate::engine::quantities::rows::{BodyRows, PeakRows, RowBlock};
use crate::structure::{LANES, Lane, Structure};
use std::ops::Range;

/// The quantities of all bodies.
#[derive(Debug)]
pub(crate) struct SpanRows {
    /// All fours of neighbouring modes.
    pub fours: Vec<FourModes>,
    pub bodies: Vec<SpanBody>,
}

/// The quantities of one body.
#[derive(Debug)]
pub(crate) struct SpanBody {
    /// The fours with modes of the body, among those of all bodies.
    pub fours: Range<usize>,
    /// The blocks of the body's rows.
    pub blocks: Vec<SpanBlock>,
}

/// [`LANES`] modes side by side, of one body or two.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FourModes {
    /// Number of the four in a modal vector.
    pub number: usize,
    pub w2: Lane,
    pub c: Lane,
    pub share: Lane,
    /// What rows are read over beside q, w^2 q + c q', of oscillators q', per unit of q and of q'.
    pub second: [Lane; 2],
    /// Bounds on the second derivatives of both, per unit of E = sqrt(q'''^2 + w^2 q''^2).
    pub bends: [Lane; 2],
}

/// [`LANES`] quantities.
#[derive(Debug)]
pub(crate) struct SpanBlock {
    /// Over the body's fours, with 0 for other modes than its own, a row over q, and one over w^2 q + c q', or over q' of
    /// oscillators; empty where it is 0.
    pub rows: [Vec<Lane>; 2],
    /// What a master's pushes add at once.
    pub pushed: Option<Pushed>,
}

impl SpanRows {
    /// The quantities of `rows`.
    pub(crate) fn of(structure: &Structure, pushes: Pushes<'_>, rows: &PeakRows) -> SpanRows {
        let mut bodies: Vec<SpanBody> =
            rows.bodies.iter().enumerate().map(|(b, body)| SpanBody::of((structure, b), body)).collect();
        let mut numbers: Vec<usize> = bodies.iter().flat_map(|body| body.fours.clone()).collect();
        numbers.dedup();
        for SpanBody { fours, .. } in &mut bodies {
            let first = numbers.partition_point(|number| *number < fours.start);
            *fours = first..first + fours.len();
        }
        for (body, of) in bodies.iter_mut().zip(&rows.bodies) {
            for (block, number) in body.blocks.iter_mut().zip(of.first..) {
                block.pushed = Pushed::of((structure, pushes), rows, number);
            }
        }
        SpanRows { fours: numbers.into_iter().map(|number| FourModes::of(structure, number)).collect(), bodies }
    }
}

impl SpanBody {
    /// With its fours among those of a modal vector.
    fn of((structure, b): (&Structure, usize), rows: &BodyRows) -> SpanBody {
        let is_oscillating = oscillates(structure, b);
        let Range { start, end } = rows.modes;
        let omega2 = &structure.in_flight().omega2[start..end];
        // The first four begins with so many modes of the body before.
        let others = start % LANES;
        let of_block = |block| SpanBlock {
            rows: rows_over((block, is_oscillating), omega2).map(|row| in_fours(row, others)),
            pushed: None,
        };
        SpanBody { fours: start / LANES..end.div_ceil(LANES), blocks: rows.blocks.iter().map(of_block).collect() }
    }
}

/// Whether the modes of a body are oscillators in flights.
fn oscillates(structure: &Structure, b: usize) -> bool {
    structure.oscillators().is_some() && structure.bodies[b].is_coupled()
}

impl FourModes {
    fn of(structure: &Structure, number: usize) -> FourModes {
        let moving = structure.in_flight();
        // Whether it is an oscillator; `None`: it rests.
        let modes: [Option<bool>; LANES] = std::array::from_fn(|i| {
            let m = number * LANES + i;
            let b = structure.bodies.iter().position(|body| body.range.contains(&m))?;
            Some(oscillates(structure, b))
        });
        let all = |of: &dyn Fn(usize, bool) -> f64| -> Lane {
            std::array::from_fn(|i| modes[i].map_or(0.0, |oscillates| of(number * LANES + i, oscillates)))
        };
        let Structure { omega2, damping, participation, quickness, .. } = moving;
        FourModes {
            number,
            w2: all(&|m, _| omega2[m]),
            c: all(&|m, _| damping[m]),
            share: all(&|m, _| participation[m]),
            second: [
                all(&|m, oscillates| if oscillates { 0.0 } else { omega2[m] }),
                all(&|m, oscillates| if oscillates { 1.0 } else { damping[m] }),
            ],
            bends: [
                all(&|m, _| 1.0 / omega2[m].sqrt()),
                all(&|m, oscillates| if oscillates { 1.0 } else { quickness[m] }),
            ],
        }
    }

    /// The numbers of these modes in a modal vector.
    #[inline(always)]
    pub(crate) fn of_vector(&self, all: &[f64]) -> Lane {
        all.as_chunks::<LANES>().0[self.number]
    }
}

/// The rows over the modes, as [`SpanBlock::rows`].
fn rows_over((RowBlock { on_q, on_v }, is_oscillating): (&RowBlock, bool), omega2: &[f64]) -> [Vec<Lane>; 2] {
    match is_oscillating {
        true => [on_q.clone(), on_v.clone()],
        false if on_v.is_empty() => [on_q.clone(), Vec::new()],
        false => [Vec::new(), on_q.iter().zip(omega2).map(|(row, w2)| row.map(|entry| entry / w2)).collect()],
    }
}

/// A row with zeros for `others` before its first entry and for those after its last one, in fours of modes.
fn in_fours(row: Vec<Lane>, others: usize) -> Vec<Lane> {
    if row.is_empty() {
        return row;
    }
    let mut fours = vec![[0.0; LANES]; (others + row.len()).next_multiple_of(LANES)];
    fours[others..][..row.len()].copy_from_slice(&row);
    fours
}
