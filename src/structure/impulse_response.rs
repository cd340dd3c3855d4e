//! The impulse response of each mode in powers of time: h'' + c h' + w^2 h = 0 from h = 0, h' = 1.

use super::equations::Structure;
use super::lanes::{LANES, Lane};
use super::motion::MotionMut;
use super::series::sums::sum_blocks;
use crate::numerics::polynomial::{COUNT, each};
use std::ops::Range;

/// Powers of time of an impulse response.
pub const RESPONSE_POWERS: usize = 20;

/// That of all modes, where damping couples none.
#[derive(Clone, Debug)]
pub struct ImpulseResponse {
    lanes: usize,
    /// Power by power, s^(1 - k).
    terms: Vec<f64>,
    /// 1/s.
    fastest: f64,
}

impl ImpulseResponse {
    /// Of a structure; `None` where damping couples its modes.
    pub fn of(structure: &Structure) -> Option<ImpulseResponse> {
        if !structure.is_classical() {
            return None;
        }
        let lanes = structure.lanes;
        let mut terms = vec![0.0; RESPONSE_POWERS * lanes];
        terms[lanes..2 * lanes].fill(1.0);
        for k in 2..RESPONSE_POWERS {
            let (known, next) = terms.split_at_mut(k * lanes);
            let (before, last) = known[(k - 2) * lanes..].split_at(lanes);
            let k = k as f64;
            for m in 0..lanes {
                next[m] =
                    -((k - 1.0) * structure.damping[m] * last[m] + structure.omega2[m] * before[m]) / (k * (k - 1.0));
            }
        }
        Some(ImpulseResponse { lanes, terms, fastest: structure.fastest })
    }

    /// Power k of all modes.
    pub fn term(&self, k: usize) -> &[f64] {
        &self.terms[k * self.lanes..(k + 1) * self.lanes]
    }

    /// How many powers are needed over a time, s, for a relative `remainder`; `None` where it is too long.
    pub fn powers(&self, time: f64, remainder: f64) -> Option<usize> {
        let angle = self.fastest * time;
        let (mut term, mut k) = (1.0, 1);
        while term > remainder {
            k += 1;
            term *= angle / k as f64;
        }
        (k < RESPONSE_POWERS).then_some(k + 1)
    }

    /// The kernel G_pq, the response of the distance of pair p to a unit impulse at pair q, in powers of t, m/(N s^k),
    /// from the rows of both pairs.
    pub fn kernel(&self, row: &[f64], other: &[f64]) -> [f64; RESPONSE_POWERS] {
        kernel(self, (0..self.lanes, RESPONSE_POWERS), row, other)
    }

    /// Some first powers of that of a row that is 0 outside of some lanes.
    pub fn kernel_in(
        &self,
        (lanes, powers): (Range<usize>, usize),
        row: &[f64],
        other: &[f64],
    ) -> [f64; RESPONSE_POWERS] {
        kernel(self, (lanes, powers), row, other)
    }

    /// Subtracts the effect of a contact force from a motion, by the moments of the force, N s^(k+1): the integrals of
    /// (time left)^k F. The terms are summed first, from the smallest on, and meet the larger motion as one sum.
    pub fn push(&self, row: &[f64], moments: &[f64], motion: MotionMut) {
        push(self, row, moments, motion);
    }
}

/// See [`ImpulseResponse::kernel`].
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn kernel(
    response: &ImpulseResponse,
    (lanes, powers): (Range<usize>, usize),
    row: &[f64],
    other: &[f64],
) -> [f64; RESPONSE_POWERS] {
    let (width, blocks) = (response.lanes / LANES, lanes.start / LANES..lanes.end.div_ceil(LANES));
    let [row, other] = [row, other].map(|row| &row.as_chunks::<LANES>().0[blocks.clone()]);
    let mut kernel = [0.0; RESPONSE_POWERS];
    let terms = response.terms.as_chunks::<LANES>().0.chunks_exact(width);
    for (kernel, terms) in kernel.iter_mut().zip(terms).take(powers) {
        let mut sum = [0.0; LANES];
        for (term, (row, other)) in terms[blocks.clone()].iter().zip(row.iter().zip(other)) {
            sum = each(|i| sum[i] + row[i] * other[i] * term[i]);
        }
        *kernel = (sum[0] + sum[2]) + (sum[1] + sum[3]);
    }
    kernel
}

