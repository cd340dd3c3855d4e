"""Fragility: how probable it is that something exceeds a limit, against the intensity of the ground motion.

The curve is the lognormal distribution of largest likelihood [Baker2015]. There is one only where the intensities of
runs that exceed the limit overlap with those of runs that do not [AlbertAnderson1984], and the limit is exceeded more
often as the intensity grows; elsewhere there are counts, and no curve.
"""

import csv
import math
from dataclasses import dataclass

import numpy as np

from study_table import NEVER_CLOSES, SIDES

INTENSITIES = {
    "pga": ("pga_m_s2", "peak ground acceleration"),
    "left_sa": ("left_sa_m_s2", "spectral acceleration, left building"),
    "right_sa": ("right_sa_m_s2", "spectral acceleration, right building"),
}


@dataclass(frozen=True)
class Demand:
    name: str
    unit: str
    of: object  # what it is of a row
    limit: float  # exceeded if it is above
    said: str  # with its limit, for a title


@dataclass(frozen=True)
class Curve:
    """Of one demand and one gap, sorted by intensity."""

    demand: Demand
    intensity: str
    gap: float
    levels: np.ndarray  # m/s2, of each run
    exceeds: np.ndarray
    fit: tuple | None  # median, m/s2, and dispersion


def drift(row):
    return largest(row, "drift_m")


def acceleration(row):
    return largest(row, "acceleration_m_s2")


def ductility(row):
    return largest(row, "ductility")


def residual(row):
    return largest(row, "residual_drift_m")


def largest(row, what):
    """Of the buildings that have it; without any `None`."""
    return max((row[f"{side}_{what}"] for side in SIDES if row[f"{side}_{what}"] is not None), default=None)


def force(row):
    return row["peak_force_n"]


def demands(rows, limits):
    """What may be exceeded in the runs of a scene; a limit of `None` becomes a median, which shows the method."""
    closing = [row for row in rows if row["gap_m"] != NEVER_CLOSES]
    found = [Demand("pounding", "impacts", lambda row: row["impacts"], 0.0, "pounding")]
    hit = [row for row in closing if force(row) > 0]
    # All runs of a scene or none.
    yielding = [row for row in closing if ductility(row) is not None]
    asked = [
        ("force", "N", force, hit, lambda limit: f"{limit / 1e3:.3g} kN" if limit >= 1e3 else f"{limit:.3g} N"),
        ("drift", "m", drift, closing, lambda limit: f"{1e3 * limit:.3g} mm"),
        ("acceleration", "m/s2", acceleration, closing, lambda limit: f"{limit:.3g} m/s2"),
    ]
    if yielding:
        asked += [
            ("ductility", "1", ductility, yielding, lambda limit: f"{limit:.3g}"),
            ("residual drift", "m", residual, yielding, lambda limit: f"{1e3 * limit:.3g} mm"),
        ]
    for name, unit, of, among, shown in asked:
        limit = limits[name] if limits[name] is not None else median(map(of, among))
        if limit is not None:
            origin = "" if limits[name] is not None else " (median)"
            found.append(Demand(name, unit, of, limit, f"{name} above {shown(limit)}{origin}"))
    return found


def median(values):
    values = list(values)
    return float(np.median(values)) if values else None


def curves(rows, demands, intensity):
    """A curve for each demand and each gap; without contact there is no force, and no pounding."""
    column = INTENSITIES[intensity][0]
    if any(row[column] is None for row in rows):
        raise SystemExit(f"{rows[0]['scene']} has no fragility by {intensity}: it has no such building")
    found = []
    for demand in demands:
        for gap in sorted({row["gap_m"] for row in rows}):
            if gap == NEVER_CLOSES and demand.name in ("pounding", "force"):
                continue
            runs = sorted((row[column], demand.of(row) > demand.limit) for row in rows if row["gap_m"] == gap)
            levels, exceeds = map(np.array, zip(*runs))
            found.append(Curve(demand, intensity, gap, levels, exceeds, fit_lognormal(levels, exceeds)))
    return found


def write(curves, path):
    """A row per curve; `median_m_s2` and `dispersion` are empty where the likelihood has no largest value."""
    with path.open("w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow("demand,limit,unit,gap_m,intensity,runs,exceeding,median_m_s2,dispersion".split(","))
        for curve in curves:
            demand = curve.demand
            counts = len(curve.exceeds), int(curve.exceeds.sum())
            table.writerow(
                [demand.name, demand.limit, demand.unit, curve.gap, curve.intensity, *counts, *(curve.fit or ("", ""))]
            )


def lognormal(levels, median, dispersion):
    """Probability at these intensities."""
    return 0.5 * np.vectorize(math.erfc)(-np.log(levels / median) / (dispersion * math.sqrt(2.0)))


def fit_lognormal(levels, exceeds):
    """Median and dispersion of largest likelihood; `None` where there are none.

    The logarithm of the likelihood is concave in a and b of the probability Phi(a + b x), x being the logarithm of the
    intensity: Newton finds its top, with steps that are halved until they go up.
    """
    if not overlap(levels, exceeds):
        return None
    x = np.log(levels)
    middle, width = x.mean(), x.std()
    terms = np.stack([np.ones_like(x), (x - middle) / width])
    signs = np.where(exceeds, 1.0, -1.0)
    at, best = np.zeros(2), -np.inf
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
    if b <= 0:
        return None
    return math.exp(middle - width * a / b), width / b


def overlap(levels, exceeds):
    """Whether strong motions that do not exceed and weaker ones that do leave the likelihood a largest value.

    Without, any steeper curve is more likely: one level tells those that exceed from those that do not.
    """
    over, under = levels[exceeds], levels[~exceeds]
    if not len(over) or not len(under):
        return False
    return over.min() < under.max() and under.min() < over.max()


def likelihood(signs, z):
    """Logarithm of the likelihood of a probit, and its first and second derivatives by each z."""
    tail = 0.5 * np.vectorize(math.erfc)(-signs * z / math.sqrt(2.0))
    tail = np.maximum(tail, 1e-300)
    ratio = np.exp(-0.5 * z**2) / math.sqrt(2 * math.pi) / tail
    return np.log(tail).sum(), signs * ratio, -ratio * (signs * z + ratio)
