#!/usr/bin/env bash
# libcosimpy 0.0.6 (package index for Python, 2026) makes one more step towards a time that has been reached.
#
# Expected: `simulate_until` stops at its goal. Asked again for the same time, or for one that has passed, it does nothing, or says that
# there is nothing to do.
# Seen: with steps of 0.25 s the first call for 1 s ends at 1 s after four steps. The second call for 1 s ends at 1.25 s, the third at
# 1.5 s, and one for 0.5 s at 1.75 s; each returns that it has succeeded. Goals between two steps are passed by the rest of a step,
# which is to be expected of a fixed step; so whoever calls it from a loop with goals closer together than its steps is ahead of them
# by more and more. Ask for the next goal only where `status().current_time` is before it.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv with
with/bin/pip install --quiet libcosimpy==0.0.6 pythonfmu==0.7.0
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
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

SECOND = 1_000_000_000  # ns

execution = CosimExecution.from_step_size(step_size=SECOND // 4)
slave = execution.add_local_slave(CosimLocalSlave(fmu_path="Steps.fmu", instance_name="steps"))
observer = CosimObserver.create_last_value()
execution.add_observer(observer=observer)
seen = []
for goal in (SECOND, SECOND, SECOND, SECOND // 2):
    succeeded = execution.simulate_until(target_time=goal)
    (count,) = observer.last_real_values(slave_index=slave, variable_references=[0])
    seen.append((goal / SECOND, succeeded, execution.status().current_time / SECOND, count))
    print("goal %g s, succeeded %s, time %g s, %g steps" % seen[-1])
assert [(time, count) for _, _, time, count in seen] == [(1.0, 4.0), (1.25, 5.0), (1.5, 6.0), (1.75, 7.0)], "it stops at its goal"
assert all(succeeded for _, succeeded, _, _ in seen)
PYTHON
with/bin/python run.py
