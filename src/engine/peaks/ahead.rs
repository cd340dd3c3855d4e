//! Looking ahead: for each block of watched quantities, the number of segments in which none can exceed its peak.
//!
//! The amplitude e = sqrt(q'^2 + w^2 q^2) of each mode grows at most by |participation| S over a cumulative absolute
//! velocity S = integral of |ground acceleration| (see `flight/broad_phase.rs`). So a quantity y = A q + B q' is
//! bounded by sums over modes:
//!
//! ```text
//! |y|   <= sum of (|A| / w + |B|) e
//! |y'|  <= sum of (|A| + |B| (w + c)) e + |B participation| |ground acceleration|
//! |y''| <= sum of (|A - B c| (w + c) + |B| w^2) e + |(A - B c) participation| |ground acceleration|
//!          + |B participation| |slope of the ground acceleration|
//! ```
//!
//! The first bound suffices once the strongest ground motion is over. The second gives the number of segments in which
//! a quantity cannot get from its value to its peak. By the third, a quantity that is below its peak by h^2/8 |y''| at
//! both ends of a segment is below it throughout. The bounds are worked out every few segments, values where they are
//! needed. They change no result, so no saved state holds them.

use crate::engine::base::Base;
use crate::engine::base::peaks::Peaks;
use crate::engine::bounds::amplitude::{Amplitudes, RowBounds, bound_block};
use crate::engine::bounds::stretch::ModeBounds;
use crate::engine::excitation::record::GroundMotion;
use crate::engine::model::Model;
use crate::engine::peaks::room::{PeakWatch, PeakWork, WatchedBlock};
use crate::engine::quantities::rows::BuildingRows;
use crate::numerics::polynomial::{each, larger};
use crate::structure::{LANES, Lane};

/// Numbers of segments for which bounds are worked out: if all quantities stay below their peaks that long, and
/// otherwise.
const LONG: u64 = 128;
const SHORT: u64 = 16;

/// Margin for rounding, relative to bounds.
const MARGIN: f64 = 1e-10;

impl Model {
    /// Looks ahead from the base, which is in the segment with that number, for the blocks that may exceed a peak;
    /// returns the number of the first segment in which any may. For modal motion without coupling by damping.
    pub(in crate::engine) fn watch_peaks(
        &self,
        ground: &GroundMotion,
        base: &mut Base,
        segment: u64,
        work: &mut PeakWork,
    ) -> u64 {
        if self.peak_rows.are_none() {
            return u64::MAX;
        }
        if cfg!(without = "peaks_ahead") {
            return segment;
        }
        if work.peaks.watch.due > segment {
            return work.peaks.watch.due;
        }
        if work.peaks.watch.until <= segment {
            self.bound_ahead(ground, base, segment, work);
        }
        let watch = &mut work.peaks.watch;
        let values = base.peaks.values.as_chunks_mut::<LANES>().0;
        let mut due = watch.until;
        for building in &self.peak_rows.buildings {
            let motion = (&base.q[building.modes.clone()], &base.v[building.modes.clone()]);
            let watched = watch.blocks[building.first..].iter_mut().zip(&mut values[building.first..]);
            for (b, (watched, peaks)) in watched.take(building.blocks.len()).enumerate() {
                if watched.clear_until <= segment {
                    if watched.known_at != Some(segment) || base.elapsed > 0.0 {
                        let values = self.values_at((building, b), &base.rest.watched, motion);
                        (watched.value, watched.known_at) = (values, Some(segment));
                        // After an impulse the value may exceed the peak.
                        *peaks = each(|i| larger(peaks[i], watched.value[i].abs()));
                    }
                    watched.clear_until = (segment + watched.segments_to_peak(peaks, watch.longest)).min(watch.until);
                }
                due = due.min(watched.clear_until);
            }
        }
        watch.due = due;
        due
    }

    /// Works out the bounds for some segments from the base on.
    #[inline(never)]
    fn bound_ahead(&self, ground: &GroundMotion, base: &Base, segment: u64, work: &mut PeakWork) {
        let ahead = ground.ahead_of(segment);
        let cumulative = [SHORT, LONG].map(|segments| ahead.over(segments).1);
        let (strongest, steepest) = ahead.largest(SHORT);
        let values = base.peaks.values.as_chunks::<LANES>().0;
        let longest = ahead.longest(SHORT);
        let sag = 0.125 * longest * longest;
        for building in &self.peak_rows.buildings {
            self.find_amplitudes(building, base, &mut work.peaks.bounds);
            let amplitudes = self.amplitudes_of(building, &work.peaks.bounds);
            for (b, block) in building.blocks.iter().enumerate() {
                let watched = &mut work.peaks.watch.blocks[building.first + b];
                let RowBounds { swing, rate, bend } = bound_block(block, &amplitudes);
                let (peaks, growth) = (&values[building.first + b], &block.growth);
                let at_rest = base.rest.watched.as_chunks::<LANES>().0[building.first + b];
                let most = |cumulative: f64| {
                    each(|i| (1.0 + MARGIN) * (at_rest[i].abs() + (swing[i] + growth.swing[i] * cumulative)))
                };
                let is_below = |most: Lane| (0..LANES).all(|i| most[i] <= peaks[i]);
                watched.clear_until = segment;
                if is_below(most(cumulative[1])) {
                    watched.clear_until = segment + LONG;
                } else if is_below(most(cumulative[0])) {
                    watched.clear_until = segment + SHORT;
                }
                watched.rate = each(|i| {
                    (1.0 + MARGIN) * (rate[i] + growth.rate[i] * cumulative[0] + growth.at_once[i] * strongest)
                });
                watched.sag = each(|i| {
                    let pushed = growth.pushed[i] * strongest + growth.at_once[i] * steepest;
                    (1.0 + MARGIN) * sag * (bend[i] + growth.bend[i] * cumulative[0] + pushed)
                });
            }
        }
        let blocks = work.peaks.watch.blocks.iter();
        let are_all_long = blocks.map(|block| block.clear_until).min().is_none_or(|first| first >= segment + LONG);
        work.peaks.watch.longest = longest;
        work.peaks.watch.until = segment + if are_all_long { LONG } else { SHORT };
    }

