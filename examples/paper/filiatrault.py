"""Section 3.1 of the paper: the shaking table test of Filiatrault, Wagner and Cherry, as far as its data go.

    "$(ci/environment)" examples/paper/filiatrault.py

Masses, stiffnesses and damping of the frames are not published there. They are varied, so that what comes out is a
range for each measured value.
"""

import functools
import os
from concurrent.futures import ThreadPoolExecutor
from itertools import product
from pathlib import Path

from pounding_fmu.plots import style

import scenes
import statement
from statement import Statement, holds, of_an_ordering

SCENE = scenes.read(Path(__file__).with_name("scenes") / "filiatrault.toml")
FLOORS = len(SCENE["contact"])
LAW = {key: SCENE["contact"][0][key] for key in ("law", "stiffness")}
GAPS = {"no contact": None, "gap 0": 0.0, "gap 15 mm": SCENE["contact"][0]["gap"]}
MASSES = [100.0, 200.0, 400.0]  # kg a floor
PERIODS = [(0.4, 0.15), (0.6, 0.2), (0.8, 0.3), (0.6, 0.3)]  # s, eight and three storeys
DAMPING = SCENE["left"]["damping"]["ratio"]
LEVEL_3, ROOF_OF_3 = "left.peak_acceleration[3]", "right.peak_acceleration[3]"

# g, as the paper reports the test: what was measured, where, in which test, largest absolute acceleration. At which
# floor of the free-standing frame is not said; the largest over its height is taken.
MEASURED = [
    ("8 storeys, anywhere", "no contact", 2.5),
    ("8 storeys, level 3", "gap 15 mm", 12.0),
    ("8 storeys, level 3", "gap 0", 12.0),
    ("3 storeys, roof", "gap 0", 15.0),
    ("3 storeys, roof", "gap 15 mm", 23.0),
]


def parts():
    return {"filiatrault": f"{ranges_table()}\n\n{statement.verdicts(statements())}"}


def run(mass, periods, gap):
    """Largest absolute accelerations, g."""
    storeys = {side: len(SCENE[side]["mass"]) for side in ("left", "right")}
    scene = {**SCENE, "contact": [] if gap is None else scenes.contacts(LAW, gap, FLOORS)}
    for (side, count), period in zip(storeys.items(), periods):
        stiffness = scenes.storey_stiffness(mass, period, count)
        scene[side] = scenes.shear_building(mass, stiffness, count, DAMPING)
    columns = [f"left.peak_acceleration[{floor}]" for floor in range(1, storeys["left"] + 1)] + [ROOF_OF_3]
    motion = scenes.run(scene, columns=columns).motion
    largest = {name: motion[name][-1] / scenes.STANDARD_GRAVITY for name in columns}
    anywhere = max(largest[name] for name in columns[:-1])
    return {
        "8 storeys, anywhere": anywhere,
        "8 storeys, level 3": largest[LEVEL_3],
        "3 storeys, roof": largest[ROOF_OF_3],
    }


@functools.cache
def sweep():
    cases = list(product(MASSES, PERIODS, GAPS))
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return dict(zip(cases, pool.map(lambda case: run(case[0], case[1], GAPS[case[2]]), cases)))


def ours(where, test):
    """g, over all masses and periods."""
    return [sweep()[mass, periods, test][where] for mass, periods in product(MASSES, PERIODS)]


def ranges_table():
    body = []
    for where, test, measured in MEASURED:
        found = ours(where, test)
        body.append([f"{where}, {test}", f"{measured:g}", f"{min(found):.1f} to {max(found):.1f}"])
    return statement.numbers(
        ["largest acceleration", "measured [g]", f"ours, {len(found)} choices of mass and periods [g]"], body
    )


def statements():
    inside = [min(ours(where, test)) <= measured <= max(ours(where, test)) for where, test, measured in MEASURED]
    more = [
        hit > free
        for test in ("gap 0", "gap 15 mm")
        for hit, free in zip(ours("8 storeys, level 3", test), ours("8 storeys, level 3", "no contact"))
    ]
    wider = [
        wide > touching
        for wide, touching in zip(ours("3 storeys, roof", "gap 15 mm"), ours("3 storeys, roof", "gap 0"))
    ]
    ratio = [
        hit / free
        for hit, free in zip(ours("8 storeys, level 3", "gap 15 mm"), ours("8 storeys, level 3", "no contact"))
    ]
    return [
        Statement(
            "section 3.1",
            "2.5 g without pounding, 12 g at level 3 of the taller and 15 and 23 g at the roof of the lower frame",
            statement.NOT_TO_BE_HAD,
            f"{sum(inside)} of {len(inside)} lie within our ranges, which only says that the order of magnitude is "
            f"right: the paper gives neither masses nor stiffnesses nor damping",
        ),
        Statement(
            "section 3.1",
            "pounding multiplies the floor accelerations",
            holds(all(more)),
            f"level 3 of the taller frame has more with contact than without in {sum(more)} of {len(more)} runs, with "
            f"15 mm {min(ratio):.1f} to {max(ratio):.1f} times as much",
        ),
        Statement(
            "section 3.1",
            "a gap of 15 mm is worse for the lower roof than none",
            of_an_ordering(wider),
            f"in {sum(wider)} of {len(wider)} choices of mass and periods",
        ),
    ]


def draw(folder):
    figure, axes = style.pyplot().subplots(figsize=(8.6, 3.8), layout="constrained")
    marks = {mass: look for mass, look in zip(MASSES, [("o", style.BLUE), ("^", style.ORANGE), ("D", style.GREEN)])}
    for row, (where, test, measured) in enumerate(MEASURED):
        axes.plot(
            measured,
            row,
            "s",
            color=style.BLACK,
            markerfacecolor="white",
            markersize=11,
            zorder=1,
            label="measured" if not row else None,
        )
        for place, (mass, (mark, colour)) in enumerate(marks.items()):
            found = [sweep()[mass, periods, test][where] for periods in PERIODS]
            label = f"ours, {mass:g} kg a floor" if not row else None
            axes.plot(found, [row + 0.2 * (place - 1)] * len(found), mark, color=colour, markersize=5.5, label=label)
    axes.set_yticks(range(len(MEASURED)), [f"{where},\n{test}" for where, test, _ in MEASURED])
    axes.set(xscale="log", xlabel="largest absolute acceleration [g]", ylim=(len(MEASURED) - 0.5, -0.5))
    axes.set_xticks([1, 2, 5, 10, 20, 50], ["1", "2", "5", "10", "20", "50"])
    axes.minorticks_off()
    figure.legend(loc="outside upper left", ncols=4)
    style.save(figure, folder / "filiatrault.png")


def main():
    draw(statement.PICTURES)
    statement.publish(parts())


if __name__ == "__main__":
    main()
