"""A master that shakes the ground: its accelerogram as an input, held over each step or as a line to the next sample.

FMI 3.0 gives the master a turn at the beginning of each step (intermediate update), in which it says what an input will be
at the end of the step; the FMU follows the line between the two. An accelerogram is such lines, so the motion is that of
the same record inside the FMU, which is what both are compared with.

    "$(ci/environment)" examples/inputs_as_lines.py
"""

import tempfile
import tomllib
from pathlib import Path

import numpy as np
import pounding_fmu
from fmpy import extract, read_model_description
from fmpy.fmi3 import FMU3Slave

SCENE = pounding_fmu.example_scene
RECORD = SCENE.parent.parent / "records/el_centro_1940_ns.csv"
STOP = 20.0  # s


class Frames:
    """The FMU, and the accelerogram at its input."""

    def __init__(self, path, times, accelerations):
        description = read_model_description(path)
        self.reference = {v.name: v.valueReference for v in description.modelVariables}
        self.times, self.accelerations = times, accelerations
        self.fmu = FMU3Slave(
            guid=description.instantiationToken,
            unzipDirectory=extract(path),
            modelIdentifier=description.coSimulation.modelIdentifier,
        )

    def run(self, as_lines):
        """The left roof at each sample, and the number of impacts."""
        ground = [self.reference["ground.acceleration"]]
        self.fmu.instantiate(intermediateUpdate=self.turn, requiredIntermediateVariables=ground if as_lines else [])
        self.fmu.enterInitializationMode(startTime=0.0)
        self.fmu.exitInitializationMode()
        roof = []
        for start, end, acceleration in zip(self.times, self.times[1:], self.accelerations):
            self.fmu.setFloat64(ground, [acceleration])
            self.fmu.doStep(start, end - start)
            roof += self.fmu.getFloat64([self.reference["left.displacement[2]"]])
        impacts = self.fmu.getInt32([self.reference["impacts"]])[0]
        self.fmu.terminate()
        self.fmu.freeInstance()
        return np.array(roof), impacts

    def turn(self, _, time, asks_for_inputs, *__):
        """What the FMU calls within a step."""
        if asks_for_inputs:
            acceleration = np.interp(time, self.times, self.accelerations)
            self.fmu.setFloat64([self.reference["ground.acceleration"]], [acceleration])


def compare():
    """Held, and as lines: error of the roof, relative to its largest displacement, impacts, and those of the record inside."""
    times, accelerations = pounding_fmu.read_record(RECORD)
    times, accelerations = times[times <= STOP], accelerations[times <= STOP]
    inside = pounding_fmu.simulate(SCENE, step=times[1], stop=times[-1])
    truth = inside["left.displacement[2]"][1:]
    scene = tomllib.loads(SCENE.read_text()) | {"ground": {}}
    with tempfile.TemporaryDirectory() as folder:
        path = pounding_fmu.build_fmu(scene, Path(folder, "driven.fmu"), fmi=3)
        for as_lines in (False, True):
            roof, impacts = Frames(path, times, accelerations).run(as_lines)
            yield np.abs(roof - truth).max() / np.abs(truth).max(), impacts, int(inside["impacts"][-1])


if __name__ == "__main__":
    for name, (error, *impacts) in zip(["held", "as lines"], compare(), strict=True):
        print(f"{name:8}   error {error:.1e}   impacts {impacts[0]}, with the record inside {impacts[1]}")
