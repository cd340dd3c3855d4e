//! Vectors that go together: displacements and velocities, a load and its rate.

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

/// A load per unit of mass that is linear in time, m/s2, on modes kg^1/2 m/s2: all of its entries.
#[derive(Clone, Copy, Debug)]
pub struct LinearLoad<'a> {
    /// The load at the start.
    pub load: &'a [f64],
    /// Its rate, per second.
    pub slope: &'a [f64],
}
