"""Draws docs/images/first_run.png, the first picture of the README, from runs of the default scene.

    python3 examples/run.py examples/plot_run.py

The engine runs twice, with the scene as it is and without its contacts: what pounding does is the difference.
"""

import numpy as np

from engine import ROOT, STANDARD_GRAVITY
from layout import Scene
from runs import simulate
from style import ALONE, FORCE, LEFT, OPEN, OVERLAP, RIGHT, pyplot, save

SCENE = ROOT / "examples/scenes/feup.toml"
PICTURE = ROOT / "docs/images/first_run.png"

CONTACT = 2  # between the second floors
STEP = 1e-3  # s, between impacts
ROWS_PER_IMPACT = 60  # and just before and after its beginning and its end, where the force jumps
STRONG_MOTION = (1.5, 5.5)  # s
ONE_IMPACT = (-4.0, 9.0)  # ms after the hardest impact begins


def main():
    scene = Scene(SCENE)
    motion = simulate(scene, STEP, rows_per_impact=ROWS_PER_IMPACT, stop=STRONG_MOTION[1])
    draw(scene, motion, simulate(scene, STEP, "--without-contacts", stop=STRONG_MOTION[1]))


def draw(scene, motion, alone):
    gap = scene.contacts[CONTACT - 1].gap
    hardest = motion.hardest(CONTACT)
    start, force, penetration = (hardest[name] for name in ["start_s", "peak_force", "peak_penetration"])

    figure, panels = prepare_figure()
    for column, clock, around in [(0, motion.time, STRONG_MOTION), (1, 1e3 * (motion.time - start), ONE_IMPACT)]:
        # With a row before and after, so that lines reach the edges.
        shown = slice(np.searchsorted(clock, around[0]) - 1, np.searchsorted(clock, around[1]) + 1)
        draw_edges(panels[0, column], clock, motion, shown, gap)
        panels[1, column].plot(clock[shown], motion[f"contact[{CONTACT}].force"][shown], **FORCE)
        draw_acceleration(panels[2, column], motion, alone, start if column else 0.0, 1e3 if column else 1.0)
        panels[2, column].set_xlim(around)

    edges, forces, accelerations = panels[:, 0]
    edges.set_title(f"Facing edges of the second floors (shaded: the gap, {1e3 * gap:.0f} mm at rest)")
    edges.set(ylabel="position [mm]", ylim=(-50, 75))
    edges.legend(loc="upper right", ncols=2)
    forces.set_title(f"Contact force between them: up to {force:.0f} N")
    forces.set_ylabel("force [N]")
    largest = [run["left.peak_acceleration[2]"][-1] / STANDARD_GRAVITY for run in (motion, alone)]
    accelerations.set_title("Acceleration of floor 2, left frame: up to {:.0f} g, {:.1f} g without contact".format(*largest))
    accelerations.set(ylabel="acceleration [g]", xlabel="time [s]")
    accelerations.legend(loc="lower right", ncols=2)

    panels[0, 1].set_title("The hardest impact")
    label_overlap(panels[0, 1], 1e3 * (motion.time - start), motion, f"penetration\n{1e3 * penetration:.2f} mm")
    panels[2, 1].set_xlabel(f"time [ms] after {start:.4f} s")
    figure.align_ylabels(panels[:, 0])
    save(figure, PICTURE)


def prepare_figure():
    """Three rows: edges, force, acceleration; on the left the strong motion, on the right one impact."""
    figure, panels = pyplot().subplots(3, 2, figsize=(9, 8.4), sharex="col", width_ratios=[2.7, 1])
    for row in [1, 2]:
        panels[row, 1].sharey(panels[row, 0])
        panels[row, 1].tick_params(labelleft=False)
    return figure, panels


def draw_edges(axes, clock, motion, shown, gap):
    """Where the two slab edges are: between them is the gap, and where they overlap they press."""
    left, right = motion["left.displacement[2]"][shown], motion["right.displacement[2]"][shown] + gap
    clock, left, right = clock[shown], 1e3 * left, 1e3 * right
    axes.fill_between(clock, left, right, where=right >= left, **OPEN)
    axes.fill_between(clock, left, right, where=left > right, **OVERLAP)
    axes.plot(clock, right, label="right frame", **RIGHT)
    axes.plot(clock, left, label="left frame", **LEFT)


def label_overlap(axes, clock, motion, text):
    """Names the largest overlap."""
    deepest = np.argmax(motion[f"contact[{CONTACT}].penetration"])
    place = (clock[deepest], 1e3 * motion["left.displacement[2]"][deepest])
    axes.margins(y=0.25)
    axes.annotate(text, place, (0.04, 0.05), textcoords="axes fraction", arrowprops={"arrowstyle": "-"})


def draw_acceleration(axes, motion, alone, start, scale):
    for run, label, style in [(motion, "pounding", LEFT), (alone, "without contact", ALONE)]:
        axes.plot(scale * (run.time - start), run["left.acceleration[2]"] / STANDARD_GRAVITY, label=label, **style)


if __name__ == "__main__":
    main()
