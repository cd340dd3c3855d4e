//! What a trial of an FMU has found, for a person and for a program.

use crate::bounded::Bounded;
use anyhow::bail;
use pounding_simulate::outcome::Outcome;
use pounding_simulate::summary;
use serde::{Serialize, Serializer};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

/// Of the JSON: it changes when something that scripts may rely on is taken away or means something else.
const VERSION: u32 = 1;

/// Checks in the order in which they were made, and what the run has shown where it came to that. The JSON of it is
/// described in `docs/check.schema.json`.
#[derive(Serialize)]
pub struct Report {
    version: u32,
    file: String,
    valid: bool,
    checks: Vec<Check>,
    #[serde(skip_serializing_if = "Option::is_none")]
    run: Option<Figures>,
    #[serde(skip)]
    outcome: Option<Outcome>,
}

#[derive(Serialize)]
struct Check {
    name: String,
    /// Empty where all is well.
    #[serde(serialize_with = "listed")]
    findings: Bounded,
}

fn listed<S: Serializer>(findings: &Bounded, serializer: S) -> Result<S::Ok, S::Error> {
    findings.listed().serialize(serializer)
}

/// What a run has shown, in figures.
#[derive(Serialize)]
struct Figures {
    /// s
    start: f64,
    /// s
    stop: f64,
    /// s
    step: f64,
    /// s, spent in `fmi2DoStep`
    solve_seconds: f64,
    /// Every number at the end of the run.
    values: BTreeMap<String, f64>,
    warnings: Vec<String>,
}

impl Figures {
    /// Of the default experiment.
    fn new(outcome: &Outcome) -> Figures {
        Figures {
            start: outcome.experiment.start,
            stop: outcome.experiment.stop,
            step: outcome.experiment.step,
            solve_seconds: outcome.solving.as_secs_f64(),
            values: outcome.seen.iter().map(|(name, seen)| (name.clone(), seen.last)).collect(),
            warnings: outcome.warnings.clone(),
        }
    }
}

impl Report {
    /// Of a file that nothing is known about yet.
    pub fn new(file: &Path) -> Report {
        let (version, file) = (VERSION, file.display().to_string());
        Report { version, file, valid: true, checks: Vec::new(), run: None, outcome: None }
    }

    /// Adds what a check has found; checks of the same name are one.
    pub fn add(&mut self, name: &str, findings: Bounded) {
        self.valid &= findings.is_empty();
        match self.checks.iter_mut().find(|check| check.name == name) {
            Some(check) => check.findings.append(findings),
            None => self.checks.push(Check { name: name.to_owned(), findings }),
        }
    }

    /// Notes the run.
    pub fn ran(&mut self, outcome: Outcome) {
        (self.run, self.outcome) = (Some(Figures::new(&outcome)), Some(outcome));
    }

    /// What the run has shown, or everything that has been found.
    pub fn outcome(&self) -> anyhow::Result<&Outcome> {
        let findings = self.checks.iter().flat_map(|check| check.findings.listed()).collect::<Vec<_>>();
        match &self.outcome {
            Some(outcome) if findings.is_empty() => Ok(outcome),
            _ => bail!("{}", findings.join("; ")),
        }
    }

    /// Whether all of these checks have been made and, where nothing was found, the FMU has run.
    pub fn is_complete(&self, checks: &[&str]) -> bool {
        let made = |name: &&str| self.checks.iter().any(|check| check.name == *name);
        !self.valid || (checks.iter().all(made) && self.outcome.is_some())
    }

    /// Whether nothing has been found.
    pub fn is_valid(&self) -> bool {
        self.valid
    }

    /// For a person.
    pub fn text(&self) -> String {
        let mut text = format!("{}\n", self.file);
        for Check { name, findings } in &self.checks {
            let _ = writeln!(text, "  {name:<20} {}", if findings.is_empty() { "ok" } else { "WRONG" });
            for finding in findings.listed() {
                let _ = writeln!(text, "    {finding}");
            }
        }
        if let Some(outcome) = &self.outcome {
            let _ = write!(text, "\n{}", summary::text(outcome, None, "default experiment of the FMU"));
        }
        let verdict = if self.valid { "nothing wrong found" } else { "this FMU is not in order" };
        let _ = writeln!(text, "\n{verdict}");
        text
    }

    /// For a program.
    pub fn json(&self) -> anyhow::Result<String> {
        Ok(serde_json::to_string_pretty(self)? + "\n")
    }
}
