"""The two buildings in motion, as a GIF: displacements and gaps to one scale, heights and widths as they fit."""

import numpy as np
from matplotlib.patches import Rectangle
from matplotlib.ticker import MaxNLocator
from PIL import Image

from engine import ROOT
from style import BLACK, BUILDINGS, GREY, YELLOW, pyplot

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
        palette = palette or Image.fromarray(stage.loudest(step)).quantize(COLOURS, dither=Image.Dither.NONE)
        images.append(image.quantize(palette=palette, dither=Image.Dither.NONE))
    plt.close(stage.figure)
    path.parent.mkdir(parents=True, exist_ok=True)
    duration = round(1000 / FRAMES_PER_SECOND)
    images[0].save(path, save_all=True, append_images=images[1:], duration=duration, loop=0, optimize=True)
    shown = path.relative_to(ROOT) if path.is_relative_to(ROOT) else path
    print(f"{shown}: {len(images)} frames, {path.stat().st_size / 1e3:.0f} kB")


class Building:
    """Slabs and columns of one building, whose inner edge stands at `edges` at rest, one for each floor."""

    def __init__(self, axes, side, edges, width, displacements):
        self.side, self.edges, self.width, self.displacements = side, edges, width, displacements
        colour = BUILDINGS[side]["color"]
        inner = -width if side == "left" else 0.0
        self.inner = inner
        slab, column = max(0.12, 0.016 * len(edges)), max(1.2, 3.2 - 0.1 * len(edges))
        # Columns stand a little inside of the slabs' ends.
        self.columns = [inner + share * width for share in (0.06, 0.94)]
        self.lines = [axes.plot([], [], color=colour, linewidth=column, solid_capstyle="butt")[0] for _ in self.columns]
        self.slabs = [
            axes.add_patch(Rectangle((0, floor - slab / 2), width, slab, facecolor=colour, edgecolor="none", zorder=3))
            for floor in range(1, len(edges) + 1)
        ]

    def place(self, row):
        """Where the inner edge of each floor is, after everything has been moved there."""
        displacement = 1e3 * np.array([column[row] for column in self.displacements])
        at = self.edges + displacement
        for slab, x in zip(self.slabs, at):
            slab.set_x(x + self.inner)
        for line, offset in zip(self.lines, self.columns):
            line.set_data(*bend(np.concatenate([[self.edges[0]], at]) + offset))
        return at


def bend(x, points=8):
    """Columns, clamped in the slabs: across each storey an S."""
    s = np.linspace(0.0, 1.0, points)
    shape = s * s * (3.0 - 2.0 * s)
    across = np.concatenate([low + (high - low) * shape for low, high in zip(x, x[1:])])
    return across, np.concatenate([storey + s for storey in range(len(x) - 1)])


class Stage:
    def __init__(self, scene, run, window):
        self.scene, self.run = scene, run
        shown = (run.time >= window[0]) & (run.time <= window[1])
        motion = {
            side: [run[f"{side}.displacement[{i}]"] for i in range(1, count + 1)]
            for side, count in scene.floors.items()
        }
        reach = 1e3 * max(np.abs(column[shown]).max() for columns in motion.values() for column in columns)
        gaps = gap_of_floors(scene)
        width = 1.5 * max(reach, 0.3 * gaps.max())
        self.figure, (axes, strip) = plt.subplots(
            2, 1, figsize=(5.2, 4.6), dpi=100, height_ratios=[4, 1], layout="constrained"
        )
        self.axes = axes
        self.buildings = {
            "left": Building(axes, "left", np.zeros(scene.floors["left"]), width, motion["left"]),
            "right": Building(axes, "right", gaps, width, motion["right"]),
        }
        top = max(scene.floors.values())
        self.prepare_axes(axes, (-width - 1.1 * reach, gaps.max() + width + 1.1 * reach), top)
        self.burst = axes.scatter([], [], marker="*", s=[], facecolor=YELLOW, edgecolor=BLACK, linewidth=0.8, zorder=5)
        self.clock = axes.text(0.01, 1.0, "", transform=axes.transAxes, va="top", family="monospace")
        self.count = axes.text(0.99, 1.0, "", transform=axes.transAxes, va="top", ha="right", family="monospace")
        self.cursor = self.prepare_strip(strip, window)
        self.hardest = max((impact["impulse"] for impact in run.impacts), default=1.0)

    def prepare_axes(self, axes, xlim, top):
        axes.set(xlim=xlim, ylim=(-0.08 * top, 1.14 * top + 0.3), yticks=range(1, top + 1, max(1, top // 10)))
        axes.set(xlabel="mm (displacements and gap to scale; heights and widths not)")
        axes.set(ylabel="floor (storeys drawn equally high)")
        axes.xaxis.set_major_locator(MaxNLocator(6))
        axes.grid(False)
        axes.axhline(0, color=GREY, linewidth=3)
        axes.xaxis.label.set_size(9)

    def prepare_strip(self, strip, window):
        shown = (self.run.time >= window[0]) & (self.run.time <= window[1])
        for side, style in BUILDINGS.items():
            top = self.run[f"{side}.displacement[{self.scene.floors[side]}]"][shown]
            strip.plot(self.run.time[shown], 1e3 * top, color=style["color"], linewidth=1.0, antialiased=True)
        strip.set(xlim=window, xlabel="time [s]", ylabel="tops [mm]")
        for label in (strip.xaxis.label, strip.yaxis.label):
            label.set_size(9)
        return strip.axvline(window[0], color=BLACK, linewidth=1.2)

    def frame(self, time, step):
        """The pixels of one frame."""
        row = min(np.searchsorted(self.run.time, time), len(self.run.time) - 1)
        at = {side: building.place(row) for side, building in self.buildings.items()}
        self.show_impacts(time, step, at)
        self.clock.set_text(f"{time:6.2f} s")
        self.cursor.set_xdata([time, time])
        self.figure.canvas.draw()
        return np.asarray(self.figure.canvas.buffer_rgba())[..., :3].copy()

    def loudest(self, step):
        """A frame that has every colour: that of the hardest impact."""
        hardest = self.run.hardest()
        return self.frame(self.run.time[0] if hardest is None else hardest["start_s"] + step / 2, step)

    def show_impacts(self, time, step, at):
        """A star for every impact of the last few frames, as large as its impulse; it fades."""
        recent = [impact for impact in self.run.impacts if time - AFTERGLOW * step < impact["start_s"] <= time]
        begun = sum(impact["start_s"] <= time for impact in self.run.impacts)
        places, sizes = [], []
        for impact in recent:
            pair = self.scene.contacts[impact["contact"] - 1]
            x = (at["left"][pair["left_floor"] - 1] + at["right"][pair["right_floor"] - 1]) / 2
            y = (pair["left_floor"] + pair["right_floor"]) / 2
            places.append((x, y))
            age = (time - impact["start_s"]) / (AFTERGLOW * step)
            sizes.append((60 + 640 * impact["impulse"] / self.hardest) * (1.0 - 0.8 * age))
        self.burst.set_offsets(np.array(places).reshape(-1, 2))
        self.burst.set_sizes(sizes)
        self.count.set_text(f"{begun:4d} impacts")


def gap_of_floors(scene):
    """mm from the left building to each floor of the right one at rest: where no contact says it, as below or above."""
    floors = np.arange(1, scene.floors["right"] + 1)
    known = sorted((pair["right_floor"], 1e3 * pair["gap"]) for pair in scene.contacts)
    if not known:
        return np.full(len(floors), 50.0)
    return np.interp(floors, *zip(*known))
