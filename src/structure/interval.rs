//! The exact flight of all modes over one interval of time.

use super::block_increments::{ModeIncrements, halvings, increments};
use super::equations::{Scratch, Structure};
use super::lanes::{FEW_BLOCKS, LANES, Lane};
use super::modes::ModalDamping;
use super::motion::{LinearGround, LinearLoad, Motion, MotionMut};
use super::propagator::{CoupledIncrement, ModeIncrement};

/// The exact flight of all modes over one interval length.
#[derive(Clone, Debug, Default)]
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
        interval.prepare_mode_by_mode(structure, length);
        interval
    }

    /// An interval without a length yet, for [`Interval::prepare`].
    pub fn room(structure: &Structure) -> Interval {
        let modes = vec![ModeIncrements::default(); structure.lanes / LANES];
        Interval { length: f64::NAN, modes, coupled: Vec::new() }
    }

    /// Prepares the flight over another length. Allocates only where damping couples modes.
    pub fn prepare(&mut self, structure: &Structure, length: f64) {
        match structure.is_classical() && structure.lanes > FEW_BLOCKS * LANES && length > 0.0 {
            true if self.length == length => {}
            true => prepare_blocks(self, structure, length),
            false => self.prepare_mode_by_mode(structure, length),
        }
    }

    fn prepare_mode_by_mode(&mut self, structure: &Structure, length: f64) {
        self.length = length;
        self.coupled.clear();
        for body in &structure.bodies {
            let (offset, modes) = (body.range.start, &body.modes);
            match &modes.damping {
                ModalDamping::Diagonal(c) => {
                    for (m, w) in modes.omega.iter().enumerate() {
                        let i = offset + m;
                        self.modes[i / LANES].set(i % LANES, &ModeIncrement::new(*w, c[m], length));
                    }
                }
                ModalDamping::Coupled(c) => {
                    self.coupled.push((offset, CoupledIncrement::new(&modes.omega, c, length)));
                }
            }
        }
    }

    /// Flies `q`, `v` over the interval under a modal load and its slope, into `end_q`, `end_v`, where damping couples
    /// no modes.
    pub fn fly_uncoupled(&self, motion: Motion, loads: LinearLoad, end: MotionMut) {
        fly_modes(&self.modes, motion, loads, end);
    }

    /// Flies `q`, `v` over the interval under a modal load and its slope, into `end_q`, `end_v`.
    pub fn fly(
        &self,
        Motion { q, v }: Motion,
        LinearLoad { load, slope }: LinearLoad,
        MotionMut { q: end_q, v: end_v }: MotionMut,
        scratch: &mut Scratch,
    ) {
        fly_modes(&self.modes, Motion { q, v }, LinearLoad { load, slope }, MotionMut { q: end_q, v: end_v });
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

    /// The same under the load that has grown from another one for `time` seconds.
    pub fn fly_from(
        &self,
        time: f64,
        motion: Motion,
        LinearLoad { load, slope }: LinearLoad,
        end: MotionMut,
        scratch: &mut Scratch,
    ) {
        let mut grown = std::mem::take(&mut scratch.y);
        grown.iter_mut().zip(load.iter().zip(slope)).for_each(|(grown, (load, slope))| *grown = load + slope * time);
        self.fly(motion, LinearLoad { load: &grown, slope }, end, scratch);
        scratch.y = grown;
    }

    /// The same under the ground's acceleration and its slope alone, where damping couples no modes.
    #[inline]
    pub fn fly_on_ground(&self, motion: Motion, pushed: (&[f64], LinearGround), end: MotionMut) {
        fly_modes_on_ground(&self.modes, motion, pushed, end);
    }
}

/// See [`Interval::fly_on_ground`].
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn fly_modes_on_ground(
    modes: &[ModeIncrements],
    Motion { q, v }: Motion,
    (participation, ground): (&[f64], LinearGround),
    MotionMut { q: end_q, v: end_v }: MotionMut,
) {
    let [(q0, _), (v0, _), (participation, _)] = [q, v, participation].map(<[f64]>::as_chunks::<LANES>);
    let [(q1, _), (v1, _)] = [end_q, end_v].map(<[f64]>::as_chunks_mut::<LANES>);
    // Equal lengths: no bounds checks below.
    let width = modes.len();
    let (participation, q0, v0) = (&participation[..width], &q0[..width], &v0[..width]);
    let (q1, v1) = (&mut q1[..width], &mut v1[..width]);
    for c in 0..width {
        (q1[c], v1[c]) = modes[c].end_on_ground((&q0[c], &v0[c]), &participation[c], ground);
    }
}

/// Prepares the flight of many modes that damping does not couple, block by block.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn prepare_blocks(interval: &mut Interval, structure: &Structure, length: f64) {
    interval.length = length;
    interval.coupled.clear();
    let [(omega2, _), (damping, _)] = [&structure.omega2, &structure.damping].map(|of| of.as_chunks::<LANES>());
    for (c, (block, (omega2, damping))) in interval.modes.iter_mut().zip(omega2.iter().zip(damping)).enumerate() {
        let mut fastest = 0.0_f64;
        for i in 0..LANES {
            fastest = fastest.max(omega2[i].sqrt()).max(damping[i]);
        }
        match halvings(fastest * length) {
            Some(halvings) => *block = increments((omega2, damping), length, halvings),
            None => {
                for i in 0..LANES {
                    let m = c * LANES + i;
                    block.set(i, &ModeIncrement::new(structure.omega2[m].sqrt(), structure.damping[m], length));
                }
            }
        }
    }
}

/// The end of all modes from q, v, load and slope, as if damping coupled none. Returns the sum of all numbers at the end,
/// which goes from block to block: else the compiler takes four blocks at a time and spends its time sorting them.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn fly_modes(
    modes: &[ModeIncrements],
    Motion { q, v }: Motion,
    LinearLoad { load, slope }: LinearLoad,
    MotionMut { q: end_q, v: end_v }: MotionMut,
) -> Lane {
    let [(q, _), (v, _), (load, _), (slope, _)] = [q, v, load, slope].map(<[f64]>::as_chunks::<LANES>);
    let [(end_q, _), (end_v, _)] = [end_q, end_v].map(<[f64]>::as_chunks_mut::<LANES>);
    // Equal lengths: no bounds checks below.
    let width = modes.len();
    let (q, v, load, slope) = (&q[..width], &v[..width], &load[..width], &slope[..width]);
    let (end_q, end_v) = (&mut end_q[..width], &mut end_v[..width]);
    let mut sum = [0.0; LANES];
    for c in 0..width {
        let (q, v) = modes[c].end(&q[c], &v[c], &load[c], &slope[c]);
        for i in 0..LANES {
            sum[i] += q[i] + v[i];
        }
        end_q[c] = q;
        end_v[c] = v;
    }
    sum
}
