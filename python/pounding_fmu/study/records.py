"""Ground motions as studies and the search for a gap take them."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

from .. import _native
from .._scenes import read_record, record_dict, warn

if TYPE_CHECKING:
    from typing import Any, TypeGuard

    from .._scenes import Record


def named(records: str | os.PathLike[str] | Iterable[Record] | Mapping[str, Record]) -> Mapping[str, Record]:
    """Records by what messages call them: those that come without a name are paths, or dicts with a file."""
    if isinstance(records, (str, os.PathLike)) or is_record_dict(records):
        records = [records]
    found: dict[str, Record] = {}
    for key in records:
        if isinstance(records, Mapping):
            found[str(key)] = records[str(key)]
        elif isinstance(key, (str, os.PathLike, Mapping)):
            source = record_dict(key, "records")
            column = f"#{source['column']}" if "column" in source else ""
            found[f"{source.get('file')}{column}"] = key
        else:
            raise ValueError("records: expected paths, or a dict of records by their names")
    if not found:
        raise ValueError("records: expected at least one")
    return found


def is_record_dict(records: object) -> TypeGuard[Mapping[str, Any]]:
    """One record with what is said of its file, not records by their names."""
    return isinstance(records, Mapping) and isinstance(records.get("file"), (str, os.PathLike))


def read_records(records: Mapping[str, Record], problems: list[str], is_scaled: bool = True) -> dict[str, _native.Record]:
    """Those that can be scaled to a peak, if they are; what is wrong with the others is added to the problems.

    Warns:
        SceneWarning: for each thing that looks like a slip.
    """
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
        elif is_scaled and found[key].offset() is not None:
            problems.append(offset_of(key, found[key]))
        else:
            warn(f"records = {key!r}: {text}" for text in found[key].warnings())
        if not label(key).isprintable():
            problems.append(f"records = {key!r}: expected a file name without line breaks and the like")
    return found


def offset_of(key: str, record: _native.Record) -> str:
    """Why a record with an offset is not scaled to a peak."""
    return (
        f"records = {key!r}: its mean is {record.mean():.4g} m/s2, so its peak is not that of the motion: expected remove_mean "
        "(--remove-mean), which takes it away"
    )


def label(key: str) -> str:
    """What a record is called in tables: the name of its file without folder and ending."""
    return os.path.splitext(os.path.basename(key))[0]
