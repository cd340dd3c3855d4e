"""Section 3.2 of the paper: the natural frequencies of the FEUP frames.

"$(ci/environment)" examples/paper/feup.py
"""

import functools
from pathlib import Path

import numpy as np
from pounding_fmu.plots import style

import scenes
import statement
from statement import Statement, holds

SCENE = scenes.read(Path(__file__).with_name("scenes") / "feup_free_vibration.toml")
STEP = 0.01  # s
# Hz, as the paper prints them.
PUBLISHED = {"left": ["2.77", "7.3"], "right": ["2", "5.60", "8.09"]}
NAMES = {"left": "2 storeys", "right": "3 storeys"}


def parts():
    return {"feup": f"{frequencies_table()}\n\n{statement.verdicts(statements())}"}


@functools.cache
def run():
    top = {side: len(SCENE[side]["mass"]) for side in PUBLISHED}
    return scenes.run(SCENE, step=STEP, columns=tuple(f"{side}.displacement[1]" for side in top))


def frequencies():
    """Published and ours, Hz, with the frame's name and the mode."""
    ours_of = scenes.frequencies(SCENE)
    for side, published in PUBLISHED.items():
        for mode, (text, ours) in enumerate(zip(published, ours_of[side], strict=True), 1):
            yield NAMES[side], mode, text, ours


def agrees(published, ours):
    """Whether cutting or rounding ours gives what is printed."""
    digits = len(published.partition(".")[2])
    unit = 10**-digits
    return -0.5 * unit <= ours - float(published) < unit


def frequencies_table():
    body = [[f"{frame}, mode {mode}", text, f"{ours:.4f}"] for frame, mode, text, ours in frequencies()]
    return statement.numbers(["frame", "published [Hz]", "ours [Hz]"], body)


def statements():
    good = [agrees(text, ours) for _, _, text, ours in frequencies()]
    return [
        Statement(
            "section 3.2",
            "m = 3.65 kg and k = 2910 N/m give 2.77 and 7.3 Hz, and 2, 5.60 and 8.09 Hz",
            holds(all(good)),
            f"{sum(good)} of {len(good)} agree to the printed digits, partly cut and partly rounded",
        ),
    ]


def draw(folder):
    figure, panels = style.pyplot().subplots(1, 2, figsize=(10, 3.9), sharey=True, layout="constrained")
    for axes, (side, look) in zip(panels, [("left", style.LEFT), ("right", style.RIGHT)]):
        frequency, amplitude = spectrum(run().motion[f"{side}.displacement[1]"])
        axes.semilogy(frequency, amplitude / amplitude.max(), **{**look, "linestyle": "-"})
        for text in PUBLISHED[side]:
            axes.axvline(float(text), color=style.BLACK, linestyle=":", linewidth=1.2)
            axes.annotate(f"{text} Hz", (float(text), 2.2), (5, 0), textcoords="offset points", va="center")
        axes.set(
            xlabel="frequency [Hz]",
            xlim=(0, 10),
            ylim=(1e-4, 4),
            title=f"{NAMES[side]}, free vibration of the first floor (dotted: published)",
        )
    panels[0].set_ylabel("amplitude / largest")
    style.save(figure, folder / "feup.png")


def spectrum(motion):
    """Hz, and the amplitude at each frequency."""
    window = np.hanning(len(motion))
    return np.fft.rfftfreq(len(motion), STEP), np.abs(np.fft.rfft(window * motion))


def main():
    draw(statement.PICTURES)
    statement.publish(parts())


if __name__ == "__main__":
    main()
