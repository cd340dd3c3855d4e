"""Ground motions as studies and the search for a gap take them."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

from .. import _native
from .._scenes import read_record

if TYPE_CHECKING:
    from .._scenes import Record


def named(records: str | os.PathLike[str] | Iterable[Record] | Mapping[str, Record]) -> Mapping[str, Record]:
    """Records by what messages call them: those that come without a name are paths."""
    if isinstance(records, (str, os.PathLike)):
        records = [records]
    found: dict[str, Record] = {}
    for key in records:
        if isinstance(records, Mapping):
            found[str(key)] = records[str(key)]
        elif isinstance(key, (str, os.PathLike)):
            found[os.fsdecode(key)] = key
        else:
            raise ValueError("records: expected paths, or a dict of records by their names")
    if not found:
        raise ValueError("records: expected at least one")
    return found


def read_records(records: Mapping[str, Record], problems: list[str]) -> dict[str, _native.Record]:
    """Those that can be scaled to a peak; what is wrong with the others is added to the problems."""
    found: dict[str, _native.Record] = {}
    for key, record in records.items():
        try:
            found[key] = read_record(record, "records")
        except OSError as error:
            problems.append(f"records = {key!r}: expected a record file, but {error.strerror}")
            continue
        except ValueError as error:
            problems.append(str(error))
            continue
        if not found[key].samples()[1].any():
            problems.append(f"records = {key!r}: the ground does not move, so it cannot be scaled to a peak")
        if not label(key).isprintable():
            problems.append(f"records = {key!r}: expected a file name without line breaks and the like")
    return found


def label(key: str) -> str:
    """What a record is called in tables: the name of its file without folder and ending."""
    return os.path.splitext(os.path.basename(key))[0]
