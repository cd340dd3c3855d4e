"""Two buildings that sway, rock, lean and collide, beside OpenSees and SciPy; the page docs/benchmark/soil.md.

"$(ci/environment benchmarks)" benchmarks/soil.py            # a minute; renews docs/benchmark/
"$(ci/environment benchmarks)" benchmarks/soil.py --quick    # seconds, one step: shows that the command works

Neither has the engine's equations. OpenSees has frames of beams whose nodes turn with their foundation: the overturning
moment is that of its beams, and P-delta its transformation. SciPy has the equations of textbooks: displacements relative
to the foundation, whose masses are coupled. Without OpenSeesPy (requirements-optional.txt) SciPy alone is compared.
"""

import argparse
import math
import os
import tomllib
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

import machine
import p_delta
from peers import compiled, opensees

ROOT = Path(__file__).resolve().parents[1]
WORK = ROOT / "target/benchmarks/soil"
RECORD = ROOT / "examples/records/el_centro_1940_ns.csv"
SIDES = ("left", "right")
STEPS = [2e-3, 4e-4, 8e-5, 1.6e-5]  # s
TOLERANCE = 1e-12  # of SciPy
ALLOWED = 1e-11  # how far SciPy may be from the engine
LONGEST = 1e-3  # s, step of SciPy: a longer one may leap over a contact
STOP = 10.0  # s
ROW = 0.02  # s, a multiple of all steps
GRAVITY = 9.80665  # m/s2
AXIAL, YOUNG = 2e11, 2e11  # N, E A of the columns; N/m2
FAINT = 1e-10  # stiffness of the beams that damp, over that of the storey

SCENE = """
name = "Soil"
[left]
mass = [200e3, 200e3, 160e3]
height = [3.2, 3.2, 3.2]
stiffness = [200e6, 190e6, 110e6]
damping = { dashpots = [1.1e6, 1.0e6, 0.6e6] }
p_delta = true
[left.foundation]
mass = 150e3
inertia = 14e6
sway = { stiffness = 500e6, dashpot = 12e6 }
rocking = { stiffness = 18e9, dashpot = 40e6 }
[right]
mass = [160e3, 120e3]
height = [3.2, 3.2]
stiffness = [260e6, 180e6]
damping = { dashpots = [0.9e6, 0.7e6] }
p_delta = true
[right.foundation]
mass = 120e3
inertia = 9e6
sway = { stiffness = 450e6, dashpot = 10e6 }
rocking = { stiffness = 12e9, dashpot = 25e6 }
[ground]
record = "RECORD"
[[contact]]
left_floor = 2
right_floor = 2
gap = 0.008
law = "kelvin_voigt"
stiffness = 8e8
restitution = 0.65
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    WORK.mkdir(parents=True, exist_ok=True)
    scene, program = tomllib.loads(SCENE), compiled.build_engine(program="simulate")
    expected, impacts = engine(program)
    independent = textbook(scene)
    if not differences(independent, expected).max() < ALLOWED:
        raise SystemExit(f"the engine and SciPy differ by {differences(independent, expected).max():.1e}")
    lines = [row("SciPy, DOP853", LONGEST, independent, expected)]
    ops = load()
    for step in (STEPS[:1] if options.quick else STEPS) if ops else ():
        lines.append(row(f"OpenSees {ops.version()}, Newmark", step, frames(ops, scene, step), expected))
    folder = ROOT / ("target/benchmarks/quick" if options.quick else "docs/benchmark")
    folder.mkdir(parents=True, exist_ok=True)
    heading = HEADING.format(stop=STOP, row=ROW, impacts=impacts, tolerance=TOLERANCE, processor=machine.processor())
    (folder / "soil.md").write_text("\n".join([heading, *lines, ""]))
    print(f"results: {(folder / 'soil.md').relative_to(ROOT)}")


def load():
    """OpenSees, where it can be had."""
    try:
        ops = opensees.load()
    except (ImportError, OSError, RuntimeError) as error:
        print(f"without OpenSees: {error}")
        return None
    ops.logFile(os.devnull, "-noEcho")
    return ops


def differences(found, expected):
    """The largest of each column, relative to its largest value."""
    return np.abs(found - expected).max(axis=0) / np.abs(expected).max(axis=0)


def row(name, step, found, expected):
    """With the largest differences of each kind."""
    largest = {}
    for difference, (kind, _) in zip(differences(found, expected), columns(tomllib.loads(SCENE))):
        largest[kind] = max(difference, largest.get(kind, 0.0))
    return f"| {name} | {step:.7g} | " + " | ".join(f"{difference:.1e}" for difference in largest.values()) + " |"


def columns(scene):
    """What is compared: kind and name of the engine's column."""
    for side in SIDES:
        floors = range(1, len(scene[side]["mass"]) + 1)
        yield from (("floor", f"{side}.displacement[{i}]") for i in floors)
        yield from (("sway", f"{side}.foundation.displacement"), ("rocking", f"{side}.foundation.rotation"))


