"""Pictures of a run of any scene, each a PNG below target/pictures/<name of the scene>.

    python3 examples/run.py examples/plot_scene.py examples/scenes/feup.toml
    python3 examples/run.py examples/plot_scene.py SCENE.toml --picture hysteresis drifts --record MINE.AT2

The engine runs with the scene as it is and without its contacts. Without --from and --to the pictures over time show
the seconds with the strongest pounding.
"""

import argparse
from pathlib import Path

import numpy as np

import animation
import pictures
import pictures_yielding
from engine import ROOT
from layout import Scene
from meetings import meetings
from runs import simulate_finely
from style import save

STATIC = {
    "contacts": meetings,
    "floors": pictures.floors,
    "forces": pictures.forces,
    "accelerations": pictures.accelerations,
    "hysteresis": pictures.hysteresis,
    "drifts": pictures.drifts,
    "loops": pictures_yielding.loops,
    "residual": pictures_yielding.residual,
}
WINDOW = 5.0  # s


def main():
    options = arguments()
    scene = Scene(options.scene)
    run, alone = simulate_finely(scene, stop=options.stop, record=options.record)
    if not any(np.any(run[f"{side}.displacement[1]"]) for side in scene.floors):
        raise SystemExit("nothing moves in this scene: give it a ground motion with --record FILE")
    folder = options.output or ROOT / "target/pictures" / scene.name
    window = strongest(run, WINDOW)
    window = (options.start if options.start is not None else window[0], options.end or window[1])
    for name in options.picture:
        if name == "animation":
            animation.write(folder / "animation.gif", scene, run, window)
        else:
            figure = STATIC[name](scene, run, alone, window)
            if figure is None:
                print(f"no picture of {name}: nothing of the kind happens in this run")
            else:
                save(figure, folder / f"{name}.{options.format}")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", type=Path)
    names = [*STATIC, "animation"]
    parser.add_argument("--picture", nargs="+", choices=names, default=names, metavar="NAME", help=", ".join(names))
    parser.add_argument("--record", type=lambda name: Path(name).resolve(), help="ground motion of a scene without one")
    parser.add_argument("--stop", type=float, help="s, end of the run")
    parser.add_argument("--from", dest="start", type=float, help="s, beginning of the pictures over time")
    parser.add_argument("--to", dest="end", type=float, help="s, their end")
    parser.add_argument("--output", type=lambda name: Path(name).resolve(), help="folder")
    parser.add_argument("--format", choices=["png", "svg"], default="png")
    options = parser.parse_args()
    if not options.scene.exists():
        parser.error(f"{options.scene}: no such file")
    return options


def strongest(run, length):
    """The window with the largest sum of impulses; without impacts that with the largest displacement."""
    end = run.time[-1]
    if end <= length:
        return (0.0, end)
    if run.impacts:
        times = np.array([impact["start_s"] for impact in run.impacts])
        weights = np.abs([impact["impulse"] for impact in run.impacts])
    else:
        top = run["left.displacement[1]"]
        times, weights = run.time, top**2
    starts = np.linspace(0.0, end - length, 200)
    totals = [np.sum(weights[(times >= start) & (times < start + length)]) for start in starts]
    best = starts[totals == np.max(totals)]
    # In the middle of those that show as much: what happens is not at the edge.
    start = best[len(best) // 2]
    return (start, start + length)


if __name__ == "__main__":
    main()
