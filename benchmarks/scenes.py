"""The scenes of the benchmark: pairs of buildings, each with any of its laws; as TOML and as plain matrices.

| scene | what | record |
|---|---|---|
| S1 | two single masses, 50 t and 75 t, periods 1.2 s and 0.6 s, 5 mm apart | synthetic, 0.6 g |
| S2 | the laboratory frames of examples/scenes/feup.toml, 2 and 3 storeys, 5 mm apart, 2 % damping | synthetic, 0.6 g |
| S3 | 3 storeys of 25 t beside 3 storeys of 1000 t, 20 mm apart | synthetic, 0.6 g |
| S4 | 20 storeys beside 30 storeys, 20 contacts, 20 mm apart | synthetic, 0.6 g |
| Y1 | two single masses that yield, elastic-perfectly plastic, no contact | synthetic, 0.6 g |
| Y2 | 8 storeys beside 5 storeys, all of which yield, 5 contacts, 20 mm apart | synthetic, 0.6 g |
"""

from dataclasses import dataclass, field
from functools import cached_property
from math import log, pi, sqrt

import numpy as np

STOP = 20.0  # s
RAYLEIGH = "{ rayleigh = { ratio = 0.05, modes = [1, 2] } }"

# Laws that the ratio to a peer is averaged over, and all that are run.
NO_CONTACT = "none"
COMPARED = [NO_CONTACT, "linear", "kelvin_voigt", "hertz", "jankowski", "hertz_damped"]
LAWS = [*COMPARED, "kelvin_voigt_no_tension", "stereomechanical"]
LINEAR_LAWS = ["linear", "kelvin_voigt", "kelvin_voigt_no_tension"]


@dataclass(frozen=True)
class Building:
    mass: list  # kg per floor
    stiffness: list  # N/m per storey
    damping: str  # as the scene says it
    ratio: float
    yield_force: tuple = ()  # N per storey; none: elastic
    post_yield_ratio: float = 0.0

    @cached_property
    def stiffness_matrix(self):
        k = np.array([*self.stiffness, 0.0])
        return np.diag(k[:-1] + k[1:]) - np.diag(k[1:-1], 1) - np.diag(k[1:-1], -1)

    @cached_property
    def modes(self):
        """Frequencies in rad/s, ascending, and shapes in columns, normalised to the masses."""
        root = np.sqrt(self.mass)
        squares, vectors = np.linalg.eigh(self.stiffness_matrix / np.outer(root, root))
        return np.sqrt(squares), vectors / root[:, None]

    @cached_property
    def damping_matrix(self):
        omega, shapes = self.modes
        if "rayleigh" in self.damping:
            first, second = omega[:2]
            on_stiffness = 2.0 * self.ratio / (first + second)
            on_mass = on_stiffness * first * second
            return on_mass * np.diag(self.mass) + on_stiffness * self.stiffness_matrix
        weighted = np.array(self.mass)[:, None] * shapes
        return weighted @ np.diag(2.0 * self.ratio * omega) @ weighted.T

    def toml(self, side):
        lines = [f"[{side}]", f"mass = {self.mass}", f"stiffness = {self.stiffness}", f"damping = {self.damping}"]
        if self.yield_force:
            lines += [f"yield_force = {list(self.yield_force)}", f"post_yield_ratio = {self.post_yield_ratio}"]
        return "\n".join(lines) + "\n"


@dataclass(frozen=True)
class Contact:
    """A pair of facing floors, counted from 0, with the coefficients of its law.

    Apart from `stereomechanical`, all laws are F = k d^n (1 + a v / V) + c d^m v: those that the law has.
    """

    floor: int
    gap: float
    law: str
    stiffness: float
    exponent: float
    restitution: float
    mass: float  # kg, of the two floors together

    @property
    def damping(self):
        """c: N s/m, or N s/m^1.25 for `jankowski`."""
        e, k, m = self.restitution, self.stiffness, self.mass
        if self.law.startswith("kelvin_voigt"):
            return 2.0 * -log(e) / sqrt(pi**2 + log(e) ** 2) * sqrt(k * m)
        if self.law == "jankowski":
            xi = 9.0 * sqrt(5.0) / 2.0 * (1.0 - e**2) / (e * (e * (9.0 * pi - 16.0) + 16.0))
            return 2.0 * xi * sqrt(k * m)
        return 0.0

    @property
    def relative_damping(self):
        """a of `hertz_damped` [Lankarani and Nikravesh]."""
        return 0.75 * (1.0 - self.restitution**2) if self.law == "hertz_damped" else 0.0

    def toml(self):
        keys = {"left_floor": self.floor + 1, "right_floor": self.floor + 1, "gap": self.gap, "law": f'"{self.law}"'}
        if self.law != "stereomechanical":
            keys["stiffness"] = self.stiffness
        if self.law not in ("linear", "hertz"):
            keys["restitution"] = self.restitution
        if self.law == "hertz_damped":
            keys["damping_formula"] = '"lankarani_nikravesh"'
        return "[[contact]]\n" + "".join(f"{key} = {value}\n" for key, value in keys.items())


@dataclass(frozen=True)
class YieldingStorey:
    """Bilinear with kinematic hardening, between two of all floors, counted from 0."""

    upper: int
    lower: int | None  # None: the ground
    stiffness: float
    yield_force: float
    post_yield_ratio: float


