"""Pictures of a study: demand against the gap, and the probability of exceeding a limit against intensity."""

import textwrap

import numpy as np

from engine import STANDARD_GRAVITY
from pictures import force_unit
from study_fragility import INTENSITIES, lognormal
from study_table import NEVER_CLOSES, SIDES
from style import ALONE, BLACK, CYCLE, pyplot, save

plt = pyplot()

MOST_LINES = 5
MOST_POINTS = 8  # of a curve whose runs all differ in intensity: shares of groups of runs
NO_CONTACT = {"color": BLACK, "linestyle": ":", "marker": "x"}


def some(values, most=MOST_LINES):
    """As many of these, evenly spread, as lines can be told apart."""
    values = sorted(set(values))
    places = np.unique(np.linspace(0, len(values) - 1, min(most, len(values))).round().astype(int))
    return [values[place] for place in places]


def left_out(values, drawn, unit, name):
    """What to say of those that are not drawn."""
    missing = [f"{unit(value)}" for value in sorted(set(values) - set(drawn))]
    return f"; {name} not drawn: {', '.join(missing)}" if missing else ""


def in_g(acceleration):
    return f"{acceleration / STANDARD_GRAVITY:.2f} g"


def in_mm(gap):
    return "no contact" if gap == NEVER_CLOSES else f"{1e3 * gap:g} mm"


def gaps(rows, path):
    """Force, impacts, drifts and accelerations against the gap: medians over the records."""
    closing = [row for row in rows if row["gap_m"] != NEVER_CLOSES]
    if not closing:
        return
    factor, unit = force_unit(max(row["peak_force_n"] for row in closing))
    sides = [side for side in SIDES if any(row[f"{side}_drift_m"] is not None for row in closing)]
    of_building = lambda side, what: lambda row: row[f"{side}_{what}_ratio"]  # noqa: E731
    panels = {
        f"largest contact force [{unit}]": lambda row: row["peak_force_n"] / factor,
        **{f"{side} building: storey drift": of_building(side, "drift") for side in sides},
        "impacts": lambda row: row["impacts"],
        **{f"{side} building: floor acceleration": of_building(side, "acceleration") for side in sides},
    }
    columns = 1 + len(sides)
    figure, axes = plt.subplots(2, columns, figsize=(4 * columns, 7.2), sharex=True)
    drawn = some(row["pga_m_s2"] for row in closing)
    for panel, (title, demand) in zip(axes.flat, panels.items()):
        for pga, style in zip(drawn, CYCLE):
            of_pga = [row for row in closing if row["pga_m_s2"] == pga]
            draw_demand(panel, of_pga, demand, style, in_g(pga), shaded=panel is axes[0, 0])
        panel.set_title(title)
        if "building" in title:
            panel.axhline(1.0, **{**ALONE, "linewidth": 1.2})
            panel.set_ylabel("relative to no contact")
        panel.set_ylim(0, 1.05 * panel.get_ylim()[1])
    for panel in axes[1]:
        panel.set_xlabel("gap [mm]")
    records = len({row["record_id"] for row in rows})
    said = f"{rows[0]['scene']}: medians of {records} records (shaded: the middle 68 %); of storeys and floors the largest"
    said += left_out([row["pga_m_s2"] for row in closing], drawn, in_g, "peak ground accelerations")
    figure.suptitle(said, x=0.01, ha="left", fontsize=10.5)
    lines = axes[0, 0].get_legend_handles_labels()
    figure.legend(*lines, loc="outside lower center", ncols=MOST_LINES, title="peak ground acceleration")
    save(figure, path)


def draw_demand(panel, rows, demand, style, label, shaded):
    widths, found = [], []
    for width in sorted({row["gap_m"] for row in rows}):
        values = [demand(row) for row in rows if row["gap_m"] == width and demand(row) is not None]
        if values:
            widths.append(1e3 * width)
            found.append(np.percentile(values, [16, 50, 84]))
    if found:
        low, middle, high = np.array(found).T
        if shaded:
            panel.fill_between(widths, low, high, color=style["color"], alpha=0.15, linewidth=0)
        panel.plot(widths, middle, **style, markersize=4, label=label)


