//! Values of variables; parameters, each read and written by one match over all of them.

use super::slot::{Calculated, Parameter};
use super::table::Type;
use super::unit::Unit;
use crate::FmiVersion;
use crate::engine::Side;
use crate::record::{KnownRecords, Record};
use crate::scene::{
    Building, Damping, Scaling, Scene, SceneError, Stiffness, Units, read_record_file, record_problems, record_source,
};
use crate::structure::period_ratio;
use crate::warnings::{self, Warning};
use std::path::Path;
use std::sync::Arc;

/// A value of a variable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value<'a> {
    /// `Real`, in the unit of the row.
    Real(f64),
    /// `Integer`
    Integer(i32),
    /// `Boolean`
    Boolean(bool),
    /// `String`
    String(&'a str),
}

impl<'a> Value<'a> {
    /// A number of the engine as a value of this type. FMI integers have 32 bits: a count beyond stays at their
    /// largest.
    #[inline(always)]
    pub const fn of(ty: Type, number: f64) -> Value<'a> {
        match ty {
            Type::Integer => Value::Integer(number as i32),
            Type::Boolean => Value::Boolean(number != 0.0),
            Type::Real(_) | Type::String => Value::Real(number), // no number is a text
        }
    }

    /// The number, if it is one.
    pub const fn real(self) -> Option<f64> {
        if let Value::Real(value) = self { Some(value) } else { None }
    }

    /// The integer, if it is one.
    pub const fn integer(self) -> Option<i32> {
        if let Value::Integer(value) = self { Some(value) } else { None }
    }

    /// The Boolean, if it is one.
    pub const fn boolean(self) -> Option<bool> {
        if let Value::Boolean(value) = self { Some(value) } else { None }
    }

    /// The string, if it is one.
    pub const fn string(self) -> Option<&'a str> {
        if let Value::String(value) = self { Some(value) } else { None }
    }

    /// Whether both are of one type and the same: numbers to the last bit.
    pub fn is_same(self, other: Value<'_>) -> bool {
        match (self, other) {
            (Value::Real(one), Value::Real(other)) => one.to_bits() == other.to_bits(),
            (one, other) => one == other,
        }
    }

    /// Name of its type.
    pub const fn type_name(self, version: FmiVersion) -> &'static str {
        let ty = match self {
            Value::Real(_) => Type::Real(Unit::One),
            Value::Integer(_) => Type::Integer,
            Value::Boolean(_) => Type::Boolean,
            Value::String(_) => Type::String,
        };
        ty.name(version)
    }
}

