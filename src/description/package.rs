//! What travels inside an FMU.

use super::xml;
use crate::record::Record;
use crate::scene::{Problem, Scene, SceneError};
use std::path::Path;
use uuid::Uuid;

/// The scene file in the `resources` directory of an FMU.
pub const SCENE_RESOURCE: &str = "scene.toml";

/// Namespace of the GUIDs: any constant will do, and it may never change.
const NAMESPACE: Uuid = Uuid::from_u128(0x8f8a_0c6e_51b7_4d0a_9d35_6f0b_7c1e_42a9);

/// A scene with everything that travels inside its FMU.
///
/// In the FMU it lies as `resources/scene.toml` (the text as the user wrote it) and, where the scene has a record,
/// `resources/record.csv` or `resources/record.at2` (the bytes as the user has them).
#[derive(Clone, Debug)]
pub struct Package {
    /// The scene file, verbatim.
    pub scene_text: String,
    /// What it says.
    pub scene: Scene,
    /// The record that `scene.ground.record` names.
    pub record: Option<PackagedRecord>,
}

/// A record inside an FMU.
#[derive(Clone, Debug)]
pub struct PackagedRecord {
    /// File name in `resources/`: `record.csv` or `record.at2`.
    pub resource_name: String,
    /// The file, verbatim.
    pub bytes: Vec<u8>,
    /// What it says.
    pub record: Record,
}

impl Package {
    /// Reads a scene file and the record that it names, relative to the scene file.
    pub fn from_scene_file(path: &Path) -> Result<Package, SceneError> {
        let directory = path.parent().unwrap_or(Path::new(""));
        Package::read(path, |record| directory.join(record))
    }

    /// Reads the `resources` directory of an unpacked FMU.
    pub fn from_resources(directory: &Path) -> Result<Package, SceneError> {
        Package::read(&directory.join(SCENE_RESOURCE), |record| directory.join(resource_name(record)))
    }

    fn read(path: &Path, record_file: impl Fn(&str) -> std::path::PathBuf) -> Result<Package, SceneError> {
        let scene_text = std::fs::read_to_string(path)
            .map_err(|error| problem("scene", path, format!("a readable scene file ({error})")))?;
        let scene = Scene::from_toml(&scene_text)?;
        let record = match &scene.ground.record {
            Some(name) => Some(PackagedRecord::read(name, &record_file(name))?),
            None => None,
        };
        Ok(Package { scene_text, scene, record })
    }

    /// The text of `modelDescription.xml`; the same package gives the same bytes.
    pub fn model_description(&self) -> String {
        xml::document(self, &self.guid())
    }

    /// The GUID in the description: a name-based UUID of the description without it, the scene and the record.
    pub fn guid(&self) -> String {
        let description = xml::document(self, "");
        let record = self.record.as_ref().map_or(&[][..], |record| &record.bytes);
        let mut name = Vec::with_capacity(description.len() + self.scene_text.len() + record.len() + 24);
        for part in [description.as_bytes(), self.scene_text.as_bytes(), record] {
            name.extend_from_slice(&(part.len() as u64).to_le_bytes());
            name.extend_from_slice(part);
        }
        Uuid::new_v5(&NAMESPACE, &name).braced().to_string()
    }

    /// s, end of the default experiment: the scene's, else the end of its record.
    pub fn stop_time(&self) -> Option<f64> {
        let end_of_record = || self.record.as_ref()?.record.times.last().copied().filter(|&end| end > 0.0);
        self.scene.stop_time.or_else(end_of_record)
    }
}

impl PackagedRecord {
    fn read(name: &str, file: &Path) -> Result<PackagedRecord, SceneError> {
        let bytes = std::fs::read(file)
            .map_err(|error| problem("ground.record", file, format!("a readable record file ({error})")))?;
        let record = Record::parse(name, &bytes)
            .map_err(|error| problem("ground.record", file, format!("a record file ({error})")))?;
        Ok(PackagedRecord { resource_name: resource_name(name).to_owned(), bytes, record })
    }
}

/// The name inside the FMU keeps the format of the record apart.
fn resource_name(record: &str) -> &'static str {
    let at2 = Path::new(record).extension().is_some_and(|extension| extension.eq_ignore_ascii_case("at2"));
    if at2 { "record.at2" } else { "record.csv" }
}

fn problem(path: &str, file: &Path, expected: String) -> SceneError {
    SceneError { problems: vec![Problem { path: path.to_owned(), found: format!("{}", file.display()), expected }] }
}
