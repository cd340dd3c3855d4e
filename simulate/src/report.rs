//! The report of a run: one HTML file with everything in it, drawn by uPlot in the browser that opens it.
//!
//! All that the page shows travels as JSON in a script element of a type that browsers do not run. There `<` is written
//! as an escape, so no text of a scene can end that element, and the page sets texts as texts, never as markup. Its
//! Content-Security-Policy forbids it to load anything.

use crate::instants;
use crate::layout::Layout;
use crate::solve::{Events, Solved, follow};
use crate::tables::{impact, outputs};
use crate::thinning::Column;
use pounding::description::Package;
use pounding::engine::{Collapse, Episode, Model};
use pounding::scene::Scene;
use pounding::variables::Type;
use serde::Serialize;
use std::error::Error;
use std::fs::File;
use std::path::Path;

/// Rows from beginning to end, as many as a wide screen has columns, and within each impact, for a look at it alone.
const REGULAR_ROWS: f64 = 2000.0;
const ROWS_PER_IMPACT: u16 = 24;
/// Numbers in the page, at about 9 bytes each: where there would be more, columns are thinned.
const MOST_NUMBERS: usize = 400_000;
/// Digits of those numbers: a screen shows three or four.
const DIGITS: usize = 6;

const PAGE: &str = include_str!("report.html");
/// What the page is put together from: marks in it, and what takes their place.
const PARTS: [(&str, &str); 6] = [
    ("/*uPlot.css*/", include_str!("uplot/uPlot.min.css")),
    ("/*report.css*/", include_str!("report.css")),
    ("@licence of uPlot@", include_str!("uplot/LICENSE")),
    ("/*uPlot.js*/", include_str!("uplot/uPlot.iife.min.js")),
    ("/*report.js*/", include_str!("report.js")),
    ("/*report_loops.js*/", include_str!("report_loops.js")),
];
/// Buildings of which charts show floors and storeys.
const MOST_CHARTED: usize = 2;
const DATA: &str = "/*data*/";
/// The modules with which the browser page draws the buildings, each after those that it imports; and their mark.
const DRAWING: [&str; 4] = [
    include_str!("../../page/web/motion.js"),
    include_str!("../../page/web/geometry.js"),
    include_str!("../../page/web/devices.js"),
    include_str!("../../page/web/drawing.js"),
];
const DRAWN: &str = "/*drawing*/";

/// The data of the page, under the names that report.js reads.
#[derive(Serialize)]
struct Run<'a> {
    #[serde(flatten)]
    layout: Layout<'a>,
    /// Names of the buildings that charts begin with; without, the page chooses.
    charted: Option<Vec<&'a str>>,
    description: &'a str,
    scene: &'a str,
    /// s, the time of the last row.
    stop: f64,
    /// What has ended the run before its time.
    collapse: Option<String>,
    /// s, of all rows.
    times: Vec<f64>,
    columns: Vec<Series>,
    /// One row per contact episode, in the order of `--impacts`; where it has not ended, `null`.
    impacts: Vec<Vec<Option<f64>>>,
}

