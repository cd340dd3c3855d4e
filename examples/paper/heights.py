"""Fig. 19 and section 4.3 of the paper: buildings of one, two and three storeys.

    "$(ci/environment)" examples/paper/heights.py                  # under El Centro, which is here
    "$(ci/environment)" examples/paper/heights.py --kobe FILE      # and under your file of Kobe

What the paper leaves open is varied: the periods of both buildings and the law. So there are orderings to check, no
values.
"""

import argparse
import functools
import hashlib
import os
from concurrent.futures import ThreadPoolExecutor
from itertools import permutations
from pathlib import Path

from pounding_fmu.plots import style

import free_impact
import scenes
import statement
from statement import Statement

# kN: the paper's largest force with one, two and three storeys.
PUBLISHED = {1: 35.0, 2: 75.0, 3: 325.0}
SCENE = scenes.read(Path(__file__).with_name("scenes") / "heights.toml")
# s, of either building with one storey: every ordered pair of different ones.
PERIODS = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8]
PAIRS = list(permutations(PERIODS, 2))
DRAWN = (0.3, 0.2)  # the pair of the scene
LAWS = ["barros_khatami", "lankarani_nikravesh", "jankowski", "kelvin_voigt_no_tension"]
HEIGHTS = [1, 2, 3]
KILONEWTON_PER_MILLIMETRE = 3e10  # N/m, the paper's k as printed


@functools.cache
def run(record, law, periods, storeys, stiffness=free_impact.STIFFNESS, **how):
    """Storeys of the same mass and stiffness, however many: the periods are those with one."""
    scene = {**SCENE, "ground": {**SCENE["ground"], "record": str(Path(record).resolve())}}
    for side, period in zip(("left", "right"), periods):
        mass, damping = scene[side]["mass"][0], scene[side]["damping"]["ratio"]
        scene[side] = scenes.shear_building(mass, scenes.storey_stiffness(mass, period, 1), storeys, damping)
    contact = free_impact.contact_law(law, stiffness=stiffness)
    scene["contact"] = scenes.contacts(contact, SCENE["contact"][0]["gap"], storeys)
    return scenes.run(scene, **how)


@functools.cache
def sweep(record):
    """Largest force at each floor, N, and the number of contacts, by law, pair of periods and height."""
    cases = [(law, pair, height) for law in LAWS for pair in PAIRS for height in HEIGHTS]

    def summary(case):
        law, pair, height = case
        done = run(record, law, pair, height)
        floors = range(1, height + 1)
        return [done.peak_force(floor) for floor in floors], [len(done.of_contact(floor)) for floor in floors]

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return dict(zip(cases, pool.map(summary, cases)))


def parts():
    return {"heights under El Centro": page(scenes.EL_CENTRO)}


def parts_under(kobe):
    return {"heights under Kobe": f"{about(kobe)}\n\n{page(kobe)}"}


def about(record):
    """Which file it was."""
    digest = hashlib.sha256(record.read_bytes()).hexdigest()
    return f"The file: `{record.name}`, SHA-256 {digest[:16]}..."


def existing(name):
    """A file that an argument names."""
    if not Path(name).is_file():
        raise argparse.ArgumentTypeError(f"{name}: no such file")
    return Path(name)


def page(record):
    return f"{counts_table(record)}\n\n{statement.verdicts(statements(record))}"


def counts(record, law):
    """In how many pairs of periods an ordering holds."""
    forces = {(pair, height): sweep(record)[law, pair, height][0] for pair in PAIRS for height in HEIGHTS}
    contacts = {pair: sweep(record)[law, pair, 3][1] for pair in PAIRS}
    largest = {pair: [max(forces[pair, height]) for height in HEIGHTS] for pair in PAIRS}
    top = lambda numbers: numbers[-1] == max(numbers)  # noqa: E731
    return {
        "the top floor has the largest force (2 and 3 storeys)": sum(
            top(forces[p, 2]) and top(forces[p, 3]) for p in PAIRS
        ),
        "3 storeys: more force than 1": sum(largest[p][2] > largest[p][0] for p in PAIRS),
        "1 < 2 < 3 storeys": sum(largest[p][0] < largest[p][1] < largest[p][2] for p in PAIRS),
        "the top floor of 3 has most contacts": sum(top(contacts[p]) for p in PAIRS),
    }


