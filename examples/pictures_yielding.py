"""What plot_scene.py draws of storeys that yield: their hysteresis loops, and what is left of their drifts."""

import numpy as np

from elevation import prepare_height
from pictures import force_unit
from style import ALONE, BLACK, BUILDINGS, GREY, pyplot

plt = pyplot()

# As many storeys of a building as one picture can show: those with the largest ductility.
MOST_STOREYS = 4


def yielding_storeys(scene, run):
    """Of each building that has any, the storeys that can yield, counted from 1."""
    found = {
        side: [i for i in range(1, count + 1) if f"{side}.storey_shear[{i}]" in run.columns]
        for side, count in scene.floors.items()
    }
    return {side: storeys for side, storeys in found.items() if storeys}


def drift_of(run, side, storey):
    """mm, over time."""
    below = run[f"{side}.displacement[{storey - 1}]"] if storey > 1 else 0.0
    return 1e3 * (run[f"{side}.displacement[{storey}]"] - below)


def loops(scene, run, alone, window):
    """Storey shear against drift: what loops enclose is dissipated. In brackets the ductility without contact."""
    storeys = yielding_storeys(scene, run)
    if not storeys:
        return None
    most = lambda side: lambda i: run[f"{side}.ductility[{i}]"][-1]  # noqa: E731
    shown = {side: sorted(sorted(own, key=most(side))[-MOST_STOREYS:]) for side, own in storeys.items()}
    rows, columns = max(map(len, shown.values())), len(shown)
    figure, panels = plt.subplots(rows, columns, figsize=(4.1 * columns, 1.9 * rows + 0.8), squeeze=False)
    for axes in panels.flat:
        axes.axis("off")
    largest = max(np.abs(run[f"{side}.storey_shear[{i}]"]).max() for side, own in shown.items() for i in own)
    factor, unit = force_unit(largest)
    for column, (side, own) in zip(panels.T, shown.items()):
        # As the storeys stand: the first one at the bottom.
        for axes, storey in zip(column[::-1], own):
            axes.axis("on")
            draw_loops(axes, run, alone, side, storey, factor)
        column[rows - len(own)].set_ylabel(f"storey shear [{unit}]")
        column[-1].set_xlabel("drift [mm]")
    named_below(figure, panels)
    return figure


def draw_loops(axes, run, alone, side, storey, factor):
    for one, label, line in [
        (alone, "without contact", {**ALONE, "linewidth": 1.0}),
        (run, f"{side}, pounding", {**BUILDINGS[side], "linestyle": "-", "linewidth": 1.1}),
    ]:
        axes.plot(drift_of(one, side, storey), one[f"{side}.storey_shear[{storey}]"] / factor, label=label, **line)
    axes.axhline(0, color=GREY, linewidth=0.8)
    axes.axvline(0, color=GREY, linewidth=0.8)
    both = [one[f"{side}.ductility[{storey}]"][-1] for one in (run, alone)]
    axes.set_title(f"{side.capitalize()} storey {storey}: ductility {both[0]:.1f} ({both[1]:.1f})")


def residual(scene, run, alone, window):
    """Ductility and residual drift of each storey at the end, over the height, with and without contact."""
    storeys = yielding_storeys(scene, run)
    if not storeys:
        return None
    height = 1.8 + 0.5 * min(12, max(scene.floors.values()))
    columns = 2 * len(storeys)
    figure, panels = plt.subplots(1, columns, figsize=(2.6 * columns + 0.6, height), sharey=True, squeeze=False)
    panels = panels[0]
    for side, ductility, left_over in zip(storeys, panels[::2], panels[1::2]):
        for one, label, line in [
            (run, f"{side}, pounding", {**BUILDINGS[side], "linestyle": "-"}),
            (alone, "without contact", ALONE),
        ]:
            for axes, quantity, factor in [(ductility, "ductility", 1.0), (left_over, "residual_drift", 1e3)]:
                # A storey that stays elastic has no such numbers.
                at_end = [
                    factor * one[f"{side}.{quantity}[{i}]"][-1] if i in storeys[side] else np.nan
                    for i in range(1, scene.floors[side] + 1)
                ]
                axes.stairs(at_end, scene.levels[side], orientation="horizontal", baseline=None, label=label, **line)
        ductility.axvline(1, color=BLACK, linewidth=0.8, linestyle=":")
        left_over.axvline(0, color=GREY, linewidth=0.8)
        ductility.set(title=f"{side.capitalize()} building", xlabel="ductility", xlim=(0, None))
        left_over.set_xlabel("residual drift [mm]")
    prepare_height(panels[0], scene, "dotted: yield")
    named_below(figure, panels)
    return figure


def named_below(figure, panels):
    """One legend for all panels, what is without contact last."""
    lines = {label: line for axes in panels.flat for line, label in zip(*axes.get_legend_handles_labels())}
    labels = sorted(lines, key="without contact".__eq__)
    figure.legend([lines[label] for label in labels], labels, loc="outside lower center", ncols=3)
