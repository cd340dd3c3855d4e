"""What plot_scene.py draws of a run, a function each; it returns a figure, or None where it has no subject."""

import numpy as np

from elevation import prepare_height
from engine import STANDARD_GRAVITY
from style import ALONE, BLACK, BUILDINGS, FORCE, GREY, OPEN, OVERLAP, VERMILION, WALL, pyplot

plt = pyplot()

# As many contacts as one picture can show: those with the largest impulse.
MOST_PANELS = 4


def busiest(scene, run, most=MOST_PANELS):
    """Contacts (counted from 1) that are worth a panel, the highest first."""
    impulse = {p: sum(impact["impulse"] for impact in run.of_contact(p)) for p in range(1, len(scene.contacts) + 1)}
    chosen = sorted(impulse, key=impulse.get, reverse=True)[:most]
    return sorted(chosen, key=lambda p: scene.contacts[p - 1].height, reverse=True)


def name_of(scene, p, begins=False):
    name = scene.contacts[p - 1].name
    return name[:1].upper() + name[1:] if begins else name


def handy(value, unit, digits=3):
    """A number with its unit, and k, M before it where that is shorter."""
    for factor, prefix in [(1e6, "M"), (1e3, "k")]:
        if abs(value) >= factor:
            return f"{value / factor:.{digits}g} {prefix}{unit}"
    return f"{value:.{digits}g} {unit}"


def force_unit(largest):
    """What to divide forces by, and the unit they are in then."""
    return next((unit for unit in [(1e6, "MN"), (1e3, "kN")] if largest >= 2 * unit[0]), (1.0, "N"))


def over_time(rows, heights, window, **more):
    figure, panels = plt.subplots(rows, 1, figsize=(9, heights * rows + 0.6), sharex=True, squeeze=False, **more)
    panels[-1, 0].set(xlabel="time [s]", xlim=window)
    return figure, panels[:, 0]


def floors(scene, run, alone, window):
    """Facing edges with the gap between them: shaded where it is open, hatched where they press."""
    contacts = busiest(scene, run)
    if not contacts:
        return None
    figure, panels = over_time(len(contacts), 2.7, window)
    shown = (run.time >= window[0]) & (run.time <= window[1])
    for axes, p in zip(panels, contacts):
        pair = scene.contacts[p - 1]
        clock = run.time[shown]
        left, right = (1e3 * edge[shown] for edge in pair.edges(run))
        axes.fill_between(clock, left, right, where=right >= left, **OPEN)
        axes.fill_between(clock, left, right, where=left > right, **OVERLAP)
        for edge, surface in [(right, pair.surfaces["right"]), (left, pair.surfaces["left"])]:
            draw_edge(axes, clock, edge, surface)
        hits = [impact["start_s"] for impact in run.of_contact(p) if window[0] <= impact["start_s"] <= window[1]]
        bottom = min(left.min(), right.min()) - 0.08 * np.ptp([left, right])
        axes.plot(hits, np.full(len(hits), bottom), "^", color=BLACK, markersize=4, label="impact")
        impacts = "1 impact" if len(hits) == 1 else f"{len(hits)} impacts"
        axes.set_title(f"{name_of(scene, p, begins=True)}: {impacts}; shaded: the gap, {1e3 * pair.gap:g} mm at rest")
        axes.set_ylabel("position [mm]")
        axes.margins(y=0.12)
    lines = {label: line for axes in panels for line, label in zip(*axes.get_legend_handles_labels())}
    figure.legend(lines.values(), lines.keys(), loc="outside upper right", ncols=len(lines))
    return figure


def draw_edge(axes, clock, edge, surface):
    side = surface.get("side")
    axes.plot(clock, edge, label=f"{side} building" if side else "wall", **BUILDINGS.get(side, WALL))


def is_rigid(scene, p):
    return scene.contacts[p - 1].law == "stereomechanical"


