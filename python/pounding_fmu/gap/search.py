"""The search for the gap that two buildings need: runs of a scene under each ground motion, with one gap after another.

Until floors meet the motion is that without contact, so where the buildings do not meet they do not with a wider gap
either: the gap that they need is enclosed between one with impacts and one without. That holds with links, too, which are
in every run; but rules of codes are for buildings that move apart from each other. Impacts and forces are those of
continuous time. The largest force has no such order, so gaps are scanned for it first.
"""

from __future__ import annotations

import itertools
import json
import math
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from .. import _native
from .._batch import simulate_batch
from .._scenes import SceneWarning, path_of, read_scene, refuse, unknown, variables_of
from ..study.records import label, named, offset_of, read_records

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from .._scenes import Record, Scene

    Numbers = NDArray[np.float64]

ENDS = ("left", "right")  # of a gap or a link
FAR = 1e3  # m
TOLERANCE = 1e-6  # m
AT_ONCE = 8  # gaps that divide each interval
SCAN = 200  # gaps at which forces are first looked at
SHARES = (1.01, 0.8, 0.6, 0.4, 0.2, 0.0)  # of the gap that keeps the buildings apart: what smaller ones cost
EUROCODE = 0.7  # for floors at the same levels [Eurocode2004, section 4.4.2.7]


@dataclass(frozen=True)
class RequiredGap:
    """Of one ground motion; lengths in m. Rules are those of the contact for which they ask most."""

    record: str
    pga: float
    """m/s2, peak of the ground acceleration"""
    gap: float
    """that the buildings need to stay apart, to 1e-6 m on the safe side"""
    contact: int | None
    """that closes first with a smaller one, counted from 1; None where no gap is needed"""
    absolute_sum: float
    """sum of the largest displacements a and b of both buildings at a contact"""
    srss: float | None
    """root of a2 + b2: Eurocode 8, and ASCE 7 [ASCE2016, section 12.12.3], for two buildings on one property; None where
    links join the buildings, as it is for those that move independently"""
    eurocode: float | None
    """0.7 times that, if there is one, which Eurocode 8 allows where all contacts are between floors at the same levels;
    else None"""
    ddc: float | None
    """root of a2 + b2 - 2 rho a b, rho the correlation of the first modes of both buildings [JengKasaiMaison1992]; None
    where there are links or soil, which change these modes"""
    force_gap: float | None = None
    """from which on no gap has a larger force than the limit, to 1e-6 m on the safe side; None without a limit"""
    hardest_force: float | None = None
    """N, the largest force of all gaps that were tried for that"""
    hardest_gap: float | None = None
    """the gap that has it"""
    collapsed: str | None = None
    """the building, or "left and right", that collapses without contact: all of the above is until then"""
    between: str | None = None
    """of a row: the two neighbours, "corner, middle", or a building and a wall; None where the gap is that of all contacts"""
    force_factor: float | None = None
    """of a row: by which all gaps of the scene are multiplied for `force_gap`"""


@dataclass(frozen=True)
class Cost:
    """What a gap costs, in the worst of all ground motions."""

    gap: float
    """m; of a row the share of the gap that each two neighbours need"""
    pounding: int
    """ground motions in which the buildings meet"""
    impacts: int
    force: float
    """N"""
    drift_ratios: dict[str, float]
    """of each building the largest ratio of a storey's drift to that without contact"""


@dataclass(frozen=True)
class Joint:
    """What is between two neighbours, or between a building and a wall beside it."""

    ends: tuple[str | None, str | None]
    """the buildings on the left and on the right; None is a wall"""
    contacts: list[int]
    """counted from 1"""

    @property
    def name(self) -> str:
        return ", ".join(end or "wall" for end in self.ends)


class Motion:
    """A ground motion at one intensity."""

    def __init__(self, name: str, record: _native.Record, scene: _native.Scene, pga: float | None) -> None:
        import numpy as np

        self.name, self.samples = name, record.samples()
        peak = float(np.abs(self.samples[1]).max())
        under = scene.with_record(record)
        of_scene: Any = variables_of(under)["ground.scale"].start
        self.scale = of_scene if pga is None else pga / peak
        self.pga = self.scale * peak if pga is None else pga
        self.stop = max(under.stop(), float(self.samples[0][-1]))


