"""Runs of the engine (the example `simulate`) for the pictures: any scene, as it is or without its contacts."""

import csv
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from engine import ROOT, program


class Run:
    """What the engine made of a scene: columns by name, and its table of impacts."""

    def __init__(self, columns, impacts):
        self.columns, self.impacts = columns, impacts
        self.time = columns["time"]

    def __getitem__(self, name):
        return self.columns[name]

    def of_contact(self, contact):
        """The impacts of one contact, which are counted from 1."""
        return [impact for impact in self.impacts if impact["contact"] == contact]

    def hardest(self, contact=None):
        """The impact with the largest force; of rigid floors, which have none, that with the largest impulse."""
        impacts = self.impacts if contact is None else self.of_contact(contact)
        return max(impacts, key=lambda impact: (impact["peak_force"], impact["impulse"]), default=None)


def simulate(scene, step, *flags, **options):
    """Runs the engine: a row every `step` s. Flags and options are those of `simulate`, such as rows_per_impact=24."""
    with tempfile.TemporaryDirectory() as folder:
        motion, impacts = Path(folder, "motion.csv"), Path(folder, "impacts.csv")
        command = [program(), scene.path, "--step", repr(float(step)), "--csv", motion, "--impacts", impacts, *flags]
        for option, value in options.items():
            command += [] if value is None else [f"--{option.replace('_', '-')}", str(value)]
        run_or_stop(command)
        with motion.open() as lines:
            names = next(lines).strip().split(",")
            columns = np.loadtxt(lines, delimiter=",", unpack=True, ndmin=2)
        return Run(dict(zip(names, columns)), read_impacts(impacts))


def run_or_stop(command):
    """Runs a program of this project; where it fails it has said why."""
    code = subprocess.run([str(part) for part in command], cwd=ROOT, stdout=subprocess.DEVNULL).returncode
    if code != 0:
        raise SystemExit(code)


def read_impacts(path):
    """One dictionary of numbers for each impact; an open one ends at nan."""
    with path.open() as lines:
        return [
            {name: int(cell) if name == "contact" else float(cell or "nan") for name, cell in row.items()}
            for row in csv.DictReader(lines)
        ]


def simulate_finely(scene, **options):
    """The scene with its impacts in full and without contacts: as many rows as a picture can use and memory holds."""
    coarse = simulate(scene, 0.02, **options)
    most_rows = 2e7 / len(coarse.columns)
    step = max(1e-3, 2 * coarse.time[-1] / most_rows)
    within = int(min(32, most_rows / 2 / max(1, len(coarse.impacts)) - 5))
    fine = simulate(scene, step, rows_per_impact=max(0, within), **options)
    return fine, simulate(scene, step, "--without-contacts", **options)