@dataclass(frozen=True)
class Template:
    """A scene without its law."""

    title: str
    left: Building
    right: Building
    gap: float
    pairs: int
    linear_stiffness: float
    power_stiffness: float
    restitution: float
    lowest: int = 0  # floor of the lowest contact, counted from 0
    laws: tuple = tuple(law for law in LAWS if law != NO_CONTACT)


@dataclass(frozen=True)
class Problem:
    """A template with its law: what every solver gets."""

    scene: str
    law: str
    template: Template = field(repr=False)
    record: str = "record.csv"
    stop: float = STOP

    @property
    def name(self):
        return f"{self.scene}_{self.law}"

    @cached_property
    def contacts(self):
        t = self.template
        linear = self.law in LINEAR_LAWS
        stiffness = t.linear_stiffness if linear else t.power_stiffness
        reduced = [a * b / (a + b) for a, b in zip(t.left.mass, t.right.mass)]
        exponent = 1.0 if linear else 1.5
        floors = range(t.lowest, t.lowest + t.pairs)
        return [Contact(i, t.gap, self.law, stiffness, exponent, t.restitution, reduced[i]) for i in floors]

    @cached_property
    def yielding_storeys(self):
        found = []
        for first, building in [(0, self.template.left), (self.floors[0], self.template.right)]:
            for i, (k, force) in enumerate(zip(building.stiffness, building.yield_force)):
                lower = first + i - 1 if i else None
                found.append(YieldingStorey(first + i, lower, k, force, building.post_yield_ratio))
        return found

    @property
    def floors(self):
        return len(self.template.left.mass), len(self.template.right.mass)

    @cached_property
    def matrices(self):
        """Diagonal of M, then K and C, of both buildings: floors of the left one first."""
        t = self.template
        both = lambda a, b: np.block([[a, np.zeros((len(a), len(b)))], [np.zeros((len(b), len(a))), b]])
        mass = np.array(t.left.mass + t.right.mass)
        return (
            mass,
            both(t.left.stiffness_matrix, t.right.stiffness_matrix),
            both(t.left.damping_matrix, t.right.damping_matrix),
        )

    def toml(self, tolerance=None, peaks=True):
        """The scene, with the peaks of the floors, as it has by default, or without: no other solver has them."""
        solver = "" if tolerance is None else f"[solver]\nrelative_tolerance = {tolerance}\n"
        parts = [
            f'name = "{self.name}"\ndescription = "{self.template.title}"\nstop_time = {self.stop}\n',
            self.template.left.toml("left"),
            self.template.right.toml("right"),
            f'[ground]\nrecord = "{self.record}"\n',
            "" if peaks else "[outputs]\npeaks = false\n",
            *(contact.toml() for contact in self.contacts),
            solver,
        ]
        return "\n".join(parts)


def shear(floors, mass, stiffness, damping, ratio, *yields):
    return Building([mass] * floors, [stiffness] * floors, damping, ratio, *yields)


TEMPLATES = {
    "S1": Template(
        "two single masses",
        shear(1, 50e3, 1370778.389040189, "{ ratio = 0.05 }", 0.05),
        shear(1, 75e3, 8224670.334241135, "{ ratio = 0.05 }", 0.05),
        0.005,
        1,
        3.0e10,
        3.0e10,
        0.5,
    ),
    "S2": Template(
        "laboratory frames, 2 and 3 storeys",
        shear(2, 3.65, 2910.0, "{ ratio = 0.02 }", 0.02),
        shear(3, 3.65, 2910.0, "{ ratio = 0.02 }", 0.02),
        0.005,
        2,
        1.0e6,
        1.0e6,
        0.65,
    ),
    "S3": Template(
        "3 and 3 storeys",
        shear(3, 25e3, 3460473.388533731, RAYLEIGH, 0.05),
        shear(3, 1000e3, 2214702968.661588, RAYLEIGH, 0.05),
        0.02,
        3,
        2.75e9,
        2.75e9,
        0.65,
    ),
    "S4": Template(
        "20 and 30 storeys",
        shear(20, 300e3, 5.0e8, RAYLEIGH, 0.05),
        shear(30, 400e3, 6.6e8, RAYLEIGH, 0.05),
        0.02,
        20,
        2.75e9,
        2.75e9,
        0.65,
    ),
    "Y1": Template(
        "two single masses that yield, no contact",
        shear(1, 50e3, 7.9e6, "{ ratio = 0.05 }", 0.05, (200e3,)),
        shear(1, 75e3, 3.0e6, "{ ratio = 0.05 }", 0.05, (150e3,)),
        0.0,
        0,
        0.0,
        0.0,
        1.0,
        laws=(NO_CONTACT,),
    ),
    "Y2": Template(
        "8 and 5 storeys that yield",
        shear(8, 300e3, 4.0e8, RAYLEIGH, 0.05, (5.0e6, 4.9e6, 4.6e6, 4.2e6, 3.6e6, 2.9e6, 2.1e6, 1.1e6), 0.03),
        shear(5, 400e3, 8.0e8, RAYLEIGH, 0.05, (6.0e6, 5.6e6, 4.8e6, 3.6e6, 2.0e6), 0.03),
        0.02,
        5,
        2.75e9,
        2.75e9,
        0.65,
        laws=("linear", "kelvin_voigt"),
    ),
}


def problem(scene, law, stop=STOP):
    return Problem(scene, law, TEMPLATES[scene], stop=stop)
