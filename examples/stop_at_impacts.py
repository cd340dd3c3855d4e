"""All impacts, each at its own time, from the results of any master that takes early returns; and a picture.

    "$(ci/environment)" examples/stop_at_impacts.py [--picture docs/images/stop_at_impacts.png]

The master, FMPy here, asks for a step of 0.01 s. Where it allows early return (FMI 3.0), the FMU ends the step at each
impact and at each release, so that the results have a row there.
"""

import argparse
import tempfile
from pathlib import Path

import numpy as np
import pounding_fmu
from fmpy import simulate_fmu
from pounding_fmu.plots.style import BLACK, GREY, VERMILION, pyplot, save

STEP, STOP, CONTACT = 0.01, 20.0, 2


def simulate_both(stop):
    """Rows of a master that takes no early returns, and of one that does."""
    outputs = [f"contact[{CONTACT}].{name}" for name in ("force", "impacts", "approach_velocity")]
    with tempfile.TemporaryDirectory() as folder:
        fmu = pounding_fmu.build_fmu(pounding_fmu.example_scene, Path(folder, "frames.fmu"), fmi=3)
        return [
            simulate_fmu(fmu, stop_time=stop, output_interval=STEP, output=outputs, early_return_allowed=allowed)
            for allowed in (False, True)
        ]


def impacts(rows):
    """Onsets, s, and approach velocities, m/s, of a contact, from the rows in which its number of impacts has grown."""
    onset = 1 + np.flatnonzero(np.diff(rows[f"contact[{CONTACT}].impacts"]))
    return rows["time"][onset], rows[f"contact[{CONTACT}].approach_velocity"][onset]


def draw(grid, stops, around):
    """The contact force about a time, s: a line through the communication points, and the rows that stops have added."""
    figure, axes = pyplot().subplots(figsize=(7.0, 3.2), layout="constrained")
    fine = pounding_fmu.simulate(pounding_fmu.example_scene, 1e-5, STOP, [f"contact[{CONTACT}].force"])
    name, begin, end = f"contact[{CONTACT}].force", around - 0.04, around + 0.1
    added = stops[~np.isin(stops["time"], grid["time"])]
    for rows, style in [
        (fine, {"color": GREY, "linewidth": 1.0, "label": "the force"}),
        (grid, {"color": VERMILION, "marker": "o", "linestyle": "--", "label": "rows every 0.01 s"}),
        (added, {"color": BLACK, "marker": "x", "linestyle": "none", "zorder": 3, "label": "added by early return"}),
    ]:
        seen = (rows["time"] >= begin) & (rows["time"] <= end)
        axes.plot(rows["time"][seen], rows[name][seen], **style)
    axes.set(xlabel="time [s]", ylabel=f"contact[{CONTACT}].force [N]", xlim=(begin, end))
    axes.legend(loc="upper right")
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--picture", type=Path, help="file of the picture")
    picture = parser.parse_args().picture
    grid, stops = simulate_both(STOP)
    times, speeds = impacts(stops)
    print("impact   time [s]              approach velocity [m/s]")
    for i, (time, speed) in enumerate(zip(times[:5], speeds[:5]), 1):
        print(f"{i:6d}   {float(time):<20}   {speed:.12f}")
    pressed = int((grid[f"contact[{CONTACT}].force"] > 0).sum())
    print(f"{len(times)} impacts with a row at each; of the {len(grid)} rows every 0.01 s, {pressed} see a force")
    if picture:
        picture.parent.mkdir(parents=True, exist_ok=True)
        save(draw(grid, stops, times[np.argmax(speeds)]), picture)


if __name__ == "__main__":
    main()
