"""One free impact under any law: what scenes/free_impact.toml becomes when the law is replaced."""

import functools
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import scenes

SCENE = scenes.read(Path(__file__).with_name("scenes") / "free_impact.toml")
MASSES = SCENE["left"]["mass"][0], SCENE["right"]["mass"][0]
REDUCED_MASS = MASSES[0] * MASSES[1] / sum(MASSES)  # kg
SPEED = SCENE["left"]["initial_velocity"][0]  # m/s
STIFFNESS = SCENE["contact"][0]["stiffness"]  # N/m^n
RESTITUTION = 0.5
EXPONENT = 1.5
POINTS = 2000  # of the curve of one contact

# What the paper's equations are called in a scene.
EQUATION_10, EQUATION_11 = "lankarani_nikravesh", "ye_printed"
# Eq. 14 can be read in two ways, with a spring 3 k / 2 or with a spring k.
EQUATION_14_SPRING, EQUATION_14_DAMPER = "barros_khatami", "barros_khatami_damper"

KEYS = {
    "stereomechanical": ["restitution"],
    "linear": ["stiffness"],
    "kelvin_voigt": ["stiffness", "restitution"],
    "kelvin_voigt_no_tension": ["stiffness", "restitution"],
    "hertz": ["stiffness", "exponent"],
    "jankowski": ["stiffness", "restitution"],
}


def contact_law(name, stiffness=STIFFNESS, exponent=EXPONENT, restitution=RESTITUTION):
    """The keys of a contact under a law, or under `hertz_damped` with the formula of that name."""
    numbers = {"stiffness": stiffness, "exponent": exponent, "restitution": restitution}
    if name in KEYS:
        return {"law": name, **{key: numbers[key] for key in KEYS[name]}}
    return {"law": "hertz_damped", "damping_formula": name, **numbers}


@dataclass
class Impact:
    """Numbers of one contact, in SI units; times from its beginning."""

    restitution: float
    duration: float
    peak_force: float
    peak_force_time: float
    deepest: float
    deepest_time: float
    first_force: float  # just after the beginning
    last_force: float  # just before the end
    least_force: float
    dissipated: float  # as the engine integrates it
    kinetic_loss: float  # from the velocities before and after
    loop_area: float  # of the curve below
    time: np.ndarray
    penetration: np.ndarray
    force: np.ndarray


@functools.cache
def run(name, *, speed=SPEED, **law):
    """The impact under a law; what is not given is as in the scene."""
    scene = {**SCENE, "left": {**SCENE["left"], "initial_velocity": [speed]}}
    scene["contact"] = [{**scenes.contacts(contact_law(name, **law), SCENE["contact"][0]["gap"], 1)[0]}]
    episode = scenes.run(scene, stop=scene["contact"][0]["gap"] / speed + 1.0).episodes[0]
    kinetic = lambda velocity: 0.5 * REDUCED_MASS * velocity**2  # noqa: E731
    loss = kinetic(episode.approach_velocity) - kinetic(episode.separation_velocity)
    duration = episode.end_s - episode.start_s
    time, penetration, force, velocity = curve(scene, episode)
    turn = np.argmax(velocity <= 0)
    share = velocity[turn - 1] / (velocity[turn - 1] - velocity[turn]) if turn else 0.0
    return Impact(
        restitution=episode.separation_velocity / episode.approach_velocity,
        duration=duration,
        peak_force=episode.peak_force,
        peak_force_time=episode.peak_time_s - episode.start_s,
        deepest=episode.peak_penetration,
        deepest_time=time[turn - 1] + share * (time[turn] - time[turn - 1]),
        first_force=force[0],
        last_force=force[-1],
        least_force=force.min(),
        dissipated=episode.dissipated_energy,
        kinetic_loss=loss,
        loop_area=np.trapezoid(force, penetration),
        time=time,
        penetration=penetration,
        force=force,
    )


def loss(name, restitution, speed=SPEED):
    """J, what the engine says one impact dissipates."""
    scene = {**SCENE, "left": {**SCENE["left"], "initial_velocity": [speed]}}
    scene["contact"] = scenes.contacts(contact_law(name, restitution=restitution), SCENE["contact"][0]["gap"], 1)
    return scenes.run(scene, stop=scene["contact"][0]["gap"] / speed + 1.0).episodes[0].dissipated_energy


def curve(scene, episode):
    """Time from the beginning, penetration, force and approach velocity, from just after the beginning to just before
    the end: at these themselves the force of a dashpot jumps."""
    names = ["contact[1].penetration", "contact[1].force", "left.velocity[1]", "right.velocity[1]"]
    if episode.end_s == episode.start_s:
        return np.zeros((4, 1))
    step = (episode.end_s - episode.start_s) / POINTS
    rows = [scenes.run(scene, step=step, stop=episode.end_s, columns=names).motion]
    for instant in [episode.start_s + 1e-7 * step, episode.end_s - 1e-7 * step]:
        rows.append({name: column[-1:] for name, column in at(scene, instant, names).items()})
    inside = (rows[0]["time"] > rows[1]["time"]) & (rows[0]["time"] < rows[2]["time"])
    joined = lambda name: np.concatenate([rows[1][name], rows[0][name][inside], rows[2][name]])  # noqa: E731
    velocity = joined("left.velocity[1]") - joined("right.velocity[1]")
    return joined("time") - episode.start_s, joined(names[0]), joined(names[1]), velocity


def at(scene, instant, names):
    """The motion at one instant."""
    return scenes.run(scene, step=instant, stop=instant, columns=names).motion
