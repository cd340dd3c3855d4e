//! The parameters that a master has changed, as plain data: with them, a scene's settings are made again anywhere.

use super::settings::Settings;
use super::slot::{Parameter, Slot};
use super::table::{Table, Type};
use super::values::Value;
use crate::record::Record;
use crate::scene::{Problem, Scaling, SceneError};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// What differs from the parameters that the scene gives.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Changes {
    /// Value references of Real parameters, and their values.
    numbers: Vec<(u32, f64)>,
    /// `ground.record` and what the file held when it was read: it may have changed, or be on another machine.
    record: Option<(String, Record)>,
}

impl Settings {
    /// What differs from `defaults`.
    pub fn changes(&self, defaults: &Settings, table: &Table) -> Changes {
        let is_changed = |parameter: Parameter| match (parameter, self.read(parameter), defaults.read(parameter)) {
            // A peak to scale to is not the factor that it comes to for the present record.
            (Parameter::GroundScale, ..) => bits(self.scene.ground.scaling) != bits(defaults.scene.ground.scaling),
            (_, Value::Real(now), Value::Real(default)) => now.to_bits() != default.to_bits(),
            _ => false,
        };
        let numbers = table.iter().filter_map(|(reference, row)| match row.slot {
            Slot::Parameter(parameter) if is_changed(parameter) => Some((reference, self.read(parameter).real()?)),
            _ => None,
        });
        let record = self.other_record.as_ref().map(|(path, record)| (path.clone(), Record::clone(record)));
        Changes { numbers: numbers.collect(), record }
    }

    /// These settings, as a scene gives them, with changes.
    ///
    /// # Errors
    /// Everything that is wrong with what comes out, or the first change that no parameter of the table can have.
    pub fn with(&self, changes: &Changes, table: &Table) -> Result<Settings, SceneError> {
        let mut settings = self.clone();
        for &(reference, number) in &changes.numbers {
            // Whether it may be infinite, as a yield force, is checked with the scene.
            let row = table.row(reference).filter(|row| matches!(row.ty, Type::Real(_)) && !number.is_nan());
            let Some(Slot::Parameter(parameter)) = row.map(|row| row.slot) else {
                let expected = "a finite number for a Real parameter";
                return Err(Problem::new(format!("value reference {reference}"), number.to_string(), expected).into());
            };
            settings.write(parameter, Value::Real(number))?;
        }
        if let Some((path, record)) = &changes.record {
            let has_record = table.rows.iter().any(|row| row.slot == Slot::Parameter(Parameter::GroundRecord));
            if !has_record {
                return Err(Problem::new("ground.record", format!("{path:?}"), "none in this scene").into());
            }
            let checked = record.clone().checked();
            let record = checked.map_err(|error| {
                Problem::new("ground.record", format!("{path:?}"), format!("a record, but {error}"))
            })?;
            settings.other_record = Some((path.clone(), Arc::new(record)));
        }
        settings.check()?;
        Ok(settings)
    }
}

fn bits(scaling: Scaling) -> (bool, u64) {
    match scaling {
        Scaling::Scale(factor) => (false, factor.to_bits()),
        Scaling::Pga(peak) => (true, peak.to_bits()),
    }
}
