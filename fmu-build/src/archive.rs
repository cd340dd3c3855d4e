//! The zip that an FMU is, unpacked safely. It is written in `pounding-pack`.

use anyhow::{Context, Result, bail};
use pounding_pack::archive::Entry;
use std::collections::HashMap;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use zip::ZipArchive;
use zip::read::ZipFile;

/// Bytes, unpacked: no FMU of ours comes near it, and a small archive can be made to unpack to anything.
const MOST_UNPACKED: u64 = 1 << 30;

/// Bytes of a description: those of the largest building that can be solved are a tenth of it.
const LARGEST_DESCRIPTION: u64 = 1 << 26;

/// Opens an archive that every reader must understand alike: each name once, and what the directory says is what stands
/// before each file.
fn open(fmu: &Path) -> Result<ZipArchive<File>> {
    let file = File::open(fmu).with_context(|| format!("cannot open {}", fmu.display()))?;
    let mut archive = ZipArchive::new(&file)
        .with_context(|| format!("{} is not an FMU: it cannot be read as a zip archive", fmu.display()))?;
    let collisions = collisions(&names(&file, archive.central_directory_start()).context("the archive is damaged")?);
    if !collisions.is_empty() {
        bail!("{}", collisions.join("; "));
    }
    if archive.offset() != 0 {
        bail!("{} bytes stand before the archive; expected none", archive.offset());
    }
    archive.validate_header_consistency().context("the archive is damaged or says two things of one file")?;
    Ok(ZipArchive::new(file)?)
}

/// Every name in the directory of an archive, which begins there. The zip reader has the last file of each name only.
fn names(mut archive: &File, directory: u64) -> io::Result<Vec<String>> {
    let mut bytes = Vec::new();
    archive.seek(SeekFrom::Start(directory))?;
    archive.read_to_end(&mut bytes)?;
    let (mut rest, mut names) = (bytes.as_slice(), Vec::new());
    while let Some((header, behind)) = rest.split_at_checked(46).filter(|(header, _)| header.starts_with(b"PK\x01\x02"))
    {
        let length = |at: usize| usize::from(u16::from_le_bytes([header[at], header[at + 1]]));
        // The name, further fields, a comment.
        let Some((name, behind)) = behind.split_at_checked(length(28)) else { break };
        names.push(String::from_utf8_lossy(name).into_owned());
        rest = behind.get(length(30) + length(32)..).unwrap_or_default();
    }
    Ok(names)
}

/// A problem for each name that leads to the same file as one before it, here or on a system that minds neither case nor
/// dots and blanks at the end, and for each file that another name has as its folder.
fn collisions(names: &[String]) -> Vec<String> {
    let plain = |name: &String| {
        let parts = name.split(['/', '\\']).map(|part| part.trim_end_matches(['.', ' ']).to_lowercase());
        parts.filter(|part| !part.is_empty()).collect::<Vec<_>>()
    };
    let (mut seen, mut problems) = (HashMap::new(), Vec::new());
    for name in names {
        match seen.insert(plain(name), name) {
            Some(other) if other == name => problems.push(format!("{name:?}: more than once in the archive")),
            Some(other) => problems.push(format!("{name:?}: the same file as {other:?} on some systems")),
            None => {}
        }
    }
    for (parts, name) in &seen {
        let above = (1..parts.len()).filter_map(|count| seen.get(&parts[..count]));
        let files = above.filter(|above| !above.ends_with('/'));
        problems.extend(files.map(|file| format!("{name:?}: in a folder, but {file:?} is a file")));
    }
    problems
}

/// Goes through the archive: `take` gets name and file, reads it to its end, but no more than so many bytes and one,
/// and says how many; none where it does not want the file.
fn each(
    fmu: &Path,
    most: u64,
    mut take: impl FnMut(&str, &mut ZipFile<'_, File>, u64) -> io::Result<Option<u64>>,
) -> Result<()> {
    let mut archive = open(fmu)?;
    let mut rest = most;
    for index in 0..archive.len() {
        let mut file = archive.by_index(index).context("the archive is damaged")?;
        let (name, size) = (String::from_utf8_lossy(file.name_raw()).into_owned(), file.size());
        let taken = take(&name, &mut file, rest).with_context(|| format!("the archive is damaged at {name}"))?;
        let Some(taken) = taken else { continue };
        let left = rest.checked_sub(taken);
        rest = left.with_context(|| format!("{name}: more than {most} bytes in the archive up to here"))?;
        if taken != size {
            bail!("{name}: {taken} bytes, where the archive says {size}");
        }
    }
    Ok(())
}

/// The files of an FMU in memory, in their order.
pub fn entries(fmu: &Path) -> Result<Vec<Entry>> {
    let mut entries = Vec::new();
    each(fmu, MOST_UNPACKED, |name, file, most| {
        if !file.is_file() {
            return Ok(None);
        }
        let mut bytes = Vec::new();
        let taken = file.take(most + 1).read_to_end(&mut bytes)?;
        entries.push(Entry::file(name, bytes));
        Ok(Some(taken as u64))
    })?;
    Ok(entries)
}

/// An FMU in a directory.
pub struct Unpacked<'a> {
    directory: &'a Path,
    /// Every name in the archive as it stands there.
    pub names: Vec<String>,
}

