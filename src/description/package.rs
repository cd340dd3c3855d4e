//! What a package says about itself in its FMU: description, fingerprint, default experiment.

use super::xml;
use crate::FmiVersion;
use crate::scene::Package;
use crate::variables::Table;
use uuid::Uuid;

/// Namespace of the GUIDs: any constant will do, and it may never change.
const NAMESPACE: Uuid = Uuid::from_u128(0x8f8a_0c6e_51b7_4d0a_9d35_6f0b_7c1e_42a9);

impl Package {
    /// The text of `modelDescription.xml`; the same package gives the same bytes.
    pub fn model_description(&self, version: FmiVersion) -> String {
        let table = Table::of_fmu(&self.scene);
        xml::document(self, &table, version, &guid(self.fingerprint_with(&table, version)))
    }

    /// The GUID, or `instantiationToken`, as the description writes it.
    pub fn guid(&self, version: FmiVersion) -> String {
        guid(self.fingerprint(version))
    }

    /// What the GUID is: a name-based UUID of the description without it, the scene and the record.
    pub fn fingerprint(&self, version: FmiVersion) -> Uuid {
        self.fingerprint_with(&Table::of_fmu(&self.scene), version)
    }

    /// The same where the variables of the scene are at hand.
    pub(crate) fn fingerprint_with(&self, table: &Table, version: FmiVersion) -> Uuid {
        let record = self.record.as_ref().map_or(&[][..], |record| &record.bytes);
        fingerprint_of(&xml::document(self, table, version, ""), &self.scene_text, record)
    }

    /// s, end of the default experiment: the scene's, else the end of its record.
    pub fn stop_time(&self) -> Option<f64> {
        let end_of_record = || self.record.as_ref()?.record.times.last().copied().filter(|&end| end > 0.0);
        self.scene.stop_time.or_else(end_of_record)
    }
}

/// The GUID that belongs to the text of a description with an empty one, the scene and the record.
pub fn guid_of(description: &str, scene_text: &str, record: &[u8]) -> String {
    guid(fingerprint_of(description, scene_text, record))
}

fn fingerprint_of(description: &str, scene_text: &str, record: &[u8]) -> Uuid {
    let mut name = Vec::with_capacity(description.len() + scene_text.len() + record.len() + 24);
    for part in [description.as_bytes(), scene_text.as_bytes(), record] {
        name.extend_from_slice(&(part.len() as u64).to_le_bytes());
        name.extend_from_slice(part);
    }
    Uuid::new_v5(&NAMESPACE, &name)
}

/// A fingerprint as descriptions write it.
pub(crate) fn guid(fingerprint: Uuid) -> String {
    fingerprint.braced().to_string()
}
