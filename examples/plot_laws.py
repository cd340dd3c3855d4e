"""Draws docs/images/laws.png: force against penetration for every law, and what an impact returns.

    "$(ci/environment)" examples/plot_laws.py

The numbers are those of free impacts that the engine runs (the example `laws`).
"""

import csv
import subprocess
from collections import defaultdict
from pathlib import Path

import numpy as np

from pounding_fmu.plots import style

ROOT = Path(__file__).resolve().parents[1]
PICTURE = ROOT / "docs/images/laws.png"
WORK = ROOT / "target/laws"

# e and the mark of the impacts that it is asked for in.
ASKED = [(0.1, "o", style.BLUE), (0.5, "s", style.VERMILION), (0.9, "D", style.GREEN)]


def main():
    command = ["cargo", "run", "--release", "--quiet", "--example", "laws", "--", "--csv", WORK]
    subprocess.run(command, cwd=ROOT, check=True)
    curves, outcomes = table("curves.csv"), table("outcomes.csv")
    figure, panels = prepare_figure()
    linear, hertz, formulas, returns = panels
    draw_linear(linear, curves, outcomes)
    draw_hertz(hertz, curves, outcomes)
    draw_formulas(formulas, curves, outcomes)
    draw_returns(returns, outcomes)
    style.save(figure, PICTURE)


def table(name):
    """Two columns of numbers for each law and formula; laws without formulas have an empty one."""
    rows = defaultdict(list)
    with (WORK / name).open() as lines:
        for row in csv.reader(list(lines)[1:]):
            rows[row[0], row[1]].append([float(number) for number in row[2:]])
    return {key: np.array(numbers).T for key, numbers in rows.items()}


def prepare_figure():
    figure = style.pyplot().figure(figsize=(10.4, 9.8), layout="constrained")
    upper, lower = figure.subfigures(2, 1, hspace=0.03)
    panels = [*upper.subplots(1, 2), *lower.subplots(1, 2, width_ratios=[1.45, 1])]
    for axes in panels[:3]:
        axes.set(xlabel="penetration / largest of the undamped spring", ylabel="force / largest of the undamped spring")
        axes.set(xlim=(0, 1.05), ylim=(-0.3, 1.15))
        axes.axhline(0, color=style.BLACK, linewidth=0.8)
    return figure, panels


def draw(axes, numbers, label, look, at, text):
    """A curve with its name beside it."""
    axes.plot(*numbers, **look)
    style.name_curve(axes, numbers, label, look, at, text)


def returned(outcomes, key):
    """What a free impact returns for e = 0.5."""
    return np.interp(0.5, *outcomes[key])


def draw_linear(axes, curves, outcomes):
    axes.set_title("Linear spring, $k\\,d$: free impact, e = 0.5")
    draw(axes, curves["linear", ""], "linear:\nreturns 1", style.LAWS["linear"], 0.33, (0.66, 1.03))
    label = f"kelvin_voigt:\nreturns {returned(outcomes, ('kelvin_voigt', '')):.2f}, pulls"
    draw(axes, curves["kelvin_voigt", ""], label, style.LAWS["kelvin_voigt"], 0.93, (0.27, -0.19))
    label = f"kelvin_voigt_no_tension:\nreturns {returned(outcomes, ('kelvin_voigt_no_tension', '')):.2f}"
    draw(axes, curves["kelvin_voigt_no_tension", ""], label, style.LAWS["kelvin_voigt_no_tension"], 0.72, (0.50, 0.12))


def draw_hertz(axes, curves, outcomes):
    axes.set_title("Hertz spring, $k\\,d^{1.5}$: free impact, e = 0.5")
    draw(axes, curves["hertz", ""], "hertz:\nreturns 1", style.LAWS["hertz"], 0.42, (0.70, 1.03))
    label = f"jankowski:\nreturns {returned(outcomes, ('jankowski', '')):.2f}"
    draw(axes, curves["jankowski", ""], label, style.LAWS["jankowski"], 0.06, (0.02, 0.95))
    label = f"hertz_damped, exact:\nreturns {returned(outcomes, ('hertz_damped', 'exact')):.2f}"
    draw(axes, curves["hertz_damped", "exact"], label, style.LAWS["exact"], 0.75, (0.60, 0.11))


def draw_formulas(axes, curves, outcomes):
    axes.set_title("hertz_damped by the formulas of the paper, e = 0.5")
    axes.set(xlim=(0, 1.8), ylim=(0, 1.2), xticks=np.arange(0, 1.2, 0.2))
    for name, at, height, also in [
        ("barros_khatami", 0.28, 1.12, ""),
        ("barros_khatami_damper", 0.22, 1.00, ""),
        ("ye", 0.30, 0.88, ""),
        ("lankarani_nikravesh", 0.47, 0.72, "\nand ye_printed"),
        ("exact", 0.62, 0.30, ""),
    ]:
        key = ("hertz_damped", name)
        label = f"{name}{also}: {returned(outcomes, key):.2f}"
        draw(axes, curves[key], label, style.LAWS[name], at, (0.95, height))
    axes.text(0.95, 0.20, "(number: what is returned)", va="center")


def draw_returns(axes, outcomes):
    axes.set_title("What a free impact returns\n", linespacing=1.4)
    laws = [(law, outcome) for (law, formula), outcome in outcomes.items() if not formula]
    formulas = [(formula, outcome) for (_, formula), outcome in outcomes.items() if formula]
    rows = [*laws, ("hertz_damped with:", None), *formulas]
    places = [i for i, (_, outcome) in enumerate(rows) if outcome is not None]
    for e, mark, colour in ASKED:
        axes.axvline(e, color=colour, linewidth=0.9, zorder=1)
        axes.plot([np.interp(e, *rows[i][1]) for i in places], places, mark, color=colour, markersize=6)
        axes.text(e, -0.75, f"e = {e}", color=colour, ha="center", va="bottom")
    axes.set(xlabel="restitution returned (lines: asked for)", xlim=(0, 1.03), ylim=(len(rows) - 0.4, -0.6))
    axes.set_yticks(range(len(rows)), [name for name, _ in rows], fontsize=9.5)
    axes.get_yticklabels()[len(laws)].set_fontweight("bold")
    axes.tick_params(axis="y", length=0)
    axes.grid(axis="x", visible=False)


if __name__ == "__main__":
    main()
