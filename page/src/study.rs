//! The same scene with many gaps: how hard it hits, and how far the storeys drift.

use crate::job::Job;
use crate::message::{Answer, Refusal};
use crate::scene::Given;
use pounding::engine::Point;
use pounding::scene::Scene;
use pounding::variables::{Parameter, Slot};
use pounding_simulate::readings::Reading;
use pounding_simulate::scenario::Scenario;
use serde_json::json;

struct Study {
    scenario: Scenario,
    /// Of all contacts.
    parameters: Vec<Parameter>,
    references: Vec<u32>,
    stop: f64,
    gaps: std::vec::IntoIter<f64>,
}

/// A study of gaps, m, of all contacts at once; the answer has what is read of each run.
pub fn begin(given: &Given<'_>, gaps: Vec<f64>) -> Result<(impl Job + use<>, Answer), Refusal> {
    let mut package = given.package()?;
    // What is read are peaks, and no account of the energy slows them down.
    (package.scene.peaks, package.scene.energy) = (true, false);
    let scenario = Scenario::new(package);
    let is_gap = |name: &str| name.starts_with("contact[") && name.ends_with("].gap");
    let rows = scenario.table.rows.iter();
    let parameters: Vec<Parameter> = rows
        .filter_map(|row| match row.slot {
            Slot::Parameter(parameter) if is_gap(&row.name) => Some(parameter),
            _ => None,
        })
        .collect();
    if parameters.is_empty() {
        return Err(Refusal::value("the scene has no contact whose gap could be studied"));
    }
    let (references, names): (Vec<u32>, Vec<&str>) = (0_u32..)
        .zip(&scenario.table.rows)
        .filter(|(_, row)| is_read(&scenario.settings.scene, &row.name))
        .map(|(reference, row)| (reference, row.name.as_str()))
        .unzip();
    let stop = scenario.stop();
    let begun = json!({ "columns": names, "gaps": gaps.len(), "stop": stop });
    let answer = Answer::json(&begun, Vec::new())?;
    Ok((Study { scenario, parameters, references, stop, gaps: gaps.into_iter() }, answer))
}

/// What is read at the end of each run.
fn is_read(scene: &Scene, name: &str) -> bool {
    let Some((whole, part)) = name.split_once('.') else { return name == "impacts" };
    let is_building = scene.buildings.iter().any(|building| building.name == whole);
    let of_building = part.starts_with("peak_drift[") || part == "peak_base_shear";
    is_building && of_building || whole.starts_with("contact[") && part == "peak_force"
}

impl Job for Study {
    /// Gaps: the answer has each with what has been read, a row each; NaN where a run could not be brought to its end, and
    /// why.
    fn go_on(&mut self, pieces: usize) -> Result<Answer, Refusal> {
        let (mut numbers, mut failures) = (Vec::new(), Vec::new());
        for gap in self.gaps.by_ref().take(pieces) {
            numbers.push(gap);
            match end(&self.scenario, &self.parameters, &self.references, gap, self.stop) {
                Ok(values) => numbers.extend(values),
                Err(refusal) => {
                    numbers.extend(self.references.iter().map(|_| f64::NAN));
                    failures.push(format!("gap {gap} m: {}", refusal.problems.join("; ")));
                }
            }
        }
        Answer::json(&json!({ "done": self.gaps.len() == 0, "left": self.gaps.len(), "failures": failures }), numbers)
    }
}

/// What is read at the end of a run.
fn end(scenario: &Scenario, gaps: &[Parameter], references: &[u32], gap: f64, stop: f64) -> Result<Vec<f64>, Refusal> {
    let with_gap: Vec<(Parameter, f64)> = gaps.iter().map(|parameter| (*parameter, gap)).collect();
    let scenario = scenario.with_parameters(&with_gap)?;
    let model = scenario.model()?;
    let (mut state, mut point) = (model.start(0.0), Point::default());
    model.advance(&mut state, stop, &mut |_| {}).map_err(Refusal::run)?;
    let now = model.observe(&state, &mut point);
    let reading = |&reference: &u32| Reading::new(&scenario.table, &scenario.settings, reference);
    Ok(references.iter().filter_map(reading).map(|reading| reading.at(&now)).collect())
}
