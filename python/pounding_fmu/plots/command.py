"""The command ``plot``: pictures of a run."""

from __future__ import annotations

import argparse
import importlib
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from .. import _native
from .._extras import require
from .._scenes import positive, read_file, read_record, warn
from .style import FORMATS, LOOK, picture_file, save

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from .runs import Runs

# Each picture is a function of its name in one of these modules.
PICTURES = {
    "overview": "overview",
    "contacts": "meetings",
    "floors": "pictures",
    "forces": "pictures",
    "accelerations": "pictures",
    "hysteresis": "pictures",
    "drifts": "storeys",
    "loops": "storeys",
    "residual": "storeys",
}


class NothingToShow(ValueError):
    """A run has nothing of what a picture is of."""


def main(arguments: list[str]) -> int:
    """Draws what is asked for; 1 where there is nothing of the kind to draw."""
    options = parser().parse_args(arguments)
    require("matplotlib", "plot")
    if options.output is not None:
        picture_file(options.output)
    runs = runs_of(options)
    path = options.output or picture_file(Path(f"{runs.scene.name}.png"))
    several = len(options.picture) > 1
    files = {name: path.with_stem(f"{path.stem}_{name}") if several else path for name in options.picture}
    spare(options, files.values())
    found = []
    for name, file in files.items():
        if sys.stderr.isatty():
            print(f"{runs.scene.name}: {name} ...", end="\r", file=sys.stderr, flush=True)
        try:
            save(draw(runs, name), file)
        except NothingToShow as nothing:
            found.append(str(nothing))
        else:
            print(f"\x1b[K{file}" if sys.stdout.isatty() else file)
    for text in found:
        print(text, file=sys.stderr)
    return 1 if len(found) == len(files) else 0


def draw(runs: Runs, name: str) -> Figure:
    """One of the pictures."""
    if name not in PICTURES:
        raise ValueError(f"picture = {name!r}: expected one of {', '.join(PICTURES)}")
    if name != "contacts":
        runs.check_motion()
    function = getattr(importlib.import_module(f".{PICTURES[name]}", __package__), name)
    with require("matplotlib", "plot").rc_context(LOOK):
        figure: Figure | None = function(runs)
    if figure is None:
        raise NothingToShow(f"no picture of {name}: nothing of the kind happens in this run")
    return figure


def runs_of(options: argparse.Namespace) -> Runs:
    """What the options of a run say."""
    from .runs import Runs

    scene = read_file(options.scene)
    if options.record is not None:
        scene = scene.with_record(read_record(options.record, "record"))
    stop = scene.stop() if options.stop is None else positive("stop", options.stop)
    warn(scene.warnings())
    return Runs(scene, stop, options.start, options.end, options.buildings)


def spare(options: argparse.Namespace, files: Iterable[Path]) -> None:
    """Refuses to write over what is read."""
    records = [] if options.record is None else [options.record]
    _native.spare([("-o", file) for file in files], [options.scene], records)


def parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser("pounding-fmu plot", description="Draws what happens in a run of a scene.")
    what = "file of the picture; by default NAME.png in the current folder, NAME being that of the scene"
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", help=f"{', '.join(FORMATS)}: {what}")
    several = "others than the overview; of several each is FILE_NAME.png"
    names = ", ".join(PICTURES)
    parser.add_argument(
        "--picture", nargs="+", choices=PICTURES, default=["overview"], metavar="NAME", help=f"{several}: {names}"
    )
    run_options(parser, "by default the whole run, of others than the overview its hardest five seconds")
    return parser


def run_options(parser: argparse.ArgumentParser, seen: str) -> None:
    """The scene, its run, and what of it is to be seen."""
    parser.add_argument("scene", type=Path, metavar="SCENE.toml")
    parser.add_argument("--from", dest="start", type=float, metavar="S", help=f"s, where it begins; {seen}")
    parser.add_argument("--to", dest="end", type=float, metavar="S", help="s, where it ends")
    parser.add_argument("--record", type=Path, metavar="FILE", help="ground motion instead of that of the scene")
    about = "one or two whose floors, storeys and loops are charted; by default, of more than two, those of the hardest impact"
    parser.add_argument("--buildings", nargs="+", metavar="NAME", help=about)
    parser.add_argument("--stop", type=float, metavar="S", help="s, end of the run; by default that of the scene")
