"""Ground motions from files, and the command ``pounding-fmu record``."""

from __future__ import annotations

import argparse
import math
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from . import _native, _record_options
from ._extras import require
from ._scenes import read_record as read_native
from ._scenes import warn

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Numbers = NDArray[np.float64]

STANDARD_GRAVITY = 9.80665  # m/s2
PERIODS = (0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 4.0)  # s, of the spectrum that is printed
PICTURE_PERIODS = 100
LARGEST = 1e100  # m/s2: no ground moves like that, and much larger squares overflow
PICTURES = (".png", ".svg", ".pdf")


def read_record(
    path: str | os.PathLike[str],
    *,
    step: float | None = None,
    unit: str | None = None,
    column: int | str | None = None,
    skip_lines: int | None = None,
    remove_mean: bool | None = None,
) -> tuple[Numbers, Numbers]:
    """The times (s) and accelerations (m/s2) of a record file of any format that scenes know.

    Nothing is corrected: baseline and mean stay, unless ``remove_mean`` takes the mean of the samples away.

    Args:
        path: the file; ``"file.v2#2"`` is the second channel, or column, of one that has several, ``"file.csv#EW"`` that
            with this name.
        step: s from sample to sample, of a file without times; the first sample is at 0.
        unit: of the accelerations in it: ``m/s2``, ``cm/s2`` (``gal``), ``mm/s2``, ``g``, ``%g``, ``mg``, ``g/10``, ``ft/s2``,
            ``in/s2``.
        column: which of several, by number (from 1, that of the times counts) or name. Without it a file of many numbers
            in a line and no times is one sequence, line after line.
        skip_lines: lines above the numbers that are not read: nothing in the file counts then but numbers.
        remove_mean: whether the mean of the samples is taken away.

    What the file says itself is compared with these: a contradiction is a ``ValueError``.

    >>> import pounding_fmu
    >>> time, acceleration = read_record(pounding_fmu.example_scene.parent.parent / "records/el_centro_1940_ns.csv")
    >>> time.shape, f"{abs(acceleration).max():.3f}"
    ((1560,), '3.127')

    Raises:
        ValueError: everything that is wrong with the file, each with its line.
        OSError: the file cannot be read.
    """
    said = {"step": step, "unit": unit, "column": column, "skip_lines": skip_lines, "remove_mean": remove_mean}
    return read_native({"file": path, **said}, "record").samples()


class Motion(NamedTuple):
    """A ground motion: samples, between which the acceleration is linear."""

    time: Numbers
    acceleration: Numbers

    @property
    def duration(self) -> float:
        return float(self.time[-1] - self.time[0])

    def arias_intensity(self) -> float:
        """m/s: pi / (2 g) times the integral of the squared acceleration [Arias1970], which is exact here."""
        import numpy as np

        before, after = self.acceleration[:-1], self.acceleration[1:]
        integral = np.diff(self.time) * (before**2 + before * after + after**2) / 3
        return math.pi / (2 * STANDARD_GRAVITY) * math.fsum(integral)


def main(arguments: list[str]) -> int:
    options = parser().parse_args(arguments)
    if options.plot and options.plot.suffix.lower() not in PICTURES:
        raise ValueError(f"{options.plot}: expected a name that ends in {', '.join(PICTURES)}")
    if options.plot:
        require("matplotlib", "plot")
    _native.spare([("-o", options.output), ("--plot", options.plot)], [], [options.file])
    source = {"file": options.file, **_record_options.of(options)}
    removes_mean = source.pop("remove_mean", False)
    record = read_native(source, "record")
    removed = record.mean() if removes_mean else None
    shown = read_native(source | {"remove_mean": True}, "record") if removes_mean else record
    motion = Motion(*shown.samples())
    if (peak := float(abs(motion.acceleration).max())) > LARGEST:
        raise ValueError(f"{options.file}: acceleration {peak:g} m/s2: expected at most {LARGEST:g} m/s2")
    print(options.file)
    print("\n".join(origin(source, record)))
    print("\n".join([*described(motion, mean_of(record, removed)), "", *spectrum(motion)]))
    # The line of the mean says what is to be said about it.
    warn(f"record = {options.file!r}: {text}" for text in shown.warnings() if not text.startswith("its mean is"))
    if options.output:
        write(options.output, motion, options.file, removed)
        print(f"\n{options.output}: {len(motion.time)} samples, time_s,accel_m_s2")
    if options.plot:
        draw(options.plot, motion, os.path.basename(options.file))
        print(f"\n{options.plot}")
    return 0


def parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="pounding-fmu record", description="Shows what is in a ground motion, of any format, and converts it to CSV."
    )
    about = "the record; FILE#2 is the second channel or column of one that has several, FILE#EW that with this name"
    parser.add_argument("file", metavar="FILE", help=about)
    parser.add_argument("-o", "--output", type=Path, metavar="OUT.csv", help="writes it as CSV, in s and m/s2")
    _record_options.add(parser, "the file does")
    parser.add_argument("--plot", type=Path, metavar="FILE.png", help="draws it and its spectrum; .png, .svg or .pdf")
    return parser


