"""Pictures of the runs at the extremes."""

import io

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from PIL import Image  # noqa: E402

plt.rcParams.update({"font.size": 9, "axes.titlesize": 10, "axes.titlelocation": "left"})

# What each plane has on its horizontal axis.
PLANES = {
    "restitution": "restitution e",
    "damping": "damping ratio of the buildings",
    "spacing": "spacing of the record [s]",
    "mass_ratio": "mass, right / left",
    "speed": "speed at the start [m/s]",
    "gap": "gap [m]",
    "exponent": "exponent n",
}
# Okabe and Ito's colours with dashes and markers: laws are told apart without colour, too.
LINES = [
    ("#000000", "-", "o"), ("#D55E00", "-", "s"), ("#0072B2", "-", "^"), ("#009E73", "-", "D"),
    ("#CC79A7", "--", "v"), ("#E69F00", "--", "P"), ("#56B4E9", "--", "X"), ("#7F7F7F", ":", "*"),
]  # fmt: skip
GIVEN_UP = {"linestyle": "", "marker": "x", "color": "black", "markersize": 11, "markeredgewidth": 2}
REFUSED = {"linestyle": "", "marker": "s", "color": "black", "markerfacecolor": "none", "markersize": 9}
UNBALANCED = {"linestyle": "", "marker": "$!$", "color": "black", "markersize": 13}
BALANCED = 1e-11  # residual of the energy account


def draw(rows, file):
    """A panel for each parameter: the longest run of all stiffnesses at each value of it, a line for each law."""
    laws = dict(zip(dict.fromkeys(row["law"] for row in rows), LINES))
    figure, panels = plt.subplots(2, 4, figsize=(13, 6.4), sharey=True, layout="constrained")
    for panel, plane in zip(panels.flat, PLANES):
        of_plane = [row for row in rows if row["plane"] == plane]
        values = sorted({float(row["value"]) for row in of_plane})
        for law, line in laws.items():
            draw_line(panel, [row for row in of_plane if row["law"] == law], values, line)
        panel.set_title(PLANES[plane])
        panel.set(yscale="log", ylim=(5e-5, 20))
        panel.set_xticks(range(len(values)), [f"{value:g}" for value in values], rotation=45, ha="right")
        panel.grid(alpha=0.25)
        panel.spines[["top", "right"]].set_visible(False)
    for panel in panels[:, 0]:
        panel.set_ylabel("longest run of 2 s, of all stiffnesses [s]")
    ended = [abs(float(row["residual"])) for row in rows if row["outcome"] == "ended"]
    name_marks(panels.flat[-1], laws, any(not residual < BALANCED for residual in ended))
    figure.suptitle(
        f"{len(rows)} runs, stiffnesses 1e4 to 1e14: {len(ended)} to the end, energy balanced to {max(ended):.0e}",
        x=0.005, ha="left",
    )  # fmt: skip
    save(figure, file)


def draw_line(panel, rows, values, line):
    color, dashes, marker = line
    run = [row for row in rows if row["outcome"] != "refused"]
    places = sorted({values.index(float(row["value"])) for row in run})
    at = {place: [row for row in run if values.index(float(row["value"])) == place] for place in places}
    longest = [max(float(row["seconds"]) for row in at[place]) for place in places]
    panel.plot(places, longest, dashes, color=color, marker=marker, markersize=4, linewidth=1.3)
    for place, seconds in zip(places, longest):
        if any(row["outcome"] == "stopped" for row in at[place]):
            panel.plot(place, seconds, **GIVEN_UP)
        if any(row["outcome"] == "ended" and not abs(float(row["residual"])) < BALANCED for row in at[place]):
            panel.plot(place, seconds, **UNBALANCED)
    for row in rows:
        if row["outcome"] == "refused":
            panel.plot(values.index(float(row["value"])), 1e-4, **REFUSED)


def name_marks(panel, laws, unbalanced):
    """In the place of a panel: which line is which law, and what marks mean."""
    panel.axis("off")
    lines = [
        plt.Line2D([], [], color=color, linestyle=dashes, marker=marker, markersize=5, label=law)
        for law, (color, dashes, marker) in laws.items()
    ]
    lines += [
        plt.Line2D([], [], **GIVEN_UP, label="some given up, with a message"),
        plt.Line2D([], [], **REFUSED, label="scenes refused, with a message"),
    ]
    if unbalanced:
        lines.append(plt.Line2D([], [], **UNBALANCED, label=f"account off by more than {BALANCED:g}"))
    panel.legend(handles=lines, loc="center left", frameon=False, fontsize=10)


def save(figure, file):
    """Of 256 colours: a third of the size that all take."""
    drawn = io.BytesIO()
    figure.savefig(drawn, dpi=110)
    plt.close(figure)
    Image.open(drawn).convert("RGB").quantize(256).save(file, optimize=True)


def draw_drift(rows, file):
    """Error of the energy against the number of impacts, for laws that lose none."""
    figure, axes = plt.subplots(figsize=(8.0, 4.6), layout="constrained")
    names = {}
    for law in dict.fromkeys(row["law"] for row in rows):
        points = [(float(row["impacts"]), max(float(row["drift"]), 1e-16)) for row in rows if row["law"] == law]
        name = law.removeprefix("law = ")
        for word in ("stiffness = 1.0e6", "stiffness = 1.0e7", "restitution = 1.0", "damping_formula = exact"):
            name = name.replace(word, "")
        # With e = 1 several laws are one and the same, to the bit.
        names.setdefault(tuple(points), []).append(" ".join(name.split()))
    for (color, dashes, marker), (points, laws) in zip(LINES, names.items()):
        style = {"color": color, "marker": marker, "markersize": 4, "markevery": 4}
        axes.plot(*zip(*points), dashes, label=", ".join(laws), **style)
    axes.set(xscale="log", yscale="log", xlabel="impacts with e = 1", ylabel="largest relative error of the energy so far")
    impacts = np.array([10.0, max(float(row["impacts"]) for row in rows)])
    axes.plot(impacts, 1e-12 * impacts, color="0.6", linewidth=1)
    axes.annotate("1e-12, the tolerance, for each impact", (1.2e3, 4e-10), color="0.4")
    axes.grid(alpha=0.25)
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(frameon=False, fontsize=8, loc="upper left")
    save(figure, file)
