"""The Debian packages that a release needs. Which are missing is said at once; installing them is the user's."""

import importlib.util
import platform
import re
import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

from releasing.commands import Failure
from releasing.places import ROOT

# The loader, which libc6-arm64-cross installs, and the folder in which qemu looks for it and the C library.
ARM_ROOT = Path("/usr/aarch64-linux-gnu")


@dataclass(frozen=True)
class Need:
    package: str
    purpose: str
    is_there: Callable[[], bool]
    platform: str | None = None  # the one that it is for; without it nothing can be released at all


def command(name):
    return lambda: shutil.which(name) is not None


def wine():
    """Of Debian's wine64 nothing is on the path unless the package wine is there too."""
    return first_program("/usr/lib/wine/wine64", "wine64", "wine")


def wine_server():
    return first_program("/usr/lib/wine/wineserver64", "wineserver")


def first_program(*names):
    return next(filter(None, map(shutil.which, names)), None)


NEEDS = (
    Need("gcc", "links what runs while cargo builds", command("cc")),
    Need("python3-venv", "holds the packages of ci/requirements.txt", lambda: importlib.util.find_spec("ensurepip")),
    Need("gcc-mingw-w64-x86-64-posix", "links the library for Windows", command("x86_64-w64-mingw32-gcc"), "win64"),
    Need("wine64", "runs the library for Windows", wine, "win64"),
    Need("qemu-user", "runs the library for Arm", command("qemu-aarch64"), "aarch64-linux"),
    Need(
        "libc6-arm64-cross",
        "the C library of Arm, for qemu",
        lambda: (ARM_ROOT / "lib/ld-linux-aarch64.so.1").exists(),
        "aarch64-linux",
    ),
)
EVERYWHERE = tuple(need for need in NEEDS if need.platform is None)


def missing(needs=NEEDS):
    return [need for need in needs if not need.is_there()]


def missing_for(platform):
    """The packages without which the library for a platform is not compiled and run here."""
    return [need.package for need in missing() if need.platform == platform.name]


def blanks_in(folder):
    if not re.search(r"\s", str(folder)):
        return []
    return [f"{folder}: the checkout has to be in a path without blanks, which dlltool of mingw cannot read"]


def require(needs=NEEDS):
    """Fails with everything that is missing."""
    if (platform.system(), platform.machine()) != ("Linux", "x86_64"):
        raise Failure(
            "ci/release runs on Linux with an x86-64 processor; elsewhere ci/native builds the library of the machine"
        )
    problems = blanks_in(ROOT)
    if not shutil.which("cargo"):
        problems.append("Rust is missing: cargo is not on the path")
    packages = missing(needs)
    if packages:
        problems.append("Debian packages are missing:")
        problems += [f"  {need.package:<28}{need.purpose}" for need in packages]
        problems.append("install them: apt-get install " + " ".join(need.package for need in packages))
    if problems:
        raise Failure("\n".join(problems))
