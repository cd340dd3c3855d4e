//! A block of quantities over a span: some flights on the ground's motion that follow each other, read at their ends over
//! the slow modes (`quantities/truncated.rs`).
//!
//! Between two ends a quantity deviates from the chord by at most h^2/8 max|y''|. A mode's q'' is a free oscillation while the
//! load is linear in time, so that E = sqrt(q'''^2 + w^2 q''^2) never grows: |y''| <= sum |A| E / w for a row over q, and sum
//! |A| (w + c) E for a row over w^2 q + c q'. The quick modes' share of the ground's acceleration is linear in time, and
//! has no deviation; what is left of them is bounded over parts of a span, from the motion at the start of the part and
//! the changes of the ground's slope within.

use crate::engine::bounds::flights::Flights;
use crate::engine::quantities::truncated::{Mode, TruncatedBlock, TruncatedBuilding};
use crate::numerics::polynomial::{each, larger};
use crate::structure::{LANES, Lane};

/// Flights in a part of a span, over which one bound on what is left of the quick modes holds.
pub const PART: usize = 5;

/// Rounding of a sum over modes, relative to the sum of the sizes of its terms.
const ROUNDING: f64 = 1e-12;

/// N - 1 flights that follow each other, or less, by the ground's motion at their ends.
#[derive(Clone, Debug)]
pub struct Span<const N: usize> {
    /// Number of the first flight, and of flights.
    pub from: usize,
    pub count: usize,
    /// Ground acceleration at the ends of the flights, m/s2; the last one is repeated.
    ground: [f64; N],
    /// Its slopes from these times on, m/s3.
    slopes: [f64; N],
    /// The largest magnitudes of both.
    strongest: f64,
    steepest: f64,
    /// Length of the longest flight, s.
    longest: f64,
    /// Whether motion or acceleration jump anywhere.
    has_gap: bool,
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

impl<const N: usize> Span<N> {
    /// The span of the flights from one on.
    pub fn of(flights: &Flights, from: usize) -> Span<N> {
        let count = (flights.count() - from).min(N - 1);
        let end = flights.load(from + count);
        let (mut ground, mut slopes) = ([end.acceleration; N], [end.slope; N]);
        let (mut longest, mut has_gap) = (0.0, false);
        for (t, load) in flights.loads[from..from + count].iter().enumerate() {
            (ground[t], slopes[t]) = (load.acceleration, load.slope);
            longest = larger(longest, load.length);
            has_gap |= load.length == 0.0;
        }
        let [strongest, steepest] = [&ground, &slopes].map(|all| largest(&all.map(f64::abs)));
        Span { from, count, ground, slopes, strongest, steepest, longest, has_gap }
    }

    /// Number of parts.
    pub fn parts(&self) -> usize {
        self.count.div_ceil(PART)
    }

    /// Reads the slow modes of a building, whose modes are `offset` and on: writes q and w^2 q + c q' at the ends, and the bounds on
    /// them. Returns a size by which spans are put in order.
    pub fn read(
        &self,
        flights: &Flights,
        offset: usize,
        modes: &[Mode],
        out: &mut [[[f64; N]; 2]],
        sizes: &mut [ModeSizes],
    ) -> f64 {
        for t in 0..=self.count {
            let (q, v) = flights.motion(self.from + t);
            for (of_mode, (q, v)) in out.iter_mut().zip(q[offset..].iter().zip(&v[offset..])) {
                (of_mode[0][t], of_mode[1][t]) = (*q, *v);
            }
        }
        for of_motion in out.as_flattened_mut() {
            let end = of_motion[self.count];
            of_motion[self.count + 1..].fill(end);
        }
        read_modes(modes, (&self.ground, &self.slopes), 0.125 * self.longest * self.longest, out, sizes)
    }

