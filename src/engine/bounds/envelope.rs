//! Oscillation about the quasi-static displacement: its envelope never grows under a load that is linear in time.

use crate::engine::bounds::stretch::{MARGIN, ModeBounds};
use crate::engine::quantities::rows::Block;
use crate::numerics::polynomial::{each, larger};
use crate::structure::{LANES, Lane};
use std::ops::Range;

/// Whether the modes' oscillations are too small for each quantity of a block to exceed its peak by more than rounding;
/// `direct` is an addition to them that is linear in time, with the start and the length of its interval, s.
pub fn stay_below(
    peaks: &Lane,
    (block, at_rest): (&Block, &Lane),
    (bounds, modes): (&ModeBounds, &Range<usize>),
    direct: Option<(&[[f64; 2]], f64, f64)>,
) -> [bool; LANES] {
    let [held, held_end] = &bounds.held;
    let of_modes =
        [held, held_end, &bounds.held_rate, &bounds.swing_q, &bounds.swing].map(|vector| &vector[modes.clone()]);
    let swings = swing_of(block, of_modes);
    let added = |i: usize| {
        direct.map_or(0.0, |(direct, from, h)| {
            let [value, rate] = direct[i];
            larger((value + rate * from).abs(), (value + rate * (from + h)).abs())
        })
    };
    std::array::from_fn(|i| swings[i] + at_rest[i].abs() + added(i) <= (1.0 + MARGIN) * peaks[i])
}

/// Bounds on the magnitudes of a block's quantities: from the quasi-static displacements at the start and at the end,
/// their rate, and the amplitudes of the oscillation about them in q and in q'.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn swing_of(block: &Block, [held, held_end, rate, swing_q, swing]: [&[f64]; 5]) -> Lane {
    let count = block.on_q.len();
    // Equal lengths: no bounds checks below.
    let (held, held_end, rate) = (&held[..count], &held_end[..count], &rate[..count]);
    let (swing_q, swing) = (&swing_q[..count], &swing[..count]);
    let (mut start, mut end, mut sum) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
    for m in 0..count {
        let row = &block.on_q[m];
        for i in 0..LANES {
            start[i] += row[i] * held[m];
            end[i] += row[i] * held_end[m];
            sum[i] += row[i].abs() * swing_q[m];
        }
    }
    for (m, row) in block.on_v.iter().enumerate().take(count) {
        for i in 0..LANES {
            start[i] += row[i] * rate[m];
            end[i] += row[i] * rate[m];
            sum[i] += row[i].abs() * swing[m];
        }
    }
    each(|i| larger(start[i].abs(), end[i].abs()) + sum[i])
}
