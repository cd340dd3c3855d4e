"""A study: gap width against peak force and drift, over many scenes, records and intensities.

    python3 examples/run.py examples/study.py
    python3 examples/run.py examples/study.py SCENE.toml ... --records MINE.AT2 ... --gaps 0.01 0.05 --pga 2 4
    python3 examples/run.py examples/study.py --scheduler tcp://HOST:8786

Every scene becomes an FMU, which each worker loads once; a case sets its gap (of all contacts), its record and the
peak ground acceleration. Each case runs a second time with a gap that never closes, for comparison. Without --records
there are El Centro and synthetic motions (ground_motions.py).

Results are in results.csv of the output folder, a row per case, as soon as it is done; a study that was stopped
goes on from there, however it was stopped. At the end come pictures: what the gap does, and fragility curves.
"""

import argparse
import csv
import hashlib
import os
import shlex
import sys
import time
from pathlib import Path

import numpy as np
from fmpy import read_model_description

import ground_motions
from engine import ROOT, STANDARD_GRAVITY
from runs import Scene, run_or_stop
from study_results import Results
from study_runners import runner
from study_worker import Case, Materials

GAPS = [0.0, 0.005, 0.01, 0.02, 0.03, 0.05, 0.08, 0.12]  # m
NEVER_CLOSES = 1e3  # m
PGA = [0.5, 1.0, 2.0, 3.0, 4.0, 6.0, 8.0]  # m/s2
CARGO_FMU = shlex.split(os.environ.get("CARGO_FMU", "cargo fmu"))


def main():
    options = arguments()
    cases, materials = plan(options)
    if options.measure:
        return measure(cases, materials)
    results = Results(options.output / "results.csv")
    missing = results.missing(cases)
    print(f"{len(cases)} cases, {len(cases) - len(missing)} of them done", file=sys.stderr)
    run, workers = runner(options.scheduler, options.workers)
    progress = Progress(len(missing))
    try:
        for rows in run(missing, materials, workers):
            results.add(rows)
            progress.show(len(rows))
    except KeyboardInterrupt:
        raise SystemExit("\nstopped; the same command goes on from here") from None
    progress.end()
    results.finish(cases)
    rows = results.of(cases)
    results.close()
    if len(rows) < len(cases):
        print(f"{len(cases) - len(rows)} cases failed: see the last column of {results.path}", file=sys.stderr)
    print(results.path)
    draw(rows, options)


def draw(rows, options):
    try:
        import study_pictures
    except ModuleNotFoundError as missing:
        print(f"no pictures without {missing.name}", file=sys.stderr)
        return
    for scene in dict.fromkeys(row["scene"] for row in rows):
        of_scene = [row for row in rows if row["scene"] == scene]
        study_pictures.gaps(of_scene, NEVER_CLOSES, options.output / f"gaps_{scene}.png")
        limits = options.force_limit, options.drift_limit
        study_pictures.fragility(of_scene, NEVER_CLOSES, limits, options.output / f"fragility_{scene}.png")


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
    parser.add_argument("--force-limit", type=float, metavar="N", help="N, of the fragility; default: the median")
    parser.add_argument("--drift-limit", type=float, metavar="M", help="m, of the fragility; default: the median")
    parser.add_argument(
        "--output", type=lambda name: Path(name).resolve(), default=ROOT / "target/study", help="folder"
    )
    parser.add_argument(
        "--measure", action="store_true", help="how many cases a second: one core, all, Dask; no results"
    )
    options = parser.parse_args()
    if options.workers < 1 or min(options.pga) <= 0 or not np.all(np.isfinite([*options.gaps, *options.pga])):
        parser.error("expected at least one worker, --pga above 0 and finite --gaps")
    for file in [*options.scenes, *(options.records or [])]:
        if not file.exists():
            parser.error(f"{file}: no such file")
    return options


