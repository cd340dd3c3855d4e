"""The two programs under test, scenes made from the default one, and FMUs held by their C interface."""

import os
import re
import shlex
import subprocess
from ctypes import byref
from pathlib import Path

import numpy as np
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi2 import FMU2Slave, fmi2CallbackLoggerTYPE, fmi2CallbackFunctions
from fmpy.fmi3 import FMU3Slave

ROOT = Path(__file__).resolve().parents[2]
RECORD = ROOT / "examples/records/el_centro_1940_ns.csv"
FEUP = (ROOT / "examples/scenes/feup.toml").read_text()

# tests/python.rs names the programs; by hand they are run through cargo.
CARGO_FMU = [os.environ["CARGO_FMU"]] if "CARGO_FMU" in os.environ else shlex.split("cargo fmu")
SIMULATE = (
    [os.environ["SIMULATE"]]
    if "SIMULATE" in os.environ
    else shlex.split("cargo run --release --quiet --example simulate --")
)


def run(command, *arguments):
    """Runs one of the programs and returns its standard output."""
    result = subprocess.run([*command, *map(str, arguments)], cwd=ROOT, capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    return result.stdout


def scene_with_record(record=RECORD):
    """The default scene, its record by absolute path so that the scene can lie anywhere."""
    return replaced(FEUP, '"../records/el_centro_1940_ns.csv"', f'"{record}"')


def scene_without_record():
    """The default scene with the ground acceleration as an input."""
    return replaced(FEUP, '[ground]\nrecord = "../records/el_centro_1940_ns.csv"\n', "")


def scene_at(path):
    """A scene of the checkout, its record by absolute path."""
    path = ROOT / path
    return re.sub('(?<=record = ")[^"]+', lambda found: str((path.parent / found[0]).resolve()), path.read_text())


def replaced(text, old, new):
    assert old in text, f"the default scene no longer has {old!r}"
    return text.replace(old, new)


def read_record(path=RECORD):
    """Times and accelerations of a record file."""
    return np.loadtxt(path, delimiter=",", comments=("#", "t"), unpack=True)


def write_record(path, times, accelerations):
    """Writes a record file; every number survives unchanged."""
    rows = "".join(f"{t!r},{a!r}\n" for t, a in zip(map(float, times), map(float, accelerations)))
    path.write_text("time_s,accel_m_s2\n" + rows)
    return path


class Fmu:
    """An FMU file, unpacked once."""

    def __init__(self, path, directory):
        self.path = str(path)
        self.directory = extract(self.path, unzipdir=str(directory))
        self.description = read_model_description(self.path)
        self.reference = {v.name: v.valueReference for v in self.description.modelVariables}

    def outputs(self):
        """Names of the outputs in their order."""
        return [v.name for v in self.description.modelVariables if v.causality == "output"]

    def simulate(self, step, stop=20.0, **more):
        """`simulate_fmu` with every output (or those of `output=`) at every communication point."""
        more.setdefault("output", self.outputs())
        return simulate_fmu(self.directory, stop_time=stop, output_interval=step, relative_tolerance=None, **more)

    def instance(self, name="test", guid=None, resources=None):
        """A new instance; what it logs is in its `.messages`."""
        return FMU2Instance(self, name, guid, resources)

    def instance_of_3(self, event_mode, early_return, **updates):
        """A new instance of FMI 3.0 with these flags, and a function for intermediate updates if one is given."""
        return FMU3Instance(self, event_mode, early_return, **updates)


class FMU2Instance(FMU2Slave):
    """An instance with its own logger. FMPy loads the functions that the beginning of the class's name stands for."""

    def __init__(self, fmu, name, guid, resources):
        super().__init__(
            guid=fmu.description.guid if guid is None else guid,
            unzipDirectory=fmu.directory,
            modelIdentifier=fmu.description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        self.fmu = fmu
        self.messages = []
        self.callbacks = fmi2CallbackFunctions()
        self.callbacks.logger = fmi2CallbackLoggerTYPE(
            lambda environment, name, status, category, message: self.messages.append(message.decode())
        )
        uri = Path(fmu.directory, "resources").as_uri() if resources is None else resources
        self.component = self.fmi2Instantiate(
            name.encode(), 1, self.guid.encode(), uri.encode(), byref(self.callbacks), 0, 1
        )

    def start(self, stop=None, **values):
        """Instantiated -> first step; `values` are set before initialization mode."""
        self.setupExperiment(startTime=0.0, stopTime=stop)
        self.set(values)
        self.enterInitializationMode()
        self.exitInitializationMode()
        return self

    def set(self, values):
        for name, value in values.items():
            self.setReal([self.fmu.reference[name]], [value])

    def get(self, *names):
        return np.array(self.getReal([self.fmu.reference[name] for name in names]))

    def steps(self, step, count, first=0):
        """Runs `count` communication steps and returns all displacements at each point."""
        names = [name for name in self.fmu.outputs() if ".displacement[" in name]
        rows = []
        for k in range(first, first + count):
            self.doStep(k * step, (k + 1) * step - k * step)
            rows.append(self.get(*names))
        return np.array(rows)


class FMU3Instance(FMU3Slave):
    """An instance of FMI 3.0, which can go from event to event."""

    def __init__(self, fmu, event_mode, early_return, **updates):
        super().__init__(
            guid=fmu.description.guid,
            unzipDirectory=fmu.directory,
            modelIdentifier=fmu.description.coSimulation.modelIdentifier,
            instanceName="test",
        )
        self.fmu = fmu
        self.instantiate(eventModeUsed=event_mode, earlyReturnAllowed=early_return, **updates)
        outputs = [v for v in fmu.description.modelVariables if v.causality == "output"]
        self.outputs = {
            kind: [v.valueReference for v in outputs if v.type == kind] for kind in ("Float64", "Int32", "Boolean")
        }

    def start(self):
        """Instantiated -> first step, for an instance with Event Mode."""
        self.enterInitializationMode()
        self.exitInitializationMode()
        self.leave_event_mode()
        return self

    def leave_event_mode(self):
        assert not any(self.updateDiscreteStates()[:5])
        self.enterStepMode()

    def bits(self):
        """All outputs, bit for bit."""
        return b"".join(np.array(getattr(self, f"get{kind}")(which)).tobytes() for kind, which in self.outputs.items())

    def go_on(self, step, time=0.0, waits=False):
        """Steps along a grid from an event, if one waits, to the next: where each step has ended, and whether an event waits."""
        while True:
            if waits:
                self.enterEventMode()
                self.leave_event_mode()
                yield time, False
            point = next(k * step for k in range(int(time / step), int(time / step) + 3) if k * step > time)
            waits, is_over, is_early, last = self.doStep(time, point - time)
            assert not is_over and (waits or not is_early)
            time = last if is_early else point
            yield time, waits


def engine(scene, folder, step, stop=20.0, record=None):
    """The engine without FMI: its columns by name."""
    table = folder / "engine.csv"
    more = [] if record is None else ["--record", record]
    run(SIMULATE, scene, "--step", repr(step), "--stop", repr(stop), "--csv", table, *more)
    return np.genfromtxt(table, delimiter=",", names=True, deletechars="", replace_space=" ")
