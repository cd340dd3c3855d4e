"""What stands where in a scene: floors at their levels, foundations on soil, what meets at each contact, what links join. The
engine says it."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import _native

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .runs import Run

SIDES = ("left", "right")
Surface = dict[str, Any]  # on one side of a gap or at one end of a link; its `kind` is floor, columns or wall
Levels = dict[str, "NDArray[Any]"]


class Layout:
    """What pictures need to know of a scene. Only buildings that are there are in its dictionaries."""

    def __init__(self, scene: _native.Scene) -> None:
        told = json.loads(scene.layout())
        self.name: str = told["name"]
        self.floors: dict[str, int] = {side: told[side]["floors"] for side in SIDES if told[side]["floors"] > 0}
        levels = {side: told[side]["levels"] for side in self.floors}
        self.has_levels = None not in levels.values()
        # From the ground floor up: m, or storeys of height 1 where not all buildings have heights.
        self.levels: Levels = {
            side: np.array(levels[side]) if self.has_levels else np.arange(count + 1.0)
            for side, count in self.floors.items()
        }
        # What the soil under each foundation is made of.
        self.foundations: dict[str, dict[str, list[str]]] = {
            side: soil for side in self.floors if (soil := told[side]["foundation"]) is not None
        }
        # m, from floor to floor, of buildings that have heights.
        self.heights = {side: np.diff(own) for side, own in levels.items() if own is not None}
        self.contacts = [Contact(contact, self) for contact in told["contacts"]]
        self.links = [Link(link) for link in told["links"]]

    @property
    def top(self) -> float:
        return max(float(levels[-1]) for levels in self.levels.values())

    @property
    def bottom(self) -> float:
        return min(float(levels[0]) for levels in self.levels.values())

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
        # Sides, names of variables, and how much of each the surfaces come nearer.
        self.row: list[tuple[str, str, float]] = told["row"]
        self.surfaces: dict[str, Surface] = {side: told[side] for side in SIDES}
        heights = [height(surface, scene.levels) for surface in self.surfaces.values() if surface["kind"] != "wall"]
        self.height = float(np.mean(heights))
        self.meeting = in_words(*self.surfaces.values())
        self.name = self.meeting + (f", level {self.height:.4g} m" if scene.has_levels else "")
        self.title = self.name[:1].upper() + self.name[1:]
        self.is_rigid = self.law == "stereomechanical"

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

    def __init__(self, told: dict[str, Any]) -> None:
        self.parts: list[str] = told["parts"]
        self.surfaces: dict[str, Surface] = {side: told[side] for side in SIDES}
        self.name = in_words(*self.surfaces.values()).replace("wall", "ground")
        self.made_of = " and ".join(self.parts)


def slabs_of(link: Link) -> list[tuple[str, int]]:
    """Side and number of the floors that a link joins; 0 is the foundation."""
    return [(side, surface["floor"]) for side, surface in link.surfaces.items() if surface["kind"] == "floor"]


def height(surface: Surface, levels: Levels) -> float:
    """Of a floor or of a place on columns, among the levels of the buildings."""
    own = levels[surface["side"]]
    if surface["kind"] == "floor":
        return float(own[surface["floor"]])
    below, above = own[surface["storey"] - 1], own[surface["storey"]]
    return float(below + surface["position"] * (above - below))


def in_words(left: Surface, right: Surface) -> str:
    """What meets, in few words."""
    if left["kind"] == right["kind"] == "floor":
        is_same = left["floor"] == right["floor"]
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


def clamped(s: Any) -> Any:
    """How far columns with ends that do not rotate are displaced at the share s of their height: an S from 0 to 1."""
    return s * s * (3.0 - 2.0 * s)
