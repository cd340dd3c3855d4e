"""A building on isolators in its moat [Komodromos2007]; qualitative, all numbers are choices."""

import functools
from math import pi, sqrt
from pathlib import Path

import scenes
from statement import Statement, holds

SCENE = scenes.read(Path(__file__).with_name("scenes") / "isolated.toml")
STOREYS = range(1, len(SCENE["left"]["mass"]) + 1)  # the first one is that of the isolators
SOFT, HARD = SCENE["contact"][0]["stiffness"], 10 * SCENE["contact"][0]["stiffness"]  # N/m
PERIODS = [1.5, 3.0, 4.0]  # s, on the isolators, beside the 2 s of the scene
ISOLATION = "an isolated building between the walls of its moat"


def columns(quantity):
    return [f"left.peak_{quantity}[{i}]" for i in STOREYS]


@functools.cache
def run(walls=True, stiffness=SOFT, period=None):
    """Largest accelerations, g, displacements, m, and drifts, m, from the base up."""
    building = SCENE["left"] if period is None else with_period(period)
    contacts = [{**contact, "stiffness": stiffness} for contact in SCENE["contact"]] if walls else []
    wanted = {quantity: columns(quantity) for quantity in ("acceleration", "displacement", "drift")}
    scene = {**SCENE, "left": building, "contact": contacts}
    motion = scenes.run(scene, columns=sum(wanted.values(), [])).motion
    acceleration, *others = ([motion[name][-1] for name in names] for names in wanted.values())
    return [largest / scenes.STANDARD_GRAVITY for largest in acceleration], *others


def with_period(period):
    """The building with that period, s, as a rigid body on its isolators, and as much damping relative to critical."""
    left = SCENE["left"]
    omega, isolators = 2 * pi / period, left["stiffness"][0]
    stiffness = sum(left["mass"]) * omega * omega
    dashpot = left["damping"]["dashpots"][0] * sqrt(stiffness / isolators)
    dashpots = [dashpot, *left["damping"]["dashpots"][1:]]
    return {**left, "stiffness": [stiffness, *left["stiffness"][1:]], "damping": {"dashpots": dashpots}}


def statements():
    return [accelerations(), higher_modes(), stiffness_of_the_contact(), flexibility()]


def accelerations():
    (free, _, _), (pounding, _, _) = run(walls=False), run()
    ratios = [with_walls / without for with_walls, without in zip(pounding, free)]
    return Statement(
        ISOLATION,
        "poundings increase floor accelerations substantially, most of all at the base",
        holds(min(ratios) > 2 and max(ratios) == ratios[0]),
        f"base from {free[0]:.2f} to {pounding[0]:.2f} g, roof from {free[-1]:.2f} to {pounding[-1]:.2f} g, the floors "
        f"between {min(ratios[1:-1]):.0f} to {max(ratios[1:-1]):.0f} times as much",
    )


def higher_modes():
    (_, _, free), (_, _, pounding) = run(walls=False), run()
    ratios = [with_walls / without for with_walls, without in zip(pounding[1:], free[1:])]
    return Statement(
        ISOLATION,
        "higher modes are excited: the storeys drift more, instead of moving as a rigid body",
        holds(min(ratios) > 1.5),
        f"{', '.join(f'{ratio:.1f}' for ratio in ratios)} times as much in the storeys above the base, "
        f"{1e3 * pounding[1]:.0f} instead of {1e3 * free[1]:.1f} mm in the lowest",
    )


def stiffness_of_the_contact():
    (soft, near, _), (hard, far, _) = run(), run(stiffness=HARD)
    return Statement(
        ISOLATION,
        "accelerations depend on the stiffness of the contact, displacements hardly",
        holds(hard[0] / soft[0] > 1.5 and abs(far[0] / near[0] - 1) < 0.1),
        f"ten times the stiffness: acceleration of the base from {soft[0]:.1f} to {hard[0]:.1f} g, its displacement "
        f"from {1e3 * near[0]:.0f} to {1e3 * far[0]:.0f} mm",
    )


def flexibility():
    free = [max(run(walls=False, period=period)[0]) for period in PERIODS]
    pounding = [max(run(period=period)[0]) for period in PERIODS]
    listed = "; ".join(
        f"{period:g} s: {without:.2f} and {with_walls:.2f} g"
        for period, without, with_walls in zip(PERIODS, free, pounding)
    )
    return Statement(
        ISOLATION,
        "very flexible isolators, which lower the accelerations, make a building vulnerable where the gap is limited",
        holds(free[-1] < free[0] and pounding[0] == free[0] and pounding[-1] > 2 * free[-1]),
        f"largest acceleration without and with walls at a period of {listed}",
    )


if __name__ == "__main__":
    for statement in statements():
        print(statement)
