"""What a worker of study.py does, on this machine or another: holds FMUs ready and runs cases with them.

Needs FMPy and nothing of this project: FMUs and records come as bytes.
"""

import atexit
import shutil
import tempfile
import threading
from dataclasses import dataclass
from pathlib import Path

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE


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


class Bench:
    """The materials as files, and an instance of each FMU for each thread."""

    def __init__(self, materials, folder):
        self.materials = materials
        self.folder = Path(tempfile.mkdtemp(prefix="study", dir=folder))
        atexit.register(shutil.rmtree, self.folder, ignore_errors=True)
        self.records = {}
        for name, (ending, content, _) in materials.records.items():
            self.records[name] = self.folder / f"{name}{ending}"
            self.records[name].write_bytes(content)
        self.lock = threading.Lock()
        self.unpacked = {}
        self.instances = threading.local()

    def instance(self, scene_id):
        held = self.instances.__dict__.setdefault("held", {})
        if scene_id not in held:
            held[scene_id] = FMU2Instance(*self.unpack(scene_id))
        return held[scene_id]

    def unpack(self, scene_id):
        with self.lock:
            if scene_id not in self.unpacked:
                file = self.folder / f"{scene_id}.fmu"
                file.write_bytes(self.materials.fmus[scene_id])
                folder = extract(str(file), unzipdir=str(self.folder / scene_id))
                self.unpacked[scene_id] = (read_model_description(str(file)), folder)
            return self.unpacked[scene_id]

    def run(self, case):
        """The row of a case; where the run fails, it says why."""
        peak = self.materials.records[case.record_id][2]
        try:
            instance = self.instance(case.scene_id)
            results = instance.run(self.records[case.record_id], case.pga / peak, case.gap, case.stop)
            return {**results, "error": ""}
        except Exception as error:
            self.instances.held.pop(case.scene_id, None)
            return {"error": " ".join(str(error).split()) or type(error).__name__}


class FMU2Instance(FMU2Slave):
    """An instance that is reset for each case: the FMU is loaded once. Its messages become the errors.

    FMPy loads the functions that the beginning of the class's name stands for.
    """

    def __init__(self, description, folder):
        identifier = description.coSimulation.modelIdentifier
        super().__init__(guid=description.guid, unzipDirectory=folder, modelIdentifier=identifier, instanceName="study")
        self.reference = {variable.name: variable.valueReference for variable in description.modelVariables}
        self.said = []
        callbacks = fmi2CallbackFunctions()
        callbacks.logger = fmi2CallbackLoggerTYPE(lambda *message: self.said.append(message[-1].decode()))
        self.instantiate(callbacks=callbacks)
        self.used = False
        named = lambda *ends: [r for name, r in self.reference.items() if name.endswith(ends)]  # noqa: E731
        self.gaps = named("].gap")
        self.forces, self.impulses, self.losses = (
            named(f"].{name}") for name in ("peak_force", "impulse", "dissipated_energy")
        )
        self.storeys = {
            side: sum(name.startswith(f"{side}.peak_drift[") for name in self.reference) for side in ("left", "right")
        }

    def run(self, record, scale, gap, stop):
        """One step over the whole record: events happen inside, and peaks miss nothing."""
        self.said.clear()
        try:
            return self.results(record, scale, gap, stop)
        except Exception as error:
            raise RuntimeError("; ".join(self.said) or str(error)) from error

    def results(self, record, scale, gap, stop):
        if self.used:
            self.reset()
        self.used = True
        self.setString([self.reference["ground.record"]], [str(record)])
        self.setReal([self.reference["ground.scale"]], [scale])
        self.setReal(self.gaps, [gap] * len(self.gaps))
        self.setupExperiment(startTime=0.0, stopTime=stop)
        self.enterInitializationMode()
        self.exitInitializationMode()
        self.doStep(0.0, stop)
        found = {
            "impacts": self.getInteger([self.reference["impacts"]])[0],
            "peak_force_n": max(self.getReal(self.forces)),
            "impulse_n_s": sum(self.getReal(self.impulses)),
            "dissipated_energy_j": sum(self.getReal(self.losses)),
        }
        for side in self.storeys:
            drifts, accelerations = self.peaks(side, "drift"), self.peaks(side, "acceleration")
            found |= {f"{side}_drift_m": max(drifts), f"{side}_acceleration_m_s2": max(accelerations)}
            found[f"{side}_base_shear_n"] = self.getReal([self.reference[f"{side}.peak_base_shear"]])[0]
            found |= {f"{side}_drift_m[{i}]": drift for i, drift in enumerate(drifts, 1)}
            found |= {f"{side}_acceleration_m_s2[{i}]": peak for i, peak in enumerate(accelerations, 1)}
        return found

    def peaks(self, side, what):
        """The largest so far, of each storey or floor."""
        names = (f"{side}.peak_{what}[{i}]" for i in range(1, self.storeys[side] + 1))
        return self.getReal([self.reference[name] for name in names])

    def first_periods(self):
        """s, of each building alone."""
        self.setupExperiment(startTime=0.0)
        self.enterInitializationMode()
        self.exitInitializationMode()
        self.used = True
        return {side: 1.0 / self.getReal([self.reference[f"{side}.frequency[1]"]])[0] for side in self.storeys}


_bench = None
_making = threading.Lock()


def prepare(materials, folder=None):
    """Makes this process ready; once is enough. Its files go into a folder of their own, below `folder` if it is given."""
    global _bench
    with _making:
        if _bench is None or _bench.materials != materials:
            _bench = Bench(materials, folder)


def run_cases(cases, materials=None):
    """The rows of some cases. A worker that is not prepared yet gets the materials with them."""
    if materials is not None:
        prepare(materials)
    return [(case, _bench.run(case)) for case in cases]
