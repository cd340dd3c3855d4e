//! Libraries as files: whether one is what its folder and its name in an FMU say, for whatever machine it is. Nothing of
//! it is run.

use crate::functions::functions;
use object::read::macho::{FatArch, MachOFatFile32, MachOFatFile64};
use object::{Architecture, BinaryFormat, ExportTarget, FileKind, NameOrOrdinal, Object, ObjectKind, ObjectSegment};
use pounding::FmiVersion;
use pounding_pack::platform::{self, Platform};
use std::collections::HashSet;

/// What a library is, and what is wrong with it.
#[derive(Debug, Default, PartialEq)]
pub struct Findings {
    /// Whose library it is, where that can be seen.
    pub platform: Option<Platform>,
    /// With folder, name, format, machine and contents.
    pub library: Vec<String>,
    /// With what it exports.
    pub functions: Vec<String>,
}

impl Findings {
    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.library.is_empty() && self.functions.is_empty()
    }
}

/// Looks at the library at a path of an FMU, which ought to be `binaries/<platform>/<identifier>.<extension>`; whether
/// there is no other library in the FMU, which is of that version.
pub fn inspect(path: &str, bytes: &[u8], identifier: &str, version: FmiVersion, is_alone: bool) -> Findings {
    let mut findings = Findings::default();
    let parts: Vec<&str> = path.split('/').collect();
    let ["binaries", folder, file] = parts.as_slice() else {
        findings.library.push(format!("{path}: expected binaries/<platform>/{identifier}.so, .dll or .dylib"));
        return findings;
    };
    let Some(platform) = Platform::of(folder) else {
        let known = ["linux64", "win64", "darwin64", "aarch64-linux"].map(|name| platform::named(name, version));
        let known = format!("{}, ...", known.join(", "));
        findings.library.push(format!("{path}: {folder:?} is no platform that is known here; expected {known}"));
        return findings;
    };
    let name_in_3 = platform::named(folder, FmiVersion::V3);
    if version == FmiVersion::V3 && name_in_3 != *folder {
        findings.library.push(format!("{path}: expected the folder {name_in_3}, its name in FMI 3.0"));
    }
    let may_be_elsewhere = is_alone && version == FmiVersion::V2;
    let other = Platform::of_lone_library(folder).filter(|other| may_be_elsewhere && is_of(bytes, *other));
    let platform = other.unwrap_or(platform);
    let name = format!("{identifier}.{}", platform.extension);
    if *file != name {
        findings.library.push(format!("{path}: expected the name {name} in {folder}"));
    }
    match exports(bytes, platform) {
        Err(problem) => findings.library.push(format!("{path}: {problem}")),
        Ok(exports) => {
            findings.platform = Some(platform);
            let is_missing = |name: &&str| !exports.contains(name.as_bytes());
            let missing: Vec<&str> = functions(version).iter().copied().filter(is_missing).collect();
            let verb = if missing.len() == 1 { "is" } else { "are" };
            let finding = || format!("{path}: {} {verb} not exported", missing.join(", "));
            findings.functions.extend((!missing.is_empty()).then(finding));
        }
    }
    findings
}

/// Whether it looks like a library for a platform.
fn is_of(bytes: &[u8], platform: Platform) -> bool {
    object::File::parse(bytes)
        .is_ok_and(|file| (file.format(), file.architecture()) == (platform.format, platform.architecture))
}

/// The functions that a library for a platform exports.
fn exports(bytes: &[u8], platform: Platform) -> Result<HashSet<Vec<u8>>, String> {
    let expected = format!("expected {}", describe(platform.format, platform.architecture));
    let damaged = |error| format!("no library that can be read: {error}; {expected}");
    let bytes = of_machine(bytes, platform.architecture).map_err(damaged)?;
    let file = object::File::parse(bytes).map_err(damaged)?;
    if (file.format(), file.architecture()) != (platform.format, platform.architecture) {
        return Err(format!("{}; {expected}", describe(file.format(), file.architecture())));
    }
    if file.kind() != ObjectKind::Dynamic {
        return Err(format!("{:?}; expected a shared library", file.kind()).to_lowercase());
    }
    for segment in file.segments() {
        segment.data().map_err(damaged)?;
    }
    // On macOS C symbols begin with an underscore.
    let prefix: &[u8] = if platform.format == BinaryFormat::MachO { b"_" } else { b"" };
    let mut functions = HashSet::new();
    for export in file.exports().map_err(damaged)? {
        let export = export.map_err(damaged)?;
        if let (NameOrOrdinal::Name(name), ExportTarget::Address { .. }) = (export.name(), export.target()) {
            functions.extend(name.strip_prefix(prefix).map(<[u8]>::to_vec));
        }
    }
    Ok(functions)
}

/// The part for one machine of a file that may hold libraries for several, as those of macOS do.
fn of_machine(bytes: &[u8], architecture: Architecture) -> object::Result<&[u8]> {
    let part = match FileKind::parse(bytes)? {
        FileKind::MachOFat32 => part_of(MachOFatFile32::parse(bytes)?.arches(), bytes, architecture)?,
        FileKind::MachOFat64 => part_of(MachOFatFile64::parse(bytes)?.arches(), bytes, architecture)?,
        _ => None,
    };
    Ok(part.unwrap_or(bytes))
}

fn part_of<'a>(
    parts: &[impl FatArch],
    bytes: &'a [u8],
    architecture: Architecture,
) -> object::Result<Option<&'a [u8]>> {
    parts.iter().find(|part| part.architecture() == architecture).map(|part| part.data(bytes)).transpose()
}

fn describe(format: BinaryFormat, architecture: Architecture) -> String {
    format!("a library in the format {format:?} for {architecture:?}")
}
