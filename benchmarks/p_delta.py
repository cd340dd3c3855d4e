"""P-delta beside OpenSees' `PDelta`: periods, and a frame that yields and falls; the page docs/benchmark/p_delta.md.

"$(ci/environment benchmarks)" benchmarks/p_delta.py            # a minute; renews docs/benchmark/
"$(ci/environment benchmarks)" benchmarks/p_delta.py --quick    # seconds, two steps: shows that the command works

Needs OpenSeesPy (requirements-optional.txt), and gcc for the reference in quadruple precision.
"""

import argparse
import csv
import math
import os
import shutil
import subprocess
import time
import tomllib
from pathlib import Path
from types import SimpleNamespace

import numpy as np

import machine
import truth
from peers import compiled, opensees

ROOT = Path(__file__).resolve().parents[1]
WORK = ROOT / "target/benchmarks/p_delta"
EXAMPLE = ROOT / "examples/scenes/leaning.toml"
RECORD = ROOT / "examples/records/el_centro_1940_ns.csv"

# Three storeys, elastic: those at the head of docs/p_delta.md.
STOREYS = {
    "mass": [200e3, 200e3, 160e3],
    "height": [3.2, 3.2, 3.2],
    "stiffness": [200e6, 190e6, 110e6],
    "gravity_load": [3900e3, 3900e3, 3100e3],
}
AXIAL = [2e9, 2e11, 2e13, 2e15]  # N, E A of the columns in OpenSees
YOUNG = 2e11  # N/m2
STEPS = [0.02, 0.01, 0.002, 0.0004, 0.00008]  # s
INTEGRATORS = {"Newmark, average acceleration": ("Newmark", 0.5, 0.25), "HHT, alpha = 0.9": ("HHT", 0.9)}
TOLERANCE = 1e-12  # m, NormDispIncr
COMPARED, STOP = 15.0, 31.0  # s: the errors are those until the first, the runs end at the second
ROW = 0.1  # s, a multiple of all steps
REPEATS = 3


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    try:
        ops = opensees.load()
    except (ImportError, OSError, RuntimeError) as error:
        print(f"nothing compared, without OpenSees: {error}")
        return
    ops.logFile(os.devnull, "-noEcho")
    WORK.mkdir(parents=True, exist_ok=True)
    program = compiled.build_engine(program="simulate")
    folder = ROOT / ("target/benchmarks/quick" if options.quick else "docs/benchmark")
    text = HEADING.format(version=ops.version(), processor=machine.processor(), tolerance=TOLERANCE)
    steps = STEPS[1:3] if options.quick else STEPS
    text += "\n" + periods_table(ops, program) + "\n" + frame_table(ops, program, steps)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "p_delta.md").write_text(text)
    print(f"results: {(folder / 'p_delta.md').relative_to(ROOT)}")


# Elastic periods


def periods_table(ops, program):
    """Periods in s, and by how much those of the engine differ, for each axial stiffness."""
    without, _ = modes(ops, "Linear", AXIAL[0])
    periods, _ = modes(ops, "PDelta", AXIAL[0])
    columns = [differences(program, *modes(ops, "PDelta", axial)) for axial in AXIAL]
    named = " | ".join(f"engine, E A = {axial:.0e} N" for axial in AXIAL)
    lines = [PERIODS, f"| mode | `Linear`, s | `PDelta`, s | {named} |", "|---" * (3 + len(AXIAL)) + "|"]
    for mode in range(len(periods)):
        found = " | ".join(f"{column[mode]:.1e}" for column in columns)
        lines.append(f"| {mode + 1} | {without[mode]:.9f} | {periods[mode]:.9f} | {found} |")
    return "\n".join([*lines, ""])


def modes(ops, transformation, axial):
    """Periods and shapes of the three storeys in OpenSees, columns that cannot turn at their ends, after gravity."""
    floors = len(STOREYS["mass"])
    begin(ops, transformation)
    ops.node(0, 0.0, 0.0)
    ops.fix(0, 1, 1, 1)
    level = 0.0
    for i, (mass, height, stiffness, _) in enumerate(zip(*STOREYS.values()), start=1):
        level += height
        ops.node(i, 0.0, level)
        ops.fix(i, 0, 0, 1)
        ops.mass(i, mass, 0.0, 0.0)
        ops.element("elasticBeamColumn", i, i - 1, i, axial / YOUNG, YOUNG, stiffness * height**3 / (12.0 * YOUNG), 1)
    lay_weights(ops, {i + 1: weight for i, weight in enumerate(STOREYS["gravity_load"])})
    squares = ops.eigen("-fullGenLapack", floors)[:floors]
    shapes = [[ops.nodeEigenvector(i + 1, mode + 1, 1) for i in range(floors)] for mode in range(floors)]
    return [2.0 * math.pi / math.sqrt(square) for square in squares], shapes


