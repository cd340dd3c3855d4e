"""The libraries, compiled for any platform."""

import json
import os
import shutil
import sys
from pathlib import Path

from releasing import remapping
from releasing.commands import run
from releasing.places import WORK

# The programs of ci/requirements.txt lie beside their Python.
ZIGBUILD = Path(sys.executable).with_name("cargo-zigbuild")

# Where cargo-zigbuild finds zig; caches that would go to the home directory; flags of the user's that would replace ours.
VARIABLES = {
    "PATH": os.pathsep.join([str(ZIGBUILD.parent), os.environ.get("PATH", "")]),
    "CARGO_TARGET_DIR": WORK / "cargo",
    "CARGO_ZIGBUILD_CACHE_DIR": WORK / "zig",
    "ZIG_GLOBAL_CACHE_DIR": WORK / "zig/global",
    "ZIG_LOCAL_CACHE_DIR": WORK / "zig/local",
    "RUSTFLAGS": None,
    "CARGO_ENCODED_RUSTFLAGS": None,
}


def compile_library(platform, compiler, libraries):
    """Compiles the library and puts it into the folder of its platform below `libraries`."""
    triple = platform.triple + (f".{platform.glibc}" if platform.glibc else "")
    cargo = [ZIGBUILD] if platform.glibc else ["cargo"]
    run(*cargo, "rustc", "--release", "--lib", "--crate-type", "cdylib", "--package", "pounding-fmu", "--target", triple,
        *flag_arguments([*platform.flags, *remapping.flags(compiler)]), "--", "--cfg", "fmi_exports",
        variables={**VARIABLES, "RUSTC": compiler}, aloud=True)
    library = libraries / platform.name / platform.library
    library.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(WORK / "cargo" / platform.triple / "release" / platform.file, library)
    return library


def flag_arguments(flags):
    """Cargo's option for flags of rustc; a JSON array of strings is a TOML array of strings."""
    return ["--config", "build.rustflags=" + json.dumps(flags)]
