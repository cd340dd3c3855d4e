"""Fig. 9 of the paper: exponents from 1 to 2, and what is true of the negative forces.

"$(ci/environment)" examples/paper/exponents.py
"""

from math import cos, pi

import numpy as np
from pounding_fmu.plots import style

import free_impact
import statement
from free_impact import EQUATION_10, STIFFNESS
from statement import FAILS, Statement, holds

PUBLISHED = [1.0, 1.3, 1.5, 1.7, 2.0]  # the paper's exponents
# What the paper sees at each: negative forces, none until the gap, positive forces.
SEEN = [-1, -1, 0, 1, 1]
LAWS = [EQUATION_10, free_impact.EQUATION_14_SPRING, free_impact.EQUATION_14_DAMPER, "exact"]
# From dark to light, none of them that of a law: all curves are of one.
COLOURS = ["#00224E", "#3B496C", "#6C6E72", "#9B9476", "#C8B866"]
DASHES = ["-", (0, (6, 1)), "-.", "--", (0, (1, 1))]


def outside(exponent):
    """The spring's d^n at d = -1, where there is no contact: the real part of (-1)^n. A formula, not a run."""
    return cos(exponent * pi)


def parts():
    return {"exponents": f"{exponents_table()}\n\n{statement.verdicts(statements())}"}


def exponents_table():
    head = [
        "n",
        "least force [kN]",
        "returns",
        "largest force, k = 3e7 N/m^n [kN]",
        "largest force, k = 30000 kN/mm^n [MN]",
        "cos(n pi)",
    ]
    body = []
    for n in PUBLISHED:
        of, other = impact(n), in_millimetres(n)
        numbers = [f"{of.least_force / 1e3 + 0.0:.1f}", f"{of.restitution:.6f}", f"{of.peak_force / 1e3:.1f}"]
        body.append(
            [f"{n}", *numbers, f"{other.peak_force / 1e6:.2f}", f"{outside(n) + 0.0:.3f}".replace("-0.000", "0.000")]
        )
    return statement.numbers(head, body)


def impact(exponent, law=EQUATION_10):
    return free_impact.run(law, exponent=exponent)


def in_millimetres(exponent):
    """The same number for k, read in kN/mm^n as the paper prints it: 30000."""
    return free_impact.run(EQUATION_10, exponent=exponent, stiffness=STIFFNESS * 1e3 ** (exponent - 1) * 1e3)


def statements():
    least = min(impact(n, law).least_force for n in PUBLISHED for law in LAWS)
    signs = [np.sign(round(outside(n), 12)) for n in PUBLISHED]
    kelvin = free_impact.run("kelvin_voigt")
    peaks, others = [impact(n).peak_force for n in PUBLISHED], [in_millimetres(n).peak_force for n in PUBLISHED]
    fades = peaks[0] < 0.5 * peaks[-1] or others[0] < 0.5 * others[-1]
    return [
        Statement(
            "Fig. 9",
            "n = 1 and 1.3 give negative forces, 1.5 none until the gap, 1.7 and 2 positive ones",
            holds(least < 0),
            f"no exponent gives a negative force: over eqs. 10 and 14 and `exact` the least is "
            f"{least / 1e3 + 0.0:.1f} kN. A contact with C = xi d^n cannot pull in a free impact, whatever n and xi: "
            f"the bodies part at v > -V/a. Where there is no contact, d < 0, a program that forgets to switch the "
            f"spring off has d^n with a real part that goes as cos(n pi), last column: its signs "
            f"are{'' if signs == SEEN else ' not'} those that the paper sees at all five exponents. That they came "
            f"about like this is our guess. The other way to a pull is a dashpot that does not fade with d: "
            f"`kelvin_voigt`, n = 1, pulls with {-kelvin.least_force / kelvin.peak_force:.3f} of its peak",
        ),
        Statement(
            "on eq. 9",
            "a smaller n limits the force towards zero",
            holds(fades),
            f"the number 3e7 read in N/m^n gives forces that rise as n falls, from {peaks[-1] / 1e3:.0f} to "
            f"{peaks[0] / 1e3:.0f} kN; 30000 read in kN/mm^n gives {min(others) / 1e6:.1f} to {max(others) / 1e6:.1f} "
            f"MN for all. Stiffnesses with different n have different units and cannot be compared as numbers; what "
            f"is returned, third column, does not depend on n at all",
        ),
        Statement(
            "on eq. 9",
            "n = 0 has no hysteresis, n without bound is a vertical line",
            FAILS,
            "by the formulas (scenes have n from 1 to 3): with n = 0 C = xi is a constant, which goes on taking "
            "energy; d^n grows without bound with n only where d > 1, in whatever unit d is",
        ),
    ]


def draw(folder):
    figure, panels = style.pyplot().subplots(1, 3, figsize=(12.4, 4.4), layout="constrained")
    loops, times, signs = panels
    for n, colour, dash in zip(PUBLISHED, COLOURS, DASHES):
        of, look = impact(n), {"color": colour, "linestyle": dash, "linewidth": 2.0, "label": f"n = {n:g}"}
        loops.plot(1e3 * of.penetration, of.force / 1e3, **look)
        times.plot(1e3 * of.time, of.force / 1e3, **look)
    loops.set(xlabel="penetration [mm]", ylabel="contact force [kN]", title="Runs: eq. 10, e = 0.5, k = 3e7 N/m$^n$")
    loops.set(xlim=(0, None))
    times.set(
        xlabel="time from the entry [ms]", ylabel="contact force [kN]", title="The same against time: never below 0"
    )
    times.set(xlim=(0, None))
    for axes in (loops, times):
        axes.axhline(0, color=style.BLACK, linewidth=0.8)
    loops.legend(loc="upper right")
    draw_signs(signs)
    style.save(figure, folder / "exponents.png")


def draw_signs(axes):
    """A formula, no run: what k d^n becomes outside of contact if nothing switches it off."""
    exponents = np.linspace(0.9, 2.1, 200)
    axes.plot(exponents, np.cos(pi * exponents), color=style.GREY, linewidth=1.5)
    axes.plot(PUBLISHED, [outside(n) for n in PUBLISHED], "o", color=style.BLACK, markersize=6)
    axes.axhline(0, color=style.BLACK, linewidth=0.8)
    words = {-1: "negative", 0: "none", 1: "positive"}
    for n, seen in zip(PUBLISHED, SEEN):
        aside = {"xytext": (10, -4), "ha": "left"} if n <= 1.5 else {"xytext": (-10, 4), "ha": "right"}
        axes.annotate(
            f"paper: {words[seen]}",
            (n, outside(n)),
            textcoords="offset points",
            va="top" if n <= 1.5 else "bottom",
            **aside,
        )
    axes.set(
        xlabel="exponent n",
        ylabel="Re (-1)$^n$ = cos(n π)",
        title="A formula, no run: d$^n$ where d < 0",
        ylim=(-1.25, 1.25),
    )


def main():
    draw(statement.PICTURES)
    statement.publish(parts())


if __name__ == "__main__":
    main()
