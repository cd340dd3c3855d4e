#!/usr/bin/env bash
# A block of pathsim-fmi 0.1.1 (Python package index, 2026) shows at t what its FMU reaches at t + dt.
#
# Expected: a scope beside an FMU whose output is the time that it has reached records y(t) = t.
# Seen: the block makes the step from t to t + dt when the clock of PathSim shows t, and hands its result on at once: the scope
# records y(0) = dt and y(t) = t + dt, each sample one step early.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv python
python/bin/pip install --quiet pathsim-fmi==0.1.1 pathsim==0.27.1 fmpy==0.3.32 pythonfmu==0.7.0
cat > clock.py <<'PYTHON'
from pythonfmu import Fmi2Causality, Fmi2Slave, Real


class Clock(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.reached = 0.0
        self.register_variable(Real("reached", causality=Fmi2Causality.output))

    def do_step(self, now, step):
        self.reached = now + step
        return True
PYTHON
python/bin/pythonfmu build -f clock.py > built
cat > run.py <<'PYTHON'
from pathsim import Connection, Simulation
from pathsim.blocks import Scope
from pathsim_fmi import CoSimulationFMU

block, scope = CoSimulationFMU("Clock.fmu", dt=0.25), Scope()
Simulation([block, scope], [Connection(block, scope)], dt=0.25, log=False).run(1.0)
times, (reached,) = scope.read()
for time, value in zip(times, reached):
    print(f"t = {time:.2f}: the FMU has reached {value:.2f}")
PYTHON
python/bin/python run.py | tee said
grep -Fx 't = 0.50: the FMU has reached 0.75' said
! grep -Fx 't = 0.50: the FMU has reached 0.50' said
