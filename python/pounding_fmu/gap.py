"""Which gap does a pair of buildings need, and what does a smaller one cost?

    cargo fmu examples/scenes/offices.toml
    python3 examples/run.py examples/choose_gap.py target/fmu/Offices.fmu

First the buildings far apart: how much each contact would close, beside what codes estimate from the peaks of either
building. Then the same FMU with smaller and smaller gaps at all contacts: its gaps are parameters.
"""

import argparse
import itertools

import numpy as np
from fmpy import read_model_description, simulate_fmu

FAR = 1000.0  # m
SHARES = [1.01, 0.8, 0.6, 0.4, 0.2, 0.0]  # of the gap that keeps the buildings apart


class Buildings:
    """An FMU with contacts, run with one gap at all of them."""

    def __init__(self, fmu):
        self.fmu = fmu
        description = read_model_description(fmu)
        names = [variable.name for variable in description.modelVariables]
        self.stop = float(description.defaultExperiment.stopTime)
        self.contacts = [name.removesuffix(".gap") for name in names if name.startswith("contact[") and name.endswith(".gap")]
        drifts = {side: [n for n in names if n.startswith(f"{side}.peak_drift[")] for side in ("left", "right")}
        # One building may stand alone, between walls.
        self.drifts = {side: of_side for side, of_side in drifts.items() if of_side}
        self.displacements = [name for name in names if ".peak_displacement[" in name]
        if not (self.contacts and self.displacements):
            raise SystemExit(f"error: {fmu}: expected contacts and peaks (its scene may say outputs.peaks = false)")

    def run(self, gap, interval):
        """Time histories by name, a row every interval, s; peaks, counts and impulses miss nothing in between."""
        wanted = ["impacts", *self.displacements, *itertools.chain(*self.drifts.values())]
        wanted += [f"{contact}.{what}" for contact in self.contacts for what in ("penetration", "peak_force")]
        gaps = {f"{contact}.gap": gap for contact in self.contacts}
        return simulate_fmu(self.fmu, stop_time=self.stop, output_interval=interval, start_values=gaps, output=wanted)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("fmu", help="an FMU with contacts and a record inside")
    buildings = Buildings(parser.parse_args().fmu)
    # How much a pair closes has no peak of its own: rows so fine that none between them is 0.1 % larger.
    apart = buildings.run(FAR, 1e-3)
    closes = {contact: max(apart[f"{contact}.penetration"]) + FAR for contact in buildings.contacts}
    needed = max(closes.values())
    for contact, closing in closes.items():
        print(f"{contact} closes by {1e3 * closing:.1f} mm")
    peaks = {name.replace("peak_", ""): apart[name][-1] for name in buildings.displacements}
    print("largest displacements: " + ", ".join(f"{name} {1e3 * peak:.1f} mm" for name, peak in peaks.items()))

    free = {side: np.array([apart[name][-1] for name in names]) for side, names in buildings.drifts.items()}
    print(f"\n gap/mm  impacts  peak force/kN  storey drift, {'  '.join(free)} (largest, relative to apart)")
    for share in SHARES:
        result = buildings.run(share * needed, buildings.stop)
        force = max(result[f"{contact}.peak_force"][-1] for contact in buildings.contacts)
        ratios = [
            max(np.array([result[name][-1] for name in names]) / free[side]) for side, names in buildings.drifts.items()
        ]
        said = "".join(f"  {ratio:5.2f}" for ratio in ratios)
        print(f"{1e3 * share * needed:7.1f}  {result['impacts'][-1]:7d}  {force / 1e3:13.0f}{' ' * 13}{said}")


if __name__ == "__main__":
    main()
