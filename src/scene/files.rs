//! Scenes with their records: as a user keeps them, and as they lie in the `resources` folder of an FMU.

use super::problem::{Problem, SceneError, quoted};
use super::read::Draft;
use super::{Scaling, Scene};
use crate::record::{Format, Record};
use std::fs;
use std::path::{Path, PathBuf};

/// A scene with its record, and the files as they are, for an FMU to carry.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneFiles {
    /// The scene.
    pub scene: Scene,
    /// The record of `scene.ground.record`, unscaled.
    pub record: Option<Record>,
    /// The scene file and, where there is one, the record file.
    pub resources: Vec<Resource>,
}

/// A file in the `resources` folder of an FMU.
#[derive(Clone, Debug, PartialEq)]
pub struct Resource {
    /// `scene.toml`, `record.csv` or `record.at2`.
    pub name: &'static str,
    /// The bytes of the user's file, unchanged.
    pub bytes: Vec<u8>,
}

/// Name of the scene file in the `resources` folder of an FMU.
pub const SCENE_RESOURCE: &str = "scene.toml";

fn record_resource(name: &str) -> &'static str {
    match Format::of(name) {
        Format::Csv => "record.csv",
        Format::PeerAt2 => "record.at2",
    }
}

/// Reads a scene file and the record that it names, relative to the folder of the scene file.
///
/// # Errors
/// All problems of the scene; a record that is missing, cannot be read or cannot be scaled is one at `ground.record`,
/// `ground.scale` or `ground.pga`. A scene file that cannot be read is a single problem at the file's name.
pub fn load(path: &Path) -> Result<(Scene, Option<Record>), SceneError> {
    load_files(path).map(|files| (files.scene, files.record))
}

/// Like [`load`], with the bytes of both files under the names that they have in an FMU.
///
/// # Errors
/// As [`load`].
pub fn load_files(path: &Path) -> Result<SceneFiles, SceneError> {
    let folder = path.parent().unwrap_or(Path::new(""));
    read_files(path, |record| folder.join(record))
}

/// Reads a scene and its record back from the `resources` folder of an FMU: [`SceneFiles::resources`] as files.
///
/// # Errors
/// As [`load`].
pub fn load_resources(folder: &Path) -> Result<SceneFiles, SceneError> {
    read_files(&folder.join(SCENE_RESOURCE), |record| folder.join(record_resource(record)))
}

fn read_files(path: &Path, record_path: impl Fn(&str) -> PathBuf) -> Result<SceneFiles, SceneError> {
    let unreadable =
        |reason: String| Problem::new(path.display().to_string(), "", format!("a scene file, but {reason}"));
    let bytes = fs::read(path).map_err(|error| unreadable(error.to_string()))?;
    let text = str::from_utf8(&bytes).map_err(|error| unreadable(not_utf8(&bytes, error.valid_up_to())))?;
    let mut draft = Draft::read(text)?;
    let (mut record, mut record_file) = (None, None);
    if let Some(name) = draft.scene.ground.record.clone() {
        match read_record(&name, &record_path(&name), draft.scene.ground.scaling) {
            Ok((parsed, bytes)) => {
                record = Some(parsed);
                record_file = Some(Resource { name: record_resource(&name), bytes });
            }
            Err(problem) => draft.add(problem),
        }
    }
    let scene = draft.finish()?;
    let scene_file = Resource { name: SCENE_RESOURCE, bytes };
    Ok(SceneFiles { scene, record, resources: std::iter::once(scene_file).chain(record_file).collect() })
}

/// Reads a record file, named as `ground.record` names it, that this scaling fits.
pub(crate) fn read_record(name: &str, path: &Path, scaling: Scaling) -> Result<(Record, Vec<u8>), Problem> {
    let problem = |expected: String| Problem::new("ground.record", quoted(name), expected);
    let unreadable = |error| problem(format!("a record file, but {}: {error}", path.display()));
    let bytes = fs::read(path).map_err(unreadable)?;
    let record = Record::parse(name, &bytes).map_err(|error| problem(format!("a record file, but {error}")))?;
    scaling.factor(&record)?;
    Ok((record, bytes))
}

fn not_utf8(bytes: &[u8], valid: usize) -> String {
    let line = bytes.iter().take(valid).filter(|&&byte| byte == b'\n').count() + 1;
    format!("line {line} is not UTF-8 text")
}
