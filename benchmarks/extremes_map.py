"""Pictures of the runs at the extremes."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.colors import LogNorm  # noqa: E402

plt.rcParams.update({"font.size": 9, "axes.titlesize": 9})

# What each plane has on its vertical axis.
PLANES = {
    "mass_ratio": "mass,\nright / left",
    "restitution": "restitution e",
    "speed": "speed at the\nstart [m/s]",
    "gap": "gap [m]",
    "damping": "damping\nratio",
    "spacing": "record\nspacing [s]",
    "exponent": "exponent n",
}
# Okabe and Ito's colours with dashes and markers: laws are told apart without colour, too.
LINES = [
    ("#000000", "-", "o"), ("#D55E00", "-", "s"), ("#0072B2", "-", "^"), ("#009E73", "-", "D"),
    ("#CC79A7", "--", "v"), ("#E69F00", "--", "P"), ("#56B4E9", "--", "X"), ("#7F7F7F", ":", "*"),
]  # fmt: skip


def draw(rows, file):
    """One panel for each law and plane: the colour is the time of a run, a mark what else came of it."""
    laws, planes = list(dict.fromkeys(row["law"] for row in rows)), list(PLANES)
    heights = [len({row["value"] for row in rows if row["plane"] == plane}) or 1 for plane in planes]
    figure, panels = plt.subplots(
        len(planes), len(laws), figsize=(1.5 + 1.6 * len(laws), 1.2 + 0.27 * sum(heights)), squeeze=False,
        gridspec_kw={"height_ratios": heights}, layout="constrained",
    )  # fmt: skip
    norm = LogNorm(1e-4, 10.0)
    for line, plane in zip(panels, planes):
        values = sorted({float(row["value"]) for row in rows if row["plane"] == plane})
        for axes, law in zip(line, laws):
            draw_panel(axes, [row for row in rows if (row["plane"], row["law"]) == (plane, law)], values, norm)
            if axes.axison and not any(other.axison for other in line[: list(line).index(axes)]):
                axes.set_yticks(range(len(values)), [f"{value:g}" for value in values])
                axes.set_ylabel(PLANES[plane])
    for axes, law in zip(panels[0], laws):
        axes.set_title(law.replace("_no_tension", "\nno_tension").replace(" ", "\n"))
    for axes in panels[-1]:
        if axes.axison:
            label_stiffness(axes, rows)
    for index, law in enumerate(laws):
        if not law.startswith("hertz"):
            label_stiffness(panels[-2][index], rows)
    bar = figure.colorbar(plt.cm.ScalarMappable(norm, "cividis"), ax=panels, location="bottom", fraction=0.02, aspect=60)
    bar.set_label("time of a run of 2 s [s];  no mark: to the end, energy account balanced;  \N{MULTIPLICATION SIGN}: given up "
                  "with a message;  \N{WHITE SQUARE}: scene refused with a message")  # fmt: skip
    figure.savefig(file, dpi=110)
    plt.close(figure)


def label_stiffness(axes, rows):
    stiffness = sorted({float(row["stiffness"]) for row in rows})
    ticks = range(0, len(stiffness), 2)
    axes.set_xticks(ticks, [f"$10^{{{round(np.log10(stiffness[i]))}}}$" for i in ticks])
    axes.set_xlabel("stiffness")


def draw_panel(axes, rows, values, norm):
    if not rows:
        axes.axis("off")
        return
    stiffness = sorted({float(row["stiffness"]) for row in rows})
    cost = np.full((len(values), len(stiffness)), np.nan)
    for row in rows:
        x, y = stiffness.index(float(row["stiffness"])), values.index(float(row["value"]))
        cost[y, x] = float(row["seconds"])
        mark = {"stopped": "x", "refused": "s"}.get(row["outcome"])
        if row["outcome"] == "ended" and not abs(float(row["residual"])) < 1e-11:
            mark = "*"
        if mark:
            face = "none" if mark == "s" else "black"
            axes.scatter(x, y, s=22, marker=mark, facecolors=face, edgecolors="black" if mark == "s" else None,
                         color=None if mark == "s" else "black", linewidths=1.2)  # fmt: skip
        if row["outcome"] == "refused":
            cost[y, x] = np.nan
    axes.imshow(cost, norm=norm, cmap="cividis", aspect="auto", origin="lower")
    axes.set_xticks([])
    axes.set_yticks([])


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
    figure.savefig(file, dpi=110)
    plt.close(figure)
