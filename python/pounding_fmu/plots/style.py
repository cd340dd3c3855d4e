"""How the pictures look: one colour and dash for each building and each law of contact, in every picture.

The colours are Okabe and Ito's and some of Tol's: colour-blind eyes tell them apart; in black and white the dashes do.
"""

from __future__ import annotations

import io
import itertools
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable

    from matplotlib.figure import Figure

Look = dict[str, Any]

BLUE, SKY, GREEN, ORANGE, VERMILION, PURPLE = "#0072B2", "#56B4E9", "#009E73", "#E69F00", "#D55E00", "#CC79A7"
WINE, OLIVE, YELLOW, BLACK, GREY = "#882255", "#8A8A1F", "#F0E442", "#000000", "#888888"
INDIGO, KHAKI, BROWN = "#332288", "#999933", "#661100"

# Buildings, a wall beside them, and a building that stands free.
LEFT: Look = {"color": BLUE, "linestyle": "-", "linewidth": 1.4}
RIGHT: Look = {"color": VERMILION, "linestyle": "--", "linewidth": 1.4}
# Of a row from left to right; after eight it begins anew. Neighbours differ in how light they are, too.
BUILDINGS: list[Look] = [
    LEFT,
    RIGHT,
    {"color": INDIGO, "linestyle": "-.", "linewidth": 1.4},
    {"color": ORANGE, "linestyle": (0, (6, 1)), "linewidth": 1.6},
    {"color": WINE, "linestyle": ":", "linewidth": 1.8},
    {"color": KHAKI, "linestyle": (0, (5, 1, 1, 1, 1, 1)), "linewidth": 1.6},
    {"color": BROWN, "linestyle": (0, (2, 1)), "linewidth": 1.4},
    {"color": PURPLE, "linestyle": (0, (9, 2, 2, 2)), "linewidth": 1.6},
]
WALL: Look = {"color": BLACK, "linestyle": "-", "linewidth": 2.2}
ALONE: Look = {"color": GREEN, "linestyle": (0, (3, 1)), "linewidth": 2.0}
# The force of a contact, the gap between two edges, a wall that is cut, and where edges press.
FORCE: Look = {"color": BLACK, "linestyle": "-", "linewidth": 1.1}
OPEN: Look = {"color": "#999999", "alpha": 0.3, "linewidth": 0}
SOLID: Look = {"facecolor": "white", "edgecolor": BLACK, "hatch": "////", "linewidth": 1.0}
OVERLAP: Look = {"facecolor": YELLOW, "edgecolor": BLACK, "hatch": "////", "linewidth": 0}

# Laws, and formulas of hertz_damped.
LAWS: dict[str, Look] = {
    "linear": {"color": GREY, "linestyle": "-", "linewidth": 1.3},
    "hertz": {"color": BLACK, "linestyle": "-", "linewidth": 1.0},
    "kelvin_voigt": {"color": BLUE, "linestyle": "-", "linewidth": 1.8},
    "kelvin_voigt_no_tension": {"color": ORANGE, "linestyle": "--", "linewidth": 1.8},
    "jankowski": {"color": SKY, "linestyle": (0, (6, 1)), "linewidth": 2.0},
    "exact": {"color": GREEN, "linestyle": "-", "linewidth": 1.8},
    "lankarani_nikravesh": {"color": VERMILION, "linestyle": "--", "linewidth": 1.8},
    "ye": {"color": OLIVE, "linestyle": "-.", "linewidth": 1.8},
    "barros_khatami": {"color": PURPLE, "linestyle": (0, (1, 1)), "linewidth": 2.2},
    "barros_khatami_damper": {"color": WINE, "linestyle": (0, (4, 1, 1, 1)), "linewidth": 1.8},
}

# Contacts beside each other: no colour of the first three buildings.
CONTACTS = [BLACK, PURPLE, SKY, ORANGE]

# For what has no colour of its own: lines in this order.
CYCLE: list[Look] = [
    {"color": color, "linestyle": line, "marker": marker}
    for color, line, marker in zip(
        [BLUE, VERMILION, GREEN, PURPLE, SKY, ORANGE, BLACK],
        ["-", "--", "-.", ":", (0, (6, 1)), (0, (5, 1, 1, 1, 1, 1)), "-"],
        ["o", "s", "^", "D", "v", "P", "X"],
    )
]

# Settings of matplotlib while a picture is drawn or written: `with matplotlib.rc_context(LOOK)`.
LOOK: Any = {
    "font.size": 10.5, "axes.titlesize": 10.5, "axes.titlelocation": "left", "axes.spines.top": False,
    "axes.spines.right": False, "legend.frameon": False, "axes.grid": True, "grid.alpha": 0.3, "axes.axisbelow": True,
    "hatch.linewidth": 0.6, "svg.hashsalt": "pounding", "svg.fonttype": "none", "figure.constrained_layout.use": True,
}  # fmt: skip

FORMATS = (".png", ".svg", ".pdf")


def looks(names: Iterable[str]) -> dict[str, Look]:
    """How each building of a row looks, by its name."""
    return dict(zip(names, itertools.cycle(BUILDINGS)))


def pyplot() -> Any:
    """matplotlib.pyplot with these settings for good: for programs that draw files of their own."""
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams.update(LOOK)
    import matplotlib.pyplot as plt

    return plt



def picture_file(path: Path) -> Path:
    """The path, where a picture can be written to."""
    if path.suffix.lower() not in FORMATS:
        raise ValueError(f"{path}: expected a name that ends in {', '.join(FORMATS)}")
    if not path.parent.is_dir():
        raise ValueError(f"{path}: expected a folder that is there; {path.parent} is none")
    return path


def save(figure: Figure, path: Path) -> None:
    """Writes a PNG of 256 colours, a third of the size that all take, an SVG or a PDF, without the date."""
    import matplotlib
    from PIL import Image

    suffix = picture_file(path).suffix.lower()
    with matplotlib.rc_context(LOOK):
        if suffix == ".png":
            drawn = io.BytesIO()
            figure.savefig(drawn, dpi=150)
            Image.open(drawn).convert("RGB").quantize(256).save(path, optimize=True)
        else:
            dates = {"Date": None} if suffix == ".svg" else {"CreationDate": None}
            figure.savefig(path, format=suffix[1:], metadata={**dates, "Creator": None})


def name_curve(axes: Any, numbers: Any, label: str, style: Look, at: float, text: tuple[float, float]) -> None:
    """Writes a curve's name beside it; `at` is the point of the curve that is named, as a share of its points."""
    x, y = numbers
    place = round(at * (len(x) - 1))
    line = {"arrowstyle": "-", "color": style["color"], "linewidth": 1, "shrinkB": 1}
    axes.annotate(label, (x[place], y[place]), text, arrowprops=line, va="center")
