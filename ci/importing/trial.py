"""An importer with each of the FMUs, beside what FMPy gets of the same FMU."""

import json
import subprocess
import sys
import tempfile
import venv
from pathlib import Path

from importing import one
from releasing import environment
from releasing.places import CI, TARGET

TRIED = CI / "importing/tried"

# All packages are those of this day, but for the importers themselves, each of which has its version in its file.
DAY = "2026-11-28"
PIP = "pip==26.3"

# A run to 20 s in steps of 0.01 s. Counts have to be the same, peaks within the tolerance of their size: they do not depend on
# the steps, so that not even an importer with steps of its own has a reason for more.
NAMES = ["impacts", "contact[2].peak_force", "right.peak_drift[1]"]
STEP, STOP = 0.01, 20.0
TOLERANCE = 1e-9

# m: what the gap is set to at both contacts, where it can be set.
GAPS = [0.02, 0.05, 0.11]

# s
LIMIT = 600


class Failure(Exception):
    """An importer that does not run the FMU, and why."""


def importers(names):
    """The files of all importers, or of some, by their names without `.py`."""
    files = {file.stem: file for file in sorted(TRIED.glob("*.py"))}
    unknown = sorted(set(names) - set(files))
    if unknown:
        sys.exit(f"error: {', '.join(unknown)}: expected {', '.join(files)}")
    return [files[name] for name in names or files]


def prepare(importer):
    """The Python of an importer."""
    home = TARGET / "importers" / importer.NAME
    python, done = home / "bin/python", home / "done"
    wanted = "\n".join([PIP, DAY, *importer.PACKAGES])
    if done.exists() and done.read_text() == wanted:
        return python
    venv.create(home, clear=True, with_pip=True)
    dated = ["--quiet", "--uploaded-prior-to", DAY, *importer.PACKAGES]
    if environment.pip(python, "--quiet", PIP) != 0 or (importer.PACKAGES and environment.pip(python, *dated) != 0):
        raise Failure("it cannot be installed")
    done.write_text(wanted)
    return python


def values(python, file, fmu, gap=None):
    """What it reads at the end, with this gap at both contacts."""
    parameters = {} if gap is None else {f"contact[{p}].gap": gap for p in (1, 2)}
    wanted = json.dumps({"names": NAMES, "values": parameters, "step": STEP, "stop": STOP})
    with tempfile.TemporaryDirectory() as folder:
        command = [python, "-P", CI / "importing/one.py", file, fmu, wanted]
        try:
            done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=LIMIT)
        except subprocess.TimeoutExpired:
            raise Failure(f"it has not come to its end in {LIMIT} s") from None
    found = [line for line in done.stdout.splitlines() if line.startswith("values ")]
    if done.returncode != 0 or not found:
        said = (done.stderr.strip() or done.stdout.strip() or f"exit status {done.returncode}").splitlines()
        raise Failure(said[-1])
    return json.loads(found[-1].removeprefix("values "))


def compare(found, expected, tolerance):
    """Nothing where it is what FMPy gets."""
    for name, one_value, other in zip(NAMES, found, expected, strict=True):
        most = 0.0 if name == "impacts" else tolerance * abs(other)
        if not abs(one_value - other) <= most:
            raise Failure(f"{name} = {one_value!r}, where FMPy has {other!r}")


def trial(file, fmus, reference, say):
    """What comes of each FMU, by its kind, and of setting the gap: `runs`, `no`, or nothing where that is not asked."""
    importer = one.load(file)
    python, tolerance = prepare(importer), getattr(importer, "TOLERANCE", TOLERANCE)
    outcome = {}
    for kind, fmu in fmus.items():
        outcome[kind] = attempt(f"{importer.NAME}, {kind}", say, lambda: compare(
            values(python, file, fmu), reference(kind, None), tolerance
        ))
    taken = next((kind for kind, what in reversed(outcome.items()) if what == "runs"), None)
    if taken:
        outcome["gap"] = attempt(f"{importer.NAME}, gaps", say, lambda: [
            compare(values(python, file, fmus[taken], gap), reference(taken, gap), tolerance) for gap in GAPS
        ])
    return outcome


def attempt(what, say, work):
    try:
        work()
    except Failure as failure:
        say(f"{what}: no, {failure}")
        return "no"
    say(f"{what}: runs")
    return "runs"
