//! The engine: event-driven integration of two buildings with contacts.
//!
//! [`Model`] never changes during a run, [`State`] is plain data; a communication point is read into a [`Point`].
//!
//! ```
//! use pounding::engine::{Model, Point, Side};
//! use pounding::scene::Scene;
//!
//! // 1 t at 0.5 m/s and 2 t at rest, 10 mm apart, on springs that hardly hold them.
//! let scene = Scene::from_toml(
//!     r#"
//!     name = "TwoMasses"
//!     [left]
//!     mass = [1000.0]
//!     stiffness = [1e-3]
//!     damping = { ratio = 0.0 }
//!     initial_velocity = [0.5]
//!     [right]
//!     mass = [2000.0]
//!     stiffness = [1e-3]
//!     damping = { ratio = 0.0 }
//!     [[contact]]
//!     left_floor = 1
//!     right_floor = 1
//!     gap = 0.01
//!     law = "kelvin_voigt"
//!     stiffness = 1e8
//!     restitution = 0.65
//!     "#,
//! )?;
//! let model = Model::new(&scene, None)?;
//! let (mut state, mut point, mut impacts) = (model.start(0.0), Point::default(), Vec::new());
//! model.advance(&mut state, 1.0, &mut |impact| impacts.push(*impact))?;
//! model.observe(&state, &mut point);
//!
//! assert_eq!(point.impacts, 1);
//! assert!((impacts[0].start - 0.02).abs() < 1e-8);
//! assert!((impacts[0].separation_velocity - 0.65 * 0.5).abs() < 1e-8);
//! // What the floors have after an impact with e = 0.65, by momentum.
//! assert!((model.velocity(&point, Side::Left, 0) - (0.5 - 1.65 * 0.5 * 2.0 / 3.0)).abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod advance;
mod closed_pairs;
mod contact_events;
mod contact_step;
mod dismissal;
mod energy;
mod energy_rates;
mod feedthrough;
mod flight;
mod floor_motion;
mod frequencies;
mod glide;
mod ground;
mod input;
mod linear_pairs;
mod look;
mod meeting;
mod members;
mod model;
mod near_pairs;
mod observe;
mod onset_step;
mod open_pairs;
mod pair_forces;
mod peaks;
mod rates;
mod rigid;
mod saved;
mod state;
mod swing;
mod window;
mod window_bounds;
mod window_draft;
mod window_step;
mod work_limit;

use std::cell::Cell;

pub use crate::structure::Side;
pub use energy_rates::EnergyRates;
pub use feedthrough::Response;
pub use input::LinearInput;
pub use model::Model;
pub use peaks::PeakOf;
pub use rates::{ContactRates, PEAK_ROUNDING, PointRates, Rates};
pub use saved::SavedState;
pub use state::{Counters, State};

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
    coordinates: state::Coordinates,
    /// Displacements and velocities, of which `floors` is made.
    q: Vec<f64>,
    v: Vec<f64>,
    floors: floor_motion::FloorMotions,
    /// What is known of each contact.
    contacts: Vec<Cell<observe::Known>>,
    work: Option<Box<state::Workspace>>,
    peaks: peaks::PeakCell,
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
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
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
