#!/usr/bin/env bash
# The error of FMPy 0.3.32 (Python package index, 2026) for a call that an FMU refuses cannot come out of a pool of processes.
#
# Expected: a worker of concurrent.futures.ProcessPoolExecutor whose FMU says fmi2Error hands the FMICallException on; the other
# runs of the pool go on.
# Seen: the exception is made of one text but wants two arguments, so it cannot be unpickled. The pool breaks: that run and all
# that are still to come end in BrokenProcessPool, which names neither the FMU nor the function.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv python
python/bin/pip install --quiet fmpy==0.3.32
cat > run.py <<'PYTHON'
from concurrent.futures import ProcessPoolExecutor

from fmpy.fmi1 import FMICallException


def run(case):
    if case == 0:
        # As FMPy raises it where a function of an FMU returns fmi2Error.
        raise FMICallException(function="fmi2DoStep", status=3)
    return case


if __name__ == "__main__":
    with ProcessPoolExecutor(max_workers=1) as pool:
        for case in [pool.submit(run, case) for case in range(3)]:
            print(type(case.exception()).__name__)
PYTHON
python/bin/python run.py | tee said
grep -Fq BrokenProcessPool said
! grep -Fq FMICallException said
