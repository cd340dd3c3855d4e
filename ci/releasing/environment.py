"""Python environments below target/, each with what lists of requirements say, and made again when a list changes."""

import os
import subprocess
import sys
import venv
from pathlib import Path


def prepare(home: Path, lists: list[Path], optional: Path | None = None) -> Path:
    """The Python of the environment in `home`; without what is optional where that cannot be had."""
    wanted = "".join(text(file) for file in [*lists, *([optional] if optional else [])])
    python = home / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    # Written last: an environment without it is not finished.
    installed = home / "requirements.installed"
    if python.exists() and installed.exists() and installed.read_text() == wanted:
        return python
    print(f"making {home}", file=sys.stderr)
    venv.create(home, clear=True, with_pip=True)
    for file in lists:
        install(python, "--requirement", file)
    if optional and pip(python, "--requirement", optional) != 0:
        print(f"going on without {optional}", file=sys.stderr)
    installed.write_text(wanted)
    return python


def text(file: Path) -> str:
    """A list of requirements with the lists that it includes."""
    lines = file.read_text().splitlines(keepends=True)
    return "".join(text(file.parent / line[3:].strip()) if line.startswith("-r ") else line for line in lines)


def install(python: Path, *what: str | Path) -> None:
    """Installs into an environment, and says what; ends the program where that cannot be done."""
    if pip(python, *what) != 0:
        sys.exit(f"error: pip install {' '.join(map(str, what))}")


def pip(python: Path, *what: str | Path) -> int:
    command = [python, "-m", "pip", "install", "--disable-pip-version-check", "--progress-bar", "off", *what]
    return subprocess.run(command, stdout=sys.stderr).returncode
