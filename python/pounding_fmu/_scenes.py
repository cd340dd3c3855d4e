"""Scenes as users give them, and the variables that they have."""

from __future__ import annotations

import difflib
import operator
import os
import warnings
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, NoReturn, TypeAlias

from . import _native

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    Scene: TypeAlias = "str | os.PathLike[str] | Mapping[str, Any]"
    Record: TypeAlias = "str | os.PathLike[str] | Mapping[str, Any] | tuple[ArrayLike, ArrayLike]"

MOST_PROBLEMS = 20
SECONDS = f"a number of seconds > 0 and at most {_native.MOST_TIME:g}"


class SceneWarning(UserWarning):
    """Something in a scene, or in the parameters of a run, that is allowed and looks like a slip."""


class Variable(NamedTuple):
    """A variable of the FMU, as ``modelDescription.xml`` has it."""

    name: str
    causality: str
    """``input``, ``parameter``, ``calculatedParameter`` or ``output``"""
    variability: str
    """``fixed``, ``discrete`` or ``continuous``"""
    type: str
    """``Real``, ``Integer``, ``Boolean`` or ``String``"""
    unit: str | None
    """of a Real, such as ``m/s2``; ``1`` where it has no dimension"""
    min: float | None
    max: float | None
    start: float | str | None
    """value of a parameter or an input"""
    description: str


def problems(scene: Scene) -> list[str]:
    """Everything that is wrong with a scene and its record, a line each; none where it can be run.

    Each says where in the scene, the value found and what was expected.

    >>> building = {"mass": [1e3, -2e3], "stiffness": [1e6, 1e6], "damping": {"ratio": 0.05}}
    >>> problems({"name": "Two", "left": building, "right": building})
    ['left.mass[2] = -2000.0: expected a finite mass > 0 kg', 'right.mass[2] = -2000.0: expected a finite mass > 0 kg']

    Raises:
        OSError: the scene file cannot be read (``FileNotFoundError`` where there is none).
        TypeError: the scene is none of the forms that a scene may have.

    Warns:
        SceneWarning: for each thing that looks like a slip.
    """
    read, found = _read(scene)
    if read is not None:
        warn(read.warnings())
    return found


def variables(scene: Scene) -> dict[str, Variable]:
    """The variables of the FMU of a scene, by name, in the order of the FMU.

    >>> import pounding_fmu
    >>> gap = variables(pounding_fmu.example_scene)["contact[1].gap"]
    >>> gap.causality, gap.unit, gap.start
    ('parameter', 'm', 0.005)

    Raises:
        ValueError: everything that is wrong with the scene.
        OSError: the scene file cannot be read.
        TypeError: the scene is none of the forms that a scene may have.
    """
    return variables_of(read_scene(scene))


def buildings(scene: Scene) -> list[str]:
    """The names of the buildings of a scene, from left to right: its variables begin with them.

    >>> import pounding_fmu
    >>> buildings(pounding_fmu.example_scene)
    ['left', 'right']

    Raises:
        ValueError: everything that is wrong with the scene.
        OSError: the scene file cannot be read.
        TypeError: the scene is none of the forms that a scene may have.
    """
    return read_scene(scene).buildings()


def read_scene(scene: Scene) -> _native.Scene:
    """A scene that can be run."""
    read, found = _read(scene)
    if read is None:
        raise ValueError("\n".join(found))
    return read


def read_file(file: str | os.PathLike[str]) -> _native.Scene:
    """The scene of a command, which is a file: each line of what is wrong with it names it."""
    read, found = _read(Path(file))
    if read is None:
        raise ValueError("\n".join(f"{file}: {line}" for line in found))
    return read


def path_of(scene: Scene) -> str | None:
    """Where the file of a scene is that is given as one."""
    is_text = isinstance(scene, str) and "\n" in scene
    return None if is_text or not isinstance(scene, (str, os.PathLike)) else file_path("scene", scene)


def file_path(key: str, path: str | os.PathLike[str]) -> str:
    """A path that a file can have; `key` is what messages call it."""
    text = os.fsdecode(path)
    try:
        is_possible = bool(text) and b"\0" not in os.fsencode(text)
    except UnicodeEncodeError:
        is_possible = False
    if not is_possible:
        raise ValueError(f"{key} = {text!r}: expected a path of a file")
    return text


def _read(scene: Scene) -> tuple[_native.Scene | None, list[str]]:
    path = path_of(scene)
    if path is None and isinstance(scene, str):
        try:
            return _native.Scene.parse(scene)
        except UnicodeEncodeError as error:
            line, half = scene.count("\n", 0, error.start) + 1, scene[error.start]
            return None, [f"line {line}: {half!r} is half of a character: expected a text in Unicode"]
    if path is not None:
        with open(path, "rb"):  # a file that cannot be read is no mistake of the scene
            pass
        return _native.Scene.read(path)
    if isinstance(scene, Mapping):
        return _native.Scene.from_dict(scene)
    expected = "a path, a text (with a line break) or a dict"
    raise TypeError(f"scene: expected {expected}, not {type(scene).__name__}")


