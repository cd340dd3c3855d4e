"""Buildings, foundations, links, walls and ground of a scene as they stand: upright to the scale of their levels, across in mm,
with widths that fit. The animation moves them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.patches import Rectangle

from .devices import Device, stacked
from .layout import SIDES, Contact, Layout, Link, clamped, slabs_of
from .soil import STILL, Column, Foot, Foundation, Slab
from .style import BUILDINGS, GREY, SOLID

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

# mm between buildings of which no contact says how far apart they are.
USUAL_GAP = 50.0
# Shares of the width of a building: from the edge of a slab to its link, and to what holds the link on the ground.
INSET, TO_GROUND = 0.2, 0.3
STOREYS_ON_SOIL = 0.12, 0.25  # of the whole height, least and most: for foundations to be seen, and not to be towers


class Elevation:
    """At rest, in mm from the left building's edge at the gap: `inner` has each floor's edge there, of both buildings,
    and `faces` the left surface of each contact."""

    def __init__(self, axes: Axes, scene: Layout, width: float) -> None:
        self.scene, self.width = scene, width
        self.inner = inner_edges(scene)
        self.buildings = {side: Building(axes, scene, side, edges, width) for side, edges in self.inner.items()}
        self.faces = [self.left_face(pair) for pair in scene.contacts]
        storey = float(np.mean([np.mean(np.diff(levels)) for levels in scene.levels.values()]))
        self.links = [
            Device(axes, link, self.ends_of(link), storey, hung) for link, hung in zip(scene.links, stacked(scene.links))
        ]
        least, most = (share * (scene.top - scene.bottom) for share in STOREYS_ON_SOIL)
        on_soil = min(max(storey, least), most)
        self.foundations = {
            side: Foundation(axes, scene, side, self.inner[side][0], width, on_soil) for side in scene.foundations
        }
        self.bottom = min([scene.bottom, *(foundation.bottom for foundation in self.foundations.values())])

    @property
    def devices(self) -> list[Device]:
        """All that joins floors or foundations with each other and with the ground."""
        sways = [foundation.device for foundation in self.foundations.values()]
        return [*self.links, *(device for device in sways if device is not None)]

    def ends(self) -> tuple[float, float]:
        """mm, from wall to wall or from edge to edge."""
        gaps = [1e3 * pair.gap for pair in self.scene.contacts]
        outer = [*self.faces, *(face + gap for face, gap in zip(self.faces, gaps))]
        right = self.inner["right"].max() + self.width if "right" in self.inner else 0.0
        held = [float(x) for foundation in self.foundations.values() for x in foundation.ends()]
        return min([-self.width, *outer, *held]), max([right, *outer, *held])

    def place(self, displacements: Mapping[str, NDArray[Any]], feet: Mapping[str, Foot] | None = None) -> None:
        """Moves the floors of each building, mm, and its foundation."""
        at = feet or {}
        for side, building in self.buildings.items():
            building.place(displacements[side], at.get(side, STILL))
        for side, foundation in self.foundations.items():
            foundation.place(at.get(side, STILL))
        for link in self.links:
            moved = {
                side: float(displacements[side][floor - 1]) if floor else at.get(side, STILL).displacement
                for side, floor in slabs_of(link.link)
            }
            link.place((moved.get("left", 0.0), moved.get("right", 0.0)))

    def ends_of(self, link: Link) -> list[NDArray[Any]]:
        """mm and level of the points that a link is between, at rest."""
        inset, ends = INSET * self.width, {}
        for side, floor in slabs_of(link):
            across = self.inner[side][max(floor, 1) - 1] + (-inset if side == "left" else inset)
            ends[side] = np.array([across, self.scene.levels[side][floor]])
        for side, other, away in (("left", "right", -1), ("right", "left", 1)):
            if side not in ends:
                ends[side] = ends[other] + [away * (inset + TO_GROUND * self.width), 0.0]
        return [ends[side] for side in SIDES]

    def left_face(self, pair: Contact) -> float:
        left, right = pair.surfaces["left"], pair.surfaces["right"]
        surface = right if left["kind"] == "wall" else left
        if surface["side"] == "left":
            edges = -self.width, 0.0
        else:
            levels = self.scene.levels["right"]
            inner = float(np.interp(pair.height_on("right", self.scene.levels) or 0.0, levels[1:], self.inner["right"]))
            edges = inner, inner + self.width
        return edges[0] - 1e3 * pair.gap if left["kind"] == "wall" else edges[1]

    def draw_surroundings(self, axes: Axes, xlim: tuple[float, float]) -> None:
        """The ground at the level of each building, and walls up to a little above what hits them."""
        scene = self.scene
        for device in self.devices:
            for (x, level), side in zip(device.ends, SIDES):
                if device.link.surfaces[side]["kind"] == "wall":
                    far = -0.03 * self.width if side == "left" else 0.03 * self.width
                    low = level - device.depth(len(device.link.parts) - 1) - 0.1 * device.storey
                    axes.add_patch(Rectangle((x, low), far, level - low, **SOLID))
        step = self.inner["right"][0] / 2 if "right" in self.inner else xlim[1]
        levels = [
            self.foundations[side].bottom if side in self.foundations else scene.levels[side][0] for side in scene.floors
        ]
        axes.plot([xlim[0], step, step, xlim[1]], np.repeat(levels, 4 // len(levels)), color=GREY, linewidth=3)
        for face, pair in zip(self.faces, scene.contacts):
            for side in SIDES:
                if pair.surfaces[side]["kind"] == "wall":
                    near, far = (face, xlim[0]) if side == "left" else (face + 1e3 * pair.gap, xlim[1])
                    top = pair.height + 0.03 * (scene.top - scene.bottom)
                    axes.add_patch(Rectangle((near, self.bottom), far - near, top - self.bottom, **SOLID))


class Building:
    """Slabs and columns of one building."""

    def __init__(self, axes: Axes, scene: Layout, side: str, edges: NDArray[Any], width: float) -> None:
        self.levels, self.edges = scene.levels[side], edges
        colour = BUILDINGS[side]["color"]
        slab = float(np.mean(np.diff(self.levels))) * max(0.12, 0.016 * len(edges))
        self.thickness = width * max(0.02, 0.05 - 0.002 * len(edges))
        # From the inner edge to the left end of a slab. Columns stand a little inside of its ends, unless they are hit.
        self.inner = -width if side == "left" else 0.0
        inset = 0.0 if any(is_hit(pair, side) for pair in scene.contacts) else 0.06 * width
        self.offsets = [self.inner + inset, self.inner + width - inset - self.thickness]
        asides = [offset + self.thickness / 2 - self.inner - width / 2 for offset in self.offsets]
        self.columns = [Column(axes, aside, colour) for aside in asides]
        self.slabs = [Slab(axes, level, (width, slab), colour) for level in self.levels[1:]]
        self.rise = scene.rise(side) if side in scene.foundations else np.zeros(len(edges))
        self.place(np.zeros(len(edges)), STILL)

    def place(self, displacements: NDArray[Any], foot: Foot) -> None:
        """Moves its floors, mm, which are tilted as its foundation is."""
        at, leans = self.edges + displacements, self.rise * foot.rotation
        for slab, x, lean in zip(self.slabs, at, leans):
            slab.place(x + self.inner, lean)
        across, up = bend(np.concatenate([[self.edges[0] + foot.displacement], at]), self.levels, leans)
        for column, offset in zip(self.columns, self.offsets):
            sides = [across + offset, across[::-1] + offset + self.thickness]
            column.place(np.column_stack([np.concatenate(sides), np.concatenate([up, up[::-1]])]), float(leans[0]))


def is_hit(pair: Contact, side: str) -> bool:
    """Whether columns of a building are hit."""
    return any(surface["kind"] == "columns" and surface["side"] == side for surface in pair.surfaces.values())


def bend(
    x: NDArray[Any], levels: NDArray[Any], leans: NDArray[Any], points: int = 13
) -> tuple[NDArray[Any], NDArray[Any]]:
    """Columns from floor to floor; their ends lean by so much a level."""
    s = np.linspace(0.0, 1.0, points)
    turned = leans * np.diff(levels)
    across = [low + (high - low - turn) * clamped(s) + turn * s for low, high, turn in zip(x, x[1:], turned)]
    return np.concatenate(across), np.concatenate([low + (high - low) * s for low, high in zip(levels, levels[1:])])


def inner_edges(scene: Layout) -> dict[str, NDArray[Any]]:
    """Where no contact says how far apart two floors are, it is as below or above."""
    inner = {side: np.zeros(count) for side, count in scene.floors.items()}
    if "right" in inner:
        both = [pair for pair in scene.contacts if {s.get("side") for s in pair.surfaces.values()} == {*SIDES}]
        known = sorted((pair.height_on("right", scene.levels) or 0.0, 1e3 * pair.gap) for pair in both)
        heights, gaps = zip(*(known or [(0.0, USUAL_GAP)]))
        inner["right"] = np.interp(scene.levels["right"][1:], heights, gaps)
    return inner


def prepare_height(axes: Axes, scene: Layout, more: str | None = None) -> None:
    """An upright axis: levels to scale where the scene has them, else floors."""
    said = "level [m]" if scene.has_levels else "floor; storeys drawn equally high"
    axes.set_ylabel(f"{said}\n({more})" if more else said)
    axes.set_ylim(scene.bottom, scene.top + 0.02 * (scene.top - scene.bottom))
    if not scene.has_levels:
        axes.set_yticks(range(0, round(scene.top) + 1, max(1, round(scene.top) // 12)))
