//! The engine: event-driven integration of two buildings with contacts.
//!
//! [`Model`] never changes during a run, [`State`] is plain data; a communication point is read into a [`Point`].

use crate::record::Record;
use crate::scene::{Scene, SceneError};

/// Which building.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// On the left.
    Left,
    /// On the right.
    Right,
}

/// Everything that stays as it is during a run.
#[derive(Debug)]
pub struct Model {}

/// Everything that changes during a run.
#[derive(Clone, Debug)]
pub struct State {}

/// The solution at one time, as floors and contacts show it.
#[derive(Clone, Debug, Default)]
pub struct Point {
    /// s.
    pub time: f64,
    /// m/s2.
    pub ground_acceleration: f64,
    /// One per contact.
    pub contacts: Vec<ContactPoint>,
    /// Contact episodes begun so far, all contacts.
    pub impacts: u64,
    /// Present where the scene asks for it.
    pub energy: Option<EnergyPoint>,
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

/// One contact episode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Episode {
    /// Contact, counted from 0.
    pub contact: usize,
    /// s.
    pub start: f64,
    /// s; `None` while open.
    pub end: Option<f64>,
    /// m/s at the start.
    pub approach_velocity: f64,
    /// m/s at the end, positive when separating.
    pub separation_velocity: f64,
    /// N.
    pub peak_force: f64,
    /// s.
    pub peak_time: f64,
    /// m.
    pub peak_penetration: f64,
    /// N s.
    pub impulse: f64,
    /// J.
    pub dissipated_energy: f64,
}

/// What the engine cannot go on from; carries the numbers and the remedy.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct EngineError {
    /// For a person.
    pub message: String,
}

impl Model {
    /// Prepares a checked scene. `record` is there when `scene.ground.record` is.
    pub fn new(_scene: &Scene, _record: Option<&Record>) -> Result<Model, SceneError> {
        todo!()
    }

    /// Number of floors of a building.
    pub fn floors(&self, _side: Side) -> usize {
        todo!()
    }

    /// Hz, natural frequencies of one building alone, ascending.
    pub fn natural_frequencies(&self, _side: Side) -> &[f64] {
        todo!()
    }

    /// The initial state at a time, s.
    pub fn start(&self, _time: f64) -> State {
        todo!()
    }

    /// Brings the state to a time, s, and reports each episode when it ends.
    pub fn advance(
        &self,
        _state: &mut State,
        _until: f64,
        _on_episode: &mut dyn FnMut(&Episode),
    ) -> Result<(), EngineError> {
        todo!()
    }

    /// Reads the state at its present time; the buffers of `point` are reused.
    pub fn observe(&self, _state: &State, _point: &mut Point) {
        todo!()
    }

    /// m, relative to the ground; floors counted from 0.
    pub fn displacement(&self, _point: &Point, _side: Side, _floor: usize) -> f64 {
        todo!()
    }

    /// m/s, relative to the ground.
    pub fn velocity(&self, _point: &Point, _side: Side, _floor: usize) -> f64 {
        todo!()
    }

    /// m/s2, absolute.
    pub fn acceleration(&self, _point: &Point, _side: Side, _floor: usize) -> f64 {
        todo!()
    }

    /// N, force of the building on the ground.
    pub fn base_shear(&self, _point: &Point, _side: Side) -> f64 {
        todo!()
    }

    /// m, largest drift of the storey below the floor so far.
    pub fn peak_drift(&self, _state: &State, _side: Side, _floor: usize) -> f64 {
        todo!()
    }

    /// The episode that a contact is in, if it is in one.
    pub fn open_episode(&self, _state: &State, _contact: usize) -> Option<Episode> {
        todo!()
    }
}

impl State {
    /// s, the communication time.
    pub fn time(&self) -> f64 {
        todo!()
    }

    /// m/s2, held from now on; only where the scene has no record.
    pub fn set_ground_acceleration(&mut self, _acceleration: f64) {
        todo!()
    }

    /// N, held from now on; only where the scene has floor forces.
    pub fn set_floor_force(&mut self, _side: Side, _floor: usize, _force: f64) {
        todo!()
    }
}