def engine(program):
    file = WORK / "soil.toml"
    file.write_text(SCENE.replace("RECORD", os.path.relpath(RECORD, WORK).replace("\\", "/")))
    rows, _ = p_delta.solve(program, file, ROW, STOP)
    names = [name for _, name in columns(tomllib.loads(SCENE))]
    return np.array([[float(row[name]) for name in names] for row in rows]), rows[-1]["impacts"]


def ground():
    return np.loadtxt(RECORD, delimiter=",", skiprows=5, unpack=True)


def contact_dashpot(scene):
    """Of the Kelvin-Voigt contact, from its restitution [Anagnostopoulos1988]."""
    [contact] = scene["contact"]
    mass = [scene[side]["mass"][contact[f"{side}_floor"] - 1] for side in SIDES]
    log = math.log(contact["restitution"])
    ratio = -log / math.hypot(math.pi, log)
    return 2.0 * ratio * math.sqrt(contact["stiffness"] * mass[0] * mass[1] / sum(mass))


# OpenSees


def frames(ops, scene, step):
    p_delta.begin(ops, "PDelta")
    ops.geomTransf("Linear", 2)
    weights = {}
    for number, side in enumerate(SIDES):
        weights |= frame(ops, scene[side], 100 * (number + 1))
    add_contact(ops, scene)
    p_delta.lay_weights(ops, weights)
    ops.loadConst("-time", 0.0)
    ops.wipeAnalysis()
    times, accelerations = ground()
    ops.timeSeries("Path", 2, "-dt", float(times[1]), "-values", *accelerations.tolist())
    ops.pattern("UniformExcitation", 2, 1, "-accel", 2)
    p_delta.analysis(ops, ("Newmark", 0.5, 0.25), "Transient")
    displacements = [read(ops, scene)]
    for _ in range(round(STOP / ROW)):
        p_delta.go(ops, round(ROW / step), step)
        displacements.append(read(ops, scene))
    return np.array(displacements)


def frame(ops, building, base):
    """Beams whose nodes turn with the foundation, node base + 1; the weights of the floors by node."""
    soil = building["foundation"]
    for node in (base, base + 1):
        ops.node(node, 0.0, 0.0)
    ops.fix(base, 1, 1, 1)
    ops.fix(base + 1, 0, 1, 0)
    ops.mass(base + 1, soil["mass"], 0.0, soil["inertia"])
    for tag, (way, direction) in enumerate([("sway", 1), ("rocking", 6)], start=base):
        ops.uniaxialMaterial("Elastic", tag, soil[way]["stiffness"], soil[way]["dashpot"])
        ops.element("zeroLength", tag, base, base + 1, "-mat", tag, "-dir", direction, "-doRayleigh", 0)
    level, weights = 0.0, {}
    storeys = zip(building["mass"], building["height"], building["stiffness"], building["damping"]["dashpots"])
    for node, (mass, height, stiffness, dashpot) in enumerate(storeys, start=base + 2):
        level += height
        ops.node(node, 0.0, level)
        ops.mass(node, mass, 0.0, 0.0)
        ops.equalDOF(base + 1, node, 3)
        inertia = stiffness * height**3 / (12.0 * YOUNG)
        ops.element("elasticBeamColumn", node, node - 1, node, AXIAL / YOUNG, YOUNG, inertia, 1)
        # A dashpot on the same drift: a beam with next to no stiffness and damping in proportion to it.
        ops.element("elasticBeamColumn", node + 50, node - 1, node, AXIAL / YOUNG * FAINT, YOUNG, FAINT * inertia, 2)
        ops.region(node, "-ele", node + 50, "-rayleigh", 0.0, dashpot / (FAINT * stiffness), 0.0, 0.0)
        weights[node] = GRAVITY * mass
    return weights


def add_contact(ops, scene):
    [contact] = scene["contact"]
    left, right = (100 * number + 1 + contact[f"{side}_floor"] for number, side in enumerate(SIDES, start=1))
    ops.uniaxialMaterial("ViscoelasticGap", 1, contact["stiffness"], contact_dashpot(scene), -contact["gap"])
    ops.element("zeroLength", 1, left, right, "-mat", 1, "-dir", 1, "-doRayleigh", 0)


