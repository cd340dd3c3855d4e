//! The solution at one time, by floors and contacts.

use crate::engine::base::Coordinates;
use crate::engine::base::element::ElementState;
use crate::engine::output::known::{FloorMotions, PeakCell};
use crate::engine::output::outputs::{ContactPoint, EnergyPoint};
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
    /// The number of the model whose solution it is.
    pub(in crate::engine) model: u64,
    /// The coordinates of the following vectors.
    pub(in crate::engine) coordinates: Coordinates,
    /// These are coordinates of oscillators, not of modes.
    pub(in crate::engine) oscillates: bool,
    /// The motion is that of the base; otherwise it is that of the following vectors.
    pub(in crate::engine) is_at_base: bool,
    /// Displacements relative to the position of rest.
    pub(in crate::engine) q: Vec<f64>,
    /// Velocities.
    pub(in crate::engine) v: Vec<f64>,
    pub(in crate::engine) floors: FloorMotions,
    /// The storeys that can yield.
    pub(in crate::engine) elements: Vec<ElementState>,
    /// Displacements of all floors at rest, m.
    pub(in crate::engine) rest: Vec<f64>,
    /// The contacts, as far as they have been worked out.
    pub(in crate::engine) contacts: Vec<Cell<Observed<ContactPoint>>>,
    /// The energy account, once it has been worked out.
    pub(in crate::engine) energy: Cell<Observed<EnergyPoint>>,
    /// Energy dissipated by the dashpots of the links, J, worked out with the energy account.
    pub(in crate::engine) dashpots: RefCell<Vec<f64>>,
    pub(in crate::engine) work: RefCell<Option<Box<Buffers>>>,
    pub(in crate::engine) peaks: PeakCell,
}

/// Outputs, and the number of the observation to which they belong.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Observed<T> {
    pub observation: u64,
    pub shown: T,
}
