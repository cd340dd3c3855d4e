//! Power series in time of all modes, or of all floors: the dense solution of a step.

use super::floors::Floors;
use super::{LANES, Lane, Structure};
use crate::numerics::polynomial::{COUNT, ROOM, each};
use crate::numerics::powers::Powers;
use crate::numerics::time_map::Clock;

/// Powers that a series may have.
const MOST_POWERS: usize = 40;

/// 1 / ((n + 1) (n + 2)).
pub(super) const RECIPROCAL: [f64; MOST_POWERS] = {
    let mut table = [0.0; MOST_POWERS];
    let mut n = 0;
    while n < MOST_POWERS {
        table[n] = 1.0 / ((n + 1) * (n + 2)) as f64;
        n += 1;
    }
    table
};

/// Blocks of modes that are few.
pub const FEW_BLOCKS: usize = 4;

/// Remainder of a series that is exact to rounding.
pub const EXACT: f64 = 1e-19;

/// Order at which the flight series over `reach` = (fastest rate) x (time) is good to a relative `remainder`; `None`
/// where the interval is too long for a series.
pub fn flight_order(reach: f64, remainder: f64) -> Option<usize> {
    if reach > 2.0 {
        return None;
    }
    let (mut term, mut order) = (1.0, 0);
    while term > remainder || order < 4 {
        order += 1;
        term *= reach / order as f64;
    }
    Some(order)
}

/// The forces of pairs while a series is expanded, power by power.
pub trait PairForces {
    /// Adds what power n of the forces does, per unit of mass and times `factor`, to power n + 2 of the motion, and takes
    /// from it the same power of the penetrations.
    fn act(&mut self, n: usize, factor: f64, term: &mut [Lane]);
}

/// q(t) = sum of term n times (t / scale)^n, of all modes or floors, read at t / scale or at the x of a clock.
#[derive(Clone, Debug, Default)]
pub struct MotionSeries {
    lanes: usize,
    /// s, unit of x: near the length of the step, so that the terms tell the error and never overflow.
    pub scale: f64,
    /// What the x is that the series is read at; its terms stay those in time, in units of the scale.
    pub clock: Clock,
    /// Highest power.
    pub order: usize,
    coefficients: Vec<f64>,
}

impl MotionSeries {
    /// Room for powers up to `highest`.
    pub fn new(lanes: usize, highest: usize) -> MotionSeries {
        MotionSeries {
            lanes,
            scale: 1.0,
            clock: Clock::default(),
            order: 0,
            coefficients: vec![0.0; lanes * (highest + 1)],
        }
    }

    /// Starts a series from a state.
    pub fn start(&mut self, scale: f64, q: &[f64], v: &[f64]) {
        self.scale = scale;
        self.clock = Clock::default();
        self.order = 1;
        let (first, rest) = self.coefficients.split_at_mut(self.lanes);
        first.copy_from_slice(q);
        for (c, v) in rest.iter_mut().zip(v) {
            *c = v * scale;
        }
    }

    /// s at x.
    pub fn time(&self, x: f64) -> f64 {
        self.clock.time(x) * self.scale
    }

    /// dt/dx at x, s.
    pub fn time_rate(&self, x: f64) -> f64 {
        self.clock.rate(x) * self.scale
    }

    /// x at a time, s.
    pub fn place(&self, time: f64) -> f64 {
        self.clock.place(time / self.scale)
    }

    /// The powers of the x at a time, s.
    pub fn set_powers(&self, time: f64, powers: &mut Powers) {
        powers.set_by(&self.clock, self.place(time), self.order);
        powers.set_in_time(&self.clock);
    }

    /// The same in a table of its own.
    pub fn powers_at(&self, time: f64) -> Powers {
        let mut powers = Powers::default();
        self.set_powers(time, &mut powers);
        powers
    }

    /// The coefficients of power `n`.
    pub fn term(&self, n: usize) -> &[f64] {
        &self.coefficients[n * self.lanes..(n + 1) * self.lanes]
    }

    /// The coefficients of all powers, block by block.
    #[inline(always)]
    pub fn rows(&self) -> impl Iterator<Item = &[Lane]> {
        let (terms, _) = self.coefficients.as_chunks::<LANES>();
        terms.chunks_exact(self.lanes / LANES).take(self.order + 1)
    }

