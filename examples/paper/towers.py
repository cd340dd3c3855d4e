"""Two towers under a sine, as Chau, Wei, Guo and Shen shook them [Chau2003]; qualitative, for the towers' data are not
public.

    "$(ci/environment)" examples/paper/towers.py
"""

import functools
import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
from pounding_fmu.plots import style

import scenes
import statement
from statement import Statement, holds, of_an_ordering

SCENE = scenes.read(Path(__file__).with_name("scenes") / "towers.toml")
AMPLITUDE = 1.0  # m/s2
SWEPT = [float(f) for f in np.round(np.arange(1.5, 4.01, 0.05), 2)]  # Hz
SETTLED = SCENE["stop_time"] / 2  # s, from when on motion and impacts are looked at
STEP = 0.005  # s
FLEXIBLE, STIFFER = "left.displacement[1]", "right.displacement[1]"


@functools.cache
def sweep():
    """By frequency: amplitudes with and without contact, m, approach velocity, m/s, and the gap that would do, m."""
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return dict(zip(SWEPT, pool.map(at, SWEPT)))


def at(frequency):
    times = np.arange(0, SCENE["stop_time"] + STEP / 2, STEP)
    ground = AMPLITUDE * np.sin(2 * np.pi * frequency * times)
    # Rounded, for the last digit of a sine depends on the machine, and some of these motions are chaotic.
    record = [[float(f"{time:.3f}") for time in times], [float(f"{value:.9f}") for value in ground]]
    runs = [
        scenes.run({**SCENE, "contact": contact}, step=STEP, columns=(FLEXIBLE, STIFFER), record=record)
        for contact in (SCENE["contact"], [])
    ]
    late = runs[0].motion["time"] > SETTLED
    largest = lambda motion: float(np.abs(motion[late]).max())  # noqa: E731
    speeds = [episode.approach_velocity for episode in runs[0].episodes if episode.start_s > SETTLED]
    with_contact, alone = ([largest(run.motion[name]) for name in (FLEXIBLE, STIFFER)] for run in runs)
    needed = float((runs[1].motion[FLEXIBLE] - runs[1].motion[STIFFER])[late].max())
    return with_contact, alone, max(speeds, default=0.0), needed


def natural():
    """Hz, of the flexible and the stiffer tower."""
    found = scenes.frequencies(SCENE)
    return found["left"][0], found["right"][0]


def statements():
    flexible, stiffer = natural()
    hit = [frequency for frequency in SWEPT if sweep()[frequency][2] > 0]
    fastest = max(SWEPT, key=lambda frequency: sweep()[frequency][2])
    widest = max(SWEPT, key=lambda frequency: sweep()[frequency][3])
    with_contact, alone = zip(*(sweep()[frequency][:2] for frequency in hit))
    more = [hit[1] > free[1] for hit, free in zip(with_contact, alone)]
    less = [hit[0] < free[0] for hit, free in zip(with_contact, alone)]
    between = [flexible <= frequency <= stiffer for frequency in hit]
    count = lambda found: f"{sum(found)} of {len(hit)}"  # noqa: E731
    inside = [m for m, is_between in zip(more, between) if is_between]
    largest = lambda runs, tower: 1e3 * max(run[tower] for run in runs)  # noqa: E731
    return [
        Statement(
            "under a sine",
            "impacts are fastest at a frequency between the natural frequencies of the towers",
            holds(flexible < fastest < stiffer),
            f"at {fastest:.2f} Hz, between {flexible:.2f} and {stiffer:.2f} Hz, at {sweep()[fastest][2]:.2f} m/s",
        ),
        Statement(
            "under a sine",
            "the gap that avoids contact is widest near the frequency of the flexible tower",
            holds(abs(widest - flexible) <= 0.05),
            f"at {widest:.2f} Hz: {1e3 * sweep()[widest][3]:.0f} mm",
        ),
        Statement(
            "under a sine",
            "pounding amplifies the motion of the stiffer tower and suppresses that of the flexible one",
            of_an_ordering(more + less),
            f"of the frequencies at which the towers meet, the stiffer moves more in {count(more)} (between the "
            f"natural frequencies {sum(inside)} of {len(inside)}), the flexible less in {count(less)}; over all of "
            f"them the largest motion falls from {largest(alone, 0):.0f} to {largest(with_contact, 0):.0f} mm "
            f"(flexible) and from {largest(alone, 1):.0f} to {largest(with_contact, 1):.0f} mm (stiffer)",
        ),
    ]


def draw(folder):
    figure, panels = style.pyplot().subplots(3, 1, figsize=(7.6, 7.2), sharex=True, layout="constrained")
    speeds, motions = panels[0], panels[1:]
    speeds.plot(
        SWEPT, [sweep()[frequency][2] for frequency in SWEPT], "o-", color=style.BLACK, markersize=3.5, linewidth=1.2
    )
    speeds.set(
        ylabel="approach velocity [m/s]", title="Largest approach velocity of the settled motion", ylim=(0, None)
    )
    for axes, tower, look, name in [(motions[0], 0, style.LEFT, "flexible"), (motions[1], 1, style.RIGHT, "stiffer")]:
        for which, style_of_line, label in [(0, look, "with contact"), (1, style.ALONE, "alone")]:
            axes.semilogy(
                SWEPT, [1e3 * sweep()[frequency][which][tower] for frequency in SWEPT], label=label, **style_of_line
            )
        axes.set(ylabel="displacement [mm]", title=f"Largest displacement of the {name} tower")
        axes.legend(loc="upper right")
    for axes in panels:
        for frequency in natural():
            axes.axvline(frequency, color=style.GREY, linestyle=":", linewidth=1.2)
    panels[-1].set(xlabel="frequency of the ground motion [Hz] (dotted: natural frequencies of the towers)")
    style.save(figure, folder / "towers.png")


if __name__ == "__main__":
    draw(statement.PICTURES)
    print(statement.verdicts(statements()))
