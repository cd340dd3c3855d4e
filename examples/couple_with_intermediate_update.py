"""A building that another program has, from a master of FMI 3.0: what an input will be at the end of a step.

    "$(ci/environment)" examples/couple_with_intermediate_update.py

FMI 3.0 has no slopes of inputs. It gives the master a turn at the beginning of each step (intermediate update), in
which the FMU asks what its inputs will be at the end of it, and it follows the line between the two. So a correction
goes on over a step as it went over the last one: the present one and the difference of the last two. Beside it a master
without a turn, whose corrections are held over each step, and one FMU that has everything.
"""

import tempfile
from pathlib import Path

import numpy as np
import pounding_fmu
from couple_opensees import FLOORS, Storeys, error, inside
from couple_with_saved_states import OURS, STEPS, STOP, correction
from fmpy import extract, read_model_description
from fmpy.fmi3 import FMU3Slave


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
        asked = self.inputs if has_turns else []
        self.fmu.instantiate(intermediateUpdate=self.turn, requiredIntermediateVariables=asked)
        self.fmu.enterInitializationMode(startTime=0.0)
        self.fmu.exitInitializationMode()

    def turn(self, _, time, asks_for_inputs, *__):
        """What the FMU calls at the beginning of a step: inputs at its end."""
        if asks_for_inputs:
            self.fmu.setFloat64(self.inputs, (2.0 * self.correction - self.before).tolist())

    def run(self, step):
        """Displacements at all steps, rest at the start included."""
        rows = [np.zeros(len(FLOORS))]
        for k in range(round(STOP / step)):
            self.fmu.setFloat64(self.inputs, self.correction.tolist())
            self.fmu.doStep(k * step, step)
            rows.append(np.array(self.fmu.getFloat64(self.places)))
            self.before, self.correction = self.correction, correction(self.model, rows[-1])
        self.fmu.terminate()
        self.fmu.freeInstance()
        return np.array(rows)


def compare():
    """Of each step its errors, held and as lines, relative to the largest displacement."""
    with tempfile.TemporaryDirectory() as folder:
        path = pounding_fmu.build_fmu(OURS, Path(folder, "part.fmu"), fmi=3)
        for step in STEPS:
            found = [Buildings(path, Storeys(), has_turns).run(step) for has_turns in (False, True)]
            yield step, *(error(one, inside(step, STOP)) for one in found)


if __name__ == "__main__":
    print("step [ms]   error, held   error, as lines")
    for step, held, lines in compare():
        print(f"{1e3 * step:9.3f}   {held:11.2e}   {lines:15.2e}")
