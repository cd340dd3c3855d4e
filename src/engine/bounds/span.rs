//! A block of quantities over a span: some flights on the ground's motion that follow each other, read at their ends over
//! the slow modes (`quantities/truncated.rs`).
//!
//! Between two ends a quantity deviates from the chord by at most h^2/8 max|y''|. A mode's q'' is a free oscillation while the
//! load is linear in time, so that E = sqrt(q'''^2 + w^2 q''^2) never grows: |y''| <= sum |A| E / w for a row over q, and sum
//! |A| (w + c) E for a row over w^2 q + c q'. The quick modes' share of the ground's acceleration is linear in time, and
//! has no deviation; what is left of them is bounded over parts of a span, from the motion at the start of the part and
//! the changes of the ground's slope within.

use crate::engine::quantities::truncated::{Group, Mode, TruncatedBlock, TruncatedBuilding};
use crate::numerics::polynomial::larger;
use crate::structure::{LANES, Lane};
use std::ops::Range;

/// Flights in a part of a span, over which one bound on what is left of the quick modes holds.
pub const PART: usize = 5;

/// Rounding of a sum over modes, relative to the sum of the sizes of its terms.
const ROUNDING: f64 = 1e-12;

/// The motion of a building at N times, the ends of N - 1 flights.
pub struct Span<'a, const N: usize> {
    pub motions: [(&'a [f64], &'a [f64]); N],
    /// Ground acceleration at these times, m/s2.
    pub ground: [f64; N],
    /// Its slopes from these times on, m/s3.
    pub slopes: [f64; N],
    /// Number of flights; from the last end on all is repeated.
    pub count: usize,
    /// Length of the longest flight, s.
    pub longest: f64,
    /// Whether motion or acceleration jump anywhere.
    pub has_gap: bool,
}

/// Bounds on one slow mode over a span: on q and on w^2 q + c q' between the ends, and on the deviation from the chord.
#[derive(Clone, Copy, Debug, Default)]
pub struct ModeSizes {
    pub most: [f64; 2],
    pub sag: [f64; 2],
}

/// Bounds on a block of quantities over a span.
pub struct BlockBounds<const N: usize> {
    /// The values at the ends, without what is left of the quick modes.
    pub values: [[f64; N]; LANES],
    /// A bound on the deviation from the chord.
    pub sag: Lane,
    /// A bound on what is left of the quick modes, for each part, with the rounding of the values.
    pub left: [Lane; N],
}

impl<const N: usize> Span<'_, N> {
    /// Number of parts.
    pub fn parts(&self) -> usize {
        self.count.div_ceil(PART)
    }

    fn steepest(&self) -> f64 {
        self.slopes.iter().fold(0.0, |most, slope| larger(most, slope.abs()))
    }

    /// Reads the slow modes: writes q and w^2 q + c q' at the ends, and the bounds on them. Returns a size by which spans are put
    /// in order.
    pub fn read(&self, modes: &[Mode], out: &mut [[[f64; N]; 2]], sizes: &mut [ModeSizes]) -> f64 {
        for (t, (q, v)) in self.motions.iter().enumerate() {
            for (of_mode, (q, v)) in out.iter_mut().zip(q.iter().zip(*v)) {
                (of_mode[0][t], of_mode[1][t]) = (*q, *v);
            }
        }
        read_modes(modes, (&self.ground, &self.slopes), 0.125 * self.longest * self.longest, out, sizes)
    }

    /// Bounds on R of each group of quick modes, for each part: `out` has the groups of the first part first.
    pub fn bound_quick(&self, building: &TruncatedBuilding, out: &mut [f64]) {
        let TruncatedBuilding { modes, groups, .. } = building;
        for (part, out) in out.chunks_mut(groups.len()).enumerate() {
            let (from, to) = (part * PART, ((part + 1) * PART).min(self.count));
            let slopes = &self.slopes[from..to];
            let kinks: f64 = slopes.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum();
            let restarts = if self.has_gap { from..to } else { from..from + 1 };
            for (Group { modes: range, kick }, out) in groups.iter().zip(out) {
                let swing = |t: usize| swing_of(&modes[range.clone()], self.motions[t], range, [self.ground[t], self.slopes[t]]);
                *out = restarts.clone().map(swing).fold(0.0, larger) + kick * kinks;
            }
        }
    }

    /// An upper bound on the magnitudes of a block's quantities over the span.
    pub fn bound_coarsely(&self, block: &TruncatedBlock, at_rest: &Lane, sizes: &[ModeSizes], quick: &[f64]) -> Lane {
        let strongest = self.ground.iter().fold(0.0, |most, ground| larger(most, ground.abs()));
        let left = self.left_of(block, quick);
        let size = sum_sizes(&block.row, sizes, usize::from(block.pulls), |sizes| &sizes.most);
        std::array::from_fn(|i| {
            let left = left[..self.parts()].iter().fold(0.0, |most, part| larger(most, part[i]));
            (1.0 + ROUNDING) * (at_rest[i].abs() + size[i] + block.per_ground[i].abs() * strongest + left)
        })
    }

    /// The block's values at the ends, and what they may be off by in between; `coarse` is the bound above.
    pub fn bound(
        &self,
        block: &TruncatedBlock,
        at_rest: &Lane,
        (motion, sizes): (&[[[f64; N]; 2]], &[ModeSizes]),
        (quick, coarse): (&[f64], &Lane),
    ) -> BlockBounds<N> {
        let kind = usize::from(block.pulls);
        let mut left = self.left_of(block, quick);
        for part in &mut left {
            for i in 0..LANES {
                part[i] += ROUNDING * coarse[i];
            }
        }
        let sag = sum_sizes(&block.row, sizes, kind, |sizes| &sizes.sag);
        let values = values_at(&block.row, (motion, kind), (&block.per_ground, at_rest), &self.ground);
        BlockBounds { values, sag, left }
    }

    fn left_of(&self, block: &TruncatedBlock, quick: &[f64]) -> [Lane; N] {
        let steepest = self.steepest();
        let mut parts = [block.per_slope.map(|per_slope| per_slope * steepest); N];
        let groups = block.left.len();
        for (k, part) in parts.iter_mut().take(self.parts()).enumerate() {
            for (row, most) in block.left.iter().zip(&quick[k * groups..]) {
                for i in 0..LANES {
                    part[i] += row[i] * most;
                }
            }
        }
        parts
    }
}

