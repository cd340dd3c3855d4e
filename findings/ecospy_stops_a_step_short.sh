#!/usr/bin/env bash
# ecospy 0.7.2 (package index for Python, 2026) ends a step before its goal where steps meet the goal exactly.
#
# Expected: `step_until(1.0)` goes to 1 s where the step is a whole part of that.
# Seen: with steps of 0.25 s it ends at 0.75 s, with 0.125 s at 0.875 s, and asked again it stays there; with 0.1 s it does go to 1 s, or to
# what ten times 0.1 add up to, 0.9999999999999999. A step is taken only if its end is before the goal: steps that rounding leaves
# below it count, steps that meet it do not. `step_for(1.0)` is the same. `step(4)` takes four steps: who needs the time of the end
# counts steps.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv with
with/bin/pip install --quiet ecospy==0.7.2 tbb==2022.3.1 pythonfmu==0.7.0
cat > steps.py <<'PYTHON'
from pythonfmu import Fmi2Causality, Fmi2Slave, Real


class Steps(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.count = 0.0
        self.register_variable(Real("count", causality=Fmi2Causality.output))

    def do_step(self, now, step):
        self.count += 1.0
        return True
PYTHON
with/bin/pythonfmu build -f steps.py > built
cat > run.py <<'PYTHON'
from ecospy import EcosSimulation, EcosSimulationStructure


def reached(step, way, argument):
    structure = EcosSimulationStructure()
    structure.add_model("steps", "Steps.fmu")
    simulation = EcosSimulation(structure=structure, step_size=step)
    simulation.init()
    getattr(simulation, way)(argument)
    found = (simulation.get_time(), simulation.get_real("steps::count"))
    simulation.terminate()
    simulation.free()
    print(f"{way}({argument}), step {step} s: {found[0]} s after {found[1]:g} steps")
    return found


for way in ("step_until", "step_for"):
    assert reached(0.25, way, 1.0) == (0.75, 3.0) and reached(0.125, way, 1.0) == (0.875, 7.0), "it goes to its goal"
    assert reached(0.1, way, 1.0)[1] == 10.0
assert reached(0.25, "step", 4) == (1.0, 4.0)
PYTHON
LD_LIBRARY_PATH="$folder/with/lib" with/bin/python run.py
