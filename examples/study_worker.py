"""What a worker of study.py does, on this machine or another: holds scenes ready and runs cases with them.

FMUs and records come as bytes. Where the Python module pounding_fmu is installed, in the version that made the FMUs, it
runs the cases (study_module.py), else FMPy does (study_fmus.py): the rows are the same.
"""

import atexit
import importlib.metadata
import io
import itertools
import shutil
import tempfile
import threading
import xml.etree.ElementTree
import zipfile
from dataclasses import dataclass
from pathlib import Path

SIDES = ("left", "right")
# Columns by what they are made of: outputs of all contacts, and peaks of all storeys or floors of a building.
OF_CONTACTS = {
    "peak_force_n": ("peak_force", max), "impulse_n_s": ("impulse", sum), "dissipated_energy_j": ("dissipated_energy", sum)
}  # fmt: skip
OF_STOREYS = {"drift_m": "drift", "acceleration_m_s2": "acceleration"}
OF_YIELDING = {"ductility": "ductility", "residual_drift_m": "residual_drift"}


@dataclass(frozen=True)
class Case:
    """One run. Scene and record by name and by a fingerprint of what is in them."""

    scene: str
    scene_id: str
    record: str
    record_id: str
    pga: float  # m/s2
    gap: float  # m, of all contacts
    stop: float  # s


@dataclass(frozen=True)
class Materials:
    """What all cases need, as bytes."""

    fmus: dict  # by scene_id
    records: dict  # by record_id: ending of the file name, its bytes, the largest acceleration in it in m/s2
    with_module: bool  # where it is installed


class Description:
    """What a study needs to know of an FMU, and what it reads out of a run."""

    def __init__(self, content):
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            root = xml.etree.ElementTree.fromstring(archive.read("modelDescription.xml"))
        self.guid, self.tool = root.get("guid"), root.get("generationTool")
        self.names = [variable.get("name") for variable in root.iter("ScalarVariable")]
        self.gaps = self._named("contact[", "].gap")
        self._of_contacts = {what: self._named("contact[", f"].{what}") for what, _ in OF_CONTACTS.values()}
        self._of_storeys = {
            (side, what): self._named(f"{side}.peak_{what}[") for side in SIDES for what in OF_STOREYS.values()
        }
        # Empty where no storey of a building can yield.
        self._of_yielding = {
            (side, what): self._named(f"{side}.{what}[") for side in SIDES for what in OF_YIELDING.values()
        }
        # One building may stand alone, between walls.
        self.sides = [side for side in SIDES if self._of_storeys[side, "acceleration"]]
        self._base_shears = {side: f"{side}.peak_base_shear" for side in self.sides}

    def storeys(self, side):
        return len(self._of_storeys[side, "drift"])

    def _named(self, start, end=""):
        return [name for name in self.names if name.startswith(start) and name.endswith(end)]

    def outputs(self):
        """The names of all variables that a row is made of; the first one is an Integer, the others are Real."""
        lists = [*self._of_contacts.values(), *self._of_storeys.values(), *self._of_yielding.values()]
        return ["impacts", *itertools.chain(*lists), *self._base_shears.values()]

    def row(self, values):
        """The results of a case of the values of these variables at its end."""
        value = dict(zip(self.outputs(), values))
        row = {"impacts": int(value["impacts"])}
        for column, (what, summary) in OF_CONTACTS.items():
            row[column] = summary(value[name] for name in self._of_contacts[what])
        for side in self.sides:
            peaks = {
                column: [value[name] for name in self._of_storeys[side, what]] for column, what in OF_STOREYS.items()
            }
            row |= {f"{side}_{column}": max(of_storeys) for column, of_storeys in peaks.items()}
            row[f"{side}_base_shear_n"] = value[self._base_shears[side]]
            for column, of_storeys in peaks.items():
                row |= {f"{side}_{column}[{i}]": peak for i, peak in enumerate(of_storeys, 1)}
            for column, what in OF_YIELDING.items():
                of_storeys = [abs(value[name]) for name in self._of_yielding[side, what]]
                row |= {f"{side}_{column}": max(of_storeys)} if of_storeys else {}
        return row


def has_module(tool):
    """Whether the module is installed here, of the version that made an FMU."""
    try:
        return tool == f"pounding-fmu {importlib.metadata.version('pounding-fmu')}"
    except importlib.metadata.PackageNotFoundError:
        return False


class Bench:
    """The materials as files, and what runs each scene."""

    def __init__(self, materials, folder):
        self.materials = materials
        self.folder = Path(tempfile.mkdtemp(prefix="study", dir=folder))
        atexit.register(shutil.rmtree, self.folder, ignore_errors=True)
        self.records = {}
        for name, (ending, content, _) in materials.records.items():
            self.records[name] = self.folder / f"{name}{ending}"
            self.records[name].write_bytes(content)
        self.lock = threading.Lock()
        self.runners = {}

    def runner(self, scene_id):
        with self.lock:
            if scene_id not in self.runners:
                content = self.materials.fmus[scene_id]
                file = self.folder / f"{scene_id}.fmu"
                file.write_bytes(content)
                description = Description(content)
                self.runners[scene_id] = runner_class(self.materials, description)(file, description)
            return self.runners[scene_id]

    def run(self, cases, threads):
        """Each case and its row; where the run has failed, the row says why."""
        rows = []
        for (scene_id, record_id, stop), group in itertools.groupby(cases, lambda c: (c.scene_id, c.record_id, c.stop)):
            group = list(group)
            scales = [case.pga / self.materials.records[record_id][2] for case in group]
            gaps = [case.gap for case in group]
            done = self.runner(scene_id).run(self.records[record_id], scales, gaps, stop, threads)
            rows += zip(group, done, strict=True)
        return rows


def runner_class(materials, description):
    """What runs the cases of a scene here. A worker that has not one of the two does not import it."""
    if materials.with_module and has_module(description.tool):
        from study_module import Module

        return Module
    from study_fmus import Fmu

    return Fmu


def failed(text):
    """The row of a case whose run has failed."""
    return {"error": " ".join(text.split())}


_bench = None
_making = threading.Lock()


def prepare(materials, folder=None):
    """Makes this process ready; once is enough. Its files go into a folder of their own, below `folder` if it is given."""
    global _bench
    with _making:
        if _bench is None or _bench.materials != materials:
            _bench = Bench(materials, folder)


def run_cases(cases, materials=None, threads=1):
    """The rows of some cases. A worker that is not prepared yet gets the materials with them."""
    if materials is not None:
        prepare(materials)
    return _bench.run(cases, threads)
