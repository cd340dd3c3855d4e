"""The table of a study as a file: it grows while the study runs, and a study that was stopped goes on from it."""

from __future__ import annotations

import importlib
import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import IO, Any

from . import table
from .cases import FACTOR, Case, Row
from .table import CASE, Key, Kind, Writer, key, order

TEMPORARY = ".new"


class Results:
    """A row for each case, in the file alone: while a study runs, only their keys are kept in memory.

    `storeys` are those of each building, and the links, that there must be room for.
    """

    def __init__(self, path: Path, storeys: Mapping[str, int]) -> None:
        self.path = path
        path.parent.mkdir(parents=True, exist_ok=True)
        self.file: IO[str] = path.open("a+", encoding="utf-8", newline="")
        lock(self.file, path)
        # Written anew at the end: a half of a study is not beside the whole of an older one.
        self.parquet = path.with_suffix(".parquet")
        self.parquet.unlink(missing_ok=True)
        found, rows = self.read(storeys)
        room = {of: max(found.get(of, 0), storeys.get(of, 0)) for of in (*storeys, *found)}
        self.columns = table.columns(room)
        self.failed = {key(row): bool(row["error"]) for row in rows}
        if found != table.storeys_of(self.columns) or not self.path.stat().st_size:
            self.write(rows)

    def read(self, storeys: Mapping[str, int]) -> tuple[Mapping[str, int], list[Row]]:
        """Takes what is there; a row that a killed run has not finished is cut off."""
        content = self.path.read_bytes()
        whole = content.rfind(b"\n") + 1
        if whole < len(content):
            self.file.truncate(whole)
        return table.parse(self.path, content[:whole]) if whole else (storeys, [])

    @property
    def rows(self) -> dict[Key, Row]:
        """All rows by case, read anew; of a case that was run again, the last."""
        _, rows = table.parse(self.path, self.path.read_bytes())
        return {key(row): row for row in rows}

    def add(self, rows: Iterable[Row]) -> None:
        """Writes rows and waits until the disk has them."""
        Writer(self.file, self.columns).rows(map(self.noted, rows))
        self.file.flush()
        os.fsync(self.file.fileno())

    def noted(self, row: Row) -> Row:
        """A row whose case has one from now on."""
        self.failed[key(row)] = bool(row["error"])
        return row

    def missing(self, cases: Iterable[Case]) -> list[Case]:
        """Cases without a result; those that failed are tried again."""
        return [case for case in cases if self.failed.get(key(columns_of(case)), True)]

    def finish(self, cases: Sequence[Case]) -> list[Row]:
        """Adds the ratios and puts the rows in the order of the cases, whoever ran them; others stay behind them.
        Returns the rows of these cases."""
        rows = self.rows
        table.add_ratios(list(rows.values()))
        keys = [key(columns_of(case)) for case in cases]
        first = {case: rows[case] for case in keys if case in rows}
        others = sorted(rows.keys() - first.keys(), key=order)
        ordered = first | {case: rows[case] for case in others}
        self.write(ordered.values())
        write_parquet(self.parquet, self.columns, list(ordered.values()))
        return list(first.values())

    def write(self, rows: Iterable[Row]) -> None:
        """Puts a table with these rows in the place of the one that is there."""
        new = self.path.with_suffix(TEMPORARY)
        file = new.open("w", encoding="utf-8", newline="")
        lock(file, self.path)
        writer = Writer(file, self.columns)
        writer.names_of_columns()
        writer.rows(rows)
        file.flush()
        os.fsync(file.fileno())
        os.replace(new, self.path)
        self.file.close()
        self.file = file

    def close(self) -> None:
        self.file.close()


def lock(file: IO[str], path: Path) -> None:
    """Two studies at once would write each row twice. The lock goes with its process, however that ends."""
    try:
        import fcntl

        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except ImportError:
        pass
    except OSError:
        raise ValueError(f"{path}: another study is writing here") from None


def columns_of(case: Case) -> Row:
    values = (case.scene, case.scene_id, case.record, case.record_id, case.pga, case.gap, case.stop, case.varied)
    return {**dict(zip(CASE, values, strict=True)), FACTOR: case.factor}


def write_parquet(path: Path, columns: Mapping[str, Kind], rows: Sequence[Row]) -> None:
    """The same table for programs, texts as they are, where there is a library for it."""
    try:
        pyarrow: Any = importlib.import_module("pyarrow")
        parquet: Any = importlib.import_module("pyarrow.parquet")
    except ImportError:
        return
    arrays = {name: arrow_array(pyarrow, kind, [row.get(name) for row in rows]) for name, kind in columns.items()}
    new = path.with_suffix(TEMPORARY)
    parquet.write_table(pyarrow.table(arrays), new)
    os.replace(new, path)


def arrow_array(pyarrow: Any, kind: Kind, values: Sequence[Any]) -> Any:
    """A column, made of its bytes: `pyarrow.array` imports pandas, which costs more than all of the table."""
    import numpy as np

    known = np.packbits([value is not None for value in values], bitorder="little")
    if kind is str:
        texts = [(value or "").encode() for value in values]
        parts = [known, np.cumsum([0, *map(len, texts)], dtype=np.int32), b"".join(texts)]
    else:
        parts = [known, np.array([0 if value is None else value for value in values], np.int64 if kind is int else np.float64)]
    of = {str: pyarrow.string(), int: pyarrow.int64(), float: pyarrow.float64()}[kind]
    return pyarrow.Array.from_buffers(of, len(values), [pyarrow.py_buffer(part) for part in parts])
