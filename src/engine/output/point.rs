//! The solution at one time, by floors and contacts.

use crate::engine::base::Coordinates;
use crate::engine::base::storey::Storey;
use crate::engine::output::known::{FloorMotions, PeakCell};
use crate::engine::system::buffers::Buffers;
use std::cell::{Cell, RefCell};

/// The solution at one time, by floors and contacts, each of which is worked out when first read.
#[derive(Clone, Debug, Default)]
pub struct Point {
    /// Time, s.
    pub time: f64,
    /// Ground acceleration, m/s2.
    pub ground_acceleration: f64,
    /// Number of contact episodes begun so far, of all contacts.
    pub impacts: u64,
    /// The coordinates of the following vectors.
    pub(in crate::engine) coordinates: Coordinates,
    /// Displacements relative to the position of rest, of which `floors` is made.
    pub(in crate::engine) q: Vec<f64>,
    /// Velocities, of which `floors` is made.
    pub(in crate::engine) v: Vec<f64>,
    pub(in crate::engine) floors: FloorMotions,
    /// The storeys that can yield.
    pub(in crate::engine) storeys: Vec<Storey>,
    /// Displacements of all floors at rest, m.
    pub(in crate::engine) rest: Vec<f64>,
    /// The contacts, as far as they have been worked out.
    pub(in crate::engine) contacts: Vec<Cell<Known<ContactPoint>>>,
    /// The energy account, once it has been worked out.
    pub(in crate::engine) energy: Cell<Known<EnergyPoint>>,
    pub(in crate::engine) work: RefCell<Option<Box<Buffers>>>,
    pub(in crate::engine) peaks: PeakCell,
}

/// One contact at one time. Names and meanings as in the FMU variables `contact[p].*`.
#[derive(Clone, Copy, Debug, Default)]
pub struct ContactPoint {
    /// Force, N, positive in compression.
    pub force: f64,
    /// Penetration, m, negative while apart.
    pub penetration: f64,
    /// Whether the floors are in contact now.
    pub active: bool,
    /// Number of episodes begun so far.
    pub impacts: u64,
    /// Largest force so far, N.
    pub peak_force: f64,
    /// Integral of the force so far, N s.
    pub impulse: f64,
    /// Energy dissipated so far, J.
    pub dissipated_energy: f64,
    /// Approach velocity at the start of the latest episode, m/s.
    pub approach_velocity: f64,
}

/// The energy account, J, for motion relative to the ground. Names and meanings as in the FMU variables `energy.*`.
#[derive(Clone, Copy, Debug, Default)]
pub struct EnergyPoint {
    /// Work of the inertia forces of the ground motion.
    pub input: f64,
    /// Kinetic energy.
    pub kinetic: f64,
    /// Strain energy of the storeys.
    pub strain: f64,
    /// Energy dissipated by structural damping.
    pub viscous: f64,
    /// Work done on the contacts.
    pub impact: f64,
    /// Work of the external floor forces.
    pub external: f64,
    /// Energy dissipated by storeys that have yielded.
    pub hysteretic: f64,
    /// Imbalance of these terms divided by the largest magnitude that any of them has had.
    pub residual: f64,
}

/// Outputs, and the number of the observation to which they belong.
#[derive(Clone, Copy, Debug, Default)]
pub struct Known<T> {
    pub observation: u64,
    pub shown: T,
}