class Search:
    """Runs of a scene under each ground motion, with one gap after another."""

    def __init__(
        self,
        scene: Scene,
        records: Sequence[Record] | Mapping[str, Record] | None,
        pga: Iterable[float] | None,
        force: float | None,
        threads: int | None,
        progress: Callable[[int, int], object] | None,
        between: Sequence[str] | None = None,
    ) -> None:
        self.scene, self.force, self.threads, self.progress = scene, force, threads, progress
        read, path = read_scene(scene), path_of(scene)
        where = f"{path}: " if path else ""
        self.warnings, self.layout = read.warnings(), json.loads(read.layout())
        self.buildings = read.buildings()
        self.modes = dict(zip(self.buildings, read.first_modes()))
        self.is_linked = bool(self.layout["links"])
        self.joints = joints_of(self.layout)
        self.joint = None if between is None else between_of(self.joints, self.buildings, list(between), where)
        self.motions = _motions(read, where, records, None if pga is None else [float(value) for value in pga])
        self.names = list(variables_of(read))
        # Those whose gap is varied; others stay as in the scene.
        self.contacts: Sequence[int] = range(1, len(self.layout["contacts"]) + 1) if self.joint is None else self.joint.contacts
        self.founded = {building["name"] for building in self.layout["buildings"] if building["foundation"]}
        self.on_soil = bool(self.founded)
        of_row = (".peak_displacement[", ".foundation.peak_displacement", ".foundation.peak_rotation")
        self.peaks = [name for name in self.names if any(part in name for part in of_row)]
        self.falls = [name for name in self.names if name.endswith(".collapsed")]
        self.drifts = {
            side: names
            for side in self.buildings
            if (names := [name for name in self.names if name.startswith(f"{side}.peak_drift[")])
        }
        found = [f"{where}expected a scene with contacts"] * (not self.contacts)
        found += [f"{where}expected a scene with peaks: outputs.peaks = true"] * (not self.peaks)
        if force is not None:
            found += [f"force = {force!r}: expected a number of N > 0"] * (not 0.0 < force < math.inf)
            rigid = [p for p in self.contacts if f"contact[{p}].stiffness" not in self.names]
            found += [f"force: contact[{p}] is stereomechanical, whose impacts have an impulse and no force" for p in rigid]
        refuse([*found, *self.more_problems()])
        self.done = 0

    def more_problems(self) -> list[str]:
        """What else is wrong."""
        return []

    def run(self) -> list[RequiredGap]:
        """Of each ground motion the gap that it needs, and what rules say."""
        import numpy as np

        count = len(self.motions)
        apart = self._ends(self._all(np.full((count, 1), FAR)), self.peaks + self.falls)[:, 0]
        peaks, fallen = np.split(apart, [len(self.peaks)], axis=1)
        collapsed = [self._collapsed(of) for of in fallen]
        rules = [self._rules(dict(zip(self.peaks, of)), self.contacts) for of in peaks]
        # The buildings cannot come nearer than by what either of them moves.
        widest = np.array([rule["absolute_sum"] for rule in rules]) * (1 + 1e-9)
        impacts = [f"contact[{p}].impacts" for p in self.contacts]
        needed = self._enclose(np.zeros(count), widest, lambda gaps: self._ends(self._all(gaps), impacts).max(axis=2) > 0)
        first = self._ends(self._all(np.maximum(needed - 2 * TOLERANCE, 0.0)[:, None]), impacts)[:, 0]
        closes = [self.contacts[int(np.argmax(of))] if of.any() else None for of in first]
        forces: list[dict[str, Any]] = [{} for _ in range(count)]
        if self.force is not None:
            forces = [dict(of) for of in self._forces(needed, self.force, self._all)]
        for more, sides in zip(forces, collapsed):
            more["collapsed"] = sides
            more["between"] = self.joint and self.joint.name
        found: Any = zip(self.motions, needed.tolist(), closes, rules, forces)
        return [RequiredGap(of.name, of.pga, gap, contact, **rule, **more) for of, gap, contact, rule, more in found]

    def _all(self, gaps: Numbers) -> dict[int, Numbers]:
        """All contacts that are varied, with these gaps."""
        return dict.fromkeys(self.contacts, gaps)

    def _collapsed(self, fallen: Iterable[float]) -> str | None:
        return " and ".join(name.split(".")[0] for name, fell in zip(self.falls, fallen) if fell) or None

    def _forces(
        self, needed: Numbers, limit: float, at: Callable[[Numbers], Mapping[int, Numbers]], tolerance: float = TOLERANCE
    ) -> list[dict[str, float]]:
        """From which gap on the force stays below the limit, and the largest force that was found; `at` says what a gap, or a
        factor on gaps, is for each contact."""
        import numpy as np

        gaps = needed[:, None] * np.linspace(0.0, 1.0, SCAN)
        forces = self._largest_force(at(gaps))
        exceeds = forces > limit
        # With the widest gap there is no contact: where a gap exceeds the limit there is one above it.
        last = np.where(exceeds.any(axis=1), SCAN - 1 - np.argmax(exceeds[:, ::-1], axis=1), 0)
        each = np.arange(len(needed))
        intervals = gaps[each, last], gaps[each, last + 1]
        refined = self._enclose(*intervals, lambda tried: self._largest_force(at(tried)) > limit, tolerance)
        hardest = np.argmax(forces, axis=1)
        return [
            {"force_gap": float(refined[i]), "hardest_force": float(forces[i, most]), "hardest_gap": float(gaps[i, most])}
            for i, most in enumerate(hardest)
        ]

    def _largest_force(self, gaps: Mapping[int, Numbers]) -> Numbers:
        forces: Numbers = self._ends(gaps, [f"contact[{p}].peak_force" for p in self.contacts]).max(axis=2)
        return forces

    def _enclose(
        self,
        low: Numbers,
        high: Numbers,
        is_bad: Callable[[Numbers], NDArray[np.bool_]],
        tolerance: float = TOLERANCE,
    ) -> Numbers:
        """The gaps from which on nothing that was tried is bad: `low` where it is not, else below `high`, which is not."""
        import numpy as np

        each, shares = np.arange(len(low)), np.arange(1, AT_ONCE + 1) / (AT_ONCE + 1)
        high = np.where(is_bad(low[:, None])[:, 0], high, low)
        while (high - low).max() > tolerance:
            tried = low[:, None] + (high - low)[:, None] * shares
            bad = is_bad(tried)
            last = np.where(bad.any(axis=1), AT_ONCE - np.argmax(bad[:, ::-1], axis=1), 0)
            bounds = np.column_stack([low, tried, high])
            low, high = bounds[each, last], bounds[each, last + 1]
        return high

    def _ends(self, gaps: Mapping[int, Numbers], outputs: Sequence[str]) -> Numbers:
        """The outputs at the end of each ground motion (first index) with each of its gaps (second index), by contacts."""
        import numpy as np

        count, tried = next(iter(gaps.values())).shape
        ends = np.empty((count, tried, len(outputs)))
        for stop in dict.fromkeys(motion.stop for motion in self.motions):
            which = [i for i, motion in enumerate(self.motions) if motion.stop == stop for _ in range(tried)]
            rows = sorted(set(which))
            parameters: dict[str, Any] = {f"contact[{p}].gap": of[rows].ravel() for p, of in gaps.items()}
            parameters["ground.scale"] = [self.motions[i].scale for i in which]
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", SceneWarning)
                found = simulate_batch(
                    self.scene,
                    parameters,
                    outputs,
                    [self.motions[i].samples for i in which],
                    self.threads,
                    stop=stop,
                    progress=self._tell,
                )
            ends[rows] = found.reshape(len(rows), tried, len(outputs))
            self.done += len(which)
        return ends

    def _tell(self, done: int, _: int) -> None:
        if self.progress is not None:
            self.progress(self.done + done, max(self._planned(), self.done + done))

    def _planned(self) -> int:
        """Runs until all is found, about: how wide the first intervals are is not known before."""
        rounds = math.log(1.0 / TOLERANCE) / math.log(AT_ONCE + 1)
        search = 3 + AT_ONCE * math.ceil(rounds)
        by_force = SCAN + AT_ONCE * math.ceil(rounds - math.log(SCAN) / math.log(AT_ONCE + 1))
        return len(self.motions) * (search + (by_force if self.force is not None else 0))

    def _rules(self, peaks: Mapping[str, float], contacts: Iterable[int]) -> dict[str, float | None]:
        """What rules say of these contacts between two buildings and with walls, by the largest displacements of the floors that
        meet; between floors at most their mean."""
        of_contacts = [self.layout["contacts"][p - 1] for p in contacts]
        pairs = []
        for contact in of_contacts:
            moves = {end: 0.0 for end in ENDS}
            ends = {contact[end].get("side"): end for end in ENDS}
            for side, name, weight in contact["row"]:
                *of, quantity = name.split(".")
                moves[ends[side]] += abs(weight) * peaks[".".join([side, *of, f"peak_{quantity}"])]
            pairs.append((moves["left"], moves["right"]))
        sides = [name for name in self.buildings if any(name in sides_of(contact) for contact in of_contacts)]
        modes = [self.modes[side] for side in sides]
        rho = correlation(modes[0], modes[1]) if len(modes) == 2 and modes[0] and modes[1] else 0.0
        links = [set(sides_of(link)) for link in self.layout["links"]]
        srss = None if {*sides} in [link for link in links if len(link) == 2] else max(math.hypot(a, b) for a, b in pairs)
        kinds = {contact[end]["kind"] for contact in of_contacts for end in ENDS}
        are_alone = not any(link & {*sides} for link in links) and not self.founded & {*sides}
        return {
            "absolute_sum": max(a + b for a, b in pairs),
            "srss": srss,
            "eurocode": EUROCODE * srss if srss is not None and kinds == {"floor"} else None,
            "ddc": max(difference(a, b, rho) for a, b in pairs) if are_alone else None,
        }

    def costs_of(self, rows: Sequence[RequiredGap]) -> list[Cost]:
        """What smaller gaps cost than those that are needed."""
        widest = max(row.gap for row in rows)
        return self.costs(widest) if widest > 0 else []

    def costs(self, widest: float) -> list[Cost]:
        """What gaps cost that are shares of this one, in all ground motions."""
        return self._costs([share * widest for share in SHARES], self._all)

    def _costs(self, gaps: Sequence[float], at: Callable[[Numbers], Mapping[int, Numbers]]) -> list[Cost]:
        import numpy as np

        count = len(self.motions)
        names = list(itertools.chain(*self.drifts.values()))
        of_contacts = [f"contact[{p}].{what}" for what in ("impacts", "peak_force") for p in self.contacts]
        outputs = [*names, *of_contacts]
        ends = self._ends(at(np.tile([FAR, *gaps], (count, 1))), outputs)
        drifts = dict(zip(names, np.moveaxis(ends[:, 1:, : len(names)] / ends[:, :1, : len(names)], 2, 0)))
        found = []
        for i, gap in enumerate(gaps):
            of_gap = ends[:, i + 1]
            ratios = {side: float(max(drifts[name][:, i].max() for name in of)) for side, of in self.drifts.items()}
            of_each, forces = np.split(of_gap[:, len(names) :], 2, axis=1)
            impacts, force = of_each.sum(axis=1), float(forces.max())
            found.append(Cost(gap, int((impacts > 0).sum()), int(impacts.max()), force, ratios))
        return found


