//! What a person finds in an importing tool: the page `documentation/index.html` and the icon.

use crate::archive::Entry;
use pounding::FmiVersion;
use pounding::description::Package;
use pounding::scene::{Building, ContactPair, Scene};
use pounding::variables::{Causality, Row, Table, Type};
use std::collections::BTreeSet;
use std::fmt::Write;

/// Two buildings that touch.
const ICON: &[u8] = include_bytes!("../icon/model.png");

const STYLE: &str = "body{font:15px/1.45 sans-serif;max-width:60em;margin:2em auto;padding:0 1em;color:#222}\
    table{border-collapse:collapse}td,th{border:1px solid #ccc;padding:.2em .6em;text-align:left;vertical-align:top}\
    th{background:#f2f2f2}pre{background:#f6f6f6;padding:.8em;overflow-x:auto}";

const USE: &str = "<ul>\n\
    <li>SI units everywhere; <em>x</em> points from left to right, as the buildings stand. Displacements and velocities are \
    relative to the ground, accelerations absolute.</li>\n\
    <li>Floors are counted from 1 at the bottom; storey <em>i</em> is below floor <em>i</em>.</li>\n\
    <li>Any communication step will do: impacts are found and followed inside. EVENTS</li>\n\
    <li>An impact may be over between two communication points: read <code>impulse</code>, \
    <code>peak_force</code> and <code>impacts</code> instead of sampling <code>force</code>. The mean force over a step \
    is the difference of the impulse divided by the step.</li>\n\
    <li>Parameters can be set until the end of the initialisation.</li>\n</ul>\n";

/// The icon, and the page of this FMU.
pub fn entries(package: &Package, version: FmiVersion) -> [Entry; 2] {
    let page = page(package, version).into_bytes();
    [Entry::file("model.png", ICON.to_vec()), Entry::file("documentation/index.html", page)]
}

/// What becomes of inputs and events within a step.
fn events(version: FmiVersion) -> &'static str {
    match version {
        FmiVersion::V2 => {
            "Inputs are held from one communication point to the next, or follow the line whose slope is set as their \
             derivative."
        }
        FmiVersion::V3 => {
            "Inputs are held from one communication point to the next. With early return (FMI 3.0) a step ends at each \
             impact, release and yield, at its own time; in Event Mode the values on both sides are seen."
        }
    }
}

fn page(package: &Package, version: FmiVersion) -> String {
    let scene = &package.scene;
    let name = escape(&scene.name);
    let mut html = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{name}</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n<h1>{name}</h1>\n<p>{}</p>\n<p>{} under a ground motion, with \
         {} between facing floors.</p>\n<h2>Use</h2>\n{}",
        escape(&scene.description),
        buildings(scene),
        match scene.contacts.len() {
            1 => "1 contact".to_owned(),
            n => format!("{n} contacts"),
        },
        USE.replace("EVENTS", events(version)),
    );
    html += &laws(&scene.contacts);
    html += &variables(&Table::of_fmu(scene), version);
    let _ = write!(
        html,
        "<h2>Scene</h2>\n<pre>{}</pre>\n<p><a href=\"licenses/license.txt\">Licences</a></p>\n</body>\n</html>\n",
        escape(&package.scene_text)
    );
    html
}

/// How many buildings there are, and how tall.
fn buildings(scene: &Scene) -> String {
    let tall = |building: &Building| format!("{} of {}", escape(&building.name), storeys(building.mass.len()));
    match scene.buildings.as_slice() {
        [one] => format!("A building of {}", storeys(one.mass.len())),
        [left, right] => {
            format!("Two adjacent buildings of {} and {}", left.mass.len(), storeys(right.mass.len()))
        }
        row => {
            let all: Vec<String> = row.iter().map(tall).collect();
            format!("A row of {} buildings, {},", row.len(), all.join(", "))
        }
    }
}

fn storeys(count: usize) -> String {
    format!("{count} {}", if count == 1 { "storey" } else { "storeys" })
}

/// The laws of contact that the scene uses.
fn laws(contacts: &[ContactPair]) -> String {
    let used: BTreeSet<&str> = contacts.iter().map(|pair| pair.law.kind.info().name).collect();
    if used.is_empty() {
        return String::new();
    }
    let mut html = String::from(
        "<h2>Contact</h2>\n<p>Penetration d = left displacement - right displacement - gap, its rate v, V its rate at the \
         entry; m is the reduced mass of the two floors, e the coefficient of restitution.</p>\n<table>\n\
         <tr><th>law</th><th>force while d &gt; 0</th><th>symbols</th><th>known defect</th></tr>\n",
    );
    for name in used {
        let Some(info) = contacts.iter().map(|pair| pair.law.kind.info()).find(|info| info.name == name) else {
            continue;
        };
        html += &row([name, info.force, info.symbols, info.defect]);
    }
    html + "</table>\n"
}

fn variables(table: &Table, version: FmiVersion) -> String {
    let mut html =
        String::from("<h2>Variables</h2>\n<table>\n<tr><th>name</th><th>kind</th><th>unit</th><th>meaning</th></tr>\n");
    if version == FmiVersion::V3 {
        html += &row(["time", "independent", "s", "time"]);
    }
    for variable in &table.rows {
        html += &row([&variable.name, kind(variable), unit(variable, version), &variable.description]);
    }
    html + "</table>\n"
}

fn row(cells: [&str; 4]) -> String {
    format!("<tr>{}</tr>\n", cells.map(|cell| format!("<td>{}</td>", escape(cell))).concat())
}

fn kind(variable: &Row) -> &'static str {
    match variable.slot.causality() {
        Causality::Input => "input",
        Causality::Output => "output",
        Causality::Parameter => "parameter",
        Causality::CalculatedParameter => "calculated parameter",
    }
}

fn unit(variable: &Row, version: FmiVersion) -> &'static str {
    match variable.ty {
        Type::Real(unit) => unit.info().name,
        Type::Integer | Type::Boolean | Type::String => variable.ty.name(version),
    }
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
