"""The machine and the versions that the figures belong to."""

import importlib.metadata
import os
import platform
import re
import subprocess
from pathlib import Path


def describe():
    lines = [f"{processor()}, {os.cpu_count()} cores, {platform.system()} {platform.machine()}"]
    lines += [first_line([compiler, "--version"]) for compiler in ("rustc", "gcc")] + [
        f"Python {platform.python_version()}"
    ]
    for package in ["heyoka", "scipy", "numpy", "openseespy"]:
        try:
            lines.append(f"{package} {importlib.metadata.version(package)}")
        except importlib.metadata.PackageNotFoundError:
            continue
    return lines


def processor():
    try:
        return re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())[1].strip()
    except (OSError, TypeError):
        return platform.processor() or platform.machine()


def first_line(command):
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()[0]
    except (OSError, subprocess.CalledProcessError):
        return f"{command[0]}: not found"


def write(path, missing, notes):
    lines = describe() + notes + [f"without {name}: {reason}" for name, reason in missing.items()]
    path.write_text("\n".join(lines) + "\n")
