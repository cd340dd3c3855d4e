//! The zip that an FMU is: written reproducibly, unpacked safely.

use anyhow::{Context, Result, bail};
use std::fs::File;
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};
use tempfile::TempDir;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipArchive, ZipWriter};

/// A file inside an FMU.
pub struct Entry {
    path: String,
    bytes: Vec<u8>,
    permissions: u32,
}

impl Entry {
    /// A file to read; `path` with forward slashes, relative to the FMU's root.
    pub fn file(path: &str, bytes: Vec<u8>) -> Entry {
        Entry { path: path.into(), bytes, permissions: 0o644 }
    }

    /// A shared library.
    pub fn library(path: &str, bytes: Vec<u8>) -> Entry {
        Entry { path: path.into(), bytes, permissions: 0o755 }
    }
}

/// The bytes of a zip of these entries in this order. They depend on nothing else: no clock, no owner, no umask.
pub fn pack(entries: &[Entry]) -> Result<Vec<u8>> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .compression_level(Some(6))
        .last_modified_time(DateTime::default());
    for entry in entries {
        zip.start_file(entry.path.as_str(), options.unix_permissions(entry.permissions))?;
        zip.write_all(&entry.bytes)?;
    }
    Ok(zip.finish()?.into_inner())
}

/// An FMU in a temporary directory, which goes when this is dropped.
pub struct Unpacked {
    directory: TempDir,
    /// Every name in the archive as it stands there.
    pub names: Vec<String>,
}

impl Unpacked {
    /// Unpacks every file whose name stays inside the directory; what is wrong with the names is for the lint to say.
    pub fn open(fmu: &Path) -> Result<Unpacked> {
        let file = File::open(fmu).with_context(|| format!("cannot open {}", fmu.display()))?;
        let mut archive = ZipArchive::new(file)
            .with_context(|| format!("{} is not an FMU: it cannot be read as a zip archive", fmu.display()))?;
        let directory = TempDir::with_prefix("fmu-").context("cannot make a temporary directory")?;
        let mut names = Vec::new();
        for index in 0..archive.len() {
            let mut file = archive.by_index(index).context("the archive is damaged")?;
            let name = String::from_utf8_lossy(file.name_raw()).into_owned();
            if let Some(inside) = file.enclosed_name().filter(|_| file.is_file()) {
                let target = directory.path().join(inside);
                extract(&mut file, &target).with_context(|| format!("the archive is damaged at {name}"))?;
            }
            names.push(name);
        }
        Ok(Unpacked { directory, names })
    }

    /// The directory that holds `modelDescription.xml`.
    pub fn root(&self) -> &Path {
        self.directory.path()
    }

    /// A file of the FMU.
    pub fn path(&self, relative: &str) -> PathBuf {
        self.root().join(relative)
    }

    /// The text of `modelDescription.xml`.
    pub fn description(&self) -> Result<String> {
        let path = self.path("modelDescription.xml");
        if !path.is_file() {
            bail!("this is not an FMU: it has no modelDescription.xml at its root");
        }
        std::fs::read_to_string(&path).context("modelDescription.xml cannot be read")
    }
}

/// URI of the `resources` directory of an FMU unpacked in `root`, as importers hand it to the FMU.
pub fn resource_uri(root: &Path) -> String {
    let path = root.join("resources").to_string_lossy().replace('\\', "/");
    let rooted = if path.starts_with('/') { path } else { format!("/{path}") };
    format!("file://{}", rooted.replace('%', "%25").replace(' ', "%20"))
}

/// Copies one file of the archive; the zip reader compares its checksum at the end.
fn extract(from: &mut impl std::io::Read, to: &Path) -> Result<()> {
    if let Some(folder) = to.parent() {
        std::fs::create_dir_all(folder)?;
    }
    std::io::copy(from, &mut File::create(to)?)?;
    Ok(())
}
