//! One run of an FMU over its default experiment.

use anyhow::{Context, Result, bail};
use fmi::model_description::fmi2::{Causality, ModelDescription, ScalarVariable, VariableType};
use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::time::{Duration, Instant};

/// An instance of a co-simulation FMU, whoever loads it. Errors say which function failed and what the FMU logged.
pub trait CoSimulation {
    /// Instantiated -> initialization mode.
    fn set_up(&self, start: f64, stop: f64) -> Result<()>;
    /// Initialization mode -> ready for the first step.
    fn begin(&self) -> Result<()>;
    /// From one communication point to the next.
    fn do_step(&self, time: f64, step: f64) -> Result<()>;
    /// Values of Real variables.
    fn reals(&self, references: &[u32]) -> Result<Vec<f64>>;
    /// Values of Integer variables.
    fn integers(&self, references: &[u32]) -> Result<Vec<i32>>;
    /// Values of Boolean variables.
    fn booleans(&self, references: &[u32]) -> Result<Vec<bool>>;
    /// Values of String variables.
    fn strings(&self, references: &[u32]) -> Result<Vec<String>>;
    /// Terminates; returns the warnings that the FMU has logged.
    fn end(&self) -> Result<Vec<String>>;
}

/// What a description proposes to run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Experiment {
    /// s
    pub start: f64,
    /// s
    pub stop: f64,
    /// s, from one communication point to the next.
    pub step: f64,
}

impl Experiment {
    /// Reads `DefaultExperiment`; what it leaves out is 0 s to 10 s in steps of 0.01 s.
    pub fn of(description: &ModelDescription) -> Result<Experiment> {
        let number = |text: Option<&String>, default: f64| {
            text.map_or(Ok(default), |text| text.parse().with_context(|| format!("DefaultExperiment: {text:?}")))
        };
        let given = description.defaultExperiment.as_ref();
        let start = number(given.and_then(|e| e.startTime.as_ref()), 0.0)?;
        let stop = number(given.and_then(|e| e.stopTime.as_ref()), start + 10.0)?;
        let step = number(given.and_then(|e| e.stepSize.as_ref()), 0.01)?;
        if !(start < stop && step > 0.0 && stop.is_finite() && step.is_finite()) {
            bail!("DefaultExperiment: cannot run from {start} s to {stop} s in steps of {step} s");
        }
        Ok(Experiment { start, stop, step })
    }

    /// Number of communication steps; the last one may be shorter.
    fn steps(&self) -> u64 {
        // A remainder of rounding is no step of its own.
        ((self.stop - self.start) / self.step - 1e-6).ceil().max(1.0) as u64
    }

    fn point(&self, index: u64) -> f64 {
        if index >= self.steps() { self.stop } else { self.start + index as f64 * self.step }
    }
}

/// What a run has shown of one variable.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct Seen {
    /// At the end.
    pub last: f64,
    /// Largest magnitude at the communication points.
    pub largest: f64,
}

/// How many variables an FMU has; every one is one of these.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Variables {
    /// Set at any time.
    pub inputs: usize,
    /// Results.
    pub outputs: usize,
    /// All others, calculated ones included.
    pub parameters: usize,
}

impl Variables {
    fn of(description: &ModelDescription) -> Variables {
        let with = |causality| description.modelVariables.iter().filter(|v| v.causality == causality).count();
        let (inputs, outputs) = (with(Causality::Input), with(Causality::Output));
        Variables { inputs, outputs, parameters: description.modelVariables.len() - inputs - outputs }
    }
}

/// What a run has shown.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Outcome {
    /// What the FMU has.
    pub variables: Variables,
    /// What was run.
    pub experiment: Experiment,
    /// Communication steps.
    pub steps: u64,
    /// Time spent in `fmi2DoStep`.
    pub solving: Duration,
    /// Every Real, Integer and Boolean (0 or 1) variable by its name; only outputs are followed through the run.
    pub seen: HashMap<String, Seen>,
    /// Warnings that the FMU has logged.
    pub warnings: Vec<String>,
}

/// Variables of one type, to be read in one call.
#[derive(Default)]
struct Group {
    names: Vec<String>,
    references: Vec<u32>,
}

