"""The buildings in motion: displacements and gaps to one scale, levels to another, widths as they fit."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from PIL import Image

from .._terminal import Progress
from .elevation import Elevation, gaps_at, prepare_height
from .pictures import counted
from .runs import Run, Runs
from .soil import Foot
from .style import BLACK, LOOK, YELLOW

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D
    from numpy.typing import NDArray

FRAMES_PER_SECOND = 20  # a GIF counts in hundredths of a second
AFTERGLOW = 4  # frames that an impact stays to be seen: it may last a part of one
COLOURS = 24  # of the palette: plain areas need few, and few make small files
MORE, MOST = 0.9, 8  # inches for each building from the third on, for so many of them


def film_file(path: Path) -> Path:
    """The path, where a film can be written to."""
    if path.suffix.lower() not in (".gif", ".mp4"):
        raise ValueError(f"{path}: expected a name that ends in .gif or .mp4")
    if path.suffix.lower() == ".mp4" and shutil.which("ffmpeg") is None:
        raise ValueError(f"{path}: MP4 needs ffmpeg, which is not installed; {path.with_suffix('.gif')} needs nothing")
    if not path.parent.is_dir():
        raise ValueError(f"{path}: expected a folder that is there; {path.parent} is none")
    return path


def write(path: Path, runs: Runs, speed: float) -> int:
    """Writes the film of what is to be seen of a run, so many times as fast as in life; returns the number of frames."""
    step = speed / FRAMES_PER_SECOND
    times = np.arange(*runs.window, step)
    with matplotlib.rc_context(LOOK):
        stage = Stage(runs)
        frames = shown(stage, times, step)
        if path.suffix.lower() == ".mp4":
            write_mp4(path, frames)
        else:
            write_gif(path, frames, palette_of(stage.loudest(step), COLOURS if runs.scene.is_pair else 2 * COLOURS))
    return len(times)


def shown(stage: Stage, times: NDArray[Any], step: float) -> Iterator[NDArray[Any]]:
    """The frames, with a bar that moves on a terminal."""
    progress = Progress("frames")
    for done, time in enumerate(times, 1):
        yield stage.frame(time, step)
        progress(done, len(times))
    if sys.stderr.isatty():
        print(file=sys.stderr)


def write_gif(path: Path, frames: Iterator[NDArray[Any]], palette: Image.Image) -> None:
    # One palette for all frames: what stands still stays the same to the bit and costs nothing.
    images = [Image.fromarray(pixels).quantize(palette=palette, dither=Image.Dither.NONE) for pixels in frames]
    duration = round(1000 / FRAMES_PER_SECOND)
    images[0].save(path, save_all=True, append_images=images[1:], duration=duration, loop=0, optimize=True)


def write_mp4(path: Path, frames: Iterator[NDArray[Any]]) -> None:
    """What every player shows: H.264 of an even number of pixels in 4:2:0."""
    first = next(frames)
    height, width, _ = first.shape
    raw = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", f"{FRAMES_PER_SECOND}"]
    even = ["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", "-movflags", "+faststart"]
    command = ["ffmpeg", "-y", "-loglevel", "error", *raw, "-i", "-", *even, f"file:{path}"]
    coder = subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE)
    assert coder.stdin is not None
    try:
        coder.stdin.write(first.tobytes())
        for pixels in frames:
            coder.stdin.write(pixels.tobytes())
    except BrokenPipeError:
        pass  # it says why below
    said = coder.communicate()[1].decode(errors="replace").strip()
    if coder.returncode != 0:
        raise RuntimeError(f"{path}: ffmpeg could not write it: {said or coder.returncode}")


def palette_of(pixels: NDArray[Any], colours: int) -> Image.Image:
    """The colours of a picture, and the stars' own, however small they are in it."""
    yellow = np.array([round(255 * part) for part in to_rgb(YELLOW)], dtype=np.uint8)
    band = np.broadcast_to(yellow, (20, *pixels.shape[1:]))
    return Image.fromarray(np.concatenate([pixels, band])).quantize(colours, dither=Image.Dither.NONE)


def feet_of(run: Run, side: str) -> tuple[NDArray[Any], NDArray[Any]]:
    """How far a foundation is displaced, mm, and turned over time; 0 in a way in which it does not move."""
    sways, rocks = (f"{side}.foundation.{way}" for way in ("displacement", "rotation"))
    still = np.zeros(len(run.time))
    return 1e3 * run[sways] if sways in run else still, run[rocks] if rocks in run else still


