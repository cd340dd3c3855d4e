//! `cargo fmu --libraries`: FMUs with libraries that have been compiled before, for any platforms.

use crate::common::libraries::library;
use crate::common::{Files, cargo_fmu, feup, feup_fmu, files, stderr, stdout, write_fmu};
use std::path::{Path, PathBuf};
use std::process::Output;
use tempfile::TempDir;

const HOST: (&str, &str) = if cfg!(windows) { ("win64", "dll") } else { ("linux64", "so") };

/// Libraries for this machine, the real one, and for two others.
struct Shipped {
    directory: TempDir,
}

impl Shipped {
    fn new() -> Shipped {
        let shipped = Shipped { directory: TempDir::new().unwrap() };
        let others = [("aarch64-linux", "so"), ("win64", "dll"), ("linux64", "so")];
        for (folder, extension) in others.into_iter().filter(|other| *other != HOST) {
            shipped.put(&format!("{folder}/pounding.{extension}"), &library(folder));
        }
        shipped.put(&format!("{}/pounding.{}", HOST.0, HOST.1), &files(feup_fmu())[1].1);
        shipped
    }

    fn put(&self, path: &str, bytes: &[u8]) {
        let path = self.path(&format!("libraries/{path}"));
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, bytes).unwrap();
    }

    fn path(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    /// Builds the default scene with them.
    fn build(&self, output: &str, options: &[&str]) -> (Output, PathBuf) {
        let (libraries, fmu) = (self.path("libraries"), self.path(output));
        let (scene, libraries) = (feup().display().to_string(), libraries.display().to_string());
        let arguments = [&[&scene, "--libraries", &libraries, "-o", fmu.to_str().unwrap()], options].concat();
        (cargo_fmu(&arguments), fmu)
    }

    fn refused(&self, options: &[&str]) -> String {
        let (output, fmu) = self.build("refused.fmu", options);
        assert_eq!(output.status.code(), Some(1), "{}", stdout(&output));
        assert!(!fmu.exists());
        stderr(&output)
    }
}

fn libraries_of(fmu: &Path) -> Vec<String> {
    let names = files(fmu).into_iter().map(|(name, _)| name);
    names.filter_map(|name| Some(name.strip_prefix("binaries/")?.to_owned())).collect()
}

/// The FMU of the default scene as it would come from another machine.
fn elsewhere(path: PathBuf, folder: &str, extension: &str) -> PathBuf {
    let mut files: Files = files(feup_fmu());
    files[1] = (format!("binaries/{folder}/FeupFrames.{extension}"), library(folder));
    write_fmu(&path, &files);
    path
}

