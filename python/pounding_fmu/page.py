"""The command ``pounding-fmu page``: the engine, an editor and the buildings in motion, for any browser."""

from __future__ import annotations

import argparse
from pathlib import Path

from . import _native
from ._data import DATA
from ._page import assembled, libraries_in
from ._scenes import read_file, warn

TEMPLATE = DATA / "page.html"
LIBRARIES = DATA / "libraries"


def main(arguments: list[str]) -> int:
    options = parser().parse_args(arguments)
    if not TEMPLATE.exists():
        raise ValueError("this wheel has been built without the page; ci/page makes it, and ci/wheel --page takes it along")
    template, libraries = TEMPLATE.read_text(encoding="utf-8"), libraries_in(LIBRARIES)
    if options.scene is None:
        name, page = "pounding", assembled(template, libraries)
    else:
        scene = read_file(options.scene)
        warn(scene.warnings())
        given = {"file": options.scene.name, "text": options.scene.read_bytes().decode()}
        name = f"{scene.name}.page"
        page = assembled(template, libraries, given, records(scene, options.scene.parent))
    output = options.output or Path(f"{name}.html")
    _native.spare([("-o", output)], [] if options.scene is None else [options.scene], [])
    output.write_text(page, encoding="utf-8", newline="\n")
    print(f"{output}: open it in a browser; its FMUs are for {', '.join(libraries)}")
    return 0


def parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="pounding-fmu page",
        description="Makes a page that runs scenes, studies gaps and makes FMUs by itself: one file, without a network.",
    )
    parser.add_argument("scene", nargs="?", type=Path, metavar="SCENE.toml", help="the scene that it opens with")
    parser.add_argument(
        "-o", "--output", type=Path, metavar="FILE.html", help="where it goes; NAME.page.html (NAME: the scene's), or pounding.html"
    )
    return parser


def records(scene: _native.Scene, folder: Path) -> dict[str, bytes]:
    """The content of the record that a scene in a folder names, by that name; of ``file.v2#2`` that of the whole file."""
    record = scene.record()
    if record is None:
        return {}
    name = record.name if (folder / record.name).exists() else record.name.rpartition("#")[0]
    return {name: (folder / name).read_bytes()}
