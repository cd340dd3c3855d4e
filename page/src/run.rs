//! A run, in slices of rows, with the columns and the bits of `pounding_fmu.simulate`.

use crate::close;
use crate::job::Job;
use crate::message::{Answer, Refusal, of_record};
use crate::scene::Given;
use pounding::engine::{Episode, Model};
use pounding::variables::{Causality, Parameter, Row, Slot, Type};
use pounding_simulate::readings::Reading;
use pounding_simulate::scenario::Scenario;
use pounding_simulate::solve::{Run, Solved, events};
use pounding_simulate::tables::impact;
use pounding_simulate::{STEP, instants};
use serde::{Deserialize, Serialize};
use serde_json::json;
use std::sync::Arc;

/// Bytes of all columns: what a browser has room for beside everything else.
const MOST_BYTES: f64 = 2e9;

/// What a run is asked to be; without a wish, as `pounding_fmu.simulate` has it.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Wishes {
    step: Option<Wished>,
    stop: Option<Wished>,
    outputs: Option<Vec<String>>,
    /// In their order.
    #[serde(default)]
    parameters: Vec<(String, Wished)>,
    rows_per_impact: Option<u16>,
    #[serde(default)]
    without_contacts: bool,
}

impl Wishes {
    /// s, from row to row.
    pub fn step(&self) -> Result<f64, Refusal> {
        self.step.as_ref().map_or(Ok(STEP), |wished| positive("step", wished))
    }

    /// s, time of the last row.
    pub fn stop(&self, scenario: &Scenario) -> Result<f64, Refusal> {
        self.stop.as_ref().map_or(Ok(scenario.stop()), |wished| positive("stop", wished))
    }
}

/// A value from JavaScript.
#[derive(Deserialize)]
#[serde(untagged)]
pub enum Wished {
    Number(f64),
    Text(String),
    /// One that JSON has no word for.
    Special {
        number: String,
    },
    Other(serde_json::Value),
}

/// A column of the answer.
#[derive(Serialize)]
struct Column<'a> {
    name: &'a str,
    about: &'a str,
    unit: &'static str,
    kind: &'static str,
}

struct Rows {
    model: Model,
    readings: Vec<Reading>,
    instants: Box<dyn Iterator<Item = f64> + Send>,
    run: Option<Run>,
    /// Of the contact episodes, how many have been told.
    told: usize,
}

/// A run from its first row; the answer has its columns and how many rows there are at most.
pub fn begin(given: &Given<'_>, wishes: Wishes) -> Result<(impl Job + use<>, Answer), Refusal> {
    let mut scenario = with_parameters(given, given.scenario()?, &wishes.parameters)?;
    if wishes.without_contacts {
        scenario = scenario.without_contacts();
    }
    let rows = chosen(&scenario, wishes.outputs.as_deref())?;
    let (step, stop) = (wishes.step()?, wishes.stop(&scenario)?);
    let readings: Vec<Reading> = rows
        .iter()
        .filter_map(|(reference, _)| Reading::new(&scenario.table, &scenario.settings, *reference))
        .collect();
    has_room(stop / step, readings.len() + 1)?;
    let model = scenario.model()?;
    let within = match wishes.rows_per_impact {
        None => Vec::new(),
        Some(count) => instants::within(&events(&model, stop).map_err(Refusal::run)?, stop, count),
    };
    let most = instants::regular(step, stop).count() + within.len();
    let columns: Vec<Column<'_>> = rows.iter().map(|(_, row)| column(row)).collect();
    let begun =
        json!({ "name": scenario.settings.scene.name, "columns": columns, "rows": most, "step": step, "stop": stop });
    let run = Some(Run::new(&model));
    let instants = Box::new(instants::merge(instants::regular(step, stop), within));
    Ok((Rows { model, readings, instants, run, told: 0 }, Answer::json(&begun, Vec::new())?))
}

impl Job for Rows {
    /// Rows: the answer has the times, then column by column, then ten numbers for each contact episode that has ended;
    /// after the last row all episodes.
    fn go_on(&mut self, pieces: usize) -> Result<Answer, Refusal> {
        let mut columns = vec![Vec::new(); self.readings.len() + 1];
        let mut run = self.run.take().ok_or_else(|| Refusal::value("the run is over"))?;
        let (mut is_done, mut rows) = (false, 0);
        while rows < pieces && !is_done {
            let Some(time) = self.instants.next() else {
                is_done = true;
                break;
            };
            let now = run.advance(&self.model, time).map_err(Refusal::run)?;
            keep(&mut columns, &self.readings, &now);
            rows += 1;
            is_done = run.so_far().collapse.is_some();
        }
        let time = columns[0].last().copied();
        let mut numbers = columns.concat();
        let episodes = match is_done {
            true => run.finish(&self.model).episodes,
            false => {
                let new = run.so_far().episodes[self.told..].to_vec();
                self.told += new.len();
                self.run = Some(run);
                new
            }
        };
        numbers.extend(episodes.iter().flat_map(of_impact));
        let told = json!({ "done": is_done, "rows": rows, "time": time, "impacts": episodes.len() });
        Answer::json(&told, numbers)
    }
}

fn keep(columns: &mut [Vec<f64>], readings: &[Reading], now: &Solved<'_>) {
    let values = std::iter::once(now.time()).chain(readings.iter().map(|reading| reading.at(now)));
    columns.iter_mut().zip(values).for_each(|(column, value)| column.push(value));
}

/// The row of the table of impacts; NaN where it has no end yet.
fn of_impact(episode: &Episode) -> impl Iterator<Item = f64> {
    let (contact, row) = impact(episode);
    std::iter::once(contact as f64).chain(row.map(|value| value.unwrap_or(f64::NAN)))
}

