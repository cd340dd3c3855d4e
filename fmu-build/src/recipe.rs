//! From a scene file to an FMU that has been seen to run, step by step.

use crate::archive::{self, Entry, Unpacked};
use crate::c_interface::{Binary, Instance};
use crate::experiment::{self, Outcome};
use crate::progress::Progress;
use crate::workspace::Workspace;
use crate::{documentation, licenses, platform, summary};
use anyhow::{Context, Result, bail};
use fmi::model_description::fmi2::ModelDescription;
use pounding::description::Package;
use std::fmt::Write as _;
use std::io::{ErrorKind, Write as _};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// Builds the FMU of a scene and returns what there is to say about it. The FMU takes its place only when it has been
/// loaded and has run: what fails leaves no FMU behind, and an older one where it was.
pub fn build(scene: Option<&Path>, output: Option<&Path>) -> Result<String> {
    let progress = Progress::start();
    progress.step("reading the scene");
    let workspace = Workspace::find()?;
    let scene_file = scene.map_or_else(|| workspace.default_scene(), Path::to_path_buf);
    let package = read(&scene_file)?;
    let destination = output.map_or_else(|| workspace.default_output(&package.scene.name), Path::to_path_buf);

    // Compiling may take minutes: what cannot be written shall fail before that.
    open_draft(&destination)?;

    progress.step("compiling the library");
    let library = workspace.compile_library()?;

    progress.step("packing the FMU");
    let draft = write_draft(&archive::pack(&entries(&package, &library, &workspace)?)?, &destination)?;

    progress.step("running the FMU");
    let (description, outcome) = try_out(draft.path()).context("the FMU has been built but does not run")?;
    draft.persist(&destination).with_context(|| format!("cannot write {}", destination.display()))?;

    drop(progress);
    Ok(report(&package, &destination, &description, &outcome))
}

fn read(scene_file: &Path) -> Result<Package> {
    Package::from_scene_file(scene_file)
        .map_err(|problems| anyhow::anyhow!("{} is not a scene that can be built:\n{problems}", scene_file.display()))
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

/// The FMU in a temporary file beside its destination.
fn write_draft(bytes: &[u8], destination: &Path) -> Result<NamedTempFile> {
    let mut draft = open_draft(destination)?;
    let written = draft.write_all(bytes).and_then(|()| draft.flush());
    written.with_context(|| format!("cannot write {}", destination.display()))?;
    Ok(draft)
}

/// A temporary file beside the destination, so that it can be renamed into its place. The directory is made if there is
/// none.
fn open_draft(destination: &Path) -> Result<NamedTempFile> {
    match std::fs::metadata(destination) {
        Ok(there) if there.is_dir() => {
            bail!("{} is a directory: expected the path of the FMU file", destination.display());
        }
        Err(error) if error.kind() == ErrorKind::InvalidFilename => {
            return Err(error).with_context(|| format!("cannot write {}", destination.display()));
        }
        Ok(_) | Err(_) => {}
    }
    let folder = match destination.parent() {
        Some(parent) if parent != Path::new("") => parent.to_path_buf(),
        _ => PathBuf::from("."),
    };
    let cannot = || format!("cannot write to {}", folder.display());
    std::fs::create_dir_all(&folder).with_context(cannot)?;
    let mut builder = tempfile::Builder::new();
    builder.prefix(".fmu-").suffix(".part");
    // As any file that a program writes, readable by others where the umask allows it.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(&folder).with_context(cannot)
}

/// Loads the FMU as an importer would and runs it.
fn try_out(fmu: &Path) -> Result<(ModelDescription, Outcome)> {
    let unpacked = Unpacked::open(fmu)?;
    let description = ModelDescription::from_string(&unpacked.description()?)?;
    let binary = Binary::load(&unpacked.path(&platform::library_path(&description.modelName)))?;
    let instance =
        Instance::new(&binary, &description.modelName, &description.guid, &archive::resource_uri(unpacked.root()))?;
    let outcome = experiment::run(&description, &instance)?;
    Ok((description, outcome))
}

fn report(package: &Package, destination: &Path, description: &ModelDescription, outcome: &Outcome) -> String {
    let about = &package.scene.description;
    let mut text = package.scene.name.clone() + if about.is_empty() { "" } else { ": " } + about + "\n";
    let size = std::fs::metadata(destination).map_or(0, |file| file.len());
    let here = std::env::current_dir().unwrap_or_default();
    let shown = destination.strip_prefix(here).unwrap_or(destination).display();
    let _ = writeln!(text, "  file         {shown} ({} kB)", size.div_ceil(1000));
    let _ = writeln!(text, "  guid         {}", description.guid);
    text + &summary::text(description, outcome, stop_reason(package))
}

/// Why the default experiment ends when it does.
fn stop_reason(package: &Package) -> &'static str {
    match (package.scene.stop_time, &package.record) {
        (Some(_), _) => "stop_time of the scene",
        (None, Some(_)) => "end of the record",
        (None, None) => "neither scene nor record says when to stop",
    }
}