    /// Appends power n + 2 from the load's power n (in 1/scale^n), by (n+1)(n+2) q_{n+2} = load_n - c (n+1) q_{n+1} - w^2 q_n.
    ///
    /// `load` adds the modal load of power n to its argument, which holds zeros, in units of the load itself, and
    /// `constrain` may change the modal accelerations that follow from it.
    pub fn extend(&mut self, structure: &Structure, load: impl FnOnce(&mut [f64]), constrain: impl FnOnce(&mut [f64])) {
        let n = self.order - 1;
        let lanes = self.lanes;
        let (known, next) = self.coefficients.split_at_mut((n + 2) * lanes);
        let (q0, q1) = (&known[n * lanes..(n + 1) * lanes], &known[(n + 1) * lanes..]);
        let next = &mut next[..lanes];
        next.fill(0.0);
        load(next);
        let (k1, k2) = ((n + 1) as f64, (n + 2) as f64);
        let rate = k1 / self.scale;
        for m in 0..lanes {
            next[m] -= rate * structure.damping[m] * q1[m] + structure.omega2[m] * q0[m];
        }
        structure.subtract_coupling(q1, rate, next);
        constrain(next);
        let factor = self.scale * self.scale / (k1 * k2);
        for value in next.iter_mut() {
            *value *= factor;
        }
        self.order += 1;
    }

    /// Expands from a started series of modes that damping does not couple to `order`, or goes on with an expanded one, under
    /// a load, its slope and the forces of some pairs; the terms of up to [`FEW_BLOCKS`] blocks of modes stay in registers.
    pub fn expand_few_modes(
        &mut self,
        structure: &Structure,
        order: usize,
        loads: (&[f64], &[f64]),
        forces: &mut impl PairForces,
    ) {
        match self.lanes / LANES {
            1 => expand_blocks::<1, _>(self, structure, order, loads, forces),
            2 => expand_blocks::<2, _>(self, structure, order, loads, forces),
            3 => expand_blocks::<3, _>(self, structure, order, loads, forces),
            _ => expand_blocks::<FEW_BLOCKS, _>(self, structure, order, loads, forces),
        }
    }

    /// The same for any number of modes.
    pub fn expand_modes(
        &mut self,
        structure: &Structure,
        order: usize,
        (load, slope): (&[f64], &[f64]),
        forces: &mut impl PairForces,
    ) {
        let lanes = self.lanes;
        for n in self.order - 1..order - 1 {
            let (known, rest) = self.coefficients.split_at_mut((n + 2) * lanes);
            let (before, last) = known[n * lanes..].split_at(lanes);
            let next = &mut rest[..lanes];
            match n {
                0 => next.copy_from_slice(load),
                1 => next.iter_mut().zip(slope).for_each(|(next, slope)| *next = slope * self.scale),
                _ => next.fill(0.0),
            }
            let factor = self.scale * self.scale * RECIPROCAL[n];
            let rate = (n + 1) as f64 * (self.scale * RECIPROCAL[n]);
            for m in 0..lanes {
                let pulled = (factor * structure.omega2[m]) * before[m];
                next[m] = (factor * next[m] - pulled) - (rate * structure.damping[m]) * last[m];
            }
            forces.act(n, factor, next.as_chunks_mut::<LANES>().0);
        }
        self.order = order;
    }

    /// Expands from a started series of all floors to `order`, or goes on with an expanded one, under a load, its slope and
    /// the forces of some pairs.
    pub fn expand_floors(
        &mut self,
        floors: &Floors,
        order: usize,
        loads: (&[f64], &[f64]),
        forces: &mut impl PairForces,
    ) {
        expand_floors(self, floors, order, loads, forces);
    }

    /// Expands a flight: load and slope only.
    pub fn expand_flight(
        &mut self,
        structure: &Structure,
        (q, v): (&[f64], &[f64]),
        (load, slope): (&[f64], &[f64]),
        (scale, order): (f64, usize),
    ) {
        if structure.is_classical() {
            return expand_single_modes(self, structure, (q, v), (load, slope), (scale, order));
        }
        self.start(scale, q, v);
        while self.order < order.max(2) {
            let n = self.order - 1;
            let load_of_power = |out: &mut [f64]| match n {
                0 => out.copy_from_slice(load),
                1 => out.iter_mut().zip(slope).for_each(|(out, slope)| *out = slope * scale),
                _ => {}
            };
            self.extend(structure, load_of_power, |_| {});
        }
    }

