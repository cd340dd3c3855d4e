"""One run with all its rows."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from . import _native
from ._scenes import Names, names_of, positive, read_record, read_scene, refuse, warn

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ._scenes import Record, Scene


class Result(Mapping[str, "NDArray[Any]"]):
    """A run: numpy columns by name, ``time`` first, all as long as there are rows.

    ``float64`` for Real, ``int32`` for Integer, ``bool`` for Boolean variables. ``dict(result)`` is what a
    ``pandas.DataFrame`` is made of.
    """

    impacts: NDArray[Any]
    """A structured array with a row for each contact episode in the order of their beginning: ``contact`` (counted from
    1), ``start_s``, ``end_s`` (NaN while it lasts), ``approach_velocity`` and ``separation_velocity`` (m/s),
    ``peak_force`` (N), ``peak_time_s``, ``peak_penetration`` (m), ``impulse`` (N s), ``dissipated_energy`` (J)."""

    def __init__(self, columns: Mapping[str, NDArray[Any]], impacts: NDArray[Any]) -> None:
        self._columns = dict(columns)
        self.impacts = impacts

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    # Columns of two runs are compared one by one; as a whole each run is itself.
    __eq__ = object.__eq__
    __hash__ = object.__hash__

    def __repr__(self) -> str:
        time = self["time"]
        rows = f"{len(time)} rows from {time[0]:g} s to {time[-1]:g} s"
        return f"<Result: {rows}, {len(self)} columns, {len(self.impacts)} impacts>"


def simulate(
    scene: Scene,
    step: float | None = None,
    stop: float | None = None,
    outputs: Iterable[str] | None = None,
    parameters: Mapping[str, float | str | os.PathLike[str]] | None = None,
    record: Record | None = None,
) -> Result:
    """Runs a scene from 0 to ``stop`` and returns its rows and its impacts, with the bits of the FMU.

    Args:
        scene: a path, a text or a dict.
        step: s, from row to row; 0.01 where nothing is said. With a record, and without
            ``inputs.floor_forces``, no value depends on it. Otherwise the FMU may be driven from outside, and its steps
            end where the rows are.
        stop: s, time of the last row; without it the scene's ``stop_time``, else the end of the record, else 10.
        outputs: names of the columns beside ``time``: outputs of the FMU, also its frequencies and parameters. All
            outputs where nothing is said.
        parameters: values of parameters of the FMU by name. ``ground.record`` is a path.
        record: another ground motion: a path (any format), or a pair of arrays of the same length, times (s, strictly
            increasing) and accelerations (m/s2, linear in between). A scene without a record gets it as its own; it is
            scaled as the scene says.

    Returns:
        ``result["time"]`` and a column for each output, of shape (rows,), at the multiples of ``step`` and at ``stop``;
        ``result.impacts``, a structured array of shape (impacts,).

    >>> import pounding_fmu
    >>> result = simulate(pounding_fmu.example_scene, parameters={"contact[1].gap": 0.01, "contact[2].gap": 0.01})
    >>> result
    <Result: 2001 rows from 0 s to 20 s, 60 columns, 68 impacts>
    >>> result["contact[1].active"].dtype, result["impacts"][-1] == len(result.impacts)
    (dtype('bool'), np.True_)

    Raises:
        ValueError: everything that is wrong with the scene, the parameters or the record.
        KeyError: names that the scene does not have.
        OSError: the scene file or the record cannot be read.
        TypeError: the scene is none of the forms that a scene may have.
        RuntimeError: the run cannot go on; the message says from when on, and what to change.
        MemoryError: more rows than there is room for.

    Warns:
        SceneWarning: for each thing that looks like a slip.
    """
    import numpy as np

    read = read_scene(scene)
    if record is not None:
        read = read.with_record(read_record(record, "record"))
    read, names = _with_parameters(read, {} if parameters is None else dict(parameters), record is not None)
    if outputs is None:
        columns = [name for name, variable in names.variables.items() if variable.causality == "output"]
    else:
        columns = [name for name in dict.fromkeys(names_of(outputs)) if name != "time"]
    names.check([], columns)
    step = _native.STEP if step is None else positive("step", step)
    stop = read.stop() if stop is None else positive("stop", stop)
    warn(read.warnings())

    arrays, of_impacts = _native.simulate(read, step, stop, [names.references[name] for name in columns])
    dtype = [(name, array.dtype) for name, array in zip(_native.IMPACT_COLUMNS, of_impacts)]
    impacts = np.empty(len(of_impacts[0]), dtype)
    for name, array in zip(_native.IMPACT_COLUMNS, of_impacts):
        impacts[name] = array
    return Result(dict(zip(["time", *columns], arrays)), impacts)


def _with_parameters(
    read: _native.Scene, parameters: Mapping[str, Any], has_record: bool
) -> tuple[_native.Scene, Names]:
    """The scene with parameters set, and the names of its variables."""
    names = Names(read)
    names.check(parameters, [])
    numbers, found = [], []
    for name, value in parameters.items():
        try:
            if names.variables[name].type != "String":
                numbers.append((names.references[name], number(value)))
            elif has_record:
                found.append(f"{name} = {value!r}: expected either this or record")
            elif os.fspath(value):
                read = read.with_record(read_record(value, name))
        except OSError as error:
            found.append(f"{name} = {value!r}: expected a record file, but {error.strerror}")
        except ValueError as error:
            found.append(str(error))
        except TypeError:
            found.append(f"{name} = {value!r}: expected a {'path' if name == 'ground.record' else 'number'}")
    refuse(found)
    return (read.with_parameters(numbers) if numbers else read), names


def number(value: Any) -> float:
    """A number, but not one that is written as a text or in an array."""
    if isinstance(value, (str, bytes)) or getattr(value, "ndim", None):
        raise TypeError
    return float(value)
