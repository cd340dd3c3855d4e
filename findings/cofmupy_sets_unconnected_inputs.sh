#!/usr/bin/env bash
# CoFMUPy 1.0.0 (Python package index, 2026) sets every input to 0 that nothing is connected to.
#
# Expected: an input without a connection keeps the start value of the FMU, here 5.
# Seen: it is 0 from the first step on, without a word. Its table has no row for t = 0, and `time` is the beginning of the step at
# whose end the values are.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv python
python/bin/pip install --quiet cofmupy==1.0.0 pythonfmu==0.6.3
cat > echo.py <<'PYTHON'
from pythonfmu import Fmi2Causality, Fmi2Slave, Real


class Echo(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.u, self.heard, self.reached = 5.0, 5.0, 0.0
        self.register_variable(Real("u", causality=Fmi2Causality.input))
        self.register_variable(Real("heard", causality=Fmi2Causality.output))
        self.register_variable(Real("reached", causality=Fmi2Causality.output))

    def do_step(self, now, step):
        self.heard, self.reached = self.u, now + step
        return True
PYTHON
python/bin/pythonfmu build -f echo.py > built
cat > run.py <<'PYTHON'
from cofmupy import Coordinator

coordinator = Coordinator()
coordinator.start({"fmus": [{"id": "echo", "path": "Echo.fmu"}], "connections": []})
for _ in range(2):
    coordinator.do_step(0.5)
results = coordinator.get_results()
for time, reached, heard in zip(results["time"], results["echo", "reached"], results["echo", "heard"]):
    print(f"time {time}: the FMU has reached {reached} and heard {heard}")
PYTHON
python/bin/python run.py | tee said
grep -Fx 'time 0.0: the FMU has reached 0.5 and heard 0.0' said
