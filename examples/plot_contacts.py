"""Draws docs/images/contacts: a picture of each kind of contact, at rest and pressed, with what its force acts on.

    "$(ci/environment)" examples/plot_contacts.py

What meets, at which levels and in which shares comes from the engine's program. Levels are to scale; gaps and
displacements are drawn larger than they are.
"""

import argparse
from pathlib import Path

import numpy as np
from pounding_fmu._scenes import read_scene
from pounding_fmu.plots.command import draw
from pounding_fmu.plots.layout import Layout, clamped
from pounding_fmu.plots.meetings import LABEL, number, stand
from pounding_fmu.plots.runs import Runs
from pounding_fmu.plots.style import BLACK, GREY, VERMILION, pyplot, save

plt = pyplot()

ROOT = Path(__file__).resolve().parents[1]
WIDTH = 260.0  # mm, of a building that is 40 mm from its neighbour
LAW = {"gap": 0.04, "law": "linear", "stiffness": 1e9}


def building(heights):
    count = len(heights)
    return {"mass": [2e5] * count, "stiffness": [2e8] * count, "damping": {"ratio": 0.05}, "height": heights}


# That of the page.
EXAMPLE = {
    "name": "Pair", "left": building([4.0, 3.2, 3.2, 3.2, 3.2, 3.0]), "right": building([3.5, 3.0, 3.6, 3.0]),
    "facing": {**LAW, "gap": 0.02, "level_tolerance": 0.4},
}  # fmt: skip
SPAN = {"arrowstyle": "<->", "linewidth": 1.0, "shrinkA": 0, "shrinkB": 0}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", type=Path, default=ROOT / "docs/images/contacts", help="folder")
    folder = parser.parse_args().output
    folder.mkdir(parents=True, exist_ok=True)
    level = [{"left_floor": floor, "right_floor": floor, **LAW} for floor in (1, 2)]
    save(floor_and_floor(pair([3.2] * 3, [3.2] * 2, level)), folder / "floors.png")
    upper, lowest = ({"left_floor": storey, "right_storey": storey, **LAW} for storey in (2, 1))
    save(floor_and_columns(pair([3.6, 3.3], [3.6, 4.4, 3.6], [upper])), folder / "columns.png")
    save(floor_and_columns(pair([2.6], [4.4, 3.4], [lowest])), folder / "first_storey.png")
    save(walls(Layout(read_scene(ROOT / "examples/scenes/isolated.toml"))), folder / "walls.png")
    save(draw(Runs(read_scene(EXAMPLE), 1.0), "contacts"), folder / "facing.png")


def pair(left, right, contacts):
    """Two buildings with storeys of these heights."""
    return Layout(read_scene({"name": "Pair", "left": building(left), "right": building(right), "contact": contacts}))


