//! What can be drawn of a scene before it is run.

use crate::message::{Answer, Refusal};
use crate::scene::{Given, findings};
use pounding::record::{Column, RecordOptions, STANDARD_GRAVITY};
use pounding::scene::{Building, ContactPair, Scaling, Scene, Stiffness};
use pounding::structure::Modes;
use pounding_simulate::STEP;
use pounding_simulate::layout::Layout;
use pounding_simulate::scenario::Scenario;
use serde_json::{Value, json};
use std::f64::consts::TAU;

/// Everything that the page says of a scene.
pub fn look(given: &Given<'_>) -> Result<Answer, Refusal> {
    let scenario = given.scenario()?;
    let scene = &scenario.settings.scene;
    let told = json!({
        "name": scene.name,
        "description": scene.description,
        "step": STEP,
        "stop": scenario.stop(),
        "stopTime": scene.stop_time,
        "layout": Layout::of(scene),
        "buildings": scene.buildings.iter().map(building).collect::<Vec<_>>(),
        "contacts": contacts(&scenario),
        "facing": scene.facing.map(|facing| json!({ "contacts": facing.contacts, "hasGaps": facing.has_gaps })),
        "energy": scene.energy,
        "peaks": scene.peaks,
        "ground": ground(scene, &scenario),
        "warnings": findings(given),
    });
    Answer::json(&told, Vec::new())
}

/// Masses, kg, stiffnesses, N/m, heights of storeys, m, and periods, s, of a building, and where it stands in the text.
fn building(building: &Building) -> Value {
    let stiffness = match &building.stiffness {
        Stiffness::Shear(each) => Some(each),
        _ => None,
    };
    let periods = Modes::of(building).ok().map(|modes| modes.omega.iter().map(|omega| TAU / omega).collect::<Vec<_>>());
    let storeys = 0..building.mass.len();
    let height =
        |storey: usize| building.heights.as_ref().map(|heights| heights.level(storey + 1) - heights.level(storey));
    json!({
        "name": building.name,
        "path": building.path,
        "floors": building.mass.len(),
        "mass": building.mass,
        "stiffness": stiffness,
        "heights": storeys.clone().map(height).collect::<Option<Vec<f64>>>(),
        "yields": storeys.map(|storey| building.yielding_storey(storey).is_some()).collect::<Vec<_>>(),
        "periods": periods,
    })
}

/// What the law of each contact has; its gap and what meets are in the layout.
fn contacts(scenario: &Scenario) -> Vec<Value> {
    let scene = &scenario.settings.scene;
    let of =
        |pair: &ContactPair| json!({ "brief": pair.brief(scene), "gap": pair.gap, "law": pair.law.kind.info().name });
    scene.contacts.iter().map(of).collect()
}

/// What the scene says about the file of its record, by the keys of the scene.
fn said(options: &RecordOptions) -> Value {
    let column = options.column.as_ref().map(|column| match column {
        Column::Number(number) => json!(number),
        Column::Name(name) => json!(name),
    });
    json!({
        "step": options.step,
        "unit": options.unit.map(|unit| unit.to_string()),
        "column": column,
        "skip_lines": options.skip_lines,
        "remove_mean": options.remove_mean.then_some(true),
    })
}

/// The record, its samples, its own peak and that with its factor; nothing where the ground is an input.
fn ground(scene: &Scene, scenario: &Scenario) -> Value {
    let Some(record) = scenario.settings.record() else { return Value::Null };
    let factor = scene.ground.scaling.factor(record).ok();
    let peak = factor.map(|factor| (factor * record.peak()).abs());
    let (scale, pga) = match scene.ground.scaling {
        Scaling::Scale(scale) => (Some(scale), None),
        Scaling::Pga(pga) => (None, Some(pga)),
    };
    let (first, last) = (record.times.first(), record.times.last());
    json!({
        "record": scene.ground.record,
        "said": said(&scene.ground.options),
        "samples": record.times.len(),
        "duration": first.zip(last).map(|(first, last)| last - first),
        "recordPeak": record.peak(),
        "scale": scale,
        "pga": pga,
        "factor": factor,
        "peak": peak,
        "peakInG": peak.map(|peak| peak / STANDARD_GRAVITY),
    })
}
