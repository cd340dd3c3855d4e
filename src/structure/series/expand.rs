//! The terms of a motion from the equation of motion, power by power.

use super::MotionSeries;
use crate::numerics::polynomial::{COUNT, MAX_TERMS, each};
use crate::numerics::time_map::TimeMap;
use crate::structure::equations::Structure;
use crate::structure::floors::Floors;
use crate::structure::lanes::{LANES, Lane};
use crate::structure::motion::{LinearLoad, Motion};
use std::ops::Range;

/// Most powers of a series.
const MOST_POWERS: usize = 40;

/// 1 / ((n + 1) (n + 2)).
pub(crate) const SECOND_RECIPROCAL: [f64; MOST_POWERS] = {
    let mut table = [0.0; MOST_POWERS];
    let mut n = 0;
    while n < MOST_POWERS {
        table[n] = 1.0 / ((n + 1) * (n + 2)) as f64;
        n += 1;
    }
    table
};

/// Relative remainder below which a truncated series is exact to rounding.
pub const EXACT: f64 = 1e-19;

/// Largest (fastest rate) x (time), rad, that one series of a flight reaches.
pub const LONGEST_ANGLE: f64 = 2.0;

/// The same of the pieces in which a flight is searched or accounted for: shorter ones need fewer powers.
pub const PIECE_ANGLE: f64 = 1.5;

/// Order at which the flight series over an `angle` = (fastest rate) x (time), rad, is good to a relative `remainder`, which is
/// estimated by angle^n / n!; `None` where the interval is too long for a series.
pub fn flight_order(angle: f64, remainder: f64) -> Option<usize> {
    if angle > LONGEST_ANGLE {
        return None;
    }
    // Counted in both types: a conversion in each turn would cost more than the rest of it.
    let (mut term, mut order, mut count) = (1.0, 0, 0.0);
    while order < 4 || term > remainder {
        order += 1;
        count += 1.0;
        term *= angle / count;
    }
    Some(order)
}

/// The forces of pairs while a series is expanded, power by power.
pub trait PairForces {
    /// Adds the accelerations by power n of the forces, times `factor`, to power n + 2 of the motion, and reads power n
    /// + 2 of the penetrations from the result.
    fn act(&mut self, n: usize, factor: f64, term: &mut [Lane]);
}

impl MotionSeries {
    /// Appends power n + 2 from the load's power n (in 1/scale^n), by (n+1)(n+2) q_{n+2} = load_n - c (n+1) q_{n+1} -
    /// w^2 q_n.
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

    /// Expands from a started series of modes to `order`, or goes on with an expanded one, under a load, its slope and the
    /// forces of some pairs.
    pub fn expand_modes(
        &mut self,
        structure: &Structure,
        order: usize,
        loads: LinearLoad,
        forces: &mut impl PairForces,
    ) {
        expand_modes(self, structure, order, loads, forces);
    }

    /// Expands from a started series of all floors to `order`, or goes on with an expanded one, under a load, its slope and
    /// the forces of some pairs.
    pub fn expand_floors(&mut self, floors: &Floors, order: usize, loads: LinearLoad, forces: &mut impl PairForces) {
        expand_floors(self, floors, order, loads, forces);
    }

    /// Expands a flight: load and slope only.
    pub fn expand_flight(&mut self, structure: &Structure, motion: Motion, loads: LinearLoad, extent: (f64, usize)) {
        self.expand_flight_of(0..self.lanes, structure, motion, loads, extent);
    }

    /// The same for some modes; where damping couples modes, for all.
    pub fn expand_flight_of(
        &mut self,
        modes: Range<usize>,
        structure: &Structure,
        motion: Motion,
        loads: LinearLoad,
        (scale, order): (f64, usize),
    ) {
        if structure.is_classical() {
            return expand_single_modes(self, (structure, modes), motion, loads, (scale, order));
        }
        self.start(scale, motion.q, motion.v);
        while self.order < order.max(2) {
            let n = self.order - 1;
            let load_of_power = |out: &mut [f64]| match n {
                0 => out.copy_from_slice(loads.load),
                1 => out.iter_mut().zip(loads.slope).for_each(|(out, slope)| *out = slope * scale),
                _ => {}
            };
            self.extend(structure, load_of_power, |_| {});
        }
    }
}