def forces(scene, run, alone, window):
    """Bursts of contact force over the run, and the hardest of each contact from near; impulses of rigid contacts."""
    contacts = [p for p in busiest(scene, run) if run.of_contact(p)]
    if not contacts:
        return None
    figure, panels = plt.subplots(
        len(contacts), 2, figsize=(9, 2.3 * len(contacts) + 0.8), squeeze=False, width_ratios=[2.5, 1]
    )
    factor, unit = force_unit(max(run.hardest(p)["peak_force"] for p in contacts))
    for (bursts, near), p in zip(panels, contacts):
        title = f"{name_of(scene, p, begins=True)}: {len(run.of_contact(p))} impacts"
        bursts.set(title=title, xlim=(0, run.time[-1]))
        if is_rigid(scene, p):
            draw_impulses(bursts, run.of_contact(p))
            near.axis("off")
            continue
        # In one unit, to a scale for each contact: one may press a hundred times as hard as another.
        draw_bursts(bursts, run, p, factor, unit)
        draw_hardest(near, run, p, factor)
        near.set_ylim(bursts.get_ylim())
    panels[-1, 0].set_xlabel("time [s]")
    return figure


def draw_impulses(axes, impacts):
    """Exchanges of momentum in no time, and what pressed rigid floors while they were held together."""
    impulses = [impact["impulse"] for impact in impacts]
    factor, unit = force_unit(max(impulses))
    axes.vlines([impact["start_s"] for impact in impacts], 0, np.array(impulses) / factor, color=BLACK, linewidth=1.1)
    axes.set_ylabel(f"impulse [{unit} s]")


def draw_bursts(axes, run, p, factor, unit):
    axes.plot(run.time, run[f"contact[{p}].force"] / factor, **FORCE)
    peaks = [(impact["peak_time_s"], impact["peak_force"] / factor) for impact in run.of_contact(p)]
    axes.plot(*zip(*peaks), ".", color=VERMILION, markersize=4)
    axes.set_ylabel(f"contact force [{unit}]")


def draw_hardest(axes, run, p, factor):
    hardest = run.hardest(p)
    start, end = hardest["start_s"], np.nan_to_num(hardest["end_s"], nan=run.time[-1])
    clock, margin = 1e3 * (run.time - start), 0.35 * 1e3 * (end - start)
    around = (clock >= -margin) & (clock <= 1e3 * (end - start) + margin)
    force = run[f"contact[{p}].force"][around] / factor
    axes.plot(clock[around], force, color=BLACK, linewidth=1.6)
    axes.fill_between(clock[around], 0, force, **OPEN)
    axes.set_title(f"Hardest: {handy(hardest['peak_force'], 'N')}, {handy(hardest['impulse'], 'N s')}")
    axes.set_xlabel(f"ms after {start:.4f} s")


def accelerations(scene, run, alone, window):
    """The floors of the hardest impact with and without contact."""
    hardest = run.hardest()
    if hardest is None:
        return None
    row = scene.contacts[hardest["contact"] - 1].row
    figure, panels = over_time(len(row), 3.0, window)
    for axes, (side, floor, _) in zip(panels, row):
        name = f"{side}.acceleration[{floor}]"
        largest = []
        for one, label, line in [
            (run, "pounding", {**BUILDINGS[side], "linestyle": "-", "linewidth": 1.0}),
            (alone, "without contact", ALONE),
        ]:
            g = one[name] / STANDARD_GRAVITY
            shown = (one.time >= window[0]) & (one.time <= window[1])
            axes.plot(one.time[shown], g[shown], label=label, **line)
            largest.append(one[name.replace("acceleration", "peak_acceleration")][-1] / STANDARD_GRAVITY)
        axes.set_title(
            f"Floor {floor}, {side} building: up to {largest[0]:.3g} g in the run, {largest[1]:.3g} g without contact"
        )
        axes.set_ylabel("acceleration [g]")
        axes.legend(loc="lower right", ncols=2)
    return figure