def sides_of(meeting: Mapping[str, Any]) -> list[str]:
    """The names of the buildings of a contact or a link."""
    return [meeting[end]["side"] for end in ENDS if meeting[end]["kind"] != "wall"]


def joints_of(layout: Mapping[str, Any]) -> list[Joint]:
    """What is between all neighbours, and the walls, in the order of their first contacts."""
    found: dict[tuple[str | None, str | None], list[int]] = {}
    for p, contact in enumerate(layout["contacts"], 1):
        left, right = (contact[end].get("side") for end in ENDS)
        found.setdefault((left, right), []).append(p)
    return [Joint(ends, contacts) for ends, contacts in found.items()]


def between_of(joints: Iterable[Joint], buildings: Sequence[str], names: list[str], where: str) -> Joint:
    """What is between two buildings that are named in any order."""
    missing = [name for name in names if name not in buildings]
    among = f"expected two neighbours of {', '.join(buildings)}"
    refuse([f"between: {unknown(name, buildings, 'the scene has no such building')}; {among}" for name in missing])
    places = sorted(buildings.index(name) for name in names)
    if len(places) != 2 or places[1] - places[0] != 1:
        raise ValueError(f"between = {' '.join(names)}: {among}")
    ends = tuple(buildings[place] for place in places)
    found = next((joint for joint in joints if joint.ends == ends), None)
    if found is None:
        raise ValueError(f"{where}between = {' '.join(names)}: expected a scene with a contact there")
    return found