impl<const N: usize> BlockBounds<N> {
    /// Upper bounds over flight `k`.
    pub fn upper(&self, k: usize) -> Lane {
        let left = &self.left[k / PART];
        std::array::from_fn(|i| larger(self.values[i][k].abs(), self.values[i][k + 1].abs()) + self.sag[i] + left[i])
    }

    /// Lower bounds on the largest magnitudes, and upper ones, over all `count` flights.
    pub fn extremes(&self, count: usize) -> [Lane; 2] {
        let (mut least, mut most) = ([0.0; LANES], [0.0; LANES]);
        for (part, left) in self.left.iter().enumerate().take(count.div_ceil(PART)) {
            let to = ((part + 1) * PART).min(count);
            for i in 0..LANES {
                let value = self.values[i][part * PART..=to].iter().fold(0.0, |most, value| larger(most, value.abs()));
                least[i] = larger(least[i], value - left[i]);
                most[i] = larger(most[i], value + self.sag[i] + left[i]);
            }
        }
        [least, most]
    }
}

#[multiversion::multiversion(targets("x86_64+avx2"))]
fn read_modes<const N: usize>(
    modes: &[Mode],
    (ground, slopes): (&[f64; N], &[f64; N]),
    chord: f64,
    motion: &mut [[[f64; N]; 2]],
    sizes: &mut [ModeSizes],
) -> f64 {
    let mut total = 0.0;
    for (Mode { w2, w, c, share }, ([q, v], sizes)) in modes.iter().zip(motion.iter_mut().zip(sizes)) {
        let (mut energy, mut moved) = ([0.0; N], [0.0; N]);
        for t in 0..N {
            let pull = w2 * q[t] + c * v[t];
            let acceleration = -share * ground[t] - pull;
            let jerk = -share * slopes[t] - c * acceleration - w2 * v[t];
            energy[t] = jerk * jerk + w2 * acceleration * acceleration;
            moved[t] = q[t].abs();
            v[t] = pull;
        }
        let sag = chord * largest(&energy).sqrt();
        let pulled = largest(&v.map(f64::abs));
        sizes.sag = [sag / w, sag * (w + c)];
        sizes.most = [largest(&moved) + sizes.sag[0], pulled + sizes.sag[1]];
        total += pulled * share.abs();
    }
    total
}

#[inline(always)]
fn largest<const N: usize>(all: &[f64; N]) -> f64 {
    let mut most = [0.0; LANES];
    let (blocks, rest) = all.as_chunks::<LANES>();
    for block in blocks {
        for i in 0..LANES {
            most[i] = larger(most[i], block[i]);
        }
    }
    rest.iter().chain(&most).fold(0.0, |most, one| larger(most, *one))
}

/// The largest R of some modes at a motion, with the ground's acceleration and its slope.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn swing_of(modes: &[Mode], (q, v): (&[f64], &[f64]), range: &Range<usize>, [ground, slope]: [f64; 2]) -> f64 {
    let (q, v) = (&q[range.clone()][..modes.len()], &v[range.clone()][..modes.len()]);
    let mut most = [0.0; 2 * LANES];
    for (m, Mode { w2, w, c, share }) in modes.iter().enumerate() {
        let stray = w2 * q[m] + share * (ground - c / w2 * slope);
        let rate = w * v[m] + share * slope / w;
        let place = &mut most[m % (2 * LANES)];
        *place = larger(*place, stray * stray + rate * rate);
    }
    most.iter().fold(0.0, |most, one| larger(most, *one)).sqrt()
}

/// The sums of |A| times the bounds on the modes.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn sum_sizes(row: &[Lane], sizes: &[ModeSizes], kind: usize, of: impl Fn(&ModeSizes) -> &[f64; 2]) -> Lane {
    let mut sum = [0.0; LANES];
    for (row, sizes) in row.iter().zip(sizes) {
        for i in 0..LANES {
            sum[i] += row[i].abs() * of(sizes)[kind];
        }
    }
    sum
}

#[multiversion::multiversion(targets("x86_64+avx2"))]
fn values_at<const N: usize>(
    row: &[Lane],
    (motion, kind): (&[[[f64; N]; 2]], usize),
    (per_ground, at_rest): (&Lane, &Lane),
    ground: &[f64; N],
) -> [[f64; N]; LANES] {
    let mut all = [[0.0; N]; LANES];
    // Two quantities at a time stay in registers.
    for (pair, out) in all.chunks_exact_mut(2).enumerate() {
        let (i, j) = (2 * pair, 2 * pair + 1);
        let (mut one, mut other) = ([at_rest[i]; N], [at_rest[j]; N]);
        for t in 0..N {
            one[t] += per_ground[i] * ground[t];
            other[t] += per_ground[j] * ground[t];
        }
        for (row, motion) in row.iter().zip(motion) {
            for t in 0..N {
                one[t] += row[i] * motion[kind][t];
                other[t] += row[j] * motion[kind][t];
            }
        }
        (out[0], out[1]) = (one, other);
    }
    all
}
