//! Flights on the ground's motion that follow each other.

/// The load of a flight.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Load {
    /// Ground acceleration at the start, m/s2.
    pub acceleration: f64,
    /// Its slope, m/s3.
    pub slope: f64,
    /// Length, s; 0: a gap, at whose end the motion or the acceleration is another one.
    pub length: f64,
}

/// Flights that follow each other, or the first part of one: the motions at their starts, and at the end of the last one, if it is no gap.
#[derive(Clone, Copy)]
pub struct Flights<'a> {
    pub lanes: usize,
    pub q: &'a [f64],
    pub v: &'a [f64],
    pub loads: &'a [Load],
    pub end: (&'a [f64], &'a [f64]),
}

impl<'a> Flights<'a> {
    /// Number of flights and gaps.
    pub fn count(&self) -> usize {
        match self.loads.last() {
            Some(load) if load.length == 0.0 => self.loads.len() - 1,
            _ => self.loads.len(),
        }
    }

    /// The motion at the start of flight `k`, or at the end of the last one.
    pub fn motion(&self, k: usize) -> (&'a [f64], &'a [f64]) {
        if k == self.loads.len() {
            return self.end;
        }
        let range = k * self.lanes..(k + 1) * self.lanes;
        (&self.q[range.clone()], &self.v[range])
    }

    /// The load of flight `k`; at the end of the last one that of a gap.
    pub fn load(&self, k: usize) -> Load {
        self.loads.get(k).copied().unwrap_or_else(|| {
            let Load { acceleration, slope, length } = self.loads.last().copied().unwrap_or_default();
            Load { acceleration: acceleration + slope * length, slope: 0.0, length: 0.0 }
        })
    }
}
