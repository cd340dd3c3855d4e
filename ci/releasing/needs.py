"""What each published file needs, read from the file itself, and the checksums of all."""

import hashlib
import re
import zipfile

from releasing import archives, reading

LIBRARIES = (".so", ".dll", ".dylib", ".pyd")


def of(path):
    """One line."""
    if path.suffix in LIBRARIES:
        return of_library(reading.read(path))
    if path.suffix in (".fmu", ".whl"):
        return of_archive(path)
    return "a browser, no network" if path.suffix == ".html" else ""


def of_library(library):
    processor = f"{library.machine} processor"
    if library.format == reading.ELF:
        newest = library.newest_glibc()
        return f"Linux, {processor}, " + (f"glibc {newest[0]}.{newest[1]} or later" if newest else "any C library")
    if library.format == reading.PE:
        return f"Windows, {processor}; uses {', '.join(sorted(library.libraries))}"
    return f"macOS {library.minimum_system} or later, {processor}"


def of_archive(path):
    """A wheel needs what its Python module needs; an FMU is for each platform of which it has the library."""
    with zipfile.ZipFile(path) as archive:
        if path.suffix == ".whl":
            modules = [of_member(archive, name) for name in archives.python_modules(archive)]
            return "; ".join([python_of(archive), *modules])
        return "; ".join(f"{name.split('/')[1]}: {of_member(archive, name)}" for name in archives.libraries(archive))


def python_of(archive):
    metadata = next(name for name in archive.namelist() if name.endswith(".dist-info/METADATA"))
    version = re.search(r"^Requires-Python: *>= *(\S+)$", archive.read(metadata).decode(), re.MULTILINE)
    return f"Python {version[1]} or later" if version else "Python"


def of_member(archive, name):
    return of_library(reading.read_bytes(archive.read(name), name))


def write(folder):
    """Writes NEEDS and SHA256SUMS beside the files and returns the lines of NEEDS."""
    written = {"NEEDS", "SHA256SUMS"}
    files = sorted(path for path in folder.rglob("*") if path.is_file() and path.name not in written)
    names = [path.relative_to(folder).as_posix() for path in files]
    width = max(map(len, names), default=0)
    lines = [f"{name:<{width}}  {of(path)}".rstrip() for name, path in zip(names, files)]
    (folder / "NEEDS").write_text("\n".join(lines) + "\n")
    sums = [f"{hashlib.sha256((folder / name).read_bytes()).hexdigest()}  {name}" for name in [*names, "NEEDS"]]
    (folder / "SHA256SUMS").write_text("\n".join(sums) + "\n")
    return lines