    /// Bounds on R of each group of quick modes, for each part: `out` has the groups of the first part first, and after those
    /// of all parts the largest ones.
    pub fn bound_quick(&self, flights: &Flights, offset: usize, building: &TruncatedBuilding, out: &mut [f64]) {
        let TruncatedBuilding { modes, groups, .. } = building;
        let (parts, most) = out.split_at_mut(self.parts() * groups.len());
        most.fill(0.0);
        for (part, out) in parts.chunks_mut(groups.len()).enumerate() {
            let (from, to) = (part * PART, ((part + 1) * PART).min(self.count));
            let kinks: f64 = self.slopes[from..to].windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum();
            out.fill(0.0);
            // After a gap the quick modes may swing more, at the end of a part as well.
            for t in from..=if self.has_gap { to } else { from } {
                let (q, v) = flights.motion(self.from + t);
                for (group, out) in groups.iter().zip(&mut *out) {
                    let range = offset + group.modes.start..offset + group.modes.end;
                    let (modes, motion) = (&modes[group.modes.clone()], (&q[range.clone()], &v[range]));
                    *out = larger(*out, swing_of(modes, motion, [self.ground[t], self.slopes[t]]));
                }
            }
            for ((group, out), most) in groups.iter().zip(out).zip(&mut *most) {
                *out += group.kick * kinks;
                *most = larger(*most, *out);
            }
        }
    }

    /// An upper bound on the magnitudes of a block's quantities over the span, from the bounds on slow and quick modes.
    pub fn bound_coarsely(&self, block: &TruncatedBlock, at_rest: &Lane, sizes: &[ModeSizes], quick: &[f64]) -> Lane {
        let most = &quick[self.parts() * block.left.len()..];
        bound_block(block, at_rest, (sizes, most), [self.strongest, self.steepest])
    }

    /// The block's values at the ends, and what they may be off by in between; `coarse` is the bound above.
    pub fn bound(
        &self,
        block: &TruncatedBlock,
        at_rest: &Lane,
        (motion, sizes): (&[[[f64; N]; 2]], &[ModeSizes]),
        (quick, coarse): (&[f64], &Lane),
    ) -> BlockBounds<N> {
        let groups = block.left.len();
        let mut left = [[0.0; LANES]; N];
        for (k, left) in left.iter_mut().take(self.parts()).enumerate() {
            *left = each(|i| ROUNDING * coarse[i] + block.per_slope[i] * self.steepest);
            for (row, most) in block.left.iter().zip(&quick[k * groups..]) {
                for i in 0..LANES {
                    left[i] += row[i] * most;
                }
            }
        }
        let kind = usize::from(block.pulls);
        let sag = sum_sags(&block.row, sizes, kind);
        let values = values_at(&block.row, (motion, kind), (&block.per_ground, at_rest), &self.ground);
        BlockBounds { values, sag, left }
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
fn swing_of(modes: &[Mode], (q, v): (&[f64], &[f64]), [ground, slope]: [f64; 2]) -> f64 {
    let mut most = [0.0; 2 * LANES];
    for (m, (Mode { w2, w, c, share }, (q, v))) in modes.iter().zip(q.iter().zip(v)).enumerate() {
        let stray = w2 * q + share * (ground - c / w2 * slope);
        let rate = w * v + share * slope / w;
        let place = &mut most[m % (2 * LANES)];
        *place = larger(*place, stray * stray + rate * rate);
    }
    largest(&most).sqrt()
}

/// An upper bound on the magnitudes of a block's quantities: the slow modes' part by the sums of |A| times the bounds on the
/// modes, and the quick modes' with the largest R of each group and the ground's largest acceleration and slope.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn bound_block(
    TruncatedBlock { pulls, row, per_ground, per_slope, left }: &TruncatedBlock,
    at_rest: &Lane,
    (sizes, quick): (&[ModeSizes], &[f64]),
    [strongest, steepest]: [f64; 2],
) -> Lane {
    let kind = usize::from(*pulls);
    let mut sum = each(|i| at_rest[i].abs() + per_ground[i].abs() * strongest + per_slope[i] * steepest);
    for (row, sizes) in row.iter().zip(sizes) {
        for i in 0..LANES {
            sum[i] += row[i].abs() * sizes.most[kind];
        }
    }
    for (row, most) in left.iter().zip(quick) {
        for i in 0..LANES {
            sum[i] += row[i] * most;
        }
    }
    each(|i| (1.0 + ROUNDING) * sum[i])
}

/// The sums of |A| times the modes' deviations from the chord.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn sum_sags(row: &[Lane], sizes: &[ModeSizes], kind: usize) -> Lane {
    let mut sum = [0.0; LANES];
    for (row, sizes) in row.iter().zip(sizes) {
        for i in 0..LANES {
            sum[i] += row[i].abs() * sizes.sag[kind];
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
