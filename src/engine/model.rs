//! The model: the scene, prepared for the engine; constant during a run.

use crate::engine::base::Base;
use crate::engine::base::kinds::Refusal;
use crate::engine::budget::{MOST_WORK, most_flights};
use crate::engine::excitation::inputs::Inputs;
use crate::engine::flight::Flight;
use crate::engine::peaks::PeakFinder;
use crate::engine::quantities::storeys::Storeys;
use crate::engine::quantities::watched::Watched;
use crate::engine::system::System;
use crate::engine::window::kernels::Windows;
use crate::numerics::identity::next_identity;
use crate::record::Record;
use crate::scene::{Scene, SceneError};
use crate::structure::{Body, BuildingId, LANES, Structure};
use std::f64::consts::PI;

/// The scene, prepared for the engine; constant during a run.
#[derive(Debug)]
pub struct Model {
    /// A number that no other model has: what has been read of one is nothing to another.
    pub(in crate::engine) identity: u64,
    pub(in crate::engine) system: System,
    /// The inputs of its scene, all 0.
    pub(in crate::engine) inputs: Inputs,
    /// Whether the energy account is kept.
    pub(in crate::engine) energy: bool,
    pub(in crate::engine) flight: Flight,
    /// What windows need, or why there are none.
    pub(in crate::engine) windows: Result<Windows, Refusal>,
    pub(in crate::engine) watched: Watched,
    pub(in crate::engine) storeys: Storeys,
    /// Natural frequencies of each building, ascending, Hz.
    pub(in crate::engine) frequencies: Vec<Vec<f64>>,
    /// Those of all bodies, ascending, Hz.
    pub(in crate::engine) system_frequencies: Vec<f64>,
    /// Limit on the work of one communication step, in flights.
    pub(in crate::engine) most_flights: f64,
}

impl Model {
    /// Prepares a checked scene, as [`Scene::from_toml`] and [`load`](crate::scene::load) return it. `record` is there
    /// when `scene.ground.record` is.
    ///
    /// # Errors
    /// A stiffness that is not positive definite, a record of less than two samples, or one that cannot be scaled to a
    /// peak: under the path of the scene's key.
    pub fn new(scene: &Scene, record: Option<&Record>) -> Result<Model, SceneError> {
        let system = System::of(scene, record)?;
        let structure = &system.structure;
        Ok(Model {
            flight: Flight::new(&system),
            windows: Windows::of(&system),
            watched: Watched::of(structure, system.pushes(), scene.peaks),
            frequencies: structure.ids().map(|id| frequencies(&structure.modes(id).omega)).collect(),
            system_frequencies: system_frequencies(structure),
            storeys: Storeys::of(scene),
            inputs: Inputs::new(scene),
            identity: next_identity(),
            energy: scene.energy,
            most_flights: most_flights(structure, system.pairs.len(), MOST_WORK),
            system,
        })
    }

    /// What finds the peaks.
    pub(in crate::engine) fn peaks(&self) -> PeakFinder<'_> {
        PeakFinder { system: &self.system, watched: &self.watched }
    }

    /// Sets the position of rest to that of the storeys.
    pub(in crate::engine) fn set_rest(&self, base: &mut Base) {
        self.system.set_rest(&base.elements, &mut base.rest);
        base.rest.watched.resize(self.watched.rows.blocks() * LANES, 0.0);
        if !base.elements.is_empty() && !self.watched.rows.are_none() {
            self.peaks().set_watched_at_rest(base);
        }
    }

    /// Which buildings there are, from left to right.
    pub fn buildings(&self) -> impl DoubleEndedIterator<Item = BuildingId> + Clone + use<> {
        self.system.structure.ids()
    }

    /// Number of floors of a building; 0 of one that is not there.
    pub fn floors(&self, id: BuildingId) -> usize {
        if id.index() < self.system.structure.ids().count() { self.system.structure.floors(id) } else { 0 }
    }

    /// Number of contacts.
    pub fn contacts(&self) -> usize {
        self.system.pairs.len()
    }
}

/// Frequencies, Hz, of rates in rad/s.
fn frequencies(omega: &[f64]) -> Vec<f64> {
    omega.iter().map(|w| w / (2.0 * PI)).collect()
}

/// Natural frequencies of all bodies, ascending, Hz.
fn system_frequencies(structure: &Structure) -> Vec<f64> {
    let of_body = |body: &Body| frequencies(&body.modes.omega);
    let mut all: Vec<f64> = structure.bodies.iter().flat_map(of_body).collect();
    all.sort_by(f64::total_cmp);
    all
}
