//! What a run has shown, whoever has made it: an importer of an FMU, or the engine.

use crate::readings::Reading;
use pounding::engine::{Instant, Output};
use pounding::variables::{Causality, Settings, Table};
use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::time::Duration;

/// From when to when.
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
    /// Number of communication steps; the last one may be shorter.
    pub fn steps(&self) -> u64 {
        self.steps_to(self.stop)
    }

    /// The same of a run that ends at a time, s.
    fn steps_to(&self, end: f64) -> u64 {
        // A remainder of rounding is no step of its own.
        ((end - self.start) / self.step - 1e-6).ceil().max(1.0) as u64
    }

    /// s, a communication point.
    pub fn point(&self, index: u64) -> f64 {
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

impl Seen {
    /// Takes note of the value at a communication point.
    pub fn look(&mut self, value: f64) {
        *self = Seen { last: value, largest: self.largest.max(value.abs()) };
    }
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

/// What a run has shown.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Outcome {
    /// What the FMU has.
    pub variables: Variables,
    /// What was run.
    pub experiment: Experiment,
    /// Communication steps, with the one in which a storey has collapsed.
    pub steps: u64,
    /// Time spent in `fmi2DoStep`.
    pub solving: Duration,
    /// Every Real, Integer and Boolean (0 or 1) variable by its name; only outputs are followed through the run.
    pub seen: HashMap<String, Seen>,
    /// Warnings that the FMU has logged.
    pub warnings: Vec<String>,
}

/// Follows a run of the engine as one of its FMU is followed.
pub struct Follower {
    variables: Variables,
    experiment: Experiment,
    followed: Vec<(String, Reading, Seen)>,
    /// s, where it ends: earlier than planned where a storey collapses.
    end: f64,
}

impl Follower {
    /// Of a run from 0 to `stop`, s, whose rows are `step` apart.
    pub fn new(table: &Table, settings: &Settings, step: f64, stop: f64) -> Follower {
        let with = |causality| table.rows.iter().filter(|row| row.slot.causality() == causality).count();
        let (inputs, outputs) = (with(Causality::Input), with(Causality::Output));
        let followed = table.rows.iter().zip(0..).filter_map(|(row, reference)| {
            Some((row.name.clone(), Reading::new(table, settings, reference)?, Seen::default()))
        });
        Follower {
            variables: Variables { inputs, outputs, parameters: table.rows.len() - inputs - outputs },
            experiment: Experiment { start: 0.0, stop, step },
            followed: followed.collect(),
            end: stop,
        }
    }

    /// Takes note of a row. Rows between the communication points do not count, but for the one that a collapse makes the last.
    pub fn look(&mut self, now: &Instant<'_>) {
        let Experiment { stop, step, .. } = self.experiment;
        let time = now.time();
        let has_collapsed = now.model().buildings().any(|id| now.read(Output::Collapsed(id)) != 0.0);
        if has_collapsed {
            self.end = time;
        }
        if has_collapsed || time == stop || (time / step).round() * step == time {
            self.followed.iter_mut().for_each(|(_, reading, seen)| seen.look(reading.at(now)));
        }
    }

    /// What the run has shown, and how long it took.
    pub fn outcome(self, solving: Duration) -> Outcome {
        let Follower { variables, experiment, followed, end } = self;
        let seen = followed.into_iter().map(|(name, _, seen)| (name, seen)).collect();
        Outcome { variables, experiment, steps: experiment.steps_to(end), solving, seen, warnings: Vec::new() }
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
