//! Vectors that go together: displacements and velocities, a load or the ground's acceleration and its rate.

/// Displacements, m, of modes m kg^1/2, or the coordinates of oscillators, and their rates, per second.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion<'a> {
    /// Displacements.
    pub q: &'a [f64],
    /// Velocities.
    pub v: &'a [f64],
}

/// The same, to be written.
#[derive(Debug)]
pub struct MotionMut<'a> {
    /// Displacements.
    pub q: &'a mut [f64],
    /// Velocities.
    pub v: &'a mut [f64],
}

impl MotionMut<'_> {
    /// Makes it the same as another.
    pub fn copy_from(self, Motion { q, v }: Motion) {
        self.q.copy_from_slice(q);
        self.v.copy_from_slice(v);
    }
}

/// A load per unit of mass that is linear in time, m/s2, on modes kg^1/2 m/s2: all of its entries.
#[derive(Clone, Copy, Debug)]
pub struct LinearLoad<'a> {
    /// The load at the start.
    pub load: &'a [f64],
    /// Its rate, per second.
    pub slope: &'a [f64],
}

/// The ground's acceleration over a time in which it is linear.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LinearGround {
    /// At the start, m/s2.
    pub acceleration: f64,
    /// Its slope, m/s3.
    pub slope: f64,
}

impl LinearGround {
    /// The acceleration some seconds after the start, m/s2.
    #[inline(always)]
    pub fn after(self, time: f64) -> f64 {
        self.acceleration + self.slope * time
    }

    /// The same from some seconds after the start on.
    pub fn later(self, time: f64) -> LinearGround {
        LinearGround { acceleration: self.after(time), ..self }
    }
}
