//! Scenes with their records: as a user keeps them, and as they lie in the `resources` folder of an FMU.

use super::data::{Scaling, Scene};
use super::problem::{Problem, SceneError, quoted};
use super::read::Draft;
use crate::record::{Column, Format, Record, RecordError, RecordFile};
use std::fs;
use std::path::Path;

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
    /// File name in `resources/`: `record.csv`, `record.at2`, or `record.txt` for the other formats; `record_channel_2.txt`
    /// where the name asks for that channel, `record_channel.txt` where it asks for one by its name.
    pub resource_name: String,
    /// The file, verbatim.
    pub bytes: Vec<u8>,
    /// The record in these bytes, unscaled.
    pub record: Record,
}

/// Name of the scene file in the `resources` folder of an FMU.
pub(crate) const SCENE_RESOURCE: &str = "scene.toml";

const RECORD_RESOURCES: [&str; 3] = ["record.csv", "record.at2", "record.txt"];

fn record_resource(format: Format, column: Option<&Column>) -> String {
    let [csv, at2, other] = RECORD_RESOURCES;
    match (format, column) {
        (_, Some(column)) => channel_resource(column),
        (Format::Csv, _) => csv.to_owned(),
        (Format::PeerAt2, _) => at2.to_owned(),
        _ => other.to_owned(),
    }
}

fn channel_resource(column: &Column) -> String {
    match column {
        Column::Number(number) => format!("record_channel_{number}.txt"),
        // It may hold what no file name may.
        Column::Name(_) => "record_channel.txt".to_owned(),
    }
}

/// The record file in a folder of resources, as it was asked for in the scene.
fn packaged_file(name: &str, folder: &Path) -> Result<RecordFile, SceneError> {
    let column = RecordFile::column_of(name).filter(|column| folder.join(channel_resource(column)).exists());
    let place = match &column {
        Some(column) => folder.join(channel_resource(column)),
        None => {
            let known = RECORD_RESOURCES.map(|resource| folder.join(resource));
            let [usual, ..] = &known;
            known.iter().find(|path| path.exists()).unwrap_or(usual).clone()
        }
    };
    Ok(RecordFile { column, ..read_record_file(name, &place)? })
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
        Package::read(scene_text, |record| read_record_file(record, &folder.join(record)))
    }

    /// Reads the text of a scene file whose record is one of some files in memory, where there is no folder: `bytes_of` is
    /// asked for the name that the scene has for it.
    ///
    /// # Errors
    /// As [`Package::from_scene_file`].
    pub fn from_memory(scene_text: String, bytes_of: impl Fn(&str) -> Option<Vec<u8>>) -> Result<Package, SceneError> {
        Package::read(scene_text, |name| {
            RecordFile::find(name, &bytes_of)
                .ok_or_else(|| record_problem(name, "it has not been given".to_owned()).into())
        })
    }

    /// Reads a package back from the `resources` folder of an unpacked FMU.
    ///
    /// # Errors
    /// As [`Package::from_scene_file`].
    pub fn from_resources(folder: &Path) -> Result<Package, SceneError> {
        Package::read(read_text(&folder.join(SCENE_RESOURCE))?, |record| packaged_file(record, folder))
    }

    /// The files in the `resources` folder of the FMU, name and bytes: the scene file and, where there is one, the
    /// record file, as the user has them.
    pub fn resources(&self) -> impl Iterator<Item = (&str, &[u8])> {
        let record = self.record.as_ref().map(|packaged| (packaged.resource_name.as_str(), packaged.bytes.as_slice()));
        std::iter::once((SCENE_RESOURCE, self.scene_text.as_bytes())).chain(record)
    }

    fn read(scene_text: String, file: impl Fn(&str) -> Result<RecordFile, SceneError>) -> Result<Package, SceneError> {
        let mut draft = Draft::read(&scene_text)?;
        let mut record = None;
        let is_name = |name: &String| !name.contains(char::is_control) && !draft.is_wrong_at("ground.record");
        if let Some(name) = draft.scene.ground.record.clone().filter(is_name) {
            let ground = &draft.scene.ground;
            match file(&name).and_then(|file| read_record(&name, file.with(&ground.options), ground.scaling)) {
                Ok(packaged) => record = Some(packaged),
                Err(error) => draft.add(error.problems),
            }
        }
        let scene = draft.finish()?;
        Ok(Package { scene_text, scene, record })
    }
}

impl PackagedRecord {
    /// A record from a file.
    ///
    /// # Errors
    /// As [`Record::parse`].
    pub fn new(file: RecordFile) -> Result<PackagedRecord, RecordError> {
        let found = file.parse()?;
        let resource_name = record_resource(found.format, file.column.as_ref());
        Ok(PackagedRecord { resource_name, bytes: file.bytes, record: found.record })
    }

    /// A record from the bytes of its file; the name may ask for a channel.
    ///
    /// # Errors
    /// As [`Record::parse`].
    pub fn parse(name: &str, bytes: Vec<u8>) -> Result<PackagedRecord, RecordError> {
        PackagedRecord::new(RecordFile::named(name, bytes))
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

/// The record in a file, named as `ground.record` names it, that this scaling fits.
fn read_record(name: &str, file: RecordFile, scaling: Scaling) -> Result<PackagedRecord, SceneError> {
    let packaged = PackagedRecord::new(file).map_err(|error| record_problems(name, error))?;
    scaling.factor(&packaged.record)?;
    Ok(packaged)
}

/// A record file, named as `ground.record` names it.
pub(crate) fn read_record_file(name: &str, path: &Path) -> Result<RecordFile, SceneError> {
    RecordFile::read(path).map_err(|error| record_problem(name, format!("{}: {error}", path.display())).into())
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
