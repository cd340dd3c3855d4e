"""What yielding does to pounding: the same two buildings elastic and yielding, at several gaps.

    python3 examples/run.py examples/elastic_or_yielding.py examples/scenes/yielding.toml
    python3 examples/run.py examples/elastic_or_yielding.py SCENE.toml --gaps 0.01 0.05

First how far each contact would close if it could, then a table: impacts, the largest contact force, the fastest
approach, and of each building the largest storey drift and, where it yields, ductility and residual drift.
"""

import argparse
import copy
from pathlib import Path

import scenes
from layout import Scene

FAR = 10.0  # m
KEYS = ("yield_force", "post_yield_ratio")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", type=Path, help="with yield forces, contacts and a record")
    parser.add_argument("--gaps", nargs="+", type=float, default=[0.005, 0.01, 0.02, 0.04], metavar="M", help="m")
    options = parser.parse_args()
    yielding = scenes.read(options.scene)
    layout = Scene(options.scene)
    storeys = {side: yielding[side].get("yield_force", []) for side in layout.floors}
    if not any(storeys.values()) or not layout.contacts:
        parser.error(f"{options.scene}: expected yield forces and contacts")
    elastic = copy.deepcopy(yielding)
    for side in layout.floors:
        elastic[side] = {key: value for key, value in elastic[side].items() if key not in KEYS}
    kinds = {"elastic": elastic, "yielding": yielding}

    for name, scene in kinds.items():
        columns = [f"contact[{p}].penetration" for p in range(1, len(layout.contacts) + 1)]
        # How much a pair closes has no peak of its own: rows so fine that none between them is 0.1 % larger.
        apart = scenes.run(with_gap(scene, FAR), step=1e-3, columns=columns).motion
        said = ", ".join(f"{1e3 * (apart[column].max() + FAR):.1f} mm" for column in columns)
        print(f"{name:8}  contacts would close by {said}")
    sides = "".join(f"  {side:>5} drift  ductility  residual" for side in layout.floors)
    print(f"\nin mm, kN and m/s\n  gap            impacts  force  speed{sides}")
    for gap in options.gaps:
        for name, scene in kinds.items():
            print(f"{1e3 * gap:5.0f}  {name:8}  {line(with_gap(scene, gap), layout.floors)}")


def with_gap(scene, gap):
    """The scene with this gap at all contacts."""
    changed = copy.deepcopy(scene)
    for contact in [changed["facing"]] if "facing" in changed else changed["contact"]:
        contact["gap"] = gap
    return changed


def line(scene, floors):
    finite = {
        side: [i for i, force in enumerate(scene[side].get("yield_force", []), 1) if force != float("inf")]
        for side in floors
    }
    drifts = {side: [f"{side}.peak_drift[{i}]" for i in range(1, count + 1)] for side, count in floors.items()}
    of_yielding = {
        (side, what): [f"{side}.{what}[{i}]" for i in storeys]
        for side, storeys in finite.items()
        for what in ("ductility", "residual_drift")
    }
    columns = [name for names in [*drifts.values(), *of_yielding.values()] for name in names]
    run = scenes.run(scene, step=0.5, columns=columns)
    in_mm = lambda name: 1.0 if "ductility" in name else 1e3  # noqa: E731
    largest = lambda names: max((in_mm(name) * abs(run.motion[name][-1]) for name in names), default=None)  # noqa: E731
    cell = lambda value: "" if value is None else f"{value:.1f}"  # noqa: E731
    fastest = max((episode.approach_velocity for episode in run.episodes), default=0.0)
    said = f"{len(run.episodes):7d}  {run.peak_force() / 1e3:5.0f}  {fastest:5.2f}"
    for side in floors:
        ductility, left = (largest(of_yielding[side, what]) for what in ("ductility", "residual_drift"))
        said += f"  {largest(drifts[side]):11.1f}  {cell(ductility):>9}  {cell(left):>8}"
    return said.rstrip()


if __name__ == "__main__":
    main()
