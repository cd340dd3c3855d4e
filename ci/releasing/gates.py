"""What a library must be to be published. Each gate returns what is wrong, a line each; none is good.

`library` is what `reading.read` says about the file, `platform` an entry of `platforms.py`.
"""

import re

from releasing.places import ROOT

LIST_OF_FUNCTIONS = ROOT / "fmu-build/src/functions.rs"


def functions_of_fmi():
    """The 44 names of FMI 2.0 and the 75 of FMI 3.0, from the lists that `cargo fmu check` has."""
    return frozenset(re.findall(r'^\s+"(fmi[23]\w+)",$', LIST_OF_FUNCTIONS.read_text(), re.MULTILINE))


def machine(library, platform):
    """The file is for the processor of its platform."""
    if library.machine == platform.machine:
        return []
    return [f"made for {library.machine}, expected {platform.machine}"]


def exports(library, functions):
    """Exactly the functions of FMI 2.0 and 3.0."""
    missing = [f"{name} is not exported" for name in sorted(functions - library.exports)]
    return missing + [f"{name} is exported and no function of FMI" for name in sorted(library.exports - functions)]


def system_libraries(library, platform):
    """What it needs is on every machine of the platform."""
    return [
        f"needs {name}, which is no part of the system"
        for name in sorted(library.libraries - set(platform.system_libraries))
    ]


def symbol_versions(library, platform):
    """It loads with the glibc that it was linked for, and is said to."""
    newest = library.newest_glibc()
    if platform.glibc is None or newest is None:
        return []
    allowed = tuple(map(int, platform.glibc.split(".")))
    if newest <= allowed:
        return []
    return [f"needs GLIBC_{'.'.join(map(str, newest))}, expected none above {platform.glibc}"]


def stripped(library):
    return [] if library.is_stripped else ["has symbols or debug information: not stripped"]


def private_paths(content, paths):
    """No path of the machine that compiled it is in the bytes."""
    found = []
    for path in paths:
        for spelling in {path, path.replace("\\", "/"), path.replace("/", "\\")}:
            position = re.search(pattern(spelling), content)
            if position:
                around = content[max(position.start() - 20, 0) : position.end() + 60]
                found.append(f"contains the path {path}: {around!r}")
                break
    return found


def pattern(path):
    """A path, then a separator. One of a single word may be a folder in another path: a name before it excludes it."""
    text = re.escape(path.rstrip("/\\").encode())
    is_single = len(re.findall(r"[^/\\]+", path)) < 2
    return (rb"(?<![\w.\-])" if is_single else rb"") + text + rb"[/\\]"


def of_file(path, library, platform, private):
    """All of them, for one file."""
    problems = [
        *machine(library, platform),
        *exports(library, functions_of_fmi()),
        *system_libraries(library, platform),
        *symbol_versions(library, platform),
        *stripped(library),
        *private_paths(path.read_bytes(), private),
    ]
    return [f"{platform.name}/{path.name}: {problem}" for problem in problems]
