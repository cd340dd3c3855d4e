"""Pictures of contacts over time, a function each; it returns a figure, or None where it has no subject."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import colormaps
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from .layout import Surface, building
from .runs import Run, Runs, Window
from .style import ALONE, BLACK, FORCE, GREY, OPEN, OVERLAP, VERMILION, WALL, Look

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from matplotlib.axes import Axes
    from numpy.typing import NDArray

STANDARD_GRAVITY = 9.80665  # m/s2
# As many contacts as one picture can show: those with the largest impulse.
MOST_PANELS = 4


def busiest(runs: Runs) -> list[int]:
    """Contacts (counted from 1) that are worth a panel, the highest first."""
    contacts = runs.scene.contacts
    impulse = {p: float(np.sum(runs.run.of_contact(p)["impulse"])) for p in runs.contacts}
    chosen = sorted(impulse, key=lambda p: impulse[p], reverse=True)[:MOST_PANELS]
    return sorted(chosen, key=lambda p: contacts[p - 1].height, reverse=True)


def handy(value: float, unit: str, digits: int = 3) -> str:
    """A number with its unit, and k, M before it where that is shorter."""
    for factor, prefix in [(1e6, "M"), (1e3, "k")]:
        if abs(value) >= factor:
            return f"{value / factor:.{digits}g} {prefix}{unit}"
    return f"{value:.{digits}g} {unit}"


def force_unit(largest: float) -> tuple[float, str]:
    """What to divide forces by, and the unit they are in then."""
    return next((unit for unit in [(1e6, "MN"), (1e3, "kN")] if largest >= 2 * unit[0]), (1.0, "N"))


def counted(impacts: int) -> str:
    return "1 impact" if impacts == 1 else f"{impacts} impacts"


def over_time(rows: int, height: float, window: Window) -> tuple[Figure, NDArray[Any]]:
    figure = Figure(figsize=(9, height * rows + 0.6))
    panels = figure.subplots(rows, 1, sharex=True, squeeze=False)
    panels[-1, 0].set(xlabel="time [s]", xlim=window)
    return figure, panels[:, 0]


def legend_of_all(figure: Figure, panels: Iterable[Axes], place: str = "outside lower center") -> None:
    """One legend for all panels, what is without contact last."""
    lines = {label: line for axes in panels for line, label in zip(*axes.get_legend_handles_labels())}
    labels = sorted(lines, key="without contact".__eq__)
    look: Look = {"loc": place, "ncols": len(labels)}
    figure.legend([lines[label] for label in labels], labels, **look)


def floors(runs: Runs) -> Figure | None:
    """Facing edges with the gap between them: shaded where it is open, hatched where they press."""
    contacts = busiest(runs)
    if not contacts:
        return None
    figure, panels = over_time(len(contacts), 2.7, runs.window)
    for axes, p in zip(panels, contacts):
        pair = runs.scene.contacts[p - 1]
        hits = draw_edges(axes, runs, p, runs.window)
        axes.set_title(f"{pair.title}: {counted(hits)}; shaded: the gap, {1e3 * pair.gap:g} mm at rest")
    legend_of_all(figure, panels, "outside upper right")
    return figure


def draw_edges(axes: Axes, runs: Runs, p: int, window: Window) -> int:
    """Both surfaces of a contact, mm, a mark for each impact below them, and how many there are."""
    run, pair = runs.run, runs.scene.contacts[p - 1]
    shown = run.rows(*window)
    clock = run.time[shown]
    left, right = (1e3 * edge[shown] for edge in pair.edges(run))
    axes.fill_between(clock, left, right, where=right >= left, **OPEN)
    axes.fill_between(clock, left, right, where=left > right, **OVERLAP)
    for edge, surface in [(right, pair.surfaces["right"]), (left, pair.surfaces["left"])]:
        draw_edge(axes, clock, edge, surface, runs.scene.looks)
    starts = run.of_contact(p)["start_s"]
    hits = starts[(window[0] <= starts) & (starts <= window[1])]
    bottom = min(left.min(), right.min()) - 0.08 * np.ptp([left, right])
    axes.plot(hits, np.full(len(hits), bottom), "^", color=BLACK, markersize=4, label="impact")
    axes.set_ylabel("position [mm]")
    axes.margins(y=0.12)
    return len(hits)


def draw_edge(
    axes: Axes, clock: NDArray[Any], edge: NDArray[Any], surface: Surface, looks: Mapping[str, Look]
) -> None:
    side = surface.get("side")
    axes.plot(clock, edge, label=building(side) if side else "wall", **(looks[side] if side else WALL))


def forces(runs: Runs) -> Figure | None:
    """Bursts of contact force over the run, and the hardest of each contact from near; impulses of rigid contacts."""
    run = runs.run
    contacts = [p for p in busiest(runs) if len(run.of_contact(p))]
    if not contacts:
        return None
    figure = Figure(figsize=(9, 2.3 * len(contacts) + 0.8))
    panels = figure.subplots(len(contacts), 2, squeeze=False, width_ratios=[2.5, 1])
    factor, unit = force_unit(max(run.hardest([p])["peak_force"] for p in contacts))
    for (bursts, near), p in zip(panels, contacts):
        pair = runs.scene.contacts[p - 1]
        bursts.set(title=f"{pair.title}: {counted(len(run.of_contact(p)))}", xlim=(0, runs.stop))
        if pair.is_rigid:
            draw_impulses(bursts, run.of_contact(p))
            near.axis("off")
            continue
        # In one unit, to a scale for each contact: one may press a hundred times as hard as another.
        draw_bursts(bursts, run, p, factor)
        bursts.set_ylabel(f"contact force [{unit}]")
        draw_hardest(near, run, p, factor)
        near.set_ylim(bursts.get_ylim())
    panels[-1, 0].set_xlabel("time [s]")
    return figure


def draw_impulses(axes: Axes, impacts: NDArray[Any]) -> None:
    """Exchanges of momentum in no time, and what pressed rigid floors while they were held together."""
    factor, unit = force_unit(impacts["impulse"].max(initial=0.0))
    axes.vlines(impacts["start_s"], 0, impacts["impulse"] / factor, color=BLACK, linewidth=1.1)
    axes.set_ylabel(f"impulse [{unit} s]")


def draw_bursts(axes: Axes, run: Run, p: int, factor: float, **look: Any) -> None:
    """The force over time, a dot at the largest of each impact."""
    impacts = run.of_contact(p)
    axes.plot(run.time, run[f"contact[{p}].force"] / factor, label=f"contact {p}", **{**FORCE, **look})
    dots = {"color": VERMILION, "markersize": 4, **look}
    axes.plot(impacts["peak_time_s"], impacts["peak_force"] / factor, ".", **dots)


def draw_hardest(axes: Axes, run: Run, p: int, factor: float) -> None:
    """Force over time in ms, with a third of its length before and after."""
    hardest = run.hardest([p])
    start, end = hardest["start_s"], np.nan_to_num(hardest["end_s"], nan=run.time[-1])
    clock, margin = 1e3 * (run.time - start), 0.35 * 1e3 * (end - start)
    around = (clock >= -margin) & (clock <= 1e3 * (end - start) + margin)
    force = run[f"contact[{p}].force"][around] / factor
    axes.plot(clock[around], force, color=BLACK, linewidth=1.6)
    axes.fill_between(clock[around], 0, force, **OPEN)
    axes.set_title(f"Hardest: {handy(hardest['peak_force'], 'N')}, {handy(hardest['impulse'], 'N s')}")
    axes.set_xlabel(f"ms after {start:.4f} s")


def accelerations(runs: Runs) -> Figure | None:
    """The floors of the hardest impact with and without contact."""
    hardest = runs.hardest
    if hardest is None:
        return None
    row = [part for part in runs.scene.contacts[hardest["contact"] - 1].row if part[1] != "foundation.rotation"]
    figure, panels = over_time(len(row), 3.0, runs.window)
    for axes, (side, part, _) in zip(panels, row):
        name = f"{side}.{part.replace('displacement', 'acceleration')}"
        what = "Foundation" if part.startswith("foundation") else f"Floor {part[part.index('[') + 1 : -1]}"
        largest = []
        for one, label, line in [
            (runs.run, "pounding", {**runs.scene.looks[side], "linestyle": "-", "linewidth": 1.0}),
            *([(runs.alone, "without contact", ALONE)] if runs.has_alone else []),
        ]:
            shown = one.rows(*runs.window)
            axes.plot(one.time[shown], one[name][shown] / STANDARD_GRAVITY, label=label, **line)
            at_all = np.abs(one[name]).max()
            peak = name.replace("acceleration", "peak_acceleration")
            largest.append((one[peak][-1] if peak in one else at_all) / STANDARD_GRAVITY)
        compared = "".join(f", {peak:.3g} g without contact" for peak in largest[1:])
        axes.set_title(f"{what}, {building(side)}: up to {largest[0]:.3g} g in the run{compared}")
        axes.set_ylabel("acceleration [g]")
        axes.legend(loc="lower right", ncols=2)
    return figure


def hysteresis(runs: Runs) -> Figure | None:
    """Force against penetration of every impact, the hardest in black: what a loop encloses is lost in it."""
    run = runs.run
    contacts = [p for p in busiest(runs) if len(run.of_contact(p)) and not runs.scene.contacts[p - 1].is_rigid]
    if not contacts:
        return None
    columns = min(2, len(contacts))
    rows = -(-len(contacts) // columns)
    figure = Figure(figsize=(4.5 * columns + 1, 3.9 * rows))
    panels = figure.subplots(rows, columns, squeeze=False)
    fastest = max(run.of_contact(p)["approach_velocity"].max() for p in contacts)
    colours = ScalarMappable(Normalize(0, fastest or 1.0), colormaps["viridis_r"])
    for axes, p in zip(panels.flat, contacts):
        pair = runs.scene.contacts[p - 1]
        lost = handy(draw_impact_loops(axes, run, p, colours)["dissipated_energy"], "J")
        # In a line of its own where both are too long for one.
        between = ", " if len(pair.title) + len(pair.law) < 45 else "\n"
        axes.set_title(
            f"{pair.title}{between}{pair.law}\n{counted(len(run.of_contact(p)))}; the hardest (black): {lost} lost"
        )
    for axes in panels.flat[len(contacts) :]:
        axes.axis("off")
    figure.colorbar(colours, ax=panels, label="approach velocity of the impact [m/s]", fraction=0.05)
    return figure


def draw_impact_loops(axes: Axes, run: Run, p: int, colours: ScalarMappable | None = None) -> Any:
    """Force against penetration of the impacts of a contact, in colours or grey; returns the hardest, in black."""
    hardest = run.hardest([p])
    factor, unit = force_unit(hardest["peak_force"])
    penetration, force = 1e3 * run[f"contact[{p}].penetration"], run[f"contact[{p}].force"] / factor
    for impact in np.sort(run.of_contact(p), order="peak_force"):
        loop = run.rows_of(impact)
        colour = colours.to_rgba(impact["approach_velocity"]) if colours else GREY
        line: Look = {"color": colour, "linewidth": 1.0 if colours else 0.6}
        if impact["start_s"] == hardest["start_s"]:
            line = {"color": BLACK, "linewidth": 2.0}
            axes.fill(penetration[loop], force[loop], **OPEN)
        axes.plot(penetration[loop], force[loop], **line)
    axes.axhline(0, color=GREY, linewidth=0.8)
    axes.set(xlabel="penetration [mm]", ylabel=f"force [{unit}]", xlim=(0, None))
    return hardest
