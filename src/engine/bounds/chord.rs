//! Many quantities over a step in contact, by the chords between their values at both ends: floor by floor.
//!
//! Within h seconds a quantity y deviates from its chord by at most h^2/8 max|y''|, so that its magnitude is at most the larger
//! one at both ends and that. If it turned in between, its ends would differ by at most h^2/2 max|y''|, four times as much, and
//! its rates at both ends would add up to no more than h max|y''|: otherwise it is largest at an end.

use crate::numerics::polynomial::{cut, larger, smaller};

/// Raises peaks to the magnitudes of some motions at both ends of `h` seconds, and writes upper bounds on the magnitudes
/// in between: from the motions and their rates at both ends, with bounds on their second derivatives. Returns how many
/// bounds are above their peaks; a NaN is.
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub fn bound_by_motion(
    [start, end, rate, end_rate, fastest]: [&[f64]; 5],
    h: f64,
    peaks: &mut [f64],
    upper: &mut [f64],
) -> u64 {
    let (sag, count) = (0.125 * h * h, peaks.len());
    // Equal lengths: no bounds checks below.
    let [start, end, rate, end_rate, fastest] = cut([start, end, rate, end_rate, fastest], count);
    let (upper, mut open) = (&mut upper[..count], 0);
    for i in 0..count {
        let ends = larger(start[i].abs(), end[i].abs());
        peaks[i] = larger(peaks[i], ends);
        let goes_on = (rate[i] + end_rate[i]).abs() > h * fastest[i];
        upper[i] = if goes_on { ends } else { ends + sag * fastest[i] };
        open += above(upper[i], peaks[i]);
    }
    open
}

/// The same for absolute accelerations, from those without contact forces and those by them at both ends, the least and
/// largest accelerations by contact forces, and bounds on the deviation of the rest from its chord.
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub fn bound_by_push(
    [start, end, first, last]: [&[f64]; 4],
    [least, most, strays]: [&[f64]; 3],
    peaks: &mut [f64],
    upper: &mut [f64],
) -> u64 {
    let count = peaks.len();
    let [start, end, first, last] = cut([start, end, first, last], count);
    let [least, most, strays] = cut([least, most, strays], count);
    let (upper, mut open) = (&mut upper[..count], 0);
    for i in 0..count {
        peaks[i] = larger(peaks[i], larger((start[i] + first[i]).abs(), (end[i] + last[i]).abs()));
        let top = larger(start[i], end[i]) + most[i];
        let bottom = larger(-start[i], -end[i]) - least[i];
        upper[i] = larger(top, bottom) + strays[i];
        open += above(upper[i], peaks[i]);
    }
    open
}

/// The same where the deviation of the whole from its chord is bounded: lowers the bounds that are there.
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub fn bound_by_deviation(
    [start, end, first, last]: [&[f64]; 4],
    strays: &[f64],
    peaks: &mut [f64],
    upper: &mut [f64],
) -> u64 {
    let count = peaks.len();
    let [start, end, first, last, strays] = cut([start, end, first, last, strays], count);
    let (upper, mut open) = (&mut upper[..count], 0);
    for i in 0..count {
        let ends = [start[i] + first[i], end[i] + last[i]];
        let most = larger(ends[0].abs(), ends[1].abs());
        peaks[i] = larger(peaks[i], most);
        let goes_on = (ends[1] - ends[0]).abs() > 4.0 * strays[i];
        upper[i] = smaller(upper[i], if goes_on { most } else { most + strays[i] });
        open += above(upper[i], peaks[i]);
    }
    open
}

/// Writes upper bounds on the magnitudes of accelerations: of the larger one at both ends, with those by contact forces and
/// the ground's.
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub fn set_largest([start, end]: [&[f64]; 2], [least, most]: [&[f64]; 2], ground: f64, largest: &mut [f64]) {
    let count = largest.len();
    let [start, end, least, most] = cut([start, end, least, most], count);
    for i in 0..count {
        largest[i] = larger(start[i].abs(), end[i].abs()) + larger(most[i], -least[i]) + ground;
    }
}

/// Lowers bounds to the larger magnitude of each number at both ends and a bound on its deviation from the chord.
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub fn lower([start, end]: [&[f64]; 2], strays: &[f64], bounds: &mut [f64]) {
    let count = bounds.len();
    let [start, end, strays] = cut([start, end, strays], count);
    for i in 0..count {
        bounds[i] = smaller(bounds[i], larger(start[i].abs(), end[i].abs()) + strays[i]);
    }
}

/// 1 where a bound is above its peak or no number, else 0.
#[inline(always)]
pub fn above(upper: f64, peak: f64) -> u64 {
    1 - u64::from(upper <= peak)
}
