"""What a reader has: a folder, the wheel with its extras, and no compiler."""

import os
import shutil
import subprocess
import sys
import venv
from pathlib import Path

from releasing.commands import run
from releasing.places import CI, ROOT, TARGET

HOME = TARGET / "documents"
SECONDS = 900  # that a block may take
EXTRAS = "plot,study"


class Reader:
    """An environment with the wheel. Blocks run in `folder`, and only what Debian has by itself is on the path."""

    def __init__(self, wheel):
        self.wheel, self.python = wheel.resolve(), HOME / "python/bin/python"
        self.path = HOME / "path"
        self.variables = {
            "PATH": f"{self.python.parent}{os.pathsep}{self.path}",
            "HOME": str(HOME / "home"),
            "MPLBACKEND": "agg",
            "PIP_FIND_LINKS": str(self.wheel.parent),  # `pip install pounding-fmu[plot]` finds the wheel
            "PIP_DISABLE_PIP_VERSION_CHECK": "1",
        }

    def prepare(self):
        shutil.rmtree(self.path, ignore_errors=True)
        self.path.mkdir(parents=True)
        (HOME / "home").mkdir(exist_ok=True)
        # Tools of every system, one by one: the folder where they lie has compilers as well.
        for tool in ("sh", "bash", "cat", "cp", "mkdir", "ls", "sed", "head", "tail", "cut", "sort", "rm", "mv", "env"):
            (self.path / tool).symlink_to(shutil.which(tool))
        if not self.python.exists():
            venv.create(self.python.parents[1], with_pip=True)
        # What the wheel asks for is kept between runs; the wheel itself is always this one.
        install = [self.python, "-m", "pip", "install", "--quiet"]
        run(*install, f"{self.wheel}[{EXTRAS}]", variables=self.variables)
        run(*install, "--no-deps", "--force-reinstall", self.wheel, variables=self.variables)

    def folder(self, page):
        folder = HOME / "pages" / Path(page).with_suffix("").as_posix().replace("/", "-")
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        shutil.copy(self.wheel, folder)
        return folder

    def run(self, kind, text, folder):
        """Exit code and all that a block prints."""
        command = [self.python, "-c", text] if kind == "python" else ["/bin/bash", "-euo", "pipefail", "-c", text]
        # Nothing of this process's surroundings that could help.
        kept = {name: os.environ[name] for name in os.environ if name.startswith(("PIP_", "SSL_", "LANG", "http", "HTTP"))}
        return finished(command, folder, kept | self.variables)


def in_checkout(text):
    return finished(["bash", "-euo", "pipefail", "-c", text], ROOT, dict(os.environ))


def finished(command, folder, variables):
    try:
        done = subprocess.run(
            command,
            cwd=folder,
            env=variables,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            timeout=SECONDS,
        )
    except subprocess.TimeoutExpired as expired:
        return 124, f"not done after {SECONDS} s: {expired.output or ''}"
    return done.returncode, done.stdout


def development_wheel():
    return Path(run(sys.executable, CI / "wheel", "--dev").splitlines()[0])
