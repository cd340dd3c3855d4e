"""Links as engineers draw them: a spring as a zigzag, a dashpot as a piston in a cup, friction as a block between plates behind
its spring; what is parallel side by side, below the slabs that it joins."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D

from .layout import Link
from .style import BLACK

if TYPE_CHECKING:
    from collections.abc import Iterator

    from matplotlib.axes import Axes
    from numpy.typing import NDArray

TEETH = 4
# Shares of a storey: half the height of a part, from one to the next, and from the level of a slab to the first.
HALF, APART, BELOW = 0.07, 0.22, 0.2
# Shares of the length at rest: leads of a spring, cup and block, and from the right end to what they are held by.
LEAD, CUP, BLOCK, HELD = 0.1, 0.26, 0.14, 0.2
SHORTEST = 0.6  # of all of them together, and a spring that is quite compressed
Strokes = list[list[tuple[float, float]]]  # along and across
STRAIGHT: Strokes = [[(0.0, 0.0), (1.0, 0.0)]]  # of ends that have passed each other


class Line(Line2D):
    """What is drawn of lines whose shape depends on the limits and the size of the axes."""

    def __init__(self, axes: Axes, storey: float) -> None:
        super().__init__([], [], color=BLACK, linewidth=1.2, zorder=4, solid_joinstyle="miter")
        self.storey = storey
        axes.add_line(self)

    def draw(self, renderer: Any) -> None:
        """Once the axes have both: what is across depends on them."""
        self.shape()
        super().draw(renderer)

    def shape(self) -> None:
        raise NotImplementedError

    def across(self, along: NDArray[Any]) -> NDArray[Any]:
        """Half the height of a part, in mm and levels: in the picture at a right angle to a line."""
        assert self.axes is not None
        # Pixels of a mm and of a level.
        scale = np.diag(self.axes.transData.transform([[1.0, 0.0], [0.0, 1.0]]) - self.axes.transData.transform((0.0, 0.0)))
        x, y = along * scale
        half: NDArray[Any] = self.storey * HALF * scale[1] * np.array([-y, x]) / np.hypot(x, y) / scale
        return half


class Device(Line):
    """A link in a drawing: `ends` in mm and levels, at rest; `hung` says how many parts hang there already."""

    def __init__(self, axes: Axes, link: Link, ends: list[NDArray[Any]], storey: float, hung: int) -> None:
        super().__init__(axes, storey)
        self.link, self.ends, self.hung = link, ends, hung
        self.rest = float(ends[1][0] - ends[0][0])
        self.place((0.0, 0.0))

    def place(self, moved: tuple[float, float]) -> None:
        """Moves its ends across, mm."""
        self.moved = moved
        self.shape()

    def shape(self) -> None:
        left, right = (end + [shift, 0.0] for end, shift in zip(self.ends, self.moved))
        pieces = [np.array([end, end - [0.0, self.depth(len(self.link.parts) - 1)]]) for end in (left, right)]
        length, across = float(right[0] - left[0]), self.across(right - left)
        for row, part in enumerate(self.link.parts):
            below = [0.0, self.depth(row)]
            pieces += drawn(part, (left - below, right - below), across, length, self.rest)
        self.set_data(*np.concatenate(list(broken(pieces))).T)

    def depth(self, row: int) -> float:
        """Of a part below the level of its slab."""
        return self.storey * (BELOW + APART * (self.hung + row))


def drawn(
    part: str, ends: tuple[NDArray[Any], NDArray[Any]], across: NDArray[Any], length: float, rest: float
) -> list[NDArray[Any]]:
    """A part between two points that are `length` apart, `rest` when nothing has moved."""
    # What keeps its length, cups and blocks, becomes shorter only where there is no room for it.
    fixed = min(rest, length / SHORTEST)
    pieces = []
    for stroke in DRAWN[part](length, fixed) if length > 0.0 else STRAIGHT:
        along, aside = np.array(stroke).T[:, :, None]
        share = along / (length if length > 0.0 else 1.0)
        pieces.append(ends[0] + share * (ends[1] - ends[0]) + aside * across)
    return pieces


def broken(pieces: list[NDArray[Any]]) -> Iterator[NDArray[Any]]:
    """Lines, and between them points that are none."""
    for piece in pieces:
        yield piece
        yield np.full((1, 2), np.nan)


def spring(length: float, rest: float) -> Strokes:
    first, last = LEAD * rest, length - LEAD * rest
    bends = np.linspace(first, last, 4 * TEETH + 1)[1::2]
    zigzag = [(x, (-1.0) ** at) for at, x in enumerate(bends)]
    return [[(0.0, 0.0), (first, 0.0), *zigzag, (last, 0.0), (length, 0.0)]]


def dashpot(length: float, rest: float) -> Strokes:
    """Its rod is as long as at rest: the piston moves in the cup, at most from end to end."""
    bottom = length - HELD * rest
    opening, thin = bottom - CUP * rest, 0.02 * rest
    piston = min(max(rest * (1.0 - HELD - CUP / 2), opening + thin), bottom - thin)
    cup = [(opening, 1.0), (bottom, 1.0), (bottom, -1.0), (opening, -1.0)]
    return [[(0.0, 0.0), (piston, 0.0)], [(piston, 0.8), (piston, -0.8)], cup, [(bottom, 0.0), (length, 0.0)]]


def friction(length: float, rest: float) -> Strokes:
    end = length - HELD * rest
    start, more = end - BLOCK * rest, 0.04 * rest
    block = [(start, 0.6), (end, 0.6), (end, -0.6), (start, -0.6), (start, 0.6)]
    plates: Strokes = [[(start - more, side), (end + more, side)] for side in (-1.0, 1.0)]
    return [*spring(start, rest), block, *plates, [(end, 0.0), (length, 0.0)]]


DRAWN = {"spring": spring, "friction": friction, "dashpot": dashpot}


def stacked(links: list[Link]) -> Iterator[int]:
    """For each link how many parts hang at its slabs already."""
    hung: dict[tuple[str, int], int] = {}
    for link in links:
        slabs = link.slabs.values()
        first = max(hung.get(slab, 0) for slab in slabs)
        yield first
        for slab in slabs:
            hung[slab] = first + len(link.parts)