    /// q and v at the x of the powers.
    pub fn evaluate(&self, powers: &Powers, q: &mut [f64], v: &mut [f64]) {
        let terms = (self.order + 1).min(ROOM);
        let (value, rate) = powers.in_time();
        let (q, v) = (&mut q[..self.lanes], &mut v[..self.lanes]);
        let terms = (&self.coefficients[..terms * self.lanes], (&value[..terms], &rate[..terms]));
        sum_terms(terms.0, terms.1, 1.0 / self.scale, q, v);
    }

    /// What the sizes of all terms from the power `first` on add up to at x, for each mode or floor, m.
    pub fn sum_sizes(&self, first: usize, x: f64, sizes: &mut [f64]) {
        let mut powers = [1.0; ROOM];
        for n in 1..=self.order.min(ROOM - 1) {
            powers[n] = powers[n - 1] * x;
        }
        let terms = &self.coefficients[first * self.lanes..(self.order + 1) * self.lanes];
        sum_sizes(terms, &powers[first..], &mut sizes[..self.lanes]);
    }

    /// The last two terms of the velocities by its clock, m, which tell how far its x reaches; returns their powers.
    pub fn last_rates(&self, last: &mut [f64], before: &mut [f64]) -> [usize; 2] {
        let powers = [self.order - 1, self.order - 2];
        let [mut of_last, mut of_before] = [[0.0; ROOM]; 2];
        self.clock.weigh_rate_term(powers[0], &mut of_last);
        self.clock.weigh_rate_term(powers[1], &mut of_before);
        let first = powers[1] / 2;
        let terms = &self.coefficients[first * self.lanes..(self.order + 1) * self.lanes];
        let factors = (&of_last[first..=self.order], &of_before[first..=self.order]);
        sum_terms(terms, factors, 1.0, &mut last[..self.lanes], &mut before[..self.lanes]);
        powers
    }

    /// The scalar series of what `row` makes of the modes, 0 where its terms cancel but for rounding, written to `out[n]`.
    /// Returns the sum of the sizes of all that is added up, each times its `factor`.
    pub fn project(&self, row: &[f64], factors: &[f64], out: &mut [f64]) -> f64 {
        project(&self.coefficients[..], row, factors, &mut out[..=self.order])
    }

    /// The scalar series of what `row` makes of the modes, from the power `first` on: each term as [`dot`] has it, written to
    /// `out[n]`.
    pub fn dot_each(&self, row: &[f64], first: usize, out: &mut [f64]) {
        dot_each(&self.coefficients[first * self.lanes..], row, &mut out[first..=self.order]);
    }

    /// v of one mode at many places, which are told by what the terms in time are multiplied by there.
    pub fn velocities<const N: usize>(&self, mode: usize, rates: &[[f64; N]; ROOM]) -> [f64; N] {
        let mut rate = [0.0; N];
        for (n, rates) in rates.iter().enumerate().take(self.order + 1) {
            let term = self.coefficients[n * self.lanes + mode];
            for i in 0..N {
                rate[i] += term * rates[i];
            }
        }
        rate.map(|rate| rate / self.scale)
    }
}

/// Adds up terms, one vector each, times their powers and times the slopes of these: q and, times `rate`, v. From the last
/// terms to the first, which are the largest. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub fn sum_terms(terms: &[f64], powers: (&[f64], &[f64]), rate: f64, q: &mut [f64], v: &mut [f64]) {
    let (terms, _) = terms.as_chunks::<LANES>();
    let (q, v) = (q.as_chunks_mut::<LANES>().0, v.as_chunks_mut::<LANES>().0);
    let terms = (terms, q.len());
    // As many blocks at a time as have their sums in registers side by side.
    let mut first = 0;
    while first < q.len() {
        first += match q.len() - first {
            1 => sum_next::<1>(terms, first, powers, rate, (q, v)),
            2 => sum_next::<2>(terms, first, powers, rate, (q, v)),
            3 => sum_next::<3>(terms, first, powers, rate, (q, v)),
            5 => sum_next::<5>(terms, first, powers, rate, (q, v)),
            6 => sum_next::<6>(terms, first, powers, rate, (q, v)),
            _ => sum_next::<4>(terms, first, powers, rate, (q, v)),
        };
    }
}

