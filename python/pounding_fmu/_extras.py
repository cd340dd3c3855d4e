"""Packages that only some commands need."""

from __future__ import annotations

import importlib
from typing import Any


class MissingExtra(ImportError):
    """A package that is not installed, and the line that installs it."""


def require(package: str, extra: str) -> Any:
    """The module of that name, which comes with ``pip install pounding-fmu[extra]``."""
    try:
        return importlib.import_module(package)
    except ModuleNotFoundError as error:
        if error.name != package.partition(".")[0]:
            raise
        line = f'pip install "pounding-fmu[{extra}]"'
        raise MissingExtra(f"this needs {error.name}, which is not installed: {line}", name=error.name) from None
