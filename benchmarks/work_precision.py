"""Run time against error, beside other solvers, measured in one session.

    "$(ci/environment benchmarks)" benchmarks/work_precision.py            # the long run: 40 minutes; renews docs/benchmark/
    "$(ci/environment benchmarks)" benchmarks/work_precision.py --scene Y1 Y2  # these scenes alone; the others' results stay
    "$(ci/environment benchmarks)" benchmarks/work_precision.py --quick    # a minute: shows that the command works
    "$(ci/environment benchmarks)" benchmarks/work_precision.py --draw     # pictures and table of the last long run again

Needs Rust, gcc and Python 3.11. Every solver gets the same scenes (scenes.py) and is compared with the
quadruple-precision program of tests/reference (truth.py), which is run first and whose results are kept below target/.
What is measured is said in docs/benchmark/README.md.
"""

import argparse
import csv
import os
from pathlib import Path

# One thread for each solver: set before NumPy is loaded.
for variable in ["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"]:
    os.environ[variable] = "1"

import numpy as np  # noqa: E402

import draw  # noqa: E402
import machine  # noqa: E402
import measure  # noqa: E402
import record  # noqa: E402
import report  # noqa: E402
import scenes  # noqa: E402
import solvers  # noqa: E402
import truth  # noqa: E402
from peers import compiled, heyoka_taylor  # noqa: E402
from progress import Progress  # noqa: E402

ROOT = Path(__file__).resolve().parents[1]
RESULTS = ROOT / "docs/benchmark"
WORK = ROOT / "target/benchmarks"

FULL = measure.Budget(repeats=21, seconds=2.0, longest=30.0)
QUICK = measure.Budget(repeats=2, seconds=1.0, longest=5.0)
QUICK_STOP = 4.0  # s


def main():
    options = parse_options()
    results = WORK / "quick" if options.quick else RESULTS
    if not options.draw:
        run(options, results)
    rows = read(results / "work_precision.csv")
    draw.work_precision(rows, results)
    report.write(rows, results)
    print(f"results: {results.relative_to(ROOT)}")


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="two scenes, two laws, 4 s of the record")
    parser.add_argument("--draw", action="store_true", help="no run: pictures and tables from the last results")
    parser.add_argument("--scene", nargs="+", choices=list(scenes.TEMPLATES), help="these only; results of others stay")
    parser.add_argument("--law", nargs="+", choices=scenes.LAWS, help="likewise")
    parser.add_argument("--solver", nargs="+", help="these peers only, by parts of their names")
    parser.add_argument("--repeats", type=int, help="of each measurement, at most")
    return parser.parse_args()


def run(options, results):
    budget = QUICK if options.quick else FULL
    if options.repeats:
        budget.repeats = options.repeats
    problems = chosen_problems(options)
    if not problems:
        raise SystemExit("none of these scenes has any of these laws")
    folder = WORK / ("quick" if options.quick else "full")
    ground = make_inputs(problems, folder)
    entries, missing = solvers.available(options.solver)
    for name, reason in missing.items():
        print(f"without {name}: {reason}")
    others = other_rows(problems, results / "work_precision.csv")
    progress, rows = Progress(len(problems)), list(others)
    for problem in problems:
        progress.begin(problem.name)
        progress.show("truth")
        true = truth.of(problem, folder)
        files = [folder / f"{problem.name}.{ending}" for ending in ("toml", "without_peaks.toml", "txt")]
        case = solvers.Case(problem, *files, ground)
        compiled.write_problem(problem, ground, case.numbers_file)
        of_this = measure.compare(case, true, entries, budget, options.quick, progress)
        rows += of_this
        progress.end()
        progress.clear()
        print(report.line(problem, of_this), flush=True)
        write(results / "work_precision.csv", rows)
    if not others:
        loop = f"{report.LOOP} {1e3 * heyoka_taylor.empty_loop(*ground):.2f} ms"
        machine.write(results / "machine.txt", missing, [loop])


def chosen_problems(options):
    chosen = options.scene or (["S1", "Y1"] if options.quick else list(scenes.TEMPLATES))
    laws = options.law or (["kelvin_voigt", "jankowski", scenes.NO_CONTACT] if options.quick else scenes.LAWS)
    stop = QUICK_STOP if options.quick else scenes.STOP
    return [scenes.problem(scene, law, stop) for scene in chosen for law in laws if law in scenes.TEMPLATES[scene].laws]


def other_rows(problems, path):
    """Results of earlier runs, of what is not run now."""
    run_now = [(problem.scene, problem.law) for problem in problems]
    return [row for row in read(path) if (row["scene"], row["law"]) not in run_now] if path.exists() else []


def make_inputs(problems, folder):
    """Scenes and record as files; returns the record's times and accelerations."""
    folder.mkdir(parents=True, exist_ok=True)
    record.write(folder / "record.csv", duration=problems[0].stop)
    for problem in problems:
        (folder / f"{problem.name}.toml").write_text(problem.toml())
        (folder / f"{problem.name}.without_peaks.toml").write_text(problem.toml(peaks=False))
    return tuple(np.loadtxt(folder / "record.csv", delimiter=",", skiprows=2, unpack=True))


def write(path, rows):
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", newline="") as file:
        table = csv.DictWriter(file, measure.COLUMNS, lineterminator="\n")
        table.writeheader()
        table.writerows(rows)


def read(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


if __name__ == "__main__":
    main()
