//! The scene as data, field by field. Contacts: `contact_pair`.

use super::contact_pair::ContactPair;
use super::facing::Facing;
use super::foundation::Foundation;
use super::levels::Heights;
use super::link::Link;
use super::problem::{Problem, number};
use super::rule;
use super::units::Units;
use crate::figures::short;
use crate::record::{Record, RecordOptions};

/// A scene whose numbers have been checked.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Scene {
    /// C identifier: FMI model name and identifier.
    pub name: String,
    /// One line for a reader.
    pub description: String,
    /// How the file gives masses and forces, for messages about it: all numbers here are in SI units.
    pub units: Units,
    /// s, end of the default experiment.
    pub stop_time: Option<f64>,
    /// The buildings, from left to right: `[left]` and `[right]`, or those of the `[[building]]` tables.
    pub buildings: Vec<Building>,
    /// Ground motion.
    pub ground: Ground,
    /// `inputs.floor_forces`: every floor gets an external force input.
    pub floor_forces: bool,
    /// `inputs.restoring_corrections`: every storey, or floor of a stiffness matrix, gets an input for what the
    /// building resists with less than its stiffness says.
    pub restoring_corrections: bool,
    /// What may collide.
    pub contacts: Vec<ContactPair>,
    /// Devices between the buildings, or between a floor and the ground.
    pub links: Vec<Link>,
    /// What `[facing]` has made, where the scene has it.
    pub facing: Option<Facing>,
    /// `outputs.energy`: the energy account exists.
    pub energy: bool,
    /// `outputs.peaks`: the largest displacements, drifts, accelerations and base shears so far exist.
    pub peaks: bool,
    /// `outputs.numbers_only`: the FMU declares numbers alone, for importers that take every variable for one.
    pub numbers_only: bool,
    /// Accuracy of the contact episodes.
    pub solver: Solver,
}

/// One building: floors counted from the bottom.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Building {
    /// What it is called: the beginning of the names of its variables.
    pub name: String,
    /// Where it stands in the file of the scene, such as `left` or `building[2]`: the beginning of the paths of its keys.
    pub path: String,
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
    /// Heights of the storeys, where the scene has them.
    pub heights: Option<Heights>,
    /// Where the storeys of a shear building yield; `None` where none does.
    pub yielding: Option<Yielding>,
    /// Gravity on storeys that lean; `None` where a scene leaves it out.
    pub p_delta: Option<PDelta>,
    /// What the building stands on, where that is not the ground itself.
    pub foundation: Option<Foundation>,
}

/// Bilinear storeys with kinematic hardening.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Yielding {
    /// N, one per storey: the storey shear at first yield; infinite where a storey stays elastic.
    pub force: Vec<f64>,
    /// Stiffness after yield over that before, one per storey.
    pub ratio: Vec<f64>,
}

/// Share of its height by which a storey leans when it has collapsed, where a scene does not say otherwise.
pub const COLLAPSE_DRIFT_RATIO: f64 = 0.5;

/// Gravity on the storeys of a building.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct PDelta {
    /// Whether gravity pushes each storey on that leans.
    pub leaning: Vec<bool>,
    /// N, one per floor; `None`: that of its mass.
    pub load: Option<Vec<f64>>,
    /// A storey has collapsed where its drift is this share of its height.
    pub collapse_drift_ratio: f64,
}

impl Building {
    /// A building at rest whose storeys stay elastic, without heights.
    pub fn new(name: impl Into<String>, mass: Vec<f64>, stiffness: Stiffness, damping: Damping) -> Building {
        let (initial_displacement, initial_velocity) = (vec![0.0; mass.len()], vec![0.0; mass.len()]);
        let name = name.into();
        Building {
            path: name.clone(),
            name,
            mass,
            stiffness,
            damping,
            initial_displacement,
            initial_velocity,
            heights: None,
            yielding: None,
            p_delta: None,
            foundation: None,
        }
    }
}

impl Yielding {
    /// Of one yield force, N, and one ratio per storey.
    pub fn new(force: Vec<f64>, ratio: Vec<f64>) -> Yielding {
        Yielding { force, ratio }
    }
}

impl PDelta {
    /// On these storeys, by the weights of the masses.
    pub fn new(leaning: Vec<bool>) -> PDelta {
        PDelta { leaning, load: None, collapse_drift_ratio: COLLAPSE_DRIFT_RATIO }
    }
}

