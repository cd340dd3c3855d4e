//! The checkout: where it is, and the library that cargo compiles from it.

use anyhow::{Context, Result, bail};
use fmu_build::host_folder;
use fmu_build::libraries::{Libraries, Library, chosen};
use pounding::FmiVersion;
use serde::Deserialize;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The package whose library goes into the FMU.
const PACKAGE: &str = "pounding-fmu";

/// The checkout.
pub struct Workspace {
    root: PathBuf,
}

impl Workspace {
    /// Of the current directory; else the one that this program was compiled in.
    pub fn find() -> Result<Workspace> {
        let here = located_from_here();
        let compiled_in = Path::new(env!("CARGO_MANIFEST_DIR")).parent().map(Path::to_path_buf);
        let ours = |root: &PathBuf| root.join("fmu-build/Cargo.toml").is_file();
        match here.into_iter().chain(compiled_in).find(ours) {
            Some(root) => Ok(Workspace { root }),
            None => bail!("this is not a checkout of {PACKAGE}: run cargo fmu inside one"),
        }
    }

    /// The scene that is built when none is given.
    pub fn default_scene(&self) -> PathBuf {
        self.root.join("examples/scenes/feup.toml")
    }

    /// Where FMUs go when no place is given.
    pub fn fmus(&self) -> PathBuf {
        self.root.join("target/fmu")
    }

    /// Compiles the library in its release profile and returns where it is; `show` gets what cargo is at.
    ///
    /// Naming the target, even this machine's, gives it a directory of its own: no other command compiles for it, nor with
    /// these flags.
    fn compile_library(&self, show: impl FnMut(&str)) -> Result<PathBuf> {
        let mut cargo = self.cargo("rustc");
        cargo
            .args(["--release", "--lib", "--crate-type", "cdylib", "--package", PACKAGE, "--target", &self.host()?])
            .arg("--message-format=json-render-diagnostics")
            .args(["--config", &path_remapping(&self.root)?, "--", "--cfg", "fmi_exports"]);
        let done = fmu_start::watch(cargo, show).context("cannot start cargo")?;
        if !done.status.success() {
            bail!("the library does not compile:\n{}", done.complaints.trim_end());
        }
        done.output.lines().find_map(dynamic_library).context("cargo did not say where it put the library")
    }

    /// The target triple of this machine, as the toolchain calls it.
    fn host(&self) -> Result<String> {
        let output = self.cargo("--version").arg("--verbose").output().context("cannot start cargo")?;
        let text = String::from_utf8_lossy(&output.stdout);
        let host = text.lines().find_map(|line| line.strip_prefix("host: "));
        Ok(host.context("cargo --version --verbose names no host")?.to_owned())
    }

    fn cargo(&self, command: &str) -> Command {
        let mut cargo = Command::new(cargo());
        cargo.arg(command).current_dir(&self.root).stdin(Stdio::null());
        cargo
    }
}

impl Libraries for Workspace {
    fn work(&self) -> &'static str {
        "compiling the library"
    }

    fn get(&self, _version: FmiVersion, platforms: &[String], show: &mut dyn FnMut(&str)) -> Result<Vec<Library>> {
        let folder = host_folder();
        chosen(platforms, std::slice::from_ref(&folder)).context(
            "without --libraries there is the library that is compiled here, for this machine's own platform",
        )?;
        let path = self.compile_library(show)?;
        let bytes = std::fs::read(&path).with_context(|| format!("cannot read {}", path.display()))?;
        Ok(vec![Library::new(folder, bytes)])
    }
}

/// The cargo that runs this program, else the one on the path.
fn cargo() -> std::ffi::OsString {
    std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

fn located_from_here() -> Option<PathBuf> {
    let output = Command::new(cargo())
        .args(["locate-project", "--workspace", "--message-format", "plain"])
        .stdin(Stdio::null())
        .output()
        .ok()?;
    let manifest = PathBuf::from(String::from_utf8(output.stdout).ok()?.trim_end());
    manifest.parent().map(Path::to_path_buf)
}

/// The shared library in one of cargo's messages.
fn dynamic_library(message: &str) -> Option<PathBuf> {
    #[derive(Deserialize)]
    struct Message {
        reason: String,
        #[serde(default)]
        target: Target,
        #[serde(default)]
        filenames: Vec<PathBuf>,
    }
    #[derive(Deserialize, Default)]
    struct Target {
        crate_types: Vec<String>,
    }
    let message: Message = serde_json::from_str(message).ok()?;
    if message.reason != "compiler-artifact" || !message.target.crate_types.iter().any(|kind| kind == "cdylib") {
        return None;
    }
    message.filenames.into_iter().find(|file| file.extension().is_some_and(|e| e == std::env::consts::DLL_EXTENSION))
}

/// Cargo configuration that keeps the paths of this machine out of the library: whoever builds a scene, wherever the
/// checkout lies, gets the same bytes and gives no home directory away.
fn path_remapping(root: &Path) -> Result<String> {
    let cargo_home = std::env::var_os("CARGO_HOME").map(PathBuf::from);
    let cargo_home = cargo_home.or_else(|| std::env::home_dir().map(|home| home.join(".cargo")));
    let prefixes = cargo_home.iter().map(|home| (home.as_path(), "/cargo")).chain([(root, "/pounding-fmu")]);
    let flags: Vec<String> =
        prefixes.map(|(path, name)| format!("--remap-path-prefix={}={name}", path.display())).collect();
    // A JSON array of strings is a TOML array of strings.
    Ok(format!("build.rustflags={}", serde_json::to_string(&flags)?))
}
