//! The motion at an instant, for functions that take both of its vectors.

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