    /// Works out the amplitudes of a building's modes at the base.
    fn find_amplitudes(&self, building: &BuildingRows, base: &Base, bounds: &mut ModeBounds) {
        for m in building.modes.clone() {
            let (q, v, w2) = (base.q[m], base.v[m], self.system.structure.omega2[m]);
            let amplitude = (v * v + w2 * q * q).sqrt();
            bounds.swing[m] = amplitude;
            bounds.swing_q[m] = amplitude / w2.sqrt();
            bounds.slow[m] = self.system.structure.quickness[m] * amplitude;
            bounds.quick[m] = w2 * amplitude;
        }
    }

    fn amplitudes_of<'a>(&'a self, building: &BuildingRows, bounds: &'a ModeBounds) -> Amplitudes<'a> {
        let [own, over_w, quick, bent, damping] =
            [&bounds.swing, &bounds.swing_q, &bounds.slow, &bounds.quick, &self.system.structure.damping]
                .map(|all| &all[building.modes.clone()]);
        Amplitudes { own, over_w, quick, bent, damping }
    }

    /// Raises the peaks of a block to the values at the end of a segment, which has been flown to the base; returns the
    /// values at both ends if the peaks may have been exceeded in between.
    pub(in crate::engine) fn raise_to_end(
        &self,
        building: &BuildingRows,
        b: usize,
        segment: u64,
        base: &mut Base,
        work: &mut PeakWork,
    ) -> Option<[Lane; 2]> {
        let watched = &mut work.peaks.watch.blocks[building.first + b];
        if watched.clear_until > segment {
            return None;
        }
        let modes = building.modes.clone();
        let end = self.values_at((building, b), &base.rest.watched, (&base.q[modes.clone()], &base.v[modes]));
        let peaks = &mut base.peaks.values.as_chunks_mut::<LANES>().0[building.first + b];
        let may_exceed = watched.raise_to(&end, peaks);
        let start = std::mem::replace(&mut watched.value, end);
        watched.known_at = Some(segment + 1);
        may_exceed.then_some([start, end])
    }

    /// Raises the peaks of a block over a part of a flight, which began with the base's segment and ends with a motion;
    /// returns whether they may have been exceeded before the end, or whether that is not known.
    pub(in crate::engine) fn raise_to_part(
        &self,
        building: &BuildingRows,
        b: usize,
        (watch, segment): (&PeakWatch, u64),
        (rest, (q, v)): (&[f64], (&[f64], &[f64])),
        peaks: &mut Peaks,
    ) -> bool {
        let (place, modes) = (building.first + b, building.modes.clone());
        let watched = &watch.blocks[place];
        if watched.clear_until > segment {
            return false;
        }
        if watched.known_at != Some(segment) {
            return true;
        }
        let end = self.values_at((building, b), rest, (&q[modes.clone()], &v[modes]));
        watched.raise_to(&end, &mut peaks.values.as_chunks_mut::<LANES>().0[place])
    }
}

impl WatchedBlock {
    /// Raises peaks to the values at the end of a segment, or of a part of it, at whose start the values are known;
    /// returns whether they may have been exceeded in between.
    #[inline(always)]
    fn raise_to(&self, end: &Lane, peaks: &mut Lane) -> bool {
        let mut may_exceed = false;
        for i in 0..LANES {
            let (start, end, sag) = (self.value[i], end[i], self.sag[i]);
            let is_below = larger(start.abs(), end.abs()) + sag <= peaks[i];
            // A slope differs from that of the chord by at most h/2 |y''|: if that is less than the chord's slope, the
            // quantity is monotonic.
            let goes_one_way = (end - start).abs() > 4.0 * sag;
            peaks[i] = larger(peaks[i], end.abs());
            may_exceed |= !(is_below || goes_one_way);
        }
        may_exceed
    }

    /// Number of segments of that length, s, for which all quantities of the block stay below their peaks.
    #[inline(always)]
    fn segments_to_peak(&self, peaks: &Lane, length: f64) -> u64 {
        let mut least = SHORT as f64;
        for ((peak, value), rate) in peaks.iter().zip(&self.value).zip(&self.rate) {
            let segments = (peak - value.abs()) / (length * rate);
            // A quantity that is always 0 has the rate 0; a NaN never clears a block.
            let segments = if *rate == 0.0 { least } else { segments };
            least = if segments >= least { least } else { segments };
        }
        // The conversion makes 0 of negative numbers and NaN.
        (least - MARGIN) as u64
    }
}
