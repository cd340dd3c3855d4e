//! The checkout: where it is, and the library that cargo compiles from it.

use anyhow::{Context, Result, bail};
use fmu_build::host_folder;
use fmu_build::libraries::{Libraries, Library, chosen};
use pounding::FmiVersion;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

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
            None => bail!("this is not a checkout of pounding-fmu: run cargo fmu inside one"),
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
        let compiled = fmu_start::compile(&self.root, cfg!(feature = "check"), show).context("the library")?;
        let path = compiled.library().context("cargo did not say where it put the library")?;
        let bytes = std::fs::read(path).with_context(|| format!("cannot read {}", path.display()))?;
        Ok(vec![Library::new(folder, bytes)])
    }
}

fn located_from_here() -> Option<PathBuf> {
    let output = Command::new(fmu_start::cargo())
        .args(["locate-project", "--workspace", "--message-format", "plain"])
        .stdin(Stdio::null())
        .output()
        .ok()?;
    let manifest = PathBuf::from(String::from_utf8(output.stdout).ok()?.trim_end());
    manifest.parent().map(Path::to_path_buf)
}
