"""Solvers of others and ours, each as a class with `setup` (s) and `run(warm_up)`.

A run integrates the whole record once, and is timed; with `warm_up` the fast ones do so twice, and the second is timed.
The first run of a program, or of a solver that has just been made ready, is cold: its code and its memory are new to the
processor.
"""

from dataclasses import dataclass, field

import numpy as np

OUTPUT_STEP = 0.05  # s, at which displacements are compared


@dataclass
class Outcome:
    """Wall time of the integration alone, displacements in rows every OUTPUT_STEP, impacts (None: not counted)."""

    seconds: float
    displacements: np.ndarray
    impacts: int | None
    counters: dict = field(default_factory=dict)
    cold: float | None = None  # s, of a first run before this one
