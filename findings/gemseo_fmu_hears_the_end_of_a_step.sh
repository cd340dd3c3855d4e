#!/usr/bin/env bash
# gemseo-fmu 3.1.1 (Python package index, 2026) gives an FMU, at the beginning of a step, the input of its end.
#
# Expected: with do_step=True and an input u(t) = t, the step from 1 to 2 is made with u = 1, as in every co-simulation that holds
# its inputs.
# Seen: it is made with u = 2: the function is asked for its value at the end of the step, of what has not been reached yet.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv python
python/bin/pip install --quiet gemseo-fmu==3.1.1 pythonfmu==0.7.0
cat > echo.py <<'PYTHON'
from pythonfmu import Fmi2Causality, Fmi2Slave, Real


class Echo(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.u, self.heard, self.since = 0.0, 0.0, 0.0
        self.register_variable(Real("u", causality=Fmi2Causality.input))
        self.register_variable(Real("heard", causality=Fmi2Causality.output))
        self.register_variable(Real("since", causality=Fmi2Causality.output))

    def do_step(self, now, step):
        self.heard, self.since = self.u, now
        return True
PYTHON
python/bin/pythonfmu build -f echo.py > built
cat > run.py <<'PYTHON'
from gemseo_fmu.disciplines.fmu_discipline import FMUDiscipline

discipline = FMUDiscipline(
    "Echo.fmu", ["u"], ["heard", "since"], initial_time=0.0, final_time=3.0, time_step=1.0, do_step=True, restart=False,
    validate=False,
)
for _ in range(2):
    result = discipline.execute({"u": lambda time: time})
    print(f"the step from {result['since'][0]} is made with u = {result['heard'][0]}")
PYTHON
python/bin/python run.py | tee said
grep -Fx 'the step from 1.0 is made with u = 2.0' said
