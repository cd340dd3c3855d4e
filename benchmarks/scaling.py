"""How the cost of a run grows: with storeys, contacts, impacts and samples of the record; and the memory.

"$(ci/environment benchmarks)" benchmarks/scaling.py            # a minute or two; renews docs/benchmark/
"$(ci/environment benchmarks)" benchmarks/scaling.py --quick    # seconds, few points: shows that the command works
"""

import argparse
import csv
import subprocess
from dataclasses import replace
from pathlib import Path

import draw
import machine
import record
import scenes
from peers import compiled
from progress import Progress

ROOT = Path(__file__).resolve().parents[1]
WORK = ROOT / "target/benchmarks/scaling"
RESULTS = ROOT / "docs/benchmark"
TOLERANCE = 1e-10
INSTANCES = 50
LAW = "hertz"
COLUMNS = [
    "series", "value", "storeys", "contacts", "impacts", "samples", "best_s", "memory_bytes",
    "contact_steps", "flight_steps",
]  # fmt: skip


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--repeats", type=int, help="of each measurement")
    options = parser.parse_args()
    results = ROOT / "target/benchmarks/quick" if options.quick else RESULTS
    repeats = options.repeats or (2 if options.quick else 15)
    rows = measure(list(series(options.quick)), repeats)
    results.mkdir(parents=True, exist_ok=True)
    with (results / "scaling.csv").open("w", newline="") as file:
        table = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
    draw.scaling(rows, machine.processor(), results)
    print(f"results: {results.relative_to(ROOT)}")


def series(quick):
    """Series, its value, and the problem with its sample interval in s."""
    thin = (lambda values: values[:: len(values) - 1]) if quick else (lambda values: values)
    tall, single = scenes.TEMPLATES["S4"], scenes.TEMPLATES["S1"]
    for storeys in thin([2, 4, 8, 16, 32, 64, 128, 200]):
        for contacts in (0, 1):
            yield f"storeys, {contacts} contacts", storeys, pair_of(tall, storeys, contacts), 0.01
    for contacts in thin([1, 2, 5, 10, 20]):
        yield "contacts", contacts, scenes.Problem("contacts", LAW, replace(tall, pairs=contacts)), 0.01
    for gap in thin([0.001, 0.005, 0.02, 0.05, 0.1, 0.15, 0.2, 0.5]):
        yield "impacts", gap, scenes.Problem("impacts", LAW, replace(single, gap=gap)), 0.01
    for step in thin([0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0005]):
        yield "samples", step, scenes.Problem("samples", LAW, replace(single, pairs=0)), step
        yield "samples, 1 contact", step, scenes.Problem("samples", LAW, single), step


def pair_of(template, storeys, contacts):
    """Two equal numbers of storeys, a contact at the top; the periods kept: stiffness as the square of the height."""
    half = storeys // 2

    def building(like):
        factor = (half / len(like.mass)) ** 2
        if half == 1:
            return scenes.shear(1, like.mass[0], like.stiffness[0] * factor, "{ ratio = 0.05 }", 0.05)
        return scenes.shear(half, like.mass[0], like.stiffness[0] * factor, scenes.RAYLEIGH, 0.05)

    buildings = {"left": building(template.left), "right": building(template.right)}
    return scenes.Problem("storeys", LAW, replace(template, **buildings, pairs=contacts, lowest=half - 1))


def measure(points, repeats):
    """All points in turn, several times: rows of the result file."""
    WORK.mkdir(parents=True, exist_ok=True)
    program = compiled.build_engine()
    runs = []
    for index, (name, value, problem, step) in enumerate(points):
        motion = f"record_{step:g}.csv"
        if not (WORK / motion).exists():
            record.write(WORK / motion, step)
        scene = WORK / f"{index}.toml"
        scene.write_text(replace(problem, record=motion).toml(peaks=False))
        solver = compiled.Solver(program, scene, sum(problem.floors), "engine", TOLERANCE)
        runs.append((name, value, problem, step, scene, solver))
    progress, outcomes = Progress(repeats), [[] for _ in runs]
    for _ in range(repeats):
        for run, found in zip(runs, outcomes):
            progress.show(f"{run[0]} {run[1]}")
            found.append(run[-1].run(warm_up=True))
        progress.end()
    progress.clear()
    return [row(program, *run[:-1], found) for run, found in zip(runs, outcomes)]


def row(program, name, value, problem, step, scene, found):
    command = [program, scene, "memory", str(TOLERANCE), str(INSTANCES), "-"]
    memory = float(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    return {
        "series": name,
        "value": value,
        "storeys": sum(problem.floors),
        "contacts": len(problem.contacts),
        "impacts": found[0].impacts,
        "samples": round(problem.stop / step) + 1,
        "best_s": f"{min(outcome.seconds for outcome in found):.4e}",
        "memory_bytes": round(memory),
        "contact_steps": int(found[0].counters["contact_steps"]),
        "flight_steps": int(found[0].counters["flight_steps"]),
    }


if __name__ == "__main__":
    main()
