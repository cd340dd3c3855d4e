//! For how many segments of the record nothing can exceed its peak.
//!
//! With the amplitude e = sqrt(q'^2 + w^2 q^2) of each mode, which grows by no more than |participation| S in a shaking
//! S = integral of |ground acceleration| (see `dismissal.rs`), a quantity y = A q + B q' swings no further than
//!
//! ```text
//! |y| <= sum over modes of (|A| / w + |B|) (e + |participation| S)
//! ```
//!
//! That is enough once the strongest shaking is over. Before, y' = (A - B c) q' - B w^2 q but for the ground's own part, and
//! that changes by no more than |y''| <= sum of (|A - B c| (w + c) + |B| w^2) (e + |participation| S) and what the ground does:
//!
//! ```text
//! |y| <= |y + t y'| + |B participation| S + t (|(A - B c) participation| S + t/2 bound on |y''|)
//! ```
//!
//! which is convex in t: what lies below a peak at both ends of a stretch does so all along.

use super::Peaks;
use super::larger;
use super::rows::{Block, BuildingRows};
use crate::engine::ground::{Ahead, GroundMotion};
use crate::engine::model::Model;
use crate::engine::state::{Base, Workspace};
use crate::polynomial::each;
use crate::structure::{LANES, Lane};

/// Most segments that one look is good for.
pub(super) const MOST: u64 = 256;

/// Numbers of segments that are tried.
const TRIED: [u64; 14] = [1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 128, MOST];

/// Margin for rounding, relative to the whole swing.
const MARGIN: f64 = 1e-12;

/// The motion of a building's modes at the base.
struct Motion<'a> {
    q: &'a [f64],
    v: &'a [f64],
    /// m/s2 (kg^1/2), what stiffness and damping do to each mode.
    own: &'a [f64],
    /// c, 1/s.
    damping: &'a [f64],
    /// Amplitudes e, e / w, (w + c) e and w^2 e.
    amplitude: [&'a [f64]; 4],
}

/// What is known of a block at the base.
struct Outlook {
    value: Lane,
    rate: Lane,
    /// Bounds on the second derivative and on the whole swing without more shaking.
    bend: Lane,
    swing: Lane,
}

impl Model {
    /// Looks ahead from the base, in the segment of that number, for the blocks that have not been cleared for it. The
    /// motion is that of modes which damping does not couple.
    pub(in crate::engine) fn look_ahead_for_peaks(
        &self,
        ground: &GroundMotion,
        base: &mut Base,
        segment: u64,
        work: &mut Workspace,
    ) {
        if base.peaks.due > segment {
            return;
        }
        let ahead = ground.ahead_of(segment);
        for building in &self.peak_rows.buildings {
            let blocks = building.first..building.first + building.blocks.len();
            if base.peaks.clear_until[blocks].iter().all(|until| *until > segment) {
                continue;
            }
            self.find_amplitudes(building, base, work);
            let bounds = &work.peaks.bounds;
            let modes = building.modes.clone();
            let motion = Motion {
                q: &base.q[modes.clone()],
                v: &base.v[modes.clone()],
                own: &bounds.first[modes.clone()],
                damping: &self.structure.damping[modes.clone()],
                amplitude: [&bounds.swing, &bounds.swing_q, &bounds.slow, &bounds.quick].map(|all| &all[modes.clone()]),
            };
            look(building, &motion, (&ahead, segment, base.elapsed), &mut base.peaks);
        }
        base.peaks.due = base.peaks.clear_until.iter().copied().min().unwrap_or(u64::MAX);
    }

    /// Amplitudes of a building's modes at the base and what stiffness and damping do to each.
    fn find_amplitudes(&self, building: &BuildingRows, base: &Base, work: &mut Workspace) {
        let bounds = &mut work.peaks.bounds;
        for m in building.modes.clone() {
            let (q, v, w2, c) = (base.q[m], base.v[m], self.structure.omega2[m], self.structure.damping[m]);
            let amplitude = (v * v + w2 * q * q).sqrt();
            bounds.first[m] = -c * v - w2 * q;
            bounds.swing[m] = amplitude;
            bounds.swing_q[m] = amplitude / w2.sqrt();
            bounds.slow[m] = self.structure.quickness[m] * amplitude;
            bounds.quick[m] = w2 * amplitude;
        }
    }
}

/// See [`Model::look_ahead_for_peaks`]. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn look(building: &BuildingRows, motion: &Motion, (ahead, segment, elapsed): (&Ahead, u64, f64), peaks: &mut Peaks) {
    let Peaks { values, clear_until, .. } = peaks;
    let peaks = values.as_chunks_mut::<LANES>().0[building.first..].iter_mut();
    for ((block, peak), until) in building.blocks.iter().zip(peaks).zip(&mut clear_until[building.first..]) {
        if *until > segment {
            continue;
        }
        let outlook = block.outlook(motion);
        *peak = each(|i| larger(peak[i], outlook.value[i].abs()));
        *until = segment;
        for segments in TRIED {
            let (time, shaking) = ahead.over(segments);
            if !outlook.stays_below(peak, &block.growth, time - elapsed, shaking) {
                break;
            }
            *until = segment + segments;
        }
    }
}

impl Block {
    #[inline(always)]
    fn outlook(&self, motion: &Motion) -> Outlook {
        let [amplitude, amplitude_q, slow, quick] = motion.amplitude;
        let mut seen = Outlook { value: [0.0; LANES], rate: [0.0; LANES], bend: [0.0; LANES], swing: [0.0; LANES] };
        let count = self.on_q.len();
        let (q, v, own) = (&motion.q[..count], &motion.v[..count], &motion.own[..count]);
        let (amplitude_q, slow) = (&amplitude_q[..count], &slow[..count]);
        for m in 0..count {
            let a = &self.on_q[m];
            for i in 0..LANES {
                seen.value[i] += a[i] * q[m];
                seen.rate[i] += a[i] * v[m];
                seen.swing[i] += a[i].abs() * amplitude_q[m];
            }
        }
        if self.on_v.is_empty() {
            for m in 0..count {
                for i in 0..LANES {
                    seen.bend[i] += self.on_q[m][i].abs() * slow[m];
                }
            }
            return seen;
        }
        let (amplitude, quick, on_v) = (&amplitude[..count], &quick[..count], &self.on_v[..count]);
        let damping = &motion.damping[..count];
        for m in 0..count {
            let (a, b, c) = (&self.on_q[m], &on_v[m], damping[m]);
            for i in 0..LANES {
                seen.value[i] += b[i] * v[m];
                seen.rate[i] += b[i] * own[m];
                seen.swing[i] += b[i].abs() * amplitude[m];
                seen.bend[i] += (a[i] - b[i] * c).abs() * slow[m] + b[i].abs() * quick[m];
            }
        }
        seen
    }
}

impl Outlook {
    /// Whether all of the block stay below their peaks for a time, s, and a shaking, m/s.
    #[inline(always)]
    fn stays_below(&self, peak: &Lane, growth: &super::rows::Growth, time: f64, shaking: f64) -> bool {
        let mut stays = true;
        for i in 0..LANES {
            let bend = self.bend[i] + growth.bend[i] * shaking;
            let swing = (self.swing[i] + growth.swing[i] * shaking) * (1.0 + MARGIN);
            let moved = (self.value[i] + time * self.rate[i]).abs()
                + (growth.at_once[i] * shaking + time * (growth.rate[i] * shaking + 0.5 * time * bend));
            let moved = moved + MARGIN * swing;
            // Written so that a NaN is never below anything.
            stays &= swing <= peak[i] || moved <= peak[i];
        }
        stays
    }
}
