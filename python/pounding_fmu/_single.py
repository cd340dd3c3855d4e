"""One run with all its rows."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from . import _native
from ._extras import require
from ._notebook import page
from ._scenes import Names, by_name, names_of, positive, read_record, read_scene, refuse, unknown, variables_of, warn, whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from ._scenes import Record, Scene


class Result(Mapping[str, "NDArray[Any]"]):
    """A run: numpy columns by name, ``time`` first, all as long as there are rows.

    ``float64`` for Real, ``int32`` for Integer, ``bool`` for Boolean variables. Notebooks show it as a small table and,
    where matplotlib is installed, a small picture. A copy through ``pickle`` has the columns and the impacts, but no scene:
    ``summary`` and ``plot`` are for the run itself.
    """

    impacts: NDArray[Any]
    """A structured array with a row for each contact episode in the order of their beginning: ``contact`` (counted from
    1), ``start_s``, ``end_s`` (NaN while it lasts), ``approach_velocity`` and ``separation_velocity`` (m/s),
    ``peak_force`` (N), ``peak_time_s``, ``peak_penetration`` (m), ``impulse`` (N s), ``dissipated_energy`` (J)."""

    def __init__(
        self,
        columns: Mapping[str, NDArray[Any]],
        impacts: NDArray[Any],
        scene: _native.Scene,
        step: float,
        stop: float,
    ) -> None:
        self._columns = dict(columns)
        self.impacts = impacts
        self._own_scene: _native.Scene | None = scene
        self._name, self._names, self._step, self._stop = scene.name, scene.buildings(), step, stop

    def __getstate__(self) -> dict[str, Any]:
        return self.__dict__ | {"_own_scene": None}

    @property
    def _scene(self) -> _native.Scene:
        if self._own_scene is None:
            raise RuntimeError("a pickled run has its columns and impacts only; call this on the run itself")
        return self._own_scene

    def __getitem__(self, name: str) -> NDArray[Any]:
        try:
            return self._columns[name]
        except KeyError:
            raise KeyError(self._unknown(name)) from None

    def summary(self) -> str:
        """What ``pounding-fmu SCENE.toml`` says of the scene's FMU: what went in, impacts, peaks of floors, contacts and
        storeys. The scene is run once more for it, since it needs more than the columns of this run."""
        return _native.summary(self._scene, self._step, self._stop)

    def plot(
        self,
        start: float | None = None,
        stop: float | None = None,
        picture: str = "overview",
        buildings: Sequence[str] | None = None,
    ) -> Figure:
        """Draws the run, as ``pounding-fmu plot`` does, and returns the matplotlib figure.

        Args:
            start: s, where the parts over time begin; the beginning, or where it is worth a look, if nothing is said.
            stop: s, their end.
            picture: ``overview``, or the name of a single picture, as ``pounding-fmu plot --picture`` has them.
            buildings: one or two names: those whose floors, storeys and loops are charted. Of more than two buildings those
                of the hardest impact, where nothing is said.

        Raises:
            ImportError: matplotlib is not installed; the message has the line that installs it.
            ValueError: times that are not in the run, a picture or a building that there is not.
        """
        from .plots import figure

        return figure(self, start, stop, picture, buildings)

    def to_dataframe(self) -> Any:
        """The columns as a ``pandas.DataFrame``, ``time`` first.

        Raises:
            ImportError: pandas is not installed.
        """
        return require("pandas").DataFrame(dict(self))

    def _repr_html_(self) -> str:
        return page(self, self._name)

    def _unknown(self, name: object) -> str:
        text = unknown(name, self._columns, "the run has no such column")
        if self._own_scene and name not in self._columns and name in variables_of(self._own_scene):
            return f"{name}: not among the outputs of this run; name it in outputs"
        return text

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
    *,
    rows_per_impact: int | None = None,
    without_contacts: bool = False,
) -> Result:
    """Runs a scene from 0 to ``stop`` and returns its rows and its impacts, with the bits of the FMU.

    Args:
        scene: a path, a text or a dict.
        step: s, from row to row; 0.01 where nothing is said. With a record, and without forces or corrections as
            ``inputs``, no value depends on it. Otherwise the FMU may be driven from outside, and its steps end where the
            rows are.
        stop: s, time of the last row; without it the scene's ``stop_time``, else the end of the record, else 10.
        outputs: names of the columns beside ``time``: outputs of the FMU, also its frequencies and parameters. All
            outputs where nothing is said.
        parameters: values of parameters of the FMU by name. ``ground.record`` is a path, or a dict with a file.
        record: another ground motion: a path (any format), a dict with a ``file`` and what it does not say (the keys
            of a scene's ``ground.record``), or a pair of arrays of the same length, times (s, strictly
            increasing) and accelerations (m/s2, linear in between). A scene without a record gets it as its own; it is
            scaled as the scene says.
        rows_per_impact: as many further rows within each contact, beside those at its beginning, its largest force and
            its end; none where nothing is said.
        without_contacts: leaves out all contacts: how each building moves by itself, or with its links.

    Returns:
        ``result["time"]`` and a column for each output, of shape (rows,), at the multiples of ``step`` and at ``stop``;
        ``result.impacts``, a structured array of shape (impacts,). Where a storey collapses the run ends: the last row is
        then, and ``left.collapsed`` or ``right.collapsed`` is true in it.

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
    read, names = prepared(read_scene(scene), parameters, record)
    slips = read.warnings()
    if without_contacts:
        read = read.without_contacts()
        names = Names(read)
    columns, within = wished(names, outputs, rows_per_impact)
    step = _native.STEP if step is None else positive("step", step)
    stop = read.stop() if stop is None else positive("stop", stop)
    warn(slips)
    return run(read, names, step, stop, columns, within)


