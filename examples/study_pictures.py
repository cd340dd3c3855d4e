"""Pictures of a study: demand against the gap, and the probability of exceeding a limit against intensity."""

import math

import numpy as np

from engine import STANDARD_GRAVITY
from style import ALONE, BLACK, CYCLE, pyplot, save

plt = pyplot()

MOST_LINES = 5


def some(values, most=MOST_LINES):
    """As many of these, evenly spread, as lines can be told apart."""
    values = sorted(set(values))
    places = np.unique(np.linspace(0, len(values) - 1, min(most, len(values))).round().astype(int))
    return [values[place] for place in places]


def drift(row):
    return max(row["left_drift_m"], row["right_drift_m"])


def gaps(rows, never_closes, path):
    """Peak force, impacts and largest drift against the gap: median over the records and the middle two thirds."""
    free = {(row["record_id"], row["pga_m_s2"]): drift(row) for row in rows if row["gap_m"] == never_closes}
    closing = [row for row in rows if row["gap_m"] < never_closes and free.get((row["record_id"], row["pga_m_s2"]))]
    if not closing:
        return
    large = max(row["peak_force_n"] for row in closing) >= 2000
    panels = {
        f"peak contact force [{'kN' if large else 'N'}]": lambda row: row["peak_force_n"] / (1e3 if large else 1.0),
        "impacts": lambda row: row["impacts"],
        "largest drift, relative to no contact": lambda row: drift(row) / free[row["record_id"], row["pga_m_s2"]],
    }
    figure, axes = plt.subplots(1, 3, figsize=(12, 4.2))
    widths = sorted({row["gap_m"] for row in closing})
    for panel, (label, demand) in zip(axes, panels.items()):
        for pga, style in zip(some(row["pga_m_s2"] for row in closing), CYCLE):
            of_pga = [row for row in closing if row["pga_m_s2"] == pga]
            found = [[demand(row) for row in of_pga if row["gap_m"] == width] or [np.nan] for width in widths]
            low, middle, high = np.array([np.percentile(values, [16, 50, 84]) for values in found]).T
            if panel is axes[0]:
                panel.fill_between(np.array(widths) * 1e3, low, high, color=style["color"], alpha=0.15, linewidth=0)
            panel.plot(np.array(widths) * 1e3, middle, **style, markersize=4, label=f"{pga / STANDARD_GRAVITY:.2f} g")
        panel.set(xlabel="gap [mm]", ylabel=label)
    axes[2].axhline(1.0, **{**ALONE, "linewidth": 1.2})
    records = len({row["record_id"] for row in rows})
    figure.suptitle(f"{rows[0]['scene']}: medians of {records} records (shaded: the middle 68 %)", x=0.01, ha="left")
    lines = axes[0].get_legend_handles_labels()
    figure.legend(*lines, loc="outside lower center", ncols=MOST_LINES, title="peak ground acceleration")
    save(figure, path)


def fragility(rows, never_closes, limits, path):
    """Share of the records that exceed a limit, against peak ground acceleration, one curve for each gap."""
    closing = [row for row in rows if row["gap_m"] < never_closes]
    if not closing:
        return
    force_limit, drift_limit = limits
    hit = [row["peak_force_n"] for row in closing if row["peak_force_n"] > 0]
    panels = [("pounding", closing, lambda row: row["impacts"] > 0)]
    if hit:
        force, said = (force_limit, "") if force_limit is not None else (float(np.median(hit)), " (median)")
        shown = f"{force / 1e3:.3g} kN" if force >= 1e3 else f"{force:.3g} N"
        panels.append((f"force above {shown}{said}", closing, lambda row: row["peak_force_n"] > force))
    middle = float(np.median([drift(row) for row in closing]))
    bound, said = (drift_limit, "") if drift_limit is not None else (middle, " (median)")
    panels.append((f"drift above {1e3 * bound:.3g} mm{said}", rows, lambda row: drift(row) > bound))
    figure, axes = plt.subplots(1, len(panels), figsize=(4 * len(panels), 4.2), sharey=True, squeeze=False)
    drawn = some(row["gap_m"] for row in closing)
    for panel, (title, of, exceeds) in zip(axes.flat, panels):
        for gap, style in [*zip(drawn, CYCLE), (never_closes, {"color": BLACK, "linestyle": ":", "marker": "x"})]:
            label = "no contact" if gap == never_closes else f"{1e3 * gap:g} mm"
            draw_fragility(panel, [row for row in of if row["gap_m"] == gap], exceeds, style, label)
        panel.set_title(f"P({title})")
        panel.set(xlabel="peak ground acceleration [g]", ylim=(-0.03, 1.03), xlim=(0, None))
    axes[0, 0].set_ylabel("share of the records; lines: lognormal fit")
    records = len({row["record_id"] for row in rows})
    figure.suptitle(f"{rows[0]['scene']}: fragility, {records} records", x=0.01, ha="left")
    lines = axes[0, -1].get_legend_handles_labels()
    figure.legend(*lines, loc="outside lower center", ncols=MOST_LINES + 1, title="gap")
    save(figure, path)


def draw_fragility(panel, rows, exceeds, style, label):
    if not rows:
        return
    levels = np.array(sorted({row["pga_m_s2"] for row in rows}))
    counts = np.array([[exceeds(row) for row in rows if row["pga_m_s2"] == level].count(True) for level in levels])
    totals = np.array([sum(row["pga_m_s2"] == level for row in rows) for level in levels])
    colour = style["color"]
    shares = {"linestyle": "", "marker": style["marker"], "color": colour, "markersize": 5}
    panel.plot(levels / STANDARD_GRAVITY, counts / totals, **shares)
    median, beta = fit_lognormal(levels, counts, totals)
    x = np.linspace(levels[0] / 2, levels[-1], 200)
    line = {"color": colour, "linestyle": style["linestyle"], "linewidth": 1.6}
    panel.plot(x / STANDARD_GRAVITY, lognormal(x, median, beta), **line)
    panel.plot([], [], **style, markersize=5, label=label)


def lognormal(levels, median, beta):
    """Probability at these intensities; `median` and `beta` may be arrays that go with them."""
    error_function = np.vectorize(math.erf)
    return 0.5 * (1.0 + error_function(np.log(levels / median) / (beta * math.sqrt(2.0))))


def fit_lognormal(levels, counts, totals):
    """Median and dispersion of the fragility with the largest likelihood [Baker2015].

    Found on a grid that is refined: where all or no records exceed the limit at every level the likelihood has no
    largest value inside, and a grid then ends at its edge.
    """
    medians = np.geomspace(levels[0] / 10, levels[-1] * 10, 41)
    betas = np.geomspace(0.05, 2.0, 41)
    for _ in range(4):
        grid = lognormal(levels, medians[:, None, None], betas[:, None]).clip(1e-12, 1 - 1e-12)
        likelihood = np.sum(counts * np.log(grid) + (totals - counts) * np.log1p(-grid), axis=-1)
        best = np.unravel_index(np.argmax(likelihood), likelihood.shape)
        found = medians[best[0]], betas[best[1]]
        medians, betas = (around(values, place) for values, place in zip((medians, betas), best))
    return found


def around(values, place):
    return np.geomspace(values[max(0, place - 1)], values[min(len(values) - 1, place + 1)], 41)
