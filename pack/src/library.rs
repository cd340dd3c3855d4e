//! The library for one platform, the same for every scene.

use crate::archive::Entry;
use crate::platform::{self, Platform};
use pounding::FmiVersion;

/// The library for one platform.
pub struct Library {
    /// Whose it is, by the name of the folder that importers expect it in, such as `linux64`.
    platform: String,
    /// The folder below `binaries/` that it goes into in place of its own.
    elsewhere: Option<&'static str>,
    bytes: Vec<u8>,
}

impl Library {
    /// Of these bytes, for a platform such as `linux64`.
    pub fn new(platform: String, bytes: Vec<u8>) -> Library {
        Library { platform, elsewhere: None, bytes }
    }

    /// Whose it is, such as `linux64`.
    pub fn platform(&self) -> &str {
        &self.platform
    }

    /// Puts it into the folder of another platform below `binaries/`.
    pub fn put_into(&mut self, folder: &'static str) {
        self.elsewhere = Some(folder);
    }

    /// Whether it can be loaded here.
    pub fn is_for_this_machine(&self) -> bool {
        platform::named(&self.platform, FmiVersion::V2) == platform::folder()
    }

    /// The folder below `binaries/` that it goes into.
    pub fn folder(&self, version: FmiVersion) -> String {
        self.elsewhere.map_or_else(|| platform::named(&self.platform, version), str::to_owned)
    }

    /// As it stands in the FMU of a scene of that name.
    pub fn entry(&self, name: &str, version: FmiVersion) -> Entry {
        let extension = Platform::of(&self.platform).map_or("so", |platform| platform.extension);
        Entry::library(&format!("binaries/{}/{name}.{extension}", self.folder(version)), self.bytes.clone())
    }
}
