//! A flight that one power series reaches over, straight to its end.

use super::series::RECIPROCAL;
use super::{LANES, Lane, Structure};
use crate::polynomial::{COUNT, ROOM};

/// Room for the terms of a flight that is hardly one.
const FEW_TERMS: usize = 8;

/// Flies `q`, `v` over `h`, s, under a modal load and its slope, where damping couples no modes, by a series of at least
/// `order`, into `end_q`, `end_v`: what [`super::MotionSeries::expand_flight`] evaluates to there, bit for bit, without
/// keeping the terms.
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub fn fly_in_one_series(
    structure: &Structure,
    motion: (&[f64], &[f64]),
    loads: (&[f64], &[f64]),
    (h, order): (f64, usize),
    end: (&mut [f64], &mut [f64]),
) {
    let order = order.max(3);
    if order < FEW_TERMS {
        fly::<FEW_TERMS>(structure, motion, loads, (h, order), end);
    } else {
        fly::<ROOM>(structure, motion, loads, (h, order), end);
    }
}

/// The same with room for so many terms of a block of modes.
#[inline(always)]
fn fly<const TERMS: usize>(
    structure: &Structure,
    (q, v): (&[f64], &[f64]),
    (load, slope): (&[f64], &[f64]),
    (h, order): (f64, usize),
    (end_q, end_v): (&mut [f64], &mut [f64]),
) {
    let (h2, rate) = (h * h, 1.0 / h);
    let [(q, _), (v, _), (load, _), (slope, _), (damping, _), (omega2, _)] =
        [q, v, load, slope, &structure.damping, &structure.omega2].map(<[f64]>::as_chunks::<LANES>);
    let [(end_q, _), (end_v, _)] = [end_q, end_v].map(<[f64]>::as_chunks_mut::<LANES>);
    let mut terms = [[0.0; LANES]; TERMS];
    for c in 0..structure.lanes / LANES {
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
    let each = terms[2..].iter_mut().zip(&COUNT[1..]).zip(&RECIPROCAL).enumerate();
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
    use crate::polynomial::Powers;
    use crate::scene::Scene;
    use crate::structure::{EXACT, MotionSeries, flight_order};

    #[test]
    fn it_ends_where_the_series_does_to_the_last_bit() {
        let building = |n: usize, stiffness: f64| {
            format!("mass = {:?}\nstiffness = {:?}\ndamping = {{ ratio = 0.07 }}", vec![2.0; n], vec![stiffness; n])
        };
        let text = format!("name = \"Two\"\n[left]\n{}\n[right]\n{}", building(4, 300.0), building(7, 900.0));
        let scene = Scene::from_toml(&text).unwrap();
        let structure = Structure::new(&scene.left, &scene.right).unwrap();
        let vector = |seed: f64| (0..structure.lanes).map(|m| (seed + 1.3 * m as f64).sin()).collect::<Vec<_>>();
        let (q, v, load, slope) = (vector(0.1), vector(0.7), vector(1.9), vector(2.3));
        let mut series = MotionSeries::new(structure.lanes, ROOM - 1);
        let mut powers = Powers::default();
        let [mut q0, mut v0, mut q1, mut v1] = [(); 4].map(|()| vec![f64::NAN; structure.lanes]);
        for reach in [1e-17, 1e-9, 1e-4, 0.01, 0.1, 0.3, 0.5, 0.9, 1.3, 2.0] {
            let h = reach / structure.fastest;
            let order = flight_order(structure.fastest * h, EXACT).unwrap();
            series.expand_flight(&structure, (&q, &v), (&load, &slope), (h, order));
            powers.set(1.0, series.order);
            series.evaluate(&powers, &mut q0, &mut v0);
            fly_in_one_series(&structure, (&q, &v), (&load, &slope), (h, order), (&mut q1, &mut v1));
            let bits = |q: &[f64], v: &[f64]| q.iter().chain(v).map(|x| x.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&q0, &v0), bits(&q1, &v1), "{reach}");
        }
    }
}
