"""A master that iterates and goes back: a tuned mass damper outside the FMU, on the roof of its left frame.

The force of the damper at the end of a step depends on the motion that it causes. For each step the master saves the
state of the FMU (fmi2GetFMUState), tries a force, goes back (fmi2SetFMUState) and tries a better one, by the secant rule,
until the damper answers with the force that was tried. Within the step the force is linear
(fmi2SetRealInputDerivatives). Beside it runs a master that does not iterate, and both are compared with one FMU in which
the damper is a third floor. The impacts need nothing of the master: they happen inside the FMU.
"""

import tempfile
from pathlib import Path

import numpy as np
import pounding_fmu
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

MASSES, STIFFNESSES = [3.65, 3.65], [2910.0, 2910.0]  # kg and N/m of the left frame
MASS, STIFFNESS, DASHPOT = 0.4, 122.0, 1.4  # kg, N/m, N s/m of the damper: the period of the frame, 10 % of critical
STOP, STEPS = 6.0, [0.008, 0.004, 0.002, 0.001]  # s
TOLERANCE = 1e-9  # N, between the force that was tried and the damper's


def scene(name, masses, stiffnesses, dashpots, forces):
    """The frames of the default scene, the left one with storeys that may be the damper."""
    contact = {"law": "hertz_damped", "stiffness": 1e6, "restitution": 0.65, "damping_formula": "exact"}
    return {
        "name": name,
        "left": {"mass": masses, "stiffness": stiffnesses, "damping": {"dashpots": dashpots}},
        "right": {"mass": [3.65] * 3, "stiffness": [2910.0] * 3, "damping": {"ratio": 0.01}},
        "ground": {"record": str(pounding_fmu.example_scene.parent.parent / "records/el_centro_1940_ns.csv")},
        "contact": [{"left_floor": i, "right_floor": i, "gap": 0.02, **contact} for i in (1, 2)],
        "inputs": {"floor_forces": forces},
    }


class Frames:
    """The FMU and what the master needs of it."""

    def __init__(self, path):
        description = read_model_description(path)
        reference = {v.name: v.valueReference for v in description.modelVariables}
        self.force, self.impacts = reference["left.force[2]"], reference["impacts"]
        self.wanted = [reference[name] for name in ("left.displacement[2]", "left.velocity[2]", "ground.acceleration")]
        identifier = description.coSimulation.modelIdentifier
        self.fmu = FMU2Slave(guid=description.guid, unzipDirectory=extract(path), modelIdentifier=identifier)
        self.fmu.instantiate()
        self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def step(self, time, step, force, rate):
        """Displacement, m, and velocity, m/s, of the roof, and the ground acceleration, m/s2, at the end of a step."""
        self.fmu.setReal([self.force], [force])
        self.fmu.setRealInputDerivatives([self.force], [1], [rate])
        self.fmu.doStep(time, step)
        return self.fmu.getReal(self.wanted)


class Damper:
    """The mass on its spring and dashpot, by the trapezoidal rule: displacement, velocity and acceleration."""

    def __init__(self, ground):
        self.motion, self.force = (0.0, 0.0, -ground), 0.0

    def answer(self, step, roof, velocity, ground):
        """The force on the roof, N, at the end of a step, and the motion there."""
        x, v, a = self.motion
        stiff = STIFFNESS * step**2 / 4 + DASHPOT * step / 2
        free = STIFFNESS * (x + step * v + step**2 / 4 * a - roof) + DASHPOT * (v + step / 2 * a - velocity)
        force = (free - stiff * ground) / (1 + stiff / MASS)
        end = -ground - force / MASS
        return force, (x + step * v + step**2 / 4 * (a + end), v + step / 2 * (a + end), end)


def iterate(frames, damper, time, step):
    """One step whose force is the damper's answer to it; how often it has been tried."""
    state = frames.fmu.getFMUState()
    tries, wrong = [damper.force], []  # N: forces at the end of the step, and how far the answers are from them
    while True:
        roof = frames.step(time, step, damper.force, (tries[-1] - damper.force) / step)
        force, motion = damper.answer(step, *roof)
        wrong.append(force - tries[-1])
        if abs(wrong[-1]) <= TOLERANCE:
            break
        slope = (wrong[-1] - wrong[-2]) / (tries[-1] - tries[-2]) if len(tries) > 1 else -1.0
        tries.append(tries[-1] - wrong[-1] / slope)
        frames.fmu.setFMUState(state)
    frames.fmu.freeFMUState(state)
    damper.force, damper.motion = force, motion
    return len(tries)


def go_on(frames, damper, time, step):
    """One step with the force of its beginning."""
    damper.force, damper.motion = damper.answer(step, *frames.step(time, step, damper.force, 0.0))
    return 1


def run(path, step, how):
    """The roof at each communication point, impacts, and tries per step."""
    frames = Frames(path)
    damper = Damper(frames.fmu.getReal(frames.wanted)[2])
    roof, tries = [], 0
    for k in range(round(STOP / step)):
        tries += how(frames, damper, k * step, (k + 1) * step - k * step)
        roof.append(frames.fmu.getReal(frames.wanted)[0])
    impacts = frames.fmu.getInteger([frames.impacts])[0]
    frames.fmu.terminate()
    frames.fmu.freeInstance()
    return np.array(roof), impacts, tries / len(roof)


def compare(steps):
    """By step: errors of the roof relative to its largest displacement, impacts, and tries per step."""
    dashpots = [2.0, 2.0]
    whole = scene("Whole", [*MASSES, MASS], [*STIFFNESSES, STIFFNESS], [*dashpots, DASHPOT], False)
    with tempfile.TemporaryDirectory() as folder:
        path = pounding_fmu.build_fmu(scene("Frames", MASSES, STIFFNESSES, dashpots, True), Path(folder, "frames.fmu"))
        for step in steps:
            truth = pounding_fmu.simulate(whole, step, STOP, ["left.displacement[2]", "impacts"])
            roof, impacts = truth["left.displacement[2]"][1:], int(truth["impacts"][-1])
            runs = [run(path, step, how) for how in (go_on, iterate)]
            errors = [np.abs(found - roof).max() / np.abs(roof).max() for found, _, _ in runs]
            yield step, *errors, impacts, *(found for _, found, _ in runs), runs[1][2]


if __name__ == "__main__":
    print("step [ms]   error, held   error, iterated   impacts (one FMU, held, iterated)   tries per step")
    for step, held, iterated, *impacts, tries in compare(STEPS):
        counts = ", ".join(map(str, impacts))
        print(f"{1e3 * step:9.3f}   {held:11.2e}   {iterated:15.2e}   {counts:<34}   {tries:.2f}")
