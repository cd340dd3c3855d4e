"""How the pictures look: one colour and dash for each building, in every picture.

The colours are Okabe and Ito's: colour-blind eyes tell them apart; in black and white the dashes do.
"""

from __future__ import annotations

import io
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Look = dict[str, Any]

BLUE, SKY, GREEN, ORANGE, VERMILION, PURPLE = "#0072B2", "#56B4E9", "#009E73", "#E69F00", "#D55E00", "#CC79A7"
YELLOW, BLACK, GREY = "#F0E442", "#000000", "#888888"

# The two buildings, a wall beside them, and a building that stands free.
LEFT: Look = {"color": BLUE, "linestyle": "-", "linewidth": 1.4}
RIGHT: Look = {"color": VERMILION, "linestyle": "--", "linewidth": 1.4}
BUILDINGS = {"left": LEFT, "right": RIGHT}
WALL: Look = {"color": BLACK, "linestyle": "-", "linewidth": 2.2}
ALONE: Look = {"color": GREEN, "linestyle": (0, (3, 1)), "linewidth": 2.0}
# The force of a contact, the gap between two edges, a wall that is cut, and where edges press.
FORCE: Look = {"color": BLACK, "linestyle": "-", "linewidth": 1.1}
OPEN: Look = {"color": "#999999", "alpha": 0.3, "linewidth": 0}
SOLID: Look = {"facecolor": "white", "edgecolor": BLACK, "hatch": "////", "linewidth": 1.0}
OVERLAP: Look = {"facecolor": YELLOW, "edgecolor": BLACK, "hatch": "////", "linewidth": 0}

# Contacts beside each other: no colour of a building.
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


def picture_file(path: Path) -> Path:
    """The path, where a picture can be written to."""
    if path.suffix.lower() not in FORMATS:
        raise ValueError(f"{path}: expected a name that ends in {', '.join(FORMATS)}")
    if not path.parent.is_dir():
        raise ValueError(f"{path}: expected a folder that is there; {path.parent} is none")
    return path


def save(figure: Figure, path: Path) -> None:
    """Writes a PNG of 256 colours, a third of the size that all take, an SVG or a PDF.

    The same numbers give the same file.
    """
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
