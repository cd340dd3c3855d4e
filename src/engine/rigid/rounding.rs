//! What of the motion of a rigid pair is rounding.

use crate::engine::base::Base;
use crate::engine::excitation::inputs::Inputs;
use crate::engine::pairs::touching::Rounding;
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;

/// A relative velocity below this share of the floors' own is rounding: some fifty rounding errors.
const STILL: f64 = 1e-14;

/// Rounding of a penetration, as a share of the floors' own displacements.
const ROUNDING: f64 = 2.0 * f64::EPSILON;

/// A rigid pair is tracked by its own increments while it is at most this many times the rounding of its penetration apart.
const CLOSE: f64 = 1e6;

impl System {
    /// Works out in `work.rounding` what is rounding of the motion of each rigid pair, in their order; the base has modes.
    ///
    /// Rounding errors remain in a motion as long as it lasts: where it passes through 0 they are as large as elsewhere. So what
    /// counts is how far and how fast each mode goes from here, by its displacement, its velocity and the load on it, in the time
    /// of a radian of its own or since the run began.
    pub(super) fn find_rounding(&self, base: &Base, inputs: &Inputs, work: &mut Buffers) {
        let Buffers { load, slope, rounding, .. } = work;
        self.load(base, inputs, load, slope);
        rounding.clear();
        rounding.extend(self.rigid.pairs.iter().map(|&p| self.rounding(p, base, load)));
    }

    fn rounding(&self, p: usize, base: &Base, load: &[f64]) -> Rounding {
        let (mut distance, mut rate) = (self.pairs[p].gap.abs(), 0.0);
        let modes = base.q.iter().zip(&base.v).zip(load).zip(&self.structure.omega2);
        for (row, (((q, v), load), omega2)) in self.pairs[p].row.modes.iter().zip(modes) {
            let omega = omega2.sqrt();
            let time = base.time().min(1.0 / omega);
            distance += (row * (q.abs() + time * (v.abs() + time * load.abs()))).abs();
            rate += (row * (v.abs() + omega * q.abs() + time * load.abs())).abs();
        }
        Rounding { distance: ROUNDING * distance, rate: STILL * rate }
    }

    /// Which rigid pairs that were tracked are to be tracked on: rebounds that die out are far smaller than the rounding errors of
    /// the floors' motion.
    pub(crate) fn track_on(&self, base: &mut Base, inputs: &Inputs, work: &mut Buffers) {
        if !base.contacts.iter().any(|contact| contact.tracked) {
            return;
        }
        self.find_rounding(base, inputs, work);
        for (&p, rounding) in self.rigid.pairs.iter().zip(&work.rounding) {
            let contact = &mut base.contacts[p];
            contact.tracked &= contact.penetration >= -CLOSE * rounding.distance;
        }
    }
}