/// Enters `N` blocks of q and v, from the `first` on; returns how many that are.
#[inline(always)]
fn sum_next<const N: usize>(
    terms: (&[Lane], usize),
    first: usize,
    powers: (&[f64], &[f64]),
    rate: f64,
    (q, v): (&mut [Lane], &mut [Lane]),
) -> usize {
    let (sums, rates) = sum_blocks::<N>(terms, first, powers, rate);
    q[first..first + N].copy_from_slice(&sums);
    v[first..first + N].copy_from_slice(&rates);
    N
}

/// q and v of `N` blocks of lanes.
#[inline(always)]
fn sum_blocks<const N: usize>(
    (terms, width): (&[Lane], usize),
    first: usize,
    (powers, slopes): (&[f64], &[f64]),
    rate: f64,
) -> ([Lane; N], [Lane; N]) {
    let (mut value, mut change) = ([[0.0; LANES]; N], [[0.0; LANES]; N]);
    for (row, (power, slope)) in terms.chunks_exact(width).zip(powers.iter().zip(slopes)).rev() {
        let row = &row[first..first + N];
        for c in 0..N {
            for i in 0..LANES {
                value[c][i] += row[c][i] * power;
                change[c][i] += row[c][i] * slope;
            }
        }
    }
    (value, change.map(|change| change.map(|change| change * rate)))
}

/// Adds up the sizes of terms, one vector each, times some factors. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub fn sum_sizes(terms: &[f64], factors: &[f64], out: &mut [f64]) {
    let (out, _) = out.as_chunks_mut::<LANES>();
    let (terms, width) = (terms.as_chunks::<LANES>().0, out.len());
    let terms = (terms, width);
    let mut first = 0;
    while first < width {
        first += match width - first {
            1 => sum_next_sizes::<1>(terms, first, factors, out),
            2 => sum_next_sizes::<2>(terms, first, factors, out),
            3 => sum_next_sizes::<3>(terms, first, factors, out),
            4 => sum_next_sizes::<4>(terms, first, factors, out),
            5 => sum_next_sizes::<5>(terms, first, factors, out),
            6 => sum_next_sizes::<6>(terms, first, factors, out),
            7 => sum_next_sizes::<7>(terms, first, factors, out),
            _ => sum_next_sizes::<8>(terms, first, factors, out),
        };
    }
}

/// Enters `N` blocks, from the `first` on; returns how many that are.
#[inline(always)]
fn sum_next_sizes<const N: usize>(terms: (&[Lane], usize), first: usize, factors: &[f64], out: &mut [Lane]) -> usize {
    out[first..first + N].copy_from_slice(&sizes_of_blocks::<N>(terms, first, factors));
    N
}

#[inline(always)]
fn sizes_of_blocks<const N: usize>((terms, width): (&[Lane], usize), first: usize, factors: &[f64]) -> [Lane; N] {
    let mut sum = [[0.0; LANES]; N];
    for (row, factor) in terms.chunks_exact(width).zip(factors) {
        let row = &row[first..first + N];
        for c in 0..N {
            for i in 0..LANES {
                sum[c][i] += row[c][i].abs() * factor;
            }
        }
    }
    sum
}

