"""Pictures of a study: demand against the gap, and the probability of exceeding a limit against intensity."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from .._extras import require
from ..plots.style import ALONE, BLACK, CYCLE, LOOK, save
from .cases import LINK, NEVER_CLOSES, SIDES, Factor, Row, collapsed, sides_of, varied_values
from .fragility import Curve, force_unit, intensity_of, lognormal, points

Chosen = Sequence[float] | None  # gaps or intensities to draw; without any as many as can be told apart

STANDARD_GRAVITY = 9.80665  # m/s2
MOST_LINES = 5
MOST_BUILDINGS = 2  # whose panels show all of a row
MOST_COLUMNS = 3
MOST_NAMES = 20  # below a panel
NO_CONTACT = {"color": BLACK, "linestyle": ":", "marker": "x"}
LETTERS = 14  # that an inch of a title may have room for


def gaps(rows: Sequence[Row], path: Path, shown: Chosen = None) -> None:
    """Force, impacts, drifts and accelerations against the gap at some intensities: medians over the records, of runs that
    do not collapse."""
    closing = [row for row in rows if row["gap_m"] != NEVER_CLOSES]
    standing = [row for row in closing if not collapsed(row)]
    fallen = len(closing) - len(standing)
    if standing:
        _draw(path, lambda: _gaps(standing, shown, f"; without {fallen} runs that collapse" if fallen else ""))


def fragility(curves: Sequence[Curve], records: int, path: Path, shown: Chosen = None) -> None:
    """Share of the runs that exceed a limit, against intensity, one curve for each of some gaps."""
    if any(curve.gap != NEVER_CLOSES for curve in curves):
        _draw(path, lambda: _fragility(curves, records, shown))


def varied(rows: Sequence[Row], name: str, scene: str, path: Path, shown: tuple[Chosen, Chosen] = (None, None)) -> None:
    """Impacts, contact force and the largest force of a link against a parameter, a column of panels for each of some gaps:
    medians over the records, of runs that do not collapse."""
    closing = [row for row in rows if row["gap_m"] != NEVER_CLOSES and not collapsed(row)]
    if closing:
        _draw(path, lambda: _varied(closing, name, scene, shown))


def row(rows: Sequence[Row], path: Path, shown: tuple[Chosen, Chosen] = (None, None)) -> None:
    """The largest drift and acceleration of each building of a row, relative to no contact, over its place: a line for each of
    some gaps, medians over the records of runs that do not collapse, a column of panels for each of some intensities."""
    closing = [row for row in rows if row["gap_m"] != NEVER_CLOSES and not collapsed(row)]
    if closing and len(standing_in(closing)) > MOST_BUILDINGS:
        _draw(path, lambda: _row(closing, shown))


def _row(closing: Sequence[Row], shown: tuple[Chosen, Chosen]) -> Any:
    sides = standing_in(closing)
    widths, peaks = some((row["gap_m"] for row in closing), shown[0]), some((row["pga_m_s2"] for row in closing), shown[1])
    drawn = peaks if shown[1] is not None else peaks[-MOST_COLUMNS:]
    figure, axes = _panels(2, len(drawn), max(4.2 * len(drawn), 7.5) + 0.05 * len(sides), 6.6, sharex=True, sharey="row")
    places = range(1, len(sides) + 1)
    for column, pga in zip(axes.T, drawn):
        for panel, (what, title) in zip(column, (("drift", "storey drift"), ("acceleration", "floor acceleration"))):
            for width, style in zip(widths, CYCLE):
                of_line = [row for row in closing if row["pga_m_s2"] == pga and row["gap_m"] == width]
                ratios = [[row[f"{side}_{what}_ratio"] for row in of_line] for side in sides]
                known = [[ratio for ratio in of if ratio is not None] for of in ratios]
                medians = [np.median(of) if of else np.nan for of in known]
                panel.plot(places, medians, **style, markersize=4 if len(sides) <= MOST_NAMES else 2, label=in_mm(width))
            panel.axhline(1.0, **{**ALONE, "linewidth": 1.2})
            panel.set_title(f"{title}, {in_g(pga)}")
        every = -(-len(sides) // MOST_NAMES)
        named = [place for place in places if place % every == 1 or every == 1]
        column[-1].set_xticks(named, [sides[place - 1] for place in named], rotation=90 if len("".join(sides)) > 30 else 0)
    for beside in axes:
        beside[0].set_ylabel("relative to no contact")
        # All panels beside each other have these limits, once all are drawn.
        beside[0].set_ylim(0, 1.05 * max(np.nanmax(line.get_ydata()) for panel in beside for line in panel.lines))
    records = len({row["record_id"] for row in closing})
    said = f"{closing[0]['scene']}: ends and middle, medians of {records} records; of storeys and floors the largest"
    said += left_out([row["pga_m_s2"] for row in closing], drawn, in_g, "peak ground accelerations")
    _title(figure, said + left_out([row["gap_m"] for row in closing], widths, in_mm, "gaps"))
    lines = axes[0, 0].get_legend_handles_labels()
    title = "gap, times that of the scene" if isinstance(widths[0], Factor) else "gap"
    figure.legend(*lines, loc="outside lower center", ncols=len(CYCLE), title=title)
    return figure


def _draw(path: Path, draw: Callable[[], Any]) -> None:
    matplotlib = require("matplotlib", extra="plot")
    with matplotlib.rc_context(LOOK):
        figure = draw()
    save(figure, path)


def _panels(rows: int, columns: int, width: float, height: float, **more: Any) -> tuple[Any, Any]:
    figure = require("matplotlib.figure", extra="plot").Figure(figsize=(width, height))
    return figure, figure.subplots(rows, columns, squeeze=False, **more)


def _title(figure: Any, text: str) -> None:
    """Above all, in as many lines as it takes."""
    for letters in range(LETTERS * int(figure.get_figwidth()), LETTERS, -LETTERS // 2):
        title = figure.suptitle(textwrap.fill(text, letters), x=0.01, ha="left", fontsize=10.5)
        if title.get_window_extent().x1 <= figure.bbox.x1:
            break


def some(values: Iterable[float], shown: Chosen = None) -> list[float]:
    """Those that are asked for, or as many, evenly spread, as lines can be told apart."""
    values = sorted(set(values))
    if shown is not None:
        return [value for value in values if value in shown]
    places = np.unique(np.linspace(0, len(values) - 1, min(MOST_LINES, len(values))).round().astype(int))
    return [values[place] for place in places]


def left_out(values: Iterable[float], drawn: Iterable[float], unit: Callable[[float], str], name: str) -> str:
    """What to say of those that are not drawn."""
    missing = [unit(value) for value in sorted(set(values) - set(drawn))]
    return f"; {name} not drawn: {', '.join(missing)}" if missing else ""


def in_g(acceleration: float) -> str:
    return f"{acceleration / STANDARD_GRAVITY:.2f} g"


def in_mm(gap: float) -> str:
    if isinstance(gap, Factor):
        return f"\N{MULTIPLICATION SIGN} {gap:g}"
    return "no contact" if gap == NEVER_CLOSES else f"{1e3 * gap:g} mm"


def _gaps(closing: Sequence[Row], shown: Chosen, apart: str) -> Any:
    factor, unit = force_unit(max(row["peak_force_n"] for row in closing))
    sides = shown_of(standing_in(closing))
    panels: dict[str, Callable[[Row], Any]] = {f"largest contact force [{unit}]": lambda row: row["peak_force_n"] / factor}
    for what, title in (("drift", "storey drift"), ("acceleration", "floor acceleration")):
        for side in sides:
            panels[f"{side}{' building' * (side in SIDES)}: {title}"] = lambda row, name=f"{side}_{what}_ratio": row[name]  # type: ignore[misc]
        panels.setdefault("impacts", lambda row: row["impacts"])
    figure, axes = _panels(2, 1 + len(sides), 4 * (1 + len(sides)), 7.2, sharex=True)
    drawn = some((row["pga_m_s2"] for row in closing), shown)
    for panel, (title, demand) in zip(axes.flat, panels.items()):
        for pga, style in zip(drawn, CYCLE):
            of_pga = [row for row in closing if row["pga_m_s2"] == pga]
            _demand(panel, of_pga, demand, {**style, "label": in_g(pga)}, shaded=panel is axes[0, 0])
        panel.set_title(title)
        if ": " in title:
            panel.axhline(1.0, **{**ALONE, "linewidth": 1.2})
            panel.set_ylabel("relative to no contact")
        panel.set_ylim(0, 1.05 * panel.get_ylim()[1])
    for panel in axes[1]:
        panel.set_xlabel(gap_axis(closing))
    records = len({row["record_id"] for row in closing})
    said = f"{closing[0]['scene']}: medians of {records} records (shaded: the middle 68 %); of storeys and floors the largest"
    said += apart + left_out([row["pga_m_s2"] for row in closing], drawn, in_g, "peak ground accelerations")
    _title(figure, said)
    lines = axes[0, 0].get_legend_handles_labels()
    figure.legend(*lines, loc="outside lower center", ncols=len(CYCLE), title="peak ground acceleration")
    return figure


def _varied(closing: Sequence[Row], name: str, scene: str, shown: tuple[Chosen, Chosen]) -> Any:
    def parameter(row: Row) -> float:
        return varied_values(row["varied"])[name]

    def of_links(row: Row) -> float | None:
        forces = [value for column, value in row.items() if column.startswith(f"{LINK}_force_n[") and value is not None]
        return max(forces) / 1e3 if forces else None

    panels: dict[str, Callable[[Row], Any]] = {"impacts": lambda row: row["impacts"]}
    panels["largest contact force [kN]"] = lambda row: row["peak_force_n"] / 1e3
    if any(of_links(row) is not None for row in closing):
        panels["largest force of a link [kN]"] = of_links
    widths, drawn = (some((row[of] for row in closing), which) for of, which in zip(("gap_m", "pga_m_s2"), shown))
    figure, axes = _panels(len(panels), len(widths), max(4 * len(widths), 6), 2.6 * len(panels) + 1, sharex=True, sharey="row")
    for column, width in zip(axes.T, widths):
        for panel, (title, demand) in zip(column, panels.items()):
            for pga, style in zip(drawn, CYCLE):
                of_line = [row for row in closing if row["gap_m"] == width and row["pga_m_s2"] == pga]
                _demand(panel, of_line, demand, {**style, "label": in_g(pga)}, shaded=True, along=parameter)
            panel.set_title(f"{title}, gap {in_mm(width)}")
            panel.set_ylim(bottom=0)
        column[-1].set_xlabel(name)
    records = len({row["record_id"] for row in closing})
    _title(figure, f"{scene}: medians of {records} records (shaded: the middle 68 %)")
    lines = axes[0, 0].get_legend_handles_labels()
    figure.legend(*lines, loc="outside lower center", ncols=len(CYCLE), title="peak ground acceleration")
    return figure


def gap_in_mm(row: Row) -> float:
    """Where a gap is drawn: in mm, or as a factor on those of the scene."""
    return float(row["gap_m"]) * (1.0 if isinstance(row["gap_m"], Factor) else 1e3)


def gap_axis(rows: Sequence[Row]) -> str:
    return "factor on the gaps of the scene" if isinstance(rows[0]["gap_m"], Factor) else "gap [mm]"


def standing_in(rows: Sequence[Row]) -> list[str]:
    """The buildings that a scene has, from left to right: others have nothing in the columns of a table."""
    return [side for side in sides_of(rows[0]) if any(row.get(f"{side}_drift_m") is not None for row in rows)]


def shown_of(sides: Sequence[str]) -> list[str]:
    """Both of two buildings; of a row the ends and the one in the middle."""
    return list(sides) if len(sides) <= MOST_BUILDINGS else [sides[0], sides[len(sides) // 2], sides[-1]]


def _demand(
    panel: Any,
    rows: Sequence[Row],
    demand: Callable[[Row], Any],
    style: Mapping[str, Any],
    shaded: bool,
    along: Callable[[Row], float] = gap_in_mm,
) -> None:
    """Median and middle 68 % of a demand, along the gap or whatever it is that is varied."""
    places, found = [], []
    for place in sorted({along(row) for row in rows}):
        values = [demand(row) for row in rows if along(row) == place and demand(row) is not None]
        if values:
            places.append(place)
            found.append(np.percentile(values, [16, 50, 84]))
    if found:
        low, middle, high = np.array(found).T
        if shaded:
            panel.fill_between(places, low, high, color=style["color"], alpha=0.15, linewidth=0)
        panel.plot(places, middle, **style, markersize=4)


def _fragility(curves: Sequence[Curve], records: int, shown: Chosen) -> Any:
    widths = {curve.gap for curve in curves} - {NEVER_CLOSES}
    styles = {**dict(zip(some(widths, shown), CYCLE)), NEVER_CLOSES: NO_CONTACT}
    demands = list(dict.fromkeys(curve.demand for curve in curves))
    strongest = max(curve.levels[-1] for curve in curves)
    rows = -(-len(demands) // 2)
    figure, axes = _panels(rows, 2, 9.6, 3.9 * rows + 0.6, sharex=True, sharey=True)
    for panel, demand in zip(axes.flat, demands):
        drawn = [curve for curve in curves if curve.demand is demand and curve.gap in styles]
        for curve in drawn:
            _curve(panel, curve, styles[curve.gap])
        panel.set_title(f"P({demand.said})")
        panel.set(ylim=(-0.03, 1.03), xlim=(0, 1.04 * strongest / STANDARD_GRAVITY))
        panel.set_xlabel(f"{intensity_of(drawn[0].intensity)[1]} [g]{notes(drawn)}")
        panel.tick_params(labelbottom=True)
    for panel in axes.flat[len(demands) :]:
        panel.axis("off")
    for panel in axes[:, 0]:
        panel.set_ylabel("share of the runs; lines: lognormal fit")
    _title(figure, f"{curves[0].scene}: fragility, {records} records{left_out(widths, styles, in_mm, 'gaps')}")
    lines = require("matplotlib.lines", extra="plot")
    handles = [lines.Line2D([], [], **style, markersize=5, label=in_mm(gap)) for gap, style in styles.items()]
    figure.legend(handles=handles, loc="outside lower center", ncols=MOST_LINES + 1, title="gap")
    return figure


def notes(curves: Sequence[Curve]) -> str:
    """Which gaps have no curve, and why, with how many runs exceed of how many; whose median is beyond all motions."""
    found: dict[str, list[str]] = {}
    for curve in curves:
        if curve.fit is None:
            why = "no curve, shares fall" if curve.falls else "no curve fits"
            found.setdefault(why, []).append(f"{in_mm(curve.gap)} ({curve.exceeds.sum()} of {len(curve.exceeds)})")
        elif curve.is_extrapolated:
            found.setdefault("median beyond all runs", []).append(f"{in_mm(curve.gap)} ({in_g(curve.fit[0])})")
    # Lines end between them, not within.
    lines = [f"{why}: " + ", ".join(gap.replace(" ", "\N{NO-BREAK SPACE}") for gap in gaps) for why, gaps in found.items()]
    return "".join(f"\n{textwrap.fill(line, 52)}" for line in lines)


def _curve(panel: Any, curve: Curve, style: Mapping[str, Any]) -> None:
    """Points, and between the weakest and the strongest of them the curve: beyond there is nothing that it rests on."""
    marks = {"linestyle": "", "marker": style["marker"], "color": style["color"], "markersize": 5}
    levels, shares, _ = points(curve.levels, curve.exceeds)
    panel.plot(levels / STANDARD_GRAVITY, shares, **marks)
    if curve.fit:
        x = np.linspace(levels[0], levels[-1], 200)
        line = {"color": style["color"], "linestyle": style["linestyle"], "linewidth": 1.6}
        panel.plot(x / STANDARD_GRAVITY, lognormal(x, *curve.fit), **line)
