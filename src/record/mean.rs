//! The mean of the samples: whether it is an offset of the instrument, and the record without it.
//!
//! K-NET, KiK-net and other networks hand out what the sensor gave, about a level that is not 0 and may be many times the motion.
//! Scaled to a peak such a record is scaled by its offset, and buildings lean under it from the beginning.

use super::accelerogram::Record;
use crate::numerics::sum::Sum;

/// Samples from which on a record is a measured one and not a few corners drawn by hand.
pub(crate) const MEASURED: usize = 50;
/// Share of the peak about the mean from which on a mean is an offset.
const OFFSET: f64 = 0.01;
/// Share of the largest velocity from which on the velocity is one that a mean leaves at the end.
const DRIFT: f64 = 0.25;

impl Record {
    /// m/s2, of the samples.
    pub fn mean(&self) -> f64 {
        let mut sum = Sum::default();
        self.accelerations.iter().for_each(|a| sum.add(*a));
        sum.exact() / self.accelerations.len() as f64
    }

    /// m/s2, the mean, where it is a level about which a measured record stands: more than a hundredth of the peak about it. A motion
    /// that begins or ends at exactly 0 has its level there, as a pulse has.
    ///
    /// ```
    /// use pounding::record::Record;
    ///
    /// let times: Vec<f64> = (0..100).map(f64::from).collect();
    /// let about = |level: f64| Record::new(times.clone(), times.iter().map(|t| level + (t + 0.5).sin()).collect());
    /// assert_eq!(about(0.0).offset(), None);
    /// assert!((about(0.5).offset().unwrap() - 0.5).abs() < 0.01);
    /// ```
    pub fn offset(&self) -> Option<f64> {
        let is_zero = |end: Option<&f64>| end.is_none_or(|a| *a == 0.0);
        let has_level = is_zero(self.accelerations.first()) || is_zero(self.accelerations.last());
        if has_level || self.accelerations.len() < MEASURED {
            return None;
        }
        let mean = self.mean();
        (mean.abs() > OFFSET * self.peak_about(mean)).then_some(mean)
    }

    /// m/s, the velocity that the mean leaves the ground with, where that is a quarter of the largest that the rest has, and more.
    pub fn drift(&self) -> Option<f64> {
        let mean = self.mean();
        let (Some(first), Some(last)) = (self.times.first(), self.times.last()) else { return None };
        let (mut velocity, mut largest) = (0.0, 0.0_f64);
        for (times, values) in self.times.windows(2).zip(self.accelerations.windows(2)) {
            velocity += (times[1] - times[0]) * ((values[0] - mean) + (values[1] - mean)) / 2.0;
            largest = largest.max(f64::abs(velocity));
        }
        let left = mean * (last - first);
        (left.abs() > DRIFT * largest).then_some(left)
    }

    /// m/s2, largest distance from a level.
    pub(crate) fn peak_about(&self, level: f64) -> f64 {
        self.accelerations.iter().fold(0.0, |peak, a| peak.max((a - level).abs()))
    }

    /// Takes the mean of the samples away.
    pub fn remove_mean(&mut self) {
        let mean = self.mean();
        self.accelerations.iter_mut().for_each(|a| *a -= mean);
    }
}