def counts_table(record):
    by_law = {law: counts(record, law) for law in LAWS}
    head = [f"true in how many of {len(PAIRS)} pairs of periods", *(f"`{law}`" for law in LAWS)]
    body = [[what, *(str(by_law[law][what]) for law in LAWS)] for what in by_law[LAWS[0]]]
    return statement.numbers(head, body)


def statements(record):
    return [*orderings(record), values(record), stiffness(record), gap(record)]


def orderings(record):
    by_law = [counts(record, law) for law in LAWS]
    top, more, strict, _ = ([of[what] for of in by_law] for what in by_law[0])
    of_all = f"of {len(PAIRS)} pairs of periods, by law"
    return [
        Statement("section 4.3", "the largest force is at the top floor", verdict(top), f"in {span(top)} {of_all}"),
        Statement("Fig. 19", "3 storeys hit harder than 1", verdict(more), f"in {span(more)} {of_all}"),
        Statement("Fig. 19", "each storey adds force: 1 < 2 < 3", verdict(strict), f"in {span(strict)} {of_all}"),
    ]


def values(record):
    largest = {height: [] for height in HEIGHTS}
    for (_, _, height), (forces, _) in sweep(record).items():
        largest[height].append(max(forces) / 1e3)
    ranges = [f"{min(found):.0f} to {max(found):.0f} kN with {height}" for height, found in largest.items()]
    return Statement(
        "Fig. 19",
        "35, 75 and 325 kN with 1, 2 and 3 storeys",
        statement.NOT_TO_BE_HAD,
        f"the text lacks what decides them: stiffness of the storeys, damping, law, n, component of the record. Over "
        f"all periods and laws ours are {'; '.join(ranges)}. Periods, k and law fitted to three numbers would show "
        f"nothing",
    )


def stiffness(record):
    """Whether the paper's k can be in the unit that is printed."""
    speeds = [
        max((episode.approach_velocity for episode in run(record, LAWS[0], pair, 3).episodes), default=0.0)
        for pair in PAIRS
    ]
    hard = run(record, "linear", DRAWN, 3, KILONEWTON_PER_MILLIMETRE).peak_force() / 1e6
    as_printed, softer = needed_speeds(KILONEWTON_PER_MILLIMETRE), needed_speeds(free_impact.STIFFNESS)
    listed = lambda found, digits: ", ".join(f"{1e3 * speed:.{digits}f}" for speed in found)  # noqa: E731
    return Statement(
        "section 4.3",
        "k is 30000 kN/mm",
        statement.holds(min(speeds) < max(as_printed)),
        f"then a linear contact has the published forces at {listed(as_printed, 1)} mm/s; three storeys meet at up to "
        f"{min(speeds):.2f} to {max(speeds):.2f} m/s, and those with periods {DRAWN[0]} and {DRAWN[1]} s press with "
        f"{hard:.0f} MN. With 30000 kN/m it takes {listed(softer, 0)} mm/s: most likely a misprint for kN/m",
    )


def needed_speeds(stiffness):
    """m/s, with which a linear contact has the published forces."""
    force = free_impact.run("linear", stiffness=stiffness, speed=1.0).peak_force
    return [1e3 * published / force for published in PUBLISHED.values()]


def gap(record):
    touching = sum(sum(contacts) > 0 for _, contacts in sweep(record).values())
    return Statement(
        "section 4.3",
        "a gap of 5 mm is sufficient to preclude contact",
        statement.holds(touching == 0),
        f"the buildings touch in {touching} of {len(sweep(record))} runs; the study itself is one of impacts",
    )


def verdict(counted):
    """Of an ordering that is true in so many pairs of periods, by law."""
    return statement.of_an_ordering([is_true for of_law in counted for is_true in (of_law > 0, of_law == len(PAIRS))])


def span(numbers):
    return f"{min(numbers)}" if min(numbers) == max(numbers) else f"{min(numbers)} to {max(numbers)}"


def draw(folder):
    draw_one(folder / "heights_el_centro.png", scenes.EL_CENTRO, "El Centro 1940 NS")


def draw_under(kobe, folder):
    draw_one(folder / "heights_kobe.png", kobe, "Kobe 1995")