/// A flight without coupling: each mode by itself, a few at a time, which then stay in registers. Wide instructions give
/// the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn expand_single_modes(
    series: &mut MotionSeries,
    structure: &Structure,
    (q, v): (&[f64], &[f64]),
    (load, slope): (&[f64], &[f64]),
    (scale, order): (f64, usize),
) {
    series.scale = scale;
    series.clock = Clock::default();
    series.order = order.max(3);
    let width = series.lanes / LANES;
    let scale2 = scale * scale;
    let [(q, _), (v, _), (load, _), (slope, _), (damping, _), (omega2, _)] =
        [q, v, load, slope, &structure.damping, &structure.omega2].map(|vector| vector.as_chunks::<LANES>());
    let (terms, _) = series.coefficients.as_chunks_mut::<LANES>();
    for c in 0..width {
        let a = damping[c].map(|damping| damping * scale);
        let b = omega2[c].map(|omega2| omega2 * scale2);
        let next_of = |count: f64, factor: f64, load: &Lane, before: &Lane, last: &Lane| -> Lane {
            each(|i| (load[i] - (count * a[i] * last[i] + b[i] * before[i])) * factor)
        };
        let mut before = q[c];
        let mut last = v[c].map(|v| v * scale);
        terms[c] = before;
        terms[width + c] = last;
        for (n, load) in [load[c].map(|l| l * scale2), slope[c].map(|l| l * (scale2 * scale))].iter().enumerate() {
            (before, last) = (last, next_of(COUNT[n + 1], RECIPROCAL[n], load, &before, &last));
            terms[(n + 2) * width + c] = last;
        }
        let rows = terms[4 * width..(series.order + 1) * width].chunks_exact_mut(width);
        for ((row, count), factor) in rows.zip(&COUNT[3..]).zip(&RECIPROCAL[2..]) {
            (before, last) = (last, next_of(*count, *factor, &[0.0; LANES], &before, &last));
            row[c] = last;
        }
    }
}

/// See [`MotionSeries::expand_few_modes`]. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn expand_blocks<const WIDTH: usize, F: PairForces>(
    series: &mut MotionSeries,
    structure: &Structure,
    order: usize,
    (load, slope): (&[f64], &[f64]),
    forces: &mut F,
) {
    let [damping, omega2, load, slope] =
        [&structure.damping, &structure.omega2, load, slope].map(first_blocks::<WIDTH>);
    let (terms, _) = series.coefficients.as_chunks_mut::<LANES>().0.as_chunks_mut::<WIDTH>();
    let first = series.order - 1;
    let (mut before, mut last) = (terms[first], terms[first + 1]);
    for ((n, reciprocal), term) in RECIPROCAL.iter().enumerate().skip(first).zip(&mut terms[first + 2..=order]) {
        let mut next = match n {
            0 => load,
            1 => slope.map(|slope| slope.map(|slope| slope * series.scale)),
            _ => [[0.0; LANES]; WIDTH],
        };
        let factor = series.scale * series.scale * reciprocal;
        let rate = (n + 1) as f64 * (series.scale * reciprocal);
        for c in 0..WIDTH {
            for i in 0..LANES {
                let pulled = (factor * omega2[c][i]) * before[c][i];
                next[c][i] = (factor * next[c][i] - pulled) - (rate * damping[c][i]) * last[c][i];
            }
        }
        forces.act(n, factor, &mut next);
        *term = next;
        (before, last) = (last, next);
    }
    series.order = order;
}

/// See [`MotionSeries::expand_floors`]. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn expand_floors<F: PairForces>(
    series: &mut MotionSeries,
    floors: &Floors,
    order: usize,
    (load, slope): (&[f64], &[f64]),
    forces: &mut F,
) {
    let lanes = series.lanes;
    let (scale2, inverse) = (series.scale * series.scale, 1.0 / series.scale);
    let first = series.order - 1;
    if first == 0 {
        series.coefficients[2 * lanes..3 * lanes].copy_from_slice(&load[..lanes]);
        series.coefficients[3 * lanes..4 * lanes].copy_from_slice(&slope[..lanes]);
    }
    for n in first..(order - 1).min(ROOM - 3) {
        let (known, rest) = series.coefficients.split_at_mut((n + 2) * lanes);
        let (u, v) = known[n * lanes..].split_at(lanes);
        let (next, _) = rest[..lanes].as_chunks_mut::<LANES>();
        let rate = COUNT[n + 1] * inverse;
        let factor = scale2 * RECIPROCAL[n];
        if n < 2 {
            let unit = if n == 0 { 1.0 } else { series.scale };
            floors.enter_resistance(u, v, rate, next, |load, resistance| (load * unit - resistance) * factor);
        } else {
            let pull = -factor;
            floors.enter_resistance(u, v, rate, next, |_, resistance| pull * resistance);
        }
        forces.act(n, factor, next);
    }
    series.order = order;
}

