#!/usr/bin/env bash
# A container of fmu-manipulation-toolbox 2.0 (Python package index, 2026) for FMI 3.0 is not valid where an FMU of FMI 2.0 has
# structured names, `mass[1]` and `mass[2]`.
#
# Expected: with `auto_parameter` the container of a valid FMU has its parameters mass[1] and mass[2], with their start values, and is
# valid itself.
# Seen: beside masses.mass[1] and masses.mass[2] stands an array, masses.mass, without the start value that a parameter must have, so
# that FMPy refuses the container. The exit status of fmucontainer is 0. With `-fmi 2` the array is left out, with a line that says
# so, and the container is valid.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv python
python/bin/pip install --quiet fmu-manipulation-toolbox==2.0 fmpy==0.3.32 pythonfmu==0.7.0
cat > masses.py <<'PYTHON'
from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real


class Masses(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.masses = [1.0, 2.0]
        for k in range(2):
            self.register_variable(Real(
                f"mass[{k + 1}]", causality=Fmi2Causality.parameter, variability=Fmi2Variability.fixed,
                getter=lambda k=k: self.masses[k], setter=lambda value, k=k: self.masses.__setitem__(k, value),
            ))
        self.total = 0.0
        self.register_variable(Real("total", causality=Fmi2Causality.output))

    def do_step(self, now, step):
        self.total = sum(self.masses)
        return True
PYTHON
python/bin/pythonfmu build -f masses.py > built
cat > container.json <<'JSON'
{
    "name": "container.fmu", "step_size": 0.5, "fmu": ["Masses.fmu"], "output": [["Masses.fmu", "total", "total"]],
    "auto_link": false, "auto_input": false, "auto_output": false, "auto_parameter": true
}
JSON
cat > look.py <<'PYTHON'
import sys

from fmpy import read_model_description

name, label = sys.argv[1:]
variables = read_model_description(name, validate=False).modelVariables
print(f"{label}: {', '.join(v.name for v in variables if v.causality == 'parameter')}")
try:
    read_model_description(name)
    print(f"{label}: valid")
except Exception as error:
    print(f"{label}: {str(error).splitlines()[-1].strip(' -')}")
PYTHON
{
    python/bin/python look.py Masses.fmu inner
    for version in 2 3; do
        python/bin/fmucontainer -fmu-directory . -container container.json -fmi "$version" > "made$version" 2>&1
        python/bin/python look.py container.fmu "FMI $version"
    done
} | tee said
for line in 'inner: valid' 'FMI 2: masses.mass[1], masses.mass[2]' 'FMI 2: valid' \
    'FMI 3: masses.mass[1], masses.mass[2], masses.mass'; do
    grep -Fxq "$line" said
done
grep -Fq 'FMI 3: Variable "masses.mass"' said
grep -Fq 'has no start value' said
