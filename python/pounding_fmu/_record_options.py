"""What a user says about a record file that the file does not: options of the commands."""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence
from typing import Any

NAMES = ("step", "unit", "column", "skip_lines", "remove_mean")


def add(parser: argparse.ArgumentParser, of_what: str) -> None:
    """The options, about one record or about all."""
    group = parser.add_argument_group(f"what {of_what} not say, as ground.record of a scene has it")
    group.add_argument("--step", type=float, metavar="S", help="s from sample to sample, where there are no times")
    group.add_argument("--unit", metavar="U", help="of the accelerations: m/s2, cm/s2, mm/s2, g, %%g, mg, g/10, ft/s2, in/s2")
    group.add_argument("--column", type=_column, metavar="N", help="which of several, by its number or name")
    group.add_argument("--skip-lines", type=int, metavar="N", help="lines above the numbers that are not read")
    group.add_argument("--remove-mean", action="store_true", default=None, help="takes the mean of the samples away")


def _column(text: str) -> int | str:
    return int(text) if text.isascii() and text.isdigit() else text


def of(options: argparse.Namespace) -> dict[str, Any]:
    """Those that have been given."""
    return {name: value for name in NAMES if (value := getattr(options, name)) is not None}


def with_options(files: Sequence[str | os.PathLike[str]] | None, options: argparse.Namespace) -> list[Any] | None:
    """The records of a command, with what its options say about all of them."""
    said = of(options)
    if files is None and said:
        given = ", ".join("--" + name.replace("_", "-") for name in said)
        wanted = "expected --records, which they are about; of the record of a scene its ground.record says that"
        raise ValueError(f"{given}: {wanted}")
    return None if files is None else [{"file": os.fspath(file), **said} if said else file for file in files]
