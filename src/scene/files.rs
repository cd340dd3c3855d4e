//! Scenes with their records: as a user keeps them, and as they lie in the `resources` folder of an FMU.

use super::data::{Scaling, Scene};
use super::problem::{Problem, SceneError, quoted};
use super::read::Draft;
use crate::record::{Format, Record, RecordError};
use std::fs;
use std::path::{Path, PathBuf};

/// A scene with everything that travels inside its FMU.
#[derive(Clone, Debug, PartialEq)]
pub struct Package {
    /// The scene file, verbatim.
    pub scene_text: String,
    /// The scene in that text.
    pub scene: Scene,
    /// The record that `scene.ground.record` names.
    pub record: Option<PackagedRecord>,
}

/// A record inside an FMU.
#[derive(Clone, Debug, PartialEq)]
pub struct PackagedRecord {
    /// File name in `resources/`: `record.csv` or `record.at2`.
    pub resource_name: &'static str,
    /// The file, verbatim.
    pub bytes: Vec<u8>,
    /// The record in these bytes, unscaled.
    pub record: Record,
}

/// Name of the scene file in the `resources` folder of an FMU.
pub(crate) const SCENE_RESOURCE: &str = "scene.toml";

fn record_resource(name: &str) -> &'static str {
    match Format::of(name) {
        Format::Csv => "record.csv",
        Format::PeerAt2 => "record.at2",
    }
}

/// Reads a scene file and the record that it names, without what only an FMU needs.
///
/// # Errors
/// As [`Package::from_scene_file`].
pub fn load(path: &Path) -> Result<(Scene, Option<Record>), SceneError> {
    let package = Package::from_scene_file(path)?;
    Ok((package.scene, package.record.map(|packaged| packaged.record)))
}

impl Package {
    /// Reads a scene file and the record that it names, relative to the folder of the scene file.
    ///
    /// # Errors
    /// All problems of the scene; a record that is missing, cannot be read or cannot be scaled is one at
    /// `ground.record`, `ground.scale` or `ground.pga`. A scene file that cannot be read is a single problem at the
    /// file's name.
    pub fn from_scene_file(path: &Path) -> Result<Package, SceneError> {
        let folder = path.parent().unwrap_or(Path::new(""));
        Package::from_scene_text(read_text(path)?, folder)
    }

    /// Reads the text of a scene file and the record that it names, relative to a folder.
    ///
    /// # Errors
    /// As [`Package::from_scene_file`].
    pub fn from_scene_text(scene_text: String, folder: &Path) -> Result<Package, SceneError> {
        Package::read(scene_text, |record| folder.join(record))
    }

    /// Reads a package back from the `resources` folder of an unpacked FMU.
    ///
    /// # Errors
    /// As [`Package::from_scene_file`].
    pub fn from_resources(folder: &Path) -> Result<Package, SceneError> {
        Package::read(read_text(&folder.join(SCENE_RESOURCE))?, |record| folder.join(record_resource(record)))
    }

    /// The files in the `resources` folder of the FMU, name and bytes: the scene file and, where there is one, the
    /// record file, as the user has them.
    pub fn resources(&self) -> impl Iterator<Item = (&'static str, &[u8])> {
        let record = self.record.as_ref().map(|packaged| (packaged.resource_name, packaged.bytes.as_slice()));
        std::iter::once((SCENE_RESOURCE, self.scene_text.as_bytes())).chain(record)
    }

    fn read(scene_text: String, record_path: impl Fn(&str) -> PathBuf) -> Result<Package, SceneError> {
        let mut draft = Draft::read(&scene_text)?;
        let mut record = None;
        let is_name = |name: &String| !name.contains(char::is_control);
        if let Some(name) = draft.scene.ground.record.clone().filter(is_name) {
            match read_record(&name, &record_path(&name), draft.scene.ground.scaling) {
                Ok(packaged) => record = Some(packaged),
                Err(error) => draft.add(error.problems),
            }
        }
        let scene = draft.finish()?;
        Ok(Package { scene_text, scene, record })
    }
}

impl PackagedRecord {
    /// A record from the bytes of its file; the name tells the format.
    ///
    /// # Errors
    /// As [`Record::parse`].
    pub fn parse(name: &str, bytes: Vec<u8>) -> Result<PackagedRecord, RecordError> {
        let record = Record::parse(name, &bytes)?;
        Ok(PackagedRecord { resource_name: record_resource(name), bytes, record })
    }
}

fn read_text(path: &Path) -> Result<String, Problem> {
    let unreadable =
        |reason: String| Problem::new(path.display().to_string(), "", format!("a scene file, but {reason}"));
    let bytes = fs::read(path).map_err(|error| unreadable(error.to_string()))?;
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        unreadable(not_utf8(error.as_bytes(), valid))
    })
}

/// Reads a record file, named as `ground.record` names it, that this scaling fits.
fn read_record(name: &str, path: &Path, scaling: Scaling) -> Result<PackagedRecord, SceneError> {
    let packaged = PackagedRecord::parse(name, read_record_file(name, path)?);
    let packaged = packaged.map_err(|error| record_problems(name, error))?;
    scaling.factor(&packaged.record)?;
    Ok(packaged)
}

/// The bytes of a record file.
pub(crate) fn read_record_file(name: &str, path: &Path) -> Result<Vec<u8>, SceneError> {
    // A device or a pipe may have no end.
    if fs::metadata(path).is_ok_and(|metadata| !metadata.is_file()) {
        return Err(record_problem(name, format!("{}: it is no file", path.display())).into());
    }
    fs::read(path).map_err(|error| record_problem(name, format!("{}: {error}", path.display())).into())
}

/// What is wrong in a record file, as problems of the scene that names it.
pub(crate) fn record_problems(name: &str, error: RecordError) -> SceneError {
    SceneError { problems: error.problems.into_iter().map(|what| record_problem(name, what)).collect() }
}

fn record_problem(name: &str, what: String) -> Problem {
    Problem::new("ground.record", quoted(name), format!("a record file, but {what}"))
}

fn not_utf8(bytes: &[u8], valid: usize) -> String {
    let line = bytes.iter().take(valid).filter(|&&byte| byte == b'\n').count() + 1;
    format!("line {line} is not UTF-8 text")
}
