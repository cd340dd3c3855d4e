"""A study: gap width against peak force and drift, over many scenes, records and intensities.

    python3 examples/run.py examples/study.py
    python3 examples/run.py examples/study.py SCENE.toml ... --records MINE.AT2 ... --gaps 0.01 0.05 --pga 2 4
    python3 examples/run.py examples/study.py --scheduler tcp://HOST:8786

Every scene becomes an FMU. A case sets its gap (of all contacts), its record and the peak ground acceleration, and runs
in the Python module pounding_fmu where that is installed, else in the FMU, which each worker loads once. Each case runs
a second time with a gap that never closes, for comparison. Without --records there are El Centro and synthetic motions
(ground_motions.py).

Results are in results.csv of the output folder, a row per case, as soon as it is done; a study that was stopped
goes on from there, however it was stopped. At the end come results.parquet, where pyarrow is installed, the parameters
of the fragility curves, and pictures: what the gap does, and fragility curves.
"""

import signal

# Until there is something to end in order, Ctrl-C ends this at once.
signal.signal(signal.SIGINT, signal.SIG_DFL)

import argparse  # noqa: E402
import contextlib  # noqa: E402
import dataclasses  # noqa: E402
import os  # noqa: E402
import sys  # noqa: E402
import time  # noqa: E402
from pathlib import Path  # noqa: E402

import numpy as np  # noqa: E402

import study_fragility  # noqa: E402
from engine import ROOT  # noqa: E402
from study_plan import plan  # noqa: E402
from study_results import Results  # noqa: E402
from study_runners import runner, without_interrupts  # noqa: E402
from study_table import NEVER_CLOSES  # noqa: E402

GAPS = [0.0, 0.005, 0.01, 0.02, 0.03, 0.05, 0.08, 0.12]  # m
PGA = [0.5, 1.0, 2.0, 3.0, 4.0, 6.0, 8.0]  # m/s2
INTERRUPTED = 130  # what a shell calls the end of a program by Ctrl-C


def main():
    options = arguments()
    planned = plan(options)
    if options.measure:
        return measure(planned.cases, planned.materials)
    results = Results(options.output / "results.csv", planned.storeys)
    fill(results, planned, options)
    rows = results.finish(planned.cases)
    results.close()
    failed = len(planned.cases) - len(rows)
    if failed:
        print(f"{failed} cases failed: see the last column of {results.path}", file=sys.stderr)
    print(results.path)
    draw(rows, options)


def fill(results, planned, options):
    """Runs the cases that have no row yet."""
    cases = planned.cases
    missing = results.missing(cases)
    print(f"{len(cases)} cases, {len(cases) - len(missing)} of them done", file=sys.stderr)
    run, workers = runner(options.scheduler, options.workers, planned.materials.with_module)
    progress = Progress(len(missing))
    with contextlib.closing(run(missing, planned.materials, workers)) as batches:
        for rows in batches:
            results.add(planned.with_intensity(case, row) for case, row in rows)
            progress.show(len(rows))
    progress.end()


def draw(rows, options):
    limits = {"force": options.force_limit, "drift": options.drift_limit, "acceleration": options.acceleration_limit}
    limits |= {"ductility": options.ductility_limit, "residual drift": options.residual_limit}
    for scene in dict.fromkeys(row["scene"] for row in rows):
        of_scene = [row for row in rows if row["scene"] == scene]
        demands = study_fragility.demands(of_scene, limits)
        curves = study_fragility.curves(of_scene, demands, options.intensity)
        study_fragility.write(curves, options.output / f"fragility_{scene}.csv")
        # A second or two; matplotlib may crash when it is interrupted.
        with without_interrupts():
            draw_scene(of_scene, curves, options, scene)


