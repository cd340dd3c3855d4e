"""Foundations as they stand on soil: a block, under it springs and dashpots that it rocks on, beside it those of its sway. What
leans with a foundation is tilted in the picture as its columns are."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.patches import Polygon

from .devices import Device, Line, broken, drawn
from .layout import Layout, Link

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

# Shares of a storey: thickness of a block, and from the level of the ground floor to the bottom of the pit.
BLOCK, PIT = 0.22, 0.85
# Shares of the width of a building: from a block to what holds its sway, from its ends to what it rocks on, and from one part
# of that to the next.
TO_GROUND, INSET, BESIDE = 0.34, 0.12, 0.13
UNDER = 0.17  # of the width: from the middle of a block between two others to each end of what holds its sway
MORE = 0.05  # beyond the ground that holds it


class Foot(NamedTuple):
    """How far a foundation has moved, mm, and turned, rad."""

    displacement: float = 0.0
    rotation: float = 0.0


STILL = Foot()


def tilt(axes: Any, lean: float) -> float:
    """By how many levels a mm across goes down where columns lean by so many mm a level: at a right angle in the picture."""
    x, y = np.diag(axes.transData.transform([[1.0, 0.0], [0.0, 1.0]]) - axes.transData.transform((0.0, 0.0)))
    return lean * float(x / y) ** 2


class Tilted(Polygon):
    """A part of a building that leans by `lean` mm a level."""

    def __init__(self, axes: Axes, colour: str, zorder: int) -> None:
        super().__init__(np.zeros((4, 2)), facecolor=colour, edgecolor="none", zorder=zorder)
        self.lean = 0.0
        axes.add_patch(self)

    def draw(self, renderer: Any) -> None:
        """Once the axes have their limits and their size, on which the tilt depends."""
        self.shape()
        super().draw(renderer)

    def shape(self) -> None:
        raise NotImplementedError


class Column(Tilted):
    """A column of all storeys: `aside` of the middle of the slabs, mm, it goes up and down with their ends."""

    def __init__(self, axes: Axes, aside: float, colour: str) -> None:
        super().__init__(axes, colour, 1)
        self.aside, self.upright = aside, np.zeros((4, 2))

    def place(self, outline: NDArray[Any], lean: float) -> None:
        self.upright, self.lean = outline, lean
        self.shape()

    def shape(self) -> None:
        assert self.axes is not None
        down = tilt(self.axes, self.lean) * self.aside if self.lean else 0.0
        self.set_xy(self.upright - [0.0, down])


class Slab(Tilted):
    """A slab or a block, from its left end at a level, tilted about its middle."""

    def __init__(self, axes: Axes, level: float, size: tuple[float, float], colour: str) -> None:
        super().__init__(axes, colour, 3)
        self.level, self.size, self.x = level, size, 0.0

    def place(self, x: float, lean: float) -> None:
        self.x, self.lean = x, lean
        self.shape()

    def shape(self) -> None:
        assert self.axes is not None
        (width, thickness), x = self.size, self.x
        down = tilt(self.axes, self.lean) * width / 2 if self.lean else 0.0
        left, right = self.level + down, self.level - down
        half = thickness / 2
        self.set_xy([(x, left - half), (x + width, right - half), (x + width, right + half), (x, left + half)])


class Post(Line):
    """A part of what a block rocks on, upright from the bottom of the pit to the block, `aside` mm from the block's middle."""

    def __init__(self, axes: Axes, part: str, middle: float, aside: float, ends: tuple[float, float], storey: float) -> None:
        super().__init__(axes, storey)
        self.part, self.middle, self.aside, self.low, self.high = part, middle, aside, *ends
        self.place(STILL, 0.0)

    def place(self, foot: Foot, lean: float) -> None:
        self.foot, self.lean = foot, lean
        self.shape()

    def shape(self) -> None:
        assert self.axes is not None
        down = tilt(self.axes, self.lean) * self.aside if self.lean else 0.0
        low = np.array([self.middle + self.aside, self.low])
        high = np.array([self.middle + self.aside + self.foot.displacement, self.high - down])
        pieces = drawn(self.part, (low, high), self.across(high - low), float(high[1] - low[1]), self.high - self.low)
        self.set_data(*np.concatenate(list(broken(pieces))).T)


class Foundation:
    """That of a building whose left edge is at `left`, mm, of a storey so high, in levels."""

    def __init__(self, axes: Axes, scene: Layout, side: str, left: float, width: float, storey: float) -> None:
        soil, level = scene.foundations[side], float(scene.levels[side][0])
        self.rise = float(scene.rise(side)[0])
        self.bottom = level - PIT * storey
        self.left = left
        self.block = Slab(axes, level - BLOCK * storey / 2, (width, BLOCK * storey), scene.looks[side]["color"])
        self.block.place(self.left, 0.0)
        middle = self.left + width / 2
        upright = self.bottom, level - BLOCK * storey
        self.posts = [
            Post(axes, part, middle, sign * (0.5 - INSET - BESIDE * place) * width, upright, storey)
            for sign in (-1.0, 1.0)
            for place, part in enumerate(soil["rocking"])
        ]
        self.device = sway_of(axes, scene, side, self.left, width, level, storey) if soil["sway"] else None

    def ends(self) -> tuple[float, float]:
        """mm, from edge to edge, with what holds it."""
        (wide, _), held = self.block.size, self.device.ends if self.device is not None else []
        across = [self.left, self.left + wide, *(float(x) + MORE * wide * sign for sign, (x, _) in zip((-1, 1), held))]
        return min(across), max(across)

    def place(self, foot: Foot) -> None:
        lean = self.rise * foot.rotation
        self.block.place(self.left + foot.displacement, lean)
        for post in self.posts:
            post.place(foot, lean)
        if self.device is not None:
            held_left = self.device.link.surfaces["left"]["kind"] == "wall"
            self.device.place((0.0, foot.displacement) if held_left else (foot.displacement, 0.0))


def sway_of(axes: Axes, scene: Layout, side: str, left: float, wide: float, level: float, storey: float) -> Device:
    """What holds a foundation on the ground: on the side that is away from the gap, or below a block between two others."""
    block = {"kind": "floor", "side": side, "floor": 0}
    free = next((end for end, step in (("left", -1), ("right", 1)) if scene.beside(side, step) is None), None)
    if free is None:
        across, level = (left + (0.5 - UNDER) * wide, left + (0.5 + UNDER) * wide), level - BLOCK * storey
    else:
        across = (left - TO_GROUND * wide, left) if free == "left" else (left + wide, left + (1 + TO_GROUND) * wide)
    parts = scene.foundations[side]["sway"]
    told: dict[str, Any] = {"parts": parts, "left": block, "right": block, free or "right": {"kind": "wall"}}
    ends: list[NDArray[Any]] = [np.array([x, level]) for x in across]
    return Device(axes, Link(told), ends, storey, 0)
