#!/usr/bin/env bash
# A System of SysSimX 0.4.3 (Python package index, 2026) begins every run with a step of length 0.
#
# Expected: FMI 2.0.4, section 4.2.2, wants a communicationStepSize > 0; the first step of a run in steps of 0.5 s is one of 0.5 s.
# Seen: System.initialize makes fmi2DoStep(0, 0) of each FMU to refresh its outputs. An FMU that holds to the standard refuses it, and
# the run ends before it begins. FMUComponent by itself makes no such step.
# (It reads no description that leaves `dependencies` out, which stands for all: so they are written into that of pythonfmu.)
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv python
python/bin/pip install --quiet syssimx==0.4.3 fmpy==0.3.32 pythonfmu==0.7.0
cat > steps.py <<'PYTHON'
from pythonfmu import Fmi2Causality, Fmi2Slave, Real


class Steps(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.shortest = 1e9
        self.register_variable(Real("shortest", causality=Fmi2Causality.output))

    def do_step(self, now, step):
        self.shortest = min(self.shortest, step)
        return True
PYTHON
python/bin/pythonfmu build -f steps.py > built
python/bin/python - <<'PYTHON'
import zipfile

with zipfile.ZipFile("Steps.fmu") as old, zipfile.ZipFile("Whole.fmu", "w") as new:
    for name in old.namelist():
        new.writestr(name, old.read(name).replace(b"<Unknown ", b'<Unknown dependencies="" '))
PYTHON
cat > run.py <<'PYTHON'
from syssimx.components.fmu import FMUComponent
from syssimx.system.system import System

component = FMUComponent("steps", "Whole.fmu")
system = System("one")
system.add_component(component)
system.initialize(t0=0.0)
system.run(t0=0.0, tf=1.0, dt=0.5)
print("shortest step", component.get_outputs()["shortest"])
PYTHON
python/bin/python run.py 2> log | tee said
grep -Eq '^shortest step 0(\.0)?( |$)' said
