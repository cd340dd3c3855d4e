"""Runs one of the Python examples with the packages that it needs.

    python3 examples/run.py examples/plot_run.py

Needs Python 3.11 or later and nothing else. The packages of examples/requirements.txt go into an environment of their
own, target/examples-python, which is made at the first use and again when a list of requirements has changed.
"""

import os
import subprocess
import sys
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
REQUIREMENTS = ROOT / "examples/requirements.txt"
ENVIRONMENT = ROOT / "target/examples-python"
PYTHON = ENVIRONMENT / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
# Written last: an environment without it is not finished.
INSTALLED = ENVIRONMENT / "requirements.installed"


def wanted():
    """All requirements, those of the files included."""
    lines = REQUIREMENTS.read_text().splitlines()
    included = [REQUIREMENTS.parent / line.removeprefix("-r ") for line in lines if line.startswith("-r ")]
    return "\n".join(lines + [file.read_text() for file in included])


def prepare():
    """Makes the environment, unless it is there as it should be."""
    if INSTALLED.exists() and INSTALLED.read_text() == wanted():
        return
    print("making", ENVIRONMENT.relative_to(ROOT), file=sys.stderr)
    venv.create(ENVIRONMENT, clear=True, with_pip=True)
    pip = [PYTHON, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    subprocess.run([*pip, "--requirement", REQUIREMENTS], check=True)
    INSTALLED.write_text(wanted())


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit("usage: python3 examples/run.py EXAMPLE.py [its arguments]")
    prepare()
    sys.exit(subprocess.run([PYTHON, *sys.argv[1:]]).returncode)
