"""What meets in a scene: its buildings at rest with their contacts, numbered, and in words beside them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from matplotlib.figure import Figure

from .elevation import Elevation, prepare_height
from .layout import Contact, Layout
from .runs import Runs
from .style import BLACK

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

LABEL: dict[str, Any] = {"ha": "center", "va": "center", "fontsize": 9.5, "zorder": 8}
SMALLEST_GAP = 10.0  # mm, which can be seen
MOST_NUMBERED = 12  # buildings whose contacts have numbers
MOST_LINES = 40  # a line for each contact
LETTERS, MOST_NAMES = 110, 50  # of names below a row: so many beside each other, or upright


def contacts(runs: Runs) -> Figure:
    """A picture of any scene: which of its floors face what."""
    scene = runs.scene
    lines = words(scene)
    # As high as the words and the floors need.
    height = max(5.2, 0.6 + 0.26 * len(lines), 1.0 + 0.4 * max(scene.floors.values()))
    many = max(0, len(scene.floors) - 2)
    figure = Figure(figsize=(min(10 + 1.6 * many, 24), height))
    axes, said = figure.subplots(1, 2, width_ratios=[1.6 + 0.5 * min(many, 5), 1])
    draw_meetings(axes, scene)
    said.axis("off")
    said.set_title("Contacts")
    said.text(0.0, 1.0, "\n".join(lines), va="top", linespacing=1.7, transform=said.transAxes)
    return figure


def draw_meetings(axes: Axes, scene: Layout, most: int = 100, always: int | None = None) -> None:
    """The buildings at rest, and what meets, numbered.

    Of more than `most` floors the roof alone has its number, of more contacts every second, third ... and `always`,
    which is the only one among many buildings.
    """
    # A gap is wide enough for a number.
    width = 6.5 * max(SMALLEST_GAP, *(1e3 * pair.gap for pair in scene.contacts)) if scene.contacts else 300.0
    said = "At rest; gaps to scale, widths not" if scene.contacts else "At rest"
    elevation = stand(axes, scene, width, said, margin=0.2)
    if scene.is_pair:
        for side, count in scene.floors.items():
            write_levels(axes, elevation, side, lowest=1 if count <= most else count)
    else:
        write_names(axes, elevation)
    # Among narrow buildings there is room for one number.
    every = -(-len(scene.contacts) // most) if len(scene.floors) <= MOST_NUMBERED else len(scene.contacts) + 1
    for p, (face, pair) in enumerate(zip(elevation.faces, scene.contacts), 1):
        if p % every == 0 or p == always:
            mark(axes, p, pair, face, width, scene)


def words(scene: Layout) -> list[str]:
    """A line for each contact, the floors that have none, a line for each way of a foundation and for each link; of many
    contacts a line for each two buildings."""
    if len(scene.contacts) > MOST_LINES:
        return briefly(scene)
    lines = []
    for p, pair in enumerate(scene.contacts, 1):
        at = [f" at {surface['position']:.3g}" for surface in pair.surfaces.values() if surface["kind"] == "columns"]
        lines.append(f"{p}   {pair.meeting}{''.join(at)}: {1e3 * pair.gap:g} mm")
    faces = [surface for pair in scene.contacts for surface in pair.surfaces.values()]
    for side, count in scene.floors.items():
        alone = [i for i in range(1, count + 1) if {"kind": "floor", "side": side, "floor": i} not in faces]
        if alone:
            lines += ["", f"no contact: {side} floor {', '.join(map(str, alone))}"]
    for side, soil in scene.foundations.items():
        ways = [("sways", soil["sway"]), ("rocks", soil["rocking"])]
        lines += ["", *(f"{side} foundation {way}: {' and '.join(parts)}" for way, parts in ways if parts)]
    links = [f"link {at}   {link.name}: {link.made_of}" for at, link in enumerate(scene.links, 1)]
    return [*lines, "", *links] if links else lines


def briefly(scene: Layout) -> list[str]:
    """A line for each two buildings, or building and wall, that have contacts: which, and their gaps."""
    found: dict[str, list[int]] = {}
    for p, pair in enumerate(scene.contacts, 1):
        found.setdefault(", ".join(pair.sides) if len(pair.sides) > 1 else f"{pair.sides[0]}, wall", []).append(p)
    lines = []
    for between, own in found.items():
        gaps = sorted({1e3 * scene.contacts[p - 1].gap for p in own})
        wide = f"{gaps[0]:g} mm" if len(gaps) == 1 else f"{gaps[0]:g} to {gaps[-1]:g} mm"
        numbers = f"{own[0]}" if len(own) == 1 else f"{own[0]} to {own[-1]}" if own[-1] - own[0] == len(own) - 1 else f"{len(own)}"
        lines.append(f"{numbers}   {between}: {wide}")
    return lines


def write_levels(axes: Axes, elevation: Elevation, side: str, lowest: int) -> None:
    """On each slab from the lowest up, far from the other building, its number and level."""
    is_first = side == elevation.scene.names[0]
    for floor, level in list(enumerate(elevation.scene.levels[side]))[lowest:]:
        far = elevation.edges[side][floor - 1] + (0.14 if is_first else 0.86) * elevation.width
        text = f"{floor}: {level:.4g} m" if elevation.scene.has_levels else f"{floor}"
        align = "left" if is_first else "right"
        look: dict[str, Any] = {"ha": align, "color": elevation.scene.looks[side]["color"], "fontsize": 9.5}
        axes.annotate(text, (far, level), (0, 7), textcoords="offset points", **look)


def write_names(axes: Axes, elevation: Elevation) -> None:
    """Below each building of a row its name, upright where there are many; of more than there is room for every second, third
    ... and the last one."""
    names, looks = elevation.scene.names, elevation.scene.looks
    every, last = -(-len(names) // MOST_NAMES), len(names) - 1
    written = [side for at, side in enumerate(names) if at == last or at % every == 0 and at + every <= last]
    is_upright = max(map(len, names)) > LETTERS / len(names)
    axes.set_xticks([elevation.middle(side) for side in written], written, rotation=90 if is_upright else 0)
    axes.tick_params(axis="x", length=0, labelsize=9.5)
    for side, label in zip(written, axes.get_xticklabels()):
        label.set_color(looks[side]["color"])


def mark(axes: Axes, p: int, pair: Contact, face: float, width: float, scene: Layout) -> None:
    """An arrow across the gap, from a slab to what it hits, and the number of the contact."""
    gap = 1e3 * pair.gap
    left, right = pair.surfaces["left"]["kind"], pair.surfaces["right"]["kind"]
    hits = {"floor": "<|-|>", "columns": "-|>", "wall": "-|>"}
    ends = (face + gap, face) if left != "floor" else (face, face + gap)
    look = {"arrowstyle": hits[right if left == "floor" else left], "color": BLACK, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", (ends[1], pair.height), (ends[0], pair.height), arrowprops=look)
    # Beside columns that are hit: contacts of nearly one level are on different sides then.
    aside = {"columns": face - 0.13 * width}.get(left) or {"columns": face + gap + 0.13 * width}.get(right)
    above = 0.045 * (scene.top - scene.bottom)
    number(axes, face + gap / 2 if aside is None else aside, pair.height + (above if aside is None else 0.0), p)


def stand(
    axes: Axes,
    scene: Layout,
    width: float,
    title: str,
    displacements: Mapping[str, NDArray[Any]] | None = None,
    margin: float = 0.5,
) -> Elevation:
    """The buildings of a scene; displacements, mm, of the floors of each."""
    elevation = Elevation(axes, scene, width)
    if displacements is not None:
        elevation.place(displacements)
    prepare_height(axes, scene)
    left, right = elevation.ends()
    xlim = left - margin * width, right + margin * width
    height = scene.top - elevation.bottom
    axes.set(xlim=xlim, ylim=(elevation.bottom - 0.06 * height, scene.top + 0.08 * height), title=title)
    axes.set_xticks([])
    axes.grid(False)
    elevation.draw_surroundings(axes, xlim)
    return elevation


def number(axes: Axes, x: float, y: float, p: int) -> None:
    """The number of a contact in a circle."""
    look = {"boxstyle": "circle,pad=0.25", "facecolor": "white", "edgecolor": BLACK, "linewidth": 1.2}
    axes.text(x, y, str(p), bbox=look, **LABEL)
