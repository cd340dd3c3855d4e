"""A building that another program has, from any master: with FMPy, inputs that are lines, and states that are saved.

    "$(ci/environment)" examples/couple_with_saved_states.py

What `pounding_fmu.couple` does inside, as a master of FMI 2.0 does it. The FMU has `inputs.restoring_corrections`, and
the initial stiffness of the other program's building. At each communication point it gets what it does not know, storey
by storey: stiffness times drift less the shear that the other program says.

    line   the correction goes on over the step as it went over the last one (fmi2SetRealInputDerivatives)
    twice  the step is tried so; the other program is moved to where that leads, the FMU goes back (fmi2SetFMUState),
           and makes the step again with a line to the correction there

Beside both, one FMU that has everything. No correction is ever iterated: what is left is the corner of a yield within a
step.
"""

import tempfile
from pathlib import Path

import numpy as np
import pounding_fmu
from couple_opensees import FLOORS, STIFFNESS, Storeys, error, inside, scene
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

STOP, STEPS = 6.0, [0.005, 0.0025, 0.00125]  # s
OURS = scene() | {"inputs": {"restoring_corrections": True}}


def correction(model, displacements):
    """What the stiffness of the FMU does not know, N, storey by storey: shears are sums of the forces above."""
    shear = np.cumsum(model.move(displacements)[::-1])[::-1]
    return STIFFNESS * np.diff(displacements, prepend=0.0) - shear


class Buildings:
    """The FMU, and what the other program answers to it."""

    def __init__(self, path, model):
        description = read_model_description(path)
        reference = {v.name: v.valueReference for v in description.modelVariables}
        self.inputs = [reference[f"left.storey_correction[{i}]"] for i in FLOORS]
        self.places = [reference[f"left.displacement[{i}]"] for i in FLOORS]
        self.model, self.correction, self.slope = model, np.zeros(len(FLOORS)), np.zeros(len(FLOORS))
        self.fmu = FMU2Slave(
            guid=description.guid,
            unzipDirectory=extract(path),
            modelIdentifier=description.coSimulation.modelIdentifier,
        )
        self.fmu.instantiate()
        self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def step(self, time, step):
        """Displacements at the end of a step under the present correction and slope."""
        self.fmu.setReal(self.inputs, self.correction.tolist())
        self.fmu.setRealInputDerivatives(self.inputs, [1] * len(FLOORS), self.slope.tolist())
        self.fmu.doStep(time, step)
        return np.array(self.fmu.getReal(self.places))

    def run(self, step, twice):
        """Displacements at all steps, rest at the start included."""
        rows = [np.zeros(len(FLOORS))]
        for k in range(round(STOP / step)):
            state = self.fmu.getFMUState() if twice else None
            displacements = self.step(k * step, step)
            end = correction(self.model, displacements)
            self.slope = (end - self.correction) / step
            if twice:
                self.fmu.setFMUState(state)
                self.fmu.freeFMUState(state)
                displacements = self.step(k * step, step)
            self.correction = end
            rows.append(displacements)
        self.fmu.terminate()
        self.fmu.freeInstance()
        return np.array(rows)


def compare():
    """Of each step its errors, by both ways, relative to the largest displacement."""
    with tempfile.TemporaryDirectory() as folder:
        path = pounding_fmu.build_fmu(OURS, Path(folder, "part.fmu"))
        for step in STEPS:
            found = [Buildings(path, Storeys()).run(step, twice) for twice in (False, True)]
            yield step, *(error(one, inside(step, STOP)) for one in found)


if __name__ == "__main__":
    print("step [ms]   error, line   error, twice")
    for step, line, twice in compare():
        print(f"{1e3 * step:9.3f}   {line:11.2e}   {twice:12.2e}")