def variables_of(scene: _native.Scene) -> dict[str, Variable]:
    return {row[0]: Variable(*row) for row in scene.variables()}


def warn(texts: Iterable[str]) -> None:
    """Warns the caller of the function of this package that calls this one."""
    for text in texts:
        warnings.warn(text, SceneWarning, stacklevel=3)


class Names:
    """The variables of a scene as parameters and outputs of a run."""

    def __init__(self, scene: _native.Scene) -> None:
        self.variables = variables_of(scene)
        self.references = {name: reference for reference, name in enumerate(self.variables)}

    def check(self, parameters: Iterable[str], outputs: Iterable[str]) -> None:
        """Refuses names that there are not, parameters that cannot be set, and outputs that are no numbers."""
        parameters, outputs = list(parameters), list(outputs)
        missing = [name for name in (*parameters, *outputs) if name not in self.variables]
        if missing:
            what = "the scene has no such variable"
            raise KeyError("; ".join(unknown(name, self.variables, what) for name in dict.fromkeys(missing)))
        found = [text for name in parameters if (text := self._not_settable(name))]
        texts = (name for name in outputs if self.variables[name].type == "String")
        found += (f"{name} is a text: expected names of numbers as outputs" for name in texts)
        refuse(found)

    def _not_settable(self, name: str) -> str | None:
        causality = self.variables[name].causality
        if causality == "input":
            return f"{name} is an input, which is 0 here: expected names of parameters"
        return (
            None if causality == "parameter" else f"{name} is computed and cannot be set: expected names of parameters"
        )


def unknown(name: object, known: Iterable[str], what: str) -> str:
    """What is said of a name that is not known, and the one that may have been meant."""
    names, start = list(known), str(name)
    longer = [one for one in names if start and one.startswith(start)]
    close = longer or difflib.get_close_matches(start, names, n=1)
    return f"{name}: {what}" + (f"; did you mean {close[0]}?" if close else "")


def refuse(found: list[str]) -> None | NoReturn:
    """Raises the problems that have been found, if there are any: the first ones, and how many more."""
    more = [f"and {len(found) - MOST_PROBLEMS} more"] if len(found) > MOST_PROBLEMS else []
    if found:
        raise ValueError("\n".join(found[:MOST_PROBLEMS] + more))
    return None


def positive(name: str, value: object) -> float:
    """A number of seconds > 0 that a scene may have, too."""
    try:
        number = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        number = 0.0
    if isinstance(value, str) or not 0.0 < number <= _native.MOST_TIME:
        raise ValueError(f"{name} = {value!r}: expected {SECONDS}")
    return number


def whole(name: str, value: object, least: int, most: int) -> int:
    """A whole number; more than the most is the most."""
    try:
        number = operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        number = least - 1
    if number < least:
        raise ValueError(f"{name} = {value!r}: expected a whole number {'>= 0' if least == 0 else '> 0'}")
    return min(number, most)


def by_name(key: str, values: Mapping[str, Any] | None) -> dict[str, Any]:
    """What has been given by name; `key` is what messages call it."""
    try:
        return {} if values is None else dict(values)
    except (TypeError, ValueError):
        raise TypeError(f"{key} = {values!r}: expected a dict by names of parameters") from None


def names_of(outputs: Iterable[str]) -> list[str]:
    """Names of outputs; a single one is no list."""
    if isinstance(outputs, str):
        raise TypeError(f"outputs = {outputs!r}: expected a list of names")
    return list(outputs)


def record_dict(record: str | os.PathLike[str] | Mapping[str, Any], key: str) -> dict[str, Any]:
    """File and options of a record; those that are None are not there."""
    if not isinstance(record, Mapping):
        return {"file": file_path(key, record)}
    source = {str(name): value for name, value in record.items() if value is not None}
    if isinstance(source.get("file"), (str, os.PathLike)):
        source["file"] = file_path(key, source["file"])
    return source


def read_record(record: Record, key: str) -> _native.Record:
    """The record of a path, of a dict as a scene has it, or of a pair of arrays; `key` is what messages call it."""
    if isinstance(record, (str, os.PathLike, Mapping)):
        source = record_dict(record, key)
        try:
            return _native.Record.read_dict(source, key) if len(source) > 1 else _native.Record.read(source["file"], key)
        except OSError:
            with open(source["file"], "rb"):  # which says it with the name of the file
                raise
    import numpy as np

    try:
        times, accelerations = record
        # What another process has sent may lie anywhere in memory.
        arrays = [np.require(np.asarray(column, np.float64), requirements=["C", "A"]) for column in (times, accelerations)]
    except (TypeError, ValueError):
        arrays = []
    if [array.ndim for array in arrays] != [1, 1]:
        expected = "a path or a pair of arrays, times in s and accelerations in m/s2, or a dict with a file"
        raise ValueError(f"{key}: expected {expected}")
    return _native.Record.of(arrays[0], arrays[1], key)
