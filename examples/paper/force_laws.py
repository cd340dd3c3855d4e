"""Figs. 3, 5, 6, 7 and 8 of the paper: force against penetration and against time, for each law and all together.

"$(ci/environment)" examples/paper/force_laws.py
"""

import numpy as np
from pounding_fmu.plots import style

import free_impact
import statement
from free_impact import EQUATION_10, EQUATION_11, EQUATION_14_DAMPER, EQUATION_14_SPRING
from statement import FAILS, IN_PART, Statement, change, holds, percent

DAMPED_HERTZ = [EQUATION_10, "ye", EQUATION_14_DAMPER, EQUATION_14_SPRING, "exact"]
DAMPED = ["kelvin_voigt", "kelvin_voigt_no_tension", "jankowski", *DAMPED_HERTZ]
ALL = ["linear", "hertz", *DAMPED]
# One picture each: its name, its title, the laws in it.
PICTURES = [
    ("linear", "Linear spring, eq. 3", ["linear"]),
    (
        "kelvin_voigt",
        "Spring and dashpot, eqs. 4 and 5, with and without tension",
        ["kelvin_voigt", "kelvin_voigt_no_tension"],
    ),
    ("hertz", "Hertz spring, eq. 6", ["hertz"]),
    ("jankowski", "Hertz spring and Jankowski's dashpot, eqs. 7 and 8", ["jankowski", "hertz"]),
    ("hertz_damped", "Hertz spring and a dashpot with d$^n$, eqs. 9 to 11 and 14", DAMPED_HERTZ),
    (
        "all_laws",
        "All together",
        ["linear", "hertz", "kelvin_voigt", "kelvin_voigt_no_tension", "jankowski", EQUATION_10, EQUATION_14_SPRING],
    ),
]
NAMES = {
    EQUATION_10: "lankarani_nikravesh, ye_printed (10, 11)",
    EQUATION_14_SPRING: "barros_khatami (14, spring 3k/2)",
    EQUATION_14_DAMPER: "barros_khatami_damper (14, spring k)",
}


def kilonewtons(force):
    return f"{force / 1e3:.1f}"


def parts():
    return {"free impacts": impacts_table(), "force laws": statement.verdicts(statements())}


def impacts_table():
    head = ["law", "returns", "force at the start [kN]", "largest [kN]", "least [kN]", "deepest [mm]"]
    head += ["time of the largest force / of the deepest point", "lost [J]", "area of the loop [J]"]
    body = []
    for name in [*ALL, EQUATION_11]:
        of = free_impact.run(name)
        undamped = name in ("linear", "hertz")
        numbers = [f"{of.restitution:.4f}", *map(kilonewtons, (of.first_force, of.peak_force, of.least_force))]
        numbers += [f"{1e3 * of.deepest:.2f}", f"{of.peak_force_time / of.deepest_time:.3f}"]
        # Of an undamped spring the rest is rounding, and so it is by which 2812.5 J become 2812 or 2813.
        energies = [round(energy, 6) for energy in (of.dissipated, of.loop_area)]
        numbers += ["0", "0"] if undamped and abs(of.dissipated) < 1e-9 else [f"{energy:.0f}" for energy in energies]
        body.append([f"`{name}`", *(number.replace("-0.0", "0.0") for number in numbers)])
    return statement.numbers(head, body)


