//! From a scene file to an FMU that has been seen to run, step by step.

use crate::archive::{self, Entry, Unpacked};
use crate::c_interface::{Binary, Instance};
use crate::channel::Channel;
use crate::destination::Destination;
use crate::experiment::{self, Outcome};
use crate::progress::Progress;
use crate::provenance::Provenance;
use crate::trial::Trial;
use crate::workspace::Workspace;
use crate::{documentation, licenses, platform, summary};
use anyhow::{Context, Result};
use fmi::model_description::fmi2::ModelDescription;
use pounding::description::{Category, Package};
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;
use std::time::Duration;

/// Builds the FMU of a scene and returns what there is to say about it. The FMU takes its place only when it has been
/// loaded and has run, for no longer than `limit`: what fails leaves no FMU behind, and an older one where it was.
pub fn build(scene: Option<&Path>, output: Option<&Path>, limit: Duration) -> Result<String> {
    let progress = Progress::start();
    progress.step("reading the scene");
    let workspace = Workspace::find()?;
    let scene_file = scene.map_or_else(|| workspace.default_scene(), Path::to_path_buf);
    let package = read(&scene_file)?;
    progress.say(&warnings_of(&package));
    let default_output = workspace.default_output(&package.scene.name);
    let provenance = output.is_none().then(|| Provenance::new(&default_output, &scene_file, &package.guid()));
    let output = output.map_or(default_output, Path::to_path_buf);
    // Compiling may take minutes: what cannot be written shall fail before that.
    let destination = Destination::open(output);
    let destination = match provenance {
        Some(_) => destination.context("the FMU cannot go to its usual place, -o FILE.fmu names another")?,
        None => destination?,
    };

    let compiling = "compiling the library";
    progress.step(compiling);
    let library = workspace.compile_library(|state| progress.state(compiling, state))?;

    progress.step("packing the FMU");
    let draft = destination.draft(&archive::pack(&entries(&package, &library, &workspace)?)?)?;

    progress.step("running the FMU");
    let trial = Trial::Run.report(draft.path(), limit);
    let outcome = trial.outcome().context("the FMU has been built but does not run")?;
    let outcome = Outcome { warnings: besides_slips(&outcome.warnings), ..outcome.clone() };
    destination.take(draft)?;

    drop(progress);
    if let Some(warning) = provenance.and_then(|provenance| provenance.note()) {
        let _ = writeln!(std::io::stderr(), "warning: {warning}");
    }
    Ok(report(&package, &destination, &outcome))
}

fn read(scene_file: &Path) -> Result<Package> {
    Package::from_scene_file(scene_file)
        .map_err(|problems| anyhow::anyhow!("{} is not a scene that can be built:\n{problems}", scene_file.display()))
}

/// What looks like a slip, a line each.
fn warnings_of(package: &Package) -> Vec<String> {
    let record = package.record.as_ref().map(|packaged| &packaged.record);
    pounding::warnings::of(&package.scene, record).iter().map(|warning| format!("warning: {warning}")).collect()
}

/// What the FMU has logged but for the slips, which have been told by then.
fn besides_slips(logged: &[String]) -> Vec<String> {
    logged.iter().filter(|line| !line.starts_with(Category::StatusWarning.name())).cloned().collect()
}

/// What the FMU holds, in the order in which it stands in the archive.
fn entries(package: &Package, library: &Path, workspace: &Workspace) -> Result<Vec<Entry>> {
    let binary = std::fs::read(library).with_context(|| format!("cannot read {}", library.display()))?;
    let mut entries = vec![
        Entry::file("modelDescription.xml", package.model_description().into_bytes()),
        Entry::library(&platform::library_path(&package.scene.name), binary),
    ];
    entries.extend(package.resources().map(|(name, bytes)| Entry::file(&format!("resources/{name}"), bytes.to_vec())));
    entries.extend(documentation::entries(package));
    entries.extend(licenses::entries(workspace)?);
    Ok(entries)
}

/// In a process of its own: loads the FMU as an importer would and runs it.
pub fn try_out(fmu: &Path, directory: &Path, channel: &Channel) -> Result<()> {
    let run = || {
        let unpacked = Unpacked::open(fmu, directory)?;
        let description = ModelDescription::from_string(&unpacked.description()?)?;
        let binary = Binary::load(&unpacked.path(&platform::library_path(&description.modelName)))?;
        let resources = archive::resource_uri(unpacked.root());
        let instance = Instance::new(&binary, &description.modelName, &description.guid, &resources)?;
        experiment::run(&description, &instance)
    };
    channel.need("run", run)?.map_or(Ok(()), |outcome| channel.ran(outcome))
}

fn report(package: &Package, destination: &Destination, outcome: &Outcome) -> String {
    let about = &package.scene.description;
    let mut text = package.scene.name.clone() + if about.is_empty() { "" } else { ": " } + about + "\n";
    let _ = writeln!(text, "  file         {}", destination.describe());
    let _ = writeln!(text, "  guid         {}", package.guid());
    text + &summary::text(outcome, Some(package), stop_reason(package))
}

/// Why the default experiment ends when it does.
fn stop_reason(package: &Package) -> &'static str {
    match (package.scene.stop_time, &package.record) {
        (Some(_), _) => "stop_time of the scene",
        (None, Some(_)) => "end of the record",
        (None, None) => "neither scene nor record says when to stop",
    }
}