/// Variables to read, by type.
#[derive(Default)]
struct Groups {
    reals: Group,
    integers: Group,
    booleans: Group,
}

impl Groups {
    fn of<'a>(variables: impl Iterator<Item = &'a ScalarVariable>) -> Groups {
        let mut groups = Groups::default();
        for variable in variables {
            let group = match variable.variableType {
                VariableType::Real { .. } => &mut groups.reals,
                VariableType::Integer { .. } | VariableType::Enumeration { .. } => &mut groups.integers,
                VariableType::Boolean { .. } => &mut groups.booleans,
                VariableType::String { .. } => continue,
            };
            group.names.push(variable.name.clone());
            group.references.push(variable.valueReference);
        }
        groups
    }

    /// Reads every variable and hands over its name and value.
    fn read<'a>(&'a self, fmu: &dyn CoSimulation, mut each: impl FnMut(&'a str, f64)) -> Result<()> {
        let reals = fmu.reals(&self.reals.references)?;
        let integers = fmu.integers(&self.integers.references)?.into_iter().map(f64::from).collect();
        let booleans = fmu.booleans(&self.booleans.references)?.into_iter().map(|b| f64::from(u8::from(b))).collect();
        for (group, values) in [(&self.reals, reals), (&self.integers, integers), (&self.booleans, booleans)] {
            for (name, value) in group.names.iter().zip::<Vec<f64>>(values) {
                each(name, value);
            }
        }
        Ok(())
    }
}

/// Runs a fresh instance over the default experiment, reads every output at every communication point and everything
/// else at the end. An output that is not finite is an error.
pub fn run(description: &ModelDescription, fmu: &dyn CoSimulation) -> Result<Outcome> {
    let experiment = Experiment::of(description)?;
    fmu.set_up(experiment.start, experiment.stop)?;
    fmu.begin()?;

    let (outputs, others): (Vec<_>, Vec<_>) =
        description.modelVariables.iter().partition(|variable| variable.causality == Causality::Output);
    let (outputs, others) = (Groups::of(outputs.into_iter()), Groups::of(others.into_iter()));
    let mut seen = HashMap::new();
    let mut solving = Duration::ZERO;
    look(&outputs, fmu, experiment.start, &mut seen)?;
    for index in 0..experiment.steps() {
        let (time, next) = (experiment.point(index), experiment.point(index + 1));
        let clock = Instant::now();
        fmu.do_step(time, next - time).with_context(|| format!("the step from {time} s to {next} s fails"))?;
        solving += clock.elapsed();
        look(&outputs, fmu, next, &mut seen)?;
    }
    look(&others, fmu, experiment.stop, &mut seen)?;

    let seen = seen.into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
    let variables = Variables::of(description);
    Ok(Outcome { variables, experiment, steps: experiment.steps(), solving, seen, warnings: fmu.end()? })
}

fn look<'a>(groups: &'a Groups, fmu: &dyn CoSimulation, time: f64, seen: &mut HashMap<&'a str, Seen>) -> Result<()> {
    let mut strange = None;
    groups.read(fmu, |name, value| {
        let seen = seen.entry(name).or_default();
        *seen = Seen { last: value, largest: seen.largest.max(value.abs()) };
        if !value.is_finite() {
            strange = Some((name, value));
        }
    })?;
    match strange {
        None => Ok(()),
        Some((name, value)) => bail!("{name} is {value} at {time} s"),
    }
}

#[cfg(test)]
mod tests {
    use super::Experiment;

    #[test]
    fn steps_end_at_the_stop_time_and_rounding_adds_none() {
        for (start, stop, step, steps) in [
            (0.0, 20.0, 0.01, 2000),
            (0.0, 20.0, 0.037, 541),
            (0.0, 0.3, 0.1, 3),
            (0.0, 0.005, 0.01, 1),
            (5.0, 6.0, 0.1, 10),
        ] {
            let experiment = Experiment { start, stop, step };
            assert_eq!(experiment.steps(), steps);
            assert_eq!(experiment.point(0), start);
            assert_eq!(experiment.point(steps), stop);
            assert!(experiment.point(steps - 1) < stop);
        }
    }
}
