"""The command ``pounding-fmu study``."""

from __future__ import annotations

import argparse
import importlib.util
import os
import signal
from collections.abc import Sequence
from pathlib import Path

from .. import _native, _record_options, _terminal
from .._data import DATA
from .._scenes import buildings
from . import GAPS, PGA, SYNTHETIC, Study, run_study
from .cases import Row, by_width, collapsed, varied_values
from .fragility import LIMITS, OF_BUILDING, curves, demands, write
from .fragility import PGA as PGA_NAME

MOST_SHOWN = 7  # lines that can be told apart

ABOUT = """\
Gap width against peak force and drift, over many scenes, records and intensities.

Every case sets its gap (of all contacts, or by --gap-factors those of the scene), its record, the peak ground acceleration and what --vary names. Each case
runs a second time with a gap that never closes, for comparison. Results are in results.csv of the output folder, a row
per case; a study that was stopped goes on from there with the same command. At the end come results.parquet, where
pyarrow is installed, the parameters of the fragility curves, and pictures, where matplotlib is: what the gap does,
fragility curves, what the parameter does that --vary names first, and of a row of buildings its ends beside its middle.
"""
EXAMPLE = """\
examples:
  pounding-fmu study SCENE.toml --records A.AT2 B.csv --gaps 0.01 0.03 0.1 --pga 1 2 4 -o office
  pounding-fmu study SCENE.toml --vary 'link[*].dashpot=3e5,1e6,3e6' --gaps 0.03"""


def main(argv: Sequence[str] | None = None) -> int:
    """Does what the arguments say and returns the exit code."""
    options = arguments(argv)
    try:
        draw(run(options), options)
    except KeyboardInterrupt:
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        _terminal.say("\nstopped; the same command goes on from here")
        return _terminal.INTERRUPTED
    return 0


class Progress(_terminal.Progress):
    """Of a study, which may go on from one that was stopped: what is told first was done before."""

    is_begun = False

    def __call__(self, done: int, total: int) -> None:
        if not self.is_begun:
            self.is_begun = True
            self.go_on_from(done, total)
        super().__call__(done, total)


def run(options: argparse.Namespace) -> Study:
    """Runs the study and says where it is."""
    progress = Progress("cases")
    check_intensity(options)
    study = run_study(
        options.scenes,
        _record_options.with_options(options.records, options),
        gaps=options.gaps,
        gap_factors=options.gap_factors,
        pga=options.pga,
        synthetic=options.synthetic,
        seed=options.seed,
        stop=options.stop,
        vary=vary(options),
        output=options.output,
        scheduler=options.scheduler,
        workers=options.workers,
        progress=progress,
    )
    progress.end()
    if study.failures:
        _terminal.say(f"{len(study.failures)} cases failed: see the last column of {study.path}")
    fallen = sum(collapsed(row) for row in study.rows)
    if fallen:
        _terminal.say(f"{fallen} of {len(study.rows)} cases end by a collapse")
    print(study.path)
    return study


def check_intensity(options: argparse.Namespace) -> None:
    """Refuses that of a building which none of the scenes has, before all cases are run."""
    if options.intensity == PGA_NAME:
        return
    known = [name for scene in options.scenes for name in buildings(scene)]
    if options.intensity.removesuffix(OF_BUILDING) not in known:
        among = ", ".join([PGA_NAME, *(f"{name}{OF_BUILDING}" for name in dict.fromkeys(known))])
        raise ValueError(f"intensity = {options.intensity}: expected one of {among}")


def draw(study: Study, options: argparse.Namespace) -> None:
    """Fragility and pictures of every scene, and of every choice of what was varied, in the folder of the table."""
    for scene in study.scenes:
        of_scene = by_width([row for row in study.rows if row["scene"] == scene])
        for number, varied in enumerate(dict.fromkeys(row["varied"] for row in of_scene), 1):
            rows = [row for row in of_scene if row["varied"] == varied]
            named = [{**row, "scene": f"{scene}, {varied}"} for row in rows] if varied else rows
            draw_rows(named, f"{scene}_{number}" if varied else scene, options)
        if vary(options) and of_scene:
            draw_varied(of_scene, scene, options)


def draw_varied(rows: Sequence[Row], scene: str, options: argparse.Namespace) -> None:
    """What the parameter does that was named first; a picture for each choice of the others."""
    if importlib.util.find_spec("matplotlib") is None:
        return
    from . import pictures

    first = next(iter(vary(options)))
    others: dict[str, list[Row]] = {}
    for row in rows:
        values = varied_values(row["varied"])
        others.setdefault(", ".join(f"{name}={values[name]:g}" for name in values if name != first), []).append(row)
    for number, (rest, group) in enumerate(others.items(), 1):
        path = place(options, f"varied_{scene}_{number}.png" if rest else f"varied_{scene}.png")
        pictures.varied(group, first, f"{scene}, {rest}" if rest else scene, path, (options.show_gaps, options.show_pga))


