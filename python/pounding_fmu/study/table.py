"""The columns of a study's table, and how their values are written and read.

A text that begins with one of =, +, -, @, a tab or an apostrophe gets an apostrophe before it, or a spreadsheet would
take a file name for a formula; whoever reads the table takes one apostrophe away.
"""

from __future__ import annotations

import csv
import io
import itertools
import math
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import IO, Any

from .cases import (
    ANY_FOUNDATION, CONTACT, FACTOR, FOUNDATION, HARDEST, LINK, NEVER_CLOSES, OF_EACH_CONTACT, OF_FOUNDATIONS, OF_LINKS,
    OF_STOREYS, OF_YIELDING, Row, collapsed, sides_of,
)  # fmt: skip

Kind = type  # of a column: str, int or float
Key = tuple[Any, ...]

CASE: dict[str, Kind] = {
    "scene": str, "scene_id": str, "record": str, "record_id": str, "pga_m_s2": float, "gap_m": float, "stop_s": float,
    "varied": str,
}  # fmt: skip
# Of each building.
INTENSITY = ("period_s", "sa_m_s2")
RESULT = ("drift_m", "acceleration_m_s2", "base_shear_n")
# Of all.
TOGETHER: dict[str, Kind] = {"impacts": int, "peak_force_n": float, "impulse_n_s": float, "dissipated_energy_j": float}
# Of each storey, or floor.
EACH = [*OF_STOREYS, "storey_shear_n"]
# Empty where a building has no storeys of the kind: whose columns slabs can hit, with a stiffness of its own, that yield,
# that can collapse.
SOME = ("column_force_n", "storey_shear_n", *OF_YIELDING)
COLLAPSED = "collapsed"
# The largest ratio of any storey, or floor, to the same one in the run without contact.
RATIO_OF = {"drift_m": "drift_ratio", "acceleration_m_s2": "acceleration_ratio"}
# What there is room for that is no building.
OTHERS = (LINK, ANY_FOUNDATION, CONTACT, FACTOR)
FORMULA = re.compile(r"[=+\-@\t']")
MOST_PROBLEMS = 10


def columns(storeys: Mapping[str, int]) -> dict[str, Kind]:
    """Name and kind of every column, for buildings of up to so many storeys, and so many links and contacts of rows, with
    foundations and factors on gaps or not."""
    sides = [of for of in storeys if of not in OTHERS]
    of_links = [f"{LINK}_{what}[{i}]" for what in OF_LINKS for i in range(1, storeys.get(LINK, 0) + 1)]
    of_storeys = [f"{side}_{what}[{i}]" for what in EACH for side in sides for i in range(1, storeys[side] + 1)]
    of_foundations = of_sides(sides, [f"{FOUNDATION}_{what}" for what in OF_FOUNDATIONS])
    numbers = of_storeys + of_links + of_foundations * storeys.get(ANY_FOUNDATION, 0)
    ratios = dict.fromkeys(of_sides(sides, RATIO_OF.values()), float)
    return {
        **case_columns(bool(storeys.get(FACTOR))), **always(sides), **dict.fromkeys(of_sides(sides, SOME), float),
        **dict.fromkeys(of_sides(sides, [COLLAPSED]), int), **ratios, **dict.fromkeys(numbers, float),
        **of_contacts(storeys.get(CONTACT, 0)), "error": str,
    }  # fmt: skip


def of_sides(sides: Iterable[str], parts: Iterable[str]) -> list[str]:
    """Columns of each building, the same of all beside each other."""
    names = list(sides)
    return [f"{side}_{what}" for what in parts for side in names]


def case_columns(with_factor: bool) -> dict[str, Kind]:
    """What was set, with the factor on gaps beside the gap."""
    if not with_factor:
        return CASE
    before, after = itertools.takewhile("stop_s".__ne__, CASE), itertools.dropwhile("stop_s".__ne__, CASE)
    return {**{name: CASE[name] for name in before}, FACTOR: float, **{name: CASE[name] for name in after}}


def always(sides: Iterable[str]) -> dict[str, Kind]:
    """What every case has that was run, of all and of each of these buildings."""
    names = list(sides)
    return {**dict.fromkeys(of_sides(names, INTENSITY), float), **TOGETHER, **dict.fromkeys(of_sides(names, RESULT), float)}


def of_contacts(count: int) -> dict[str, Kind]:
    """Of each contact of a row of buildings."""
    kinds: dict[str, Kind] = {what: int if what == "impacts" else float for what in OF_EACH_CONTACT}
    each = {f"{CONTACT}_{what}[{p}]": kind for what, kind in kinds.items() for p in range(1, count + 1)}
    return each | {HARDEST: int} if count else {}


def storeys_of(names: Iterable[str]) -> dict[str, int]:
    """Of each building, links and foundations, as many as a table with these columns has room for."""
    known = list(names)
    sides = sides_of(dict.fromkeys(known))
    firsts = {side: f"{side}_drift_m[" for side in sides}
    firsts |= {LINK: f"{LINK}_force_n[", ANY_FOUNDATION: f"{sides[0]}_{FOUNDATION}_displacement_m"}
    firsts |= {CONTACT: f"{CONTACT}_force_n[", FACTOR: FACTOR}
    return {of: sum(name.startswith(first) for name in known) for of, first in firsts.items()}


