"""A building on isolators that hits its moat wall [Komodromos2007]; qualitative, all numbers are choices."""

import functools
from pathlib import Path

import engine
import scenes
from statement import Statement, holds

SCENE = scenes.read(Path(__file__).with_name("scenes") / "isolated.toml")
SOFT, HARD = SCENE["contact"][0]["stiffness"], 10 * SCENE["contact"][0]["stiffness"]  # N/m
ACCELERATION, DISPLACEMENT = "left.peak_acceleration[1]", "left.peak_displacement[1]"  # of the base


@functools.cache
def run(stiffness):
    """Largest acceleration, g, and displacement, m, of the base."""
    scene = {**SCENE, "contact": [{**SCENE["contact"][0], "stiffness": stiffness}]}
    motion = scenes.run(scene, columns=(ACCELERATION, DISPLACEMENT)).motion
    return motion[ACCELERATION][-1] / engine.STANDARD_GRAVITY, motion[DISPLACEMENT][-1]


def statements():
    (soft, near), (hard, far) = run(SOFT), run(HARD)
    return [
        Statement(
            "an isolated building hits a moat wall",
            "accelerations depend on the stiffness of the contact, displacements hardly",
            holds(hard / soft > 1.5 and abs(far / near - 1) < 0.1),
            f"ten times the stiffness: acceleration of the base from {soft:.1f} to {hard:.1f} g, its displacement "
            f"from {1e3 * near:.0f} to {1e3 * far:.0f} mm",
        ),
    ]
