//! Files of a scene, byte for byte as the commands write them: the FMU, the tables, the report.

use crate::message::{Answer, Refusal};
use crate::run::{Wishes, has_room};
use crate::scene::Given;
use pounding::FmiVersion;
use pounding_pack::library::Library;
use pounding_pack::platform::Platform;
use pounding_simulate::scenario::Scenario;
use pounding_simulate::solve::{Solved, events, follow};
use pounding_simulate::{instants, report, tables};
use std::io;

const NO_LIBRARIES: &str = "an FMU without the library of any platform cannot be run; expected at least one";

/// The FMU with libraries: each with the name of its platform, such as linux64.
pub fn fmu(given: &Given<'_>, libraries: Vec<(&str, &[u8])>, fmi: &serde_json::Value) -> Result<Answer, Refusal> {
    let version = match fmi.as_f64() {
        Some(2.0) => FmiVersion::V2,
        Some(3.0) => FmiVersion::V3,
        _ => return Err(Refusal::value(format!("fmi = {fmi}: expected 2 or 3"))),
    };
    let package = given.package()?;
    if let Some((platform, _)) = libraries.iter().find(|(platform, _)| Platform::of(platform).is_none()) {
        return Err(Refusal::value(format!("platform {platform}: expected such as linux64")));
    }
    if libraries.is_empty() {
        return Err(Refusal::value(NO_LIBRARIES));
    }
    let library = |(platform, bytes): (&str, &[u8])| Library::new(platform.to_owned(), bytes.to_vec());
    let libraries: Vec<Library> = libraries.into_iter().map(library).collect();
    pounding_pack::pack(&package, &libraries, version).map(Answer::file).map_err(Refusal::run)
}

/// The table that `simulate --csv` writes.
pub fn motion_table(given: &Given<'_>, wishes: &Wishes) -> Result<Answer, Refusal> {
    let scenario = given.scenario()?;
    let (step, stop) = (wishes.step()?, wishes.stop(&scenario)?);
    let scene = &scenario.package.scene;
    has_room(stop / step, tables::outputs(scene).count() + 1)?;
    let model = scenario.model()?;
    let mut table = tables::Motion::new(Vec::new(), scene).map_err(Refusal::run)?;
    follow(&model, instants::regular(step, stop), Some(|now: Solved<'_>| table.write(now))).map_err(Refusal::run)?;
    table.finish().map(Answer::file).map_err(Refusal::run)
}

/// The table that `simulate --impacts` writes.
pub fn impacts_table(given: &Given<'_>, wishes: &Wishes) -> Result<Answer, Refusal> {
    let scenario = given.scenario()?;
    let stop = wishes.stop(&scenario)?;
    let happened = events(&scenario.model()?, stop).map_err(Refusal::run)?;
    let written: Result<Vec<u8>, io::Error> = tables::write_impacts(Vec::new(), &happened.episodes);
    written.map(Answer::file).map_err(Refusal::run)
}

/// The page that `simulate --html` writes.
pub fn report_page(given: &Given<'_>, wishes: &Wishes) -> Result<Answer, Refusal> {
    let scenario: Scenario = given.scenario()?;
    let stop = wishes.stop(&scenario)?;
    let model = scenario.model()?;
    let happened = events(&model, stop).map_err(Refusal::run)?;
    let page = report::page(&scenario.package, &model, stop, &happened).map_err(Refusal::run)?;
    Ok(Answer::file(page.into_bytes()))
}