def text(value: object) -> str:
    if value is None:
        return ""
    if isinstance(value, str):
        return f"'{value}" if FORMULA.match(value) else value
    return repr(value)


class Writer:
    """Writes rows of these columns. Numbers have their shortest texts, as `text` has them, by the csv module's own doing."""

    def __init__(self, file: IO[str], known: Mapping[str, Kind]) -> None:
        self.lines = csv.writer(file, lineterminator="\n")
        self.names = list(known)
        self.texts = [place for place, kind in enumerate(known.values()) if kind is str]

    def names_of_columns(self) -> None:
        self.lines.writerow(self.names)

    def rows(self, rows: Iterable[Mapping[str, Any]]) -> None:
        self.lines.writerows(map(self.cells, rows))

    def cells(self, row: Mapping[str, Any]) -> list[Any]:
        cells = [row.get(name) for name in self.names]
        for place in self.texts:
            cells[place] = text(cells[place])
        return cells


def parse(path: Path, content: bytes) -> tuple[dict[str, int], list[Row]]:
    """The columns and the rows of a table; a `ValueError` with all that is wrong with it, line by line."""
    lines = csv.reader(io.StringIO(decoded(path, content), newline=""))
    names = next(lines, [])
    known = columns(storeys_of(names))
    if names != list(known):
        raise ValueError(f"{path}, line 1: no table of this version's studies: move it away, or name another folder")
    reader = Reader(known)
    rows: list[Row] = []
    problems: list[str] = []
    try:
        for cells in lines:
            row, wrong = reader.row(cells)
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


class Reader:
    """Reads rows of a table with these columns."""

    def __init__(self, known: Mapping[str, Kind]) -> None:
        self.known = known
        self.sides = sides_of(dict.fromkeys(known))
        self.of_side = {side: [name for name in of_sides([side], [*INTENSITY, *RESULT, *SOME]) if name in known] for side in self.sides}

    def row(self, cells: Sequence[str]) -> tuple[Row, list[str]]:
        """The row by column names, and what is wrong with it."""
        known = self.known
        if len(cells) != len(known):
            return {}, [f"expected {len(known)} cells, found {len(cells) if any(cells) else 'a blank line'}"]
        row: Row = {}
        problems: list[str] = []
        for (name, kind), cell in zip(known.items(), cells):
            if kind is str:
                row[name] = cell.removeprefix("'")
            elif not cell:
                row[name] = None
            else:
                try:
                    row[name] = number = kind(cell)
                    is_number = math.isfinite(number)
                except (ValueError, OverflowError):
                    is_number = False
                if not is_number:
                    problems.append(f"{name} = {cell!r}: expected {'a whole number' if kind is int else 'a number'}")
        # A gap, or a factor on those of the scene.
        needed = [name for name in CASE if name != "gap_m" or row.get(FACTOR) is None]
        problems += [f"{name}: expected a value" for name in needed if row.get(name, "") is None]
        if not row["error"]:
            needed = list(always([side for side in self.sides if self.is_there(side, row)] or self.sides))
            problems += [f"{name}: expected a value, or a reason in error" for name in needed if row.get(name, 0) is None]
        return row, problems

    def is_there(self, side: str, row: Row) -> bool:
        """A building that is not there has nothing at all."""
        return any(row.get(name) is not None for name in self.of_side[side])


def stop_at(problems: Sequence[str]) -> None:
    if not problems:
        return
    more = len(problems) - MOST_PROBLEMS
    said = list(problems[:MOST_PROBLEMS]) + ([f"and {more} more"] if more > 0 else [])
    raise ValueError("\n".join([*said, "mend or delete these lines; a case without a line is run again"]))


def key(row: Mapping[str, Any]) -> Key:
    """What names a case in the table: its columns."""
    return (*(row[name] for name in CASE), row.get(FACTOR))


def order(of: Key) -> tuple[str, ...]:
    """By which rows are sorted that no case of the study has: by their texts."""
    return tuple(map(text, of))


def add_ratios(rows: Sequence[Row]) -> None:
    """Writes into each row of a table what the largest storey ratios to its run without contact are, where that is there and
    neither has collapsed."""
    known = dict.fromkeys(rows[0]) if rows else {}
    of_storeys = {
        f"{side}_{ratio}": [name for name in known if name.startswith(f"{side}_{what}[")]
        for what, ratio in RATIO_OF.items()
        for side in sides_of(known)
    }
    standing = [row for row in rows if not collapsed(row)]
    free = {key(row): row for row in standing}
    for row in rows:
        row |= dict.fromkeys(of_storeys)
    for row in standing:
        if alone := free.get(key({**row, "gap_m": NEVER_CLOSES, FACTOR: None})):
            row |= {ratio: largest_ratio(row, alone, names) for ratio, names in of_storeys.items()}


def largest_ratio(row: Row, alone: Row, names: Iterable[str]) -> float | None:
    pairs = [(row[name], alone.get(name)) for name in names]
    return max((mine / other for mine, other in pairs if mine is not None and other), default=None)
