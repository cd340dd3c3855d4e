#!/usr/bin/env bash
# A container of fmu-manipulation-toolbox 2.0 (Python package index, 2026) for FMI 3.0 leaves out the Booleans of an FMU of 2.0.
#
# Expected: `fmucontainer -fmi 3` of an FMU of FMI 2.0 with a Real and a Boolean output, both of them named, has both, or says that
# it cannot.
# Seen: the Boolean is missing in the container, the exit status is 0. With `-fmi 2` it is there.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv python
python/bin/pip install --quiet fmu-manipulation-toolbox==2.0 fmpy==0.3.32 pythonfmu==0.7.0
cat > lamp.py <<'PYTHON'
from pythonfmu import Boolean, Fmi2Causality, Fmi2Slave, Real


class Lamp(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.reached, self.burns = 0.0, False
        self.register_variable(Real("reached", causality=Fmi2Causality.output))
        self.register_variable(Boolean("burns", causality=Fmi2Causality.output))

    def do_step(self, now, step):
        self.reached, self.burns = now + step, True
        return True
PYTHON
python/bin/pythonfmu build -f lamp.py > built
cat > container.json <<'JSON'
{
    "name": "container.fmu", "step_size": 0.5, "fmu": ["Lamp.fmu"],
    "output": [["Lamp.fmu", "reached", "reached"], ["Lamp.fmu", "burns", "burns"]],
    "auto_link": false, "auto_input": false, "auto_output": false, "auto_parameter": false
}
JSON
for version in 2 3; do
    python/bin/fmucontainer -fmu-directory . -container container.json -fmi "$version" > "made$version" 2>&1
    python/bin/python - "$version" <<'PYTHON'
import sys

from fmpy import read_model_description

outputs = [v.name for v in read_model_description("container.fmu", validate=False).modelVariables if v.causality == "output"]
print(f"FMI {sys.argv[1]}: {', '.join(outputs)}")
PYTHON
done | tee said
grep -Fx 'FMI 2: reached, burns' said
grep -Fx 'FMI 3: reached' said
