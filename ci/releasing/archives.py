"""Wheels and FMUs: the gates for what is in them."""

import re
import zipfile

from releasing import gates, reading


def check(path, platform, private):
    """No member has a path of the machine, and what Python loads from a wheel is fit for its platform."""
    problems = []
    with zipfile.ZipFile(path) as archive:
        modules = python_modules(archive)
        for name in archive.namelist():
            content = archive.read(name)
            found = gates.private_paths(content, private)
            if name in modules:
                module = reading.read_bytes(content, name)
                found += [
                    *gates.machine(module, platform),
                    *gates.symbol_versions(module, platform),
                    *gates.stripped(module),
                ]
            problems += [f"{path.name}: {name} {problem}" for problem in found]
    return problems


def python_modules(archive):
    """What Python loads, as opposed to the libraries for FMUs, which are data."""
    return [name for name in archive.namelist() if re.fullmatch(r"\w+/\w+(\.abi3)?\.(so|pyd)", name)]


def libraries(archive):
    """The libraries in an FMU."""
    return sorted(name for name in archive.namelist() if re.fullmatch(r"binaries/[^/]+/[^/]+", name))