/// The variables that are columns, with their value references: the outputs, where none are named.
fn chosen<'s>(scenario: &'s Scenario, names: Option<&[String]>) -> Result<Vec<(u32, &'s Row)>, Refusal> {
    let all = (0_u32..).zip(&scenario.table.rows);
    let Some(names) = names else {
        return Ok(all.filter(|(_, row)| row.slot.causality() == Causality::Output).collect());
    };
    let mut rows: Vec<(u32, &Row)> = Vec::new();
    let (mut missing, mut texts) = (Vec::new(), Vec::new());
    for name in names.iter().filter(|name| *name != "time") {
        match all.clone().find(|(_, row)| row.name == *name) {
            None => missing.push(unknown(scenario, name)),
            Some((_, row)) if matches!(row.ty, Type::String) => {
                texts.push(format!("{name} is a text: expected names of numbers as outputs"));
            }
            Some((reference, _)) if rows.iter().any(|(known, _)| *known == reference) => {}
            Some(found) => rows.push(found),
        }
    }
    match (missing.is_empty(), texts.is_empty()) {
        (false, _) => Err(Refusal::key(missing.join("; "))),
        (true, false) => Err(Refusal { kind: "ValueError", problems: texts }),
        (true, true) => Ok(rows),
    }
}

fn unknown(scenario: &Scenario, name: &str) -> String {
    let meant = close::meant(name, scenario.table.rows.iter().map(|row| row.name.as_str()));
    let meant = meant.map_or(String::new(), |name| format!("; did you mean {name}?"));
    format!("{name}: the scene has no such variable{meant}")
}

/// The scenario with other parameters, in the order in which they are given.
fn with_parameters(given: &Given<'_>, scenario: Scenario, wished: &[(String, Wished)]) -> Result<Scenario, Refusal> {
    let mut scenario = scenario;
    let (mut numbers, mut missing, mut problems) = (Vec::new(), Vec::new(), Vec::new());
    for (name, value) in wished {
        let Some(row) = scenario.table.rows.iter().find(|row| row.name == *name) else {
            missing.push(unknown(&scenario, name));
            continue;
        };
        match (row.slot, value.number()) {
            (Slot::Parameter(Parameter::GroundRecord), _) => match with_record(given, &scenario, value) {
                Ok(other) => scenario = other.unwrap_or(scenario),
                Err(refusal) => problems.extend(refusal.problems),
            },
            (Slot::Parameter(parameter), Some(number)) => numbers.push((parameter, number)),
            (Slot::Parameter(_), None) => problems.push(format!("{name} = {}: expected a number", value.written())),
            (Slot::Input(_), _) => {
                problems.push(format!("{name} is an input, which is 0 here: expected names of parameters"));
            }
            _ => problems.push(format!("{name} is computed and cannot be set: expected names of parameters")),
        }
    }
    if !missing.is_empty() {
        return Err(Refusal::key(missing.join("; ")));
    }
    if !problems.is_empty() {
        return Err(Refusal { kind: "ValueError", problems });
    }
    if numbers.is_empty() { Ok(scenario) } else { Ok(scenario.with_parameters(&numbers)?) }
}

/// The scenario under another of the records that have been given; none where the name is empty.
fn with_record(given: &Given<'_>, scenario: &Scenario, value: &Wished) -> Result<Option<Scenario>, Refusal> {
    const KEY: &str = "ground.record";
    let Wished::Text(name) = value else {
        return Err(Refusal::value(format!("{KEY} = {}: expected the name of a record", value.written())));
    };
    if name.is_empty() {
        return Ok(None);
    }
    let refused = |problem: &str| format!("{KEY} = {name:?}: expected a record file, but {problem}");
    let file = given.record_file(name).ok_or_else(|| Refusal::value(refused("it has not been given")))?;
    let found = file.parse().map_err(|error| of_record(&error, refused))?;
    Ok(Some(scenario.with_record(name, &Arc::new(found.record))?))
}

impl Wished {
    fn number(&self) -> Option<f64> {
        match self {
            Wished::Number(number) => Some(*number),
            Wished::Special { number } => number.parse().ok(),
            Wished::Text(_) | Wished::Other(_) => None,
        }
    }

    /// As Python writes it.
    fn written(&self) -> String {
        match self {
            Wished::Number(number) => format!("{number:?}"),
            Wished::Text(text) => format!("'{text}'"),
            Wished::Special { number } => number.to_lowercase().replace("infinity", "inf"),
            Wished::Other(value) => value.to_string(),
        }
    }
}

fn positive(name: &str, wished: &Wished) -> Result<f64, Refusal> {
    let expected = || Refusal::value(format!("{name} = {}: expected a number of seconds > 0", wished.written()));
    wished.number().filter(|number| *number > 0.0 && number.is_finite()).ok_or_else(expected)
}

/// Whether there is memory for so many rows and columns.
pub fn has_room(rows: f64, columns: usize) -> Result<(), Refusal> {
    if rows * columns as f64 * 8.0 <= MOST_BYTES {
        return Ok(());
    }
    Err(Refusal::memory(format!("{rows:.1e} rows of {columns} columns: expected fewer, by a larger step")))
}

fn column(row: &Row) -> Column<'_> {
    let (unit, kind) = match row.ty {
        Type::Real(unit) => (unit.info().name, "real"),
        Type::Integer => ("", "integer"),
        Type::Boolean => ("", "boolean"),
        Type::String => ("", "text"),
    };
    Column { name: &row.name, about: &row.description, unit, kind }
}