def read(ops, scene):
    values = []
    for number, side in enumerate(SIDES, start=1):
        node = 100 * number + 1
        values += [ops.nodeDisp(node + i, 1) for i in range(1, len(scene[side]["mass"]) + 1)]
        # OpenSees counts rotations to the left.
        values += [ops.nodeDisp(node, 1), -ops.nodeDisp(node, 3)]
    return values


# SciPy


def matrices(building):
    """M, K, C, load and total displacements of [relative floors, sway, rotation], as textbooks have them."""
    mass, height, stiffness = (np.array(building[key]) for key in ("mass", "height", "stiffness"))
    n, level = len(mass), np.cumsum(height)
    soil = building["foundation"]
    total = np.vstack([np.hstack([np.eye(n), np.ones((n, 1)), level[:, None]]), np.eye(2, n + 2, n)])
    M = total.T @ np.diag([*mass, soil["mass"], soil["inertia"]]) @ total
    drift = np.eye(n, n + 2) - np.eye(n, n + 2, -1)
    lean = drift + np.outer(height, np.eye(n + 2)[n + 1])
    weight = GRAVITY * np.cumsum(mass[::-1])[::-1]
    ends = [np.diag([0.0] * n + [soil[way][key] for way in ("sway", "rocking")]) for key in ("stiffness", "dashpot")]
    K = drift.T @ np.diag(stiffness) @ drift - lean.T @ np.diag(weight / height) @ lean + ends[0]
    C = drift.T @ np.diag(building["damping"]["dashpots"]) @ drift + ends[1]
    return M, K, C, total.T @ np.array([*mass, soil["mass"], 0.0]), total


def textbook(scene):
    parts = [matrices(scene[side]) for side in SIDES]
    M, K, C, total = (block(*(part[index] for part in parts)) for index in (0, 1, 2, 4))
    load, n = np.concatenate([part[3] for part in parts]), len(K)
    [contact] = scene["contact"]
    row = total[contact["left_floor"] - 1] - total[len(parts[0][4]) + contact["right_floor"] - 1]
    dashpot, closed, times_, record = contact_dashpot(scene), [False], *ground()

    def slope(t, y):
        u, v = y[:n], y[n:]
        force = -K @ u - C @ v - load * np.interp(t, times_, record)
        if closed[0]:
            force -= row * (contact["stiffness"] * (row @ u - contact["gap"]) + dashpot * (row @ v))
        return np.concatenate([v, np.linalg.solve(M, force)])

    def touch(t, y):
        return row @ y[:n] - contact["gap"]

    accuracy = {"rtol": TOLERANCE, "atol": 1e-4 * TOLERANCE}
    touch.terminal, y, found = True, np.zeros(2 * n), []
    for t, end in zip(times_, times_[1:]):
        found.append(total @ y[:n])
        if t >= STOP - 1e-9:
            return np.array(found)
        while t < end:
            touch.direction = -1.0 if closed[0] else 1.0
            part = solve_ivp(slope, (t, end), y, "DOP853", events=touch, max_step=LONGEST, **accuracy)
            t, y = part.t[-1], part.y[:, -1]
            closed[0] ^= part.status == 1
    raise SystemExit("the record is shorter than the run")


def block(one, other):
    zeros = np.zeros((len(one), other.shape[1]))
    return np.block([[one, zeros], [np.zeros((len(other), one.shape[1])), other]])


HEADING = """# Soil beside OpenSees and SciPy

Two frames of three and two storeys on foundations that sway and rock, P-delta on both, that collide at their second
floors; El Centro, {stop:g} s, {impacts} impacts. Made by `benchmarks/soil.py`, which has the scene; on {processor}.

* SciPy solves the equations of textbooks, with displacements of floors relative to the foundation and a mass matrix that
  is not diagonal, with a tolerance of {tolerance:.0e} and steps of at most 1 ms; it stops at each entry and release.
* OpenSees has beams whose nodes turn with the foundation, an `elasticBeamColumn` with `PDelta` per storey, `zeroLength`
  springs and dashpots below, `ViscoelasticGap` between. The overturning moment is that of its beams. Steps are fixed, and a
  contact begins and ends with one of them.

Largest differences from the engine at multiples of {row:g} s, of displacements of floors, of foundations, and of their
rotations, each relative to the largest value of the same.

| solver | step, s | floors | sway | rocking |
|---|---|---|---|---|"""

if __name__ == "__main__":
    main()
