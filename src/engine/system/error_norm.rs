//! Norms of the motion and the velocity to which errors of a step in contact are relative, and the time unit of its
//! series.

use crate::engine::base::{Base, Coordinates, touching};
use crate::engine::system::System;
use crate::structure::{FEW_BLOCKS, LANES, Lane};

impl System {
    /// Largest component over all floors of a vector of motion; of modal coordinates, the largest that one mode
    /// contributes to any floor.
    pub fn floor_norm(&self, coordinates: Coordinates, motion: &[f64]) -> f64 {
        match coordinates {
            Coordinates::Floors => largest_of(motion, |_, size| size),
            Coordinates::Modes => {
                let weights = self.structure.weight.as_chunks::<LANES>().0;
                match weights.len() <= FEW_BLOCKS {
                    true => largest_of(motion, |(c, i), size| size * weights[c][i]),
                    false => largest_of_many(weights, motion),
                }
            }
        }
    }

    /// The velocity to which errors in contact are relative, m/s: the largest of the floors, or, at the first step,
    /// also the one that the elastic energy could give them.
    pub fn present_velocity(&self, base: &Base) -> f64 {
        let floors = self.floor_norm(base.coordinates, &base.v);
        // Later elastic energy comes from velocities that have been seen.
        if base.last_length > 0.0 {
            return floors;
        }
        let springs = base.contacts.iter().zip(&self.pairs).map(|(contact, pair)| {
            (2.0 * contact.branch().stored_energy(contact.penetration.max(0.0)) / pair.mass).sqrt()
        });
        springs.fold(floors, f64::max)
    }

    /// The time unit of the next series, s: near the length of the step, so that its terms neither overflow nor
    /// underflow. A power law's series converges no further than to its singularity at d = 0.
    pub fn series_scale(&self, base: &Base, remaining: f64) -> f64 {
        let last = if base.last_length > 0.0 { base.last_length } else { remaining };
        let reach = touching(base)
            .filter(|(_, contact)| contact.penetration > 0.0 && !contact.branch().is_regular() && contact.rate != 0.0)
            .map(|(_, contact)| contact.penetration / contact.rate.abs())
            .fold(last.min(remaining), f64::min);
        power_of_two_below(reach)
    }
}

/// The largest of the magnitudes of a motion, each as `weighed` by its block and lane.
#[inline(always)]
fn largest_of(motion: &[f64], weighed: impl Fn((usize, usize), f64) -> f64) -> f64 {
    let mut largest = [0.0_f64; LANES];
    for (c, motion) in motion.as_chunks::<LANES>().0.iter().enumerate() {
        for i in 0..LANES {
            // Not `max`, which tests both numbers for NaN.
            let size = weighed((c, i), motion[i].abs());
            largest[i] = if size > largest[i] { size } else { largest[i] };
        }
    }
    largest.iter().fold(0.0, |a, b| a.max(*b))
}

/// The same where modes are many.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn largest_of_many(weights: &[Lane], motion: &[f64]) -> f64 {
    largest_of(motion, |(c, i), size| size * weights[c][i])
}

/// The power of two at or below x > 0: scaling by it makes no rounding error.
fn power_of_two_below(x: f64) -> f64 {
    const MANTISSA: u64 = (1 << 52) - 1;
    let power = f64::from_bits(x.to_bits() & !MANTISSA);
    if power > 0.0 { power } else { x }
}
