"""A steel frame of fibre sections in OpenSeesPy beside a building of ours.

    pip install pounding-fmu openseespy
    python examples/couple_frame.py

One bay and four storeys of beams and columns whose sections are fibres of Steel02. Its floors move sideways; what else
moves in it, rotations of joints, OpenSees solves by itself. Its initial stiffness over the floors, condensed by moving
each a little, goes into the scene as a matrix. It is no shear building, so that its corrections are forces on floors.
"""

import time as clock

import numpy as np
import openseespy.opensees as ops
import pounding_fmu
from couple_opensees import RECORD, OpenSees

BAY, HEIGHT, STOREYS, MASS = 6.0, 3.2, 4, 60e3  # m, m, kg of a floor
STOP = 12.0  # s


def section(tag, depth, width, flange, web):
    """An I of fibres, m."""
    ops.section("Fiber", tag)
    ops.patch("rect", 1, 3, 1, depth / 2 - flange, -width / 2, depth / 2, width / 2)
    ops.patch("rect", 1, 3, 1, -depth / 2, -width / 2, -depth / 2 + flange, width / 2)
    ops.patch("rect", 1, 8, 1, -depth / 2 + flange, -web / 2, depth / 2 - flange, web / 2)


class Frame(OpenSees):
    """The model, whose floors are moved."""

    def __init__(self):
        ops.wipe()
        ops.model("basic", "-ndm", 2, "-ndf", 3)
        ops.uniaxialMaterial("Steel02", 1, 345e6, 200e9, 0.02, 18.0, 0.925, 0.15)
        section(1, 0.40, 0.40, 0.028, 0.018)  # columns
        section(2, 0.40, 0.18, 0.014, 0.009)  # beams
        ops.geomTransf("Linear", 1)
        ops.beamIntegration("Lobatto", 1, 1, 4)
        ops.beamIntegration("Lobatto", 2, 2, 4)
        for level in range(STOREYS + 1):
            for side in (0, 1):
                ops.node(10 * level + side, side * BAY, level * HEIGHT)
        ops.fix(0, 1, 1, 1)
        ops.fix(1, 1, 1, 1)
        for level in range(1, STOREYS + 1):
            for side in (0, 1):
                ends = 10 * (level - 1) + side, 10 * level + side
                ops.element("forceBeamColumn", 3 * level + side, *ends, 1, 1, "-iter", 50, 1e-12)
            ops.element("forceBeamColumn", 3 * level + 2, 10 * level, 10 * level + 1, 1, 2, "-iter", 50, 1e-12)
            ops.equalDOF(10 * level, 10 * level + 1, 1)
        super().__init__([(10 * level, 1) for level in range(1, STOREYS + 1)])


def scene():
    """The frame, 20 mm beside a shear building of three storeys."""
    right = {"stiffness": [250e6, 230e6, 170e6], "yield_force": [1150e3, 940e3, 540e3], "post_yield_ratio": 0.05}
    law = {"law": "hertz_damped", "damping_formula": "exact", "stiffness": 2.75e9, "restitution": 0.65}
    return {
        "name": "SteelFrame",
        "stop_time": STOP,
        "left": {"mass": [MASS] * STOREYS, "damping": {"ratio": 0.02}},  # its stiffness is the model's
        "right": {"mass": [170e3, 170e3, 130e3], "damping": {"ratio": 0.05}, **right},
        "ground": {"record": str(RECORD), "pga": 6.0},
        "contact": [{"left_floor": i, "right_floor": i, "gap": 0.02, **law} for i in (1, 2, 3)],
    }


if __name__ == "__main__":
    finest = None
    print("how     step [ms]   roof [mm]   largest base shear [kN]   impacts   against the finest   time [s]")
    for how, step in [("twice", 0.00125), ("twice", 0.0025), ("twice", 0.005), ("line", 0.0025), ("line", 0.005)]:
        start = clock.perf_counter()
        run = pounding_fmu.couple(scene(), left=Frame(), step=step, how=how)
        seconds = clock.perf_counter() - start
        roof = run[f"left.displacement[{STOREYS}]"][:: round(0.005 / step)]
        finest = roof if finest is None else finest
        apart = np.abs(roof - finest).max() / np.abs(finest).max()
        peak, shear, impacts = 1e3 * np.abs(roof).max(), run["left.peak_base_shear"][-1] / 1e3, run["impacts"][-1]
        reached = f"{peak:9.2f}   {shear:23.1f}   {impacts:7}"
        print(f"{how:5}   {1e3 * step:9.2f}   {reached}   {apart:18.1e}   {seconds:8.1f}")
