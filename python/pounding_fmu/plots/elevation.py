"""Buildings, foundations, links, walls and ground of a scene as they stand: upright to the scale of their levels, across in mm,
with widths that fit. The animation moves them."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.patches import Rectangle

from .devices import Device, stacked
from .layout import ENDS, Contact, Layout, Link, clamped
from .soil import STILL, Column, Foot, Foundation, Slab
from .style import GREY, SOLID

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

# mm between buildings of which no contact says how far apart they are.
USUAL_GAP = 50.0
# Shares of the width of a building: from the edge of a slab to its link, and to what holds the link on the ground.
INSET, TO_GROUND = 0.2, 0.3
WALL = 0.12  # of the width: a wall between two buildings, if there is room for it
STOREYS_ON_SOIL = 0.12, 0.25  # of the whole height, least and most: for foundations to be seen, and not to be towers


class Elevation:
    """At rest, in mm from the first building's right edge: `edges` has the left edge of each floor of each building, and
    `faces` the left surface of each contact."""

    def __init__(self, axes: Axes, scene: Layout, width: float) -> None:
        self.scene, self.width = scene, width
        self.edges = left_edges(scene, width)
        self.buildings = {side: Building(axes, scene, side, edges, width) for side, edges in self.edges.items()}
        self.faces = [self.left_face(pair) for pair in scene.contacts]
        storey = float(np.mean([np.mean(np.diff(levels)) for levels in scene.levels.values()]))
        self.links = [
            Device(axes, link, self.ends_of(link), storey, hung) for link, hung in zip(scene.links, stacked(scene.links))
        ]
        least, most = (share * (scene.top - scene.bottom) for share in STOREYS_ON_SOIL)
        on_soil = min(max(storey, least), most)
        self.foundations = {
            side: Foundation(axes, scene, side, self.edges[side][0], width, on_soil) for side in scene.foundations
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
        edges = [float(edge) for own in self.edges.values() for edge in own]
        held = [float(x) for foundation in self.foundations.values() for x in foundation.ends()]
        return min([*edges, *outer, *held]), max([max(edges) + self.width, *outer, *held])

    def place(self, displacements: Mapping[str, NDArray[Any]], feet: Mapping[str, Foot] | None = None) -> None:
        """Moves the floors of each building, mm, and its foundation."""
        at = feet or {}
        for side, building in self.buildings.items():
            building.place(displacements[side], at.get(side, STILL))
        for side, foundation in self.foundations.items():
            foundation.place(at.get(side, STILL))
        for link in self.links:
            moved = {
                end: float(displacements[side][floor - 1]) if floor else at.get(side, STILL).displacement
                for end, (side, floor) in link.link.slabs.items()
            }
            link.place((moved.get("left", 0.0), moved.get("right", 0.0)))

    def ends_of(self, link: Link) -> list[NDArray[Any]]:
        """mm and level of the points that a link is between, at rest."""
        inset, ends = INSET * self.width, {}
        for end, (side, floor) in link.slabs.items():
            edge = self.edges[side][max(floor, 1) - 1]
            across = edge + (self.width - inset if end == "left" else inset)
            ends[end] = np.array([across, self.scene.levels[side][floor]])
        for end, other, away in (("left", "right", -1), ("right", "left", 1)):
            if end not in ends:
                ends[end] = ends[other] + [away * (inset + TO_GROUND * self.width), 0.0]
        return [ends[end] for end in ENDS]

    def left_face(self, pair: Contact) -> float:
        end = "right" if pair.surfaces["left"]["kind"] == "wall" else "left"
        side = pair.surfaces[end]["side"]
        edge = self.edge_at(side, pair.height_on(side, self.scene.levels) or 0.0)
        return edge + self.width if end == "left" else edge - 1e3 * pair.gap

    def edge_at(self, side: str, level: float) -> float:
        """The left edge of a building at any level."""
        return float(np.interp(level, self.scene.levels[side][1:], self.edges[side]))

    def middle(self, side: str) -> float:
        """Of a building, at its lowest floor."""
        return float(self.edges[side][0]) + self.width / 2

    def draw_surroundings(self, axes: Axes, xlim: tuple[float, float]) -> None:
        """The ground at the level of each building, and walls up to a little above what hits them."""
        scene = self.scene
        for device in self.devices:
            for (x, level), end in zip(device.ends, ENDS):
                if device.link.surfaces[end]["kind"] == "wall":
                    far = -0.03 * self.width if end == "left" else 0.03 * self.width
                    low = level - device.depth(len(device.link.parts) - 1) - 0.1 * device.storey
                    axes.add_patch(Rectangle((x, low), far, level - low, **SOLID))
        levels = [
            self.foundations[side].bottom if side in self.foundations else scene.levels[side][0] for side in scene.floors
        ]
        lowest = [float(edges[0]) for edges in self.edges.values()]
        steps = [(left + self.width + right) / 2 for left, right in zip(lowest, lowest[1:])]
        axes.plot([xlim[0], *np.repeat(steps, 2), xlim[1]], np.repeat(levels, 2), color=GREY, linewidth=3)
        for face, pair in zip(self.faces, scene.contacts):
            for end in ENDS:
                if pair.surfaces[end]["kind"] == "wall":
                    near = face if end == "left" else face + 1e3 * pair.gap
                    far = self.behind(pair.sides[0], end, near, pair.height, xlim)
                    top = pair.height + 0.03 * (scene.top - scene.bottom)
                    axes.add_patch(Rectangle((near, self.bottom), far - near, top - self.bottom, **SOLID))

    def behind(self, side: str, end: str, near: float, level: float, xlim: tuple[float, float]) -> float:
        """How far a wall goes on that stands beside a building: to the edge of the picture, or within the gap to the next one."""
        away = -1 if end == "left" else 1
        beside = self.scene.beside(side, away)
        if beside is None:
            return xlim[0] if end == "left" else xlim[1]
        neighbour = self.edge_at(beside, level) + (self.width if end == "left" else 0.0)
        room = max(0.0, 0.6 * away * (neighbour - near))
        return near + away * min(room, WALL * self.width)


class Building:
    """Slabs and columns of one building."""

    def __init__(self, axes: Axes, scene: Layout, side: str, edges: NDArray[Any], width: float) -> None:
        self.levels, self.edges = scene.levels[side], edges
        colour = scene.looks[side]["color"]
        slab = float(np.mean(np.diff(self.levels))) * max(0.12, 0.016 * len(edges))
        self.thickness = width * max(0.02, 0.05 - 0.002 * len(edges))
        # Columns stand a little inside of the ends of slabs, unless they are hit.
        inset = 0.0 if any(is_hit(pair, side) for pair in scene.contacts) else 0.06 * width
        self.offsets = [inset, width - inset - self.thickness]
        asides = [offset + self.thickness / 2 - width / 2 for offset in self.offsets]
        self.columns = [Column(axes, aside, colour) for aside in asides]
        self.slabs = [Slab(axes, level, (width, slab), colour) for level in self.levels[1:]]
        self.rise = scene.rise(side) if side in scene.foundations else np.zeros(len(edges))
        self.place(np.zeros(len(edges)), STILL)

    def place(self, displacements: NDArray[Any], foot: Foot) -> None:
        """Moves its floors, mm, which are tilted as its foundation is."""
        at, leans = self.edges + displacements, self.rise * foot.rotation
        for slab, x, lean in zip(self.slabs, at, leans):
            slab.place(x, lean)
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


def left_edges(scene: Layout, width: float) -> dict[str, NDArray[Any]]:
    """mm, of each floor of each building. Where no contact says how far apart two floors are, it is as below or above."""
    edges: dict[str, NDArray[Any]] = {}
    for side, count in scene.floors.items():
        beside, own = scene.beside(side, -1), scene.levels[side][1:]
        if beside is None:
            edges[side] = np.full(count, -width)
        else:
            right = np.interp(own, scene.levels[beside][1:], edges[beside]) + width
            edges[side] = right + gaps_at(scene, beside, side)
    return edges


def gaps_at(scene: Layout, left: str, right: str) -> NDArray[Any]:
    """mm, between two neighbours at the levels of the floors of the right one."""
    between = [pair for pair in scene.contacts if pair.sides == [left, right]]
    known = sorted((pair.height_on(right, scene.levels) or 0.0, 1e3 * pair.gap) for pair in between)
    heights, gaps = zip(*(known or [(0.0, USUAL_GAP)]))
    at: NDArray[Any] = np.interp(scene.levels[right][1:], heights, gaps)
    return at


def prepare_height(
    axes: Axes, scene: Layout, more: str | None = None, of: Collection[str] | None = None
) -> None:
    """An upright axis, for these buildings or for all: levels to scale where the scene has them, else floors."""
    levels = [scene.levels[side] for side in (of or scene.names)]
    bottom, top = min(float(own[0]) for own in levels), max(float(own[-1]) for own in levels)
    said = "level [m]" if scene.has_levels else "floor; storeys drawn equally high"
    axes.set_ylabel(f"{said}\n({more})" if more else said)
    axes.set_ylim(bottom, top + 0.02 * (top - bottom))
    if not scene.has_levels:
        axes.set_yticks(range(0, round(top) + 1, max(1, round(top) // 12)))