def origin(source: dict[str, Any], record: _native.Record) -> list[str]:
    """What the file says of itself, a line each."""
    form, unit, about, channels = _native.Record.about(source, "record")
    lines = [("format", f"{form}, in {unit}"), *([("about", about)] if about else [])]
    lines += [("component", record.component())] if record.component() else []
    lines += [(f"channel {number}", name) for number, name in enumerate(channels, 1)]
    return [f"  {name:<12}{text}" for name, text in lines]


def described(motion: Motion, mean: str) -> list[str]:
    """What is in it, a line each."""
    import numpy as np

    time, acceleration = motion
    steps = np.diff(time)
    step = motion.duration / len(steps)
    even = bool(np.all(np.abs(steps - step) <= 1e-6 * step))
    spacing = f"every {step:.6g} s ({1 / step:.6g} Hz)" if even else f"uneven, {steps.min():.6g} s to {steps.max():.6g} s apart"
    peak, highest, lowest = (int(place) for place in (abs(acceleration).argmax(), acceleration.argmax(), acceleration.argmin()))
    lines = [
        ("samples", f"{len(time)}, {spacing}"),
        ("duration", f"{motion.duration:.6g} s, from {time[0]:.6g} s to {time[-1]:.6g} s"),
        ("peak", f"{in_both(abs(acceleration[peak]))}, at {time[peak]:.6g} s"),
        ("highest", f"{in_both(acceleration[highest])}, at {time[highest]:.6g} s"),
        ("lowest", f"{in_both(acceleration[lowest])}, at {time[lowest]:.6g} s"),
        ("mean", mean),
        ("Arias", f"intensity {motion.arias_intensity():.5g} m/s"),
    ]
    return [f"  {name:<12}{text}" for name, text in lines]


def mean_of(record: _native.Record, removed: float | None) -> str:
    if removed is not None:
        return f"{removed:.4g} m/s2 has been taken away; all numbers are of the rest"
    mean, drift = record.mean(), record.drift()
    if record.offset() is None and drift is None:
        return f"{mean:.4g} m/s2, about 0"
    left = "" if drift is None else f": it leaves the ground at {drift:.3g} m/s"
    return f"{mean:.4g} m/s2, not about 0{left}; --remove-mean takes it away"


def in_both(acceleration: float) -> str:
    return f"{acceleration:.5g} m/s2, {acceleration / STANDARD_GRAVITY:.4g} g"


def spectrum(motion: Motion) -> list[str]:
    """A table of the pseudo-spectral acceleration."""
    rows = [("period", "pseudo-spectral acceleration, 5 % damping", ""), ("s", "m/s2", "g")]
    for period in PERIODS:
        value = spectral(motion, period)
        rows.append((f"{period:g}", f"{value:.5g}", f"{value / STANDARD_GRAVITY:.4g}"))
    return [f"  {period:>6}  {value:>42}  {in_g:>8}".rstrip() for period, value, in_g in rows]


def spectral(motion: Motion, period: float) -> float:
    """m/s2; NaN where the record is too long for so short a period."""
    from .spectra import pseudo_acceleration

    try:
        return pseudo_acceleration(*motion, period)
    except ValueError:
        return math.nan


def write(output: Path, motion: Motion, source: str, removed: float | None) -> None:
    """Writes the samples so that they read back as the same numbers."""
    name = " ".join(os.path.basename(source).split())
    lines = [f"# {name}" + ("" if removed is None else f", without its mean of {removed!r} m/s2"), "time_s,accel_m_s2"]
    lines += [f"{time!r},{value!r}" for time, value in zip(motion.time.tolist(), motion.acceleration.tolist())]
    output.write_text("\n".join(lines) + "\n", encoding="utf-8", newline="\n")


def draw(picture: Path, motion: Motion, title: str) -> None:
    """Acceleration over time, and the spectrum."""
    import numpy as np

    figure = require("matplotlib.figure", "plot").Figure(figsize=(8.0, 5.6), layout="constrained")
    over_time, over_period = figure.subplots(2, 1)
    over_time.plot(*motion, color="black", linewidth=0.7)
    over_time.set(xlabel="time [s]", ylabel="acceleration [m/s²]")
    over_time.set_title(title, loc="left", wrap=True)
    periods = np.geomspace(PERIODS[0], PERIODS[-1], PICTURE_PERIODS)
    over_period.semilogx(periods, [spectral(motion, float(period)) for period in periods], color="#0072B2")
    over_period.set(xlabel="period [s]", ylabel="pseudo-spectral\nacceleration, 5 % [m/s²]", ylim=(0, None))
    over_period.set_xticks([0.05, 0.1, 0.2, 0.5, 1, 2, 4], labels=["0.05", "0.1", "0.2", "0.5", "1", "2", "4"])
    for panel in (over_time, over_period):
        panel.grid(alpha=0.3)
    figure.savefig(picture, dpi=150)
