"""Fragility: how probable it is that something exceeds a limit, against the intensity of the ground motion.

The curve is the lognormal distribution of largest likelihood [Baker2015]. There is one only where the intensities of
runs that exceed the limit overlap with those of runs that do not [AlbertAnderson1984], and where the limit is exceeded
more often as the intensity grows, so much so that a constant share is ruled out at the level of 5 %: elsewhere there are
counts, and no curve. A distribution never falls; so there is none either where the share falls from one intensity to a
higher one by more than one and a half standard errors of the difference.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .cases import FACTOR, NEVER_CLOSES, SIDES, Factor, Row, collapsed, sides_of

Numbers = NDArray[np.float64]
Truths = NDArray[np.bool_]

PGA, OF_BUILDING = "pga", "_sa"
LIMITS = {"force": "N", "drift": "m", "acceleration": "m/s2", "ductility": "1", "residual drift": "m"}
MOST_POINTS = 8  # where all runs differ in intensity: shares of groups of neighbouring runs
DEFORMATIONS = ("drift", "ductility", "residual drift")  # that a building which has collapsed exceeds, whatever the limit
FALL = 1.5  # standard errors
RISE = 3.84  # of twice the logarithm of a likelihood ratio: 95 % of chi-squared with one degree of freedom


@dataclass(frozen=True)
class Demand:
    """What may be exceeded."""

    name: str
    unit: str
    of: Callable[[Row], float | None]
    limit: float
    """exceeded if it is above"""
    said: str
    """with its limit, for a title"""


@dataclass(frozen=True)
class Curve:
    """Of one scene, demand and gap, sorted by intensity."""

    scene: str
    demand: Demand
    intensity: str
    gap: float
    """m, or a factor on those of the scene"""
    levels: Numbers
    """m/s2, of each run"""
    exceeds: Truths
    fit: tuple[float, float] | None
    """median, m/s2, and dispersion"""

    @property
    def falls(self) -> bool:
        """Whether the limit is exceeded less often in stronger motions."""
        return falls(self.levels, self.exceeds)

    @property
    def is_extrapolated(self) -> bool:
        """Whether the median is beyond all intensities of the study."""
        return self.fit is not None and not self.levels[0] <= self.fit[0] <= self.levels[-1]


def intensity_of(name: str) -> tuple[str, str]:
    """The column of an intensity, and what it is called: `pga`, or `corner_sa` of the building corner."""
    if name == PGA:
        return "pga_m_s2", "peak ground acceleration"
    side = name.removesuffix(OF_BUILDING)
    return f"{side}_sa_m_s2", f"spectral acceleration, {side}" + " building" * (side in SIDES)


def largest(what: str, sides: Iterable[str]) -> Callable[[Row], float | None]:
    """Of the buildings that have it; without any `None`."""
    names = [f"{side}_{what}" for side in sides]
    return lambda row: max((row[name] for name in names if row.get(name) is not None), default=None)


def of_buildings(sides: Sequence[str]) -> dict[str, Callable[[Row], float | None]]:
    """What may exceed a limit, of all contacts and of the building that has most of it."""
    return {
        "force": lambda row: float(row["peak_force_n"]),
        "drift": largest("drift_m", sides),
        "acceleration": largest("acceleration_m_s2", sides),
        "ductility": largest("ductility", sides),
        "residual drift": largest("residual_drift_m", sides),
    }


def demands(rows: Iterable[Row], limits: Mapping[str, float | None]) -> list[Demand]:
    """What may be exceeded in the runs of a scene; a limit that is not given is a median, which shows the method. Runs that
    collapse are no part of it."""
    rows = list(rows)
    closing = [row for row in rows if row["gap_m"] != NEVER_CLOSES and not collapsed(row)]
    found = [Demand("pounding", "impacts", lambda row: row["impacts"], 0.0, "pounding")]
    sides = sides_of(rows[0]) if rows else list(SIDES)
    if any(row.get(f"{side}_collapsed") is not None for row in rows for side in sides):
        found.append(Demand("collapse", "collapses", lambda row: float(collapsed(row)), 0.0, "collapse"))
    for name, of in of_buildings(sides).items():
        # A force of 0 says that there was no contact; ductilities are those of all runs of a scene, or of none.
        values = [value for row in closing if (value := of(row)) is not None and (value > 0 or name != "force")]
        limit = limits.get(name)
        if not values and (limit is None or name not in ("force", "drift", "acceleration")):
            continue
        origin = " (median)" if limit is None else ""
        limit = float(np.median(values)) if limit is None else limit
        found.append(Demand(name, LIMITS[name], of, limit, f"{name} above {shown(limit, LIMITS[name])}{origin}"))
    return found


def force_unit(largest: float) -> tuple[float, str]:
    """What to divide forces by, and the unit they are in then."""
    return next((unit for unit in [(1e6, "MN"), (1e3, "kN")] if largest >= unit[0]), (1.0, "N"))


def shown(limit: float, unit: str) -> str:
    """A limit in the unit in which people say it."""
    if unit == "m":
        return f"{1e3 * limit:.3g} mm"
    if unit == "N":
        factor, of_force = force_unit(limit)
        return f"{limit / factor:.3g} {of_force}"
    return f"{limit:.3g}" + f" {unit}" * (unit != "1")


def curves(rows: Sequence[Row], demands: Iterable[Demand], intensity: str) -> list[Curve]:
    """A curve for each demand and each gap; without contact there is no force, and no pounding."""
    column = intensity_of(intensity)[0]
    if any(row.get(column) is None for row in rows):
        raise ValueError(f"{rows[0]['scene']} has no fragility by {intensity}: it has no such building")
    found = []
    for demand in demands:
        for gap in sorted({row["gap_m"] for row in rows}):
            if gap == NEVER_CLOSES and demand.name in ("pounding", "force"):
                continue
            of_gap = [row for row in rows if row["gap_m"] == gap]
            runs = sorted((row[column], exceeds(demand, row)) for row in of_gap)
            levels, above = (np.array(values) for values in zip(*runs))
            found.append(Curve(rows[0]["scene"], demand, intensity, gap, levels, above, fit_lognormal(levels, above)))
    return found


def exceeds(demand: Demand, row: Row) -> bool:
    if demand.name in DEFORMATIONS and collapsed(row):
        return True
    return (demand.of(row) or 0.0) > demand.limit


def write(curves: Iterable[Curve], path: Path) -> None:
    """A row per curve; `median_m_s2` and what follows are empty where there is no curve. A factor on gaps has a column of its
    own name in place of the gap, in which the run without contact is that with a gap of 1000, too."""
    every = list(curves)
    width = FACTOR if any(isinstance(curve.gap, Factor) for curve in every) else "gap_m"
    with path.open("w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(f"demand,limit,unit,{width},intensity,runs,exceeding,median_m_s2,dispersion,extrapolated".split(","))
        for curve in every:
            demand = curve.demand
            counts = len(curve.exceeds), int(curve.exceeds.sum())
            fit = (*curve.fit, int(curve.is_extrapolated)) if curve.fit else ("", "", "")
            table.writerow([demand.name, demand.limit, demand.unit, curve.gap, curve.intensity, *counts, *fit])


def points(levels: Numbers, exceeds: Truths) -> tuple[Numbers, Numbers, Numbers]:
    """Intensities, the share that exceeds there, and of how many runs: of each intensity, or of neighbours where there
    are too many."""
    distinct, first = np.unique(levels, return_index=True)
    places = first[1:] if len(distinct) <= 2 * MOST_POINTS else MOST_POINTS
    parts = list(zip(np.array_split(levels, places), np.array_split(exceeds, places)))
    middles, shares = [float(np.median(of)) for of, _ in parts], [float(share.mean()) for _, share in parts]
    return np.array(middles), np.array(shares), np.array([float(len(of)) for of, _ in parts])


def falls(levels: Numbers, exceeds: Truths) -> bool:
    """Whether the share falls from one point to any further one by more than chance explains.

    The standard error of the difference of two shares is that of their common share.
    """
    _, shares, counts = points(levels, exceeds)
    drop = shares[:, None] - shares[None, :]
    both = counts[:, None] + counts[None, :]
    common = (shares * counts)[:, None] / both + (shares * counts)[None, :] / both
    error = np.sqrt(common * (1 - common) * (1 / counts[:, None] + 1 / counts[None, :]))
    return bool(np.any(np.triu(drop > FALL * error, 1)))


def lognormal(levels: Numbers, median: float, dispersion: float) -> Numbers:
    """Probability at these intensities."""
    return 0.5 * erfc(-np.log(levels / median) / (dispersion * math.sqrt(2.0)))


def erfc(values: Numbers) -> Numbers:
    return np.array([math.erfc(value) for value in values])


def fit_lognormal(levels: Numbers, exceeds: Truths) -> tuple[float, float] | None:
    """Median and dispersion of largest likelihood; `None` where there are none.

    The logarithm of the likelihood is concave in a and b of the probability Phi(a + b x), x being the logarithm of the
    intensity: Newton finds its top, with steps that are halved until they go up.
    """
    if not overlap(levels, exceeds) or falls(levels, exceeds):
        return None
    x = np.log(levels)
    middle, width = x.mean(), x.std()
    terms = np.stack([np.ones_like(x), (x - middle) / width])
    signs = np.where(exceeds, 1.0, -1.0)
    at, best = np.zeros(2), -math.inf
    for _ in range(200):
        top, slope, curvature = likelihood(signs, at @ terms)
        gradient, hessian = terms @ slope, (terms * curvature) @ terms.T
        step = -np.linalg.solve(hessian, gradient)
        while likelihood(signs, (at + step) @ terms)[0] < top and np.abs(step).max() > 1e-14:
            step /= 2
        at, before, best = at + step, best, top
        if best - before <= 1e-13 * abs(best) and np.abs(step).max() < 1e-9:
            break
    a, b = at
    share = float(exceeds.mean())
    constant = len(exceeds) * (share * math.log(share) + (1 - share) * math.log(1 - share))
    if b <= 0 or 2 * (best - constant) < RISE:
        return None
    return math.exp(middle - width * a / b), float(width / b)


def overlap(levels: Numbers, exceeds: Truths) -> bool:
    """Whether strong motions that do not exceed and weaker ones that do leave the likelihood a largest value.

    Without, any steeper curve is more likely: one level tells those that exceed from those that do not.
    """
    over, under = levels[exceeds], levels[~exceeds]
    if not len(over) or not len(under):
        return False
    return bool(over.min() < under.max() and under.min() < over.max())


def likelihood(signs: Numbers, z: Numbers) -> tuple[float, Numbers, Numbers]:
    """Logarithm of the likelihood of a probit, and its first and second derivatives by each z."""
    tail = 0.5 * erfc(-signs * z / math.sqrt(2.0))
    tail = np.maximum(tail, 1e-300)
    ratio = np.exp(-0.5 * z**2) / math.sqrt(2 * math.pi) / tail
    return float(np.log(tail).sum()), signs * ratio, -ratio * (signs * z + ratio)
