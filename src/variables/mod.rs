//! The variables of the FMU: one table for description and dispatch.
//!
//! [`Table::new`] lists what exists for a scene, [`Table::of_fmu`] what its FMU declares; the value reference of a variable
//! is the number of its row. The description walks the rows, and every access goes through the row's [`Slot`]
//! (`settings.rs`), so the two cannot differ.
//!
//! ```
//! use pounding::engine::{Model, Point};
//! use pounding::scene::Scene;
//! use pounding::variables::{Slot, Table, Value};
//!
//! let scene = Scene::from_toml(
//!     "name = \"Mast\"\n\
//!     left = { mass = [1e3], stiffness = [1e5], damping = { ratio = 0.0 }, initial_velocity = [0.1] }",
//! )?;
//! let (table, model) = (Table::new(&scene), Model::new(&scene, None)?);
//! let (state, mut point) = (model.start(0.0), Point::default());
//! let now = model.observe(&state, &mut point);
//! let row = table.rows.iter().find(|row| row.name == "left.velocity[1]").expect("a floor has a velocity");
//! let Slot::Output(output) = row.slot else { panic!("a velocity is an output") };
//! assert_eq!(Value::of(row.ty, now.read(output)), Value::Real(0.1));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A new output or input is named in the engine (`engine/output/outputs.rs`, `engine/excitation/inputs.rs`), a new
//! parameter in `slot.rs`; its row is in `rows.rs` (of links: `link_rows.rs`), and the compiler asks for the arms: of a
//! parameter in `number.rs`, of an output in `initial_dependencies.rs`.

mod changes;
mod dependencies;
mod derivatives;
mod foundation_rows;
mod initial_dependencies;
mod link_rows;
mod number;
mod numbers_only;
mod part;
mod rows;
mod settings;
mod slot;
mod table;
mod unit;
mod values;

pub use changes::Changes;
pub use dependencies::{Dependence, Dependencies};
pub use derivatives::{by_parameter, highest_output_derivative};
pub use initial_dependencies::InitialDependencies;
pub use settings::Settings;
pub use slot::{Calculated, Causality, Parameter, Slot};
pub use table::{Row, SharedRule, Table, Type, Variability};
pub use unit::{Unit, UnitInfo};
pub use values::Value;
