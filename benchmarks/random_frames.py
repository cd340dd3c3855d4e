"""Random scenes as text: two frames of a few storeys in a random earthquake, with any law, of several kinds."""

import math

import numpy as np

# By the name of its kind, what a scene has.
KINDS = {
    "floors": "level floors",
    "uneven": "floors, columns and walls",
    "yielding": "storeys that yield",
    "gravity": "gravity, half of them with storeys that yield",
    "linked": "links, half of them with a slip force",
    "soil": "foundations on soil",
    "all": "all of these at once",
}
LAWS = [
    "linear", "kelvin_voigt", "kelvin_voigt_no_tension", "hertz", "jankowski", "hertz_damped", "stereomechanical",
]  # fmt: skip
FORMULAS = ["lankarani_nikravesh", "ye", "exact"]
STOP, SAMPLE = 3.0, 0.02  # s
HEIGHT = 3.0  # m


def record(rng):
    """Times in s and ground accelerations in m/s2, from rest: some sinusoids under an envelope."""
    time = SAMPLE * np.arange(round(STOP / SAMPLE) + 1)
    waves = [rng.uniform(0.5, 3.0) * np.sin(2 * math.pi * 10 ** rng.uniform(-0.5, 1.0) * time) for _ in range(6)]
    return time, np.minimum(1.0, time) * sum(waves)


def scene(rng, kind):
    """The text of a scene, without its record."""
    has = {part: part == kind or kind == "all" for part in KINDS}
    frames = [Frame(rng, rng.integers(1, 5)) for _ in range(2)]
    lines = ['name = "Random"', f"stop_time = {STOP}"]
    yields = has["yielding"] or (has["gravity"] and rng.random() < 0.5)
    for side, frame in zip(("left", "right"), frames, strict=True):
        lines += [f"[{side}]", *frame.lines(rng, yields, has["gravity"])]
        if has["soil"]:
            lines += frame.foundation(rng, side)
    lines += uneven(rng, frames) if has["uneven"] else level(rng, frames)
    if has["linked"]:
        lines += link(rng, frames)
    return "\n".join(lines) + "\n"


class Frame:
    def __init__(self, rng, storeys):
        mass = 10 ** rng.uniform(3.0, 6.0)
        self.mass = rng.uniform(0.5, 1.5, storeys) * mass
        # Of one storey, where a frame of equal ones has a first frequency of 0.5 to 5 Hz.
        omega = 2 * math.pi * 10 ** rng.uniform(-0.3, 0.7) / (2 * math.sin(math.pi / (4 * storeys + 2)))
        self.stiffness = rng.uniform(0.6, 1.4, storeys) * mass * omega**2

    def lines(self, rng, yields, leans):
        lines = [f"mass = {numbers(self.mass)}", f"stiffness = {numbers(self.stiffness)}", self.damping(rng)]
        lines.append(f"height = {numbers([HEIGHT] * len(self.mass))}")
        if yields:
            above = np.cumsum(self.mass[::-1])[::-1]
            forces = above * 10 ** rng.uniform(-0.7, 1.0, len(above))
            ratio = rng.choice([0.0, rng.uniform(0, 0.5)])
            lines += [f"yield_force = {numbers(forces)}", f"post_yield_ratio = {number(ratio)}"]
        if leans:
            # At most about a tenth, in a soft storey a quarter, of the weight that would make a storey unstable.
            loads = self.stiffness * HEIGHT / len(self.mass) * rng.uniform(0.0, 0.1)
            lines += ["p_delta = true", f"gravity_load = {numbers(loads)}"]
        return lines

    def damping(self, rng):
        ratio = rng.choice([0.0, rng.uniform(0.005, 0.1)])
        kinds = [f"{{ ratio = {number(ratio)} }}"]
        if len(self.mass) > 1:
            dashpots = rng.uniform(0.0, 0.01, len(self.mass)) * np.sqrt(self.stiffness * self.mass)
            kinds += [
                f"{{ rayleigh = {{ ratio = {number(ratio)}, modes = [1, 2] }} }}",
                f"{{ dashpots = {numbers(dashpots)} }}",
            ]
        return f"damping = {rng.choice(kinds)}"

    def foundation(self, rng, side):
        mass, stiffness = self.mass.sum(), self.stiffness[0]
        arm = HEIGHT * len(self.mass)
        springs = {"sway": (mass, stiffness), "rocking": (mass * HEIGHT**2, stiffness * arm**2)}
        lines = [f"[{side}.foundation]", f"mass = {number(mass * rng.uniform(0.3, 2.0))}"]
        lines.append(f"inertia = {number(mass * rng.uniform(1.0, 9.0))}")
        for way, (moved, spring) in springs.items():
            spring = spring * 10 ** rng.uniform(0.5, 1.5)
            dashpot = rng.uniform(0.0, 0.5) * math.sqrt(spring * moved)
            lines.append(f"{way} = {{ stiffness = {number(spring)}, dashpot = {number(dashpot)} }}")
        return lines


def level(rng, frames):
    """Contacts at most floors that face each other."""
    facing = range(1, min(len(frame.mass) for frame in frames) + 1)
    lines = []
    for floor in facing:
        if floor == facing[-1] or rng.random() < 0.7:
            lines += contact(rng, frames, [f"left_floor = {floor}", f"right_floor = {floor}"])
    return lines


def uneven(rng, frames):
    """Floors against columns, a wall, and the roof of the lower frame against the floor beside it."""
    left, right = (len(frame.mass) for frame in frames)
    lowest = min(left, right)
    places = [
        [f"left_floor = {lowest}", f"right_floor = {lowest}"],
        [f"left_floor = {rng.integers(1, lowest + 1)}", f"right_storey = {rng.integers(1, right + 1)}"],
        [f"right_floor = {rng.integers(1, right + 1)}", 'wall = "right"'],
    ]
    places[1] += [f"right_position = {number(rng.uniform(0.1, 0.9))}"]
    places[1] += [f'column_shape = "{rng.choice(["fixed", "straight"])}"']
    return [line for place in places for line in contact(rng, frames, place)]


def contact(rng, frames, place):
    law = rng.choice(LAWS)
    mass = sum(frame.mass.mean() for frame in frames)
    lines = ["[[contact]]", *place, f"gap = {number(10 ** rng.uniform(-3.3, -1.7))}", f'law = "{law}"']
    if law != "stereomechanical":
        lines.append(f"stiffness = {number(mass * 10 ** rng.uniform(4.0, 7.0))}")
    if law not in ("linear", "hertz"):
        lines.append(f"restitution = {number(rng.uniform(0.2, 0.95))}")
    if law == "hertz_damped":
        lines.append(f'damping_formula = "{rng.choice(FORMULAS)}"')
    return lines


def link(rng, frames):
    """A spring and a dashpot between the roof of the lower frame and the floor beside it."""
    floor, softest = min(len(frame.mass) for frame in frames), min(frame.stiffness.min() for frame in frames)
    lines = ["[[link]]", f"left_floor = {floor}", f"right_floor = {floor}"]
    lines.append(f"stiffness = {number(softest * rng.uniform(0.05, 1.0))}")
    lines.append(f"dashpot = {number(softest * rng.uniform(0.0, 0.01))}")
    if rng.random() < 0.5:
        lines.append(f"slip_force = {number(softest * 10 ** rng.uniform(-4.0, -2.0))}")
    return lines


def numbers(values):
    return f"[{', '.join(map(number, values))}]"


def number(value):
    return repr(float(value))
