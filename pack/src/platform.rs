//! Where each version of FMI wants the library of each platform, and what such a library is.

use object::{Architecture, BinaryFormat};
use pounding::FmiVersion;
use std::env::consts::{ARCH, DLL_EXTENSION, OS};

/// Linux on Intel processors.
pub const INTEL_LINUX: &str = "linux64";
/// Linux on Arm.
pub const ARM_LINUX: &str = "aarch64-linux";

/// What the folders of FMI 2.0 below `binaries/` are for; the standard defines them for Intel processors only. FMPy looks
/// for `linux64` and `darwin64` on Arm too; other importers use `<architecture>-<system>` there, the names of FMI 3.0.
const FMI2: [(&str, &str, &str); 5] = [
    (INTEL_LINUX, "linux", "x86_64"),
    ("linux32", "linux", "x86"),
    ("win64", "windows", "x86_64"),
    ("win32", "windows", "x86"),
    ("darwin64", "darwin", "x86_64"),
];

const ARCHITECTURES: [(&str, Architecture); 9] = [
    ("x86_64", Architecture::X86_64),
    ("x86", Architecture::I386),
    ("aarch64", Architecture::Aarch64),
    ("arm", Architecture::Arm),
    ("aarch32", Architecture::Arm),
    ("riscv64", Architecture::Riscv64),
    ("powerpc64", Architecture::PowerPc64),
    ("s390x", Architecture::S390x),
    ("loongarch64", Architecture::LoongArch64),
];

/// The format of libraries and the extension of their names.
const SYSTEMS: [(&str, BinaryFormat, &str); 6] = [
    ("linux", BinaryFormat::Elf, "so"),
    ("freebsd", BinaryFormat::Elf, "so"),
    ("netbsd", BinaryFormat::Elf, "so"),
    ("openbsd", BinaryFormat::Elf, "so"),
    ("windows", BinaryFormat::Pe, "dll"),
    ("darwin", BinaryFormat::MachO, "dylib"),
];

/// What the library in a folder has to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Platform {
    /// Of the file.
    pub format: BinaryFormat,
    /// Of the machine.
    pub architecture: Architecture,
    /// Of the file's name, without its dot.
    pub extension: &'static str,
}

impl Platform {
    /// Of a folder below `binaries/`.
    pub fn of(folder: &str) -> Option<Platform> {
        let named = FMI2.iter().find(|(name, ..)| *name == folder).map(|(_, system, arch)| (*arch, *system));
        let (arch, system) = named.or_else(|| folder.split_once('-'))?;
        let (_, architecture) = *ARCHITECTURES.iter().find(|(name, _)| *name == arch)?;
        let (_, format, extension) = *SYSTEMS.iter().find(|(name, ..)| *name == system)?;
        Some(Platform { format, architecture, extension })
    }

    /// What else may be in a folder, where it is the only library of its FMU: the one for Arm, for FMPy.
    pub fn of_lone_library(folder: &str) -> Option<Platform> {
        if folder == INTEL_LINUX { Platform::of(ARM_LINUX) } else { None }
    }

    /// Of this machine.
    pub fn host() -> Option<Platform> {
        Platform::of(&self::folder())
    }
}

/// The folder that a version has for a platform, which may be named as in either.
pub fn named(platform: &str, version: FmiVersion) -> String {
    let in_fmi3 = |system: &str, arch: &str| format!("{arch}-{system}");
    let names = FMI2.iter().find(|(name, system, arch)| *name == platform || in_fmi3(system, arch) == platform);
    match (names, version) {
        (Some((name, ..)), FmiVersion::V2) => (*name).to_owned(),
        (Some((_, system, arch)), FmiVersion::V3) => in_fmi3(system, arch),
        (None, _) => platform.to_owned(),
    }
}

/// The folder of the host's library below `binaries/`, such as `linux64`.
pub fn folder() -> String {
    let system = if OS == "macos" { "darwin" } else { OS };
    named(&format!("{ARCH}-{system}"), FmiVersion::V2)
}

/// Path inside an FMU with these files of the library that this machine loads.
pub fn host_library<'a>(names: &'a [String], model_identifier: &str, version: FmiVersion) -> Option<&'a str> {
    let own = named(&folder(), version);
    let is_for_fmpy = version == FmiVersion::V2 && own == ARM_LINUX;
    let folders = [own.as_str(), if is_for_fmpy { INTEL_LINUX } else { &own }];
    let paths = folders.map(|folder| format!("binaries/{folder}/{model_identifier}.{DLL_EXTENSION}"));
    paths.iter().find_map(|path| names.iter().find(|name| *name == path)).map(String::as_str)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_host_is_among_the_platforms() {
        assert_eq!(Platform::host().map(|platform| platform.extension), Some(DLL_EXTENSION));
    }

    #[test]
    fn names_in_both_standards() {
        for (old, new) in [
            ("linux64", "x86_64-linux"),
            ("win64", "x86_64-windows"),
            ("darwin64", "x86_64-darwin"),
            ("win32", "x86-windows"),
            ("aarch64-linux", "aarch64-linux"),
            ("vax", "vax"),
        ] {
            for name in [old, new] {
                assert_eq!(FmiVersion::ALL.map(|version| named(name, version)), [old, new]);
            }
        }
    }

    #[test]
    fn folders_of_both_standards() {
        let arm =
            Some(Platform { format: BinaryFormat::MachO, architecture: Architecture::Aarch64, extension: "dylib" });
        assert_eq!(Platform::of("aarch64-darwin"), arm);
        assert_eq!(Platform::of("linux64"), Platform::of("x86_64-linux"));
        assert_eq!(Platform::of("win32").map(|platform| platform.architecture), Some(Architecture::I386));
        for folder in ["", "vax", "linux", "x86_64-", "-linux", "Linux64", "linux64-x86_64"] {
            assert_eq!(Platform::of(folder), None, "{folder}");
        }
    }
}
