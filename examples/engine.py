"""Runs of the engine without FMI, for the programs in this folder: the example `simulate`, and its tables."""

import csv
import functools
import json
import os
import re
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
EL_CENTRO = ROOT / "examples/records/el_centro_1940_ns.csv"
STANDARD_GRAVITY = 9.80665  # m/s2


@dataclass(frozen=True)
class Episode:
    """One contact, as the engine's table of impacts has it; `end_s` is None where it was still open."""

    contact: int
    start_s: float
    end_s: float | None
    approach_velocity: float
    separation_velocity: float
    peak_force: float
    peak_time_s: float
    peak_penetration: float
    impulse: float
    dissipated_energy: float


@dataclass
class Run:
    """What a run has left: columns by name, contacts in the order of their start, natural frequencies in Hz."""

    motion: dict
    episodes: list
    frequencies: dict

    def of_contact(self, contact):
        return [episode for episode in self.episodes if episode.contact == contact]

    def peak_force(self, contact=None):
        """N, the largest in one contact or in all; 0 where there was none."""
        episodes = self.episodes if contact is None else self.of_contact(contact)
        return max((episode.peak_force for episode in episodes), default=0.0)


@functools.cache
def program():
    """The engine's program. SIMULATE names one that is built already."""
    if "SIMULATE" in os.environ:
        return os.environ["SIMULATE"]
    command = ["cargo", "build", "--release", "--quiet", "--example", "simulate"]
    command.append("--message-format=json-render-diagnostics")
    built = subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True)
    messages = map(json.loads, built.stdout.splitlines())
    return next(message["executable"] for message in messages if message.get("executable"))


def simulate(scene, *, step=0.01, stop=None, columns=(), folder=None):
    """Runs a scene, a file or a text; `columns` are those of the motion that are wanted, beside `time`.

    A text names its record by an absolute path. The tables go into a folder of their own unless one is named.
    """
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(folder or temporary)
        folder.mkdir(parents=True, exist_ok=True)
        if isinstance(scene, str):
            (folder / "scene.toml").write_text(scene)
            scene = folder / "scene.toml"
        motion, impacts = folder / "motion.csv", folder / "impacts.csv"
        command = [program(), scene, "--step", repr(float(step)), "--impacts", impacts]
        command += ["--stop", repr(float(stop))] if stop else []
        command += ["--csv", motion] if columns else []
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"{scene}: {done.stderr.strip()}")
        return Run(read_motion(motion, columns) if columns else {}, read_impacts(impacts), frequencies(done.stdout))


def read_motion(file, columns):
    with file.open() as lines:
        names = next(lines).strip().split(",")
        wanted = ["time", *columns]
        numbers = np.loadtxt(lines, delimiter=",", unpack=True, ndmin=2, usecols=[names.index(name) for name in wanted])
        return dict(zip(wanted, numbers))


def read_impacts(file):
    with file.open() as lines:
        rows = list(csv.DictReader(lines))
    number = lambda row: {name: float(value) if value else None for name, value in row.items()}  # noqa: E731
    return [Episode(**{**number(row), "contact": int(row["contact"])}) for row in rows]


def frequencies(printed):
    """Hz, of each building alone, from what the program prints."""
    lines = re.findall(r"(left|right) frequencies: (.*) Hz", printed)
    return {side: [float(number) for number in numbers.split(", ")] for side, numbers in lines}
