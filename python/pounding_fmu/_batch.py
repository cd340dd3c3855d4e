"""Many runs on all cores."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from . import _native
from ._scenes import MOST_PROBLEMS, Names, by_name, names_of, positive, read_record, read_scene, refuse, warn, whole

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from ._scenes import Record, Scene


class BatchError(RuntimeError):
    """Cases of a batch that could not be run to their end; all others have been run."""

    results: NDArray[np.float64]
    """The values of all cases, NaN for those that failed; shape (cases, outputs)."""
    failures: dict[int, str]
    """Why, by the place of the case, counted from 0."""

    def __init__(self, results: NDArray[np.float64], failures: dict[int, str]) -> None:
        super().__init__(results, failures)
        self.results = results
        self.failures = failures

    def __str__(self) -> str:
        lines = [f"case {case}: {message}" for case, message in self.failures.items()]
        more = [f"and {len(lines) - MOST_PROBLEMS} more"] if len(lines) > MOST_PROBLEMS else []
        head = f"{len(lines)} of {len(self.results)} cases could not be run; .results has the others"
        return "\n".join([head, *lines[:MOST_PROBLEMS], *more])


def simulate_batch(
    scene: Scene,
    parameters: Mapping[str, ArrayLike],
    outputs: Iterable[str],
    records: Record | Sequence[Record | None] | None = None,
    threads: int | None = None,
    *,
    step: float | None = None,
    stop: float | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> NDArray[np.float64]:
    """Runs n cases of a scene on all cores and returns the values at their ends, with the bits of the FMU.

    n is the length of the arrays in ``parameters`` and of ``records``; 1 where there is none. All cases are checked
    before any is run. Other Python threads go on meanwhile, and Ctrl-C ends the batch.

    Args:
        scene: a path, a text or a dict.
        parameters: by name, an array of shape (n,) with the values of a parameter of the FMU, or one value for all
            cases. ``ground.record`` is a path or a list of n paths.
        outputs: names of the m columns: outputs of the FMU, also its frequencies and parameters. Peaks (such as
            ``contact[1].peak_force``) are those of the whole case, between all steps.
        records: other ground motions, as ``simulate`` takes them: one for all, or n of them, of which those that are
            the same path or the same arrays are read once; ``None`` among them is the scene's own.
        threads: how many cases run at a time; all cores where nothing is said. The results do not depend on it.
        step: s, communication step of the FMU; one step over everything where nothing is said. With a record, and without
            forces or corrections as ``inputs``, no value depends on it; it divides a case that is more work than one step
            may be (``BatchError`` says so). Otherwise the FMU may be driven from outside, and its steps end there.
        stop: s, end of each case; without it the scene's ``stop_time``, else the end of its record, else 10.
        progress: called with (cases done, n) about ten times a second, and at the end.

    Returns:
        ``float64`` of shape (n, m): a row for each case, a column for each output. Booleans are 0 and 1. A case ends where
        a storey collapses: the output ``left.collapsed`` or ``right.collapsed`` is 1 then.

    >>> import pounding_fmu
    >>> gaps = [0.002, 0.005, 0.02]
    >>> outputs = ["impacts", "contact[2].peak_force"]
    >>> simulate_batch(pounding_fmu.example_scene, {"contact[1].gap": gaps, "contact[2].gap": gaps}, outputs).shape
    (3, 2)

    Raises:
        ValueError: everything that is wrong with the scene, its parameters (with the case, counted from 0), or the
            records; arrays of different lengths.
        KeyError: names that the scene does not have.
        OSError: the scene file, or the one record for all, cannot be read.
        TypeError: the scene is none of the forms that a scene may have.
        BatchError: cases that cannot go on; it has the values of the others.

    Warns:
        SceneWarning: for each thing that looks like a slip, once for all cases that have it.
    """
    import numpy as np

    read, outputs = read_scene(scene), names_of(outputs)
    threads = None if threads is None else whole("threads", threads, 1, 2**31)
    step = None if step is None else positive("step", step)
    stop = None if stop is None else positive("stop", stop)
    if progress is not None and not callable(progress):
        raise TypeError(f"progress = {progress!r}: expected a function")
    columns = by_name("parameters", parameters)
    key = "records"
    if "ground.record" in columns and "ground.record" in Names(read).references:
        if records is not None:
            raise ValueError("ground.record and records: expected one of them")
        key, records = "ground.record", columns.pop("ground.record")
    motions = _Motions(read, records, key)
    names = Names(motions.scenes[0])
    names.check(columns, outputs)
    arrays = _arrays(columns)
    count = _common_length(arrays, motions)
    values = [
        (names.references[name], np.ascontiguousarray(np.broadcast_to(array, count))) for name, array in arrays.items()
    ]
    batch = _native.Batch(count, motions.scenes, motions.which, values)
    warn(batch.look(threads))
    results, failures = batch.run([names.references[name] for name in outputs], step, stop, threads, progress)
    if failures:
        raise BatchError(results, failures)
    return results


class _Motions:
    """The scene under each of its records, and which of them each case has."""

    def __init__(self, read: _native.Scene, records: Any, key: str) -> None:
        self.key = key
        self.which: list[int] | None = None
        if isinstance(records, Iterator):
            records = list(records)  # the first look at it uses it up
        if records is None or (isinstance(records, str) and not records):
            self.scenes = [read]
        elif _is_one(records):
            self.scenes = [read.with_record(read_record(records, key))]
        elif isinstance(records, Iterable):
            self._read_all(read, list(records))
        else:
            raise TypeError(f"{key} = {records!r}: expected a record, or a list of records")

    def _read_all(self, read: _native.Scene, records: list[Any]) -> None:
        self.scenes, self.which = [], []
        places: dict[object, int] = {}
        found: list[str] = []
        for case, record in enumerate(records):
            content = _identity(record)
            if content not in places:
                places[content] = len(self.scenes)
                try:
                    self.scenes.append(_under(read, record, f"{self.key}[{case}]"))
                except OSError as error:
                    found.append(f"{self.key}[{case}] = {record!r}: expected a record file, but {error.strerror}")
                except (TypeError, ValueError) as error:
                    found.append(str(error))
            self.which.append(places[content])
        refuse(found)
        self.scenes = self.scenes or [read]
        if len({len(scene.variables()) for scene in self.scenes}) > 1:
            raise ValueError(f"{self.key}: the scene has no record of its own: expected one for each case")


def _under(read: _native.Scene, record: Any, key: str) -> _native.Scene:
    if record is None or (isinstance(record, str) and not record):
        return read
    try:
        return read.with_record(read_record(record, key))
    except ValueError as error:
        raise ValueError(
            "\n".join(line if line.startswith(key) else f"{key}: {line}" for line in str(error).split("\n"))
        )


def _identity(record: Any) -> object:
    """What two records have in common that are read once."""
    if record is None or isinstance(record, (str, os.PathLike)):
        return record and os.fsdecode(record)
    if isinstance(record, Mapping):
        return tuple((name, str(value)) for name, value in record.items())
    if isinstance(record, (tuple, list)):
        return tuple(id(column) for column in record)
    return id(record)  # rows of an array are objects that last no longer than a look at them


def _is_one(records: Any) -> bool:
    """Whether it is one record and not a sequence of them: a path, or a pair whose first half is numbers."""
    if isinstance(records, (str, os.PathLike, Mapping)):
        return True
    try:
        times, _ = records
        first = times[0] if len(times) else 0.0
    except (TypeError, ValueError, KeyError, IndexError):
        return False
    return not isinstance(times, (str, os.PathLike)) and not hasattr(first, "__len__")


def _arrays(columns: Mapping[str, Any]) -> dict[str, NDArray[np.float64]]:
    """Numbers of shape (n,), or () for all cases."""
    import numpy as np

    arrays: dict[str, NDArray[np.float64]] = {}
    found: list[str] = []
    for name, values in columns.items():
        try:
            array = np.asarray(values)
            if array.dtype.kind == "O" and array.ndim == 1:
                array = np.array([float(value) for value in array])
            if array.dtype.kind not in "biuf" or array.ndim > 1:
                raise ValueError
            arrays[name] = array.astype(np.float64)
        except (TypeError, ValueError):
            found.append(f"{name} = {_short(values)}: expected a number, or an array of numbers with one dimension")
    refuse(found)
    return arrays


def _short(values: object) -> str:
    text = " ".join(repr(values).split())
    return text if len(text) <= 60 else text[:57] + "..."


def _common_length(arrays: Mapping[str, NDArray[np.float64]], motions: _Motions) -> int:
    lengths = {name: len(array) for name, array in arrays.items() if array.ndim}
    if motions.which is not None:
        lengths[motions.key] = len(motions.which)
    if len(set(lengths.values())) > 1:
        each = ", ".join(f"{name} has {length}" for name, length in lengths.items())
        raise ValueError(f"arrays of different lengths: {each}")
    return next(iter(lengths.values()), 1)
