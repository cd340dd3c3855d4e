//! `cargo fmu merge`: one FMU with the libraries of two that are the same otherwise.

use crate::archive::{self, odd_names};
use crate::bounded::Bounded;
use crate::destination::Destination;
use crate::inspection;
use crate::sight::{model_identifier, origin, version};
use anyhow::{Context, Result, bail};
use pounding::FmiVersion;
use pounding_pack::archive::{Entry, pack};
use pounding_simulate::written::is_same_file;
use std::collections::BTreeMap;
use std::path::Path;

const DESCRIPTION: &str = "modelDescription.xml";
const LIBRARIES: &str = "binaries/";

/// Merges two FMUs and returns what there is to say about it. Neither is changed, and which is named first makes no
/// difference to the bytes.
pub fn merge(fmus: [&Path; 2], output: &Path) -> Result<String> {
    for fmu in fmus {
        if is_same_file(fmu, output) {
            bail!("-o {} is one of the FMUs to merge: expected another file", output.display());
        }
    }
    let [one, other] = fmus.map(Source::open);
    let (mut one, mut other) = match (one, other) {
        (Ok(one), Ok(other)) => (one, other),
        (Err(one), Err(other)) => bail!("{one:#}\n{other:#}"),
        (Err(error), _) | (_, Err(error)) => return Err(error),
    };
    if one.version != other.version {
        let [of_one, of_other] =
            [&one, &other].map(|source| format!("{} is FMI {}", source.name, source.version.name()));
        bail!("{of_one} and {of_other}: expected two FMUs of one version");
    }
    let problems = [different_files(&one, &other), same_platforms(&one, &other)].concat();
    if !problems.is_empty() {
        bail!("{} and {} cannot be merged:\n{}", one.name, other.name, problems.join("\n"));
    }
    if other.libraries < one.libraries {
        std::mem::swap(&mut one, &mut other);
    }
    let entries = merged(one, other);
    let destination = Destination::open(output.to_path_buf())?;
    let draft = destination.draft(&pack(&entries)?)?;
    destination.take(draft)?;
    Ok(report(&destination, &entries))
}

/// One of the FMUs.
struct Source {
    /// As it was named on the command line.
    name: String,
    version: FmiVersion,
    /// In the order of the archive.
    common: Vec<Entry>,
    /// By path.
    libraries: BTreeMap<String, Vec<u8>>,
}

impl Source {
    /// Reads an FMU, or says everything that keeps it from being merged with any other.
    fn open(fmu: &Path) -> Result<Source> {
        let name = fmu.display().to_string();
        let entries = archive::entries(fmu).with_context(|| name.clone())?;
        let names: Vec<String> = entries.iter().map(|entry| entry.path.clone()).collect();
        let (libraries, common): (Vec<Entry>, Vec<Entry>) = entries.into_iter().partition(is_library);
        let mut problems = odd_names(&names);
        let description = common.iter().find(|entry| entry.path == DESCRIPTION);
        let description = description.map(|entry| String::from_utf8_lossy(&entry.bytes));
        let version = description.as_ref().map_or_else(FmiVersion::default, |text| version(text));
        match &description {
            Some(description) => problems.extend(wrong_libraries(description, &libraries)),
            None => problems.push(format!("this is not an FMU: it has no {DESCRIPTION} at its root")),
        }
        if libraries.is_empty() {
            problems.push(format!("no library in {LIBRARIES}"));
        }
        if !problems.is_empty() {
            bail!("{name}: {}", Bounded::from(problems).listed().join("; "));
        }
        let libraries = libraries.into_iter().map(|library| (library.path, library.bytes)).collect();
        Ok(Source { name, version, common, libraries })
    }

    fn file(&self, path: &str) -> Option<&Entry> {
        self.common.iter().find(|entry| entry.path == path)
    }

    /// The folders of the libraries below `binaries/`.
    fn platforms(&self) -> impl Iterator<Item = &str> {
        self.libraries.keys().map(|path| platform(path))
    }
}

/// What is wrong with the libraries beside a description, which ought to be that of an FMU of ours.
fn wrong_libraries(description: &str, libraries: &[Entry]) -> Vec<String> {
    if let Err(error) = origin(description) {
        return vec![format!("{error:#}")];
    }
    let Some(identifier) = model_identifier(description) else {
        return vec![format!("{DESCRIPTION} has no co-simulation interface with a modelIdentifier")];
    };
    // It has company in the merged FMU.
    let inspect =
        |library: &Entry| inspection::inspect(&library.path, &library.bytes, &identifier, version(description), false);
    let findings = libraries.iter().map(inspect);
    findings.flat_map(|findings| [findings.library, findings.functions].concat()).collect()
}

fn is_library(entry: &Entry) -> bool {
    entry.path.starts_with(LIBRARIES)
}

fn platform(path: &str) -> &str {
    path.split('/').nth(1).unwrap_or_default()
}

/// A problem for each file, but for the libraries, that is not the same in both.
fn different_files(one: &Source, other: &Source) -> Vec<String> {
    let only_in = |here: &Source, there: &Source| {
        let alone = here.common.iter().filter(|file| there.file(&file.path).is_none());
        alone.map(|file| format!("  {}: only in {}", file.path, here.name)).collect::<Vec<_>>()
    };
    let in_both = one.common.iter().filter_map(|file| Some((file, other.file(&file.path)?)));
    let different = in_both.filter(|(file, there)| file.bytes != there.bytes);
    let different = different.map(|(file, there)| {
        let line = first_difference(&file.bytes, &there.bytes);
        format!("  {}: different from line {line} on", file.path)
    });
    different.chain(only_in(one, other)).chain(only_in(other, one)).collect()
}

/// The first line that differs, counted from 1.
fn first_difference(one: &[u8], other: &[u8]) -> usize {
    let same = one.iter().zip(other).take_while(|(one, other)| one == other);
    same.filter(|(byte, _)| **byte == b'\n').count() + 1
}

/// A problem for each platform that both have a library for: which one should importers get?
fn same_platforms(one: &Source, other: &Source) -> Vec<String> {
    let both = one.platforms().filter(|platform| other.platforms().any(|there| there == *platform));
    both.map(|platform| format!("  {LIBRARIES}{platform}: in both; expected libraries for different platforms"))
        .collect()
}

/// The files of both: the libraries, by path, behind the description, where an FMU with one library has it.
fn merged(one: Source, other: Source) -> Vec<Entry> {
    let libraries = BTreeMap::from_iter(one.libraries.into_iter().chain(other.libraries));
    let libraries = libraries.into_iter().map(|(path, bytes)| Entry::library(&path, bytes));
    let (description, others): (Vec<Entry>, Vec<Entry>) =
        one.common.into_iter().partition(|entry| entry.path == DESCRIPTION);
    description.into_iter().chain(libraries).chain(others).collect()
}

fn report(destination: &Destination, entries: &[Entry]) -> String {
    let platforms: Vec<&str> = entries.iter().filter(|entry| is_library(entry)).map(|e| platform(&e.path)).collect();
    format!("  file         {}\n  libraries    {}\n", destination.describe(), platforms.join(", "))
}