def hysteresis(scene, run, alone, window):
    """Force against penetration of every impact, the hardest in black: what a loop encloses is lost in it."""
    contacts = [p for p in busiest(scene, run) if run.of_contact(p) and not is_rigid(scene, p)]
    if not contacts:
        return None
    columns = min(2, len(contacts))
    rows = -(-len(contacts) // columns)
    figure, panels = plt.subplots(rows, columns, figsize=(4.5 * columns + 1, 3.9 * rows), squeeze=False)
    fastest = max(impact["approach_velocity"] for p in contacts for impact in run.of_contact(p))
    colours = plt.cm.ScalarMappable(plt.Normalize(0, fastest or 1.0), plt.colormaps["viridis_r"])
    for axes, p in zip(panels.flat, contacts):
        hardest = run.hardest(p)
        factor, unit = force_unit(hardest["peak_force"])
        penetration, force = 1e3 * run[f"contact[{p}].penetration"], run[f"contact[{p}].force"] / factor
        for impact in sorted(run.of_contact(p), key=lambda impact: impact["peak_force"]):
            first, last = np.searchsorted(run.time, [impact["start_s"], np.nan_to_num(impact["end_s"], nan=np.inf)])
            loop = slice(first, last)
            line = {"color": colours.to_rgba(impact["approach_velocity"]), "linewidth": 1.0}
            if impact is hardest:
                line = {"color": BLACK, "linewidth": 2.0}
                axes.fill(penetration[loop], force[loop], **OPEN)
            axes.plot(penetration[loop], force[loop], **line)
        axes.axhline(0, color=GREY, linewidth=0.8)
        lost = handy(hardest["dissipated_energy"], "J")
        name, law = name_of(scene, p, begins=True), scene.contacts[p - 1].law
        # In a line of its own where both are too long for one.
        title = f"{name}, {law}" if len(name) + len(law) < 45 else f"{name}\n{law}"
        axes.set_title(f"{title}\n{len(run.of_contact(p))} impacts; the hardest (black): {lost} lost")
        axes.set(xlabel="penetration [mm]", ylabel=f"force [{unit}]", xlim=(0, None))
    for axes in panels.flat[len(contacts) :]:
        axes.axis("off")
    figure.colorbar(colours, ax=panels, label="approach velocity of the impact [m/s]", fraction=0.05)
    return figure


def drifts(scene, run, alone, window):
    """Largest inter-storey drifts of either sign over the height, with and without contact."""
    sides = list(scene.floors)
    height = 1.8 + 0.5 * min(12, max(scene.floors.values()))
    figure, panels = plt.subplots(1, len(sides), figsize=(4 * len(sides) + 0.4, height), sharey=True, squeeze=False)
    panels = panels[0]
    largest = 0.0
    for axes, side in zip(panels, sides):
        style = BUILDINGS[side]
        levels = scene.levels[side]
        for one, label, line in [
            (run, f"{side}, pounding", {**style, "linestyle": "-"}),
            (alone, "without contact", ALONE),
        ]:
            at = [np.zeros_like(one.time)] + [one[f"{side}.displacement[{i}]"] for i in range(1, len(levels))]
            drift = 1e3 * np.diff(at, axis=0)
            low, high = drift.min(axis=1), drift.max(axis=1)
            largest = max(largest, -low.min(), high.max())
            if one is run:
                axes.stairs(
                    high, levels, baseline=low, orientation="horizontal", fill=True, alpha=0.2, color=line["color"]
                )
            for bound in (low, high):
                named = label if bound is low else None
                axes.stairs(bound, levels, orientation="horizontal", baseline=None, label=named, **line)
        axes.axvline(0, color=GREY, linewidth=0.8)
        axes.set_title(f"{side.capitalize()} building")
        axes.set_xlabel("inter-storey drift, least and largest [mm]")
        touched = {pair.height_on(side, scene.levels) for pair in scene.contacts} - {None}
        axes.plot(np.zeros(len(touched)), sorted(touched), "D", color=BLACK, markersize=4, zorder=3)
    prepare_height(panels[0], scene, "diamond: a contact")
    for axes in panels:
        axes.set_xlim(-1.08 * largest, 1.08 * largest)
    lines = {label: line for axes in panels for line, label in zip(*axes.get_legend_handles_labels())}
    labels = sorted(lines, key="without contact".__eq__)
    figure.legend([lines[label] for label in labels], labels, loc="outside lower center", ncols=3)
    return figure