def draw_rows(rows: Sequence[Row], name: str, options: argparse.Namespace) -> None:
    """Fragility and pictures of rows that differ in gap, record and intensity, in files of this name."""
    limits = {name: getattr(options, f"{name.replace(' ', '_')}_limit") for name in LIMITS}
    found = curves(rows, demands(rows, limits), options.intensity)
    write(found, place(options, f"fragility_{name}.csv"))
    if importlib.util.find_spec("matplotlib") is None:
        _terminal.say('no pictures without matplotlib: pip install "pounding-fmu[plot]"')
        return
    from . import pictures

    records = len({row["record_id"] for row in rows})
    pictures.gaps(rows, place(options, f"gaps_{name}.png"), options.show_pga)
    pictures.row(rows, place(options, f"row_{name}.png"), (options.show_gaps, options.show_pga))
    pictures.fragility(found, records, place(options, f"fragility_{name}.png"), options.show_gaps)


def place(options: argparse.Namespace, name: str) -> Path:
    """Where a file of the study goes, which is none that it reads."""
    path: Path = options.output / name
    _native.spare([("the table", options.output / "results.csv"), ("-o", path)], options.scenes, options.records or [])
    return path


def vary(options: argparse.Namespace) -> dict[str, list[float]]:
    """Parameters and values of all --vary; of a name given twice both."""
    found: dict[str, list[float]] = {}
    for name, values in options.vary:
        found.setdefault(name, []).extend(values)
    return found


def axis(text: str) -> tuple[str, list[float]]:
    """What --vary says: NAME=VALUE,VALUE."""
    name, _, values = text.partition("=")
    try:
        return name.strip(), [float(value) for value in values.split(",")]
    except ValueError:
        wanted = "expected NAME=VALUE,VALUE such as link[*].dashpot=3e5,1e6"
        raise argparse.ArgumentTypeError(f"{text!r}: {wanted}") from None


def arguments(argv: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="pounding-fmu study",
        description=ABOUT,
        epilog=EXAMPLE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    feup = DATA / "scenes" / "feup.toml"
    parser.add_argument("scenes", nargs="*", default=[feup], metavar="SCENE.toml", help="default: the laboratory frames")
    parser.add_argument("--records", nargs="+", metavar="FILE", help="ground motions, instead of the usual ones")
    _record_options.add(parser, "the files of --records do")
    add_numbers(parser, "--gaps", "M", f"m, of all contacts (default: {' '.join(f'{gap:g}' for gap in GAPS)})")
    add_numbers(parser, "--gap-factors", "X", "by which all gaps of the scene are multiplied, in place of --gaps")
    add_numbers(parser, "--pga", "A", f"m/s2 (default: {' '.join(f'{peak:g}' for peak in PGA)})", PGA)
    about = "values of another parameter of the scene by its FMU name, * for any number, *.NAME for any building; may be given several times"
    parser.add_argument("--vary", action="append", type=axis, default=[], metavar="NAME=VALUES", help=about)
    parser.add_argument("-o", "--output", type=Path, default=Path("study"), metavar="FOLDER", help="default: %(default)s")
    parser.add_argument("--stop", type=float, metavar="S", help="s, end of each run; default: end of record or stop_time")
    parser.add_argument(
        "--synthetic", type=int, default=SYNTHETIC, metavar="N", help="synthetic motions (default: %(default)s)"
    )
    parser.add_argument("--seed", type=int, default=1, help="of the first of them")
    parser.add_argument("--workers", type=int, default=os.cpu_count(), metavar="N", help="threads (default: all cores)")
    parser.add_argument("--scheduler", metavar="ADDRESS", help="tcp://HOST:PORT of a Dask cluster, or local for one here")
    pictures = parser.add_argument_group("fragility and pictures")
    for name, unit in LIMITS.items():
        pictures.add_argument(
            f"--{name.replace(' ', '-')}-limit", type=float, metavar=unit.upper()[:1], help=f"{unit}; default: the median"
        )
    pictures.add_argument(
        "--intensity",
        default=PGA_NAME,
        metavar="NAME",
        help="what the fragility is drawn against: pga, the peak ground acceleration (default), or left_sa, right_sa, the "
        "spectral acceleration at the first period of that building",
    )
    add_numbers(pictures, "--show-gaps", "M", "m, those of fragility curves; default: five of them")
    add_numbers(pictures, "--show-pga", "A", "m/s2, those of curves over the gap; default: five of them")
    options = parser.parse_args(argv)
    if options.gaps is not None and options.gap_factors is not None:
        parser.error("--gaps and --gap-factors: expected one of them")
    widths = options.gap_factors or options.gaps or GAPS
    for name, of_study in (("gaps", widths), ("pga", options.pga)):
        shown = getattr(options, f"show_{name}") or []
        if len(shown) > MOST_SHOWN or not set(shown) <= set(of_study):
            wanted = f"at most {MOST_SHOWN} of --{name}, which are {' '.join(f'{value:g}' for value in of_study)}"
            parser.error(f"--show-{name} {' '.join(f'{value:g}' for value in shown)}: expected {wanted}")
    return options


def add_numbers(
    group: argparse._ActionsContainer, name: str, metavar: str, about: str, default: Sequence[float] | None = None
) -> None:
    group.add_argument(name, nargs="+", type=float, default=default, metavar=metavar, help=about)
