"""Which houses of a street block suffer from pounding, those at its ends or those inside [Anagnostopoulos1988]?

His model: each house is one mass, each contact a spring with a dashpot. Two hundred blocks of five houses whose stiffnesses differ
by chance, each under three ground motions, with three gaps. Printed is the largest drift of each house over that without contact:
the median of all, and in how many of a hundred cases it is larger than alone.
"""

import math

import numpy as np
import pounding_fmu
from pounding_fmu.study import motions

HOUSES, BLOCKS, MOTIONS = 5, 200, 3
GAPS = (0.002, 0.005, 0.010)  # m
MASS, PERIOD, UNCERTAIN = 150e3, 0.5, 0.25  # kg; s; standard deviation of the stiffness of a house, relative

stiffness = MASS * (2 * math.pi / PERIOD) ** 2
house = {"mass": [MASS], "stiffness": [stiffness], "damping": {"ratio": 0.05}}
contact = {"left_floor": 1, "right_floor": 1, "gap": 0.0, "law": "kelvin_voigt", "stiffness": 3e8, "restitution": 0.5}
pairs = range(1, HOUSES)
block = {
    "name": "Block",
    "building": [house] * HOUSES,
    "contact": [contact | {"left": f"b{pair}", "right": f"b{pair + 1}"} for pair in pairs],
}
records = [motions.acceleration(seed) for seed in range(MOTIONS)]
factors = np.random.default_rng(1).lognormal(0.0, UNCERTAIN, (BLOCKS, HOUSES))
blocks = {f"b{k + 1}.stiffness[1]": stiffness * factors[:, k] for k in range(HOUSES)}
drifts = [f"b{k + 1}.peak_drift[1]" for k in range(HOUSES)]


def largest_drifts(gap):
    """Of each case and house."""
    gaps = {f"contact[{pair}].gap": gap for pair in pairs}
    return np.concatenate([pounding_fmu.simulate_batch(block, blocks | gaps, drifts, record) for record in records])


alone = largest_drifts(1000.0)
print("gap   ", *(f"{f'house {k + 1}':>12}" for k in range(HOUSES)))
for gap in GAPS:
    ratios = largest_drifts(gap) / alone
    medians, worse = np.median(ratios, axis=0), 100 * (ratios > 1).mean(axis=0)
    print(f"{1e3 * gap:2.0f} mm ", *(f"{median:5.2f} ({share:2.0f} %)" for median, share in zip(medians, worse)))
