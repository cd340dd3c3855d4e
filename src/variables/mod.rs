//! The variables of the FMU: one table for description and dispatch.
//!
//! [`Table::new`] lists what exists for a scene; the value reference of a variable is the number of its row. The
//! description walks the rows, and every access goes through the row's [`Slot`] (`values.rs`), so the two cannot differ.
//!
//! A new variable is a variant of [`Output`], [`Parameter`] or [`Input`] (`slot.rs`), its row in `rows.rs` and its arm in
//! `values.rs`; the compiler asks for the arms.

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
pub use slot::{Causality, ContactOutput, EnergyOutput, Input, Output, Parameter, Slot};
pub use table::{Row, Table, Type, Variability};
pub use unit::{Unit, UnitInfo};
pub use values::{Inputs, Instant, Settings, Value};
