//! From a scene file to an FMU that has been seen to run, step by step.

use crate::arguments::BuildArguments;
use crate::destination::Destination;
use crate::face::{Face, Home};
use crate::libraries::{Library, Shipped, move_arm_for_fmpy};
use crate::numbers_only::numbers_only;
use crate::provenance::Provenance;
use crate::trial::Trial;
use anyhow::{Context, Result, bail};
use fmu_start::Line;
use pounding::FmiVersion;
use pounding::description::{Category, Package};
use pounding_pack::{file_name, pack};
use pounding_simulate::outcome::Outcome;
use pounding_simulate::summary::{self, Problem};
use pounding_simulate::written;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

/// Builds the FMU of a scene and returns what there is to say about it. The FMU takes its place only when it has been
/// loaded and has run, for no longer than the limit: what fails leaves no FMU behind, and an older one where it was.
pub fn build(face: &dyn Face, arguments: &BuildArguments) -> Result<String> {
    let version = arguments.fmi;
    if arguments.arm_in_linux64 && version == FmiVersion::V3 {
        bail!(
            "--arm-in-linux64 is for FMI 2.0: in FMI 3.0 the library for Arm has a folder of its own, aarch64-linux, \
             and FMPy looks there"
        );
    }
    let line = Line::start();
    line.work("reading the scene");
    let home = face.home()?;
    let scene_file = arguments.scene.as_ref().unwrap_or(&home.default_scene);
    let mut package = read(scene_file)?;
    if arguments.numbers_only {
        package = numbers_only(&package)?;
    }
    warnings_of(&package).iter().for_each(|warning| line.say(warning));
    let default_output = home.fmus.join(file_name(&package, version));
    let output = arguments.output.as_ref().unwrap_or(&default_output);
    written::check(&written::sources(scene_file, &package.scene, None), &[("-o", Some(output))])
        .map_err(anyhow::Error::msg)?;
    let has_note = home.has_notes && arguments.output.is_none();
    let provenance = has_note.then(|| Provenance::new(&default_output, scene_file, &package.guid(version)));
    // Compiling may take minutes: what cannot be written shall fail before that.
    let destination = match &arguments.output {
        Some(output) => Destination::open(output.clone())?,
        None => Destination::open(default_output)
            .context("the FMU cannot go to its usual place, -o FILE.fmu names another")?,
    };

    let libraries = libraries(home, arguments, &line)?;
    line.work("packing the FMU");
    let draft = destination.draft(&pack(&package, &libraries, version)?)?;

    line.work("running the FMU");
    let outcome = match libraries.iter().any(Library::is_for_this_machine) {
        false => None,
        true => {
            let trial = Trial::Run.report(face, draft.path(), arguments.limit.time_limit);
            let outcome = trial.outcome().context("the FMU has been built but does not run")?;
            Some(Outcome { warnings: besides_slips(&outcome.warnings), ..outcome.clone() })
        }
    };
    destination.take(draft)?;

    drop(line);
    if let Some(warning) = provenance.and_then(|provenance| provenance.note()) {
        let _ = writeln!(std::io::stderr(), "warning: {warning}");
    }
    Ok(report(&package, version, &destination, &libraries, outcome.as_ref()))
}

/// The libraries that the arguments ask for.
fn libraries(home: Home, arguments: &BuildArguments, line: &Line) -> Result<Vec<Library>> {
    let source = match &arguments.libraries {
        Some(folder) => Box::new(Shipped(folder.clone())),
        None => home.libraries,
    };
    line.work(source.work());
    let mut libraries = source.get(arguments.fmi, &arguments.platforms, &mut |state| line.state(state))?;
    if arguments.arm_in_linux64 {
        move_arm_for_fmpy(&mut libraries)?;
    }
    Ok(libraries)
}

fn read(scene_file: &Path) -> Result<Package> {
    Package::from_scene_file(scene_file)
        .map_err(|problems| anyhow::anyhow!("{} is not a scene that can be built:\n{problems}", scene_file.display()))
}

/// What looks like a slip, a line each.
fn warnings_of(package: &Package) -> Vec<String> {
    let record = package.record.as_ref().map(|packaged| &packaged.record);
    pounding::warnings::of_file(&package.scene, record).iter().map(|warning| format!("warning: {warning}")).collect()
}

/// What the FMU has logged but for the slips, which have been told by then.
fn besides_slips(logged: &[String]) -> Vec<String> {
    logged.iter().filter(|line| !line.starts_with(Category::StatusWarning.name())).cloned().collect()
}

fn report(
    package: &Package,
    version: FmiVersion,
    destination: &Destination,
    libraries: &[Library],
    outcome: Option<&Outcome>,
) -> String {
    let problem = Problem::from(package);
    let folders: Vec<String> = libraries.iter().map(|library| library.folder(version)).collect();
    let guid = match version {
        FmiVersion::V2 => "guid",
        FmiVersion::V3 => "token",
    };
    let mut text = problem.heading();
    let _ = writeln!(text, "  file         {}", destination.describe());
    let _ = writeln!(text, "  {guid:<12} {}", package.guid(version));
    let _ = writeln!(text, "  libraries    {}", folders.join(", "));
    match outcome {
        Some(outcome) => text + &summary::text(outcome, Some(problem), problem.stop_reason()),
        None => text + "  not run      none of the libraries is for this machine\n",
    }
}
