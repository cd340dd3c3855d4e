"""What pictures are drawn from: a scene, its run with rows within each impact, and its run without contacts."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import _native
from .._scenes import Names, unknown
from .._single import Result, run
from .layout import Layout

if TYPE_CHECKING:
    from numpy.typing import NDArray

MOST_BUILDINGS = 2  # in charts

Window = tuple[float, float]  # s, from and to

WINDOW = 5.0  # s that a picture over time shows where nothing is said
FINEST = 1e-3  # s, from row to row outside of impacts
MOST_CELLS = 2e7  # numbers of a run: as many as a picture can use and memory holds
ROWS_PER_IMPACT = 32
# Of these outputs pictures are made.
DRAWN = (
    "displacement", "acceleration", "peak_acceleration", "storey_shear", "ductility", "residual_drift", "force",
    "penetration", "collapsed", "collapse_time", "foundation.displacement", "foundation.rotation", "foundation.acceleration",
)  # fmt: skip


class Run:
    """Columns by name, and the rows of impacts; of rigid contacts these have no force."""

    def __init__(self, result: Result, rigid: set[int]) -> None:
        self.result, self.impacts, self.time, self.rigid = result, result.impacts, result["time"], rigid

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self.result[name]

    def __contains__(self, name: str) -> bool:
        return name in self.result

    def of_contact(self, contact: int) -> NDArray[Any]:
        """The impacts of one contact, which are counted from 1."""
        own: NDArray[Any] = self.impacts[self.impacts["contact"] == contact]
        return own

    def hardest(self, contacts: Iterable[int] | None = None) -> Any:
        """The impact, of these contacts or of all, with the largest force; where all are of rigid contacts, that with the
        largest impulse."""

        def hardness(impact: Any) -> tuple[bool, float]:
            is_soft = impact["contact"] not in self.rigid
            return is_soft, float(impact["peak_force" if is_soft else "impulse"])

        impacts = self.impacts if contacts is None else self.impacts[np.isin(self.impacts["contact"], [*contacts])]
        return max(impacts, key=hardness, default=None)

    def rows(self, start: float, end: float) -> slice:
        """Those from one time to another."""
        return slice(int(np.searchsorted(self.time, start)), int(np.searchsorted(self.time, end, side="right")))

    def rows_of(self, impact: Any) -> slice:
        """Those of an impact; one that is open lasts to the end."""
        return slice(*np.searchsorted(self.time, [impact["start_s"], np.nan_to_num(impact["end_s"], nan=np.inf)]))


class Runs:
    """A scene, its run to a time, s, and that without contacts, once they are asked for; what of it is to be seen: from when
    to when, and of a row of more than two buildings which of them."""

    def __init__(
        self,
        scene: _native.Scene,
        stop: float,
        start: float | None = None,
        end: float | None = None,
        buildings: Sequence[str] | None = None,
    ) -> None:
        self._scene, self.stop, self._start, self._end = scene, stop, start, end
        self.scene = Layout(scene)
        self._named = None if buildings is None else chosen(buildings, self.scene.names)
        for name, time in [("from", start), ("to", end)]:
            if time is not None and not 0.0 <= time <= stop * (1 + 1e-12):
                raise ValueError(f"{name} = {time:g}: expected a time within the run, from 0 to {stop:g} s")
        if start is not None and start >= (stop if end is None else end):
            raise ValueError(f"from = {start:g}: expected a time before {stop if end is None else end:g} s, the end")

    @cached_property
    def run(self) -> Run:
        """With rows within each impact."""
        impacts = self._run(self._scene, min(0.02, self.stop), []).impacts
        within = int(min(ROWS_PER_IMPACT, self._most_rows / 2 / max(1, len(impacts)) - 5))
        return self._run(self._scene, self._step, self._drawn(self._scene), max(0, within))

    @cached_property
    def buildings(self) -> list[str]:
        """Those of charts, from left to right: both of two, those that were asked for, or those of the hardest impact; without
        any of the contact that came nearest to one, and without contacts the two that move farthest."""
        if self._named is not None:
            return self._named
        if self.scene.is_pair:
            return self.scene.names
        if self.scene.contacts:
            return self.scene.contacts[self.hardest_contact(range(1, len(self.scene.contacts) + 1)) - 1].sides
        farthest = {side: np.abs(self.run[f"{side}.displacement[{n}]"]).max() for side, n in self.scene.floors.items()}
        most = sorted(farthest, key=farthest.__getitem__)[-2:]
        return [side for side in self.scene.names if side in most]

    @cached_property
    def contacts(self) -> list[int]:
        """Those of charts, counted from 1: all of two buildings, else those between the ones that are shown, or where there
        are none, those that any of them has."""
        every = {p: {*pair.sides} for p, pair in enumerate(self.scene.contacts, 1)}
        if self._named is None and self.scene.is_pair:
            return list(every)
        shown = {*self.buildings}
        return [p for p, sides in every.items() if sides <= shown] or [p for p, sides in every.items() if sides & shown]

    @cached_property
    def hardest(self) -> Any:
        """The hardest impact of these contacts."""
        return self.run.hardest(self.contacts)

    def hardest_contact(self, of: Iterable[int]) -> int:
        """The one of the hardest impact of these contacts, or without any the one that came nearest to it."""
        contacts = list(of)
        hardest = self.run.hardest(contacts)
        if hardest is not None:
            return int(hardest["contact"])
        return max(contacts, key=lambda p: float(self.run[f"contact[{p}].penetration"].max()))

    @property
    def has_alone(self) -> bool:
        """Whether there is a run without contacts to compare with: another program would have to be asked again."""
        return bool(self.scene.contacts) and not self._scene.is_coupled()

    @cached_property
    def alone(self) -> Run:
        """Without contacts."""
        scene = self._scene.without_contacts()
        return self._run(scene, self._step, self._drawn(scene))

    @cached_property
    def _most_rows(self) -> float:
        return MOST_CELLS / len(self._drawn(self._scene))

    @property
    def _step(self) -> float:
        return max(FINEST, 2 * self.stop / self._most_rows)

    def _drawn(self, scene: _native.Scene) -> list[str]:
        outputs = [name for name, variable in Names(scene).variables.items() if variable.causality == "output"]
        return [name for name in outputs if name.partition(".")[2].partition("[")[0] in DRAWN]

    def _run(self, scene: _native.Scene, step: float, columns: list[str], rows_per_impact: int | None = None) -> Run:
        rigid = {p for p, pair in enumerate(self.scene.contacts, 1) if pair.is_rigid}
        return Run(run(scene, Names(scene), step, self.stop, columns, rows_per_impact), rigid)

    def collapse(self, of: Run) -> tuple[str, int, float] | None:
        """Building, storey and time, s, of the collapse that has ended a run: of those that lean and yield the storey with the
        largest drift ratio then."""
        for side, count in self.scene.floors.items():
            if f"{side}.collapsed" in of and of[f"{side}.collapsed"][-1]:
                drifts = [self.scene.drift(of, side, i)[-1] for i in range(1, count + 1)]
                ratios = np.abs(drifts) / self.scene.heights[side]
                names = Names(self._scene).variables
                for i in range(1, count + 1):
                    if not {f"{side}.stability_coefficient[{i}]", f"{side}.ductility[{i}]"} <= names.keys():
                        ratios[i - 1] = 0.0
                return side, int(np.argmax(ratios)) + 1, float(of[f"{side}.collapse_time"][-1])
        return None

    def check_motion(self) -> None:
        """What stands still makes no picture."""
        if not any(np.any(self.run[f"{side}.displacement[1]"]) for side in self.scene.floors):
            raise ValueError("nothing moves in this scene: give it a ground motion with --record FILE")

    def seen(self, start: float, end: float) -> Window:
        """s, what pictures over time show: what was asked for, else these."""
        return start if self._start is None else self._start, end if self._end is None else self._end

    @cached_property
    def window(self) -> Window:
        """s, what was asked for; else the seconds with the strongest pounding."""
        if self._start is self._end is None:
            return self._strongest()
        return self.seen(0.0, self.stop)

    def _strongest(self) -> Window:
        """The window with the largest sum of impulses; without impacts that with the largest displacement."""
        if self.stop <= WINDOW:
            return 0.0, self.stop
        times, weights = self.run.time, self.run[f"{self.buildings[0]}.displacement[1]"] ** 2
        impacts = self.run.impacts[np.isin(self.run.impacts["contact"], self.contacts)]
        if len(impacts):
            times, weights = impacts["start_s"], np.abs(impacts["impulse"])
        starts = np.linspace(0.0, self.stop - WINDOW, 200)
        totals = np.array([np.sum(weights[(times >= start) & (times < start + WINDOW)]) for start in starts])
        best = starts[totals == totals.max()]
        # In the middle of those that show as much: what happens is not at the edge.
        start = float(best[len(best) // 2])
        return start, start + WINDOW


def chosen(wanted: Sequence[str], names: Sequence[str]) -> list[str]:
    """The buildings that are asked for, from left to right, or what is wrong with that."""
    among = f"expected one or two of {', '.join(names)}"
    for name in wanted:
        if name not in names:
            raise ValueError(f"buildings: {unknown(name, names, 'the scene has no such building')}; {among}")
    if not 0 < len(set(wanted)) <= MOST_BUILDINGS:
        raise ValueError(f"buildings = {' '.join(wanted)}: {among}")
    return [name for name in names if name in wanted]
