"""How the pictures of this project look: one colour and dash for each building and each law of contact, in every picture.

The colours are Okabe and Ito's and a few of Tol's: colour-blind eyes tell them apart; in black and white the dashes do.
"""

import io
from pathlib import Path

from engine import ROOT

BLUE, SKY, GREEN, ORANGE, VERMILION, PURPLE = "#0072B2", "#56B4E9", "#009E73", "#E69F00", "#D55E00", "#CC79A7"
WINE, OLIVE, YELLOW, BLACK, GREY = "#882255", "#8A8A1F", "#F0E442", "#000000", "#888888"

# The two buildings, a wall beside them, and a building that stands free.
LEFT = {"color": BLUE, "linestyle": "-", "linewidth": 1.4}
RIGHT = {"color": VERMILION, "linestyle": "--", "linewidth": 1.4}
BUILDINGS = {"left": LEFT, "right": RIGHT}
WALL = {"color": BLACK, "linestyle": "-", "linewidth": 2.2}
ALONE = {"color": GREEN, "linestyle": (0, (3, 1)), "linewidth": 2.0}
# The force of a contact, the gap between two edges, a wall that is cut, and where edges press.
FORCE = {"color": BLACK, "linestyle": "-", "linewidth": 1.1}
OPEN = {"color": "#999999", "alpha": 0.3, "linewidth": 0}
SOLID = {"facecolor": "white", "edgecolor": BLACK, "hatch": "////", "linewidth": 1.0}
OVERLAP = {"facecolor": YELLOW, "edgecolor": BLACK, "hatch": "////", "linewidth": 0}

# Laws, and formulas of hertz_damped.
LAWS = {
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
# For what has no colour of its own: lines in this order.
CYCLE = [
    {"color": color, "linestyle": line, "marker": marker}
    for color, line, marker in zip(
        [BLUE, VERMILION, GREEN, PURPLE, SKY, ORANGE, BLACK],
        ["-", "--", "-.", ":", (0, (6, 1)), (0, (5, 1, 1, 1, 1, 1)), "-"],
        ["o", "s", "^", "D", "v", "P", "X"],
    )
]

LOOK = {
    "font.size": 10.5, "axes.titlesize": 10.5, "axes.titlelocation": "left", "axes.spines.top": False,
    "axes.spines.right": False, "legend.frameon": False, "axes.grid": True, "grid.alpha": 0.3, "axes.axisbelow": True,
    "hatch.linewidth": 0.6, "svg.hashsalt": "pounding", "svg.fonttype": "none", "figure.constrained_layout.use": True,
}  # fmt: skip


def pyplot():
    """The plotting library in this project's look, drawing to files."""
    # Not at the top: who wants numbers alone needs no plotting library.
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    plt.rcParams.update(LOOK)
    return plt


def save(figure, picture):
    """Writes an SVG, or a PNG of 256 colours, a third of the size that all take. The same numbers give the same file."""
    picture = Path(picture)
    picture.parent.mkdir(parents=True, exist_ok=True)
    if picture.suffix == ".svg":
        figure.savefig(picture, metadata={"Date": None, "Creator": None})
    else:
        from PIL import Image

        drawn = io.BytesIO()
        figure.savefig(drawn, dpi=150)
        Image.open(drawn).convert("RGB").quantize(256).save(picture, optimize=True)
    pyplot().close(figure)
    print(picture.relative_to(ROOT) if picture.is_relative_to(ROOT) else picture)


def name_curve(axes, numbers, label, style, at, text):
    """Writes a curve's name beside it; `at` is the point of the curve that is named, as a share of its points."""
    x, y = numbers
    place = round(at * (len(x) - 1))
    line = {"arrowstyle": "-", "color": style["color"], "linewidth": 1, "shrinkB": 1}
    axes.annotate(label, (x[place], y[place]), text, arrowprops=line, va="center")
