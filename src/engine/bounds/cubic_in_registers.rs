//! Proof from both ends of each segment that no pair meets in it, while fast flight passes over many segments.
//!
//! It is the test of `flight/certificate.rs` with a bound that is never sharper: every segment accepted here is accepted
//! there. All pairs are tested side by side, with modes and pairs few enough for registers.

use crate::engine::pairs::pair::Pair;
use crate::numerics::polynomial::each;
use crate::structure::{LANES, Lane, Side, Structure};

/// Largest number of blocks of modes that fast flight keeps in registers.
pub const MOST_BLOCKS: usize = 3;

/// Coefficients of the test; constant during a run.
#[derive(Debug)]
pub struct NearPairs {
    modes: Vec<CertifiedModes>,
    /// Rows of all pairs, mode by mode, without the padding, kg^-1/2.
    shares: Vec<Lane>,
}

/// Coefficients of [`LANES`] modes, side by side.
#[derive(Clone, Copy, Debug, Default)]
struct CertifiedModes {
    /// Modal participation of the ground acceleration, kg^1/2.
    participation: Lane,
    /// Damping c, 1/s.
    damping: Lane,
    /// w^2, 1/s2.
    omega2: Lane,
    /// Factors of |q''| and |q'''| at the start in the bound on a mode's |q''''|, 1/s2 and 1/s.
    of_acceleration: Lane,
    of_jerk: Lane,
}

impl NearPairs {
    /// For all pairs of a structure; `None` where modes or pairs are many, or damping couples modes.
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
        })
    }

    /// The test over segments of a `length`, s, from a motion on, for pairs with these gaps.
    #[inline(always)]
    pub fn from<const WIDTH: usize>(
        &self,
        (q, v): (&[Lane; WIDTH], &[Lane; WIDTH]),
        gaps: &[f64],
        length: f64,
    ) -> HermiteCheck<'_, WIDTH> {
        let (third, share) = (length / 3.0, (length * length) * (length * length) / 384.0);
        let gaps = each(|p| gaps.get(p).copied().unwrap_or(f64::INFINITY));
        let mut seen = HermiteCheck { near: self, gaps, third, share, start: Default::default() };
        let [start, rate, _] = seen.pairs_at(q, v, &[[0.0; LANES]; WIDTH]);
        seen.start = [start, rate];
        seen
    }
}

/// The test of segments that follow each other.
pub trait SegmentCheck<const WIDTH: usize> {
    /// Whether no pair meets in the next segment, from the motion at its start and end and the ground's acceleration,
    /// m/s2, and slope, m/s3, at its start.
    fn stays_apart(
        &mut self,
        start: (&[Lane; WIDTH], &[Lane; WIDTH]),
        end: (&[Lane; WIDTH], &[Lane; WIDTH]),
        load: (f64, f64),
    ) -> bool;
}

/// The test by cubic Hermite interpolation, on its way from segment to segment.
pub struct HermiteCheck<'a, const WIDTH: usize> {
    near: &'a NearPairs,
    /// Gaps, m; infinite in a lane without a pair.
    gaps: Lane,
    /// A third of a segment's length h, s.
    third: f64,
    /// h^4/384, s4.
    share: f64,
    /// Penetrations, m, and rates, m/s, at the start of the present segment.
    start: [Lane; 2],
}

impl<const WIDTH: usize> HermiteCheck<'_, WIDTH> {
    /// Penetrations, m, and rates, m/s, of all pairs, and the sums over modes of |row| times `sizes`.
    #[inline(always)]
    fn pairs_at(&self, q: &[Lane; WIDTH], v: &[Lane; WIDTH], sizes: &[Lane; WIDTH]) -> [Lane; 3] {
        let (mut moved, mut rate, mut size) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        let motion = q.as_flattened().iter().zip(v.as_flattened()).zip(sizes.as_flattened());
        for (share, ((q, v), own)) in self.near.shares.iter().zip(motion) {
            moved = each(|p| moved[p] + share[p] * q);
            rate = each(|p| rate[p] + share[p] * v);
            size = each(|p| size[p] + share[p].abs() * own);
        }
        [each(|p| moved[p] - self.gaps[p]), rate, size]
    }

    /// Bounds on |q''''| of the modes, from the motion at the start of a segment and the ground's acceleration and
    /// slope: as [`Structure::fourth_derivative_bound`], but with a + b in place of sqrt(a^2 + b^2).
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
