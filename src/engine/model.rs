//! The model: everything about a scene that stays as it is during a run.

use crate::engine::budget::{MOST_WORK, most_flights};
use crate::engine::excitation::record::GroundMotion;
use crate::engine::flight::Flight;
use crate::engine::pairs::pair::Pair;
use crate::engine::peaks::resistance::FloorResistance;
use crate::engine::peaks::rows::PeakRows;
use crate::engine::system::System;
use crate::engine::window::kernels::Windows;
use crate::record::Record;
use crate::scene::{Building, Problem, Scene, SceneError};
use crate::structure::{Side, Structure};
use std::f64::consts::PI;

/// Everything that stays as it is during a run.
#[derive(Debug)]
pub struct Model {
    pub(in crate::engine) system: System,
    pub(in crate::engine) energy: bool,
    pub(in crate::engine) flight: Flight,
    pub(in crate::engine) windows: Option<Windows>,
    pub(in crate::engine) peak_rows: PeakRows,
    pub(in crate::engine) resistance: FloorResistance,
    pub(in crate::engine) frequencies: [Vec<f64>; 2],
    pub(in crate::engine) initial: [Vec<f64>; 2],
    /// What one communication step may take, in flights.
    pub(in crate::engine) most_flights: f64,
}

impl Model {
    /// Prepares a checked scene. `record` is there when `scene.ground.record` is.
    pub fn new(scene: &Scene, record: Option<&Record>) -> Result<Model, SceneError> {
        let structure = Structure::new(&scene.left, &scene.right).map_err(|(side, _)| not_positive_definite(side))?;
        let pairs: Vec<Pair> = scene.contacts.iter().map(|pair| Pair::new(pair, scene, &structure)).collect();
        let ground = match record {
            Some(record) if record.times.len() < 2 => return Err(too_short(record)),
            Some(record) => {
                let factor = scene.ground.scaling.factor(record).map_err(|p| SceneError { problems: vec![p] })?;
                Some(GroundMotion::new(record, factor, &structure))
            }
            None => None,
        };
        let system = System::new(structure, pairs, ground, scene);
        let structure = &system.structure;
        Ok(Model {
            flight: Flight::new(&system),
            windows: Windows::of(&system),
            peak_rows: PeakRows::of(structure, scene.peaks),
            resistance: FloorResistance::of(structure),
            frequencies: [Side::Left, Side::Right]
                .map(|side| structure.modes(side).omega.iter().map(|w| w / (2.0 * PI)).collect()),
            initial: initial_state(scene, structure),
            energy: scene.energy,
            most_flights: most_flights(structure, system.pairs.len(), MOST_WORK),
            system,
        })
    }

    /// Number of floors of a building.
    pub fn floors(&self, side: Side) -> usize {
        self.system.structure.floors(side)
    }

    /// Number of contacts.
    pub fn contacts(&self) -> usize {
        self.system.pairs.len()
    }
}

fn initial_state(scene: &Scene, structure: &Structure) -> [Vec<f64>; 2] {
    let mut state = [vec![0.0; structure.lanes], vec![0.0; structure.lanes]];
    for (side, building) in [(Side::Left, &scene.left), (Side::Right, &scene.right)] {
        let Building { mass, initial_displacement, initial_velocity, .. } = building;
        structure.to_modal(side, mass, initial_displacement, &mut state[0]);
        structure.to_modal(side, mass, initial_velocity, &mut state[1]);
    }
    state
}

fn too_short(record: &Record) -> SceneError {
    let found = format!("{} samples", record.times.len());
    Problem::new("ground.record", found, "at least 2 samples, to be linear between").into()
}

fn not_positive_definite(side: Side) -> SceneError {
    let building = match side {
        Side::Left => "left",
        Side::Right => "right",
    };
    let expected = "a positive definite stiffness with natural frequencies that double precision can hold";
    Problem::new(format!("{building}.stiffness"), "", expected).into()
}