class Stage:
    """The buildings, and their tops over time, at one instant after another."""

    def __init__(self, runs: Runs) -> None:
        self.runs = runs
        scene, run = self.scene, self.run = runs.scene, runs.run
        self.seen = run.rows(*runs.window)
        # mm, a row for each floor.
        self.motion = {
            side: 1e3 * np.array([run[f"{side}.displacement[{i}]"] for i in range(1, count + 1)])
            for side, count in scene.floors.items()
        }
        # mm and rad.
        self.feet = {side: feet_of(run, side) for side in scene.foundations}
        reach = max(np.abs(rows[:, self.seen]).max() for rows in self.motion.values())
        wide = 5.2 + MORE * min(max(0, len(scene.names) - 2), MOST)
        self.figure = Figure(figsize=(wide, 4.6), dpi=100)
        self.canvas: Any = FigureCanvasAgg(self.figure)
        axes, strip = self.figure.subplots(2, 1, height_ratios=[4, 1])
        gaps = [gaps_at(scene, *pair).max() for pair in pairwise(scene.names)]
        width = 1.5 * max(reach, *(0.3 * gap for gap in [0.0, *gaps]))
        self.elevation = Elevation(axes, scene, width)
        # mm, both surfaces of each contact over time.
        self.edges = [
            [face + 1e3 * edge for edge in pair.edges(run)] for face, pair in zip(self.elevation.faces, scene.contacts)
        ]
        self.prepare_axes(axes, reach)
        self.burst = axes.scatter([], [], marker="*", s=[], facecolor=YELLOW, edgecolor=BLACK, linewidth=0.8, zorder=5)
        self.clock = axes.text(0.01, 1.0, "", transform=axes.transAxes, va="top", family="monospace")
        self.count = axes.text(0.99, 1.0, "", transform=axes.transAxes, va="top", ha="right", family="monospace")
        self.cursor = self.prepare_strip(strip, runs.window)
        self.largest = float(run.impacts["impulse"].max(initial=0.0)) or 1.0

    def prepare_axes(self, axes: Axes, reach: float) -> None:
        scene = self.scene
        prepare_height(axes, scene)
        left, right = self.elevation.ends()
        xlim = left - 1.1 * reach, right + 1.1 * reach
        above = 0.14 + 0.3 / max(scene.floors.values())
        bottom = self.elevation.bottom
        height = scene.top - bottom
        axes.set(xlim=xlim, ylim=(bottom - 0.08 * height, scene.top + above * height))
        axes.set(xlabel="mm (displacements and gap to scale; widths not)")
        axes.xaxis.set_major_locator(MaxNLocator(6))
        axes.grid(False)
        axes.xaxis.label.set_fontsize(9)
        self.elevation.draw_surroundings(axes, xlim)

    def prepare_strip(self, strip: Axes, window: tuple[float, float]) -> Line2D:
        for side in self.runs.buildings:
            look: dict[str, Any] = {"color": self.scene.looks[side]["color"], "linewidth": 1.0, "label": side}
            strip.plot(self.run.time[self.seen], self.motion[side][-1][self.seen], antialiased=True, **look)
        if not self.scene.is_pair:
            strip.legend(loc="upper right", ncols=2, fontsize=8)
        strip.set(xlim=window, xlabel="time [s]", ylabel="tops [mm]")
        for label in (strip.xaxis.label, strip.yaxis.label):
            label.set_fontsize(9)
        return strip.axvline(window[0], color=BLACK, linewidth=1.2)

    def frame(self, time: float, step: float) -> NDArray[Any]:
        """The pixels of one frame."""
        row = min(int(np.searchsorted(self.run.time, time)), len(self.run.time) - 1)
        feet = {side: Foot(float(sways[row]), float(rocks[row])) for side, (sways, rocks) in self.feet.items()}
        self.elevation.place({side: rows[:, row] for side, rows in self.motion.items()}, feet)
        self.show_impacts(time, step, row)
        self.clock.set_text(f"{time:6.2f} s")
        self.cursor.set_xdata([time, time])
        self.canvas.draw()
        return np.asarray(self.canvas.buffer_rgba())[..., :3].copy()

    def loudest(self, step: float) -> NDArray[Any]:
        """A frame that has every colour: that of the hardest impact."""
        hardest = self.run.hardest()
        return self.frame(self.run.time[0] if hardest is None else hardest["start_s"] + step / 2, step)

    def show_impacts(self, time: float, step: float, row: int) -> None:
        """A star for every impact of the last few frames, as large as its impulse; it fades."""
        recent = [impact for impact in self.run.impacts if time - AFTERGLOW * step < impact["start_s"] <= time]
        begun = sum(impact["start_s"] <= time for impact in self.run.impacts)
        places, sizes = [], []
        for impact in recent:
            p = impact["contact"] - 1
            left, right = self.edges[p]
            places.append(((left[row] + right[row]) / 2, self.scene.contacts[p].height))
            age = (time - impact["start_s"]) / (AFTERGLOW * step)
            sizes.append((60 + 640 * impact["impulse"] / self.largest) * (1.0 - 0.8 * age))
        self.burst.set_offsets(np.array(places).reshape(-1, 2))
        self.burst.set_sizes(sizes)
        self.count.set_text(f"{counted(begun):>12}")