def push(axes, x, y, length, text, beside=False):
    """A force that acts at (x, y), as an arrow from there, and its name above it, or beside where it may be short."""
    arrow = {"arrowstyle": "-|>", "color": BLACK, "linewidth": 2.0, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", (x + length, y), (x, y), arrowprops=arrow, zorder=7)
    if beside:
        axes.annotate(text, (x + length, y), (5, 0), textcoords="offset points", **{**LABEL, "ha": "left"})
    else:
        axes.annotate(text, (x + length / 2, y), (0, 10), textcoords="offset points", **LABEL)


def dimension(axes, near, far, y, text):
    """A distance across."""
    axes.annotate("", (near, y), (far, y), arrowprops=SPAN)
    axes.annotate(text, ((near + far) / 2, y), (0, 9), textcoords="offset points", **LABEL)


def leaning(scene, most):
    """Displacements that grow with the height of each building, mm at its top."""
    return {
        side: most[side] * (levels[1:] - levels[0]) / (levels[-1] - levels[0]) for side, levels in scene.levels.items()
    }


def floors_of(contact):
    """Side, number and share of the floors that take part in a contact of buildings on a fixed base."""
    return [(side, int(name.removeprefix("displacement[").removesuffix("]")), share) for side, name, share in contact.row]


def pressed(scene, p, right_top):
    """The right building leans and the left one so far that contact p closes."""
    contact = scene.contacts[p - 1]
    moved = leaning(scene, {"left": 1.0, "right": right_top})
    left, right = 0.0, 1e3 * contact.gap
    for side, floor, weight in floors_of(contact):
        if weight > 0:
            left += weight * moved[side][floor - 1]
        else:
            right -= weight * moved[side][floor - 1]
    moved["left"] = moved["left"] * right / left
    return moved


def floor_and_floor(scene):
    figure, (rest, closed) = plt.subplots(1, 2, figsize=(8, 3.9), sharey=True)
    stand(rest, scene, WIDTH, "At rest")
    for p, contact in enumerate(scene.contacts, 1):
        number(rest, 0.5e3 * contact.gap, contact.height - 0.75, p)
    top = scene.contacts[-1]
    dimension(rest, 0.0, 1e3 * top.gap, top.height + 0.25, "gap")
    stand(closed, scene, WIDTH, "Contact 2 pressed: F on both floors", pressed(scene, 2, 40.0))
    x = pressed(scene, 2, 40.0)["left"][1]
    push(closed, x - 5, top.height + 0.35, -0.5 * WIDTH, "F")
    push(closed, x + 5, top.height + 0.35, 0.5 * WIDTH, "F")
    closed.set_ylabel("")
    return figure


def floor_and_columns(scene):
    """At rest, pressed with the shares of the force, and where the shares come from."""
    contact = scene.contacts[0]
    surface = contact.surfaces["right"]
    storey, position = surface["storey"], surface["position"]
    levels = scene.levels["right"]
    figure, (rest, closed, shape) = plt.subplots(1, 3, figsize=(11, 4.2), width_ratios=[1, 1, 0.85])
    stand(rest, scene, WIDTH, "At rest", margin=0.25)
    gap = 1e3 * contact.gap
    dimension(rest, 0.0, gap, contact.height + 0.25, "gap")
    at, foot = gap + 0.3 * WIDTH, levels[storey - 1]
    rest.annotate("", (at, foot), (at, contact.height), arrowprops=SPAN)
    rest.text(at + 8, (foot + contact.height) / 2, f"s h\ns = {position:.2g}", **{**LABEL, "ha": "left"})
    rest.plot([gap, at + 15], [contact.height] * 2, color=GREY, linestyle=":", linewidth=1.0)

    moved = pressed(scene, 1, 90.0)
    stand(closed, scene, WIDTH, "Pressed: F on the slab, shares of F opposite", moved, margin=0.35)
    push(closed, moved["left"][-1] - 5, contact.height + 0.3, -0.5 * WIDTH, "F")
    shares = {floor: -weight for side, floor, weight in floors_of(contact) if side == "right"}
    # What the floors do not take is the ground's.
    shares.setdefault(storey - 1, 1.0 - sum(shares.values()))
    for floor, share in shares.items():
        x = gap + (moved["right"][floor - 1] if floor else 0.0)
        text = "N F" if floor == storey else "(1 - N) F"
        push(closed, x + 15, levels[floor] + 0.45, share * 0.5 * WIDTH, text, beside=True)
    closed.set_ylabel("")
    draw_shape(shape, position, shares, storey)
    return figure


def draw_shape(axes, position, shares, storey):
    """Columns between two floors of which the upper one has moved by 1."""
    s = np.linspace(0.0, 1.0, 101)
    above, below = f"floor {storey}", f"floor {storey - 1}" if storey > 1 else "the ground"
    axes.plot(clamped(s), s, color=VERMILION, linewidth=2.5, label='"fixed": $N = 3 s^2 - 2 s^3$')
    axes.plot(s, s, color=GREY, linewidth=2.0, linestyle="--", label='"straight": $N = s$')
    axes.axhline(position, color=BLACK, linestyle=":", linewidth=1.0)
    axes.plot([shares[storey], position], [position] * 2, "o", color=BLACK, markersize=5)
    axes.set(xlim=(-0.05, 1.12), ylim=(-0.02, 1.02), xlabel=f"N: displacement, that of {above} being 1")
    axes.set(ylabel="s: share of the storey's height")
    upper, lower = (f"{100 * shares[floor]:.0f} %" for floor in (storey, storey - 1))
    axes.set_title(f'At s = {position:.2g}, "fixed": {above} takes {upper}\nof the force, {below} the other {lower}')
    axes.legend(loc="lower right", fontsize=9)


def walls(scene):
    """A building in a moat: two contacts, each with one floor."""
    figure, (rest, closed) = plt.subplots(1, 2, figsize=(9, 4.4), sharey=True)
    right = scene.contacts[1]
    reach = 1e3 * right.gap
    width = 6.0 * reach
    elevation = stand(rest, scene, width, "At rest", margin=0.3)
    for p, (face, contact) in enumerate(zip(elevation.faces, scene.contacts), 1):
        number(rest, face + 0.5e3 * contact.gap, contact.height + 1.9, p)
        dimension(rest, face, face + 1e3 * contact.gap, contact.height + 0.4, "gap")
    rest.annotate(
        "isolators:\nthe lowest storey", (-0.92 * width, scene.levels["left"][:2].mean()), (-0.5 * width, 1.7),
        arrowprops={"arrowstyle": "-"}, **LABEL,
    )  # fmt: skip
    moved = reach * (1.0 + 0.04 * np.arange(scene.floors["left"]))
    stand(closed, scene, width, "Contact 2 pressed: F on the floor and on the ground", {"left": moved}, margin=0.3)
    push(closed, reach - 10, right.height + 0.55, -0.3 * width, "F")
    push(closed, reach + 10, right.height + 0.55, 0.25 * width, "F")
    closed.set_ylabel("")
    return figure


if __name__ == "__main__":
    main()
