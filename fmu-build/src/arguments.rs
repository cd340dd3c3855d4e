//! The arguments of the command line.

use crate::trial::Trial;
use clap::{Args, Subcommand};
use pounding::FmiVersion;
use std::path::PathBuf;
use std::time::Duration;

/// What is done beside building.
#[derive(Subcommand)]
pub enum Command {
    /// Opens an FMU with an independent importer, validates it and runs it; exit code 1 where anything is wrong.
    Check(CheckArguments),
    /// Makes one FMU of two that hold the same but for their libraries, which are for different platforms.
    Merge(MergeArguments),
    /// For this program itself, in a process of its own: tries an FMU.
    #[command(hide = true)]
    Trial(TrialArguments),
}

/// What is built.
#[derive(Args)]
pub struct BuildArguments {
    /// The scene; without it, the two laboratory frames of the default scene.
    #[arg(value_name = "SCENE.toml")]
    pub(crate) scene: Option<PathBuf>,
    /// Where the FMU goes, in a directory that is made if need be; without it, NAME.fmu (NAME: the scene's), or
    /// NAME.fmi3.fmu with --fmi 3, in the current directory, or in target/fmu of a checkout.
    #[arg(short, long, value_name = "FILE.fmu")]
    pub(crate) output: Option<PathBuf>,
    /// The version of FMI, 2 or 3: importers of today know 2.0, some of them 3.0 with its events.
    #[arg(long, value_name = "VERSION", default_value = "2", value_parser = version)]
    pub(crate) fmi: FmiVersion,
    /// Platforms whose library goes into the FMU, such as linux64 (or x86_64-linux), win64, aarch64-linux; without it, all
    /// there are.
    #[arg(long = "platform", value_name = "PLATFORM", num_args = 1.., value_delimiter = ',', value_parser = platform)]
    pub(crate) platforms: Vec<String>,
    /// Takes libraries that have been compiled before: PLATFORM/pounding.so, .dll or .dylib in this directory.
    #[arg(long, value_name = "DIRECTORY")]
    pub(crate) libraries: Option<PathBuf>,
    /// For FMPy on Arm Linux, which looks for linux64 in FMI 2.0: the library for Arm, which is the only one then, goes there.
    #[arg(long)]
    pub(crate) arm_in_linux64: bool,
    /// For importers that read every variable as a number (docs/importers.md): the FMU has counts and flags as numbers, and no
    /// texts; as outputs.numbers_only = true in the scene.
    #[arg(long)]
    pub(crate) numbers_only: bool,
    #[command(flatten)]
    pub(crate) limit: Limit,
}

/// What is checked.
#[derive(Args)]
pub struct CheckArguments {
    /// The FMU.
    #[arg(value_name = "FILE.fmu")]
    pub(crate) fmu: PathBuf,
    /// Findings for a program to read, as docs/check.schema.json describes them.
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) limit: Limit,
}

/// What is merged.
#[derive(Args)]
pub struct MergeArguments {
    /// One FMU.
    #[arg(value_name = "A.fmu")]
    pub(crate) one: PathBuf,
    /// The other: the same scene, built with the same version for another platform.
    #[arg(value_name = "B.fmu")]
    pub(crate) other: PathBuf,
    /// Where the merged FMU goes, in a directory that is made if need be.
    #[arg(short, long, value_name = "C.fmu")]
    pub(crate) output: PathBuf,
}

/// What is tried, and where it is unpacked.
#[derive(Args)]
pub struct TrialArguments {
    pub(crate) trial: Trial,
    pub(crate) fmu: PathBuf,
    pub(crate) directory: PathBuf,
}

#[derive(Args)]
pub(crate) struct Limit {
    /// How long the FMU may take to be tried, its run included; then it is stopped, and that is a failure.
    #[arg(long, value_name = "SECONDS", default_value = "300", value_parser = seconds)]
    pub(crate) time_limit: Duration,
}

fn version(text: &str) -> Result<FmiVersion, String> {
    match text {
        "2" => Ok(FmiVersion::V2),
        "3" => Ok(FmiVersion::V3),
        _ => Err("expected 2 or 3".to_owned()),
    }
}

fn platform(text: &str) -> Result<String, String> {
    let is_name = text.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '-' | '_')) && !text.is_empty();
    is_name.then(|| text.to_owned()).ok_or_else(|| "expected a platform; the scene stands before --platform".to_owned())
}

fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    // Far below where the clock ends.
    let seconds = seconds.filter(|seconds| !seconds.is_zero() && seconds.as_secs() < 1 << 40);
    seconds.ok_or_else(|| "expected a number of seconds > 0".to_owned())
}