/// An output of the FMU.
#[derive(Serialize)]
struct Series {
    name: String,
    about: String,
    unit: &'static str,
    /// Another unit for people, and how much of it one of `unit` is.
    display: Option<(&'static str, f64)>,
    /// Numbers of the rows that are kept, each as the difference from the one before; all of them where there are none.
    steps: Option<Vec<usize>>,
    values: Vec<f64>,
}

/// The file, before the work that it is for.
///
/// # Errors
/// A file that cannot be written.
pub fn create(file: &Path) -> Result<File, Box<dyn Error>> {
    File::create(file).map_err(|error| format!("cannot write {}: {error}", file.display()).into())
}

/// The page.
///
/// # Errors
/// What keeps the run from its end.
pub fn page(package: &Package, model: &Model, stop: f64, events: &Events) -> Result<String, Box<dyn Error>> {
    page_about(package, model, stop, events, None)
}

/// The page whose charts begin with these buildings.
///
/// # Errors
/// What keeps the run from its end.
pub fn page_about(
    package: &Package,
    model: &Model,
    stop: f64,
    events: &Events,
    charted: Option<Vec<&str>>,
) -> Result<String, Box<dyn Error>> {
    let Package { scene, scene_text, .. } = package;
    let (times, columns) = columns(scene, model, stop, events)?;
    let run = Run {
        layout: Layout::of(scene),
        charted,
        description: &scene.description,
        scene: scene_text,
        stop: times.last().copied().unwrap_or(stop),
        collapse: events.collapse.map(|Collapse { building: id, storey, .. }| {
            format!("storey {} of {} collapsed, and the run ends there", storey + 1, scene.building(id).called())
        }),
        times,
        columns,
        impacts: events.episodes.iter().map(row).collect(),
    };
    let data = serde_json::to_string(&run)?.replace('<', "\\u003c");
    let page = PARTS.iter().fold(PAGE.to_owned(), |page, (mark, part)| page.replacen(mark, part, 1));
    Ok(page.replacen(DRAWN, &script(&DRAWING), 1).replacen(DATA, &data, 1))
}

/// The buildings that are asked for, in the order of the scene.
///
/// # Errors
/// A name that the scene does not have, and which it has; more names than charts have room for.
pub fn charted<'a>(scene: &'a Scene, wanted: &[String]) -> Result<Option<Vec<&'a str>>, String> {
    let names: Vec<&str> = scene.buildings.iter().map(|building| &*building.name).collect();
    let among = format!("expected one or two of {}", names.join(", "));
    if let Some(name) = wanted.iter().find(|name| !names.contains(&name.as_str())) {
        return Err(format!("--buildings {name}: the scene has no such building; {among}"));
    }
    if wanted.len() > MOST_CHARTED {
        return Err(format!("--buildings {}: {among}", wanted.join(" ")));
    }
    let chosen: Vec<&str> = names.into_iter().filter(|name| wanted.iter().any(|wanted| wanted == name)).collect();
    Ok(Some(chosen).filter(|chosen| !chosen.is_empty()))
}

/// Modules as one script: without their imports and exports.
fn script(modules: &[&str]) -> String {
    let lines = modules.iter().flat_map(|module| module.lines()).filter(|line| !line.starts_with("import "));
    lines.map(|line| line.strip_prefix("export ").unwrap_or(line)).collect::<Vec<_>>().join("\n")
}

/// The times of all rows, and of each output what is kept of it.
fn columns(
    scene: &Scene,
    model: &Model,
    stop: f64,
    events: &Events,
) -> Result<(Vec<f64>, Vec<Series>), Box<dyn Error>> {
    let within = instants::within(events, stop, ROWS_PER_IMPACT);
    let instants: Vec<f64> = instants::merge(instants::regular(stop / REGULAR_ROWS, stop), within).collect();
    let outputs: Vec<_> = outputs(scene).collect();
    let all = instants.len() * outputs.len();
    let bin = if all <= MOST_NUMBERS { 1 } else { 2 * all.div_ceil(MOST_NUMBERS) };

    let mut columns: Vec<Column> = outputs.iter().map(|_| Column::new(bin)).collect();
    let mut times = Vec::with_capacity(instants.len());
    let show = |solved: Solved| {
        times.push(solved.time());
        for ((_, output), column) in outputs.iter().zip(&mut columns) {
            column.push(solved.read(*output));
        }
        Ok::<(), Box<dyn Error>>(())
    };
    follow(model, instants.into_iter(), Some(show))?;
    let series = outputs.into_iter().zip(columns).map(|((row, _), column)| {
        let info = match row.ty {
            Type::Real(unit) => Some(unit.info()),
            _ => None,
        };
        let kept = column.finish();
        let last_rows = std::iter::once(0).chain(kept.iter().map(|(row, _)| *row));
        Series {
            name: row.name,
            about: row.description,
            unit: info.as_ref().map_or("", |info| info.name),
            display: info.and_then(|info| info.display),
            steps: (bin > 1).then(|| kept.iter().zip(last_rows).map(|((row, _), last)| row - last).collect()),
            values: kept.iter().map(|(_, value)| rounded(*value)).collect(),
        }
    });
    let series = series.collect();
    Ok((times, series))
}

/// The number with so few digits that it is short as text.
fn rounded(value: f64) -> f64 {
    format!("{value:.*e}", DIGITS - 1).parse().unwrap_or(value)
}

fn row(episode: &Episode) -> Vec<Option<f64>> {
    let (contact, row) = impact(episode);
    std::iter::once(Some(contact as f64)).chain(row).collect()
}
