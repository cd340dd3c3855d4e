"""The standard library of Rust for other platforms: rustup's, or built from Debian's sources of the same version."""

import shutil
import subprocess
from pathlib import Path

from releasing import debian_sources
from releasing.cargo import Toolchain, flag_arguments
from releasing.commands import Failure, run
from releasing.places import WORK
from releasing.remapping import flags

FOLDER = WORK / "std"
# The last one is for unit tests.
CRATES = "std,panic_unwind,test"


def toolchain(platforms, source):
    """One that has the standard libraries of the platforms; `source` is auto, rustup or debian."""
    if source == "debian":
        return from_debian(platforms)
    missing = [platform.triple for platform in platforms if not has_library(platform.triple)]
    if missing and not (shutil.which("rustup") and added(missing)):
        if source == "rustup":
            raise Failure("rustup has no standard library for " + ", ".join(missing))
        return from_debian(platforms)
    return Toolchain()


def has_library(triple):
    return any(Path(run("rustc", "--print", "target-libdir", "--target", triple).strip()).glob("libstd-*.rlib"))


def added(triples):
    return subprocess.run(["rustup", "target", "add", *triples], capture_output=True).returncode == 0


def from_debian(platforms):
    """One with a system root of its own: links to what the installed rustc has for this machine, and what is built."""
    root, installed = FOLDER / "root", Path(run("rustc", "--print", "sysroot").strip())
    host = next(line.split()[1] for line in run("rustc", "-vV").splitlines() if line.startswith("host:"))
    link(root / "lib/rustlib" / host, installed / "lib/rustlib" / host)
    link(root / "lib/rustlib/src/rust/library", debian_sources.library())
    compiler = FOLDER / "rustc"
    compiler.write_text(f'#!/bin/sh\nexec "{installed}/bin/rustc" --sysroot "{root}" "$@"\n')
    compiler.chmod(0o755)
    toolchain = Toolchain(compiler, WORK / "cargo-debian")
    for platform in platforms:
        if platform.triple != host:
            build(platform.triple, toolchain, root)
    return toolchain


def build(triple, toolchain, root):
    """Builds the standard library so that it can be optimised together with the crates that use it."""
    version = run("rustc", "-V") + CRATES
    built = root / "lib/rustlib" / triple / "lib"
    stamp = built / "built-by"
    if stamp.exists() and stamp.read_text() == version:
        return
    crate = FOLDER / "empty"
    (crate / "src").mkdir(parents=True, exist_ok=True)
    (crate / "src/lib.rs").touch()
    (crate / "Cargo.toml").write_text('[package]\nname = "empty"\nedition = "2021"\n[workspace]\n')
    target = FOLDER / "build"
    for outdated in (target, toolchain.target):
        shutil.rmtree(outdated / triple, ignore_errors=True)
    # The compiler lets only its developers build the standard library, unless it is told that it is at work for them.
    run(
        *f"cargo build --release -Zbuild-std={CRATES} --target".split(),
        *(triple, "--target-dir", target),
        *flag_arguments(["-Cembed-bitcode=yes", *flags(toolchain.compiler)]),
        variables={**toolchain.variables, "RUSTC_BOOTSTRAP": "1"},
        folder=crate,
        aloud=True,
    )
    shutil.rmtree(built, ignore_errors=True)
    built.mkdir(parents=True)
    for file in (target / triple / "release/deps").glob("*.rlib"):
        if not file.name.startswith("libempty-"):
            shutil.copy(file, built)
    stamp.write_text(version)


def link(link, target):
    link.parent.mkdir(parents=True, exist_ok=True)
    link.unlink(missing_ok=True)
    link.symlink_to(target)
