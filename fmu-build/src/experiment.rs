//! One run of an FMU over its default experiment.

use crate::description::{Causality, Description, Kind, Variable};
use anyhow::{Context, Result, bail};
use pounding_simulate::outcome::{Experiment, Outcome, Seen, Variables};
use std::collections::HashMap;
use std::time::{Duration, Instant};

/// An instance of a co-simulation FMU, whoever loads it. Errors say which function failed and what the FMU logged.
pub trait CoSimulation {
    /// Instantiated -> initialization mode.
    fn set_up(&self, start: f64, stop: f64) -> Result<()>;
    /// Initialization mode -> ready for the first step.
    fn begin(&self) -> Result<()>;
    /// From one communication point to the next; the time, s, at which the FMU has ended the run, where it has.
    fn do_step(&self, time: f64, step: f64) -> Result<Option<f64>>;
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

/// Reads `DefaultExperiment`; what it leaves out is 0 s to 10 s in steps of 0.01 s.
pub fn experiment(description: &Description) -> Result<Experiment> {
    let number = |text: Option<&String>, default: f64| {
        text.map_or(Ok(default), |text| text.parse().with_context(|| format!("DefaultExperiment: {text:?}")))
    };
    let given = &description.experiment;
    let start = number(given.start.as_ref(), 0.0)?;
    let stop = number(given.stop.as_ref(), start + 10.0)?;
    let step = number(given.step.as_ref(), 0.01)?;
    if !(start < stop && step > 0.0 && stop.is_finite() && step.is_finite()) {
        bail!("DefaultExperiment: cannot run from {start} s to {stop} s in steps of {step} s");
    }
    Ok(Experiment { start, stop, step })
}

/// How many variables a description has.
fn variables(description: &Description) -> Variables {
    let with = |causality| description.variables.iter().filter(|v| v.causality == causality).count();
    Variables {
        inputs: with(Causality::Input),
        outputs: with(Causality::Output),
        parameters: with(Causality::Parameter) + with(Causality::CalculatedParameter),
    }
}

/// Variables of one type, to be read in one call.
#[derive(Default)]
struct Group {
    names: Vec<String>,
    references: Vec<u32>,
}

/// Variables to read, by type.
#[derive(Default)]
pub struct Groups {
    reals: Group,
    integers: Group,
    booleans: Group,
}

impl Groups {
    /// Those of some variables; texts are not read.
    pub fn of<'a>(variables: impl Iterator<Item = &'a Variable>) -> Groups {
        let mut groups = Groups::default();
        for variable in variables {
            let group = match variable.kind {
                Kind::Real => &mut groups.reals,
                Kind::Integer => &mut groups.integers,
                Kind::Boolean => &mut groups.booleans,
                Kind::String | Kind::Other(_) => continue,
            };
            group.names.push(variable.name.clone());
            group.references.push(variable.reference);
        }
        groups
    }

    /// Reads every variable and hands over its name and value.
    pub fn read<'a>(&'a self, fmu: &dyn CoSimulation, mut each: impl FnMut(&'a str, f64)) -> Result<()> {
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

/// Runs a fresh instance over the default experiment, or as far as the FMU goes, reads every output at every communication
/// point and everything else at the end. An output that is not finite is an error, and so is an end out of the last step.
pub fn run(description: &Description, fmu: &dyn CoSimulation) -> Result<Outcome> {
    let experiment = experiment(description)?;
    fmu.set_up(experiment.start, experiment.stop)?;
    fmu.begin()?;

    let (outputs, others): (Vec<_>, Vec<_>) =
        description.variables.iter().partition(|variable| variable.causality == Causality::Output);
    let (outputs, others) = (Groups::of(outputs.into_iter()), Groups::of(others.into_iter()));
    let mut seen = HashMap::new();
    let (mut solving, mut steps, mut end) = (Duration::ZERO, 0, None);
    look(&outputs, fmu, experiment.start, &mut seen)?;
    while end.is_none() && steps < experiment.steps() {
        let (time, next) = (experiment.point(steps), experiment.point(steps + 1));
        let clock = Instant::now();
        end = fmu.do_step(time, next - time).with_context(|| format!("the step from {time} s to {next} s fails"))?;
        solving += clock.elapsed();
        steps += 1;
        if let Some(end) = end.filter(|end| !(time..=next).contains(end)) {
            bail!("the step from {time} s to {next} s ends the run, and the last successful time is {end} s");
        }
        look(&outputs, fmu, end.unwrap_or(next), &mut seen)?;
    }
    look(&others, fmu, end.unwrap_or(experiment.stop), &mut seen)?;

    // That a step is discarded is the end of the run, which its outputs tell, and no warning.
    let mut warnings = fmu.end()?;
    warnings.retain(|warning| end.is_none() || !warning.starts_with("logStatusDiscard"));
    let seen = seen.into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
    let variables = variables(description);
    Ok(Outcome { variables, experiment, steps, solving, seen, warnings })
}

fn look<'a>(groups: &'a Groups, fmu: &dyn CoSimulation, time: f64, seen: &mut HashMap<&'a str, Seen>) -> Result<()> {
    let mut strange = None;
    groups.read(fmu, |name, value| {
        let seen = seen.entry(name).or_default();
        seen.look(value);
        if !value.is_finite() {
            strange = Some((name, value));
        }
    })?;
    match strange {
        None => Ok(()),
        Some((name, value)) => bail!("{name} is {value} at {time} s"),
    }
}
