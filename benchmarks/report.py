"""The results in words: ratios to the peers, and where a peer wins; Markdown."""

from math import exp, log

from scenes import COMPARED
from solvers import OURS, WITHOUT_PEAKS

ACCURACIES = [1e-3, 1e-6, 1e-9, 1e-12]
GOAL = 1e-9
LOOP = "heyoka, the loop over the samples of the record with an equation that costs nothing:"


def fastest(rows, solver, accuracy, column="best_s"):
    """Least time, s, in which a solver was within an error; None where it never was."""
    measured = [row for row in rows if row["solver"] == solver and row["best_s"]]
    times = [float(row[column]) for row in measured if float(row["error"]) <= accuracy]
    return min(times, default=None)


def of_problem(rows, scene, law):
    return [row for row in rows if row["scene"] == scene and row["law"] == law]


def names(rows, key):
    return list(dict.fromkeys(row[key] for row in rows))


def geometric_mean(values):
    """None of nothing."""
    return exp(sum(map(log, values)) / len(values)) if values else None


def line(problem, rows):
    """One problem on one line, for whoever watches the run."""
    ours, heyoka = fastest(rows, OURS, GOAL), fastest(rows, "heyoka", GOAL)
    compared = f", heyoka {1e3 * heyoka:.2f} ms: {heyoka / ours:.1f} times ours" if ours and heyoka else ""
    counts = f"{rows[0]['true_impacts']} impacts"
    return f"{problem.name}: {counts}; to {GOAL:g}: ours {milliseconds(ours)} ms{compared}"


def milliseconds(seconds):
    return "-" if seconds is None else f"{1e3 * seconds:.3g}"


def write(rows, folder):
    machine = (folder / "machine.txt").read_text().splitlines() if (folder / "machine.txt").exists() else []
    parts = [
        "<!-- Written by benchmarks/work_precision.py. -->",
        f"Machine: {machine[0]}." if machine else "",
        *ratios(rows, loop_seconds(machine)),
        "\n".join(time_table(rows)),
        "\n".join(losses(rows)),
    ]
    (folder / "table.md").write_text("\n\n".join(part for part in parts if part) + "\n")


def loop_seconds(machine):
    """What of heyoka's time is Python's, s."""
    return next((1e-3 * float(line.removeprefix(LOOP).split()[0]) for line in machine if line.startswith(LOOP)), 0.0)


def ratios(rows, loop):
    """The tables of ratios, warm and cold, and what they are."""
    yield f"heyoka's time over ours, each with its fastest setting whose displacements are within {GOAL:g}.\n" + (
        f"In brackets: without the {milliseconds(loop)} ms of an empty loop over the samples of the record.\n"
        "Ours has the peaks of all floors and contacts in continuous time, as everybody runs it; heyoka has none.\n"
        "Warm, in a process that has done the same run before:"
    )
    yield "\n".join(ratio_table(rows, loop, "best_s"))
    yield "Cold, the first run of a fresh process, or of a solver that has just been compiled:"
    yield "\n".join(ratio_table(rows, loop, "cold_s"))
    yield "Warm, without the peaks of the floors (`outputs.peaks = false`), as heyoka is:"
    yield "\n".join(ratio_table(rows, loop, "best_s", WITHOUT_PEAKS))


def ratio_table(rows, loop, column, own=OURS):
    """Time of heyoka over ours, both with the fastest setting that is within the goal."""
    laws = [law for law in COMPARED if law in names(rows, "law")]
    yield "| scene | " + " | ".join(f"`{law}`" for law in laws) + " | geometric mean |"
    yield "|---" * (len(laws) + 2) + "|"
    for scene in names(rows, "scene"):
        times = [[fastest(of_problem(rows, scene, law), solver, GOAL, column) for solver in (own, "heyoka")] for law in laws]
        ratios = [ratio(ours, theirs, loop) if ours and theirs else None for ours, theirs in times]
        reached = [ratio for ratio in ratios if ratio]
        mean = tuple(map(geometric_mean, zip(*reached))) or None
        tried = [law for law in laws if of_problem(rows, scene, law)]
        partial = f", {len(reached)} laws" if len(reached) < len(tried) else ""
        cells = [ratio_cell(ratio) if law in tried else "" for law, ratio in zip(laws, ratios)]
        yield f"| {scene} | " + " | ".join(cells) + f" | **{ratio_cell(mean)}**{partial} |"


def ratio(ours, theirs, loop):
    """As it is, and without the loop."""
    return theirs / ours, max(theirs - loop, 0.01 * theirs) / ours


def ratio_cell(ratio):
    return "-" if ratio is None else f"{ratio[0]:.1f} ({ratio[1]:.1f})"


def time_table(rows):
    """Time of every solver to each accuracy, by scene: geometric mean over the laws."""
    for scene in names(rows, "scene"):
        of_scene = [row for row in rows if row["scene"] == scene and row["law"] in COMPARED]
        laws = names(of_scene, "law")
        if not laws:
            continue
        mean = "geometric mean over " if len(laws) > 1 else ""
        yield f"{scene}, ms for the whole record, {mean}{', '.join(f'`{law}`' for law in laws)}"
        yield "(in brackets: laws that reach the accuracy, where not all do):"
        yield ""
        yield "| solver | " + " | ".join(f"error {accuracy:g}" for accuracy in ACCURACIES) + " |"
        yield "|---" * (len(ACCURACIES) + 1) + "|"
        for solver in names(of_scene, "solver"):
            cells = []
            for accuracy in ACCURACIES:
                times = [fastest(of_problem(rows, scene, law), solver, accuracy) for law in laws]
                reached = [time for time in times if time]
                count = f" ({len(reached)})" if reached and len(reached) < len(laws) else ""
                cells.append(f"{milliseconds(geometric_mean(reached))}{count}")
            yield f"| {solver} | " + " | ".join(cells) + " |"
        yield ""


def losses(rows):
    """Every case in which a peer was faster than we were, at some accuracy."""
    found = []
    for scene in names(rows, "scene"):
        for law in names(rows, "law"):
            of_this = of_problem(rows, scene, law)
            for accuracy in [1e-2, *ACCURACIES]:
                ours = fastest(of_this, OURS, accuracy)
                for peer in [name for name in names(of_this, "solver") if name not in (OURS, WITHOUT_PEAKS)]:
                    theirs = fastest(of_this, peer, accuracy)
                    if theirs and (ours is None or theirs < ours):
                        times = f"{peer} {milliseconds(theirs)} ms, ours {milliseconds(ours)} ms"
                        found.append(f"* {scene} `{law}` to {accuracy:g}: {times}")
    yield "Where a peer is faster, at an error of 1e-2, 1e-3, 1e-6, 1e-9 or 1e-12:"
    yield ""
    yield from found or ["* nowhere in these runs"]
