#!/usr/bin/env bash
# FMPy 0.3.32 (Python package index, 2026) does not take the step that an FMU declares where a run has more than 1000 steps of it.
#
# Expected: simulate_fmu without a word about steps makes those of the FMU's DefaultExperiment, 0.01 s for 20 s: 2001 rows. An
# input that is given every 0.01 s is heard every 0.01 s.
# Seen: the step is doubled, silently, until there are no more than 1000: 1001 rows of 0.02 s. Of an input that changes its sign
# every 0.01 s the FMU hears one sign alone. With output_interval=0.01 both are as expected.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv python
python/bin/pip install --quiet fmpy==0.3.32 pythonfmu==0.7.0
cat > echo.py <<'PYTHON'
from pythonfmu import DefaultExperiment, Fmi2Causality, Fmi2Slave, Real


class Echo(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.u, self.heard = 0.0, 0.0
        self.default_experiment = DefaultExperiment(start_time=0.0, stop_time=20.0, step_size=0.01)
        self.register_variable(Real("u", causality=Fmi2Causality.input))
        self.register_variable(Real("heard", causality=Fmi2Causality.output))

    def do_step(self, now, step):
        self.heard = self.u
        return True
PYTHON
python/bin/pythonfmu build -f echo.py > built
cat > run.py <<'PYTHON'
import numpy as np
from fmpy import simulate_fmu

samples = [(0.01 * k, (-1.0) ** k) for k in range(2001)]
signal = np.array(samples, dtype=[("time", float), ("u", float)])
for more in ({}, {"output_interval": 0.01}):
    result = simulate_fmu("Echo.fmu", input=signal, output=["heard"], **more)
    print(len(result), "rows; heard", sorted(set(result["heard"][1:].round(6))))
PYTHON
python/bin/python run.py | tee said
grep -Fx '1001 rows; heard [np.float64(1.0)]' said
grep -Fx '2001 rows; heard [np.float64(-1.0), np.float64(1.0)]' said
