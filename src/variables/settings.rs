//! The parameters of an FMU, with the record that runs: read, set and checked.

use super::number::{number, number_mut};
use super::slot::{Calculated, Parameter, Slot};
use super::table::{Row, SharedRule};
use super::values::Value;
use crate::record::{KnownRecords, Record};
use crate::scene::{
    Building, Problem, Scaling, Scene, SceneError, Units, read_record_file, record_problems, record_source,
};
use crate::structure::period_ratio;
use crate::warnings::{self, Warning};
use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;

/// The parameters: a scene and the record that runs.
#[derive(Clone, Debug)]
pub struct Settings {
    /// With every parameter that has been set.
    pub scene: Scene,
    /// What `scene.ground.record` names, unless `ground.record` names another.
    packaged_record: Option<Arc<Record>>,
    /// `ground.record` and what it names.
    pub(super) other_record: Option<(String, Arc<Record>)>,
    /// What files have held, for all settings of an instance.
    known_records: Arc<KnownRecords>,
}

impl Settings {
    /// The parameters as the scene gives them, in SI units as all variables of an FMU.
    pub fn new(scene: Scene, record: Option<Record>) -> Settings {
        Settings {
            scene: Scene { units: Units::Si, ..scene },
            packaged_record: record.map(Arc::new),
            other_record: None,
            known_records: Arc::new(KnownRecords::new(1)),
        }
    }

    /// The record that runs.
    pub fn record(&self) -> Option<&Record> {
        let other = self.other_record.as_ref().map(|(_, record)| record);
        other.or(self.packaged_record.as_ref()).map(Arc::as_ref)
    }