def prepared(
    read: _native.Scene,
    parameters: Mapping[str, float | str | os.PathLike[str]] | None,
    record: Record | None,
) -> tuple[_native.Scene, Names]:
    """A scene under a record and with parameters, if there are any, and the names of its variables."""
    if record is not None:
        read = read.with_record(read_record(record, "record"))
    return _with_parameters(read, by_name("parameters", parameters), record is not None)


def wished(
    names: Names, outputs: Iterable[str] | None, rows_per_impact: int | None
) -> tuple[list[str] | None, int | None]:
    """The columns and the rows of each impact that a run is to have."""
    columns = None if outputs is None else [name for name in dict.fromkeys(names_of(outputs)) if name != "time"]
    names.check([], columns or [])
    return columns, None if rows_per_impact is None else whole("rows_per_impact", rows_per_impact, 0, 2**16 - 1)


def run(
    scene: _native.Scene,
    names: Names,
    step: float,
    stop: float,
    columns: list[str] | None = None,
    rows_per_impact: int | None = None,
) -> Result:
    """Runs a scene whose arguments have been checked; all outputs are columns where none are named."""
    import numpy as np

    if columns is None:
        columns = [name for name, variable in names.variables.items() if variable.causality == "output"]
    references = [names.references[name] for name in columns]
    arrays, of_impacts = _native.simulate(scene, step, stop, references, rows_per_impact)
    dtype = [(name, array.dtype) for name, array in zip(_native.IMPACT_COLUMNS, of_impacts)]
    impacts = np.empty(len(of_impacts[0]), dtype)
    for name, array in zip(_native.IMPACT_COLUMNS, of_impacts):
        impacts[name] = array
    return Result(dict(zip(["time", *columns], arrays)), impacts, scene, step, stop)


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
            elif isinstance(value, Mapping) or os.fspath(value):
                read = read.with_record(read_record(value, name))
        except OSError as error:
            found.append(f"{name} = {value!r}: expected a record file, but {error.strerror}")
        except ValueError as error:
            found.append(str(error))
        except TypeError:
            found.append(f"{name} = {value!r}: expected a {'path or a dict with a file' if name == 'ground.record' else 'number'}")
    refuse(found)
    return (read.with_parameters(numbers) if numbers else read), names


def number(value: Any) -> float:
    """A number, but not one that is written as a text or in an array."""
    if isinstance(value, (str, bytes)) or getattr(value, "ndim", None):
        raise TypeError
    return float(value)
