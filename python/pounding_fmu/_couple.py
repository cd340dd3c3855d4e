"""One run in which buildings are another program's."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, Protocol

from . import _native
from ._scenes import by_name, positive, read_scene, refuse, unknown, warn
from ._single import Result, prepared, run, wished

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from ._scenes import Record, Scene

WAYS = ("line", "twice", "held")
# Of the largest stiffness: what differences of forces leave.
ROUNDING = 1e-6


class Model(Protocol):
    """A building that another program has. Any object with these two methods is one."""

    def initial_stiffness(self) -> ArrayLike:
        """N/m: one number per storey, lowest first, of a shear building, or else a symmetric matrix over the floors. It
        need not be exact, but at least the largest stiffness that the building ever has."""

    def move(self, displacements: NDArray[Any]) -> ArrayLike:
        """The forces, N, that hold the floors at these displacements relative to their base, m, one per floor, lowest
        first. What is asked has happened: the history of the building goes on from here."""


def couple(
    scene: Scene,
    left: Model | None = None,
    right: Model | None = None,
    step: float = 0.0025,
    how: str = "line",
    stop: float | None = None,
    outputs: Iterable[str] | None = None,
    parameters: Mapping[str, float | str | os.PathLike[str]] | None = None,
    record: Record | None = None,
    *,
    models: Mapping[str, Model] | None = None,
    rows_per_impact: int | None = None,
) -> Result:
    """Runs a scene in which one building or several are another program's: it answers with restoring forces, step by step.

    Masses, damping, foundations, gravity, links and contacts are those of the scene, and so are the other buildings. Of a
    building that a model has, ``initial_stiffness()`` takes the place of its ``stiffness`` or ``stiffness_matrix``, and
    it does not yield by itself. What the model adds to that stiffness goes in as a line over each step (the inputs
    ``left.storey_correction[i]`` or ``left.restoring_correction[i]``), and impacts are found within the step as ever.

    Args:
        scene: a path, a text or a dict, which may leave out the stiffness of a building that a model has.
        left: the building on the left, with ``initial_stiffness()`` and ``move(displacements)``; without it, that of the
            scene. A model keeps what it has been through: each run wants one of its own.
        right: likewise.
        models: those of any buildings by their names, as ``{"corner": model}``.
        step: s, from one call of ``move`` to the next, and from row to row.
        how: ``"line"``: corrections go on over a step as they went over the last one. ``"twice"``: a step is tried so,
            the model is moved to where that leads, and the step is made again with corrections that lead there: errors
            are three to four times smaller. ``"held"``: corrections stay as they were at the beginning of a step, as
            masters do that know no slopes. The error of the first two falls with the square of the step, that of the
            last with the step.
        stop: s, time of the last row; without it the scene's ``stop_time``, else the end of the record, else 10.
        outputs: names of the columns beside ``time``; all outputs where nothing is said.
        parameters: values of parameters of the FMU by name.
        record: another ground motion, as in ``simulate``.
        rows_per_impact: as in ``simulate``.

    Returns:
        A run as ``simulate`` returns it. Storey shears, base shears and their peaks are the model's, and peaks are those
        in continuous time. The model has been moved once at the start and once for each step; it is not asked again for
        pictures or ``summary()``.

    >>> import numpy as np
    >>> import pounding_fmu
    >>> class Slipping:
    ...     stiffness, strength, slipped = 2910.0, 40.0, np.zeros(2)
    ...     def initial_stiffness(self):
    ...         return [self.stiffness] * 2
    ...     def move(self, displacements):
    ...         drift = np.diff(displacements, prepend=0.0)
    ...         limit = self.strength / self.stiffness
    ...         self.slipped = drift - np.clip(drift - self.slipped, -limit, limit)
    ...         shear = self.stiffness * (drift - self.slipped)
    ...         return shear - np.append(shear[1:], 0.0)
    >>> result = couple(pounding_fmu.example_scene, left=Slipping(), stop=5)
    >>> round(float(np.abs(result["left.storey_shear[1]"]).max()), 6)
    40.0

    Raises:
        ValueError: everything that is wrong with the scene, the parameters, the record or a model's stiffness.
        KeyError: names that the scene does not have.
        OSError: the scene file or the record cannot be read.
        TypeError: the scene is none of the forms that a scene may have; a model lacks one of its methods.
        RuntimeError: a model has failed (what it has raised is the cause; the message says when, and in which storey the
            drift was largest), or the run cannot go on.

    Warns:
        SceneWarning: for each thing that looks like a slip, also where a model becomes stiffer than its
            ``initial_stiffness()``.
    """
    models = _models({"left": left, "right": right}, models, how)
    step = positive("step", step)
    stiffness = {side: _stiffness(side, model) for side, model in models.items()}
    read = read_scene(_completed(scene, stiffness))
    places = _places(read, models)
    read = _native.with_outside(read, [(places[side], rows) for side, rows in stiffness.items()])
    read, names = prepared(read, parameters, record)
    columns, within = wished(names, outputs, rows_per_impact)
    stop = read.stop() if stop is None else positive("stop", stop)
    warn(read.warnings())
    calls = [(places[side], model.move) for side, model in models.items()]
    coupled, slips = _native.couple(read, calls, how, step, stop)
    warn(slips)
    return run(coupled, names, step, stop, columns, within)


def _models(sides: Mapping[str, Model | None], named: Mapping[str, Model] | None, how: str) -> dict[str, Model]:
    """All models by the names of their buildings."""
    found = [] if how in WAYS else [f"how = {how!r}: expected one of {', '.join(WAYS)}"]
    models = {side: model for side, model in sides.items() if model is not None}
    of_row = by_name("models", named)
    found += [f"models: {side}: expected it once, here or by its own argument" for side in of_row if side in models]
    models |= of_row
    found += [] if models else ["left, right: expected a model for at least one building"]
    refuse(found)
    for side, model in models.items():
        missing = [name for name in ("initial_stiffness", "move") if not callable(getattr(model, name, None))]
        if missing:
            expected = "a model with initial_stiffness() and move(displacements)"
            raise TypeError(f"{side}: expected {expected}, but it has no {missing[0]}")
    return models


def _places(read: _native.Scene, models: Iterable[str]) -> dict[str, int]:
    """Where in the row the buildings stand that have models."""
    places = {side: place for place, side in enumerate(read.buildings())}
    among = f"expected the name of a building ({', '.join(places)})"
    refuse([f"{unknown(side, places, 'the scene has no such building')}; {among}" for side in models if side not in places])
    return places


def _completed(scene: Scene, stiffness: Mapping[str, list[list[float]]]) -> Scene:
    """A dict may leave out the stiffness that a model has."""
    if not isinstance(scene, Mapping):
        return scene

    def completed(side: str, building: Any) -> Any:
        rows = stiffness.get(side)
        if rows is None or not isinstance(building, Mapping) or {"stiffness", "stiffness_matrix"} & building.keys():
            return building
        own = {"stiffness": rows[0]} if len(rows) == 1 else {"stiffness_matrix": rows}
        return {**building, **own}

    of_sides = {side: completed(side, scene[side]) for side in ("left", "right") if side in scene}
    row = scene.get("building")
    if not isinstance(row, (list, tuple)):
        return {**scene, **of_sides}
    # A building without a name has that of its place.
    named = [(str(of.get("name", f"b{place}")) if isinstance(of, Mapping) else "", of) for place, of in enumerate(row, 1)]
    return {**scene, **of_sides, "building": [completed(name, of) for name, of in named]}


def _stiffness(side: str, model: Model) -> list[list[float]]:
    """N/m, rows of a symmetric matrix; of a shear building given by its storeys a single row."""
    import numpy as np

    key = f"{side}: initial_stiffness()"
    try:
        found = np.asarray(model.initial_stiffness(), np.float64)
    except (TypeError, ValueError):
        raise ValueError(f"{key}: expected numbers in N/m, one per storey or a matrix over the floors") from None
    rows = np.atleast_2d(found)
    if found.ndim < 2:
        refuse([] if np.isfinite(rows).all() else [f"{key} = {found.tolist()}: expected finite numbers in N/m"])
        return listed(rows)
    if found.ndim != 2 or rows.shape[0] != rows.shape[1] or not np.isfinite(rows).all():
        raise ValueError(f"{key} of shape {found.shape}: expected a finite symmetric matrix over the floors in N/m")
    apart, largest = np.abs(rows - rows.T).max(), np.abs(rows).max()
    if apart > ROUNDING * largest:
        share = f"{apart / largest:.1e} of its largest entry"
        raise ValueError(f"{key}: it differs from its transpose by {share}; expected a symmetric matrix")
    return listed((rows + rows.T) / 2)


def listed(rows: NDArray[Any]) -> list[list[float]]:
    return [[float(entry) for entry in row] for row in rows]