/// Expands a flight of modes that damping does not couple, one block of modes after the other: its last two terms stay
/// in registers.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn expand_single_modes(
    series: &mut MotionSeries,
    (structure, modes): (&Structure, Range<usize>),
    Motion { q, v }: Motion,
    LinearLoad { load, slope }: LinearLoad,
    (scale, order): (f64, usize),
) {
    series.scale = scale;
    series.time_map = TimeMap::default();
    series.order = order.max(3);
    let width = series.lanes / LANES;
    let scale2 = scale * scale;
    let [(q, _), (v, _), (load, _), (slope, _), (damping, _), (omega2, _)] =
        [q, v, load, slope, &structure.damping, &structure.omega2].map(|vector| vector.as_chunks::<LANES>());
    let (terms, _) = series.coefficients.as_chunks_mut::<LANES>();
    for c in modes.start / LANES..modes.end.div_ceil(LANES) {
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
            (before, last) = (last, next_of(COUNT[n + 1], SECOND_RECIPROCAL[n], load, &before, &last));
            terms[(n + 2) * width + c] = last;
        }
        let rows = terms[4 * width..(series.order + 1) * width].chunks_exact_mut(width);
        for ((row, count), factor) in rows.zip(&COUNT[3..]).zip(&SECOND_RECIPROCAL[2..]) {
            (before, last) = (last, next_of(*count, *factor, &[0.0; LANES], &before, &last));
            row[c] = last;
        }
    }
}

/// See [`MotionSeries::expand_modes`].
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn expand_modes<F: PairForces>(
    series: &mut MotionSeries,
    structure: &Structure,
    order: usize,
    loads: LinearLoad,
    forces: &mut F,
) {
    match series.lanes / LANES {
        1 => expand_blocks::<1, F>(series, structure, order, loads, forces),
        2 => expand_blocks::<2, F>(series, structure, order, loads, forces),
        _ => expand_blocks::<0, F>(series, structure, order, loads, forces),
    }
}

/// The same for `N` blocks of modes, or for any number of blocks where N is 0.
#[inline(always)]
fn expand_blocks<const N: usize, F: PairForces>(
    series: &mut MotionSeries,
    structure: &Structure,
    order: usize,
    LinearLoad { load, slope }: LinearLoad,
    forces: &mut F,
) {
    let (scale, is_coupled) = (series.scale, !structure.is_classical());
    let width = if N > 0 { N } else { series.lanes / LANES };
    let vectors = [&structure.damping, &structure.omega2, load, slope];
    let [damping, omega2, load, slope] = vectors.map(|of| &of.as_chunks::<LANES>().0[..width]);
    let (terms, _) = series.coefficients.as_chunks_mut::<LANES>();
    for n in series.order - 1..order - 1 {
        let (known, rest) = terms.split_at_mut((n + 2) * width);
        let (before, last) = known[n * width..].split_at(width);
        let next = &mut rest[..width];
        let factor = scale * scale * SECOND_RECIPROCAL[n];
        let rate = (n + 1) as f64 * (scale * SECOND_RECIPROCAL[n]);
        // All of damping first, of which the off-diagonal part is as large as the rest.
        if is_coupled {
            next.fill([0.0; LANES]);
            structure.subtract_coupling(last.as_flattened(), rate, next.as_flattened_mut());
        }
        for c in 0..width {
            let load: Lane = match n {
                0 => load[c],
                1 => slope[c].map(|slope| slope * scale),
                _ => [0.0; LANES],
            };
            let coupled = if is_coupled { next[c] } else { [0.0; LANES] };
            next[c] = each(|i| {
                let pulled = (factor * omega2[c][i]) * before[c][i];
                (factor * load[i] - pulled) - ((rate * damping[c][i]) * last[c][i] - coupled[i])
            });
        }
        forces.act(n, factor, next);
    }
    series.order = order;
}

/// See [`MotionSeries::expand_floors`].
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn expand_floors<F: PairForces>(
    series: &mut MotionSeries,
    floors: &Floors,
    order: usize,
    LinearLoad { load, slope }: LinearLoad,
    forces: &mut F,
) {
    let lanes = series.lanes;
    let (scale2, inverse) = (series.scale * series.scale, 1.0 / series.scale);
    let first = series.order - 1;
    if first == 0 {
        series.coefficients[2 * lanes..3 * lanes].copy_from_slice(&load[..lanes]);
        series.coefficients[3 * lanes..4 * lanes].copy_from_slice(&slope[..lanes]);
    }
    for n in first..(order - 1).min(MAX_TERMS - 3) {
        let (known, rest) = series.coefficients.split_at_mut((n + 2) * lanes);
        let (u, v) = known[n * lanes..].split_at(lanes);
        let (next, _) = rest[..lanes].as_chunks_mut::<LANES>();
        let rate = COUNT[n + 1] * inverse;
        let factor = scale2 * SECOND_RECIPROCAL[n];
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
