//! Flights over segments in which some pair is too near to be dismissed: both ends of each segment show that none meets.
//!
//! What [`super::flight`] asks of a planned flight, for all pairs of a scene abreast and without a stop between segments,
//! where modes and pairs are few. It is never surer than that: what is flown over here would be certified there.

use crate::engine::pairs::pair::Pair;
use crate::numerics::polynomial::each;
use crate::structure::{LANES, Lane, Side, Structure};

/// Most blocks of modes that a flight keeps in registers.
pub const MOST_BLOCKS: usize = 3;

/// What stays the same during a run.
#[derive(Debug)]
pub struct NearPairs {
    modes: Vec<CertifiedModes>,
    /// What each mode is to the pairs, without the padding.
    shares: Vec<Lane>,
    /// m; infinite in a lane without a pair.
    gaps: Lane,
}

/// What [`LANES`] modes are, side by side.
#[derive(Clone, Copy, Debug, Default)]
struct CertifiedModes {
    participation: Lane,
    /// c, 1/s, and w^2, 1/s2.
    damping: Lane,
    omega2: Lane,
    /// What a mode's own acceleration and its rate at the start add to the bound on its |q''''|, 1/s2 and 1/s.
    of_acceleration: Lane,
    of_jerk: Lane,
}

impl NearPairs {
    /// For all pairs; none where modes or pairs are many, or damping couples modes.
    pub fn of(structure: &Structure, pairs: &[Pair]) -> Option<NearPairs> {
        let are_few = structure.lanes <= MOST_BLOCKS * LANES && pairs.len() <= LANES;
        if cfg!(without = "near_pairs") || !are_few || !structure.is_classical() {
            return None;
        }
        let block = |c: usize| {
            let lane = |all: &[f64]| -> Lane { std::array::from_fn(|i| all[c * LANES + i]) };
            let (of_jerk, omega2) = (lane(&structure.quickness), lane(&structure.omega2));
            CertifiedModes {
                participation: lane(&structure.participation),
                damping: lane(&structure.damping),
                omega2,
                of_acceleration: std::array::from_fn(|i| of_jerk[i] * omega2[i].sqrt()),
                of_jerk,
            }
        };
        let modes = [Side::Left, Side::Right].into_iter().flat_map(|side| structure.range(side));
        let of_pairs = |of: &dyn Fn(&Pair) -> f64, none: f64| std::array::from_fn(|p| pairs.get(p).map_or(none, of));
        Some(NearPairs {
            modes: (0..structure.lanes / LANES).map(block).collect(),
            shares: modes.map(|m| of_pairs(&|pair| pair.row[m], 0.0)).collect(),
            gaps: of_pairs(&|pair| pair.gap, f64::INFINITY),
        })
    }

    /// What is seen from a motion on over segments of a length, s.
    #[inline(always)]
    pub fn from<const WIDTH: usize>(
        &self,
        (q, v): (&[Lane; WIDTH], &[Lane; WIDTH]),
        length: f64,
    ) -> HermiteCheck<'_, WIDTH> {
        let (third, share) = (length / 3.0, (length * length) * (length * length) / 384.0);
        let mut seen = HermiteCheck { near: self, third, share, start: Default::default() };
        let [start, rate, _] = seen.pairs_at(q, v, &[[0.0; LANES]; WIDTH]);
        seen.start = [start, rate];
        seen
    }
}

/// What is seen of the pairs on the way from segment to segment.
pub trait SegmentCheck<const WIDTH: usize> {
    /// Whether no pair meets in the next segment, from the motion at its start and at its end and from the ground's
    /// acceleration and its slope.
    fn stays_apart(
        &mut self,
        start: (&[Lane; WIDTH], &[Lane; WIDTH]),
        end: (&[Lane; WIDTH], &[Lane; WIDTH]),
        load: (f64, f64),
    ) -> bool;
}

/// What is seen on the way from segment to segment.
pub struct HermiteCheck<'a, const WIDTH: usize> {
    near: &'a NearPairs,
    /// s, a third of a segment's length h; and s4, h^4/384.
    third: f64,
    share: f64,
    /// Penetrations and rates at the start of the present segment.
    start: [Lane; 2],
}

impl<const WIDTH: usize> HermiteCheck<'_, WIDTH> {
    /// Penetrations and rates, and the sums over modes of |share| times `sizes`.
    #[inline(always)]
    fn pairs_at(&self, q: &[Lane; WIDTH], v: &[Lane; WIDTH], sizes: &[Lane; WIDTH]) -> [Lane; 3] {
        let (mut moved, mut rate, mut size) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        let motion = q.as_flattened().iter().zip(v.as_flattened()).zip(sizes.as_flattened());
        for (share, ((q, v), own)) in self.near.shares.iter().zip(motion) {
            moved = each(|p| moved[p] + share[p] * q);
            rate = each(|p| rate[p] + share[p] * v);
            size = each(|p| size[p] + share[p].abs() * own);
        }
        [each(|p| moved[p] - self.near.gaps[p]), rate, size]
    }

    /// Bounds on |q''''| of the modes, from the motion at the start of a segment and the ground's acceleration and its
    /// slope: as [`Structure::fourth_derivative_bound`] has it with a + b for sqrt(a^2 + b^2).
    #[inline(always)]
    fn fourth(&self, q: &[Lane; WIDTH], v: &[Lane; WIDTH], (acceleration, slope): (f64, f64)) -> [Lane; WIDTH] {
        let mut fourth = [[0.0; LANES]; WIDTH];
        for (((mode, q), v), fourth) in self.near.modes.iter().zip(q).zip(v).zip(&mut fourth) {
            let CertifiedModes { participation, damping, omega2, of_acceleration, of_jerk } = mode;
            let own = each(|i| -participation[i] * acceleration - damping[i] * v[i] - omega2[i] * q[i]);
            let jerk = each(|i| -participation[i] * slope - damping[i] * own[i] - omega2[i] * v[i]);
            *fourth = each(|i| of_acceleration[i] * own[i].abs() + of_jerk[i] * jerk[i].abs());
        }
        fourth
    }
}

impl<const WIDTH: usize> SegmentCheck<WIDTH> for HermiteCheck<'_, WIDTH> {
    #[inline(always)]
    fn stays_apart(
        &mut self,
        (start_q, start_v): (&[Lane; WIDTH], &[Lane; WIDTH]),
        (end_q, end_v): (&[Lane; WIDTH], &[Lane; WIDTH]),
        load: (f64, f64),
    ) -> bool {
        let [start, rate] = self.start;
        let [end, end_rate, fourth] = self.pairs_at(end_q, end_v, &self.fourth(start_q, start_v, load));
        self.start = [end, end_rate];
        let controls = [each(|p| start[p] + self.third * rate[p]), each(|p| end[p] - self.third * end_rate[p])];
        let higher = |a: Lane, b: Lane| -> Lane { each(|p| if a[p] < b[p] { b[p] } else { a[p] }) };
        let highest = higher(higher(start, controls[0]), higher(controls[1], end));
        each(|p| highest[p] + self.share * fourth[p]).iter().all(|upper_bound| *upper_bound < 0.0)
    }
}