def statements():
    of = {name: free_impact.run(name) for name in [*ALL, EQUATION_11]}
    kelvin, cut, jankowski = of["kelvin_voigt"], of["kelvin_voigt_no_tension"], of["jankowski"]
    eq10, eq11, eq14, eq14b = (of[name] for name in (EQUATION_10, EQUATION_11, EQUATION_14_SPRING, EQUATION_14_DAMPER))
    asked = free_impact.RESTITUTION
    kN = kilonewtons
    loop = max(abs(of[name].loop_area) / (of[name].peak_force * of[name].deepest) for name in ("linear", "hertz"))
    early = [of[name].peak_force_time / of[name].deepest_time for name in DAMPED]
    turns = max(abs(at_the_turn(of[name]) / of[name].deepest - 1) for name in ALL)
    area = max(abs(of[name].loop_area / of[name].kinetic_loss - 1) for name in DAMPED)
    damped_peaks = {name: of[name].peak_force / of["hertz"].peak_force for name in DAMPED_HERTZ + ["jankowski"]}
    softer = damped_peaks[EQUATION_14_DAMPER] < 1 < damped_peaks[EQUATION_14_SPRING]
    returns = lambda name: of[name].restitution  # noqa: E731
    return [
        Statement(
            "eqs. 3 and 6",
            "the linear and the Hertz spring enclose a quite negligible area",
            holds(loop < 1e-9),
            "nothing but rounding: both return all they take, with e = 1 always",
        ),
        Statement(
            "eq. 4",
            "with a dashpot the force does not start from zero",
            holds(abs(kelvin.first_force) > 0.1 * kelvin.peak_force),
            f"it starts with c V = {kN(kelvin.first_force)} kN, {percent(kelvin.first_force / kelvin.peak_force, 0)} "
            f"of its peak",
        ),
        Statement(
            "eq. 4",
            "and pulls before the bodies part",
            holds(kelvin.least_force < 0),
            f"down to {kN(kelvin.least_force)} kN; with this pull it returns {kelvin.restitution:.4f}",
        ),
        Statement(
            "section 2.2",
            "a contact that is released where the force is zero does not pull",
            holds(cut.least_force >= 0),
            f"true, at a price that the paper does not name: it returns {cut.restitution:.4f} instead of {asked} and "
            f"loses {percent(1 - cut.dissipated / kelvin.dissipated)} less energy",
        ),
        Statement(
            "eqs. 7 and 8",
            "Jankowski's law starts from zero, rises steeply and never pulls",
            holds(jankowski.first_force < 0.01 * jankowski.peak_force and jankowski.least_force >= 0),
            f"{percent(jankowski.first_force / jankowski.peak_force)} of the peak {jankowski.time[0]:.0e} s after the "
            f"entry, {percent(share_after(jankowski, 0.01), 0)} after 1 % of the contact; never below 0; returns "
            f"{jankowski.restitution:.4f}",
        ),
        Statement(
            "on the hysteresis loop",
            "the approach velocity is zero where the penetration is largest",
            holds(turns < 1e-5),
            f"true of any motion. The force is largest earlier under every damped law, after {min(early):.2f} to "
            f"{max(early):.2f} of that time",
        ),
        Statement(
            "eq. 13",
            "the area inside the loop is the energy lost",
            holds(area < 1e-3),
            f"the areas of the drawn curves and the losses of kinetic energy agree within {area:.0e}. As printed, eq. "
            f"13 is that of n = 1; in general it is the integral of C(d) v^2 over time",
        ),
        Statement(
            "eqs. 10 and 11",
            "take different energies (their published ones)",
            holds(eq10.dissipated != eq11.dissipated),
            f"at e = 0.5 both are a = 0.5625: {eq10.dissipated:.3f} J and {eq11.dissipated:.3f} J, the same to the "
            f"last bit",
        ),
        Statement(
            "eq. 14",
            "takes more energy than eqs. 10 and 11",
            holds(eq14.dissipated > eq10.dissipated),
            f"in sign, but by {percent(eq14.dissipated / eq10.dissipated - 1, 0)} (spring 3k/2) or "
            f"{percent(eq14b.dissipated / eq10.dissipated - 1, 0)} (spring k), not by about 11 %",
        ),
        Statement(
            "eq. 14",
            "is one of the best formulas",
            IN_PART if abs(eq14.restitution - asked) < abs(eq10.restitution - asked) else FAILS,
            f"with a spring 3k/2 it returns {eq14.restitution:.3f} for 0.5, far nearer than eqs. 10 and 11 "
            f"({eq10.restitution:.3f}), and it is the formula of Ye, Li and Zhu [YeLiZhu2009]; with a spring k "
            f"{eq14b.restitution:.3f}, worse than Jankowski's ({jankowski.restitution:.3f}) and far from `exact` "
            f"({returns('exact'):.3f})",
        ),
        Statement(
            "eq. 14",
            "decreases the impact force",
            IN_PART if softer else holds(max(damped_peaks.values()) < 1),
            f"against the undamped Hertz spring of the same k: {change(damped_peaks[EQUATION_14_DAMPER])} with a "
            f"spring k, but {change(damped_peaks[EQUATION_14_SPRING])} with a spring 3k/2. Against eq. 10 it raises "
            f"the peak, by {percent(eq14b.peak_force / eq10.peak_force - 1)} and "
            f"{percent(eq14.peak_force / eq10.peak_force - 1)}",
        ),
    ]


def at_the_turn(impact):
    """m, the penetration where the approach velocity passes 0."""
    return np.interp(impact.deepest_time, impact.time, impact.penetration)


def share_after(impact, share):
    """Force after a share of the contact's duration, relative to the peak."""
    after = impact.time.searchsorted(share * impact.duration)
    return impact.force[after] / impact.peak_force


def draw(folder):
    for name, title, laws in PICTURES:
        draw_one(folder / f"{name}.png", title, laws)


def draw_one(picture, title, laws):
    height = 4.0 + 0.25 * len(laws)
    figure, (loops, times) = style.pyplot().subplots(1, 2, figsize=(9.6, height), sharey=True, layout="constrained")
    for name in laws:
        of = free_impact.run(name)
        # Where the force jumps, the curve does.
        pad = lambda column: [0.0, *column, column[-1] if column is of.time else 0.0]  # noqa: B023, E731
        force = [force / 1e3 for force in pad(of.force)]
        look = style.LAWS[name]
        loops.plot([1e3 * d for d in pad(of.penetration)], force, label=NAMES.get(name, name), **look)
        times.plot([1e3 * t for t in pad(of.time)], force, **look)
    figure.suptitle(title, x=0.01, ha="left", fontsize=11.5)
    loops.set(xlabel="penetration [mm]", ylabel="contact force [kN]", xlim=(0, None), title="Against penetration")
    times.set(xlabel="time from the entry [ms]", xlim=(0, None), title="Against time")
    for axes in (loops, times):
        axes.axhline(0, color=style.BLACK, linewidth=0.8)
    if len(laws) > 1:
        figure.legend(*loops.get_legend_handles_labels(), loc="outside lower center", ncols=2, handlelength=3.2)
    style.save(figure, picture)


def main():
    draw(statement.PICTURES)
    statement.publish(parts())


if __name__ == "__main__":
    main()
