"""The synthetic ground motion of the benchmark: eight sinusoids under an envelope, 20 s, peak 0.6 g."""

from pathlib import Path

import numpy as np

STANDARD_GRAVITY = 9.80665  # m/s2
PEAK = 0.6 * STANDARD_GRAVITY
DURATION = 20.0  # s
FREQUENCIES = [0.35, 0.62, 0.95, 1.43, 2.1, 3.25, 4.9, 7.4]  # Hz
AMPLITUDES = [0.45, 0.7, 1.0, 0.95, 0.8, 0.6, 0.4, 0.25]
PHASES = [0.3, 1.7, 4.1, 2.2, 5.6, 0.9, 3.4, 1.1]  # rad
STRONGEST = 3.0  # s, where the strong part of the envelope has its peak


def acceleration(time):
    """m/s2, not yet scaled to the peak."""
    x = time / STRONGEST
    envelope = 0.7 * x**2 * np.exp(2.0 - 2.0 * x) + 0.3 * np.sin(np.pi * time / DURATION) ** 2
    waves = zip(FREQUENCIES, AMPLITUDES, PHASES)
    return envelope * sum(a * np.sin(2.0 * np.pi * f * time + phase) for f, a, phase in waves)


def write(path: Path, step=0.01, duration=DURATION):
    """Samples every `step` s as a record file. Longer durations repeat the motion."""
    count = round(duration / step)
    time = np.arange(count + 1) * step
    sampled = acceleration(np.where(time > DURATION, np.fmod(time, DURATION), time))
    # The largest sample at 0.01 s is the peak, however finely the same motion is sampled.
    scale = PEAK / np.abs(acceleration(np.arange(2001) * 0.01)).max()
    rows = [f"{float(t)!r},{float(a)!r}" for t, a in zip(np.round(time, 9), scale * sampled)]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join([f"# synthetic: {__doc__.split(': ')[1]}", "time_s,accel_m_s2", *rows, ""]))