def differences(program, periods, shapes):
    """Of the engine's periods from those, relative: let go in a shape, nothing is left of it after a quarter period."""
    mass, found = np.array(STOREYS["mass"]), []
    for mode, (period, shape) in enumerate(zip(periods, shapes), start=1):
        shape = np.array(shape) / np.abs(shape).max()
        lines = [f"{key} = {value}" for key, value in STOREYS.items()]
        lines += ["p_delta = true", "damping = { ratio = 0.0 }", f"initial_displacement = {shape.tolist()}"]
        scene = WORK / f"mode_{mode}.toml"
        scene.write_text("\n".join(['name = "Mode"', "[left]", *lines, ""]))
        last, _ = solve(program, scene, period / 4.0, period / 4.0)
        rest = [float(last[-1][f"left.displacement[{i + 1}]"]) for i in range(len(shape))]
        # cos(pi/2 (1 - e)) = pi/2 e where the engine's period is 1 + e times as long.
        found.append(float(mass * shape @ rest / (mass * shape @ shape)) * 2.0 / math.pi)
    return found


# A frame that yields


def frame_table(ops, program, steps):
    scene = write_frame()
    with scene.open("rb") as file:
        frame = tomllib.load(file)["left"]
    true = truth.of(SimpleNamespace(name="frame", floors=[1]), WORK)
    fall = true_fall()
    per_row = round(ROW / truth.OUTPUT_STEP)
    expected = true.displacements[: round(COMPARED / truth.OUTPUT_STEP) + 1 : per_row, 0]
    lines = [FRAME.format(fall=fall, compared=COMPARED, repeats=REPEATS, row=ROW)]
    lines += ["| solver | step, s | error | collapse, s | late by, s | run time, ms |", "|---|---|---|---|---|---|"]
    lines.append(engine_row(program, scene, expected, fall))
    for name, integrator in INTEGRATORS.items():
        for step in steps:
            runs = [run_frame(ops, frame, integrator, step) for _ in range(REPEATS)]
            displacements, found, seconds = min(runs, key=lambda run: run[2])
            lines.append(table_row(f"OpenSees, {name}", f"{step:.7g}", displacements, expected, found, fall, seconds))
    return "\n".join([*lines, ""])


def engine_row(program, scene, expected, fall):
    rows, _ = solve(program, scene, ROW, STOP)
    displacements = np.array([float(row["left.displacement[1]"]) for row in rows[: len(expected)]])
    seconds = min(solve(program, scene, ROW, COMPARED)[1] for _ in range(REPEATS))
    return table_row("engine", "", displacements, expected, float(rows[-1]["left.collapse_time"]), fall, seconds)


def table_row(name, step, displacements, expected, found, fall, seconds):
    error = np.abs(displacements - expected).max() / np.abs(expected).max()
    collapse = f"{found:.6f} | {found - fall:.2g}" if found is not None else "stands | "
    return f"| {name} | {step} | {error:.1e} | {collapse} | {1e3 * seconds:.1f} |"


def write_frame():
    """The left frame of the example alone, with its record beside it."""
    example = EXAMPLE.read_text()
    left, ground = (example.split(f"\n[{name}]\n")[1].split("\n\n")[0] for name in ("left", "ground"))
    ground = ground.replace(os.path.relpath(RECORD, EXAMPLE.parent).replace("\\", "/"), "record.csv")
    shutil.copy(RECORD, WORK / "record.csv")
    scene = WORK / "frame.toml"
    heading = f'name = "Frame"\nunits = "kN-t"\nstop_time = {STOP}\n'
    scene.write_text(f"{heading}[left]\n{left}\n[ground]\n{ground}\n")
    return scene


def true_fall():
    """Time of the collapse in quadruple precision, s."""
    *_, last = (WORK / "frame.truth.yields.csv").read_text().splitlines()
    _, _, what, when, *_ = last.split(",")
    if not what.startswith("collapses"):
        raise SystemExit("the frame does not collapse")
    return float(when)


