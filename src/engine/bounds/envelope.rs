//! Oscillation about the quasi-static displacement: its envelope never grows under a load that is linear in time.

use crate::engine::bounds::stretch::{MARGIN, ModeBounds};
use crate::engine::quantities::rows::{RowBlock, sums_of};
use crate::numerics::polynomial::larger;
use crate::structure::{LANES, Lane};
use std::ops::Range;

/// Whether the modes' oscillations are too small for each quantity of a block to exceed its peak by more than rounding;
/// `direct` is an addition to them that is linear in time, with the start and the length of its interval, s.
pub fn stay_below(
    peaks: &Lane,
    (block, at_rest): (&RowBlock, &Lane),
    (bounds, modes): (&ModeBounds, &Range<usize>),
    direct: Option<(&[[f64; 2]], f64, f64)>,
) -> [bool; LANES] {
    let [quasi_static, quasi_static_end] = &bounds.quasi_static;
    let [quasi_static, quasi_static_end, rate, swing_q, swing] =
        [quasi_static, quasi_static_end, &bounds.quasi_static_rate, &bounds.swing_q, &bounds.swing]
            .map(|vector| &vector[modes.clone()]);
    // By the quasi-static displacements at the start and at the end, their rate, and the amplitudes of the oscillation about
    // them in q and in q'.
    let [start, end, swings] = sums_of(block, [(quasi_static, rate), (quasi_static_end, rate)], (swing_q, swing));
    let added = |i: usize| {
        direct.map_or(0.0, |(direct, from, h)| {
            let [value, rate] = direct[i];
            larger((value + rate * from).abs(), (value + rate * (from + h)).abs())
        })
    };
    std::array::from_fn(|i| {
        larger(start[i].abs(), end[i].abs()) + swings[i] + at_rest[i].abs() + added(i) <= (1.0 + MARGIN) * peaks[i]
    })
}
