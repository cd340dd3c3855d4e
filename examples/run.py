"""Runs a Python program of this project with the packages that it needs.

    python3 examples/run.py examples/plot_run.py
    python3 examples/run.py examples/paper/all.py
    python3 examples/run.py benchmarks/work_precision.py --quick

Needs Python 3.11 or later and nothing else. The packages of the requirements.txt in the program's folder, or in the
nearest one above it, go into an environment of their own, target/<folder>-python, which is made at the first use and
again when a list of requirements has changed. Those of requirements-optional.txt go there too, where they can be had.
The program can import what lies in its own folder and in that of the requirements.txt.
"""

import os
import signal
import subprocess
import sys
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


class Environment:
    """The packages for the programs of one folder."""

    def __init__(self, folder):
        self.requirements = folder / "requirements.txt"
        self.optional = folder / "requirements-optional.txt"
        self.folder = ROOT / f"target/{folder.name}-python"
        self.python = self.folder / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
        # Written last: an environment without it is not finished.
        self.installed = self.folder / "requirements.installed"

    def wanted(self):
        """All requirements, those of the files included."""
        lines = self.requirements.read_text().splitlines()
        included = [self.requirements.parent / line.removeprefix("-r ") for line in lines if line.startswith("-r ")]
        included += [self.optional] if self.optional.exists() else []
        return "\n".join(lines + [file.read_text() for file in included])

    def prepare(self):
        """Makes the environment, unless it is there as it should be."""
        if self.installed.exists() and self.installed.read_text() == self.wanted():
            return
        print("making", self.folder.relative_to(ROOT), file=sys.stderr)
        venv.create(self.folder, clear=True, with_pip=True)
        pip = [self.python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--requirement"]
        subprocess.run([*pip, self.requirements], check=True)
        if self.optional.exists() and subprocess.run([*pip, self.optional]).returncode != 0:
            print("going on without", self.optional.relative_to(ROOT), file=sys.stderr)
        self.installed.write_text(self.wanted())


def main():
    if len(sys.argv) < 2:
        sys.exit("usage: python3 examples/run.py PROGRAM.py [its arguments]")
    program = Path(sys.argv[1])
    if not program.exists():
        sys.exit(f"{program}: no such file")
    above = [folder for folder in program.resolve().parents if (folder / "requirements.txt").exists()]
    if not above:
        sys.exit(f"{program}: no requirements.txt in its folder or above")
    environment = Environment(above[0])
    try:
        environment.prepare()
    except KeyboardInterrupt:
        sys.exit(130)
    paths = [str(above[0]), *filter(None, [os.environ.get("PYTHONPATH")])]
    variables = {**os.environ, "PYTHONPATH": os.pathsep.join(paths)}
    running = subprocess.Popen([environment.python, *sys.argv[1:]], env=variables)
    # Ctrl-C is the program's: how it ends, this ends.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    code = running.wait()
    sys.exit(128 - code if code < 0 else code)


if __name__ == "__main__":
    main()
