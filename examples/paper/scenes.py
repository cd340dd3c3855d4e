"""Scenes as dictionaries: read from their files, changed where a parameter is varied, and run."""

import tomllib
import warnings
from dataclasses import dataclass
from math import pi, sin
from pathlib import Path

import numpy as np
import pounding_fmu

ROOT = Path(__file__).resolve().parents[2]
EL_CENTRO = ROOT / "examples/records/el_centro_1940_ns.csv"
STANDARD_GRAVITY = 9.80665  # m/s2

# Some of the paper's numbers look like slips.
warnings.simplefilter("ignore", pounding_fmu.SceneWarning)


@dataclass
class Run:
    """What a run has left: columns by name, contacts in the order of their start."""

    motion: pounding_fmu.Result
    episodes: np.recarray

    def of_contact(self, contact):
        return self.episodes[self.episodes.contact == contact]

    def peak_force(self, contact=None):
        """N, the largest in one contact or in all; 0 where there was none."""
        episodes = self.episodes if contact is None else self.of_contact(contact)
        return max(episodes.peak_force, default=0.0)


def read(file):
    """A scene file, its record by an absolute path so that it can be run from anywhere."""
    scene = tomllib.loads(file.read_text())
    if "record" in scene.get("ground", {}):
        scene["ground"]["record"] = str((file.parent / scene["ground"]["record"]).resolve())
    return scene


def run(scene, *, step=0.01, stop=None, columns=(), record=None):
    """Runs a scene; `columns` are those of the motion that are wanted, beside `time`."""
    result = pounding_fmu.simulate(scene, step, stop, columns, record=record)
    return Run(result, result.impacts.view(np.recarray))


def frequencies(scene):
    """Hz, of each building alone."""
    names = [name for name in pounding_fmu.variables(scene) if ".frequency[" in name]
    found = pounding_fmu.simulate(scene, stop=0.01, outputs=names)
    return {side: [found[name][0] for name in names if name.startswith(side)] for side in ("left", "right")}


def contacts(law, gap, floors):
    """One contact at each of the lowest floors."""
    return [{"left_floor": floor, "right_floor": floor, "gap": gap, **law} for floor in range(1, floors + 1)]


def shear_building(mass, stiffness, storeys, damping_ratio):
    """Equal floors and equal storeys."""
    return {"mass": [mass] * storeys, "stiffness": [stiffness] * storeys, "damping": {"ratio": damping_ratio}}


def storey_stiffness(mass, period, storeys):
    """N/m that gives a shear building of equal floors and storeys its first period, s.

    Its circular frequencies are 2 sqrt(k/m) sin((2 j - 1) pi/(4 N + 2)).
    """
    return mass * (2 * pi / period / (2 * sin(pi / (4 * storeys + 2)))) ** 2