def build_frame(ops, frame, integrator):
    """A mass on a column that carries the weight alone, beside a spring that yields and a dashpot."""
    value = {key: 1e3 * frame[key][0] for key in ("mass", "stiffness", "yield_force", "gravity_load")}
    height = frame["height"][0]
    net = value["stiffness"] - value["gravity_load"] / height
    dashpot = 2.0 * frame["damping"]["ratio"] * math.sqrt(net * value["mass"])
    begin(ops, "PDelta")
    for node, level, fixed in [(1, 0.0, (1, 1, 1)), (2, height, (0, 0, 1)), (3, height, (1, 1, 1))]:
        ops.node(node, 0.0, level)
        ops.fix(node, *fixed)
    ops.mass(2, value["mass"], 0.0, 0.0)
    # 12 E I / h^3 of it is 1e-15 of the stiffness.
    inertia = 1e-15 * value["stiffness"] * height**3 / (12.0 * YOUNG)
    ops.element("elasticBeamColumn", 1, 1, 2, AXIAL[0] / YOUNG, YOUNG, inertia, 1)
    ops.uniaxialMaterial("Steel01", 1, value["yield_force"], value["stiffness"], frame["post_yield_ratio"])
    ops.uniaxialMaterial("Elastic", 2, 0.0, dashpot)
    for material in (1, 2):
        ops.element("zeroLength", 1 + material, 3, 2, "-mat", material, "-dir", 1, "-doRayleigh", 0)
    lay_weights(ops, {2: value["gravity_load"]})
    ops.loadConst("-time", 0.0)
    ops.wipeAnalysis()
    with (WORK / "frame.toml").open("rb") as file:
        scale = tomllib.load(file)["ground"]["scale"]
    times, accelerations = np.loadtxt(RECORD, delimiter=",", skiprows=5, unpack=True)
    ops.timeSeries("Path", 2, "-dt", float(times[1]), "-values", *(scale * accelerations).tolist())
    ops.pattern("UniformExcitation", 2, 1, "-accel", 2)
    analysis(ops, integrator, "Transient")
    return 0.5 * height  # the drift at which it has collapsed


def run_frame(ops, frame, integrator, step):
    """Displacements every ROW until COMPARED; the time of the collapse; the seconds until COMPARED took."""
    collapse = build_frame(ops, frame, integrator)
    displacements, start = [0.0], time.perf_counter()
    for _ in range(round(COMPARED / ROW)):
        go(ops, round(ROW / step), step)
        displacements.append(ops.nodeDisp(2, 1))
    seconds, last = time.perf_counter() - start, abs(displacements[-1])
    for k in range(round(COMPARED / step), round(STOP / step)):
        go(ops, 1, step)
        now = abs(ops.nodeDisp(2, 1))
        if now >= collapse:
            return np.array(displacements), step * (k + (collapse - last) / (now - last)), seconds
        last = now
    return np.array(displacements), None, seconds


# What both have in common


def solve(program, scene, step, stop):
    """Rows of the table of a run of the engine, and the seconds that it took."""
    table = WORK / "run.csv"
    command = [program, scene, "--step", repr(step), "--stop", repr(stop), "--csv", table]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    with table.open(newline="") as file:
        return list(csv.DictReader(file)), float(done.stdout.rsplit("solve_seconds=", 1)[1])


def begin(ops, transformation):
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.geomTransf(transformation, 1)


def lay_weights(ops, weights):
    """A static analysis under the weights, N, by node."""
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    for node, weight in weights.items():
        ops.load(node, 0.0, -weight, 0.0)
    analysis(ops, ("LoadControl", 1.0), "Static")
    go(ops, 1)


def analysis(ops, integrator, kind):
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("FullGeneral")
    ops.test("NormDispIncr", TOLERANCE, 50)
    ops.algorithm("Newton")
    ops.integrator(*integrator)
    ops.analysis(kind)


def go(ops, *steps):
    if ops.analyze(*steps) != 0:
        raise RuntimeError(f"OpenSees' iteration did not converge at {ops.getTime():.4f} s")


HEADING = """# P-delta beside OpenSees

The engine, and OpenSees {version} with the transformation `PDelta`, weights laid on before; Newton until the increment
(`NormDispIncr`) is below {tolerance:.0e} m; on {processor}. Made by `benchmarks/p_delta.py`.
"""
PERIODS = """## Elastic periods

Three storeys (those at the head of [the page on gravity](../p_delta.md), elastic); in OpenSees one `elasticBeamColumn`
per storey that cannot turn at its ends, 12 E I / h^3 = k, eigenvalues by `-fullGenLapack`. The last columns say by
which share the engine's period is longer: it is let go in OpenSees' shape, and what is left of that after a quarter of
OpenSees' period says it. In OpenSees the force in a column is E A times its shortening: the stiffer, the fewer digits
of the weight are left.
"""
FRAME = """## A frame that yields and falls

The left frame of `examples/scenes/leaning.toml` alone; in OpenSees a mass on a column that carries the weight and next
to no horizontal force, beside `Steel01` and a dashpot. Error: the largest difference of a displacement at multiples of
{row:g} s until {compared:g} s, relative to the largest one, from the quadruple-precision program of
`tests/reference`. There the frame collapses at {fall:.12f} s, with a drift of half the height; in OpenSees that time
is interpolated within its step. Run time: until {compared:g} s, without reading files and set-up, the best of
{repeats}; the engine is in a new process each time, with everything that `simulate` puts into its table.
"""

if __name__ == "__main__":
    main()
