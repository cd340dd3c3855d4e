//! What every kind of step plans.

/// What ends a step, at which contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// Penetration passes 0 upwards.
    Entry(usize),
    /// Penetration is back at 0.
    Release(usize),
    /// The force passes from one branch to the other.
    Branch(usize),
}

/// Penetration, m, and its rate, m/s, one per contact.
pub type Carried = Vec<Option<(f64, f64)>>;
