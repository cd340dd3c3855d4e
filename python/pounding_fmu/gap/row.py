"""The gaps that each two neighbours of a row need, so that they do not meet if no other buildings do.

As long as nothing meets, buildings move as they do alone. So one run without contact has what all gaps need: the largest
approach of each pair of floors, and of each floor to a wall. Its rows are close, and between two of them it is the top of the
cubic through displacements and velocities; another run, with all of these gaps at once, shows in continuous time that nothing
meets. Where something does, the gap is searched for as that of two buildings.
"""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from .._scenes import SceneWarning
from .._single import simulate
from .search import FAR, SHARES, TOLERANCE, Cost, Joint, Motion, RequiredGap, Search

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Numbers = NDArray[np.float64]

STEP = 1e-3  # s, from row to row
MOST_CELLS = 2e7  # numbers of a run
STILL = 1e-9  # of the largest displacement: what comes no nearer than this needs no gap
RATES = {"displacement": "velocity", "rotation": "rotation_rate"}


class RowSearch(Search):
    """Runs of a row of buildings: each gap by itself, or for a force one factor on all of them."""

    def run(self) -> list[RequiredGap]:
        """For each ground motion the gap between all neighbours, one after the other, and what rules say."""
        import numpy as np

        free = [self._alone(motion) for motion in self.motions]
        reached = np.array([near for near, _ in free])
        ends = [of for _, of in free]
        rules = [[self._rules(of, joint.contacts) for joint in self.joints] for of in ends]
        widest = np.array([[rule["absolute_sum"] for rule in of] for of in rules], dtype=float) * (1 + 1e-9)
        nearest = np.array([[max(of[p - 1] for p in joint.contacts) for joint in self.joints] for of in reached])
        needed = self._checked(np.where(nearest > STILL * widest, nearest + TOLERANCE / 2, 0.0), widest)
        found = []
        for i, motion in enumerate(self.motions):
            for j, joint in enumerate(self.joints):
                gap = float(needed[i, j])
                first = max(joint.contacts, key=lambda p: float(reached[i][p - 1])) if gap > 0 else None
                fallen = self._collapsed([ends[i][name] for name in self.falls])
                more: dict[str, Any] = {**rules[i][j], "collapsed": fallen, "between": joint.name}
                found.append(RequiredGap(motion.name, motion.pga, gap, first, **more))
        return found if self.force is None else self._with_forces(found, needed, self.force)

    def more_problems(self) -> list[str]:
        """A factor opens no gap that is closed."""
        if self.force is None:
            return []
        gaps = {p: self.layout["contacts"][p - 1]["gap"] for p in self.contacts}
        return [f"contact[{p}].gap = {gap!r}: expected a gap > 0, which a factor makes wider" for p, gap in gaps.items() if gap <= 0]

    def _alone(self, motion: Motion) -> tuple[list[float], dict[str, float]]:
        """Without contact: how near the sides of each contact come, m, and the values of peaks and collapses at the end."""
        contacts = [self.layout["contacts"][p - 1] for p in self.contacts]
        # As many at a time as memory holds with all their rows: a contact has up to six columns.
        at_once = max(1, int(MOST_CELLS / 6 * STEP / motion.stop))
        near: list[float] = []
        ends: dict[str, float] = {}
        for start in range(0, len(contacts), at_once):
            some = contacts[start : start + at_once]
            places = {(side, name) for contact in some for side, name, _ in contact["row"]}
            moves = [f"{side}.{of}" for side, name in sorted(places) for of in (name, rate_of(name))]
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", SceneWarning)
                outputs, scale = [*moves, *self.peaks, *self.falls], {"ground.scale": motion.scale}
                step = min(STEP, motion.stop)
                run = simulate(self.scene, step, motion.stop, outputs, scale, motion.samples, without_contacts=True)
            near += [approach(run, contact) for contact in some]
            ends = {name: float(run[name][-1]) for name in (*self.peaks, *self.falls)}
        self.done += 1
        self._tell(0, 0)
        return near, ends

    def _checked(self, needed: Numbers, widest: Numbers) -> Numbers:
        """These gaps, or where something meets with them the least with which those two do not."""
        import numpy as np

        impacts = [f"contact[{p}].impacts" for p in self.contacts]
        for _ in self.joints:
            met = self._ends(self._of_joints(needed[:, None, :]), impacts)[:, 0] > 0
            meets = np.array([[any(of[p - 1] for p in joint.contacts) for joint in self.joints] for of in met])
            if not meets.any():
                break
            for j in np.flatnonzero(meets.any(axis=0)):
                high = np.where(meets[:, j], np.maximum(widest[:, j], needed[:, j]), needed[:, j])
                needed[:, j] = self._enclose(needed[:, j], high, lambda gaps, j=j: self._meets(self.joints[j], gaps))  # type: ignore[misc]
        return needed

    def _meets(self, joint: Joint, gaps: Numbers) -> NDArray[np.bool_]:
        """Whether these two meet with such a gap, all others being apart."""
        import numpy as np

        every = dict.fromkeys(self.contacts, np.full(gaps.shape, FAR)) | dict.fromkeys(joint.contacts, gaps)
        met: NDArray[np.bool_] = self._ends(every, [f"contact[{p}].impacts" for p in joint.contacts]).max(axis=2) > 0
        return met

    def _of_joints(self, gaps: Numbers) -> dict[int, Numbers]:
        """By contacts, of gaps whose last index is that of a joint."""
        return {p: gaps[..., j] for j, joint in enumerate(self.joints) for p in joint.contacts}

    def _with_forces(self, found: Sequence[RequiredGap], needed: Numbers, limit: float) -> list[RequiredGap]:
        """With the factor on the gaps of the scene from which on no force is larger than the limit."""
        import numpy as np

        own = {p: float(self.layout["contacts"][p - 1]["gap"]) for p in self.contacts}
        least = np.array([min(own[p] for p in joint.contacts) for joint in self.joints])
        factors = (needed / least).max(axis=1)
        tolerance = TOLERANCE / max(own.values())
        forces = self._forces(factors, limit, lambda factors: {p: gap * factors for p, gap in own.items()}, tolerance)
        rows = []
        for i, of in enumerate(forces):
            for j, gap in enumerate(least.tolist()):
                at = {"force_gap": gap * of["force_gap"], "hardest_gap": gap * of["hardest_gap"]}
                row = found[i * len(self.joints) + j]
                rows.append(replace(row, **at, hardest_force=of["hardest_force"], force_factor=of["force_gap"]))
        return rows

    def costs_of(self, rows: Sequence[RequiredGap]) -> list[Cost]:
        """What shares of all gaps that are needed cost."""
        import numpy as np

        widest = np.array([max(row.gap for row in rows[j :: len(self.joints)]) for j in range(len(self.joints))])
        if widest.max() <= 0:
            return []

        def at(shares: Numbers) -> dict[int, Numbers]:
            return self._of_joints(np.where(shares[..., None] == FAR, FAR, shares[..., None] * widest))

        return self._costs(SHARES, at)

    def _planned(self) -> int:
        """Runs until all is found, about."""
        return len(self.motions) * (2 if self.force is None else 2 + super()._planned() // len(self.motions))


def rate_of(name: str) -> str:
    """The variable that is the rate of a displacement or a rotation."""
    for quantity, rate in RATES.items():
        if quantity in name:
            return name.replace(quantity, rate)
    raise ValueError(name)


def approach(run: Mapping[str, Numbers], contact: Mapping[str, Any]) -> float:
    """m, how much nearer both sides of a contact come than they are at rest, at most."""
    near: Numbers = sum(weight * run[f"{side}.{name}"] for side, name, weight in contact["row"])
    rate: Numbers = sum(weight * run[f"{side}.{rate_of(name)}"] for side, name, weight in contact["row"])
    return largest(run["time"], near, rate)


def largest(time: Numbers, value: Numbers, rate: Numbers) -> float:
    """The largest value of cubics through values and rates."""
    import numpy as np

    turns = np.flatnonzero((rate[:-1] > 0) & (rate[1:] <= 0))
    step = time[turns + 1] - time[turns]
    low, high, up, down = value[turns], value[turns + 1], step * rate[turns], step * rate[turns + 1]
    # Slope a s^2 + b s + up over the share s of a step; its root from + to -.
    a, b = 6 * (low - high) + 3 * (up + down), 6 * (high - low) - 4 * up - 2 * down
    s = 2 * up / (np.sqrt(np.maximum(b * b - 4 * a * up, 0.0)) - b)
    t = 1 - s
    tops = low * t * t * (1 + 2 * s) + high * s * s * (1 + 2 * t) + up * s * t * t - down * s * s * t
    return float(max(value.max(), tops.max(initial=-np.inf)))