    /// The value of a parameter. A parameter that the scene does not have reads as 0; no row of its table names one.
    pub fn read(&self, parameter: Parameter) -> Value<'_> {
        if parameter == Parameter::GroundRecord {
            return Value::String(self.other_record.as_ref().map_or("", |(path, _)| path.as_str()));
        }
        let number = number(&self.scene, parameter);
        let of_record = || self.scene.ground.scaling.factor(self.record()?).ok();
        Value::Real(
            match parameter {
                Parameter::GroundScale => number.or_else(of_record),
                _ => number,
            }
            .unwrap_or_default(),
        )
    }

    /// A calculated parameter that needs no model; 0 for frequencies. A storey that always resists has no critical drift: it is
    /// infinite.
    pub fn calculate(&self, calculated: Calculated) -> f64 {
        match calculated {
            Calculated::Frequency(..) | Calculated::SystemFrequency(_) => 0.0,
            Calculated::PeriodRatio(id) => period_ratio(self.scene.building(id)),
            Calculated::StabilityCoefficient(id, storey) => {
                let building = self.scene.building(id);
                let gravity = building.gravity_stiffness();
                let of = |stiffness: f64| gravity.get(storey).map_or(0.0, |g| g / stiffness);
                building.stiffness.of_storey(storey).map_or(0.0, of)
            }
            Calculated::CriticalDrift(id, storey) => {
                let net = self.scene.building(id).net_storey(storey);
                net.and_then(|net| net.critical_drift()).unwrap_or(f64::INFINITY)
            }
        }
    }

    /// Sets parameters, each a row with a value of its type: all of them, or none where anything is wrong. Only the
    /// rules are asked that these parameters can break, and none about gravity, which may still come right: those are
    /// for [`Settings::check`].
    ///
    /// # Errors
    /// All that is wrong with these values, at once: in the words of the scene, under the names of the variables.
    pub fn set(&mut self, values: &[(&Row, Value<'_>)]) -> Result<(), SceneError> {
        let (scaling, record) = (self.scene.ground.scaling, self.other_record.clone());
        let mut before = Vec::with_capacity(values.len());
        let mut problems = Vec::new();
        for &(row, value) in values {
            let Slot::Parameter(parameter) = row.slot else { continue };
            before.push((parameter, number(&self.scene, parameter)));
            problems.extend(self.write(parameter, value).err().into_iter().flat_map(|error| error.problems));
        }
        for problem in self.problems_of(values.iter().map(|(row, _)| *row)) {
            // One at a time, and a parameter may be set twice.
            if !problems.iter().any(|known| known.path == problem.path) {
                problems.push(problem);
            }
        }
        if problems.is_empty() {
            return Ok(());
        }
        for (parameter, number) in before.into_iter().rev() {
            number_mut(&mut self.scene, parameter).zip(number).into_iter().for_each(|(now, before)| *now = before);
        }
        (self.scene.ground.scaling, self.other_record) = (scaling, record);
        Err(SceneError { problems })
    }

    /// What is wrong with the present values of some parameters, each by its own rule, and together with others.
    fn problems_of<'t>(&self, rows: impl Iterator<Item = &'t Row>) -> Vec<Problem> {
        let (mut problems, mut shared) = (Vec::new(), BTreeSet::new());
        for row in rows {
            let Slot::Parameter(parameter) = row.slot else { continue };
            let ruled = row.rule.zip(number(&self.scene, parameter));
            problems.extend(ruled.and_then(|(rule, number)| rule.problem(&row.name, number)));
            shared.extend(row.shared);
        }
        for rule in shared {
            let mut found = match rule {
                SharedRule::Scaling => Vec::from_iter(self.problem_of_scaling()),
                SharedRule::Overlap(contact) => self.scene.problems_of_overlap(contact),
                SharedRule::Springs => self.scene.problems_of_springs(),
            };
            found.iter_mut().for_each(|problem| self.name_variable(&mut problem.path));
            problems.append(&mut found);
        }
        problems
    }

    /// That the record cannot be scaled so.
    fn problem_of_scaling(&self) -> Option<Problem> {
        self.scene.ground.scaling.factor(self.record()?).err()
    }

    /// Everything that is wrong with the numbers, by themselves and with the record: in the words of the scene, under
    /// the names of the variables.
    ///
    /// # Errors
    /// All of that, at once.
    pub fn check(&self) -> Result<(), SceneError> {
        let mut problems = self.scene.check().err().map_or_else(Vec::new, |error| error.problems);
        let of_scaling = self.problem_of_scaling().filter(|of| !problems.iter().any(|known| known.path == of.path));
        problems.extend(of_scaling);
        problems.iter_mut().for_each(|problem| self.name_variable(&mut problem.path));
        if problems.is_empty() { Ok(()) } else { Err(SceneError { problems }) }
    }

    /// What looks like a slip in them, under the names of the variables.
    pub fn warnings(&self) -> Vec<Warning> {
        let mut scene = self.scene.clone();
        if let Some((path, _)) = &self.other_record {
            scene.ground.record = Some(path.clone());
        }
        let mut warnings = warnings::of(&scene, self.record());
        warnings.iter_mut().for_each(|warning| self.name_variable(&mut warning.path));
        warnings
    }

    /// The name of the variable that a path in the scene stands for: of a building of a row it begins with its name.
    fn name_variable(&self, path: &mut String) {
        let key_of = |building: &Building| Some((building.name.clone(), path.strip_prefix(&building.path)?.to_owned()));
        let in_building = self.scene.buildings.iter().filter_map(key_of).find(|(_, key)| key.starts_with('.'));
        if let Some((name, key)) = in_building {
            *path = name + &key;
        }
        rename_key(path);
    }

    /// What is done to a record that has been chosen instead of the scene's, where the scene says a peak.
    pub fn rescaled_record(&self) -> Option<String> {
        let (Scaling::Pga(pga), Some((path, record))) = (self.scene.ground.scaling, &self.other_record) else {
            return None;
        };
        let (factor, peak) = (Scaling::Pga(pga).factor(record).ok()?, record.peak());
        Some(format!(
            "ground.record = {path:?}: scaled by {factor:?} from its own peak of {peak:?} m/s2 to that of the scene, {pga:?} m/s2 \
             (ground.pga); ground.scale sets another factor"
        ))
    }

    /// Sets a parameter to a value of its row's type. [`Settings::check`] is for the caller: once, after everything that
    /// is set together.
    ///
    /// # Errors
    /// A record file that cannot be read, or not scaled to the peak of the scene.
    pub fn write(&mut self, parameter: Parameter, value: Value<'_>) -> Result<(), SceneError> {
        match (parameter, value) {
            (Parameter::GroundRecord, Value::String(path)) => return self.choose_record(path),
            (Parameter::GroundScale, Value::Real(factor)) => self.scene.ground.scaling = Scaling::Scale(factor),
            (_, Value::Real(number)) => {
                let place = number_mut(&mut self.scene, parameter);
                debug_assert!(place.is_some(), "{parameter:?} is no parameter of the scene");
                place.into_iter().for_each(|place| *place = number);
            }
            (_, Value::String(_) | Value::Integer(_) | Value::Boolean(_)) => {} // no parameter has these types
        }
        Ok(())
    }

    /// Another record file, or with an empty path again the packaged one.
    fn choose_record(&mut self, path: &str) -> Result<(), SceneError> {
        if path.is_empty() {
            self.other_record = None;
            return Ok(());
        }
        let (name, options) = record_source(path)?;
        let file = read_record_file(&name, Path::new(&name))?.with(&options);
        let record = self.known_records.read(file).map_err(|error| record_problems(&name, error))?;
        self.set_record(path, record)
    }

    /// Another record that has been read already; `name` is what `ground.record` reads as from here on.
    ///
    /// # Errors
    /// A record that cannot be scaled to the peak of the scene, at `ground.record`.
    pub fn set_record(&mut self, name: &str, record: Arc<Record>) -> Result<(), SceneError> {
        self.scene.ground.scaling.factor(&record).map_err(|problem| without_pga(problem.into(), name))?;
        self.other_record = Some((name.to_owned(), record));
        Ok(())
    }
}

/// What is wrong with a record that takes the place of the scene's: no variable says which peak it is scaled to.
fn without_pga(mut error: SceneError, record: &str) -> SceneError {
    for problem in error.problems.iter_mut().filter(|problem| problem.path == "ground.pga") {
        (problem.path, problem.found) = ("ground.record".to_owned(), format!("{record:?}"));
    }
    error
}

/// The parameters whose names are not their keys in the scene.
fn rename_key(path: &mut String) {
    for (key, name) in [
        (".damping.ratio", ".damping_ratio"),
        (".damping.dashpots[", ".dashpot["),
        (".left_position", ".position"),
        (".right_position", ".position"),
        (".foundation.sway.", ".foundation.sway_"),
        (".foundation.rocking.", ".foundation.rocking_"),
    ] {
        if path.contains(key) {
            *path = path.replacen(key, name, 1);
            return;
        }
    }
}
