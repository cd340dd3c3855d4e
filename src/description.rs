//! From a scene to its `modelDescription.xml`.

use crate::record::Record;
use crate::scene::{Scene, SceneError};
use std::path::Path;

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
    pub fn from_scene_file(_path: &Path) -> Result<Package, SceneError> {
        todo!()
    }

    /// Reads the `resources` directory of an unpacked FMU.
    pub fn from_resources(_dir: &Path) -> Result<Package, SceneError> {
        todo!()
    }

    /// The text of `modelDescription.xml`; the same package gives the same bytes.
    pub fn model_description(&self) -> String {
        todo!()
    }

    /// The GUID in the description: a name-based UUID of description, scene and record.
    pub fn guid(&self) -> String {
        todo!()
    }
}
