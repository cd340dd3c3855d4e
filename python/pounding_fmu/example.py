"""The command ``pounding-fmu example``: the scenes that come with this package."""

from __future__ import annotations

import argparse
import re
from pathlib import Path

from . import _native
from ._data import DATA
from ._scenes import unknown

# In scenes of the package records lie beside the folder of scenes; what is written has them below its own.
RECORD = re.compile(r'^(record *= *")\.\./(records/[^"]+)"', re.MULTILINE)


def main(arguments: list[str]) -> int:
    parser = argparse.ArgumentParser(prog="pounding-fmu example", description="Writes one of the scenes that come with this package.")
    parser.add_argument("name", nargs="?", metavar="NAME", help="the scene to write; without it, all are listed")
    parser.add_argument(
        "-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where it goes (the current folder)"
    )
    options = parser.parse_args(arguments)
    if options.name is None:
        for name, about in scenes().items():
            print(f"{name:<12}{about}")
        print("\npounding-fmu example NAME writes one of them, and its record")
        return 0
    scene, *records = write(options.name, options.output)
    for file in (scene, *records):
        print(file)
    print(f"go on with: pounding-fmu {quoted(scene)}")
    return 0


def scenes() -> dict[str, str]:
    """What all scenes are, by their names: the description, or the remark in the first line."""
    files = sorted((DATA / "scenes").glob("*.toml"))
    read = {file: _native.Scene.read(str(file))[0] for file in files}
    first = {file: file.read_text(encoding="utf-8").partition("\n")[0].strip("# ") for file in files}
    return {file.stem: scene.description or first[file] for file, scene in read.items() if scene is not None}


def write(name: str, folder: Path) -> list[Path]:
    """Writes a scene and its record below a folder, over no file that is there, and returns where they are."""
    known = [file.stem for file in (DATA / "scenes").glob("*.toml")]
    stem = name.lower().removesuffix(".toml")
    if stem not in known:
        raise ValueError(f"{unknown(name, known, 'there is no such example')} (pounding-fmu example lists all)")
    text = (DATA / "scenes" / f"{stem}.toml").read_text(encoding="utf-8")
    files = {folder / f"{stem}.toml": RECORD.sub(r'\1\2"', text).encode()}
    files |= {folder / record: (DATA / record).read_bytes() for _, record in RECORD.findall(text)}
    scene = next(iter(files))
    in_the_way = [file for file, content in files.items() if file.exists() and not is_record(file, scene, content)]
    if in_the_way:
        there = ", ".join(map(str, in_the_way))
        raise ValueError(f"{there}: already there; nothing has been written (-o FOLDER names another folder)")
    for file, content in files.items():
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(content)
    return list(files)


def is_record(file: Path, scene: Path, content: bytes) -> bool:
    """Whether it is the record that another example has brought."""
    return file != scene and file.is_file() and file.read_bytes() == content


def quoted(path: Path) -> str:
    return f'"{path}"' if " " in str(path) else str(path)