def plan(options):
    """All cases, and what they need."""
    fmus = {}
    for file in options.scenes:
        fmu = build(file, options.output / "fmus")
        fmus[fmu] = Scene(file).name
    synthetic = range(options.seed, options.seed + options.synthetic)
    records = options.records or [
        ROOT / "examples/records/el_centro_1940_ns.csv",
        *(ground_motions.write(options.output / "records", seed) for seed in synthetic),
    ]
    contents = {record: Path(record).read_bytes() for record in records}
    names = {record: hashlib.sha256(content).hexdigest()[:12] for record, content in contents.items()}
    motions = {record: read_record(record) for record in records}
    materials = Materials(
        fmus={fingerprint(fmu): fmu.read_bytes() for fmu in fmus},
        records={
            names[record]: (record.suffix.lower(), contents[record], float(np.abs(motion[1]).max()))
            for record, motion in motions.items()
        },
    )
    cases = [
        Case(
            scene, fingerprint(fmu), record.stem, names[record], pga, gap, options.stop or float(motions[record][0][-1])
        )
        for fmu, scene in fmus.items()
        for record in records
        for pga in dict.fromkeys(options.pga)
        for gap in dict.fromkeys([*options.gaps, NEVER_CLOSES])
    ]
    return cases, materials


def build(scene, folder):
    """The FMU of a scene."""
    folder.mkdir(parents=True, exist_ok=True)
    fmu = folder / f"{Scene(scene).name}.fmu"
    run_or_stop([*CARGO_FMU, scene.resolve(), "-o", fmu])
    names = {variable.name for variable in read_model_description(str(fmu)).modelVariables}
    for needed, why in [("ground.record", "a record in [ground]"), ("contact[1].gap", "a [[contact]]")]:
        if needed not in names:
            raise SystemExit(f"{scene}: a study needs a scene with {why}")
    return fmu


def fingerprint(fmu):
    """The GUID: it stands for scene, record and variables."""
    return read_model_description(str(fmu)).guid.strip("{}")


def read_record(path):
    """Times, s, and accelerations, m/s2, of a record."""
    try:
        return read_at2(path) if path.suffix.lower() == ".at2" else read_csv(path)
    except (ValueError, IndexError):
        raise SystemExit(f"{path}: expected CSV with the columns time_s,accel_m_s2, or PEER AT2") from None


def read_csv(path):
    lines = path.read_text().splitlines()
    rows = list(csv.reader(line for line in lines if line.strip() and not line.startswith("#")))[1:]
    time, acceleration = np.array(rows, float).T
    return time, acceleration


def read_at2(path):
    lines = path.read_text().splitlines()
    step = float(lines[3].upper().split("DT=")[1].split()[0].strip(","))
    values = np.array(" ".join(lines[4:]).split(), float) * STANDARD_GRAVITY
    return step * np.arange(len(values)), values


def measure(cases, materials, repeats=3):
    """Prints how fast each way of running is, and what starting takes: medians, and the lowest and highest rate."""
    cores = os.cpu_count()
    ways = [("one process", None, 1), (f"{cores} processes", None, cores)]
    ways += [(f"local Dask cluster, {workers} workers", "local", workers) for workers in sorted({1, cores, 2 * cores})]
    print(f"{len(cases)} cases, {cores} cores")
    for name, scheduler, workers in ways:
        processor = time.process_time()
        found = [measure_once(cases, materials, *runner(scheduler, workers)) for _ in range(repeats)]
        rates, starts = zip(*found)
        low, middle, high = np.percentile(rates, [0, 50, 100])
        said = f"{middle:4.0f} cases a second ({low:.0f} to {high:.0f})"
        print(f"{name:30}  {said:34}  after {np.median(starts):.1f} s", flush=True)
        if workers == 1 and scheduler is None:
            # Of this process, whatever else the machine is doing.
            each = (time.process_time() - processor) / (repeats * len(cases))
            print(f"{'':30}  {1e3 * each:.2f} ms of processor time each", flush=True)


def measure_once(cases, materials, run, workers):
    """Cases a second from the first results on, and s until then."""
    start = time.monotonic()
    batches = run(cases, materials, workers)
    next(batches)
    begun = time.monotonic()
    rest = sum(len(rows) for rows in batches)
    return rest / (time.monotonic() - begun), begun - start


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
    main()
