"""The command ``pounding-fmu gap``."""

from __future__ import annotations

import argparse
import csv
from collections.abc import Callable, Sequence
from dataclasses import asdict
from pathlib import Path
from statistics import fmean

from .. import _native, _record_options, _terminal
from .._scenes import read_file, warn
from .search import Cost, RequiredGap, Search

ABOUT = """\
How wide a gap keeps the buildings apart, in each ground motion and in all, beside the rules of codes.

The gap is the same at all contacts, whatever theirs are in the scene. It is found to a thousandth of a millimetre. A run
goes to the end of its record, or to the scene's stop_time where that is later. Links of the scene are in all runs.
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
    parser.add_argument("--force", type=float, metavar="F", help="N: also the gap from which on no peak force is larger")
    parser.add_argument("--workers", type=int, metavar="N", help="threads (default: all cores)")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE.csv", help="the table as a file, too")
    _record_options.add(parser, "the files of --records do")
    options = parser.parse_args(argv)
    _native.spare([("-o", options.output)], [options.scene], options.records or [])
    read_file(options.scene)
    progress = _terminal.Progress("runs")
    records = _record_options.with_options(options.records, options)
    search = Search(options.scene, records, options.pga, options.force, options.workers, progress)
    warn(search.warnings)
    rows = search.run()
    widest = max(row.gap for row in rows)
    costs = search.costs(widest) if widest > 0 else []
    progress.end(quietly=True)
    parts = [tell(rows, options.force), RULES, *([LINKED] * search.is_linked), *([SOIL] * search.on_soil), *tell_collapses(rows)]
    print(*parts, *(["", tell_costs(costs, len(rows))] * bool(costs)), sep="\n")
    if options.output:
        write(rows, options.output)
    return 0


def tell(rows: Sequence[RequiredGap], force: float | None) -> str:
    """The table of a person: gaps in mm; of several motions at one intensity the largest and the mean as well."""
    head = ["ground motion", "peak/m/s2", "gap/mm", "closes first", "sum", "SRSS", "0.7 SRSS", "DDC"]
    columns: list[Callable[[RequiredGap], float | None]] = [
        lambda row: row.gap,
        lambda row: row.absolute_sum,
        lambda row: row.srss,
        lambda row: row.eurocode,
        lambda row: row.ddc,
    ]
    if force is not None:
        head += [f"gap/mm for {force:g} N", "hardest/N", "with gap/mm"]
        columns.append(lambda row: row.force_gap)

    def line(start: Sequence[str], first: str, lengths: Sequence[float | None], end: Sequence[str]) -> list[str]:
        gap, *others = map(mm, lengths)
        return [*start, gap, first, *others, *(end if force is not None else [])]

    lines = []
    for row in rows:
        hardest = ["-" if row.hardest_force is None else f"{row.hardest_force:.4g}", mm(row.hardest_gap)]
        first = "-" if row.contact is None else f"contact[{row.contact}]"
        lines.append(line([row.record, f"{row.pga:.3g}"], first, [of(row) for of in columns], hardest))
    for peak, together in groups(rows).items():
        for name, of_all in (("largest", max), ("mean", fmean)):
            each = [[value for row in together if (value := of(row)) is not None] for of in columns]
            lines.append(line([name, peak], "", [of_all(values) if values else None for values in each], ["", ""]))
    return table([head, *lines])


def tell_collapses(rows: Sequence[RequiredGap]) -> list[str]:
    """A line for each ground motion in which a building falls by itself."""
    return [
        f"collapse  {row.record} at {row.pga:.3g} m/s2: apart, {row.collapsed} falls; all here is until then"
        for row in rows
        if row.collapsed
    ]


def groups(rows: Sequence[RequiredGap]) -> dict[str, list[RequiredGap]]:
    """Ground motions of one intensity; those that each have their own are one group, and a single one is none."""
    found: dict[str, list[RequiredGap]] = {}
    for row in rows:
        found.setdefault(f"{row.pga:.3g}", []).append(row)
    if len(rows) > 1 and all(len(group) == 1 for group in found.values()) and len({row.record for row in rows}) > 1:
        return {"": list(rows)}
    return {peak: group for peak, group in found.items() if len(group) > 1}


def tell_costs(costs: Sequence[Cost], motions: int) -> str:
    """What smaller gaps cost."""
    sides = list(costs[0].drift_ratios)
    head = ["gap/mm", "impacts", "peak force/kN", *(f"storey drift, {side}" for side in sides)]
    lines = [
        [mm(cost.gap), str(cost.impacts), f"{cost.force / 1e3:.4g}", *(f"{cost.drift_ratios[side]:.2f}" for side in sides)]
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
    """A row for each ground motion, lengths in m."""
    with path.open("w", newline="", encoding="utf-8") as file:
        lines = csv.DictWriter(file, list(asdict(rows[0])), lineterminator="\n")
        lines.writeheader()
        lines.writerows({name: "" if value is None else value for name, value in asdict(row).items()} for row in rows)
