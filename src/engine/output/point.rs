//! The solution at one time, as floors and contacts show it.

use crate::engine::base::Coordinates;
use crate::engine::output::known::{FloorMotions, PeakCell};
use crate::engine::system::buffers::Buffers;
use std::cell::Cell;

/// The solution at one time, as floors and contacts show it, each worked out when it is first read.
#[derive(Clone, Debug, Default)]
pub struct Point {
    /// s.
    pub time: f64,
    /// m/s2.
    pub ground_acceleration: f64,
    /// Contact episodes begun so far, all contacts.
    pub impacts: u64,
    /// Present where the scene asks for it.
    pub energy: Option<EnergyPoint>,
    /// What the following vectors hold.
    pub(in crate::engine) coordinates: Coordinates,
    /// Displacements and velocities, of which `floors` is made.
    pub(in crate::engine) q: Vec<f64>,
    pub(in crate::engine) v: Vec<f64>,
    pub(in crate::engine) floors: FloorMotions,
    /// What is known of each contact.
    pub(in crate::engine) contacts: Vec<Cell<Known>>,
    pub(in crate::engine) work: Option<Box<Buffers>>,
    pub(in crate::engine) peaks: PeakCell,
}

/// One contact at one time. Names and meaning as in the FMU variables `contact[p].*`.
#[derive(Clone, Copy, Debug, Default)]
pub struct ContactPoint {
    /// N, compression positive.
    pub force: f64,
    /// m, negative while apart.
    pub penetration: f64,
    /// In contact now.
    pub active: bool,
    /// Episodes begun so far.
    pub impacts: u64,
    /// N, largest so far.
    pub peak_force: f64,
    /// N s so far.
    pub impulse: f64,
    /// J so far.
    pub dissipated_energy: f64,
    /// m/s at the start of the latest episode.
    pub approach_velocity: f64,
}

/// The energy account, J, in motion relative to the ground. Names and meaning as in the FMU variables `energy.*`.
#[derive(Clone, Copy, Debug, Default)]
pub struct EnergyPoint {
    /// Work of the inertia forces of the ground motion.
    pub input: f64,
    /// Kinetic energy.
    pub kinetic: f64,
    /// Strain energy of the storeys.
    pub strain: f64,
    /// Dissipated by structural damping.
    pub viscous: f64,
    /// Work done on the contacts.
    pub impact: f64,
    /// Work of the external floor forces.
    pub external: f64,
    /// Imbalance divided by the largest magnitude that any of them has had.
    pub residual: f64,
}

/// What a contact shows, and the observation that it is of.
#[derive(Clone, Copy, Debug, Default)]
pub struct Known {
    pub observation: u64,
    pub shown: ContactPoint,
}
