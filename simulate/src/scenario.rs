//! A scene with its record and its parameters, as programs hand it from step to step.

use crate::STOP;
use crate::corrections::Corrections;
use pounding::description::Package;
use pounding::engine::Model;
use pounding::record::Record;
use pounding::scene::{BuildingId, Problem, SceneError, Stiffness};
use pounding::variables::{Parameter, Settings, Slot, Table, Value};
use pounding::warnings::{self, Warning};
use std::sync::Arc;

/// A scene that never changes: what gives it a record or parameters returns another one.
pub struct Scenario {
    /// As it goes into an FMU.
    pub package: Arc<Package>,
    /// Its parameters, and the record that runs.
    pub settings: Settings,
    /// Its variables.
    pub table: Table,
    /// What another program's buildings add, in a run that has been made.
    pub corrections: Arc<Corrections>,
    /// Whether anything is not as the scene says.
    is_changed: bool,
}

impl Scenario {
    /// As the scene says.
    pub fn new(package: Package) -> Scenario {
        let record = package.record.as_ref().map(|packaged| packaged.record.clone());
        let settings = Settings::new(package.scene.clone(), record);
        let table = Table::new(&settings.scene);
        Scenario { package: Arc::new(package), settings, table, corrections: Arc::default(), is_changed: false }
    }

    fn changed(&self, settings: Settings) -> Scenario {
        let table = Table::new(&settings.scene);
        Scenario { package: Arc::clone(&self.package), settings, table, corrections: Arc::default(), is_changed: true }
    }

    /// The same under another record.
    ///
    /// # Errors
    /// A record that cannot be scaled as the scene says.
    pub fn with_record(&self, name: &str, record: &Arc<Record>) -> Result<Scenario, SceneError> {
        let mut settings = self.settings.clone();
        if settings.scene.ground.record.is_some() {
            settings.set_record(name, Arc::clone(record))?;
        } else {
            let mut scene = settings.scene;
            scene.ground.record = Some(name.to_owned());
            settings = Settings::new(scene, Some(record.as_ref().clone()));
            settings.check()?;
        }
        Ok(self.changed(settings))
    }

    /// The same with other parameters.
    ///
    /// # Errors
    /// Everything that is wrong with them.
    pub fn with_parameters(&self, parameters: &[(Parameter, f64)]) -> Result<Scenario, SceneError> {
        let mut settings = self.settings.clone();
        for (parameter, value) in parameters {
            settings.write(*parameter, Value::Real(*value))?;
        }
        settings.check()?;
        Ok(self.changed(settings))
    }

    /// The same without any contact: how each building moves by itself.
    pub fn without_contacts(&self) -> Scenario {
        let mut settings = self.settings.clone();
        settings.scene.contacts.clear();
        self.changed(settings)
    }

    /// The same whose buildings another program has, with this stiffness in place of what their storeys are in the
    /// scene.
    ///
    /// # Errors
    /// Everything that is wrong with it then.
    pub fn with_outside(&self, stiffness: Vec<(BuildingId, Stiffness)>) -> Result<Scenario, SceneError> {
        let mut settings = self.settings.clone();
        if stiffness.iter().any(|(id, _)| id.index() >= settings.scene.buildings.len()) {
            let expected = "masses of a building, whose storeys a model can have";
            return Err(Problem::new("right", "", expected).into());
        }
        settings.scene.restoring_corrections = true;
        for (id, stiffness) in stiffness {
            let building = settings.scene.building_mut(id);
            (building.stiffness, building.yielding) = (stiffness, None);
        }
        settings.check()?;
        Ok(self.changed(settings))
    }

    /// The same with what these buildings have added to a run.
    pub fn with_corrections(&self, corrections: Corrections) -> Scenario {
        Scenario { corrections: Arc::new(corrections), ..self.changed(self.settings.clone()) }
    }

    /// What looks like a slip in it.
    pub fn warnings(&self) -> Vec<Warning> {
        if self.is_changed {
            self.settings.warnings()
        } else {
            warnings::of_file(&self.package.scene, self.settings.record())
        }
    }

    /// The parameter of a value reference.
    pub fn parameter(&self, reference: u32) -> Option<Parameter> {
        match self.table.row(reference)?.slot {
            Slot::Parameter(parameter) => Some(parameter),
            _ => None,
        }
    }

    /// s, when a run ends where nothing else is said.
    pub fn stop(&self) -> f64 {
        let end = || self.settings.record()?.times.last().copied().filter(|&end| end > 0.0);
        self.settings.scene.stop_time.or_else(end).unwrap_or(STOP)
    }

    /// Ready to be run.
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn model(&self) -> Result<Model, SceneError> {
        Model::new(&self.settings.scene, self.settings.record())
    }
}
