"""What stands where in a scene: floors at their levels, foundations on soil, what meets at each contact, what links join. The
engine says it."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import _native
from .style import looks

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .runs import Run

ENDS = ("left", "right")  # of a gap or a link
Surface = dict[str, Any]  # at one end; its `kind` is floor, columns or wall, its `side` the name of the building
Levels = dict[str, "NDArray[Any]"]


class Layout:
    """What pictures need to know of a scene. Its dictionaries are by the names of the buildings, from left to right."""

    def __init__(self, scene: _native.Scene) -> None:
        told = json.loads(scene.layout())
        self.name: str = told["name"]
        buildings = {building["name"]: building for building in told["buildings"]}
        self.floors: dict[str, int] = {side: building["floors"] for side, building in buildings.items()}
        self.looks = looks(self.floors)
        levels = {side: building["levels"] for side, building in buildings.items()}
        self.has_levels = None not in levels.values()
        # From the ground floor up: m, or storeys of height 1 where not all buildings have heights.
        self.levels: Levels = {
            side: np.array(levels[side]) if self.has_levels else np.arange(count + 1.0)
            for side, count in self.floors.items()
        }
        # What the soil under each foundation is made of.
        self.foundations: dict[str, dict[str, list[str]]] = {
            side: soil for side, building in buildings.items() if (soil := building["foundation"]) is not None
        }
        # m, from floor to floor, of buildings that have heights.
        self.heights = {side: np.diff(own) for side, own in levels.items() if own is not None}
        self.contacts = [Contact(contact, self) for contact in told["contacts"]]
        self.links = [Link(link, self.is_pair) for link in told["links"]]

    @property
    def names(self) -> list[str]:
        """Of the buildings, from left to right."""
        return list(self.floors)

    @property
    def is_pair(self) -> bool:
        """Whether all that can be meant by both buildings are these two."""
        return len(self.floors) <= 2

    @property
    def top(self) -> float:
        return max(float(levels[-1]) for levels in self.levels.values())

    @property
    def bottom(self) -> float:
        return min(float(levels[0]) for levels in self.levels.values())

    def beside(self, side: str, step: int) -> str | None:
        """The neighbour of a building, on its left for -1 and on its right for 1."""
        at = self.names.index(side) + step
        return self.names[at] if 0 <= at < len(self.names) else None

    def rise(self, side: str) -> NDArray[Any]:
        """mm by which each storey of a building leans for a rad, for each level that it is drawn high."""
        leans: NDArray[Any] = 1e3 * self.heights[side] / np.diff(self.levels[side])
        return leans

    def drift(self, run: Run, side: str, storey: int) -> NDArray[Any]:
        """m, what strains the columns of a storey over time: without the part that leans with the foundation."""
        below = f"{side}.displacement[{storey - 1}]" if storey > 1 else f"{side}.foundation.displacement"
        drift: NDArray[Any] = run[f"{side}.displacement[{storey}]"]
        if below in run:
            drift = drift - run[below]
        if (rotation := f"{side}.foundation.rotation") in run:
            drift = drift - self.heights[side][storey - 1] * run[rotation]
        return drift


class Contact:
    """What meets on both sides of a gap, m."""

    def __init__(self, told: dict[str, Any], scene: Layout) -> None:
        self.gap: float = told["gap"]
        self.law: str = told["law"]
        # Buildings, names of variables, and how much of each the surfaces come nearer.
        self.row: list[tuple[str, str, float]] = told["row"]
        self.surfaces: dict[str, Surface] = {end: told[end] for end in ENDS}
        heights = [height(surface, scene.levels) for surface in self.surfaces.values() if surface["kind"] != "wall"]
        self.height = float(np.mean(heights))
        self.meeting = in_words(self.surfaces, scene.is_pair)
        self.name = self.meeting + (f", level {self.height:.4g} m" if scene.has_levels else "")
        begins_with_name = self.name.split()[0] in {*scene.floors} - {*ENDS}
        self.title = self.name if begins_with_name else self.name[:1].upper() + self.name[1:]
        self.is_rigid = self.law == "stereomechanical"

    @property
    def sides(self) -> list[str]:
        """The names of its buildings: two, or that of the one at a wall."""
        return sides_of(self.surfaces)

    def edges(self, run: Run) -> tuple[NDArray[Any], NDArray[Any]]:
        """m, both surfaces over the time of a run: from where the left one is at rest, to the right."""
        left, right = np.zeros_like(run.time), np.full_like(run.time, self.gap)
        for side, name, weight in self.row:
            if self.surfaces["left"].get("side") == side:
                left += weight * run[f"{side}.{name}"]
            else:
                right -= weight * run[f"{side}.{name}"]
        return left, right

    def height_on(self, side: str, levels: Levels) -> float | None:
        """Where a building is touched, or None where it is not."""
        own = [surface for surface in self.surfaces.values() if surface.get("side") == side]
        return height(own[0], levels) if own else None


class Link:
    """What a link joins, and its parts: spring, friction, dashpot. An end on the ground is a wall."""

    def __init__(self, told: dict[str, Any], is_pair: bool = True) -> None:
        self.parts: list[str] = told["parts"]
        self.surfaces: dict[str, Surface] = {end: told[end] for end in ENDS}
        self.name = in_words(self.surfaces, is_pair).replace("wall", "ground")
        self.made_of = " and ".join(self.parts)

    @property
    def sides(self) -> list[str]:
        """The names of its buildings: two, or that of the one that it holds on the ground."""
        return sides_of(self.surfaces)

    @property
    def slabs(self) -> dict[str, tuple[str, int]]:
        """Building and number of the floor at each end that is not on the ground; 0 is the foundation."""
        slabs = {end: surface for end, surface in self.surfaces.items() if surface["kind"] == "floor"}
        return {end: (surface["side"], surface["floor"]) for end, surface in slabs.items()}


def sides_of(surfaces: dict[str, Surface]) -> list[str]:
    return [surface["side"] for surface in surfaces.values() if surface["kind"] != "wall"]


def height(surface: Surface, levels: Levels) -> float:
    """Of a floor or of a place on columns, among the levels of the buildings."""
    own = levels[surface["side"]]
    if surface["kind"] == "floor":
        return float(own[surface["floor"]])
    below, above = own[surface["storey"] - 1], own[surface["storey"]]
    return float(below + surface["position"] * (above - below))


def in_words(surfaces: dict[str, Surface], is_pair: bool) -> str:
    """What meets, in few words; in a scene of two buildings, `both` are these."""
    left, right = (surfaces[end] for end in ENDS)
    if left["kind"] == right["kind"] == "floor":
        is_same = left["floor"] == right["floor"] and is_pair
        if is_same and left["floor"] == 0:
            return "both foundations"
        return f"floor {left['floor']} of both" if is_same else f"{called(left)}, {called(right)}"
    if "wall" in (left["kind"], right["kind"]):
        return f"{called(right)}, wall on its left" if left["kind"] == "wall" else f"{called(left)}, wall on its right"
    hits, hit = sorted((left, right), key=lambda surface: bool(surface["kind"] == "columns"))
    return f"{called(hits)}, columns of {called(hit)}"


def called(surface: Surface) -> str:
    what = "floor" if surface["kind"] == "floor" else "storey"
    if surface[what] == 0:
        return f"{surface['side']} foundation"
    return f"{surface['side']} {what} {surface[what]}"


def building(side: str) -> str:
    """What a line of a building is called: `left` and `right` are no names of it."""
    return f"{side} building" if side in ENDS else side


def titled(side: str, what: str = "building") -> str:
    """The title of a picture of a building, or of its storey 3: a name keeps its letters."""
    if side in ENDS:
        return f"{side.capitalize()} {what}"
    return side if what == "building" else f"{side} {what}"


def clamped(s: Any) -> Any:
    """How far columns with ends that do not rotate are displaced at the share s of their height: an S from 0 to 1."""
    return s * s * (3.0 - 2.0 * s)
