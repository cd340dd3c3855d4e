"""A master that reacts to impacts: a brake on the roof of the left frame that grips while the frames touch.

The controller outside the FMU pushes the left roof back with a constant force from the instant at which it touches the
right frame until they part. With Event Mode and early return (FMI 3.0) the step ends at that instant, before anything has
jumped: the master enters Event Mode, reads what has changed, sets the force, and goes on. Beside it runs a master that can
only look at its communication points. The same controller in a step ten times finer is what both are compared with.

    "$(ci/environment)" examples/react_to_impacts.py
"""

import tempfile
from pathlib import Path

import numpy as np
import pounding_fmu
from fmpy import extract, read_model_description
from fmpy.fmi3 import FMU3Slave

PUSH = -20.0  # N
STOP, STEPS = 6.0, [0.01, 0.005, 0.0025, 0.00125]  # s


def scene():
    """The frames of the default scene, 20 mm apart, with a force on every floor."""
    building = {"stiffness": [2910.0] * 2, "damping": {"ratio": 0.01}, "mass": [3.65] * 2}
    contact = {"law": "hertz_damped", "stiffness": 1e6, "restitution": 0.65, "damping_formula": "exact"}
    return {
        "name": "Braked",
        "left": building,
        "right": {"mass": [3.65] * 3, "stiffness": [2910.0] * 3, "damping": {"ratio": 0.01}},
        "ground": {"record": str(pounding_fmu.example_scene.parent.parent / "records/el_centro_1940_ns.csv")},
        "contact": [{"left_floor": i, "right_floor": i, "gap": 0.02, **contact} for i in (1, 2)],
        "inputs": {"floor_forces": True},
    }


class Frames:
    """The FMU, and the controller at its inputs."""

    def __init__(self, path, has_events):
        description = read_model_description(path)
        reference = {v.name: v.valueReference for v in description.modelVariables}
        self.force, self.touches = reference["left.force[2]"], reference["contact[2].active"]
        self.roof, self.impacts = reference["left.displacement[2]"], reference["impacts"]
        self.fmu = FMU3Slave(
            guid=description.instantiationToken,
            unzipDirectory=extract(path),
            modelIdentifier=description.coSimulation.modelIdentifier,
        )
        self.fmu.instantiate(eventModeUsed=has_events, earlyReturnAllowed=has_events)
        self.fmu.enterInitializationMode(startTime=0.0)
        self.fmu.exitInitializationMode()
        if has_events:
            self.go_on()

    def react(self):
        """What the controller does with what it sees."""
        self.fmu.setFloat64([self.force], [PUSH if self.fmu.getBoolean([self.touches])[0] else 0.0])

    def go_on(self):
        """From Event Mode back to stepping."""
        self.fmu.updateDiscreteStates()
        self.fmu.enterStepMode()

    def step(self, time, end):
        """One communication step, however many events it has."""
        while time < end:
            event, _, early, reached = self.fmu.doStep(time, end - time)
            time = reached if early else end
            if event:
                self.fmu.enterEventMode()
                self.react()
                self.go_on()


def run(path, step, stop, has_events):
    """The roof at every 10 ms, and the impacts."""
    frames = Frames(path, has_events)
    roof, every = [], round(0.01 / step)
    for k in range(round(stop / step)):
        if not has_events:
            frames.react()
        frames.step(k * step, (k + 1) * step)
        if (k + 1) % every == 0:
            roof.append(frames.fmu.getFloat64([frames.roof])[0])
    impacts = frames.fmu.getInt32([frames.impacts])[0]
    frames.fmu.terminate()
    frames.fmu.freeInstance()
    return np.array(roof), impacts


def compare(steps, stop):
    """By step: errors relative to the largest displacement, and impacts, of both masters."""
    with tempfile.TemporaryDirectory() as folder:
        path = pounding_fmu.build_fmu(scene(), Path(folder, "braked.fmu"), fmi=3)
        truth, _ = run(path, min(steps) / 10, stop, True)
        for step in steps:
            runs = [run(path, step, stop, has_events) for has_events in (False, True)]
            yield step, *(np.abs(roof - truth).max() / np.abs(truth).max() for roof, _ in runs), *(n for _, n in runs)


if __name__ == "__main__":
    print("step [ms]   error, looking at communication points   error, with events   impacts")
    for step, looking, events, *impacts in compare(STEPS, STOP):
        print(f"{1e3 * step:9.3f}   {looking:38.1e}   {events:18.1e}   {impacts[0]}, {impacts[1]}")
