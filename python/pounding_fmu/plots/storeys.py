"""Pictures of storeys: drifts over the height, and of those that yield hysteresis loops and what is left of drifts; loops of
links beside them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure

from .elevation import prepare_height
from .layout import titled
from .pictures import force_unit, handy, legend_of_all
from .runs import Run, Runs
from .style import ALONE, BLACK, GREY, Look

if TYPE_CHECKING:
    from collections.abc import Iterable

    from matplotlib.axes import Axes
    from numpy.typing import NDArray

# As many storeys of a building as one picture can show: those with the largest ductility.
MOST_STOREYS = 4
# As many links: those with the largest force.
MOST_LINKS = 4
LINK: Look = {"color": BLACK, "linewidth": 1.4}


def both(runs: Runs, side: str) -> list[tuple[Run, str, Look]]:
    """The run and that without contacts, and how their lines are called and look."""
    return with_and_without(runs, side, runs.scene.looks[side])


def with_and_without(runs: Runs, name: str, look: Look) -> list[tuple[Run, str, Look]]:
    look = {**look, "linestyle": "-"}
    if not runs.has_alone:
        return [(runs.run, name, look)]
    return [(runs.run, f"{name}, pounding", look), (runs.alone, "without contact", ALONE)]


def drift_of(runs: Runs, run: Run, side: str, storey: int) -> NDArray[Any]:
    """mm, over time."""
    drift: NDArray[Any] = 1e3 * runs.scene.drift(run, side, storey)
    return drift


def panels_over_height(runs: Runs, columns: int, width: float) -> tuple[Figure, Any]:
    height = 1.8 + 0.5 * min(12, max(runs.scene.floors[side] for side in runs.buildings))
    figure = Figure(figsize=(width * columns + 0.5, height))
    return figure, figure.subplots(1, columns, sharey=True, squeeze=False)[0]


def drifts(runs: Runs) -> Figure:
    """Largest inter-storey drifts of either sign over the height, with and without contact."""
    figure, panels = panels_over_height(runs, len(runs.buildings), 4.0)
    draw_all_drifts(panels, runs)
    prepare_height(panels[0], runs.scene, "diamond: a contact" if runs.scene.contacts else None, runs.buildings)
    legend_of_all(figure, panels)
    return figure


def draw_all_drifts(panels: Iterable[Axes], runs: Runs) -> None:
    """A panel for each building, to one scale."""
    of = list(zip(panels, runs.buildings))
    largest = max(draw_drifts(axes, runs, side) for axes, side in of)
    for axes, side in of:
        axes.set(title=titled(side), xlim=(-1.08 * largest, 1.08 * largest))


def draw_drifts(axes: Axes, runs: Runs, side: str) -> float:
    """Least and largest drift of each storey of a building; returns the largest magnitude, mm."""
    levels, largest = runs.scene.levels[side], 0.0
    for one, label, line in both(runs, side):
        drift = np.array([drift_of(runs, one, side, storey) for storey in range(1, len(levels))])
        low, high = drift.min(axis=1), drift.max(axis=1)
        largest = max(largest, -float(low.min()), float(high.max()))
        if one is runs.run:
            axes.stairs(high, levels, baseline=low, orientation="horizontal", fill=True, alpha=0.2, color=line["color"])
        axes.stairs(low, levels, orientation="horizontal", baseline=None, label=label, **line)
        axes.stairs(high, levels, orientation="horizontal", baseline=None, **line)
    axes.axvline(0, color=GREY, linewidth=0.8)
    axes.set_xlabel("inter-storey drift, least and largest [mm]")
    heights = (pair.height_on(side, runs.scene.levels) for pair in runs.scene.contacts)
    touched = sorted({height for height in heights if height is not None})
    axes.plot(np.zeros(len(touched)), touched, "D", color=BLACK, markersize=4, zorder=3)
    return largest


def storeys_with(runs: Runs, quantity: str) -> dict[str, list[int]]:
    """Of each building that has any, the storeys with this output, counted from 1."""
    found = {
        side: [i for i in range(1, runs.scene.floors[side] + 1) if f"{side}.{quantity}[{i}]" in runs.run]
        for side in runs.buildings
    }
    return {side: storeys for side, storeys in found.items() if storeys}


def most_ductile(runs: Runs, most: int) -> dict[str, list[int]]:
    """Of each building that has any, the storeys with the largest ductility, or where a building is another program's the
    largest drift, from below."""
    found = {}
    for side, own in storeys_with(runs, "storey_shear").items():
        strain = {i: strain_of(runs, side, i) for i in own}
        found[side] = sorted(sorted(own, key=strain.__getitem__)[-most:])
    return found


def strain_of(runs: Runs, side: str, storey: int) -> float:
    """Ductility, or the largest drift, mm."""
    name = f"{side}.ductility[{storey}]"
    return float(runs.run[name][-1] if name in runs.run else np.abs(drift_of(runs, runs.run, side, storey)).max())


def strongest_links(runs: Runs, most: int) -> list[int]:
    """The links of these buildings with the largest forces, counted from 1, in their order."""
    shown = {*runs.buildings}
    largest = {at: link_force(runs.run, at) for at, link in enumerate(runs.scene.links, 1) if shown & {*link.sides}}
    return sorted(sorted(largest, key=largest.__getitem__)[-most:])


def link_force(run: Run, link: int) -> float:
    """N, the largest of either sign."""
    return float(np.abs(run[f"link[{link}].force"]).max())


def loops(runs: Runs) -> Figure | None:
    """Storey shear against drift, and force of links against displacement: what loops enclose is dissipated. In brackets the
    ductility, or the largest force, without contact."""
    shown, links = most_ductile(runs, MOST_STOREYS), strongest_links(runs, MOST_LINKS)
    if not shown and not links:
        return None
    rows, columns = max(len(own) for own in (*shown.values(), links)), len(shown) + bool(links)
    figure = Figure(figsize=(4.1 * columns, 1.9 * rows + 0.8))
    panels = figure.subplots(rows, columns, squeeze=False)
    for axes in panels.flat:
        axes.axis("off")
    draw_storeys(panels.T, runs, shown)
    if links:
        draw_links(panels[rows - len(links) :, -1], runs, links)
    legend_of_all(figure, panels.flat)
    return figure


def draw_storeys(columns: NDArray[Any], runs: Runs, shown: dict[str, list[int]]) -> None:
    """A column for each building, as its storeys stand: the first one at the bottom."""
    shears = [np.abs(runs.run[f"{side}.storey_shear[{i}]"]).max() for side, own in shown.items() for i in own]
    factor, unit = force_unit(max(shears, default=0.0))
    for column, (side, own) in zip(columns, shown.items()):
        for axes, storey in zip(column[::-1], own):
            axes.axis("on")
            draw_loops(axes, runs, side, storey, factor)
        column[len(column) - len(own)].set_ylabel(f"storey shear [{unit}]")
        column[-1].set_xlabel("drift [mm]")


def draw_links(panels: NDArray[Any], runs: Runs, links: list[int]) -> None:
    """A panel for each."""
    factor, unit = force_unit(max(link_force(runs.run, link) for link in links))
    for axes, link in zip(panels, links):
        axes.axis("on")
        draw_link_loops(axes, runs, link, factor)
    panels[0].set_ylabel(f"link force [{unit}]")
    panels[-1].set_xlabel("displacement, nearer positive [mm]")


def draw_link_loops(axes: Axes, runs: Runs, link: int, factor: float) -> None:
    lines = with_and_without(runs, "link", LINK)
    for one, label, line in lines[::-1]:
        displacement, force = 1e3 * one[f"link[{link}].displacement"], one[f"link[{link}].force"] / factor
        axes.plot(displacement, force, label=label, **{**line, "linewidth": 1.0})
    draw_zero(axes)
    pounding, *alone = (handy(link_force(one, link), "N") for one, _, _ in lines)
    compared = f" ({alone[0]})" if alone else ""
    told = runs.scene.links[link - 1]
    axes.set_title(f"Link {link}, {told.name}\n{told.made_of}: {pounding}{compared}")


def draw_loops(axes: Axes, runs: Runs, side: str, storey: int, factor: float) -> None:
    lines = both(runs, side)
    for one, label, line in lines[::-1]:
        shear = one[f"{side}.storey_shear[{storey}]"] / factor
        axes.plot(drift_of(runs, one, side, storey), shear, label=label, **{**line, "linewidth": 1.0})
    draw_zero(axes)
    pounding, *alone = (reached(runs, one, side, storey) for one, _, _ in lines)
    compared = f" ({alone[0]})" if alone else ""
    what = "ductility" if f"{side}.ductility[{storey}]" in runs.run else "drift up to"
    axes.set_title(f"{titled(side, f'storey {storey}')}: {what} {pounding}{compared}")


def draw_zero(axes: Axes) -> None:
    axes.axhline(0, color=GREY, linewidth=0.8)
    axes.axvline(0, color=GREY, linewidth=0.8)


def reached(runs: Runs, run: Run, side: str, storey: int) -> str:
    """The largest ductility of a storey, or its largest drift, and when it has collapsed, if it has."""
    if f"{side}.ductility[{storey}]" not in run:
        return f"{strain_of(runs, side, storey):.1f} mm"
    collapse = runs.collapse(run)
    fell = f", fell at {collapse[2]:.1f} s" if collapse and collapse[:2] == (side, storey) else ""
    return f"{run[f'{side}.ductility[{storey}]'][-1]:.1f}{fell}"


def residual(runs: Runs) -> Figure | None:
    """Ductility and residual drift of each storey at the end, over the height, with and without contact."""
    storeys = storeys_with(runs, "ductility")
    if not storeys:
        return None
    figure, panels = panels_over_height(runs, 2 * len(storeys), 2.6)
    for side, ductility, left_over in zip(storeys, panels[::2], panels[1::2]):
        for one, label, line in both(runs, side):
            for axes, quantity, factor in [(ductility, "ductility", 1.0), (left_over, "residual_drift", 1e3)]:
                # A storey that stays elastic has no such numbers.
                at_end = [
                    factor * one[f"{side}.{quantity}[{i}]"][-1] if i in storeys[side] else np.nan
                    for i in range(1, runs.scene.floors[side] + 1)
                ]
                levels = runs.scene.levels[side]
                axes.stairs(at_end, levels, orientation="horizontal", baseline=None, label=label, **line)
        ductility.axvline(1, color=BLACK, linewidth=0.8, linestyle=":")
        left_over.axvline(0, color=GREY, linewidth=0.8)
        ductility.set(title=titled(side), xlabel="ductility", xlim=(0, None))
        left_over.set_xlabel("residual drift [mm]")
    prepare_height(panels[0], runs.scene, "dotted: yield", runs.buildings)
    legend_of_all(figure, panels)
    return figure
