//! The scene: everything that is fixed about a problem, as a user writes it (TOML), with every check.

use crate::contact::ImpactLaw;
use crate::record::Record;
use std::fmt;
use std::path::Path;

/// A scene whose numbers have been checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// C identifier: FMI model name and identifier.
    pub name: String,
    /// One line for a reader.
    pub description: String,
    /// s, end of the default experiment.
    pub stop_time: Option<f64>,
    /// The building on the left.
    pub left: Building,
    /// The building on the right.
    pub right: Building,
    /// Ground motion.
    pub ground: Ground,
    /// `inputs.floor_forces`: every floor gets an external force input.
    pub floor_forces: bool,
    /// Pairs of facing floors.
    pub contacts: Vec<ContactPair>,
    /// `outputs.energy`: the energy account exists.
    pub energy: bool,
    /// Accuracy of the contact episodes.
    pub solver: Solver,
}

/// One building: floors counted from the bottom.
#[derive(Clone, Debug, PartialEq)]
pub struct Building {
    /// kg, one per floor.
    pub mass: Vec<f64>,
    /// N/m.
    pub stiffness: Stiffness,
    /// Structural damping.
    pub damping: Damping,
    /// m relative to the ground, one per floor.
    pub initial_displacement: Vec<f64>,
    /// m/s relative to the ground, one per floor.
    pub initial_velocity: Vec<f64>,
}

/// Stiffness of a building.
#[derive(Clone, Debug, PartialEq)]
pub enum Stiffness {
    /// Shear building: one per storey, storey i below floor i.
    Shear(Vec<f64>),
    /// Symmetric positive definite, rows from the lowest floor.
    Matrix(Vec<Vec<f64>>),
}

/// Damping of a building.
#[derive(Clone, Debug, PartialEq)]
pub enum Damping {
    /// The same ratio of critical damping in every mode.
    Ratio(f64),
    /// One ratio per mode, lowest mode first.
    Ratios(Vec<f64>),
    /// C = alpha M + beta K with this ratio in two modes (counted from 1).
    Rayleigh {
        /// Damping ratio in both modes.
        ratio: f64,
        /// The two modes.
        modes: [usize; 2],
    },
    /// N s/m, symmetric positive semidefinite; need not be classical.
    Matrix(Vec<Vec<f64>>),
}

/// Ground motion of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Ground {
    /// Record file as written in the scene; `None`: the acceleration is an FMI input.
    pub record: Option<String>,
    /// Factor on the record, or the peak that it is scaled to.
    pub scaling: Scaling,
}

/// How the record is scaled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scaling {
    /// Factor.
    Scale(f64),
    /// Peak ground acceleration, m/s2.
    Pga(f64),
}

impl Scaling {
    /// The factor on a record.
    pub fn factor(self, record: &Record) -> Result<f64, Problem> {
        match self {
            Scaling::Scale(factor) => Ok(factor),
            Scaling::Pga(pga) => Ok(pga / record.peak()),
        }
    }
}

/// Two facing floors.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactPair {
    /// Floor of the left building, counted from 1.
    pub left_floor: usize,
    /// Floor of the right building, counted from 1.
    pub right_floor: usize,
    /// m, clear distance at rest; may be 0 or negative.
    pub gap: f64,
    /// Force of the contact.
    pub law: ImpactLaw,
}

/// Accuracy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solver {
    /// Error of each contact episode relative to the velocities in it.
    pub relative_tolerance: f64,
    /// m/s, floor on the approach velocity where a law divides by it.
    pub min_approach_velocity: f64,
}

/// One thing that is wrong with a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Path in the file, such as `contact[2].restitution`.
    pub path: String,
    /// The value found; empty where something is missing.
    pub found: String,
    /// What was expected.
    pub expected: String,
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.found.is_empty() {
            write!(f, "{}: expected {}", self.path, self.expected)
        } else {
            write!(f, "{} = {}: expected {}", self.path, self.found, self.expected)
        }
    }
}

/// Everything that is wrong with a scene, at once.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct SceneError {
    /// In the order of the file.
    pub problems: Vec<Problem>,
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, problem) in self.problems.iter().enumerate() {
            if i > 0 {
                writeln!(f)?;
            }
            write!(f, "{problem}")?;
        }
        Ok(())
    }
}

impl Scene {
    /// Reads a scene from TOML text.
    pub fn from_toml(_text: &str) -> Result<Scene, SceneError> {
        todo!()
    }

    /// Checks every number again, as after a parameter has been changed through the FMI.
    pub fn check(&self) -> Result<(), SceneError> {
        todo!()
    }
}

/// Reads a scene file and the record beside it.
pub fn load(_path: &Path) -> Result<(Scene, Option<Record>), SceneError> {
    todo!()
}
