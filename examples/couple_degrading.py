"""Storeys that degrade, which the scene cannot have, beside a building that it has: what impacts do to them.

    "$(ci/environment)" examples/couple_degrading.py --picture degrading.png

A storey of the left building yields, softens beyond four yield drifts, and loses stiffness by what it has been through:
reloaded, it heads for its farthest point so far (R. W. Clough's rule). The same building with bilinear storeys, which the
FMU has itself, stands beside the same neighbour in the same ground motion.
"""

import argparse
from pathlib import Path

import numpy as np
import pounding_fmu
from couple_opensees import RATIO, STIFFNESS, YIELD, scene

STEP, SCALE, GAP = 0.0025, 1.3, 0.01  # s, of the ground motion, m
SOFTENS, SLOPE, REST = 4.0, -0.05, 0.3  # yield drifts, of the stiffness from there on, of the strength that stays


class Storey:
    """Force over drift. It heads for its farthest point on either side, and unloads with its first stiffness."""

    def __init__(self, stiffness, strength):
        self.stiffness, self.strength = stiffness, strength
        self.drift, self.shear, self.zero = 0.0, 0.0, 0.0
        self.farthest = {1: strength / stiffness, -1: strength / stiffness}

    def envelope(self, drift):
        """The shear of a storey that is pushed so far for the first time."""
        yielded, cap = self.strength / self.stiffness, SOFTENS * self.strength / self.stiffness
        hardened = self.strength + RATIO * self.stiffness * (min(drift, cap) - yielded)
        return max(hardened + SLOPE * self.stiffness * max(0.0, drift - cap), REST * self.strength)

    def move(self, drift):
        shear = self.shear + self.stiffness * (drift - self.drift)
        if shear * self.shear <= 0.0 and shear != 0.0:
            self.zero = drift - shear / self.stiffness  # here it passes without a force
        side = 1 if shear > 0.0 else -1
        away, zero, farthest = side * drift, side * self.zero, self.farthest[side]
        if away < farthest:
            limit = self.envelope(farthest) * (away - zero) / (farthest - zero)
        else:
            limit, self.farthest[side] = self.envelope(away), max(away, farthest)
        self.drift, self.shear = drift, side * min(abs(shear), max(limit, 0.0))
        return self.shear


class Frame:
    """The building on the left."""

    def __init__(self):
        self.storeys = [Storey(stiffness, strength) for stiffness, strength in zip(STIFFNESS, YIELD)]

    def initial_stiffness(self):
        return STIFFNESS

    def move(self, displacements):
        drifts = np.diff(displacements, prepend=0.0)
        shear = np.array([storey.move(drift) for storey, drift in zip(self.storeys, drifts)])
        return shear - np.append(shear[1:], 0.0)


def runs():
    """The run with storeys that degrade, and that with bilinear ones."""
    wanted = {"ground.scale": SCALE * pounding_fmu.variables(scene())["ground.scale"].start}
    wanted |= {f"contact[{p}].gap": GAP for p in (1, 2, 3)}
    degrading = pounding_fmu.couple(scene(), left=Frame(), step=STEP, how="twice", parameters=wanted)
    bilinear = pounding_fmu.simulate(scene(yield_force=YIELD, post_yield_ratio=RATIO), STEP, parameters=wanted)
    return degrading, bilinear


def drift(run, storey):
    """mm"""
    below = run[f"left.displacement[{storey - 1}]"] if storey > 1 else 0.0
    return 1e3 * (run[f"left.displacement[{storey}]"] - below)


def draw(degrading, bilinear, path):
    """Loops of two storeys with the beginning of each impact, and the floors that meet."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(12, 4), layout="constrained")
    panels = figure.subplots(1, 3, width_ratios=[1, 1, 1.4])
    began = np.searchsorted(degrading["time"], degrading.impacts["start_s"])
    for axes, storey in zip(panels, (1, 3)):
        name = f"left.storey_shear[{storey}]"
        axes.plot(drift(bilinear, storey), bilinear[name] / 1e3, color="0.7", linewidth=0.8, label="bilinear")
        axes.plot(drift(degrading, storey), degrading[name] / 1e3, linewidth=0.9, label="degrading")
        at = drift(degrading, storey)[began], degrading[name][began] / 1e3
        axes.plot(*at, "o", color="tab:red", markersize=4, label="an impact begins")
        axes.set(xlabel="drift [mm]", ylabel="storey shear [kN]", title=f"storey {storey} of the left building")
    panels[0].legend(fontsize=8)
    left, right = (1e3 * degrading[f"{side}.displacement[3]"] for side in ("left", "right"))
    panels[2].plot(degrading["time"], left, linewidth=0.9, label="left floor 3")
    panels[2].plot(degrading["time"], right + 1e3 * GAP, linewidth=0.9, label="right floor 3, plus the gap")
    panels[2].plot(degrading["time"][began], left[began], "o", color="tab:red", markersize=4)
    panels[2].set(xlabel="time [s]", ylabel="displacement [mm]", title="floors 3")
    panels[2].legend(fontsize=8)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--picture", type=Path, help="where the picture goes")
    arguments = parser.parse_args()
    both = runs()
    print("storeys     largest drift of each storey [mm]   residual drift of storey 1 [mm]   impacts")
    for name, run in zip(("degrading", "bilinear"), both):
        largest = "  ".join(f"{1e3 * run[f'left.peak_drift[{storey}]'][-1]:6.1f}" for storey in (1, 2, 3, 4))
        print(f"{name:9}   {largest:33}   {drift(run, 1)[run['time'] > 18.0].mean():31.1f}   {run['impacts'][-1]}")
    if arguments.picture:
        draw(*both, arguments.picture)
