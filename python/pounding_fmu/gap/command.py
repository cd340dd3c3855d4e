"""The command ``pounding-fmu gap``."""

from __future__ import annotations

import argparse
import csv
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from statistics import fmean
from typing import TYPE_CHECKING

from .. import _native, _record_options, _terminal
from .._scenes import read_file, read_scene, warn
from .row import RowSearch
from .search import ENDS, Cost, RequiredGap, Search

if TYPE_CHECKING:
    from .._scenes import Record, Scene

MOST_BUILDINGS = 6  # that have a column each in the table of costs
OF_ROWS = ("between", "force_factor")  # columns of a table that are those of a row

ABOUT = """\
How wide a gap keeps the buildings apart, in each ground motion and in all, beside the rules of codes.

The gap is the same at all contacts, whatever theirs are in the scene; in a row of [[building]] tables each two neighbours
have their own, from which on they do not meet if no other buildings do. It is found to a thousandth of a millimetre. A run goes
to the end of its record, or to the scene's stop_time where that is later. Links of the scene are in all runs.
"""
EXAMPLE = "example:\n  pounding-fmu gap offices.toml --records A.AT2 B.AT2 --pga 2 4 --force 1e6"
RULES = """\
sum       of the largest displacements a and b of both buildings where they meet: enough in every motion
SRSS      root of a2 + b2: Eurocode 8 and ASCE 7 for two buildings on one property, by the displacements of design
0.7 SRSS  what Eurocode 8 allows where floors are at the same levels, in place of SRSS
DDC       root of a2 + b2 - 2 rho a b, with the correlation rho of the first modes of both buildings"""

LINKED = """\
links     are in all runs; a and b are displacements with them, and rules for buildings that move without them have no value"""

SOIL = """\
soil      is in all runs; a and b are displacements on it, and DDC, which is of periods on a fixed base, has no value"""

