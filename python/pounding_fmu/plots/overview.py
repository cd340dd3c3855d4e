"""One picture of a run: the buildings with their contacts, drifts, gap and forces over time, the hardest impact, and
the hysteresis loops of storeys that yield."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure

from . import pictures
from .elevation import prepare_height
from .layout import ENDS, building
from .meetings import draw_meetings
from .pictures import MOST_PANELS, counted, force_unit, handy, legend_of_all
from .runs import Runs, Window
from .storeys import draw_all_drifts, draw_loops, most_ductile
from .style import CONTACTS

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDTH = 13.0  # inches
ROW = 3.4  # inches: a row of buildings above all else
LETTERS = 11  # of the title, in an inch
MOST_NUMBERS = 16  # of floors and contacts that the drawing of the buildings has room for
AROUND = 0.25  # s, before and after an impact that takes no time


def overview(runs: Runs) -> Figure:
    """As many rows as there are kinds of things that happen; more than two buildings stand above them."""
    window, hardest = runs.seen(0.0, runs.stop), runs.hardest
    ductile = most_ductile(runs, 1)
    rows = 2 + (hardest is not None) + bool(ductile)
    charts, above = 2.4 + 2.05 * rows, 0.0 if runs.scene.is_pair else ROW
    figure = Figure(figsize=(WIDTH, charts + above))
    figure.suptitle(textwrap.fill(heading(runs), int(LETTERS * WIDTH)), x=0.01, ha="left", fontsize=12)
    if above:
        whole = figure.add_gridspec(2, 1, height_ratios=[above, charts])
        draw_at_rest(figure.add_subplot(whole[0]), runs)
        both: Any = whole[1].subgridspec(1, 2, width_ratios=[1, 1.7])
        draw_all(figure, both[0], runs)
    else:
        both = figure.add_gridspec(1, 2, width_ratios=[1, 1.7])
        draw_buildings(figure, both[0].subgridspec(2, 1, height_ratios=[1.5, 1]), runs)
    grid = both[1].subgridspec(rows, 1)
    between = figure.add_subplot(grid[0])
    below = figure.add_subplot(grid[1], sharex=between)
    below.set(xlabel="time [s]", xlim=window)
    between.tick_params(labelbottom=False)
    draw_gap(between, runs, window)
    if hardest is None:
        draw_roofs(below, runs, window, "acceleration", "roof acceleration [m/s²]", 1.0)
    else:
        draw_forces(below, runs, window)
        draw_hardest(figure, grid[2], runs)
    if ductile:
        draw_yielding(figure, grid[rows - 1], runs, ductile)
    return figure


def heading(runs: Runs) -> str:
    """What happened, in a sentence."""
    hardest, name = runs.hardest, f"{runs.scene.name}, {runs.stop:g} s"
    if collapse := runs.collapse(runs.run):
        side, storey, time = collapse
        where = f"the {side} building" if side in ENDS else side
        name = f"{runs.scene.name}, storey {storey} of {where} collapsed at {time:.3f} s"
    every, shown = len(runs.run.impacts), sum(len(runs.run.of_contact(p)) for p in runs.contacts)
    of = " and ".join(runs.buildings)
    among = f", {shown} of them at {of}" if 0 < shown < every else ""
    if hardest is None:
        nothing = f"{counted(every)}, none at {of}" if every else "no impact"
        return f"{name}: {nothing if runs.scene.contacts else 'no contacts'}"
    p = hardest["contact"]
    is_rigid = runs.scene.contacts[p - 1].is_rigid
    how = handy(hardest["impulse"], "N s") if is_rigid else handy(hardest["peak_force"], "N")
    when = hardest["start_s"] if is_rigid else hardest["peak_time_s"]
    return f"{name}: {counted(every)}{among}, the hardest with {how} at contact {p} at {when:.3f} s"


def draw_buildings(figure: Figure, grid: Any, runs: Runs) -> None:
    """The buildings to scale with their contacts, and the drifts of their storeys below."""
    draw_at_rest(figure.add_subplot(grid[0]), runs)
    draw_all(figure, grid[1], runs)


def draw_at_rest(axes: Axes, runs: Runs) -> None:
    hardest = runs.hardest
    draw_meetings(axes, runs.scene, MOST_NUMBERS, None if hardest is None else hardest["contact"])


def draw_all(figure: Figure, place: Any, runs: Runs) -> None:
    """The drifts of the storeys of these buildings."""
    panels = place.subgridspec(1, len(runs.buildings)).subplots(sharey=True, squeeze=False)[0]
    draw_all_drifts(panels, runs)
    for axes in panels:
        axes.set_xlabel("drift [mm]")
    prepare_height(panels[0], runs.scene, of=runs.buildings)
    panels[0].set_ylabel("level [m]" if runs.scene.has_levels else "floor")
    legend_of_all(figure, panels, "outside lower left")


def draw_gap(axes: Axes, runs: Runs, window: Window) -> None:
    """Both sides of the contact of the hardest impact; without impacts of the one that came nearest to one."""
    if not runs.contacts:
        draw_roofs(axes, runs, window, "displacement", "roof displacement [mm]", 1e3)
        return
    p = runs.hardest_contact(runs.contacts)
    pair = runs.scene.contacts[p - 1]
    hits = pictures.draw_edges(axes, runs, p, window)
    left = -1e3 * runs.run[f"contact[{p}].penetration"].max()
    happened = counted(hits) if hits or left <= 0 else f"open by {left:.3g} mm at least"
    axes.set_title(f"Contact {p}: {pair.name}; gap {1e3 * pair.gap:g} mm at rest, {happened}")
    axes.legend(loc="upper right", ncols=3, fontsize=8.5)


def draw_roofs(axes: Axes, runs: Runs, window: Window, quantity: str, label: str, factor: float) -> None:
    shown = runs.run.rows(*window)
    for side in runs.buildings:
        column = factor * runs.run[f"{side}.{quantity}[{runs.scene.floors[side]}]"]
        axes.plot(runs.run.time[shown], column[shown], label=building(side), **runs.scene.looks[side])
    axes.set_ylabel(label)
    axes.legend(loc="upper right", ncols=2, fontsize=8.5)


def draw_forces(axes: Axes, runs: Runs, window: Window) -> None:
    """Forces of the contacts with the largest impulses; impulses where all are rigid."""
    run = runs.run
    hit = [p for p in sorted(pictures.busiest(runs)) if len(run.of_contact(p))]
    soft = [p for p in hit if not runs.scene.contacts[p - 1].is_rigid]
    if not soft:
        pictures.draw_impulses(axes, run.impacts[np.isin(run.impacts["contact"], runs.contacts)])
        axes.set_title("Impulses of rigid contacts")
        return
    factor, unit = force_unit(max(run.hardest([p])["peak_force"] for p in soft))
    by_force = sorted(soft, key=lambda p: -float(run.hardest([p])["peak_force"]))
    for p, colour in zip(soft, CONTACTS):
        # The weaker in front of the stronger.
        pictures.draw_bursts(axes, run, p, factor, color=colour, zorder=2 + 0.1 * by_force.index(p))
    few = " of those with the largest impulses" if len(soft) == MOST_PANELS < len(runs.contacts) else ""
    axes.set(title=f"Contact forces{few}; dots: the largest of each impact", ylabel=f"force [{unit}]")
    axes.legend(loc="upper right", ncols=len(soft), fontsize=8.5)
    if any(window[0] <= start <= window[1] for start in run.impacts["start_s"]):
        shown = run.rows(*window)
        top = max(run[f"contact[{p}].force"][shown].max() for p in soft) / factor
        axes.set_ylim(top=1.25 * top if top > 0 else None)


def draw_hardest(figure: Figure, place: Any, runs: Runs) -> None:
    """The hardest impact from near: its force, and what it loses; of rigid floors how they come and go."""
    hardest = runs.hardest
    p = int(hardest["contact"])
    pair = runs.scene.contacts[p - 1]
    if pair.is_rigid:
        axes = figure.add_subplot(place)
        start = hardest["start_s"]
        near = max(0.0, start - AROUND), min(runs.stop, start + AROUND)
        pictures.draw_edges(axes, runs, p, near)
        axes.set(title=f"Around the hardest: {handy(hardest['impulse'], 'N s')}", xlabel="time [s]", xlim=near)
        return
    over_time, loop = place.subgridspec(1, 2).subplots()
    factor, unit = force_unit(hardest["peak_force"])
    pictures.draw_hardest(over_time, runs.run, p, factor)
    over_time.set_ylabel(f"force [{unit}]")
    pictures.draw_impact_loops(loop, runs.run, p)
    loop.set_title(f"{handy(hardest['dissipated_energy'], 'J')} lost, {pair.law}")


def draw_yielding(figure: Figure, place: Any, runs: Runs, ductile: dict[str, list[int]]) -> None:
    """Of each building the loops of the storey with the largest ductility."""
    panels = place.subgridspec(1, len(ductile)).subplots(squeeze=False)[0]
    for axes, (side, (storey,)) in zip(panels, ductile.items()):
        factor, unit = force_unit(float(np.abs(runs.run[f"{side}.storey_shear[{storey}]"]).max()))
        draw_loops(axes, runs, side, storey, factor)
        axes.set(xlabel="drift [mm]", ylabel=f"storey shear [{unit}]")
