//! The libraries that go into an FMU: one for each platform, the same for every scene.

use crate::inspection::inspect;
use anyhow::{Context, Result, bail};
use pounding::FmiVersion;
pub use pounding_pack::library::Library;
use pounding_pack::platform::{self, Platform};
use std::path::PathBuf;

/// What the file is called before it belongs to a scene, without its extension.
const STEM: &str = "pounding";

/// Where libraries come from.
pub trait Libraries {
    /// What is done to get them, for a person who waits.
    fn work(&self) -> &'static str;

    /// Those for these platforms, or all that there are where none is named, with the functions of that version; `show`
    /// gets how far it is.
    ///
    /// # Errors
    /// A platform that there is no library for, and what else keeps one from being had.
    fn get(&self, version: FmiVersion, platforms: &[String], show: &mut dyn FnMut(&str)) -> Result<Vec<Library>>;
}

/// A folder of libraries that have been compiled before: `<platform>/pounding.so`, `.dll` or `.dylib`.
pub struct Shipped(pub PathBuf);

impl Shipped {
    /// The platforms that there is a folder for, in the order of their names.
    ///
    /// # Errors
    /// A folder that cannot be read.
    pub fn platforms(&self) -> Result<Vec<String>> {
        let unreadable = || format!("cannot read the libraries in {}", self.0.display());
        let mut folders = Vec::new();
        for entry in std::fs::read_dir(&self.0).with_context(unreadable)? {
            let entry = entry.with_context(unreadable)?;
            let name = entry.file_name().to_string_lossy().into_owned();
            folders.extend((entry.path().is_dir() && Platform::of(&name).is_some()).then_some(name));
        }
        folders.sort();
        Ok(folders)
    }

    fn read(&self, folder: &str, version: FmiVersion) -> Result<Library> {
        let extension = Platform::of(folder).map(|platform| platform.extension).unwrap_or_default();
        let file = format!("{STEM}.{extension}");
        let path = self.0.join(folder).join(&file);
        let bytes = std::fs::read(&path).with_context(|| format!("cannot read {}", path.display()))?;
        let findings =
            inspect(&format!("binaries/{}/{file}", platform::named(folder, version)), &bytes, STEM, version, false);
        let problems = [findings.library, findings.functions].concat();
        if !problems.is_empty() {
            bail!("{}: {}", path.display(), problems.join("; "));
        }
        Ok(Library::new(folder.to_owned(), bytes))
    }
}

impl Libraries for Shipped {
    fn work(&self) -> &'static str {
        "reading the libraries"
    }

    fn get(&self, version: FmiVersion, platforms: &[String], _show: &mut dyn FnMut(&str)) -> Result<Vec<Library>> {
        let there = self.platforms()?;
        if there.is_empty() {
            bail!("{}: no library in it; expected such as linux64/{STEM}.so", self.0.display());
        }
        let (mut libraries, mut problems) = (Vec::new(), Vec::new());
        for folder in chosen(platforms, &there)? {
            match self.read(&folder, version) {
                Ok(library) => libraries.push(library),
                Err(problem) => problems.push(format!("{problem:#}")),
            }
        }
        if !problems.is_empty() {
            bail!("{}", problems.join("\n"));
        }
        Ok(libraries)
    }
}

/// The platforms that are asked for, by either of their names, each once, of those that there are; all of them where none
/// is asked for.
///
/// # Errors
/// Every platform that there is not.
pub fn chosen(platforms: &[String], there: &[String]) -> Result<Vec<String>> {
    let plain = |name: &String| platform::named(name, FmiVersion::V2);
    let among = |name: &String, names: &[String]| names.iter().any(|other| plain(other) == plain(name));
    let missing: Vec<&str> = platforms.iter().filter(|name| !among(name, there)).map(String::as_str).collect();
    if !missing.is_empty() {
        bail!("platform {}: expected one of {}", missing.join(", "), there.join(", "));
    }
    let is_wanted = |name: &&String| platforms.is_empty() || among(name, platforms);
    Ok(there.iter().filter(is_wanted).cloned().collect())
}

/// Moves the library for Arm Linux to where FMPy looks for it: into `linux64`, as the standard names no folder for Arm.
///
/// # Errors
/// Other libraries beside it: in `linux64` there can be one only, and other importers would take it for Intel's.
pub fn move_arm_for_fmpy(libraries: &mut [Library]) -> Result<()> {
    match libraries {
        [alone] if alone.platform() == platform::ARM_LINUX => {
            alone.put_into(platform::INTEL_LINUX);
            Ok(())
        }
        _ => bail!(
            "--arm-in-linux64 is for an FMU that has the library for {0} and no other: expected --platform {0} alone",
            platform::ARM_LINUX
        ),
    }
}
