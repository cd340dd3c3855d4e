//! The variables of the FMU: one table for description and dispatch.
//!
//! [`Table::new`] lists what exists for a scene; the value reference of a variable is the number of its row. The
//! description walks the rows, and every access goes through the row's [`Slot`] (`values.rs`), so the two cannot differ.
//!
//! A new output or input is named in the engine (`engine/output/outputs.rs`, `engine/excitation/inputs.rs`), a new parameter in
//! `slot.rs`; its row is in `rows.rs`, and the compiler asks for the arms: of a parameter in `values.rs`, of an output in
//! `initial_dependencies.rs`.

mod changes;
mod dependencies;
mod derivatives;
mod initial_dependencies;
mod rows;
mod slot;
mod table;
mod unit;
mod values;

pub use changes::Changes;
pub use dependencies::{Dependence, at_communication_points};
pub use derivatives::{HIGHEST_OUTPUT_DERIVATIVE, by_parameter};
pub use initial_dependencies::at_start;
pub use slot::{Causality, Parameter, Slot};
pub use table::{Row, Table, Type, Variability};
pub use unit::{Unit, UnitInfo};
pub use values::{Settings, Value};
