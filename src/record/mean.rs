//! The mean of the samples: whether it is an offset of the instrument, and the record without it.
//!
//! K-NET, KiK-net and other networks hand out what the sensor gave, about a level that is not 0: between 2 % of the peak and many
//! times the motion. Scaled to a peak such a record is scaled by its offset, and buildings lean under it from the beginning.

use super::accelerogram::Record;
use crate::numerics::sum::Sum;

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

    /// m/s2, the mean, where it is a level about which the record stands: more than a hundredth of the peak about it. A motion that
    /// begins and ends at exactly 0 has its level there: a pulse has none.
    ///
    /// ```
    /// use pounding::record::Record;
    ///
    /// let about = |level: f64| Record::new(vec![0.0, 1.0, 2.0, 3.0], [0.1, -1.0, 1.0, -0.1].map(|a| level + a).to_vec());
    /// assert_eq!(about(0.0).offset(), None);
    /// assert_eq!(about(0.5).offset(), Some(0.5));
    /// ```
    pub fn offset(&self) -> Option<f64> {
        let ends = [self.accelerations.first(), self.accelerations.last()];
        let has_level = ends.iter().all(|end| end.is_none_or(|a| *a == 0.0));
        let mean = self.mean();
        (!has_level && mean.abs() > OFFSET * self.peak_about(mean)).then_some(mean)
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
