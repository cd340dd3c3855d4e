"""Synthetic ground motions: filtered white noise under an envelope, written as record files that say what they are.

Each motion is a sum of cosines with random phases [ShinozukaDeodatis1991] whose spectrum is that of white noise after
the soil as an oscillator [Kanai1957], [Tajimi1960], without the lowest frequencies [CloughPenzien1975], times an
envelope that rises, stays and decays [Jennings1968]. They are no recordings, and no site's: a study that decides about
a building takes records chosen for its site.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.float64]

SOIL = (15.6, 0.6)  # rad/s and damping ratio of the soil: firm ground
HIGH_PASS = (1.5, 0.6)  # rad/s and damping ratio: below, the soil alone would leave a displacement that grows
STRONG = (2.5, 10.0)  # s: the envelope rises until the first, stays until the second
DECAY = 0.35  # 1/s after that
DURATION, STEP, PEAK = 20.0, 0.01, 3.0  # s, s, m/s2
FREQUENCIES = np.arange(1, 1001) / (2.0 * DURATION)  # Hz, up to 25


def spectrum(frequency: Numbers) -> Numbers:
    """Power of the ground acceleration over frequency, of any scale."""
    soil, high_pass = ((2 * np.pi * frequency / own, ratio) for own, ratio in (SOIL, HIGH_PASS))

    def denominator(r: Numbers, ratio: float) -> Numbers:
        return (1 - r**2) ** 2 + (2 * ratio * r) ** 2

    transmitted = (1 + (2 * soil[1] * soil[0]) ** 2) / denominator(*soil)
    return transmitted * high_pass[0] ** 4 / denominator(*high_pass)


def envelope(time: Numbers) -> Numbers:
    rise, decay = np.minimum(1.0, (time / STRONG[0]) ** 2), np.exp(-DECAY * np.maximum(0.0, time - STRONG[1]))
    return rise * decay


def acceleration(seed: int) -> tuple[Numbers, Numbers]:
    """Times, s, and accelerations, m/s2, with a peak of `PEAK`; the same seed gives the same motion."""
    time: Numbers = np.multiply(np.arange(round(DURATION / STEP) + 1), STEP, dtype=np.float64)
    phases = np.random.default_rng(seed).uniform(0, 2 * np.pi, len(FREQUENCIES))
    # The sum of cosines as a Fourier transform, of twice the duration: it repeats after that.
    amplitudes = np.concatenate([[0.0], np.sqrt(spectrum(FREQUENCIES)) * np.exp(1j * phases)])
    motion: Numbers = envelope(time) * np.fft.irfft(amplitudes, round(2 * DURATION / STEP))[: len(time)]
    return time, PEAK * motion / np.abs(motion).max()


def write(folder: Path, seed: int) -> Path:
    """Writes the motion of a seed as a record and returns its path."""
    path = Path(folder, f"synthetic_{seed:04d}.csv")
    path.parent.mkdir(parents=True, exist_ok=True)
    lines = [
        "# SYNTHETIC, no recording: filtered noise (Kanai-Tajimi with the Clough-Penzien high-pass)",
        f"# seed {seed}; soil {SOIL[0]} rad/s, damping ratio {SOIL[1]}; high-pass {HIGH_PASS[0]} rad/s, {HIGH_PASS[1]}",
        "time_s,accel_m_s2",
        *(f"{time:.2f},{value:.6f}" for time, value in zip(*acceleration(seed))),
    ]
    path.write_text("\n".join(lines) + "\n")
    return path
