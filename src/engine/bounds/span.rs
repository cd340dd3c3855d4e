//! A block of quantities over a span: some flights that follow each other, read at their ends
//! (`quantities/span_rows.rs`).
//!
//! Between two ends a quantity deviates from the chord by at most h^2/8 max|y''|. A mode's q'' is a free oscillation
//! while the load is linear in time, so that E = sqrt(q'''^2 + w^2 q''^2) never grows: |y''| <= sum |A| E / w for a row
//! over q, sum |A| (w + c) E for a row over w^2 q + c q', and sum |A| E for one over q' of oscillators. What a master's
//! pushes add to accelerations and shears at once is linear in time.
//!
//! Loads may jump from one flight to the next: then a quantity is read with the load at the end of the one, and with that at the
//! start of the other.

use crate::engine::bounds::flights::{Flights, Forces};
use crate::engine::quantities::pushed::Pushed;
use crate::engine::quantities::span_rows::{FourModes, SpanBlock};
use crate::numerics::polynomial::{each, larger};
use crate::structure::{LANES, Lane, LinearGround, Motion};

/// Rounding of a sum over modes, relative to the sum of the sizes of its terms.
const ROUNDING: f64 = 1e-12;

/// Change of the ground's acceleration from one flight to the next, relative to it, that is no rounding.
const JUMP: f64 = 1e-12;

/// N - 1 flights that follow each other, or less, by the ground's motion at their ends.
#[derive(Clone, Debug)]
pub struct Span<const N: usize> {
    /// Number of the first flight, and of flights.
    pub from: usize,
    pub count: usize,
    /// Ground acceleration at the starts of the flights and after the last one, which is repeated, m/s2.
    ground: [f64; N],
    /// Its slopes from the starts on, m/s3.
    slopes: [f64; N],
    /// Length of the longest flight, s.
    longest: f64,
    /// Whether motion or acceleration jump anywhere.
    jumps: bool,
    /// Whether a master pushes.
    is_pushed: bool,
}

/// Bounds on [`LANES`] modes side by side over a span: on q and on w^2 q + c q', of oscillators q', between the ends, and on
/// the deviations from the chord.
#[derive(Clone, Copy, Debug, Default)]
pub struct ModeSizes {
    pub most: [Lane; 2],
    pub sag: [Lane; 2],
}

/// Bounds on a block of quantities over a span.
pub struct BlockBounds<const N: usize> {
    /// For each flight the larger magnitude at its start and its end; 0 over a gap.
    pub highest: [[f64; N]; LANES],
    /// A bound on the deviation from the chord.
    pub sag: Lane,
    /// A bound on the rounding of the values.
    pub rounding: Lane,
}

impl<const N: usize> Span<N> {
    /// The span of the flights from one on.
    pub fn of(flights: &Flights, from: usize) -> Span<N> {
        let count = (flights.count() - from).min(N - 1);
        let end = flights.load(from + count);
        let (mut ground, mut slopes) = ([end.ground.acceleration; N], [end.ground.slope; N]);
        let (mut longest, mut jumps) = (0.0, false);
        let mut before = flights.load(from).ground.acceleration;
        for (t, load) in flights.loads[from..from + count].iter().enumerate() {
            let LinearGround { acceleration, slope } = load.ground;
            (ground[t], slopes[t]) = (acceleration, slope);
            longest = larger(longest, load.length);
            // By more than rounding.
            let is_jump = (before - acceleration).abs() > JUMP * (before.abs() + acceleration.abs());
            jumps |= load.length == 0.0 || is_jump;
            before = load.ground.after(load.length);
        }
        let is_pushed = flights.forces.is_some_and(|forces| forces.of[from..from + count].iter().any(|set| *set > 0));
        Span { from, count, ground, slopes, longest, jumps, is_pushed }
    }

    /// Bounds all modes. Returns a size by which spans are put in order.
    pub fn bound_modes(&self, flights: &Flights, fours: &[FourModes], sizes: &mut [ModeSizes]) -> f64 {
        set_largest(self, flights, fours, sizes);
        if let Some(Forces { energies, .. }) = flights.forces {
            for (sizes, four) in sizes.iter_mut().zip(fours) {
                let energies = energies[self.from * flights.lanes..].chunks_exact(flights.lanes).take(self.count);
                sizes.sag[0] = energies.fold([0.0; LANES], |most, energies| {
                    let energies = four.of_vector(energies);
                    each(|i| larger(most[i], energies[i]))
                });
            }
        }
        let chord = 0.125 * self.longest * self.longest;
        let finish = |(sizes, four): (&mut ModeSizes, &FourModes)| {
            let (pulled, energy) = (sizes.most[1], sizes.sag[0].map(f64::sqrt));
            sizes.sag = four.bends.map(|bends| each(|i| chord * energy[i] * bends[i]));
            sizes.most = [0, 1].map(|kind| each(|i| sizes.most[kind][i] + sizes.sag[kind][i]));
            (0..LANES).map(|i| pulled[i] * four.share[i].abs()).sum::<f64>()
        };
        sizes.iter_mut().zip(fours).map(finish).sum()
    }

