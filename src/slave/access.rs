//! Getting and setting values by value reference.

use super::instance::Slave;
use super::run::Run;
use super::sequence::Phase;
use super::status::Refusal;
use crate::FmiVersion;
use crate::description::Category;
use crate::engine::Input;
use crate::variables::{Calculated, Row, Settings, Slot, Type, Unit, Value};
use crate::warnings;
use std::mem::MaybeUninit;
use std::sync::Arc;

impl Slave {
    /// Reads outputs that are numbers, up to the first variable that is anything else, and returns how many: most of
    /// what masters read after each step. [`Slave::get`] reads the others.
    pub fn read_outputs(&mut self, references: &[u32], values: &mut [MaybeUninit<f64>]) -> usize {
        let (Run::Started(simulation), None) = (&mut self.run, &self.held) else { return 0 };
        let now = simulation.now();
        let mut count = 0;
        for (&reference, value) in references.iter().zip(values) {
            let Some(&Row { slot: Slot::Output(output), ty: Type::Real(_), .. }) = self.table.row(reference) else {
                break;
            };
            value.write(now.read(output));
            count += 1;
        }
        count
    }

    /// Reads each variable in turn and hands over its place and value; `take` is `None` where it is not of `wanted` type.
    ///
    /// # Errors
    /// References that there are not, variables that `take` refuses, and settings of which no model can be made.
    pub fn get(
        &mut self,
        references: &[u32],
        wanted: &str,
        mut take: impl FnMut(usize, Value<'_>) -> Option<()>,
    ) -> Result<(), Refusal> {
        let mut problems = Vec::new();
        for (i, &reference) in references.iter().enumerate() {
            let value = match self.table.row(reference).map(|row| (row.slot, row.ty)) {
                Some((slot, ty)) => self.read(reference, slot, ty)?,
                None if self.is_time(reference) => Value::Real(self.run.time()),
                None => {
                    problems.push(self.unknown(reference));
                    continue;
                }
            };
            if take(i, value).is_none() {
                problems.push(self.wrong_type(reference, wanted));
            }
        }
        Refusal::unless_empty(problems)
    }

    /// The value of a variable.
    #[inline(always)]
    fn read(&mut self, reference: u32, slot: Slot, ty: Type) -> Result<Value<'_>, Refusal> {
        Ok(match slot {
            Slot::Output(output) => match self.held.as_ref().and_then(|held| held.get(reference)) {
                Some(held) => Value::of(ty, held),
                None => Value::of(ty, self.start()?.now().read(output)),
            },
            Slot::Input(input) => Value::Real(self.run.inputs().get(input).at(self.run.time())),
            Slot::Parameter(parameter) => self.settings.read(parameter),
            Slot::Calculated(Calculated::Frequency(id, mode)) => {
                Value::Real(self.start()?.model().natural_frequencies(id)[mode])
            }
            Slot::Calculated(Calculated::SystemFrequency(mode)) => {
                Value::Real(self.start()?.model().system_frequencies()[mode])
            }
            Slot::Calculated(calculated) => Value::Real(self.settings.calculate(calculated)),
        })
    }

    /// Whether a value reference is that of the time.
    pub(super) fn is_time(&self, reference: u32) -> bool {
        self.interface.version() == FmiVersion::V3 && reference == self.table.time_reference()
    }

    /// Sets each variable to the value of its place: all of them, or none where anything is wrong. Nothing happens to a
    /// parameter that is set to the value that it has when parameters are fixed: there are importers that set all of them again.
    ///
    /// # Errors
    /// References that there are not, values of another type or out of their range, variables that cannot be set now,
    /// and parameters that the scene's rules refuse.
    pub fn set<'v>(&mut self, references: &[u32], value: impl Fn(usize) -> Value<'v>) -> Result<(), Refusal> {
        let pairs = || references.iter().enumerate().map(|(i, &reference)| (reference, value(i)));
        let (mut problems, mut parameters) = (Vec::new(), Vec::new());
        for (reference, value) in pairs() {
            match (self.refuse(reference, value), self.table.row(reference)) {
                (Some(problem), _) => problems.push(problem),
                (None, Some(row @ Row { slot: Slot::Parameter(_), .. })) if self.takes_parameters() => {
                    parameters.push((row, value));
                }
                (None, _) => {}
            }
        }
        if !parameters.is_empty() {
            // Where other things are wrong, it is only asked what is wrong with these as well.
            let asked = match problems.is_empty() {
                true => Arc::make_mut(&mut self.settings).set(&parameters),
                false => Settings::clone(&self.settings).set(&parameters),
            };
            problems.extend(asked.err().into_iter().flat_map(|error| Refusal::from(error).problems));
        }
        Refusal::unless_empty(problems)?;
        if !parameters.is_empty() {
            self.run.stop();
        }
        for (reference, value) in pairs() {
            if let (Some(Slot::Input(input)), Value::Real(value)) = (self.table.row(reference).map(|r| r.slot), value) {
                match self.ends_of_inputs() {
                    Some(ends) => ends.push((input, value)),
                    None => {
                        self.handle_event()?;
                        self.run.set_input(input, value);
                    }
                }
                self.look_at_input(input, value);
            }
        }
        Ok(())
    }

    /// Whether parameters can still be changed.
    const fn takes_parameters(&self) -> bool {
        matches!(self.phase, Phase::Instantiated | Phase::Initialization)
    }

    /// Warns once in a run of a ground that shakes like no other.
    #[inline]
    fn look_at_input(&mut self, input: Input, value: f64) {
        if input == Input::GroundAcceleration
            && !self.has_warned_of_ground
            && let Some(warning) = warnings::of_ground_input(value)
        {
            self.log.add(Category::StatusWarning, warning.to_string());
            self.has_warned_of_ground = true;
        }
    }

    /// What is wrong with setting a variable now, but for the numbers of parameters, which the scene's rules judge.
    fn refuse(&self, reference: u32, value: Value<'_>) -> Option<String> {
        let Some(row) = self.table.row(reference) else {
            let of_time = || "time: computed by the FMU, it cannot be set".to_owned();
            return Some(if self.is_time(reference) { of_time() } else { self.unknown(reference) });
        };
        let (version, found) = (self.interface.version(), value.type_name(self.interface.version()));
        if row.ty.name(version) != found {
            return Some(self.wrong_type(reference, found));
        }
        let problem = match (row.slot, self.phase) {
            (Slot::Input(_), _) if !self.takes_inputs() => "the step asks for no inputs now",
            (Slot::Input(_), _) => return row.problem(value.real()?),
            (Slot::Parameter(_), _) if self.takes_parameters() => return None,
            (Slot::Parameter(parameter), _) if self.settings.read(parameter).is_same(value) => return None,
            (Slot::Parameter(_), _) => "a fixed parameter can only be set before the end of initialisation",
            (Slot::Calculated(_) | Slot::Output(_), _) => "computed by the FMU, it cannot be set",
        };
        Some(format!("{}: {problem}", row.name))
    }

    /// That there is no such variable.
    pub(super) fn unknown(&self, reference: u32) -> String {
        let count = self.table.time_reference() + u32::from(self.interface.version() == FmiVersion::V3);
        format!("value reference {reference}: expected one below {count}")
    }

    /// That a variable is of another type.
    pub(super) fn wrong_type(&self, reference: u32, wanted: &str) -> String {
        let version = self.interface.version();
        let row = self.table.row(reference).map(|row| (row.name.as_str(), row.ty));
        let (name, ty) = row.unwrap_or(("time", Type::Real(Unit::Second)));
        format!("{name} (value reference {reference}) is {}, not {wanted}", ty.name(version))
    }
}