#[test]
fn it_is_the_fmu_of_cargo_fmu_and_merge() {
    let shipped = Shipped::new();
    let (output, fmu) = shipped.build("host.fmu", &["--platform", HOST.0]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(std::fs::read(&fmu).unwrap() == std::fs::read(feup_fmu()).unwrap());
    assert!(stdout(&output).contains("peak force"), "it has run");

    let (output, fmu) = shipped.build("all.fmu", &[]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(stdout(&output).contains("  libraries    aarch64-linux, linux64, win64\n"), "{}", stdout(&output));
    let mut merged = feup_fmu().to_path_buf();
    for (folder, extension) in [("aarch64-linux", "so"), ("win64", "dll"), ("linux64", "so")] {
        if folder != HOST.0 {
            let other = elsewhere(shipped.path(&format!("{folder}.fmu")), folder, extension);
            let both = shipped.path(&format!("with_{folder}.fmu"));
            let arguments = [&merged, &other, &both].map(|path| path.to_str().unwrap().to_owned());
            let done = cargo_fmu(&["merge", &arguments[0], &arguments[1], "-o", &arguments[2]]);
            assert!(done.status.success(), "{}", stderr(&done));
            merged = both;
        }
    }
    assert!(std::fs::read(&fmu).unwrap() == std::fs::read(merged).unwrap());
}

#[test]
fn platforms_are_chosen_by_name_and_others_refused_together() {
    let shipped = Shipped::new();
    let (output, fmu) = shipped.build("two.fmu", &["--platform", "win64,aarch64-linux", "--platform", "win64"]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert_eq!(libraries_of(&fmu), ["aarch64-linux/FeupFrames.so", "win64/FeupFrames.dll"]);
    if HOST.0 == "linux64" {
        assert!(stdout(&output).contains("not run      none of the libraries is for this machine"));
    }
    let said = shipped.refused(&["--platform", "vax", "linux64", "darwin64"]);
    assert!(said.contains("platform vax, darwin64: expected one of aarch64-linux, linux64, win64"), "{said}");
    let behind = cargo_fmu(&["--platform", HOST.0, feup().to_str().unwrap()]);
    assert_eq!(behind.status.code(), Some(2));
    assert!(stderr(&behind).contains("the scene stands before --platform"), "{}", stderr(&behind));
    let said = stderr(&cargo_fmu(&["--platform", "aarch64-darwin"]));
    assert!(said.contains(&format!("platform aarch64-darwin: expected one of {}", HOST.0)), "{said}");
    assert!(said.contains("--libraries"), "{said}");
}

#[test]
fn what_is_no_library_is_refused() {
    let shipped = Shipped::new();
    shipped.put("darwin64/pounding.dylib", b"MZ no library at all");
    let said = shipped.refused(&[]);
    assert!(said.contains("pounding.dylib: ") && said.contains("no library that can be read"), "{said}");
    shipped.put("darwin64/pounding.dylib", &library("aarch64-darwin"));
    shipped.put("linux32/pounding.so", b"");
    let said = shipped.refused(&[]);
    assert!(
        said.contains("expected a library in the format MachO for X86_64") && said.contains("for I386"),
        "all: {said}"
    );
    std::fs::remove_dir_all(shipped.path("libraries/linux32")).unwrap();
    std::fs::remove_file(shipped.path("libraries/darwin64/pounding.dylib")).unwrap();
    assert!(shipped.refused(&[]).contains("cannot read"));
    std::fs::remove_dir_all(shipped.path("libraries")).unwrap();
    assert!(shipped.refused(&[]).contains("cannot read the libraries in"));
    std::fs::create_dir_all(shipped.path("libraries/other")).unwrap();
    assert!(shipped.refused(&[]).contains("no library in it; expected such as linux64/pounding.so"));
}

#[test]
fn the_library_for_arm_may_stand_alone_where_fmpy_looks() {
    let shipped = Shipped::new();
    let (output, fmu) = shipped.build("arm.fmu", &["--platform", "aarch64-linux", "--arm-in-linux64"]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert_eq!(libraries_of(&fmu), ["linux64/FeupFrames.so"]);
    assert!(files(&fmu)[1].1 == library("aarch64-linux"));
    // Nothing is wrong with it, but on this machine it cannot be tried.
    let checked = cargo_fmu(&["check", fmu.to_str().unwrap()]);
    let (said, failures) = (stdout(&checked), stdout(&checked).matches("FAILED").count());
    if !cfg!(all(target_os = "linux", target_arch = "aarch64")) {
        assert!(said.contains("the FMU has no library for this machine"), "{said}");
        assert!(failures <= 1 && !said.contains("expected a library in the format"), "{said}");
    }
    // Beside others it would be taken for Intel's.
    let windows = elsewhere(shipped.path("windows.fmu"), "win64", "dll");
    let merged = shipped.path("merged.fmu");
    let done = cargo_fmu(&["merge", fmu.to_str().unwrap(), windows.to_str().unwrap(), "-o", merged.to_str().unwrap()]);
    assert!(
        stderr(&done).contains("for Aarch64; expected a library in the format Elf for X86_64"),
        "{}",
        stderr(&done)
    );
    for options in [&["--arm-in-linux64"][..], &["--arm-in-linux64", "--platform", "win64"]] {
        let said = shipped.refused(options);
        assert!(said.contains("expected --platform aarch64-linux alone"), "{said}");
    }
}