    /// Reads the modes of a body at the ends: writes q and w^2 q + c q', of oscillators q'.
    pub fn read_modes(&self, flights: &Flights, fours: &[FourModes], out: &mut [[[f64; N]; 2]]) {
        for t in 0..N {
            let Motion { q, v } = flights.motion(self.from + t.min(self.count));
            for (four, out) in fours.iter().zip(out.as_chunks_mut::<LANES>().0) {
                let (q, v) = (four.of_vector(q), four.of_vector(v));
                for (i, out) in out.iter_mut().enumerate() {
                    (out[0][t], out[1][t]) = (q[i], four.second[0][i] * q[i] + four.second[1][i] * v[i]);
                }
            }
        }
    }

    /// Upper bounds on the magnitudes of all quantities of some blocks over the span, from the bounds on the modes.
    pub fn bound_coarsely(
        &self,
        flights: &Flights,
        (blocks, rest): (&[SpanBlock], &[Lane]),
        sizes: &[ModeSizes],
        out: &mut [Lane],
    ) {
        bound_blocks((blocks, Some(rest)), sizes, out);
        for (block, out) in blocks.iter().zip(out).filter(|_| self.is_pushed) {
            if let Some(pushed) = &block.pushed {
                let [starts, ends] = self.pushes(flights, pushed);
                let none = [0.0; LANES];
                let added =
                    starts.iter().chain(&ends).fold(none, |most, push| each(|i| larger(most[i], push[i].abs())));
                *out = each(|i| out[i] + added[i]);
            }
        }
    }

    /// What pushes add at the starts and at the ends of the flights.
    fn pushes(&self, flights: &Flights, pushed: &Pushed) -> [[Lane; N]; 2] {
        let mut pushes = [[[0.0; LANES]; N]; 2];
        let [starts, ends] = &mut pushes;
        for t in 0..self.count {
            if let Some((acting, rates)) = flights.forces.and_then(|forces| forces.acting(self.from + t)) {
                let length = flights.load(self.from + t).length;
                let (first, rate) = (pushed.add_up(|i| acting[i]), pushed.add_up(|i| rates[i]));
                (starts[t], ends[t]) = (first, each(|i| first[i] + rate[i] * length));
            }
        }
        pushes
    }

    /// The block's values at the ends, and what they may be off by in between; `coarse` is the bound above.
    pub fn bound(
        &self,
        flights: &Flights,
        (block, at_rest): (&SpanBlock, &Lane),
        (motion, sizes): (&[[[f64; N]; 2]], &[ModeSizes]),
        coarse: &Lane,
    ) -> BlockBounds<N> {
        let values = values_at(&block.rows, motion, at_rest);
        let mut highest = match block.pushed.as_ref().filter(|_| self.is_pushed) {
            Some(pushed) => highest_of_pushed(&values, &self.pushes(flights, pushed)),
            None => highest_at(&values),
        };
        // Both ends of a gap are those of the flights beside it.
        let loads = &flights.loads[self.from..self.from + self.count];
        for (k, _) in loads.iter().enumerate().filter(|(_, load)| self.jumps && load.length == 0.0) {
            highest.iter_mut().for_each(|highest| highest[k] = 0.0);
        }
        BlockBounds { highest, sag: sum_sags(&block.rows, sizes), rounding: coarse.map(|coarse| ROUNDING * coarse) }
    }
}

impl<const N: usize> BlockBounds<N> {
    /// Upper bounds over flight `k`.
    pub fn upper(&self, k: usize) -> Lane {
        each(|i| self.highest[i][k] + self.sag[i] + self.rounding[i])
    }

    /// Lower bounds on the largest magnitudes, and upper ones, over all `count` flights.
    pub fn extremes(&self, count: usize) -> [Lane; 2] {
        let highest = self.highest.map(|of| of[..count].iter().fold(0.0, |most, value| larger(most, *value)));
        [each(|i| larger(0.0, highest[i] - self.rounding[i])), each(|i| highest[i] + self.sag[i] + self.rounding[i])]
    }
}

