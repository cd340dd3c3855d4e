"""Pictures of the results."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.ticker import FuncFormatter, LogLocator  # noqa: E402

from scenes import LAWS, TEMPLATES  # noqa: E402
from solvers import OURS, WITHOUT_PEAKS  # noqa: E402

# Okabe and Ito's colours, which colour-blind eyes tell apart; markers and dashes do in black and white.
STYLES = {
    OURS: ("#000000", "-", "o"),
    WITHOUT_PEAKS: ("#000000", ":", "o"),
    "heyoka": ("#D55E00", "-", "s"),
    "CVODE Adams, events": ("#0072B2", "-", "^"),
    "CVODE Adams, plain": ("#0072B2", ":", "^"),
    "Newmark": ("#E69F00", "-", "D"),
    "RK4": ("#009E73", "-", "v"),
    "SciPy DOP853, events": ("#CC79A7", "-", "P"),
    "SciPy DOP853, plain": ("#CC79A7", ":", "P"),
    "SciPy LSODA, events": ("#56B4E9", "-", "X"),
    "SciPy LSODA, plain": ("#56B4E9", ":", "X"),
    "OpenSeesPy": ("#7F7F7F", "-", "*"),
}
plt.rcParams.update({
    "font.size": 9, "axes.titlesize": 10, "axes.titlelocation": "left", "axes.spines.top": False,
    "axes.spines.right": False, "axes.grid": True, "grid.alpha": 0.25, "axes.axisbelow": True,
    "svg.hashsalt": "pounding", "svg.fonttype": "none",
})  # fmt: skip
PREVIEWS = Path(__file__).resolve().parents[1] / "target/benchmarks/pictures"


def work_precision(rows, folder):
    for scene in dict.fromkeys(row["scene"] for row in rows):
        draw_scene(scene, [row for row in rows if row["scene"] == scene and row["best_s"]], folder)


def draw_scene(scene, rows, folder):
    # A law that only we have is in the tables; there is nothing to compare in a picture.
    laws = [law for law in LAWS if {row["solver"] for row in rows if row["law"] == law} - {OURS, WITHOUT_PEAKS}]
    columns = min(3, len(laws))
    shape = (-(-len(laws) // columns), columns)
    figure, panels = plt.subplots(
        *shape, figsize=(4.4 * columns, 3.9 * shape[0]), sharex=True, sharey=True, squeeze=False, layout="constrained"
    )
    for law, axes in zip(laws, panels.flat):
        of_law = [row for row in rows if row["law"] == law]
        draw_law(axes, of_law)
        axes.set_title(f"{law} ({of_law[0]['true_impacts']} impacts)")
    for axes in panels[:, 0]:
        axes.set_ylabel("run time [ms]")
    for index in range(len(laws)):
        if index + columns >= len(laws):
            panels.flat[index].set_xlabel("error of displacements, relative to the largest (smaller to the right)")
            panels.flat[index].xaxis.set_tick_params(labelbottom=True)
            panels.flat[index].xaxis.label.set_size(8)
    wrap = ". " if columns > 1 else "\n"
    title = f"{scene}: {TEMPLATES[scene].title}{wrap}Run time against error, whole record"
    figure.suptitle(title, x=0.01, ha="left", weight="bold")
    name_lines(figure, panels.flat[len(laws) :], {row["solver"] for row in rows})
    save(figure, folder, scene)


def save(figure, folder, name):
    """SVG for the document, without the date; PNG below target/ for a look."""
    PREVIEWS.mkdir(parents=True, exist_ok=True)
    figure.savefig(folder / f"{name}.svg", metadata={"Date": None})
    figure.savefig(PREVIEWS / f"{name}.png", dpi=110)
    plt.close(figure)


def draw_law(axes, rows):
    axes.set(xscale="log", yscale="log")
    for solver in STYLES:
        points = [(float(row["error"]), 1e3 * float(row["best_s"])) for row in rows if row["solver"] == solver]
        points = [(max(error, 1e-15), time) for error, time in points if np.isfinite(error) and error < 0.5]
        if points:
            axes.plot(*zip(*points), **look(solver))
    axes.set_xticks([10.0**-exponent for exponent in range(0, 16, 3)])
    # Accurate to the right.
    axes.set_xlim(0.7, 3e-16)
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))


def look(solver):
    color, dashes, marker = STYLES[solver]
    wide = 2.4 if solver == OURS else 1.3
    return {"color": color, "linestyle": dashes, "marker": marker, "markersize": 4.5, "linewidth": wide}


def name_lines(figure, free, solvers):
    """One legend for all panels: in the place of one that is free, or below them."""
    lines = [plt.Line2D([], [], label=solver, **look(solver)) for solver in STYLES if solver in solvers]
    for axes in free:
        axes.axis("off")
    if len(free):
        free[0].legend(handles=lines, loc="center left", frameon=False, fontsize=10)
    else:
        figure.legend(handles=lines, loc="outside lower center", ncols=4, frameon=False)


# Series of scaling.py: its column on the x axis, what that is, and how its line is drawn.
SCALING = [
    (
        "storeys",
        "storeys of both buildings",
        {"storeys, 0 contacts": "no contact", "storeys, 1 contacts": "1 contact, {} to {} impacts"},
    ),
    ("contacts", "contacts (20 and 30 storeys)", {"contacts": "{} to {} impacts"}),
    ("impacts", "impacts (two masses, the gap varied)", {"impacts": "1 contact"}),
    (
        "samples",
        "samples of the record (two masses)",
        {"samples": "no contact", "samples, 1 contact": "1 contact, {} impacts"},
    ),
]


def scaling(rows, machine, folder):
    figure, panels = plt.subplots(2, 3, figsize=(12.5, 7.4))
    for axes, (column, label, lines) in zip(panels.flat, SCALING):
        for position, ((series, text), color) in enumerate(zip(lines.items(), ["#0072B2", "#D55E00"])):
            of_series = sorted((row for row in rows if row["series"] == series), key=lambda row: row[column])
            impacts = sorted(row["impacts"] for row in of_series)
            points = [(row[column], 1e3 * float(row["best_s"])) for row in of_series]
            draw_growth(axes, points, text.format(impacts[0], impacts[-1]), color, position)
        axes.set(xlabel=label, ylabel="run time [ms]")
    tall = [row for row in rows if row["series"] == "storeys, 1 contacts"]
    memory, rate = panels[1, 1], panels[1, 2]
    draw_growth(memory, [(row["storeys"], row["memory_bytes"] / 1e6) for row in tall], "", "#009E73", 0)
    memory.set(
        xlabel="storeys of both buildings (record of 2001 samples)",
        ylabel="memory of an instance [MB]",
        yscale="linear",
        ylim=(0, None),
    )
    alone = {row["storeys"]: float(row["best_s"]) for row in rows if row["series"] == "storeys, 0 contacts"}
    above = [(row, float(row["best_s"]) - alone[row["storeys"]]) for row in tall]
    per_impact = [(row["storeys"], 1e6 * time / row["impacts"]) for row, time in above if time > 0.0 and row["impacts"]]
    draw_growth(rate, per_impact, "run with 1 contact less run without, per impact", "#009E73", 0)
    rate.set(xlabel="storeys of both buildings", ylabel="time of an impact [µs]")
    impacts = panels[0, 2]
    impacts.set(xscale="linear", yscale="linear", xlim=(0, None), ylim=(0, None))
    title = f"Cost of 20 s of ground motion: law hertz, tolerance 1e-10, {machine}"
    figure.suptitle(title, x=0.01, ha="left", weight="bold")
    figure.tight_layout()
    save(figure, folder, "scaling")


def draw_growth(axes, points, label, color, position):
    """A line with its name, the first in the upper left corner and the next one below."""
    axes.set(xscale="log", yscale="log")
    axes.margins(y=0.12)
    axes.plot(*zip(*points), "-s" if position else "-o", color=color, markersize=4.5, linewidth=1.6)
    axes.text(0.03, 0.96 - 0.07 * position, label, transform=axes.transAxes, color=color, va="top", fontsize=9)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_formatter(FuncFormatter(lambda value, _: ""))
