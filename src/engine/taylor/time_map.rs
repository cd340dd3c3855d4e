//! Reach of a Taylor step in the x of a time map, in which the motion near an entry or a release is analytic.

use crate::engine::base::contact::{Contact, ContactPhase};
use crate::engine::base::{Base, touching};
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::engine::taylor::solution::Solution;
use crate::engine::taylor::step_size::FURTHEST;
use crate::numerics::polynomial::rough_root;
use crate::numerics::time_map::TimeMap;
use crate::structure::MotionSeries;

/// Share of the time to a singularity that a series in time reaches if the singularity is what limits it.
const SHARE_TO_SINGULARITY: f64 = 0.35;

/// x up to which a series is used in the time map of an entry, in units of the time since the entry: t is then 24 times
/// that time.
const FURTHEST_FROM_ENTRY: f64 = 8.0;

/// The map is made to end this share later than the estimated release: dt/dx is 0 at its end, and the estimate by the
/// terms in time is about as accurate.
const LATE: f64 = 1e-3;

impl System {
    /// Reach, in x, with the time map for which the nearest entry before, or release after the base is no singularity;
    /// `reach` is that of the series in time.
    pub fn reach_by_map(
        &self,
        base: &Base,
        solution: &mut Solution,
        work: &mut Buffers,
        (reach, remaining): (f64, f64),
    ) -> f64 {
        let Some((time_map, furthest)) = self.time_map(base, solution, reach) else { return reach };
        solution.substitute(time_map);
        let reach = self.reach_of_rates(base, &solution.series, work);
        self.with_safety(reach, furthest.min(time_map.inverse(remaining / solution.series.scale)))
    }

    /// The time map for series with that reach in time, if one takes them further, and the largest x for which it is
    /// good.
    fn time_map(&self, base: &Base, solution: &Solution, reach: f64) -> Option<(TimeMap, f64)> {
        let is_behind = |(_, contact): &(usize, &Contact)| {
            contact.phase == ContactPhase::Engaged && !contact.branch().is_regular() && contact.age > 0.0
        };
        let ages = touching(base).filter(is_behind).map(|(_, contact)| contact.age);
        let since = ages.fold(f64::INFINITY, f64::min) / solution.series.scale;
        let release = (1.0 + LATE) * solution.closed.first_release(reach / SHARE_TO_SINGULARITY);
        let (curvature, furthest) = match () {
            // The singularity is behind or within reach already, or the scale is far too long.
            _ if release < reach || reach > FURTHEST_FROM_ENTRY * since || reach < 1.0 / FURTHEST => return None,
            // No velocity to which an error would be relative.
            _ if base.velocity_scale == 0.0 => return None,
            _ if reach > SHARE_TO_SINGULARITY * since => (0.25 / since, FURTHEST_FROM_ENTRY * since),
            _ if release.is_finite() => (-0.25 / release, 2.0 * release * self.safety_factor()),
            _ => return None,
        };
        Some((TimeMap { curvature }, furthest))
    }

    /// Reach, in the x of its time map, at which the last two terms of the velocities of a series are below the
    /// tolerance.
    fn reach_of_rates(&self, base: &Base, series: &MotionSeries, work: &mut Buffers) -> f64 {
        let allowed = self.tolerance.step * base.velocity_scale * series.scale;
        let (last, before) = (&mut work.node_q, &mut work.node_v);
        let powers = series.last_rates(last, before);
        let sizes = [last, before].map(|term| self.floor_norm(base.coordinates, term));
        let reaches = powers.iter().zip(sizes).filter(|(_, size)| *size > 0.0);
        reaches.map(|(power, size)| rough_root(allowed / size, *power)).fold(f64::INFINITY, f64::min)
    }
}