def draw_one(picture, record, earthquake):
    plt = style.pyplot()
    figure = plt.figure(figsize=(11.4, 6.6), layout="constrained")
    histories, right = figure.subfigures(1, 2, width_ratios=[1.35, 1])
    figure.suptitle(
        f"{earthquake}, scaled to 0.7105 g; eq. 14 with a spring 3k/2, k = 3e7 N/m$^{{1.5}}$, e = 0.5",
        x=0.01,
        ha="left",
        fontsize=11.5,
    )
    draw_histories(histories.subplots(3, 1, sharex=True, sharey=True), record)
    floors, sweeps = right.subplots(2, 1, height_ratios=[1, 1.3])
    draw_floors(floors, record)
    draw_sweep(sweeps, record)
    style.save(figure, picture)


def draw_histories(panels, record):
    for axes, height in zip(panels, HEIGHTS):
        name = f"contact[{height}].force"
        done = run(record, LAWS[0], DRAWN, height, step=5e-4, columns=(name,))
        axes.plot(done.motion["time"], done.motion[name] / 1e3, color=style.BLACK, linewidth=0.8)
        count = len(done.of_contact(height))
        axes.set_title(
            f"{height} storey{'s' if height > 1 else ''}: {count} contacts of the top floors, up to "
            f"{done.peak_force(height) / 1e3:.0f} kN"
        )
        axes.set_ylabel("force [kN]")
        hit = [episode.start_s for episode in done.episodes]
    panels[-1].set(xlabel="time [s]", xlim=(0, min(SCENE["stop_time"], hit[-1] + 1)), ylim=(0, None))


def draw_floors(axes, record):
    hatches = ["", "///", "..."]
    for height, colour in zip(HEIGHTS, (style.SKY, style.ORANGE, style.GREEN)):
        done = run(record, LAWS[0], DRAWN, height)
        for floor in range(1, height + 1):
            place, force = floor + 0.26 * (height - 2), done.peak_force(floor) / 1e3
            axes.barh(
                place,
                force,
                0.24,
                color=colour,
                edgecolor=style.BLACK,
                linewidth=0.6,
                hatch=hatches[height - 1],
                label=f"{height} storey{'s' if height > 1 else ''}" if floor == 1 else None,
            )
    axes.set(
        xlabel="largest force [kN]",
        ylabel="floor",
        title=f"By floor; periods with one storey {DRAWN[0]} and {DRAWN[1]} s",
        ylim=(0.5, 3.6),
    )
    axes.set_yticks(HEIGHTS)
    axes.grid(axis="y", visible=False)
    axes.legend(loc="lower right", reverse=True)


def draw_sweep(axes, record):
    """A point for each pair of periods: above the diagonal three storeys hit harder than one."""
    forces = {pair: [max(sweep(record)[LAWS[0], pair, height][0]) / 1e3 for height in HEIGHTS] for pair in PAIRS}
    rising = [found for found in forces.values() if found[0] < found[1] < found[2]]
    harder = [found for found in forces.values() if found[0] < found[2] and found not in rising]
    softer = [found for found in forces.values() if not found[0] < found[2]]
    for found, mark, colour, label in [
        (rising, "o", style.GREEN, "1 < 2 < 3 storeys"),
        (harder, "^", style.ORANGE, "1 < 3, but 2 out of order"),
        (softer, "v", style.VERMILION, "3 storeys hit no harder than 1"),
    ]:
        axes.plot(
            [of[0] for of in found],
            [of[2] for of in found],
            mark,
            color=colour,
            markeredgecolor=style.BLACK,
            markeredgewidth=0.5,
            markersize=6,
            label=f"{label}: {len(found)} pair{'s' if len(found) != 1 else ''}",
        )
    axes.plot(PUBLISHED[1], PUBLISHED[3], "s", color=style.BLACK, markerfacecolor="white", markersize=8, label="published")
    axes.plot([150, 3000], [150, 3000], color=style.GREY, linewidth=1, zorder=1, label="the same force")
    axes.set(
        xlabel="largest force with 1 storey [kN]",
        ylabel="with 3 storeys [kN]",
        xscale="log",
        yscale="log",
        ylim=(4, 5000),
        title=f"All {len(PAIRS)} pairs of periods from {PERIODS[0]} to {PERIODS[-1]} s",
    )
    axes.legend(loc="lower right", fontsize=8.5)


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--kobe", type=existing, metavar="FILE", help="your record of Kobe, CSV or AT2")
    kobe = arguments.parse_args().kobe
    draw(statement.PICTURES)
    statement.publish(parts())
    if kobe is not None:
        draw_under(kobe, statement.PICTURES)
        statement.publish(parts_under(kobe))


if __name__ == "__main__":
    main()