/// Keys of a scene that are no parameters: what is wrong at them is so by several parameters.
const OF_SEVERAL: [&str; 3] = [".p_delta", ".collapse_drift_ratio", ".foundation"];

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
        let scene = &self.scene;
        Value::Real(match parameter {
            Parameter::GroundRecord => {
                return Value::String(self.other_record.as_ref().map_or("", |(path, _)| path.as_str()));
            }
            Parameter::GroundScale => match scene.ground.scaling {
                Scaling::Scale(factor) => factor,
                scaling @ Scaling::Pga(_) => {
                    self.record().and_then(|record| scaling.factor(record).ok()).unwrap_or_default()
                }
            },
            Parameter::Mass(side, floor) => scene.building(side).mass[floor],
            Parameter::Stiffness(side, storey) => match &scene.building(side).stiffness {
                Stiffness::Shear(stiffness) => stiffness[storey],
                Stiffness::Matrix(_) => 0.0,
            },
            Parameter::DampingRatio(side) => match scene.building(side).damping {
                Damping::Ratio(ratio) => ratio,
                _ => 0.0,
            },
            Parameter::Dashpot(side, storey) => match &scene.building(side).damping {
                Damping::Dashpots(storeys) => storeys[storey],
                _ => 0.0,
            },
            Parameter::YieldForce(side, storey) => {
                scene.building(side).yielding.as_ref().map_or(0.0, |yielding| yielding.force[storey])
            }
            Parameter::PostYieldRatio(side, storey) => {
                scene.building(side).yielding.as_ref().map_or(0.0, |yielding| yielding.ratio[storey])
            }
            Parameter::Gap(p) => scene.contacts[p].gap,
            Parameter::Position(p) => scene.contacts[p].position().unwrap_or_default(),
            Parameter::ContactStiffness(p) => scene.contacts[p].law.stiffness,
            Parameter::Exponent(p) => scene.contacts[p].law.exponent,
            Parameter::Restitution(p) => scene.contacts[p].law.restitution,
            Parameter::Foundation(side, key) => {
                scene.building(side).foundation.as_ref().and_then(|of| of.get(key)).unwrap_or_default()
            }
            Parameter::LinkStiffness(l) => scene.links[l].stiffness,
            Parameter::LinkDashpot(l) => scene.links[l].dashpot,
            Parameter::SlipForce(l) => scene.links[l].slip.map_or(0.0, |slip| slip.force),
            Parameter::LinkPostYieldRatio(l) => scene.links[l].slip.map_or(0.0, |slip| slip.ratio),
            Parameter::RelativeTolerance => scene.solver.relative_tolerance,
        })
    }

    /// A calculated parameter that needs no model; 0 for frequencies. A storey that always resists has no critical drift: it is
    /// infinite.
    pub fn calculate(&self, calculated: Calculated) -> f64 {
        match calculated {
            Calculated::Frequency(..) | Calculated::SystemFrequency(_) => 0.0,
            Calculated::PeriodRatio(side) => period_ratio(self.scene.building(side)),
            Calculated::StabilityCoefficient(side, storey) => {
                let building = self.scene.building(side);
                let gravity = building.gravity_stiffness();
                let of = |stiffness: f64| gravity.get(storey).map_or(0.0, |g| g / stiffness);
                building.stiffness.of_storey(storey).map_or(0.0, of)
            }
            Calculated::CriticalDrift(side, storey) => {
                let net = self.scene.building(side).net_storey(storey);
                net.and_then(|net| net.critical_drift()).unwrap_or(f64::INFINITY)
            }
        }
    }

    /// What [`Settings::check`] finds, but for what only several parameters together can be wrong about, as a master may set them
    /// one after the other: gravity on a storey of little stiffness, and its collapse.
    ///
    /// # Errors
    /// All of that, at once.
    pub fn check_one_by_one(&self) -> Result<(), SceneError> {
        let Err(SceneError { mut problems }) = self.check() else { return Ok(()) };
        problems.retain(|problem| !OF_SEVERAL.iter().any(|key| problem.path.ends_with(key)));
        if problems.is_empty() { Ok(()) } else { Err(SceneError { problems }) }
    }

    /// Everything that is wrong with the numbers, by themselves and with the record: in the words of the scene, under
    /// the names of the variables.
    ///
    /// # Errors
    /// All of that, at once.
    pub fn check(&self) -> Result<(), SceneError> {
        let mut problems = self.scene.check().err().map_or_else(Vec::new, |error| error.problems);
        let factor = self.record().map(|record| self.scene.ground.scaling.factor(record));
        if let Some(Err(problem)) = factor
            && !problems.iter().any(|known| known.path == problem.path)
        {
            problems.push(problem);
        }
        problems.iter_mut().for_each(|problem| name_variable(&mut problem.path));
        if problems.is_empty() { Ok(()) } else { Err(SceneError { problems }) }
    }

    /// What looks like a slip in them, under the names of the variables.
    pub fn warnings(&self) -> Vec<Warning> {
        let mut scene = self.scene.clone();
        if let Some((path, _)) = &self.other_record {
            scene.ground.record = Some(path.clone());
        }
        let mut warnings = warnings::of(&scene, self.record());
        warnings.iter_mut().for_each(|warning| name_variable(&mut warning.path));
        warnings
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
        let number = match value {
            Value::Real(number) => number,
            Value::String(path) => return self.choose_record(path),
            Value::Integer(_) | Value::Boolean(_) => return Ok(()), // no parameter has these types
        };
        let scene = &mut self.scene;
        match parameter {
            Parameter::GroundRecord => {}
            Parameter::GroundScale => scene.ground.scaling = Scaling::Scale(number),
            Parameter::Mass(side, floor) => building_mut(scene, side).mass[floor] = number,
            Parameter::Stiffness(side, storey) => {
                if let Stiffness::Shear(stiffness) = &mut building_mut(scene, side).stiffness {
                    stiffness[storey] = number;
                }
            }
            Parameter::DampingRatio(side) => building_mut(scene, side).damping = Damping::Ratio(number),
            Parameter::Dashpot(side, storey) => {
                if let Damping::Dashpots(storeys) = &mut building_mut(scene, side).damping {
                    storeys[storey] = number;
                }
            }
            Parameter::YieldForce(side, storey) => {
                building_mut(scene, side).yielding.iter_mut().for_each(|yielding| yielding.force[storey] = number);
            }
            Parameter::PostYieldRatio(side, storey) => {
                building_mut(scene, side).yielding.iter_mut().for_each(|yielding| yielding.ratio[storey] = number);
            }
            Parameter::Gap(p) => scene.contacts[p].gap = number,
            Parameter::Position(p) => {
                if let Some(position) = scene.contacts[p].position_mut() {
                    *position = number;
                }
            }
            Parameter::ContactStiffness(p) => scene.contacts[p].law.stiffness = number,
            Parameter::Exponent(p) => scene.contacts[p].law.exponent = number,
            Parameter::Restitution(p) => scene.contacts[p].law.restitution = number,
            Parameter::Foundation(side, key) => {
                building_mut(scene, side).foundation.iter_mut().for_each(|of| of.set(key, number));
            }
            Parameter::LinkStiffness(l) => scene.links[l].stiffness = number,
            Parameter::LinkDashpot(l) => scene.links[l].dashpot = number,
            Parameter::SlipForce(l) => scene.links[l].slip.iter_mut().for_each(|slip| slip.force = number),
            Parameter::LinkPostYieldRatio(l) => scene.links[l].slip.iter_mut().for_each(|slip| slip.ratio = number),
            Parameter::RelativeTolerance => scene.solver.relative_tolerance = number,
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

/// The parameters whose names are not their paths in the scene.
fn name_variable(path: &mut String) {
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

fn building_mut(scene: &mut Scene, side: Side) -> &mut Building {
    match side {
        Side::Left => &mut scene.left,
        Side::Right => &mut scene.right,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_stay_at_the_largest_integer() {
        let largest = i32::MAX as u64;
        for (n, expected) in [(0, 0), (largest, i32::MAX), (largest + 1, i32::MAX), (u64::MAX, i32::MAX)] {
            assert_eq!(Value::of(Type::Integer, n as f64), Value::Integer(expected));
        }
    }
}
