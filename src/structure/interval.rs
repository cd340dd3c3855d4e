//! The exact flight of all modes over one interval of time.

use super::equations::{Scratch, Side, Structure};
use super::lanes::{LANES, Lane};
use super::modes::ModalDamping;
use super::propagator::{CoupledIncrement, ModeIncrement};

/// The increments of [`LANES`] modes side by side.
#[derive(Clone, Copy, Debug, Default)]
pub struct ModeIncrements {
    dqq: [f64; LANES],
    dqv: [f64; LANES],
    dvq: [f64; LANES],
    dvv: [f64; LANES],
    rq0: [f64; LANES],
    rq1: [f64; LANES],
    rv0: [f64; LANES],
    rv1: [f64; LANES],
}

impl ModeIncrements {
    fn set(&mut self, i: usize, mode: &ModeIncrement) {
        self.dqq[i] = mode.dqq;
        self.dqv[i] = mode.dqv;
        self.dvq[i] = mode.dvq;
        self.dvv[i] = mode.dvv;
        self.rq0[i] = mode.rq0;
        self.rq1[i] = mode.rq1;
        self.rv0[i] = mode.rv0;
        self.rv1[i] = mode.rv1;
    }

    /// q and v at the end, from q, v and the load and its slope at the start.
    #[inline(always)]
    fn end(
        &self,
        q: &[f64; LANES],
        v: &[f64; LANES],
        load: &[f64; LANES],
        slope: &[f64; LANES],
    ) -> ([f64; LANES], [f64; LANES]) {
        let mut end = ([0.0; LANES], [0.0; LANES]);
        for i in 0..LANES {
            let from_load =
                (self.rq0[i] * load[i] + self.rq1[i] * slope[i], self.rv0[i] * load[i] + self.rv1[i] * slope[i]);
            end.0[i] = q[i] + (self.dqq[i] * q[i] + self.dqv[i] * v[i] + from_load.0);
            end.1[i] = v[i] + (self.dvq[i] * q[i] + self.dvv[i] * v[i] + from_load.1);
        }
        end
    }

    /// The same under the ground's acceleration and its slope alone.
    #[inline(always)]
    pub fn end_on_ground(
        &self,
        (q, v): (&Lane, &Lane),
        participation: &Lane,
        (acceleration, slope): (f64, f64),
    ) -> (Lane, Lane) {
        let (pull, rate) = (-acceleration, -slope);
        self.end(q, v, &participation.map(|p| p * pull), &participation.map(|p| p * rate))
    }
}

/// The exact flight of all modes over one interval length.
#[derive(Clone, Debug)]
pub struct Interval {
    /// s.
    pub length: f64,
    modes: Vec<ModeIncrements>,
    coupled: Vec<(usize, CoupledIncrement)>,
}

impl Interval {
    /// Prepares the flight over `length` seconds.
    pub fn new(structure: &Structure, length: f64) -> Interval {
        let mut interval = Interval::room(structure);
        interval.prepare(structure, length);
        interval
    }

    /// An interval without a length yet, for [`Interval::prepare`].
    pub fn room(structure: &Structure) -> Interval {
        let modes = vec![ModeIncrements::default(); structure.lanes / LANES];
        Interval { length: f64::NAN, modes, coupled: Vec::new() }
    }

    /// Prepares the flight over another length. Allocates only where damping couples modes.
    pub fn prepare(&mut self, structure: &Structure, length: f64) {
        self.length = length;
        self.coupled.clear();
        for side in [Side::Left, Side::Right] {
            let offset = structure.offset(side);
            let building = structure.modes(side);
            match &building.damping {
                ModalDamping::Diagonal(c) => {
                    for (m, w) in building.omega.iter().enumerate() {
                        let i = offset + m;
                        self.modes[i / LANES].set(i % LANES, &ModeIncrement::new(*w, c[m], length));
                    }
                }
                ModalDamping::Coupled(c) => {
                    self.coupled.push((offset, CoupledIncrement::new(&building.omega, c, length)));
                }
            }
        }
    }

    /// The increments of all modes, where they are so many blocks of them and damping couples none.
    pub fn blocks<const WIDTH: usize>(&self) -> Option<&[ModeIncrements; WIDTH]> {
        self.modes.as_slice().try_into().ok().filter(|_| self.coupled.is_empty())
    }

    /// Flies `q`, `v` over the interval under a modal load and its slope, into `end_q`, `end_v`.
    pub fn fly(
        &self,
        (q, v): (&[f64], &[f64]),
        (load, slope): (&[f64], &[f64]),
        (end_q, end_v): (&mut [f64], &mut [f64]),
        scratch: &mut Scratch,
    ) {
        fly_modes(&self.modes, (q, v), (load, slope), (end_q, end_v));
        let mut ahead = &mut scratch.ahead[..];
        for (offset, increment) in &self.coupled {
            let (own, rest) = ahead.split_at_mut(increment.matrix.nrows());
            increment.step(*offset, [q, v, load, slope], own);
            ahead = rest;
        }
        let mut ahead = &scratch.ahead[..];
        for (offset, increment) in &self.coupled {
            let n = increment.matrix.nrows() / 2;
            for m in 0..n {
                end_q[offset + m] += ahead[m];
                end_v[offset + m] += ahead[n + m];
            }
            ahead = &ahead[2 * n..];
        }
    }

    /// The same under the ground's acceleration and its slope alone, where damping couples no modes. Returns whether the
    /// end is finite.
    #[inline(always)]
    pub fn fly_on_ground(
        &self,
        (q, v): (&[f64], &[f64]),
        (participation, (acceleration, slope)): (&[f64], (f64, f64)),
        (end_q, end_v): (&mut [f64], &mut [f64]),
    ) -> bool {
        let [(q0, _), (v0, _), (participation, _)] = [q, v, participation].map(<[f64]>::as_chunks::<LANES>);
        let [(q1, _), (v1, _)] = [end_q, end_v].map(<[f64]>::as_chunks_mut::<LANES>);
        let width = self.modes.len();
        // Equal lengths: no bounds checks below.
        let (modes, participation) = (&self.modes[..width], &participation[..width]);
        let (q0, v0, q1, v1) = (&q0[..width], &v0[..width], &mut q1[..width], &mut v1[..width]);
        let mut sum = [0.0; LANES];
        for c in 0..width {
            let (q, v) = modes[c].end_on_ground((&q0[c], &v0[c]), &participation[c], (acceleration, slope));
            for i in 0..LANES {
                // Finite only if all of its terms are.
                sum[i] += q[i] + v[i];
            }
            (q1[c], v1[c]) = (q, v);
        }
        sum.iter().sum::<f64>().is_finite()
    }
}

/// The end of all modes from q, v, load and slope, as if damping coupled none.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn fly_modes(
    modes: &[ModeIncrements],
    (q, v): (&[f64], &[f64]),
    (load, slope): (&[f64], &[f64]),
    (end_q, end_v): (&mut [f64], &mut [f64]),
) {
    let [(q, _), (v, _), (load, _), (slope, _)] = [q, v, load, slope].map(<[f64]>::as_chunks::<LANES>);
    let [(end_q, _), (end_v, _)] = [end_q, end_v].map(<[f64]>::as_chunks_mut::<LANES>);
    // Equal lengths: no bounds checks below.
    let width = modes.len();
    let (q, v, load, slope) = (&q[..width], &v[..width], &load[..width], &slope[..width]);
    let (end_q, end_v) = (&mut end_q[..width], &mut end_v[..width]);
    for c in 0..width {
        (end_q[c], end_v[c]) = modes[c].end(&q[c], &v[c], &load[c], &slope[c]);
    }
}
