//! What travels inside an FMU.

use super::xml;
use crate::record::Record;
use crate::scene::{self, Scene, SceneError, SceneFiles};
use std::path::Path;
use uuid::Uuid;

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
        scene::load_files(path).map(Package::of)
    }

    /// Reads the `resources` directory of an unpacked FMU.
    pub fn from_resources(directory: &Path) -> Result<Package, SceneError> {
        scene::load_resources(directory).map(Package::of)
    }

    fn of(files: SceneFiles) -> Package {
        let mut package = Package { scene_text: String::new(), scene: files.scene, record: None };
        let mut record = files.record;
        for resource in files.resources {
            match record.take_if(|_| resource.name != scene::SCENE_RESOURCE) {
                Some(record) => {
                    let resource_name = resource.name.to_owned();
                    package.record = Some(PackagedRecord { resource_name, bytes: resource.bytes, record });
                }
                // It has been read as UTF-8.
                None => package.scene_text = String::from_utf8_lossy(&resource.bytes).into_owned(),
            }
        }
        package
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