/// See [`MotionSeries::project`]: as [`difference`] has it, [`LANES`] powers abreast. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn project(terms: &[f64], row: &[f64], factors: &[f64], out: &mut [f64]) -> f64 {
    let (terms, row) = (terms.as_chunks::<LANES>().0, row.as_chunks::<LANES>().0);
    match row.len() {
        1 => project_blocks::<1>(terms, row, factors, out),
        2 => project_blocks::<2>(terms, row, factors, out),
        3 => project_blocks::<3>(terms, row, factors, out),
        _ => project_blocks::<0>(terms, row, factors, out),
    }
}

/// The same for `N` blocks of modes, or any number of them where that is 0.
#[inline(always)]
fn project_blocks<const N: usize>(terms: &[Lane], row: &[Lane], factors: &[f64], out: &mut [f64]) -> f64 {
    let width = if N > 0 { N } else { row.len() };
    let row = &row[..width];
    let mut whole = 0.0;
    let factors = factors.chunks(LANES);
    for ((out, terms), factors) in out.chunks_mut(LANES).zip(terms.chunks(LANES * width)).zip(factors) {
        let (mut sums, mut sizes) = ([[0.0; LANES]; LANES], [[0.0; LANES]; LANES]);
        for ((term, sum), size) in terms.chunks_exact(width).zip(&mut sums).zip(&mut sizes) {
            for c in 0..width {
                let product = each(|i| row[c][i] * term[c][i]);
                *sum = each(|i| sum[i] + product[i]);
                *size = each(|i| size[i] + product[i].abs());
            }
        }
        let [values, sizes] = [sums, sizes].map(|of| each(|k| from_left_to_right(of[k])));
        for (((out, value), size), factor) in out.iter_mut().zip(&values).zip(&sizes).zip(factors) {
            *out = if value.abs() <= 4.0 * f64::EPSILON * size { 0.0 } else { *value };
            whole += size * factor.abs();
        }
    }
    whole
}

/// See [`MotionSeries::dot_each`]. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn dot_each(terms: &[f64], row: &[f64], out: &mut [f64]) {
    let (terms, row) = (terms.as_chunks::<LANES>().0, row.as_chunks::<LANES>().0);
    for (out, term) in out.iter_mut().zip(terms.chunks_exact(row.len())) {
        let mut sum = [0.0; LANES];
        for (row, term) in row.iter().zip(term) {
            sum = each(|i| sum[i] + row[i] * term[i]);
        }
        *out = from_left_to_right(sum);
    }
}

/// The first blocks of a vector that has as many.
fn first_blocks<const WIDTH: usize>(vector: &[f64]) -> [Lane; WIDTH] {
    let mut blocks = [[0.0; LANES]; WIDTH];
    blocks.as_flattened_mut().copy_from_slice(&vector[..WIDTH * LANES]);
    blocks
}

/// The sum of products, 0 where its terms cancel but for rounding, and the sum of their sizes.
///
/// Two floors that move alike have a distance of 0 to rounding; the sign of that rounding must not decide what happens.
pub fn difference(row: &[f64], modal: &[f64]) -> (f64, f64) {
    let (mut sum, mut size) = ([0.0; LANES], [0.0; LANES]);
    for (row, q) in row.as_chunks::<LANES>().0.iter().zip(modal.as_chunks::<LANES>().0) {
        for i in 0..LANES {
            let product = row[i] * q[i];
            sum[i] += product;
            size[i] += product.abs();
        }
    }
    let [value, size] = [sum, size].map(from_left_to_right);
    if value.abs() <= 4.0 * f64::EPSILON * size { (0.0, size) } else { (value, size) }
}

/// Sum of products in a fixed order: one partial sum per lane, then the lanes from left to right.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    for (a, b) in a.as_chunks::<LANES>().0.iter().zip(b.as_chunks::<LANES>().0) {
        for i in 0..LANES {
            lanes[i] += a[i] * b[i];
        }
    }
    from_left_to_right(lanes)
}

#[inline(always)]
fn from_left_to_right([a, b, c, d]: Lane) -> f64 {
    ((a + b) + c) + d
}
