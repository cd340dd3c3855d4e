"""FMUs of scenes."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from . import _native
from ._data import DATA
from ._scenes import file_path, path_of, read_scene, warn

if TYPE_CHECKING:
    from ._scenes import Scene


def build_fmu(
    scene: Scene,
    output: str | os.PathLike[str] | None = None,
    platforms: Iterable[str] | None = None,
    fmi: int = 2,
    numbers_only: bool = False,
) -> Path:
    """Makes an FMU (co-simulation) of a scene and returns its path. The FMU is not run.

    Args:
        scene: a path, a text or a dict.
        output: where the FMU goes, in a directory that is made if need be; ``NAME.fmu`` (NAME: the scene's), or
            ``NAME.fmi3.fmu`` with ``fmi=3``, in the current directory where nothing is said. An older file there is
            replaced at once, or stays.
        platforms: those that the FMU can be run on, such as ``["win64", "linux64"]``; all whose library has come with
            this package where nothing is said.
        fmi: the version of FMI, 2 or 3.
        numbers_only: for importers that read every variable as a number: counts and flags are numbers in the FMU, and
            there are no texts; as ``outputs.numbers_only`` in the scene.

    >>> import pounding_fmu, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     fmu = build_fmu(pounding_fmu.example_scene, f"{folder}/frames.fmu")
    ...     fmu.name, fmu.stat().st_size > 100_000
    ('frames.fmu', True)

    Raises:
        ValueError: everything that is wrong with the scene; a platform that there is no library for; a name that does
            not end in ``.fmu``, or that of the scene or its record; a version of FMI that is neither 2 nor 3.
        OSError: the scene file cannot be read, or the FMU cannot be written.
        TypeError: the scene is none of the forms that a scene may have.

    Warns:
        SceneWarning: for each thing that looks like a slip.
    """
    if isinstance(fmi, bool) or fmi not in (2, 3):
        raise ValueError(f"fmi = {fmi!r}: expected 2 or 3")
    if platforms is not None:
        platforms = [platforms] if isinstance(platforms, str) else list(platforms)
        if not platforms:
            raise ValueError("platforms: expected at least one, or None for all")
    read = read_scene(scene)
    warn(read.warnings())
    path = None if output is None else file_path("output", output)
    if numbers_only:
        read = _native.with_numbers_only(read)
    return _native.build(read, path, path_of(scene), os.fspath(DATA / "libraries"), platforms or [], fmi == 3)
