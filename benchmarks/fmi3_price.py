"""What FMI 3.0 costs beside FMI 2.0: the default scene through both C interfaces, in turn, in one process.

"$(ci/environment tests/python)" benchmarks/fmi3_price.py            # a minute
"$(ci/environment tests/python)" benchmarks/fmi3_price.py --quick    # seconds: shows that the command works

CARGO_FMU names a `cargo fmu` that has been built before. Without its flags FMI 3.0 may take 1.2 times FMI 2.0.
"""

import argparse
import os
import shlex
import statistics
import subprocess
import tempfile
import time
from ctypes import byref, c_bool, c_double, c_uint32
from pathlib import Path

from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave

ROOT = Path(__file__).resolve().parents[1]
SCENE = ROOT / "examples/scenes/feup.toml"
CARGO_FMU = [os.environ["CARGO_FMU"]] if "CARGO_FMU" in os.environ else shlex.split("cargo fmu")
STEP, COUNT = 0.01, 2000  # s, steps
MOST = 1.2
WAYS = {
    "FMI 3.0": (False, False),
    "FMI 3.0, early returns": (False, True),
    "FMI 3.0, Event Mode": (True, False),
    "FMI 3.0, both": (True, True),
}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        older, newer = (Fmu(Path(folder), version) for version in (2, 3))
        raw = {"FMI 2.0": older.run_of_2} | {
            name: lambda flags=flags: newer.run_of_3(*flags) for name, flags in WAYS.items()
        }
        print(f"{COUNT} steps of {STEP} s, each with all outputs read; medians of processor time and of its ratios")
        print("by the C functions alone, called from Python, which passes more arguments to those of FMI 3.0")
        measure(raw, 3 if options.quick else 31)
        fmpy = {"FMI 2.0": older.simulate} | {
            name: lambda flags=flags: newer.simulate(*flags) for name, flags in WAYS.items()
        }
        print("by FMPy's simulate_fmu")
        ratio = measure(fmpy, 1 if options.quick else 15)["FMI 3.0"]
        verdict = "as asked" if ratio <= MOST else "too much"
        print(f"FMI 3.0 without its flags in FMPy: {ratio:.3f}, {verdict}: at most {MOST}")


def measure(runs, repetitions):
    """Runs all of them in turn, prints the median of each, and returns the median ratio of each to the first."""
    times = {name: [] for name in runs}
    for _ in range(repetitions):
        for name, run in runs.items():
            times[name].append(run())
    first = next(iter(times.values()))
    ratios = {
        name: statistics.median(one / other for one, other in zip(found, first)) for name, found in times.items()
    }
    for name, found in times.items():
        print(f"  {name:24} {1e3 * statistics.median(found):9.2f} ms {ratios[name]:8.3f}")
    return ratios


class Fmu:
    """The default scene in one version of FMI, unpacked."""

    def __init__(self, folder, version):
        path = folder / f"fmi{version}.fmu"
        command = [*CARGO_FMU, SCENE, "--fmi", str(version), "-o", path]
        subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
        self.directory = extract(str(path), unzipdir=str(folder / f"fmi{version}"))
        self.description = read_model_description(self.directory)
        outputs = [v for v in self.description.modelVariables if v.causality == "output"]
        self.outputs = [v.name for v in outputs]
        numbers = [v.valueReference for v in outputs if v.type in ("Real", "Float64")]
        self.references = (c_uint32 * len(numbers))(*numbers)
        self.values = (c_double * len(numbers))()

    def instance(self, kind, **flags):
        instance = kind(
            guid=self.description.guid,
            unzipDirectory=self.directory,
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName="price",
        )
        instance.instantiate(**flags)
        return instance

    def run_of_2(self):
        """s of the processor that the steps have taken, and the outputs after each."""
        instance = self.instance(FMU2Slave)
        instance.setupExperiment(startTime=0.0)
        instance.enterInitializationMode()
        instance.exitInitializationMode()
        component, do_step, get = instance.component, instance.dll.fmi2DoStep, instance.dll.fmi2GetReal
        references, values, count = self.references, self.values, len(self.values)
        begin = time.process_time()
        for k in range(COUNT):
            assert do_step(component, k * STEP, STEP, 1) == 0
            get(component, references, count, values)
        end = time.process_time()
        instance.freeInstance()
        return end - begin

    def run_of_3(self, event_mode, early_return):
        """The same, from event to event where the flags say so, with the outputs on both sides of each."""
        instance = self.instance(FMU3Slave, eventModeUsed=event_mode, earlyReturnAllowed=early_return)
        instance.enterInitializationMode()
        instance.exitInitializationMode()
        if event_mode:
            instance.enterStepMode()
        component, dll = instance.component, instance.dll
        do_step, get, enter, leave = dll.fmi3DoStep, dll.fmi3GetFloat64, dll.fmi3EnterEventMode, dll.fmi3EnterStepMode
        update = dll.fmi3UpdateDiscreteStates
        references, values, count = self.references, self.values, len(self.values)
        event, over, early, last = c_bool(), c_bool(), c_bool(), c_double()
        results = list(map(byref, (event, over, early, last)))
        of_update = list(map(byref, (c_bool(), c_bool(), c_bool(), c_bool(), c_bool(), c_double())))
        begin = time.process_time()
        for k in range(COUNT):
            assert do_step(component, k * STEP, STEP, True, *results) == 0
            get(component, references, count, values, count)
            while event.value or early.value:
                if event.value:
                    enter(component)
                    update(component, *of_update)
                    leave(component)
                    get(component, references, count, values, count)
                    event.value = False
                if early.value:
                    reached = last.value
                    assert do_step(component, reached, (k + 1) * STEP - reached, True, *results) == 0
                    get(component, references, count, values, count)
        end = time.process_time()
        instance.freeInstance()
        return end - begin

    def simulate(self, event_mode=False, early_return=False):
        begin = time.process_time()
        simulate_fmu(
            self.directory,
            model_description=self.description,
            stop_time=COUNT * STEP,
            output_interval=STEP,
            output=self.outputs,
            use_event_mode=event_mode,
            early_return_allowed=early_return,
        )
        return time.process_time() - begin


if __name__ == "__main__":
    main()