def difference(a: float, b: float, rho: float) -> float:
    """Of two motions with this correlation, as a combination of their largest values."""
    return math.sqrt(max(a * a + b * b - 2 * rho * a * b, 0.0))


def correlation(one: tuple[float, float], other: tuple[float, float]) -> float:
    """Of the responses of two oscillators, period and damping ratio each, to white noise [Chopra2001, section 13.7]."""
    (period, ratio), (other_period, other_ratio) = one, other
    r = period / other_period
    above = 8 * math.sqrt(ratio * other_ratio) * (ratio + other_ratio * r) * r**1.5
    below = (1 - r * r) ** 2 + 4 * ratio * other_ratio * r * (1 + r * r) + 4 * (ratio**2 + other_ratio**2) * r * r
    return above / below if below else 1.0


def _motions(read: _native.Scene, where: str, records: Any, pga: list[Any] | None) -> list[Motion]:
    """Every record at every intensity, or all that is wrong with them."""
    problems = [f"pga: {peak!r}: expected a number of m/s2 > 0" for peak in pga or [] if not 0.0 < peak < math.inf]
    problems += ["pga: expected at least one"] * (pga == [])
    own = read.record()
    if records is not None:
        found = read_records(named(records), problems, pga is not None)
    else:
        problems += [f"{where}the scene has no record: expected records"] * (own is None)
        found = {own.name: own} if own else {}
        problems += [offset_of(key, record) for key, record in found.items() if pga and record.offset() is not None]
    refuse(problems)
    return [Motion(label(key), record, read, peak) for key, record in found.items() for peak in pga or [None]]
