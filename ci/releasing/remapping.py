"""Paths of this machine, which must not be in a library, and what stands there instead."""

from pathlib import Path

from releasing.commands import run
from releasing.places import ROOT, cargo_home


def flags(compiler):
    """Flags of rustc that rename the checkout, the sources of the crates and those of the standard library.

    The last one that fits counts. The standard library gets the names that it has in the toolchain's own builds.
    """
    facts = dict(line.split(": ", 1) for line in run(compiler, "-vV").splitlines() if ": " in line)
    sources = Path(run(compiler, "--print", "sysroot").strip()) / "lib/rustlib/src/rust"
    official = "/rustc/" + facts["commit-hash"]
    names = {cargo_home(): "/cargo", ROOT: "/pounding-fmu", sources: official}
    # The folder of the crates is called like the server that they came from: the same bytes wherever that is.
    names |= {folder: "/cargo/registry" for folder in (cargo_home() / "registry/src").glob("*")}
    library = sources / "library"
    if library.is_symlink():
        names[library.resolve()] = official + "/library"
    return [f"--remap-path-prefix={path}={name}" for path, name in names.items()]


def private_paths():
    """What no published file may contain."""
    return sorted({str(ROOT), str(Path.home()), str(cargo_home())})