/// Stiffness of a building.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Stiffness {
    /// Shear building: one per storey, storey i below floor i.
    Shear(Vec<f64>),
    /// Symmetric (within 1e-12 of the largest entry) positive definite, rows from the lowest floor.
    Matrix(Vec<Vec<f64>>),
}

/// Damping of a building.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Damping {
    /// The same ratio of critical damping in every mode.
    Ratio(f64),
    /// One ratio per mode, lowest mode first.
    Ratios(Vec<f64>),
    /// C = alpha M + beta K with this ratio in two modes (counted from 1).
    Rayleigh {
        /// Damping ratio in both modes.
        ratio: f64,
        /// The two modes, different, in any order.
        modes: [usize; 2],
    },
    /// N s/m, one per storey.
    Dashpots(Vec<f64>),
    /// N s/m, symmetric (within 1e-12 of the largest entry) positive semidefinite; need not be classical.
    Matrix(Vec<Vec<f64>>),
}

/// Ground motion of the scene.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Ground {
    /// Record file as written in the scene; `None`: the acceleration is an FMI input.
    pub record: Option<String>,
    /// What the scene says about that file.
    pub options: RecordOptions,
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

/// Accuracy.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Solver {
    /// Error of each contact episode relative to the velocities in it.
    pub relative_tolerance: f64,
    /// m/s, floor on the approach velocity where a law divides by it.
    pub min_approach_velocity: f64,
}

impl Building {
    /// How messages call it: "the left building", or in a row `building "corner"`.
    pub fn called(&self) -> String {
        if self.path == self.name { format!("the {} building", self.name) } else { format!("building {:?}", self.name) }
    }

    /// Yield force, N, and post-yield ratio of a storey, counted from 0, that can yield.
    pub fn yielding_storey(&self, storey: usize) -> Option<(f64, f64)> {
        let Yielding { force, ratio } = self.yielding.as_ref()?;
        Some((*force.get(storey)?, *ratio.get(storey)?)).filter(|(force, _)| force.is_finite())
    }

    /// The drift of a storey, counted from 0, at the start, m.
    pub fn initial_drift(&self, storey: usize) -> f64 {
        let of = |floor: usize| self.initial_displacement[floor];
        of(storey) - storey.checked_sub(1).map_or(0.0, of)
    }
}

impl Stiffness {
    /// N/m, of a storey of a shear building, counted from 0.
    pub fn of_storey(&self, storey: usize) -> Option<f64> {
        match self {
            Stiffness::Shear(storeys) => storeys.get(storey).copied(),
            Stiffness::Matrix(_) => None,
        }
    }
}

impl Default for Solver {
    fn default() -> Solver {
        Solver { relative_tolerance: 1e-12, min_approach_velocity: 1e-4 }
    }
}

impl Scaling {
    /// The factor by which the samples of a record are multiplied.
    ///
    /// # Errors
    /// The problem, at `ground.scale` or `ground.pga`, where there is no such factor: an all-zero record has no peak to
    /// scale, that of one with an offset is not its own, and accelerations go up to [`rule::MOST_ACCELERATION`].
    pub fn factor(self, record: &Record) -> Result<f64, Problem> {
        let peak = record.peak();
        if let (Scaling::Pga(pga), Some(mean)) = (self, record.offset()) {
            let expected = format!(
                "a record about 0, but the mean of this one is {} m/s2 and its peak {} m/s2: remove_mean takes it away, as in \
                 record = {{ file = ..., remove_mean = true }}",
                short(mean),
                short(peak)
            );
            return Err(Problem::new("ground.pga", number(pga), expected));
        }
        let (path, value, factor) = match self {
            Scaling::Scale(scale) => ("ground.scale", scale, scale),
            Scaling::Pga(pga) => ("ground.pga", pga, pga / peak),
        };
        if factor.is_finite() && (factor * peak).abs() <= rule::MOST_ACCELERATION {
            return Ok(factor);
        }
        let expected = if peak == 0.0 {
            "a record with a peak, but all its accelerations are 0".to_owned()
        } else {
            let (peak, most) = (number(peak), rule::MOST_ACCELERATION);
            format!("accelerations up to {most:e} m/s2 from a record with a peak of {peak} m/s2")
        };
        Err(Problem::new(path, number(value), expected))
    }
}
