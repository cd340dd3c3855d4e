"""Two FMUs coupled by a master: two buildings on shared soil, each hitting a wall of its own.

    "$(ci/environment)" examples/couple_two_fmus.py

Floor 1 of each building is its foundation, on a soil spring (its first storey). The soil between the two is a spring
that belongs to neither FMU: this program computes its force from both displacements and hands it to both foundations
as a floor force. It does so in two ways, beside one FMU that holds everything:

    held    the force of each communication point is held over the step: the error falls with the step
    linear  its rate goes with it (fmi2SetRealInputDerivatives), from the foundations' velocities
            (fmi2GetRealOutputDerivatives): the error falls with the square of the step

The impacts need nothing of the master: they happen inside the FMUs.
"""

import tempfile
from pathlib import Path

import numpy as np
import pounding_fmu
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

STOP, STEPS = 6.0, [0.01, 0.005, 0.0025, 0.00125]  # s
SOIL = 8e7  # N/m, between the foundations
# Masses, kg, storey stiffnesses, N/m, and the gap to its wall, m, of each building; the foundation comes first.
BUILDINGS = {
    "One": ([60e3, 50e3, 50e3], [3.0e8, 6.0e7, 5.0e7], 0.010),
    "Two": ([80e3, 60e3, 55e3], [3.5e8, 4.0e7, 3.5e7], 0.015),
}
WALL = (1e9, 1e15)  # kg, N/m: it does not move


def chain(stiffnesses):
    """The stiffness matrix of a shear building."""
    k = np.append(stiffnesses, 0.0)
    return np.diag(k[:-1] + k[1:]) - np.diag(k[1:-1], 1) - np.diag(k[1:-1], -1)


def blocks(matrices):
    """One matrix with others along its diagonal."""
    ends = np.cumsum([0] + [len(matrix) for matrix in matrices])
    whole = np.zeros((ends[-1], ends[-1]))
    for start, end, matrix in zip(ends, ends[1:], matrices):
        whole[start:end, start:end] = matrix
    return whole


def scene(name, buildings, forces, between=None):
    """A scene with these buildings in one matrix on the left and a wall for each on the right."""
    parts = [BUILDINGS[building] for building in buildings]
    masses = np.concatenate([mass for mass, _, _ in parts])
    stiffness = blocks([chain(stiffnesses) for _, stiffnesses, _ in parts])
    # Of every building by itself, so that it is the same in all scenes: 5 % at about 2 and 10 Hz.
    damping = 1.05 * np.diag(masses) + 1.3e-3 * stiffness
    if between:
        (i, j), k = between
        stiffness[[i, j], [i, j]] += k
        stiffness[[i, j], [j, i]] -= k
    tops = np.cumsum([len(mass) for mass, _, _ in parts])
    contact = {"law": "hertz_damped", "stiffness": 1e9, "restitution": 0.65, "damping_formula": "exact"}
    mass, stiffness_of_wall = WALL
    return {
        "name": name,
        "left": {"mass": masses, "stiffness_matrix": stiffness, "damping": {"matrix": damping}},
        "right": {
            "mass": [mass] * len(parts),
            "stiffness_matrix": stiffness_of_wall * np.eye(len(parts)),
            "damping": {"ratio": 0.05},
        },
        "ground": {"record": str(pounding_fmu.example_scene.parent.parent / "records/el_centro_1940_ns.csv")},
        "inputs": {"floor_forces": forces},
        "contact": [
            {"left_floor": int(top), "right_floor": wall, "gap": gap, **contact}
            for wall, (top, (_, _, gap)) in enumerate(zip(tops, parts), start=1)
        ],
    }


class Building:
    """One FMU with what the master needs of it."""

    def __init__(self, path, name):
        description = read_model_description(path)
        identifier = description.coSimulation.modelIdentifier
        self.reference = {v.name: v.valueReference for v in description.modelVariables}
        self.displacement, self.force = self.reference["left.displacement[1]"], self.reference["left.force[1]"]
        self.fmu = FMU2Slave(
            guid=description.guid, unzipDirectory=extract(path), modelIdentifier=identifier, instanceName=name
        )
        self.fmu.instantiate()
        self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def foundation(self):
        """m and m/s."""
        displacement = self.fmu.getReal([self.displacement])[0]
        return np.array([displacement, self.fmu.getRealOutputDerivatives([self.displacement], [1])[0]])

    def push(self, force, rate):
        """N, and N/s if it is to change within the step."""
        self.fmu.setReal([self.force], [force])
        if rate is not None:
            self.fmu.setRealInputDerivatives([self.force], [1], [rate])

    def top(self):
        """m"""
        floors = len([name for name in self.reference if name.startswith("left.displacement")])
        return self.fmu.getReal([self.reference[f"left.displacement[{floors}]"]])[0]


def couple(paths, step, stop, linear):
    """Displacements of foundation and top of both buildings, and all impacts, at each communication point."""
    one, two = (Building(path, name) for name, path in paths.items())
    rows = []
    for k in range(round(stop / step)):
        force, rate = SOIL * (two.foundation() - one.foundation())
        one.push(force, rate if linear else None)
        two.push(-force, -rate if linear else None)
        for building in (one, two):
            building.fmu.doStep(k * step, (k + 1) * step - k * step)
        impacts = sum(building.fmu.getInteger([building.reference["impacts"]])[0] for building in (one, two))
        rows.append([one.foundation()[0], one.top(), two.foundation()[0], two.top(), impacts])
    for building in (one, two):
        building.fmu.terminate()
        building.fmu.freeInstance()
    return np.array(rows)


def compare(steps, stop):
    """By step: largest errors of all displacements relative to the largest one, force held and linear, and impacts."""
    foundations = (0, len(BUILDINGS["One"][0]))
    whole = scene("Whole", BUILDINGS, forces=False, between=(foundations, SOIL))
    names = [f"left.displacement[{floor}]" for floor in (1, 3, 4, 6)]
    with tempfile.TemporaryDirectory() as folder:
        scenes = {name: scene(name, [name], forces=True) for name in BUILDINGS}
        paths = {name: pounding_fmu.build_fmu(scenes[name], Path(folder, f"{name}.fmu")) for name in scenes}
        for step in steps:
            result = pounding_fmu.simulate(whole, step, stop, [*names, "impacts"])
            truth = np.array([result[name][1:] for name in names]).T
            runs = [couple(paths, step, stop, linear) for linear in (False, True)]
            errors = [np.abs(run[:, :4] - truth).max() / np.abs(truth).max() for run in runs]
            yield step, *errors, int(result["impacts"][-1]), *(int(run[-1, 4]) for run in runs)


if __name__ == "__main__":
    print("step [ms]   error, held   error, linear   impacts (one FMU, held, linear)")
    for step, held, linear, *impacts in compare(STEPS, STOP):
        print(f"{1e3 * step:9.3f}   {held:11.2e}   {linear:13.2e}   {', '.join(map(str, impacts))}")
