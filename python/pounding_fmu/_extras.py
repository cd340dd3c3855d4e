"""Packages that only some commands need."""

from __future__ import annotations

import importlib
from typing import Any


class MissingExtra(ImportError):
    """A package that is not installed, and the line that installs it."""


def require(package: str, extra: str | None = None) -> Any:
    """The module of that name, which comes with ``pip install "pounding-fmu[extra]"`` or by itself."""
    try:
        return importlib.import_module(package)
    except ModuleNotFoundError as error:
        name = package.partition(".")[0]
        if error.name != name:
            raise
        line = f'pip install "pounding-fmu[{extra}]"' if extra else f"pip install {name}"
        raise MissingExtra(f"this needs {name}, which is not installed: {line}", name=name) from None
