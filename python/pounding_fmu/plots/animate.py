"""The command ``animate``: the buildings in motion."""

from __future__ import annotations

import argparse
import math
from pathlib import Path

from .._extras import require
from .command import run_options, runs_of, spare


def main(arguments: list[str]) -> int:
    """Writes the film."""
    parser = argparse.ArgumentParser("pounding-fmu animate", description="Shows the buildings in motion.")
    what = ".gif, or .mp4 where ffmpeg is installed; by default NAME.gif in the current folder"
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", help=what)
    parser.add_argument("--speed", type=float, default=0.5, help="1 is as fast as in life; by default %(default)s")
    run_options(parser, "by default the hardest five seconds")
    options = parser.parse_args(arguments)
    require("matplotlib", "plot")
    from . import animation

    if not (math.isfinite(options.speed) and options.speed > 0):
        raise ValueError(f"speed = {options.speed:g}: expected a finite number > 0")
    if options.output is not None:
        animation.film_file(options.output)
    runs = runs_of(options)
    runs.check_motion()
    path = options.output or animation.film_file(Path(f"{runs.scene.name}.gif"))
    spare(options, [path])
    count = animation.write(path, runs, options.speed)
    print(f"{path}: {count} frames, {path.stat().st_size / 1e3:.0f} kB")
    return 0
