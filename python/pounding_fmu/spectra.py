"""Spectral acceleration of a ground motion: how hard it shakes an oscillator of one period."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.float64]
Complex = NDArray[np.complex128]

DAMPING_RATIO = 0.05  # the usual one of response spectra, whatever damping a building has
PIECES = 64  # of a period: no peak between two of them is more than 0.2 % above the higher one
NEAR = 0.99  # of the largest: which of them may have the peak beside them
MOST_PIECES = 20_000_000


def pseudo_acceleration(
    times: Numbers, accelerations: Numbers, period: float, ratio: float = DAMPING_RATIO
) -> float:
    """m/s2: w^2 times the largest displacement of the oscillator, in the record (s, m/s2) and in the period after it.

    The displacement is Im(y)/wd, where y' = r y - ground acceleration with the root r = -ratio w + i wd. Between two
    samples the acceleration is linear, so y is known there in closed form [NigamJennings1969], and its largest value is
    found in continuous time.
    """
    circular = 2 * math.pi / period
    root = circular * complex(-ratio, math.sqrt(1 - ratio**2))
    # After the record the ground stands still.
    lengths = np.append(np.diff(times), period)
    slopes = np.append(np.diff(accelerations) / np.diff(times), 0.0)
    ground = np.append(accelerations[:-1], 0.0)
    line = Line(root, ground / root + slopes / root**2, slopes / root)
    pieces = np.ceil(lengths * (PIECES / period)).astype(int)
    if not pieces.sum() <= MOST_PIECES:
        raise ValueError(f"a record of {times[-1] - times[0]:g} s is too long for a period of {period:g} s")
    line.free = starts(line, lengths) - line.rest
    segment = np.repeat(np.arange(len(pieces)), pieces)
    counted = np.arange(len(segment)) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    time = (counted + 1) / pieces[segment] * lengths[segment]
    sampled = np.abs(line.displacement(segment, time))
    near = sampled >= NEAR * sampled.max()
    segment, time = segment[near], time[near]
    for _ in range(6):
        time = np.clip(time - line.to_rest(segment, time), 0.0, lengths[segment])
    return float(circular**2 * max(sampled.max(), np.abs(line.displacement(segment, time)).max()))


class Line:
    """y in segments of linear ground acceleration: free e^(r t) + rest + drift t."""

    def __init__(self, root: complex, rest: Complex, drift: Complex) -> None:
        self.root, self.rest, self.drift = root, rest, drift
        self.free: Complex = np.zeros_like(rest)

    def displacement(self, segment: NDArray[np.intp], time: Numbers) -> Numbers:
        y = self.free[segment] * np.exp(self.root * time) + self.rest[segment] + self.drift[segment] * time
        displacement: Numbers = y.imag / self.root.imag
        return displacement

    def to_rest(self, segment: NDArray[np.intp], time: Numbers) -> Numbers:
        """How long the velocity has been 0, by Newton; at most a piece."""
        change = self.root * self.free[segment] * np.exp(self.root * time)
        velocity, acceleration = (change + self.drift[segment]).imag, (self.root * change).imag
        piece = 2 * math.pi / abs(self.root) / PIECES
        known = np.where(acceleration == 0, 1.0, acceleration)
        return np.clip(np.where(acceleration == 0, 0.0, velocity / known), -piece, piece)


def starts(line: Line, lengths: Numbers) -> Complex:
    """y at the beginning of each segment, from rest."""
    decays = np.exp(line.root * lengths)
    gains = line.rest * (1 - decays) + line.drift * lengths
    # What comes after one segment, after two, four and so on: decay and gain of neighbours put together.
    reach = 1
    while reach < len(gains):
        gains[reach:] += decays[reach:] * gains[:-reach]
        decays[reach:] *= decays[:-reach]
        reach *= 2
    return np.append(0j, gains[:-1])
