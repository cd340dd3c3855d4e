"""The columns of a study's table, and how their values are written and read.

A text that begins with one of =, +, -, @, a tab or an apostrophe gets an apostrophe before it, or a spreadsheet would
take a file name for a formula; whoever reads the table takes one apostrophe away.
"""

import csv
import io
import math
import re

from study_worker import SIDES

NEVER_CLOSES = 1e3  # m, the gap of the runs without contact
CASE = {
    "scene": str, "scene_id": str, "record": str, "record_id": str, "pga_m_s2": float, "gap_m": float, "stop_s": float
}  # fmt: skip
INTENSITY = {f"{side}_{what}": float for what in ("period_s", "sa_m_s2") for side in SIDES}
RESULT = {
    "impacts": int, "peak_force_n": float, "impulse_n_s": float, "dissipated_energy_j": float,
    **{f"{side}_{what}": float for what in ("drift_m", "acceleration_m_s2", "base_shear_n") for side in SIDES},
}  # fmt: skip
# Of the storeys that can yield; of a building without such storeys there is nothing.
YIELDING = {f"{side}_{what}": float for what in ("ductility", "residual_drift_m") for side in SIDES}
# Of each storey, or floor; the largest ratio of any of them to the same one in the run without contact.
OF_STOREYS = {"drift_m": "drift_ratio", "acceleration_m_s2": "acceleration_ratio"}
RATIOS = {f"{side}_{ratio}": float for ratio in OF_STOREYS.values() for side in SIDES}
FORMULA = re.compile(r"[=+\-@\t']")
MOST_PROBLEMS = 10


def columns(storeys):
    """Name and kind of every column, for buildings of up to so many storeys."""
    of_storeys = [f"{side}_{what}[{i}]" for what in OF_STOREYS for side in SIDES for i in range(1, storeys[side] + 1)]
    return CASE | INTENSITY | RESULT | YIELDING | RATIOS | dict.fromkeys(of_storeys, float) | {"error": str}


def storeys_of(names):
    """Of each building, as many as a table with these columns has room for."""
    return {side: sum(name.startswith(f"{side}_drift_m[") for name in names) for side in SIDES}


def text(value):
    if value is None:
        return ""
    if isinstance(value, str):
        return f"'{value}" if FORMULA.match(value) else value
    return repr(value)


def value(kind, cell):
    if kind is str:
        return cell.removeprefix("'")
    if not cell:
        return None
    number = kind(cell)
    if not math.isfinite(number):
        raise ValueError
    return number


def parse(path, content):
    """The columns and the rows of a table; a `SystemExit` with all that is wrong with it, line by line."""
    lines = csv.reader(io.StringIO(decoded(path, content), newline=""))
    names = next(lines)
    known = columns(storeys_of(names))
    if names != list(known):
        raise SystemExit(f"{path}, line 1: no table of this version's studies: move it away, or name another --output")
    rows, problems = [], []
    try:
        for cells in lines:
            row, wrong = row_of(known, cells)
            problems += [f"{path}, line {lines.line_num}: {problem}" for problem in wrong]
            rows.append(row)
    except csv.Error as error:
        problems.append(f"{path}, line {lines.line_num}: {error}")
    stop_at(problems)
    return storeys_of(names), rows


def decoded(path, content):
    """The table as text. Each line by itself: one that is none can be named."""
    problems, lines = [], []
    for number, line in enumerate(content.split(b"\n"), 1):
        try:
            lines.append(line.decode())
        except UnicodeDecodeError as error:
            problems.append(f"{path}, line {number}: no text: byte 0x{line[error.start]:02x} at {error.start + 1}")
    stop_at(problems)
    return "\n".join(lines)


def row_of(known, cells):
    """The row by column names, and what is wrong with it."""
    if len(cells) != len(known):
        return {}, [f"expected {len(known)} cells, found {len(cells) if any(cells) else 'a blank line'}"]
    row, problems = {}, []
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


def stop_at(problems):
    if not problems:
        return
    more = len(problems) - MOST_PROBLEMS
    said = problems[:MOST_PROBLEMS] + ([f"and {more} more"] if more > 0 else [])
    raise SystemExit("\n".join([*said, "mend or delete these lines; a case without a line is run again"]))


def key(row):
    """What names a case in the table: its columns, numbers by their shortest text."""
    return tuple(text(row[name]) for name in CASE)


def add_ratios(rows):
    """Writes into each row what the largest storey ratios to its run without contact are, where that is there."""
    free = {key(row): row for row in rows}
    for row in rows:
        alone = free.get(key({**row, "gap_m": NEVER_CLOSES}))
        for what, ratio in OF_STOREYS.items():
            for side in SIDES:
                row[f"{side}_{ratio}"] = largest_ratio(row, alone, f"{side}_{what}[") if alone else None


def largest_ratio(row, alone, prefix):
    pairs = [(row[name], alone.get(name)) for name in row if name.startswith(prefix)]
    return max((mine / other for mine, other in pairs if mine is not None and other), default=None)