def fragility(rows, curves, intensity, path):
    """Share of the runs that exceed a limit, against intensity, one curve for each gap that there is room for."""
    if all(curve.gap == NEVER_CLOSES for curve in curves):
        return
    widths = {curve.gap for curve in curves} - {NEVER_CLOSES}
    styles = {**dict(zip(some(widths), CYCLE)), NEVER_CLOSES: NO_CONTACT}
    demands = list(dict.fromkeys(curve.demand for curve in curves))
    strongest = max(curve.levels[-1] for curve in curves)
    columns = 2
    shape = (-(-len(demands) // columns), columns)
    figure, axes = plt.subplots(*shape, figsize=(9.6, 3.9 * shape[0] + 0.6), sharex=True, sharey=True, squeeze=False)
    for panel, demand in zip(axes.flat, demands):
        shown = [curve for curve in curves if curve.demand is demand and curve.gap in styles]
        for curve in shown:
            draw_curve(panel, curve, styles[curve.gap])
        panel.set_title(f"P({demand.said})")
        panel.set(ylim=(-0.03, 1.03), xlim=(0, 1.04 * strongest / STANDARD_GRAVITY))
        panel.set_xlabel(f"{INTENSITIES[intensity][1]} [g]{without_fit(shown)}")
        panel.tick_params(labelbottom=True)
    for panel in axes.flat[len(demands) :]:
        panel.axis("off")
    for panel in axes[:, 0]:
        panel.set_ylabel("share of the runs; lines: lognormal fit")
    records = len({row["record_id"] for row in rows})
    said = f"{rows[0]['scene']}: fragility, {records} records{left_out(widths, styles, in_mm, 'gaps')}"
    figure.suptitle(said, x=0.01, ha="left")
    lines = [plt.Line2D([], [], **style, markersize=5, label=in_mm(gap)) for gap, style in styles.items()]
    figure.legend(handles=lines, loc="outside lower center", ncols=MOST_LINES + 1, title="gap")
    save(figure, path)


def without_fit(curves):
    """Which have no curve, with how many runs exceed of how many."""
    counts = [f"{in_mm(curve.gap)} ({curve.exceeds.sum()} of {len(curve.exceeds)})" for curve in curves if not curve.fit]
    # Lines end between them, not within.
    said = ", ".join(count.replace(" ", "\N{NO-BREAK SPACE}") for count in counts)
    return f"\n{textwrap.fill(f'no curve fits: {said}', 52)}" if counts else ""


def draw_curve(panel, curve, style):
    points = {"linestyle": "", "marker": style["marker"], "color": style["color"], "markersize": 5}
    levels, shares = groups(curve.levels, curve.exceeds)
    panel.plot(levels / STANDARD_GRAVITY, shares, **points)
    if curve.fit:
        x = np.linspace(levels[0] / 2, curve.levels[-1], 200)
        line = {"color": style["color"], "linestyle": style["linestyle"], "linewidth": 1.6}
        panel.plot(x / STANDARD_GRAVITY, lognormal(x, *curve.fit), **line)


def groups(levels, exceeds):
    """Intensities and the share that exceeds there: of each intensity, or of neighbours where there are too many."""
    distinct, first = np.unique(levels, return_index=True)
    if len(distinct) <= 2 * MOST_POINTS:
        parts = list(zip(np.split(levels, first[1:]), np.split(exceeds, first[1:])))
    else:
        parts = list(zip(np.array_split(levels, MOST_POINTS), np.array_split(exceeds, MOST_POINTS)))
    return np.array([np.median(of) for of, _ in parts]), np.array([share.mean() for _, share in parts])
