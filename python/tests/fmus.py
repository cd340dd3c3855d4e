"""Scenes of the examples, and their FMUs as FMPy drives them."""

import os
import zipfile
from pathlib import Path

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
SCENES = sorted([*EXAMPLES.glob("scenes/*.toml"), *EXAMPLES.glob("paper/scenes/*.toml")])
FEUP = EXAMPLES / "scenes/feup.toml"
RECORD = EXAMPLES / "records/el_centro_1940_ns.csv"

# As cargo fmu makes them, with the library for this machine alone.
REFERENCES = Path(os.environ["REFERENCE_FMUS"])


def libraries(fmu):
    """The platforms of an FMU, and their libraries."""
    with zipfile.ZipFile(fmu) as archive:
        return {name.split("/")[1]: archive.read(name) for name in archive.namelist() if name.startswith("binaries/")}


(HOST,) = libraries(REFERENCES / "feup.fmu")


def feup(old="", new=""):
    """The text of the default scene, its record by absolute path, with a change."""
    text = FEUP.read_text().replace("../records/el_centro_1940_ns.csv", str(RECORD))
    assert old in text
    return text.replace(old, new)


def without_record():
    """The default scene with the ground acceleration as an input."""
    return feup(f'[ground]\nrecord = "{RECORD}"\n')


class Fmu:
    """An FMU, unpacked once."""

    def __init__(self, path, folder):
        self.description = read_model_description(str(path))
        self.folder = extract(str(path), unzipdir=str(folder))

    def run(self, times, parameters=None):
        """Every numeric variable at each time, by name."""
        rows = {v.name: [] for v in self.description.modelVariables if v.type != "String"}
        slave = FMU2Slave(
            guid=self.description.guid,
            unzipDirectory=self.folder,
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName="test",
        )
        slave.instantiate()
        slave.setupExperiment(startTime=0.0)
        references = {v.name: v.valueReference for v in self.description.modelVariables}
        for name, value in (parameters or {}).items():
            if isinstance(value, str):
                slave.setString([references[name]], [value])
            else:
                slave.setReal([references[name]], [value])
        slave.enterInitializationMode()
        slave.exitInitializationMode()
        get = {"Real": slave.getReal, "Integer": slave.getInteger, "Boolean": slave.getBoolean}
        for before, time in zip([None, *times], times):
            if before is not None:
                slave.doStep(before, time - before)
            for kind, read in get.items():
                of_kind = [v for v in self.description.modelVariables if v.type == kind]
                for variable, value in zip(of_kind, read([v.valueReference for v in of_kind])):
                    rows[variable.name].append(value)
        slave.terminate()
        slave.freeInstance()
        return {name: np.array(values) for name, values in rows.items()}


def same_bits(one, other):
    """Whether two columns are the same numbers, sign of zero and NaN included."""
    one, other = np.asarray(one, dtype=np.float64), np.asarray(other, dtype=np.float64)
    return one.shape == other.shape and one.tobytes() == other.tobytes()