def main(argv: Sequence[str] | None = None) -> int:
    """Does what the arguments say and returns the exit code."""
    parser = argparse.ArgumentParser(
        prog="pounding-fmu gap",
        description=ABOUT,
        epilog=EXAMPLE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("scene", metavar="SCENE.toml", help="with contacts")
    parser.add_argument("--records", nargs="+", metavar="FILE", help="ground motions, instead of that of the scene")
    parser.add_argument("--pga", nargs="+", type=float, metavar="A", help="m/s2, to which the peak of each is scaled")
    parser.add_argument("--force", type=float, metavar="F", help="N: also the gap from which on no peak force is larger, in a row by one factor on all gaps")
    about = "two neighbours: their gap alone is varied, the others stay as in the scene, with what contact there makes of it"
    parser.add_argument("--between", nargs=2, metavar="NAME", help=about)
    parser.add_argument("--workers", type=int, metavar="N", help="threads (default: all cores)")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE.csv", help="the table as a file, too")
    _record_options.add(parser, "the files of --records do")
    options = parser.parse_args(argv)
    _native.spare([("-o", options.output)], [options.scene], options.records or [])
    read_file(options.scene)
    progress = _terminal.Progress("runs")
    records = _record_options.with_options(options.records, options)
    search = search_of(options.scene, records, options.pga, options.force, options.workers, progress, options.between)
    warn(search.warnings)
    rows = search.run()
    costs = search.costs_of(rows)
    progress.end(quietly=True)
    parts = [tell(rows, options.force), RULES, *([LINKED] * search.is_linked), *([SOIL] * search.on_soil), *tell_collapses(rows)]
    print(*parts, *(["", tell_costs(costs, len(search.motions), isinstance(search, RowSearch))] * bool(costs)), sep="\n")
    if options.output:
        write(rows, options.output)
    return 0


def search_of(
    scene: Scene,
    records: Sequence[Record] | Mapping[str, Record] | None,
    pga: Iterable[float] | None,
    force: float | None,
    threads: int | None,
    progress: Callable[[int, int], object] | None,
    between: Sequence[str] | None,
) -> Search:
    """What finds the gaps: of the buildings that `[left]` and `[right]` are, or of two that are named, one gap at all contacts,
    and else each its own."""
    is_row = between is None and not {*read_scene(scene).buildings()} <= {*ENDS}
    return (RowSearch if is_row else Search)(scene, records, pga, force, threads, progress, between)


def tell(rows: Sequence[RequiredGap], force: float | None) -> str:
    """The table of a person: gaps in mm; of several motions at one intensity the largest and the mean as well, in a row of each
    two neighbours."""
    is_row = rows[0].between is not None
    head = [*["between"] * is_row, "ground motion", "peak/m/s2", "gap/mm", "closes first", "sum", "SRSS", "0.7 SRSS", "DDC"]
    columns: list[Callable[[RequiredGap], float | None]] = [
        lambda row: row.gap,
        lambda row: row.absolute_sum,
        lambda row: row.srss,
        lambda row: row.eurocode,
        lambda row: row.ddc,
    ]
    if force is not None:
        head += [f"gap/mm for {force:g} N", "hardest/N", "with gap/mm"]
        head += ["factor"] * (rows[0].force_factor is not None)
        columns.append(lambda row: row.force_gap)

    def line(start: Sequence[str], first: str, lengths: Sequence[float | None], end: Sequence[str]) -> list[str]:
        gap, *others = map(mm, lengths)
        return [*start, gap, first, *others, *(end if force is not None else [])]

    lines = []
    for row in rows:
        hardest = ["-" if row.hardest_force is None else f"{row.hardest_force:.4g}", mm(row.hardest_gap)]
        hardest += [] if row.force_factor is None else [f"{row.force_factor:.4g}"]
        first = "-" if row.contact is None else f"contact[{row.contact}]"
        start = [*([row.between] if row.between is not None else []), row.record, f"{row.pga:.3g}"]
        lines.append(line(start, first, [of(row) for of in columns], hardest))
    for between in dict.fromkeys(row.between for row in rows):
        start = [] if between is None else [between]
        for peak, together in groups([row for row in rows if row.between == between]).items():
            for name, of_all in (("largest", max), ("mean", fmean)):
                each = [[value for row in together if (value := of(row)) is not None] for of in columns]
                largest = [of_all(values) if values else None for values in each]
                lines.append(line([*start, name, peak], "", largest, [""] * (2 + (rows[0].force_factor is not None))))
    return table([head, *lines])


def tell_collapses(rows: Sequence[RequiredGap]) -> list[str]:
    """A line for each ground motion in which a building falls by itself."""
    falls = [
        f"collapse  {row.record} at {row.pga:.3g} m/s2: apart, {row.collapsed} falls; all here is until then"
        for row in rows
        if row.collapsed
    ]
    return list(dict.fromkeys(falls))


def groups(rows: Sequence[RequiredGap]) -> dict[str, list[RequiredGap]]:
    """Ground motions of one intensity; those that each have their own are one group, and a single one is none."""
    found: dict[str, list[RequiredGap]] = {}
    for row in rows:
        found.setdefault(f"{row.pga:.3g}", []).append(row)
    if len(rows) > 1 and all(len(group) == 1 for group in found.values()) and len({row.record for row in rows}) > 1:
        return {"": list(rows)}
    return {peak: group for peak, group in found.items() if len(group) > 1}


def tell_costs(costs: Sequence[Cost], motions: int, is_row: bool = False) -> str:
    """What smaller gaps cost; of a row, shares of all that are needed, and of many buildings the ends and what is between."""
    sides: dict[str, list[str]] = {side: [side] for side in costs[0].drift_ratios}
    if len(sides) > MOST_BUILDINGS:
        first, *inner, last = sides
        sides = {first: [first], "between": inner, last: [last]}
    head = ["of these gaps" if is_row else "gap/mm", "impacts", "peak force/kN", *(f"storey drift, {side}" for side in sides)]
    lines = [
        [
            f"{100 * cost.gap:.0f} %" if is_row else mm(cost.gap),
            str(cost.impacts),
            f"{cost.force / 1e3:.4g}",
            *(f"{max(cost.drift_ratios[side] for side in of):.2f}" for of in sides.values()),
        ]
        for cost in costs
    ]
    if motions > 1:
        head.insert(1, f"pounding in, of {motions}")
        lines = [[line[0], str(cost.pounding), *line[1:]] for line, cost in zip(lines, costs)]
    worst = "the largest of any ground motion; " if motions > 1 else ""
    return f"Smaller gaps ({worst}drifts of storeys relative to those without contact):\n{table([head, *lines])}"


def mm(length: float | None) -> str:
    return "-" if length is None else f"{1e3 * length:.1f}"


def table(lines: Sequence[Sequence[str]]) -> str:
    """Columns as wide as they need, the first one to the left."""
    widths = [max(map(len, column)) for column in zip(*lines)]
    return "\n".join(
        "  ".join([line[0].ljust(widths[0]), *(cell.rjust(width) for cell, width in zip(line[1:], widths[1:]))]).rstrip()
        for line in lines
    )


def write(rows: Sequence[RequiredGap], path: Path) -> None:
    """A row for each ground motion, and in a row of buildings for each two neighbours; lengths in m."""
    columns = [*OF_ROWS, *(name for name in asdict(rows[0]) if name not in OF_ROWS)]
    columns = [name for name in columns if name not in OF_ROWS or any(asdict(row)[name] is not None for row in rows)]
    with path.open("w", newline="", encoding="utf-8") as file:
        lines = csv.DictWriter(file, columns, lineterminator="\n")
        lines.writeheader()
        lines.writerows({name: "" if asdict(row)[name] is None else asdict(row)[name] for name in columns} for row in rows)
