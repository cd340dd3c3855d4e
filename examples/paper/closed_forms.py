"""What a free impact must give, by formulas that owe nothing to the engine, beside what its runs give."""

from dataclasses import dataclass
from math import acos, asin, exp, log, log1p, pi, sqrt

import free_impact
import scenes
from free_impact import EXPONENT, MASSES, REDUCED_MASS, RESTITUTION, SPEED, STIFFNESS

RATIO = -log(RESTITUTION) / sqrt(pi**2 + log(RESTITUTION) ** 2)  # xi of eq. 5

# a of F = k d^n (1 + a v/V) by each formula.
E = RESTITUTION
DAMPING = {
    "lankarani_nikravesh": 3 * (1 - E**2) / 4,
    "ye_printed": 3 * (1 - E**2) / (8 * E),
    "ye": 8 * (1 - E) / (5 * E),
    "barros_khatami": 8 * (1 - E) / (5 * E),
    "barros_khatami_damper": 24 * (1 - E) / (10 * E),
    "hunt_crossley": 3 * (1 - E) / 2,
    "hu_guo": 3 * (1 - E) / (2 * E),
}


@dataclass(frozen=True)
class Check:
    case: str
    formula: str
    source: str
    expected: float
    ours: float

    def agrees(self):
        return abs(self.ours - self.expected) <= 1e-9 * abs(self.expected)


def returned(a):
    """e of a (1 + e) = ln[(1 + a)/(1 - a e)], by bisection [Gonthier2004]."""
    low, high = 0.0, min(1.0, 1 / a) * (1 - 1e-15)
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if a * (1 + middle) > log1p(a) - log1p(-a * middle) else (low, middle)
    return low


def deepest(a, exponent):
    """m, of the same law: from m V^2 u du/(1 + a u) = -k d^n dd with u = v/V."""
    return ((exponent + 1) * REDUCED_MASS * SPEED**2 * (a - log1p(a)) / (STIFFNESS * a * a)) ** (1 / (exponent + 1))


def checks():
    return [*instantaneous(), *springs(), *dashpots(), *damped_hertz()]


def instantaneous():
    """Eqs. 1 and 2: the bodies' velocities afterwards, m/s."""
    scene = {**free_impact.SCENE}
    scene["contact"] = scenes.contacts(free_impact.contact_law("stereomechanical"), scene["contact"][0]["gap"], 1)
    motion = scenes.run(scene, columns=("left.velocity[1]", "right.velocity[1]")).motion
    left, right = MASSES
    law, source = "`stereomechanical`, velocity of the ", "[Goldsmith1960], [BarrosKhatami2013, eqs. 1, 2]"
    after_left = SPEED - (1 + E) * right / (left + right) * SPEED
    after_right = (1 + E) * left / (left + right) * SPEED
    return [
        Check(
            law + "left body [m/s]", "V - (1 + e) m2 V/(m1 + m2)", source, after_left, motion["left.velocity[1]"][-1]
        ),
        Check(law + "right body [m/s]", "(1 + e) m1 V/(m1 + m2)", source, after_right, motion["right.velocity[1]"][-1]),
    ]


def springs():
    linear, hertz = free_impact.run("linear"), free_impact.run("hertz")
    energy = REDUCED_MASS * SPEED**2
    # Of d^n: k d^(n + 1)/(n + 1) is the energy m V^2/2.
    depth = ((EXPONENT + 1) * energy / (2 * STIFFNESS)) ** (1 / (EXPONENT + 1))
    return [
        Check(
            "`linear`, largest force [N]",
            "V sqrt(k m)",
            "energy",
            SPEED * sqrt(STIFFNESS * REDUCED_MASS),
            linear.peak_force,
        ),
        Check(
            "`linear`, duration [s]",
            "pi sqrt(m/k)",
            "half a period",
            pi * sqrt(REDUCED_MASS / STIFFNESS),
            linear.duration,
        ),
        Check(
            "`hertz`, largest force [N]",
            "k^0.4 (1.25 m V^2)^0.6",
            "energy",
            STIFFNESS * depth**EXPONENT,
            hertz.peak_force,
        ),
    ]


def dashpots():
    kelvin, cut = free_impact.run("kelvin_voigt"), free_impact.run("kelvin_voigt_no_tension")
    root, spring = sqrt(1 - RATIO**2), SPEED * sqrt(STIFFNESS * REDUCED_MASS)
    peak = spring * exp(-RATIO / root * (pi / 2 - 3 * asin(RATIO)))
    source = "[Anagnostopoulos1988]"
    return [
        Check("`kelvin_voigt`, restitution", "e", source, E, kelvin.restitution),
        Check(
            "`kelvin_voigt`, largest force [N]",
            "V sqrt(k m) exp(-xi (pi/2 - 3 asin xi)/sqrt(1 - xi^2))",
            source,
            peak,
            kelvin.peak_force,
        ),
        Check(
            "`kelvin_voigt`, energy lost [J]",
            "(1 - e^2) m V^2/2",
            "[BarrosKhatami2013, eq. 12]",
            (1 - E**2) * REDUCED_MASS * SPEED**2 / 2,
            kelvin.dissipated,
        ),
        Check(
            "`kelvin_voigt_no_tension`, restitution",
            "exp(-2 xi acos(xi)/sqrt(1 - xi^2))",
            "motion until F = 0",
            exp(-2 * RATIO * acos(RATIO) / root),
            cut.restitution,
        ),
    ]


def damped_hertz():
    """With several exponents: what is returned does not depend on n."""
    found = []
    for name, a in DAMPING.items():
        of = free_impact.run(name)
        found.append(
            Check(
                f"`{name}`, restitution",
                f"a (1 + e') = ln[(1 + a)/(1 - a e')], a = {a:.4g}",
                "[Gonthier2004]",
                returned(a),
                of.restitution,
            )
        )
    for exponent in (1.0, 2.0):
        of, a = free_impact.run("lankarani_nikravesh", exponent=exponent), DAMPING["lankarani_nikravesh"]
        formula = "[(n + 1) m V^2 (a - ln(1 + a))/(k a^2)]^(1/(n + 1))"
        found.append(
            Check(
                f"`lankarani_nikravesh`, n = {exponent:g}, deepest [m]",
                formula,
                "energy",
                deepest(a, exponent),
                of.deepest,
            )
        )
    return found
