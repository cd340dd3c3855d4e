//! A flight short enough for one power series, straight to its end.

use super::equations::Structure;
use super::lanes::{LANES, Lane};
use super::motion::{LinearLoad, Motion, MotionMut};
use super::series::expand::{EXACT, SECOND_RECIPROCAL, flight_order};
use crate::numerics::polynomial::{COUNT, MAX_TERMS};

/// Up to this (fastest rate) x (time) a series of this order is exact to rounding: flights between instants that are
/// the same but for rounding.
const TINY_ANGLE: f64 = 1e-6;
const TINY_ANGLE_ORDER: usize = 4;

/// Order at which the series of a flight over `angle` = (fastest rate) x (time) is exact to rounding; `None` where it
/// is too long for one.
#[inline]
pub fn exact_order(angle: f64) -> Option<usize> {
    if angle <= TINY_ANGLE { Some(TINY_ANGLE_ORDER) } else { flight_order(angle, EXACT) }
}

/// Flies `q`, `v` over `h`, s, under a modal load and its slope, where damping couples no modes, by a series of at least
/// `order`, into `end_q`, `end_v`: what [`super::MotionSeries::expand_flight`] evaluates to there, bit for bit, without
/// keeping the terms.
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub fn fly_in_one_series(
    structure: &Structure,
    motion: Motion,
    loads: LinearLoad,
    (h, order): (f64, usize),
    end: MotionMut,
) {
    if order <= TINY_ANGLE_ORDER {
        // Terms whose number is known stay in registers.
        fly::<{ TINY_ANGLE_ORDER + 1 }>(structure, motion, loads, (h, TINY_ANGLE_ORDER), end);
    } else {
        fly::<MAX_TERMS>(structure, motion, loads, (h, order), end);
    }
}

/// The same with room for so many terms of a block of modes.
#[inline(always)]
fn fly<const TERMS: usize>(
    structure: &Structure,
    Motion { q, v }: Motion,
    LinearLoad { load, slope }: LinearLoad,
    (h, order): (f64, usize),
    MotionMut { q: end_q, v: end_v }: MotionMut,
) {
    let (h2, rate) = (h * h, 1.0 / h);
    let [(q, _), (v, _), (load, _), (slope, _), (damping, _), (omega2, _)] =
        [q, v, load, slope, &structure.damping, &structure.omega2].map(<[f64]>::as_chunks::<LANES>);
    let [(end_q, _), (end_v, _)] = [end_q, end_v].map(<[f64]>::as_chunks_mut::<LANES>);
    // Equal lengths: no bounds checks below.
    let width = structure.lanes / LANES;
    let (q, v, load, slope) = (&q[..width], &v[..width], &load[..width], &slope[..width]);
    let (damping, omega2) = (&damping[..width], &omega2[..width]);
    let (end_q, end_v) = (&mut end_q[..width], &mut end_v[..width]);
    let mut terms = [[0.0; LANES]; TERMS];
    for c in 0..width {
        terms[0] = q[c];
        terms[1] = v[c].map(|v| v * h);
        let loads = [load[c].map(|load| load * h2), slope[c].map(|slope| slope * (h2 * h))];
        let rates = (damping[c].map(|damping| damping * h), omega2[c].map(|omega2| omega2 * h2));
        let terms = &mut terms[..=order];
        expand(terms, loads, rates);
        let (q, v) = sums(terms);
        end_q[c] = q;
        end_v[c] = v.map(|v| v * rate);
    }
}

/// (n+1)(n+2) q_{n+2} = load_n - (n+1) damping q_{n+1} - w^2 q_n in units of h.
#[inline(always)]
fn expand(terms: &mut [Lane], loads: [Lane; 2], (damping, omega2): (Lane, Lane)) {
    let (mut before, mut last) = (terms[0], terms[1]);
    let each = terms[2..].iter_mut().zip(&COUNT[1..]).zip(&SECOND_RECIPROCAL).enumerate();
    for (n, ((term, count), factor)) in each {
        let mut next = loads.get(n).copied().unwrap_or_default();
        for i in 0..LANES {
            next[i] = (next[i] - (count * damping[i] * last[i] + omega2[i] * before[i])) * factor;
        }
        *term = next;
        (before, last) = (last, next);
    }
}

/// Sums of the terms and of n times the terms, from the smallest to the largest.
#[inline(always)]
fn sums(terms: &[Lane]) -> (Lane, Lane) {
    let (mut value, mut slope) = ([0.0; LANES], [0.0; LANES]);
    for (term, count) in terms.iter().zip(&COUNT).rev() {
        for i in 0..LANES {
            value[i] += term[i];
            slope[i] += term[i] * count;
        }
    }
    (value, slope)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::numerics::powers::Powers;
    use crate::scene::Scene;
    use crate::structure::MotionSeries;

    #[test]
    fn the_order_over_a_tiny_angle_is_that_over_any_other() {
        for angle in [0.0, 1e-300, 1e-17, 1e-9, 0.999 * TINY_ANGLE, TINY_ANGLE, 1.001 * TINY_ANGLE, 1e-3, 0.7, 2.0, 2.1]
        {
            assert_eq!(exact_order(angle), flight_order(angle, EXACT), "{angle}");
        }
    }

    #[test]
    fn it_ends_where_the_series_does_to_the_last_bit() {
        let building = |n: usize, stiffness: f64| {
            format!("mass = {:?}\nstiffness = {:?}\ndamping = {{ ratio = 0.07 }}", vec![2.0; n], vec![stiffness; n])
        };
        let text = format!("name = \"Two\"\n[left]\n{}\n[right]\n{}", building(4, 300.0), building(7, 900.0));
        let scene = Scene::from_toml(&text).unwrap();
        let structure = Structure::of(&scene).unwrap();
        let vector = |seed: f64| (0..structure.lanes).map(|m| (seed + 1.3 * m as f64).sin()).collect::<Vec<_>>();
        let (q, v, load, slope) = (vector(0.1), vector(0.7), vector(1.9), vector(2.3));
        let (motion, loads) = (Motion { q: &q, v: &v }, LinearLoad { load: &load, slope: &slope });
        let mut series = MotionSeries::new(structure.lanes, MAX_TERMS - 1);
        let mut powers = Powers::default();
        let [mut q0, mut v0, mut q1, mut v1] = [(); 4].map(|()| vec![f64::NAN; structure.lanes]);
        for angle in [1e-17, 1e-9, 1e-4, 0.01, 0.1, 0.3, 0.5, 0.9, 1.3, 2.0] {
            let h = angle / structure.fastest;
            let order = exact_order(structure.fastest * h).unwrap();
            series.expand_flight(&structure, motion, loads, (h, order));
            powers.set(1.0, series.order);
            series.evaluate(&powers, &mut q0, &mut v0);
            fly_in_one_series(&structure, motion, loads, (h, order), MotionMut { q: &mut q1, v: &mut v1 });
            let bits = |q: &[f64], v: &[f64]| q.iter().chain(v).map(|x| x.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&q0, &v0), bits(&q1, &v1), "{angle}");
        }
    }
}
