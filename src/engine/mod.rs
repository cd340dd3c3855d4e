//! The engine: event-driven integration of buildings with contacts.
//!
//! [`Model`] never changes during a run, [`State`] is plain data; a communication point is read into a [`Point`], which
//! an [`Instant`] shows.
//!
//! ```
//! use pounding::engine::{BuildingId, Model, Output, Point};
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
//! let now = model.observe(&state, &mut point);
//!
//! assert_eq!(now.contact(0).impacts, 1);
//! assert!((impacts[0].start - 0.02).abs() < 1e-8);
//! assert!((impacts[0].separation_velocity - 0.65 * 0.5).abs() < 1e-8);
//! // What the floors have after an impact with e = 0.65, by momentum.
//! assert!((now.read(Output::Velocity(BuildingId::LEFT, 0)) - (0.5 - 1.65 * 0.5 * 2.0 / 3.0)).abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[allow(unreachable_pub, reason = "public to the engine")]
mod advance;
mod base;
#[allow(unreachable_pub, reason = "public to the engine")]
mod bounds;
mod budget;
mod diagnosis;
mod energy;
mod error;
mod excitation;
#[allow(unreachable_pub, reason = "public to the engine")]
mod flight;
mod follow;
mod model;
#[allow(unreachable_pub, reason = "public to the engine")]
mod onset;
mod output;
mod pairs;
#[allow(unreachable_pub, reason = "public to the engine")]
mod peaks;
mod quantities;
mod rigid;
mod saved;
mod state;
mod step;
#[allow(unreachable_pub, reason = "public to the engine")]
mod system;
#[allow(unreachable_pub, reason = "public to the engine")]
mod taylor;
#[cfg(test)]
mod tests;
#[allow(unreachable_pub, reason = "public to the engine")]
mod window;
mod yielding;

pub use crate::engine::advance::Collapse;
pub use crate::engine::base::contact::Episode;
pub use crate::engine::base::counters::Counters;
pub use crate::engine::base::kinds::{Kind, Refusal};
pub use crate::engine::error::{EngineError, GivenUp};
pub use crate::engine::excitation::inputs::{Input, Inputs, LinearInput};
pub use crate::engine::model::Model;
pub use crate::engine::output::feedthrough::Response;
pub use crate::engine::output::instant::Instant;
pub use crate::engine::output::outputs::{ContactOutput, ContactPoint, ContactRates};
pub use crate::engine::output::outputs::{EnergyOutput, EnergyPoint, EnergyRates};
pub use crate::engine::output::outputs::{FoundationOutput, LinkOutput, Output, Rates, YieldingOf};
pub use crate::engine::output::point::Point;
pub use crate::engine::output::point_rates::PointRates;
pub use crate::engine::quantities::rows::PeakOf;
pub use crate::engine::quantities::storeys::StoreyPeak;
pub use crate::engine::saved::SavedState;
pub use crate::engine::state::State;
pub use crate::engine::window::kernels::window_tables;
pub use crate::structure::BuildingId;