/// Sets `most` to the largest |q| and |w^2 q + c q'|, of oscillators |q'|, at all ends, and the first `sag` to the largest E^2 at
/// the starts of flights on the ground's motion alone.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn set_largest<const N: usize>(span: &Span<N>, flights: &Flights, fours: &[FourModes], sizes: &mut [ModeSizes]) {
    let motions: [_; N] = std::array::from_fn(|t| flights.motion(span.from + t.min(span.count)));
    for (four, sizes) in fours.iter().zip(sizes) {
        let FourModes { w2, c, share, second, .. } = four;
        let (mut moved, mut pulled, mut energy) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        for (t, Motion { q, v }) in motions.iter().enumerate().take(span.count + 1) {
            let (q, v) = (four.of_vector(q), four.of_vector(v));
            let acceleration = each(|i| -share[i] * span.ground[t] - (w2[i] * q[i] + c[i] * v[i]));
            let jerk = each(|i| -share[i] * span.slopes[t] - c[i] * acceleration[i] - w2[i] * v[i]);
            moved = each(|i| larger(moved[i], q[i].abs()));
            pulled = each(|i| larger(pulled[i], (second[0][i] * q[i] + second[1][i] * v[i]).abs()));
            energy = each(|i| larger(energy[i], jerk[i] * jerk[i] + w2[i] * acceleration[i] * acceleration[i]));
        }
        *sizes = ModeSizes { most: [moved, pulled], sag: [energy, [0.0; LANES]] };
    }
}

/// Upper bounds on the magnitudes of the quantities of some blocks: the sums of |A| times the bounds on the modes,
/// about their values at rest, if these are not 0.
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub fn bound_blocks((blocks, rest): (&[SpanBlock], Option<&[Lane]>), sizes: &[ModeSizes], out: &mut [Lane]) {
    for (b, (SpanBlock { rows, .. }, out)) in blocks.iter().zip(out).enumerate() {
        let mut sum = rest.map_or([0.0; LANES], |rest| rest[b].map(f64::abs));
        for (kind, row) in rows.iter().enumerate() {
            for (rows, sizes) in row.as_chunks::<LANES>().0.iter().zip(sizes) {
                for (row, most) in rows.iter().zip(sizes.most[kind]) {
                    sum = each(|i| sum[i] + row[i].abs() * most);
                }
            }
        }
        *out = each(|i| (1.0 + ROUNDING) * sum[i]);
    }
}

/// The sums of |A| times the modes' deviations from the chord.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn sum_sags(rows: &[Vec<Lane>; 2], sizes: &[ModeSizes]) -> Lane {
    let mut sum = [0.0; LANES];
    for (kind, row) in rows.iter().enumerate() {
        for (rows, sizes) in row.as_chunks::<LANES>().0.iter().zip(sizes) {
            for (row, sag) in rows.iter().zip(sizes.sag[kind]) {
                sum = each(|i| sum[i] + row[i].abs() * sag);
            }
        }
    }
    sum
}

#[multiversion::multiversion(targets("x86_64+avx2"))]
fn values_at<const N: usize>(rows: &[Vec<Lane>; 2], motion: &[[[f64; N]; 2]], at_rest: &Lane) -> [[f64; N]; LANES] {
    let mut all = [[0.0; N]; LANES];
    // Two quantities at a time stay in registers.
    for (pair, out) in all.chunks_exact_mut(2).enumerate() {
        let (i, j) = (2 * pair, 2 * pair + 1);
        let (mut one, mut other) = ([at_rest[i]; N], [at_rest[j]; N]);
        for (kind, row) in rows.iter().enumerate() {
            for (row, motion) in row.iter().zip(motion) {
                for t in 0..N {
                    one[t] += row[i] * motion[kind][t];
                    other[t] += row[j] * motion[kind][t];
                }
            }
        }
        (out[0], out[1]) = (one, other);
    }
    all
}

/// The larger magnitude at the start and at the end of each flight, from the values at their ends.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn highest_at<const N: usize>(values: &[[f64; N]; LANES]) -> [[f64; N]; LANES] {
    let mut highest = [[0.0; N]; LANES];
    for i in 0..LANES {
        for k in 0..N - 1 {
            highest[i][k] = larger(values[i][k].abs(), values[i][k + 1].abs());
        }
    }
    highest
}

/// The same with what pushes add at the starts and at the ends.
fn highest_of_pushed<const N: usize>(values: &[[f64; N]; LANES], [starts, ends]: &[[Lane; N]; 2]) -> [[f64; N]; LANES] {
    let mut highest = [[0.0; N]; LANES];
    for k in 0..N - 1 {
        for i in 0..LANES {
            let (start, end) = (values[i][k] + starts[k][i], values[i][k + 1] + ends[k][i]);
            highest[i][k] = larger(start.abs(), end.abs());
        }
    }
    highest
}
