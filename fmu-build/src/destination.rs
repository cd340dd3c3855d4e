//! Where an FMU goes: it takes its place at once and whole, or not at all.

use anyhow::{Context, Result, bail};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// The path of an FMU that is to be written.
pub struct Destination {
    path: PathBuf,
    folder: PathBuf,
    _made: MadeFolders,
}

impl Destination {
    /// Makes sure that a file can be written there. Its directory is made if there is none, and goes again with this if
    /// nothing has been put there.
    pub fn open(path: PathBuf) -> Result<Destination> {
        match std::fs::metadata(&path) {
            Ok(there) if there.is_dir() => {
                bail!("{} is a directory: expected the path of the FMU file", path.display());
            }
            Err(error) if error.kind() == ErrorKind::InvalidFilename => {
                return Err(error).with_context(|| format!("cannot write {}", path.display()));
            }
            Ok(_) | Err(_) => {}
        }
        if !is_fmu(&path) {
            let stem = path.with_extension("");
            let right = if is_fmu(&stem) { stem } else { path.with_extension("fmu") };
            bail!("{}: expected a name that ends in .fmu, such as {}", path.display(), right.display());
        }
        let folder = match path.parent() {
            Some(parent) if parent != Path::new("") => parent.to_path_buf(),
            _ => PathBuf::from("."),
        };
        let made = MadeFolders::make(&folder).with_context(|| format!("cannot write to {}", folder.display()))?;
        let destination = Destination { path, folder, _made: made };
        destination.open_draft()?;
        Ok(destination)
    }

    /// A file of these bytes beside the path, which goes when it is dropped.
    pub fn draft(&self, bytes: &[u8]) -> Result<NamedTempFile> {
        let mut draft = self.open_draft()?;
        let written = draft.write_all(bytes).and_then(|()| draft.flush());
        written.with_context(|| format!("cannot write {}", self.path.display()))?;
        Ok(draft)
    }

    /// Puts a draft in its place, where an older file may be.
    pub fn take(&self, draft: NamedTempFile) -> Result<()> {
        draft.persist(&self.path).with_context(|| format!("cannot write {}", self.path.display()))?;
        Ok(())
    }

    /// The path as seen from the current directory, and the size of the file.
    pub fn describe(&self) -> String {
        let size = std::fs::metadata(&self.path).map_or(0, |file| file.len());
        let here = std::env::current_dir().unwrap_or_default();
        let shown = self.path.strip_prefix(here).unwrap_or(&self.path).display();
        format!("{shown} ({} kB)", size.div_ceil(1000))
    }

    fn open_draft(&self) -> Result<NamedTempFile> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(".fmu-").suffix(".part");
        // As any file that a program writes, readable by others where the umask allows it.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        builder.tempfile_in(&self.folder).with_context(|| format!("cannot write to {}", self.folder.display()))
    }
}

/// Whether a path has the extension by which importers know FMUs.
fn is_fmu(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("fmu"))
}

/// Directories that were not there before, the outermost first. Those that are still empty go when this is dropped.
struct MadeFolders(Vec<PathBuf>);

impl MadeFolders {
    fn make(folder: &Path) -> std::io::Result<MadeFolders> {
        let missing = folder.ancestors().take_while(|above| *above != Path::new("") && !above.exists());
        let mut made = MadeFolders(missing.map(Path::to_path_buf).collect());
        made.0.reverse();
        std::fs::create_dir_all(folder)?;
        Ok(made)
    }
}

impl Drop for MadeFolders {
    fn drop(&mut self) {
        for folder in self.0.iter().rev() {
            // One with something in it stays.
            let _ = std::fs::remove_dir(folder);
        }
    }
}
