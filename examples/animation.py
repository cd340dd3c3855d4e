"""The buildings in motion, as a GIF: displacements and gaps to one scale, levels to another, widths as they fit."""

import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.ticker import MaxNLocator
from PIL import Image

from elevation import Elevation, inner_edges, prepare_height
from engine import ROOT
from style import BLACK, BUILDINGS, YELLOW, pyplot

plt = pyplot()

SLOWER = 2.0  # than in life
FRAMES_PER_SECOND = 20  # a GIF counts in hundredths of a second
AFTERGLOW = 4  # frames that an impact stays to be seen: it may last a part of one
COLOURS = 24  # of the palette: plain areas need few, and few make small files


def write(path, scene, run, window):
    """Writes the GIF of a part of a run."""
    stage = Stage(scene, run, window)
    step = 1.0 / (SLOWER * FRAMES_PER_SECOND)
    images, palette = [], None
    for time in np.arange(window[0], window[1], step):
        pixels = stage.frame(time, step)
        image = Image.fromarray(pixels)
        # One palette for all frames: what stands still stays the same to the bit and costs nothing.
        palette = palette or palette_of(stage.loudest(step))
        images.append(image.quantize(palette=palette, dither=Image.Dither.NONE))
    plt.close(stage.figure)
    path.parent.mkdir(parents=True, exist_ok=True)
    duration = round(1000 / FRAMES_PER_SECOND)
    images[0].save(path, save_all=True, append_images=images[1:], duration=duration, loop=0, optimize=True)
    shown = path.relative_to(ROOT) if path.is_relative_to(ROOT) else path
    print(f"{shown}: {len(images)} frames, {path.stat().st_size / 1e3:.0f} kB")


def palette_of(pixels):
    """The colours of a picture, and the stars' own, however small they are in it."""
    yellow = np.uint8([round(255 * part) for part in to_rgb(YELLOW)])
    band = np.broadcast_to(yellow, (20, *pixels.shape[1:]))
    return Image.fromarray(np.concatenate([pixels, band])).quantize(COLOURS, dither=Image.Dither.NONE)


class Stage:
    def __init__(self, scene, run, window):
        self.scene, self.run = scene, run
        shown = (run.time >= window[0]) & (run.time <= window[1])
        # mm, a row for each floor.
        self.motion = {
            side: 1e3 * np.array([run[f"{side}.displacement[{i}]"] for i in range(1, count + 1)])
            for side, count in scene.floors.items()
        }
        reach = max(np.abs(rows[:, shown]).max() for rows in self.motion.values())
        self.figure, (axes, strip) = plt.subplots(
            2, 1, figsize=(5.2, 4.6), dpi=100, height_ratios=[4, 1], layout="constrained"
        )
        width = 1.5 * max(reach, *(0.3 * edges.max() for edges in inner_edges(scene).values()))
        self.elevation = Elevation(axes, scene, width)
        # mm, both surfaces of each contact over time.
        self.edges = [
            [face + 1e3 * edge for edge in pair.edges(run)] for face, pair in zip(self.elevation.faces, scene.contacts)
        ]
        self.prepare_axes(axes, reach)
        self.burst = axes.scatter([], [], marker="*", s=[], facecolor=YELLOW, edgecolor=BLACK, linewidth=0.8, zorder=5)
        self.clock = axes.text(0.01, 1.0, "", transform=axes.transAxes, va="top", family="monospace")
        self.count = axes.text(0.99, 1.0, "", transform=axes.transAxes, va="top", ha="right", family="monospace")
        self.cursor = self.prepare_strip(strip, window)
        self.hardest = max((impact["impulse"] for impact in run.impacts), default=1.0)

    def prepare_axes(self, axes, reach):
        scene = self.scene
        prepare_height(axes, scene)
        left, right = self.elevation.ends()
        xlim = left - 1.1 * reach, right + 1.1 * reach
        above = 0.14 + 0.3 / max(scene.floors.values())
        height = scene.top - scene.bottom
        axes.set(xlim=xlim, ylim=(scene.bottom - 0.08 * height, scene.top + above * height))
        axes.set(xlabel="mm (displacements and gap to scale; widths not)")
        axes.xaxis.set_major_locator(MaxNLocator(6))
        axes.grid(False)
        axes.xaxis.label.set_size(9)
        self.elevation.draw_surroundings(axes, xlim)

    def prepare_strip(self, strip, window):
        shown = (self.run.time >= window[0]) & (self.run.time <= window[1])
        for side, (*_, top) in self.motion.items():
            strip.plot(self.run.time[shown], top[shown], color=BUILDINGS[side]["color"], linewidth=1.0, antialiased=True)
        strip.set(xlim=window, xlabel="time [s]", ylabel="tops [mm]")
        for label in (strip.xaxis.label, strip.yaxis.label):
            label.set_size(9)
        return strip.axvline(window[0], color=BLACK, linewidth=1.2)

    def frame(self, time, step):
        """The pixels of one frame."""
        row = min(np.searchsorted(self.run.time, time), len(self.run.time) - 1)
        self.elevation.place({side: rows[:, row] for side, rows in self.motion.items()})
        self.show_impacts(time, step, row)
        self.clock.set_text(f"{time:6.2f} s")
        self.cursor.set_xdata([time, time])
        self.figure.canvas.draw()
        return np.asarray(self.figure.canvas.buffer_rgba())[..., :3].copy()

    def loudest(self, step):
        """A frame that has every colour: that of the hardest impact."""
        hardest = self.run.hardest()
        return self.frame(self.run.time[0] if hardest is None else hardest["start_s"] + step / 2, step)

    def show_impacts(self, time, step, row):
        """A star for every impact of the last few frames, as large as its impulse; it fades."""
        recent = [impact for impact in self.run.impacts if time - AFTERGLOW * step < impact["start_s"] <= time]
        begun = sum(impact["start_s"] <= time for impact in self.run.impacts)
        places, sizes = [], []
        for impact in recent:
            p = impact["contact"] - 1
            left, right = self.edges[p]
            places.append(((left[row] + right[row]) / 2, self.scene.contacts[p].height))
            age = (time - impact["start_s"]) / (AFTERGLOW * step)
            sizes.append((60 + 640 * impact["impulse"] / self.hardest) * (1.0 - 0.8 * age))
        self.burst.set_offsets(np.array(places).reshape(-1, 2))
        self.burst.set_sizes(sizes)
        self.count.set_text(f"{begun:4d} impacts")
