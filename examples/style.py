"""How all pictures of the examples look: colours by building and by law, font sizes, files the same each time."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from runs import ROOT, STANDARD_GRAVITY  # noqa: F401

# Okabe and Ito's colours, which colour-blind eyes tell apart; in black and white the line styles do.
BLUE, ORANGE, GREEN, PURPLE = "#0072B2", "#D55E00", "#009E73", "#CC79A7"
SKY, AMBER, YELLOW, BLACK, GREY = "#56B4E9", "#E69F00", "#F0E442", "#000000", "#888888"

# By building.
LEFT = {"color": BLUE, "linestyle": "-", "linewidth": 1.4}
RIGHT = {"color": ORANGE, "linestyle": "--", "linewidth": 1.4}
BUILDINGS = {"left": LEFT, "right": RIGHT}
# The same building without contact, the force of a contact, the gap between two edges, and where they press.
ALONE = {"color": GREEN, "linestyle": (0, (3, 1)), "linewidth": 2.0}
FORCE = {"color": BLACK, "linestyle": "-", "linewidth": 1.1}
OPEN = {"color": "#999999", "alpha": 0.3, "linewidth": 0}
OVERLAP = {"facecolor": YELLOW, "edgecolor": BLACK, "hatch": "////", "linewidth": 0}

# By law of contact, under its name in a scene.
LAWS = {
    "stereomechanical": {"color": BLACK, "linestyle": (0, (1, 1)), "linewidth": 1.8},
    "linear": {"color": GREY, "linestyle": "-", "linewidth": 1.6},
    "kelvin_voigt": {"color": BLUE, "linestyle": "-", "linewidth": 1.8},
    "kelvin_voigt_no_tension": {"color": ORANGE, "linestyle": "--", "linewidth": 1.8},
    "hertz": {"color": SKY, "linestyle": (0, (6, 1)), "linewidth": 1.8},
    "jankowski": {"color": PURPLE, "linestyle": "-.", "linewidth": 1.8},
    "hertz_damped": {"color": GREEN, "linestyle": (0, (5, 1, 1, 1, 1, 1)), "linewidth": 1.8},
}
# For what has no colour of its own: lines in this order.
CYCLE = [
    {"color": color, "linestyle": line, "marker": marker}
    for color, line, marker in zip(
        [BLUE, ORANGE, GREEN, PURPLE, SKY, AMBER, BLACK],
        ["-", "--", "-.", ":", (0, (6, 1)), (0, (5, 1, 1, 1, 1, 1)), "-"],
        ["o", "s", "^", "D", "v", "P", "X"],
    )
]

plt.rcParams.update({
    "font.size": 10.5, "axes.titlesize": 10.5, "axes.titlelocation": "left", "legend.frameon": False,
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.alpha": 0.3, "axes.axisbelow": True,
    "hatch.linewidth": 0.6, "svg.hashsalt": "pounding", "svg.fonttype": "none", "figure.constrained_layout.use": True,
})  # fmt: skip


def save(figure, path, dpi=150):
    """Writes a picture, PNG or SVG by its name, without a date or a version: the same numbers give the same file."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    if path.suffix == ".svg":
        figure.savefig(path, metadata={"Date": None, "Creator": None})
    else:
        figure.savefig(path, dpi=dpi, metadata={"Software": None}, pil_kwargs={"optimize": True})
    plt.close(figure)
    print(path.relative_to(ROOT) if path.is_relative_to(ROOT) else path)
