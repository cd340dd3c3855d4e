"""The columns of a study's table, and how their values are written and read.

A text that begins with one of =, +, -, @, a tab or an apostrophe gets an apostrophe before it, or a spreadsheet would
take a file name for a formula; whoever reads the table takes one apostrophe away.
"""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from .cases import (
    FOUNDATION, LINK, NEVER_CLOSES, OF_FOUNDATIONS, OF_LINKS, OF_STOREYS, OF_YIELDING, SIDES, Row, collapsed,
)  # fmt: skip

Kind = type  # of a column: str, int or float

CASE: dict[str, Kind] = {
    "scene": str, "scene_id": str, "record": str, "record_id": str, "pga_m_s2": float, "gap_m": float, "stop_s": float,
    "varied": str,
}  # fmt: skip
INTENSITY: dict[str, Kind] = {f"{side}_{what}": float for what in ("period_s", "sa_m_s2") for side in SIDES}
RESULT: dict[str, Kind] = {
    "impacts": int, "peak_force_n": float, "impulse_n_s": float, "dissipated_energy_j": float,
    **{f"{side}_{what}": float for what in ("drift_m", "acceleration_m_s2", "base_shear_n") for side in SIDES},
}  # fmt: skip
# Of each storey, or floor.
EACH = [*OF_STOREYS, "storey_shear_n"]
# Empty where a building has no storeys of the kind: whose columns slabs can hit, with a stiffness of its own, that yield,
# that can collapse.
SOME: dict[str, Kind] = {
    f"{side}_{what}": float for what in ("column_force_n", "storey_shear_n", *OF_YIELDING) for side in SIDES
} | {f"{side}_collapsed": int for side in SIDES}
# The largest ratio of any storey, or floor, to the same one in the run without contact.
RATIO_OF = {"drift_m": "drift_ratio", "acceleration_m_s2": "acceleration_ratio"}
RATIOS: dict[str, Kind] = {f"{side}_{ratio}": float for ratio in RATIO_OF.values() for side in SIDES}
FORMULA = re.compile(r"[=+\-@\t']")
MOST_PROBLEMS = 10


def columns(storeys: Mapping[str, int]) -> dict[str, Kind]:
    """Name and kind of every column, for buildings of up to so many storeys, and so many links, with foundations or not."""
    of_links = [f"{LINK}_{what}[{i}]" for what in OF_LINKS for i in range(1, storeys.get(LINK, 0) + 1)]
    of_storeys = [f"{side}_{what}[{i}]" for what in EACH for side in SIDES for i in range(1, storeys[side] + 1)]
    of_foundations = [f"{side}_{FOUNDATION}_{what}" for what in OF_FOUNDATIONS for side in SIDES]
    numbers = of_storeys + of_links + of_foundations * storeys.get(FOUNDATION, 0)
    return CASE | INTENSITY | RESULT | SOME | RATIOS | dict.fromkeys(numbers, float) | {"error": str}


def storeys_of(names: Iterable[str]) -> dict[str, int]:
    """Of each building, links and foundations, as many as a table with these columns has room for."""
    known = list(names)
    firsts = {side: f"{side}_drift_m[" for side in SIDES} | {LINK: f"{LINK}_force_n["}
    firsts[FOUNDATION] = f"left_{FOUNDATION}_displacement_m"
    return {of: sum(name.startswith(first) for name in known) for of, first in firsts.items()}


def text(value: object) -> str:
    if value is None:
        return ""
    if isinstance(value, str):
        return f"'{value}" if FORMULA.match(value) else value
    return repr(value)


def value(kind: Kind, cell: str) -> Any:
    if kind is str:
        return cell.removeprefix("'")
    if not cell:
        return None
    number = kind(cell)
    if not math.isfinite(number):
        raise ValueError
    return number


def parse(path: Path, content: bytes) -> tuple[dict[str, int], list[Row]]:
    """The columns and the rows of a table; a `ValueError` with all that is wrong with it, line by line."""
    lines = csv.reader(io.StringIO(decoded(path, content), newline=""))
    names = next(lines, [])
    known = columns(storeys_of(names))
    if names != list(known):
        raise ValueError(f"{path}, line 1: no table of this version's studies: move it away, or name another folder")
    rows: list[Row] = []
    problems: list[str] = []
    try:
        for cells in lines:
            row, wrong = row_of(known, cells)
            problems += [f"{path}, line {lines.line_num}: {problem}" for problem in wrong]
            rows.append(row)
    except csv.Error as error:
        problems.append(f"{path}, line {lines.line_num}: {error}")
    stop_at(problems)
    return storeys_of(names), rows


def decoded(path: Path, content: bytes) -> str:
    """The table as text. Each line by itself: one that is none can be named."""
    problems, lines = [], []
    for number, line in enumerate(content.split(b"\n"), 1):
        try:
            lines.append(line.decode())
        except UnicodeDecodeError as error:
            problems.append(f"{path}, line {number}: no text: byte 0x{line[error.start]:02x} at {error.start + 1}")
    stop_at(problems)
    return "\n".join(lines)


def row_of(known: Mapping[str, Kind], cells: Sequence[str]) -> tuple[Row, list[str]]:
    """The row by column names, and what is wrong with it."""
    if len(cells) != len(known):
        return {}, [f"expected {len(known)} cells, found {len(cells) if any(cells) else 'a blank line'}"]
    row: Row = {}
    problems: list[str] = []
    for (name, kind), cell in zip(known.items(), cells):
        try:
            row[name] = value(kind, cell)
        except ValueError:
            problems.append(f"{name} = {cell!r}: expected {'a whole number' if kind is int else 'a number'}")
    problems += [f"{name}: expected a value" for name in CASE if row.get(name, "") is None]
    if not row["error"]:
        # A building that is not there has nothing at all.
        found = {name.partition("_")[0] for name in known if row.get(name) is not None}
        absent = tuple(f"{side}_" for side in SIDES if side not in found and not found.isdisjoint(SIDES))
        needed = [name for name in [*INTENSITY, *RESULT] if not name.startswith(absent)]
        problems += [f"{name}: expected a value, or a reason in error" for name in needed if row.get(name, 0) is None]
    return row, problems


def stop_at(problems: Sequence[str]) -> None:
    if not problems:
        return
    more = len(problems) - MOST_PROBLEMS
    said = list(problems[:MOST_PROBLEMS]) + ([f"and {more} more"] if more > 0 else [])
    raise ValueError("\n".join([*said, "mend or delete these lines; a case without a line is run again"]))


def key(row: Mapping[str, Any]) -> tuple[str, ...]:
    """What names a case in the table: its columns, numbers by their shortest text."""
    return tuple(text(row[name]) for name in CASE)


def add_ratios(rows: Sequence[Row]) -> None:
    """Writes into each row what the largest storey ratios to its run without contact are, where that is there and neither has
    collapsed."""
    free = {key(row): row for row in rows if not collapsed(row)}
    for row in rows:
        alone = None if collapsed(row) else free.get(key({**row, "gap_m": NEVER_CLOSES}))
        for what, ratio in RATIO_OF.items():
            for side in SIDES:
                row[f"{side}_{ratio}"] = largest_ratio(row, alone, f"{side}_{what}[") if alone else None


def largest_ratio(row: Row, alone: Row, prefix: str) -> float | None:
    pairs = [(row[name], alone.get(name)) for name in row if name.startswith(prefix)]
    return max((mine / other for mine, other in pairs if mine is not None and other), default=None)