/// See [`ImpulseResponse::push`].
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn push(response: &ImpulseResponse, row: &[f64], moments: &[f64], MotionMut { q, v }: MotionMut) {
    let width = response.lanes / LANES;
    let (terms, row) = (response.terms.as_chunks::<LANES>().0, row.as_chunks::<LANES>().0);
    let terms = (&terms[width..moments.len() * width], width);
    let (q, v) = (q.as_chunks_mut::<LANES>().0, v.as_chunks_mut::<LANES>().0);
    let mut before = [0.0; RESPONSE_POWERS];
    for ((before, moment), k) in before.iter_mut().zip(moments).zip(&COUNT[1..]) {
        *before = k * moment;
    }
    let moments = (&moments[1..], &before[..moments.len() - 1]);
    let mut first = 0;
    while first < width {
        first += match width - first {
            1 => push_next::<1>(terms, first, moments, row, (q, v)),
            2 => push_next::<2>(terms, first, moments, row, (q, v)),
            3 => push_next::<3>(terms, first, moments, row, (q, v)),
            _ => push_next::<4>(terms, first, moments, row, (q, v)),
        };
    }
}

/// Pushes `N` blocks, from the `first` on; returns how many that are.
#[inline(always)]
fn push_next<const N: usize>(
    terms: (&[Lane], usize),
    first: usize,
    moments: (&[f64], &[f64]),
    row: &[Lane],
    (q, v): (&mut [Lane], &mut [Lane]),
) -> usize {
    let (moved, slowed) = sum_blocks::<N>(terms, first, moments, 1.0);
    let (row, q, v) = (&row[first..first + N], &mut q[first..first + N], &mut v[first..first + N]);
    for c in 0..N {
        q[c] = each(|i| q[c][i] - row[c][i] * moved[c][i]);
        v[c] = each(|i| v[c][i] - row[c][i] * slowed[c][i]);
    }
    N
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    fn two_masses() -> Structure {
        let text = "name = \"Two\"\n[left]\nmass = [2.0]\nstiffness = [50.0]\ndamping = { ratio = 0.1 }\n\
                    [right]\nmass = [3.0]\nstiffness = [48.0]\ndamping = { ratio = 0.0 }";
        let scene = Scene::from_toml(text).unwrap();
        Structure::of(&scene).unwrap()
    }

    /// h = exp(-z w t) sin(w_d t) / w_d.
    #[test]
    fn it_is_that_of_an_oscillator() {
        let response = ImpulseResponse::of(&two_masses()).unwrap();
        for (mode, w, z) in [(0, 5.0_f64, 0.1_f64), (1, 4.0, 0.0)] {
            let (t, wd) = (0.13, w * (1.0 - z * z).sqrt());
            let series: f64 = (0..RESPONSE_POWERS).map(|k| response.term(k)[mode] * libm::pow(t, k as f64)).sum();
            let exact = libm::exp(-z * w * t) * libm::sin(wd * t) / wd;
            assert!((series / exact - 1.0).abs() < 1e-14, "{series} instead of {exact}");
        }
    }

    #[test]
    fn it_says_how_many_powers_are_needed() {
        let structure = two_masses();
        let response = ImpulseResponse::of(&structure).unwrap();
        for time in [1e-3, 0.03, 0.1] {
            let powers = response.powers(time, 1e-12).unwrap();
            let sum = |last: usize| (0..last).map(|k| response.term(k)[0] * libm::pow(time, k as f64)).sum::<f64>();
            assert!((sum(powers) / sum(RESPONSE_POWERS) - 1.0).abs() < 1e-12, "{time}: {powers}");
        }
        assert_eq!(response.powers(10.0, 1e-12), None);
    }
}