def draw_scene(rows, curves, options, scene):
    try:
        import study_pictures
    except ModuleNotFoundError as missing:
        print(f"no pictures without {missing.name}", file=sys.stderr)
        return
    study_pictures.gaps(rows, options.output / f"gaps_{scene}.png")
    study_pictures.fragility(rows, curves, options.intensity, options.output / f"fragility_{scene}.png")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", type=Path, default=[ROOT / "examples/scenes/feup.toml"])
    parser.add_argument("--gaps", nargs="+", type=float, default=GAPS, metavar="M", help="m (default: %(default)s)")
    parser.add_argument("--pga", nargs="+", type=float, default=PGA, metavar="A", help="m/s2 (default: %(default)s)")
    parser.add_argument("--records", nargs="+", type=Path, metavar="FILE", help="CSV or AT2, instead of the usual ones")
    parser.add_argument(
        "--synthetic", type=int, default=20, metavar="N", help="synthetic records (default: %(default)s)"
    )
    parser.add_argument("--seed", type=int, default=1, help="of the first of them")
    parser.add_argument("--stop", type=float, help="s, end of each run; without it, the end of its record")
    parser.add_argument("--scheduler", help="tcp://HOST:PORT of a Dask cluster, or `local` for one on this machine")
    parser.add_argument("--workers", type=int, default=os.cpu_count(), help="on this machine (default: all cores)")
    parser.add_argument(
        "--through", choices=["module", "fmus"], help="what runs the cases (default: the module where it is installed)"
    )
    parser.add_argument("--force-limit", type=float, metavar="N", help="N, of the fragility; default: the median")
    parser.add_argument("--drift-limit", type=float, metavar="M", help="m, of the fragility; default: the median")
    parser.add_argument(
        "--acceleration-limit", type=float, metavar="A", help="m/s2, of the fragility; default: the median"
    )
    parser.add_argument("--ductility-limit", type=float, metavar="D", help="where storeys yield; default: the median")
    parser.add_argument("--residual-limit", type=float, metavar="M", help="m, of residual drift; default: the median")
    parser.add_argument(
        "--intensity",
        choices=study_fragility.INTENSITIES,
        default="pga",
        help="what the fragility is drawn against: peak ground acceleration, or the spectral acceleration at the first "
        "period of a building (default: %(default)s)",
    )
    parser.add_argument(
        "--output", type=lambda name: Path(name).resolve(), default=ROOT / "target/study", help="folder"
    )
    parser.add_argument(
        "--measure", action="store_true", help="how many cases a second: one core, all, Dask; no results"
    )
    options = parser.parse_args()
    numbers = [*options.gaps, *options.pga, options.stop or 1.0]
    if not np.all(np.isfinite(numbers)) or min(options.pga) <= 0 or max(options.gaps) >= NEVER_CLOSES:
        parser.error(f"expected --pga above 0 and --gaps below {NEVER_CLOSES:g}, all finite")
    if options.workers < 1 or options.synthetic < 0 or options.seed < 0 or (options.stop or 1.0) <= 0:
        parser.error("expected at least one worker, --stop above 0, --synthetic and --seed of 0 or more")
    for file in [*options.scenes, *(options.records or [])]:
        if not file.is_file():
            parser.error(f"{file}: no such file")
    return options


def measure(cases, materials, repeats=3):
    """Prints how fast each way of running is, and what starting takes: medians, and the lowest and highest rate.

    Where the Python module is installed, FMUs and module take turns, so that both have the same of what else goes on.
    """
    cores = os.cpu_count()
    kinds = {"FMUs": dataclasses.replace(materials, with_module=False)}
    kinds |= {"module": materials} if materials.with_module else {}
    ways = [(f"{workers} at a time", None, workers) for workers in sorted({1, cores})]
    ways += [(f"local Dask cluster, {workers} workers", "local", workers) for workers in sorted({1, cores, 2 * cores})]
    print(f"{len(cases)} cases, {cores} cores")
    for name, scheduler, workers in ways:
        found = {kind: [] for kind in kinds}
        for kind in [*kinds] * repeats:
            found[kind].append(measure_once(cases, kinds[kind], scheduler, workers))
        for kind, runs in found.items():
            rates, starts, processor = zip(*runs)
            low, middle, high = np.percentile(rates, [0, 50, 100])
            said = f"{middle:4.0f} cases a second ({low:.0f} to {high:.0f})"
            # Of this process, whatever else the machine is doing.
            own = f", {np.median(processor):.2f} ms of processor time each" if workers == 1 and scheduler is None else ""
            print(f"{name:30}  {kind:7} {said:34}  after {np.median(starts):.1f} s{own}", flush=True)


def measure_once(cases, materials, scheduler, workers):
    """Cases a second from the first results on, s until then, and ms of processor time a case."""
    run, workers = runner(scheduler, workers, materials.with_module)
    processor, start = time.process_time(), time.monotonic()
    batches = run(cases, materials, workers)
    next(batches)
    begun = time.monotonic()
    rest = sum(len(rows) for rows in batches)
    each = 1e3 * (time.process_time() - processor) / len(cases)
    return rest / (time.monotonic() - begun), begun - start, each


class Progress:
    """A line on a terminal; nothing in a pipe."""

    def __init__(self, total):
        self.total, self.done, self.start = total, 0, time.monotonic()

    def show(self, more):
        self.done += more
        if not sys.stderr.isatty():
            return
        rate = self.done / (time.monotonic() - self.start)
        bar = "#" * (30 * self.done // self.total)
        left = (self.total - self.done) / rate
        line = f"[{bar:<30}] {self.done}/{self.total}  {rate:.0f} cases/s, {left:.0f} s left"
        print(f"\r\x1b[K{line}", end="", file=sys.stderr, flush=True)

    def end(self):
        seconds = time.monotonic() - self.start
        if self.done:
            end = "\n" if sys.stderr.isatty() else ""
            print(f"{end}{self.done} cases in {seconds:.1f} s, {self.done / seconds:.1f} a second", file=sys.stderr)


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        main()
    except KeyboardInterrupt:
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        print("\nstopped; the same command goes on from here", file=sys.stderr)
        sys.exit(INTERRUPTED)
    except OSError as error:
        sys.exit(f"error: {error}")
