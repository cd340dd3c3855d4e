"""The libraries, compiled for any platform."""

import functools
import json
import os
import shutil
import sys
from dataclasses import dataclass
from pathlib import Path

from releasing import remapping
from releasing.commands import run
from releasing.places import WORK

# The programs of ci/requirements.txt lie beside their Python.
ZIGBUILD = Path(sys.executable).with_name("cargo-zigbuild")

# Where cargo-zigbuild finds zig; caches that would go to the home directory; flags of the user's that would replace
# ours.
VARIABLES = {
    "PATH": os.pathsep.join([str(ZIGBUILD.parent), os.environ.get("PATH", "")]),
    "CARGO_ZIGBUILD_CACHE_DIR": WORK / "zig",
    "ZIG_GLOBAL_CACHE_DIR": WORK / "zig/global",
    "ZIG_LOCAL_CACHE_DIR": WORK / "zig/local",
    "RUSTFLAGS": None,
    "CARGO_ENCODED_RUSTFLAGS": None,
}


@dataclass(frozen=True)
class Toolchain:
    """A rustc, and the target directory for it: what was compiled with one standard library does not fit another."""

    compiler: Path = Path("rustc")
    target: Path = WORK / "cargo"

    @property
    def variables(self):
        return {**VARIABLES, "RUSTC": self.compiler, "CARGO_TARGET_DIR": self.target}


def compile_library(platform, toolchain, libraries):
    """Compiles the library and puts it into the folder of its platform below `libraries`."""
    triple = platform.triple + (f".{platform.glibc}" if platform.glibc else "")
    cargo = [ZIGBUILD] if platform.glibc else ["cargo"]
    # Before the crates are there, their folders cannot be renamed.
    run("cargo", "fetch", "--locked", variables=toolchain.variables, aloud=True)
    run(
        *cargo,
        *"rustc --locked --release --lib --crate-type cdylib --package pounding-fmu --target".split(),
        triple,
        *flag_arguments([*platform.flags, *remapping.flags(toolchain.compiler)]),
        *("--", "--cfg", "fmi_exports"),
        variables=toolchain.variables,
        aloud=True,
    )
    library = libraries / platform.name / platform.library
    library.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(toolchain.target / platform.triple / "release" / platform.file, library)
    return library


def flag_arguments(flags):
    """Cargo's option for flags of rustc; a JSON array of strings is a TOML array of strings."""
    return ["--config", "build.rustflags=" + json.dumps(flags)]


@functools.cache
def fmu_command():
    """The program behind `cargo fmu`, compiled: many FMUs are made without asking cargo each time whether it is up to date."""
    run("cargo", "fmu", "--help", aloud=True)
    about = json.loads(run("cargo", "metadata", "--format-version", "1", "--no-deps"))
    return Path(about["target_directory"]) / "quick/cargo-fmu"
