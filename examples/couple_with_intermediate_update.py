"""A building that another program has, from a master of FMI 3.0: what an input will be at the end of a step.

    "$(ci/environment)" examples/couple_with_intermediate_update.py

FMI 3.0 has no slopes of inputs. It gives the master a turn at the beginning of each step (intermediate update), in which the FMU
asks what its inputs will be at the end of it, and it follows the line between the two. So a correction goes on over a step as it
went over the last one: the present one and the difference of the last two. Beside it a master without a turn, whose corrections are
held over each step, and one FMU that has everything.
"""

import tempfile
from pathlib import Path

import numpy as np
import pounding_fmu
from couple_opensees import RATIO, STIFFNESS, YIELD, Storeys, scene
from fmpy import extract, read_model_description
from fmpy.fmi3 import FMU3Slave

STOP, STEPS = 6.0, [0.005, 0.0025, 0.00125]  # s
FLOORS = range(1, len(STIFFNESS) + 1)


class Buildings:
    """The FMU, and what the other program answers to it."""

    def __init__(self, path, model, has_turns):
        description = read_model_description(path)
        reference = {v.name: v.valueReference for v in description.modelVariables}
        self.inputs = [reference[f"left.storey_correction[{i}]"] for i in FLOORS]
        self.places = [reference[f"left.displacement[{i}]"] for i in FLOORS]
        self.model, self.correction, self.before = model, np.zeros(len(FLOORS)), np.zeros(len(FLOORS))
        self.fmu = FMU3Slave(
            guid=description.instantiationToken,
            unzipDirectory=extract(path),
            modelIdentifier=description.coSimulation.modelIdentifier,
        )
        self.fmu.instantiate(
            intermediateUpdate=self.turn, requiredIntermediateVariables=self.inputs if has_turns else []
        )
        self.fmu.enterInitializationMode(startTime=0.0)
        self.fmu.exitInitializationMode()

    def turn(self, _, time, asks_for_inputs, *__):
        """What the FMU calls at the beginning of a step: inputs at its end."""
        if asks_for_inputs:
            self.fmu.setFloat64(self.inputs, (2.0 * self.correction - self.before).tolist())

    def run(self, step):
        rows = []
        for k in range(round(STOP / step)):
            self.fmu.setFloat64(self.inputs, self.correction.tolist())
            self.fmu.doStep(k * step, step)
            displacements = np.array(self.fmu.getFloat64(self.places))
            shear = np.cumsum(self.model.move(displacements)[::-1])[::-1]
            self.before = self.correction
            self.correction = STIFFNESS * np.diff(displacements, prepend=0.0) - shear
            rows.append(displacements)
        self.fmu.terminate()
        self.fmu.freeInstance()
        return np.array(rows)


def compare():
    """Of each step its errors, held and as lines, relative to the largest displacement."""
    ours = scene() | {"inputs": {"restoring_corrections": True}}
    names = [f"left.displacement[{i}]" for i in FLOORS]
    with tempfile.TemporaryDirectory() as folder:
        path = pounding_fmu.build_fmu(ours, Path(folder, "part.fmu"), fmi=3)
        for step in STEPS:
            whole = pounding_fmu.simulate(scene(yield_force=YIELD, post_yield_ratio=RATIO), step, STOP, names)
            exact = np.column_stack([whole[name][1:] for name in names])
            found = [Buildings(path, Storeys(), has_turns).run(step) for has_turns in (False, True)]
            yield step, *(np.abs(one - exact).max() / np.abs(exact).max() for one in found)


if __name__ == "__main__":
    print("step [ms]   error, held   error, as lines")
    for step, held, lines in compare():
        print(f"{1e3 * step:9.3f}   {held:11.2e}   {lines:15.2e}")