impl Unpacked<'_> {
    /// Unpacks every file whose name stays inside the directory; what is wrong with the names is for the lint to say.
    pub fn open<'a>(fmu: &Path, directory: &'a Path) -> Result<Unpacked<'a>> {
        let mut names = Vec::new();
        each(fmu, MOST_UNPACKED, |name, file, most| {
            names.push(name.to_owned());
            let Some(inside) = file.enclosed_name().filter(|_| file.is_file()) else { return Ok(None) };
            extract(&mut file.take(most + 1), &directory.join(inside)).map(Some)
        })?;
        Ok(Unpacked { directory, names })
    }

    /// The directory that holds `modelDescription.xml`.
    pub fn root(&self) -> &Path {
        self.directory
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
        let size = std::fs::metadata(&path)?.len();
        if size > LARGEST_DESCRIPTION {
            bail!("modelDescription.xml has {size} bytes; expected no more than {LARGEST_DESCRIPTION}");
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
fn extract(from: &mut impl Read, to: &Path) -> io::Result<u64> {
    if let Some(folder) = to.parent() {
        std::fs::create_dir_all(folder)?;
    }
    io::copy(from, &mut File::create(to)?)
}

/// What is wrong with names of files: expected relative to the archive's root, with forward slashes, inside it.
pub fn odd_names(names: &[String]) -> Vec<String> {
    let mut findings = Vec::new();
    for name in names {
        let parts: Vec<&str> = name.trim_end_matches('/').split('/').collect();
        if name.contains('\\') {
            findings.push(format!("{name:?}: a backslash; expected forward slashes"));
        }
        if name.starts_with('/') || name.as_bytes().get(1) == Some(&b':') {
            findings.push(format!("{name:?}: an absolute path; expected one relative to the archive's root"));
        }
        if parts.iter().any(|part| matches!(*part, ".." | ".")) || parts.iter().skip(1).any(|part| part.is_empty()) {
            findings.push(format!("{name:?}: expected a plain path without empty, `.` or `..` parts"));
        }
    }
    findings
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use pounding_pack::archive::pack;

    #[test]
    fn what_unpacks_to_too_much_is_refused() {
        let archive = tempfile::NamedTempFile::new().unwrap();
        let entries = [Entry::file("a", vec![0; 600]), Entry::file("b", vec![0; 400])];
        std::fs::write(archive.path(), pack(&entries).unwrap()).unwrap();
        let read = |most| {
            let mut sizes = Vec::new();
            let result = each(archive.path(), most, |_, file, most| {
                sizes.push(io::copy(&mut file.take(most + 1), &mut io::sink())?);
                Ok(sizes.last().copied())
            });
            (sizes, result.err().map(|error| error.to_string()))
        };
        assert_eq!(read(1000), (vec![600, 400], None));
        let (sizes, error) = read(999);
        assert_eq!(sizes, [600, 400]);
        assert_eq!(error.unwrap(), "b: more than 999 bytes in the archive up to here");
        assert_eq!(read(10).0, [11], "no more is read");
    }

    #[test]
    fn names_that_lead_to_one_file_are_found() {
        let found = |names: &[&str]| collisions(&names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>());
        assert_eq!(found(&["a", "b", "c/", "c/a", "c/b", "d/a"]), [""; 0]);
        assert_eq!(found(&["a", "b", "a"]), ["\"a\": more than once in the archive"]);
        for other in ["A", "a.", "a ", "./a", "a/", "/a", "\\a", "./A. "] {
            let said = format!("{other:?}: the same file as \"a\" on some systems");
            assert_eq!(found(&["a", other]), [said]);
        }
        assert_eq!(found(&["b/a", "c", "B"]), ["\"b/a\": in a folder, but \"B\" is a file"]);
    }
}
