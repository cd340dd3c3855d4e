//! The cases of a batch: their parameters, and what is wrong or odd with them before any of them runs.

use pounding::scene::SceneError;
use pounding::variables::{Parameter, Settings, Table, Value};
use pounding_simulate::readings::Reading;
use std::collections::BTreeMap;

/// Problems that a person reads.
const MOST_PROBLEMS: usize = 20;

/// How the cases differ.
pub struct Cases {
    pub count: usize,
    /// Of all of them.
    pub table: Table,
    /// Under each of the records.
    pub settings: Vec<Settings>,
    /// Which of these each case has; the first where nothing is said.
    pub which: Option<Vec<usize>>,
    /// A value for each case.
    pub parameters: Vec<(Parameter, Vec<f64>)>,
}

impl Cases {
    /// The parameters of a case, or everything that is wrong with them.
    pub fn settings(&self, case: usize) -> Result<Settings, SceneError> {
        let base = self.which.as_ref().map_or(0, |which| which[case]);
        let mut settings = self.settings[base].clone();
        for (parameter, values) in &self.parameters {
            settings.write(*parameter, Value::Real(values[case]))?;
        }
        settings.check()?;
        Ok(settings)
    }

    /// What is read of a case; texts are left out.
    pub fn readings(&self, settings: &Settings, references: &[u32]) -> Vec<Reading> {
        references.iter().filter_map(|&reference| Reading::new(&self.table, settings, reference)).collect()
    }
}

/// What has been found in cases that were looked at in any order.
#[derive(Default)]
pub struct Findings {
    /// Of the first cases, by case and place.
    problems: BTreeMap<(usize, usize), String>,
    /// All of them.
    count: usize,
    /// By their path: the first case with its warning, and how many cases have one there.
    warnings: BTreeMap<String, (usize, String, usize)>,
}

impl Findings {
    /// Notes what a look at a case has found.
    pub fn note(&mut self, case: usize, looked: &Result<Settings, SceneError>) {
        match looked {
            Ok(settings) => settings.warnings().into_iter().for_each(|warning| {
                let text = warning.to_string();
                let known = self.warnings.entry(warning.path).or_insert_with(|| (case, text.clone(), 0));
                known.2 += 1;
                if case < known.0 {
                    (known.0, known.1) = (case, text);
                }
            }),
            Err(error) => {
                for (place, problem) in error.problems.iter().enumerate() {
                    self.problems.insert((case, place), format!("case {case}: {problem}"));
                }
                self.count += error.problems.len();
                while self.problems.len() > MOST_PROBLEMS {
                    self.problems.pop_last();
                }
            }
        }
    }

    /// The warnings, each once, or the problems.
    pub fn finish(self, cases: usize) -> Result<Vec<String>, String> {
        let more = self.count - self.problems.len();
        if self.count == 0 {
            return Ok(self.warnings.into_values().map(|known| in_cases(known, cases)).collect());
        }
        let mut lines: Vec<String> = self.problems.into_values().collect();
        lines.extend((more > 0).then(|| format!("and {more} more")));
        Err(lines.join("\n"))
    }
}

/// A warning, with the cases that it is about unless it is about all of them.
fn in_cases((first, text, count): (usize, String, usize), cases: usize) -> String {
    match count {
        _ if count == cases => text,
        1 => format!("{text} (case {first})"),
        _ => format!("{text} (case {first} and {} more)", count - 1),
    }
}
