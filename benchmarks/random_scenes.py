"""Random scenes beside the program in quadruple precision; the page docs/benchmark/random_scenes.md.

"$(ci/environment benchmarks)" benchmarks/random_scenes.py               # 920 scenes, an hour; renews docs/benchmark/
"$(ci/environment benchmarks)" benchmarks/random_scenes.py --scenes 3    # of each kind; shows that it works
"$(ci/environment benchmarks)" benchmarks/random_scenes.py --seed 1      # others
"$(ci/environment benchmarks)" benchmarks/random_scenes.py --kinds row   # of some kinds only

Errors are told per unit of sensitivity: how much a change of the record and of the initial state by one part in 1e18 has
grown by then, which the other program finds in a run of its own. Needs gcc. Scenes and tables are kept below target/.
"""

import argparse
import csv
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import random_frames
import random_rows
import truth
from peers import compiled
from progress import Progress

ROOT = Path(__file__).resolve().parents[1]
WORK = ROOT / "target/benchmarks/random_scenes"
KINDS = random_frames.KINDS | {"row": "three to six buildings in a row, with all of these"}
SCENES, SEED = 115, 0
STEP = 0.01  # s, from row to row
# Errors per unit of sensitivity: of displacements, relative to the largest; of the beginning of an impact, what the floors
# approach each other by in the time that it is off, relative to that; of impulses, relative to the largest. Each contact may
# be off by the relative tolerance of the scenes, 1e-12, which later impacts make larger; that is not in the sensitivity where
# earlier changes of the record have died out meanwhile, as in the long contact of `uneven_0_017`: 1e-10 at a sensitivity of 14.
ALLOWED = {"displacement": 1e-9, "beginning": 1e-9, "impulse": 1e-9}
# What is left out: rows where hardly a digit is left, and impacts whose impulse is so small a part of the largest.
MOST_SENSITIVE, NEGLIGIBLE = 1e9, 1e-9
# s: how many of the rebounds of rigid floors that die out are listed is a convention. Where one program lists one more just
# beyond that time, it is taken to be longer.
AT_ONCE = 1e-9, 3e-9
ROUNDING = 1e-14


@dataclass
class Comparison:
    """Of one scene: errors per unit of sensitivity, by what they are of."""

    name: str
    errors: dict
    impacts: int
    complaint: str = ""
    is_judged: bool = True


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scenes", type=int, default=SCENES, help="of each kind")
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--kinds", nargs="+", choices=KINDS, default=list(KINDS))
    options = parser.parse_args()
    WORK.mkdir(parents=True, exist_ok=True)
    engine = compiled.build_engine(program="simulate")
    truth.program(WORK)  # before threads would compile it side by side
    is_page = (options.scenes, options.seed, options.kinds) == (SCENES, SEED, list(KINDS))
    lines, told, progress = [], [], Progress(len(options.kinds) * options.scenes)
    for kind in options.kinds:
        title = KINDS[kind]
        progress.begin(title)
        found = []
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            seeds = [(options.seed, k) for k in range(options.scenes)]
            for one in pool.map(lambda seed: compare(engine, kind, seed), seeds):
                found.append(one)
                progress.end()
                progress.show(one.name)
        lines.append(row(title, found))
        told += [one for one in found if one.complaint or not are_small(one.errors)]
    progress.clear()
    text = HEADING.format(count=options.scenes * len(options.kinds)) + "\n".join(lines) + "\n"
    if is_page:
        (ROOT / "docs/benchmark/random_scenes.md").write_text(text)
    print(text)
    for one in told:
        print(f"{WORK.relative_to(ROOT)}/{one.name}.toml: {one.complaint or one.errors}", file=sys.stderr)
    sys.exit(1 if any(one.is_judged for one in told) else 0)


def are_small(errors):
    """A NaN is not."""
    return all(errors[of] <= ALLOWED[of] for of in errors)


def row(title, found):
    judged = [one for one in found if not one.complaint]
    errors = [[one.errors[of] for one in judged] or [np.nan] for of in ALLOWED]
    numbers = " | ".join(f"{np.median(of):.1e} | {np.max(of):.1e}" for of in errors)
    return f"| {title} | {len(judged)} | {sum(one.impacts for one in judged)} | {numbers} |"


def compare(engine, kind, seed):
    """Solves a scene with both programs."""
    rng = np.random.default_rng([*seed, list(KINDS).index(kind)])
    name = f"{kind}_{seed[0]}_{seed[1]:03}"
    scene = WORK / f"{name}.toml"
    times, accelerations = random_frames.record(rng)
    rows = "".join(f"{float(t)!r},{float(a)!r}\n" for t, a in zip(times, accelerations, strict=True))
    (WORK / f"{name}.csv").write_text("time_s,accel_m_s2\n" + rows)
    text = random_rows.scene(rng) if kind == "row" else random_frames.scene(rng, kind)
    scene.write_text(text + f'[ground]\nrecord = "{name}.csv"\n')
    stem = WORK / name
    command = [engine, scene, "--step", repr(STEP), "--csv", f"{stem}.rows.csv", "--impacts", f"{stem}.hits.csv"]
    ours = subprocess.run(command, capture_output=True, text=True)
    if ours.returncode != 0:
        return Comparison(name, {}, 0, ours.stderr.strip())
    try:
        truth.solve(scene, stem, STEP, "--proof")
    except subprocess.CalledProcessError as error:
        said = f"not judged, the reference fails: {error.stdout}{error.stderr}"
        return Comparison(name, {}, 0, said, is_judged=False)
    return judge(name, *(read(f"{stem}.{of}.csv") for of in ("rows", "displacements", "hits", "impacts")))


def judge(name, rows, expected, hits, impacts):
    if len(rows["time"]) < len(expected["time"]):
        return Comparison(name, {}, 0, f"{len(rows['time'])} rows in place of {len(expected['time'])}")
    sensitivity = np.maximum(1.0, expected["sensitivity"])
    known = sensitivity < MOST_SENSITIVE
    columns = [column for column in expected if ".displacement[" in column]
    largest = max(np.abs(expected[column]).max() for column in columns)
    differences = [np.abs(rows[column][: len(known)] - expected[column]) for column in columns]
    errors = {"displacement": (np.max(differences, axis=0) / sensitivity)[known].max() / largest}
    if missed := peaks_below(rows, expected, known, max(ROUNDING, errors["displacement"]) * largest):
        return Comparison(name, errors, 0, f"{missed} is below what has been")
    until = expected["time"][known][-1]
    for at_once in AT_ONCE:
        ours, theirs = weighty(hits, until, at_once), weighty(impacts, until, at_once)
        if list(ours["contact"]) == list(theirs["contact"]):
            break
    else:
        return Comparison(name, errors, len(theirs["contact"]), f"{len(ours['contact'])} impacts in place of these")
    grown = np.interp(theirs["start_s"], expected["time"], sensitivity)
    off = (ours["start_s"] - theirs["start_s"]) * theirs["approach_velocity"]
    errors["beginning"] = np.max(np.abs(off) / grown, initial=0.0) / largest
    hardest = np.max(np.abs(theirs["impulse"]), initial=1e-300)
    errors["impulse"] = np.max(np.abs(ours["impulse"] - theirs["impulse"]) / grown, initial=0.0) / hardest
    return Comparison(name, errors, len(grown))


def peaks_below(rows, expected, known, error):
    """The name of a peak of displacements or drifts that is below a row of the other program by more than the errors."""
    room = 2.0 * error * np.maximum(1.0, expected["sensitivity"]).max()
    for side in dict.fromkeys(column.split(".")[0] for column in expected if ".displacement[" in column):
        below = expected.get(f"{side}.foundation.displacement", 0.0)
        leaning = expected.get(f"{side}.foundation.rotation", 0.0) * random_frames.HEIGHT
        for floor in range(1, sum(column.startswith(f"{side}.displacement[") for column in expected) + 1):
            moved = expected[f"{side}.displacement[{floor}]"]
            for of, reached in (("displacement", moved), ("drift", moved - below - leaning)):
                peak = f"{side}.peak_{of}[{floor}]"
                if not np.abs(reached[known]).max() <= rows[peak][: len(known)][known].max() + room:
                    return peak
            below = moved
    return ""


def weighty(impacts, until, at_once):
    """The impacts that are compared, one contact after the other; rebounds that follow each other at once are one impact."""
    order = np.lexsort((impacts["start_s"], impacts["contact"]))
    contact, start, approach, impulse = (
        impacts[name][order] for name in ("contact", "start_s", "approach_velocity", "impulse")
    )
    begins = np.ones(len(start), dtype=bool)
    begins[1:] = (np.diff(contact) != 0) | (np.diff(start) > at_once)
    impulse = np.add.reduceat(impulse, np.flatnonzero(begins)) if len(start) else impulse
    contact, start, approach = contact[begins], start[begins], approach[begins]
    chosen = (np.abs(impulse) > NEGLIGIBLE * np.max(np.abs(impulse), initial=0.0)) & (start < until)
    columns = {"contact": contact, "start_s": start, "approach_velocity": approach, "impulse": impulse}
    return {name: column[chosen] for name, column in columns.items()}


def read(path):
    """The columns of a table."""
    with open(path, newline="") as file:
        table = csv.DictReader(line for line in file if not line.startswith("#"))
        rows = list(table)
    return {name: np.array([float(row[name] or "nan") for row in rows]) for name in table.fieldnames}


HEADING = """# Random scenes beside quadruple precision

{count} scenes from a fixed seed: two frames of one to four storeys, in rows three to six of up to three, some 1 to 1000 t and
0.5 to 5 Hz, damped by ratios, Rayleigh damping, dashpots or a matrix, with any law at gaps from 0.5 to 20 mm, in 3 s of random
shaking (rows 2 s); displacements of all floors every 0.01 s, beginnings and impulses of all impacts beside those of the program of
[tests/reference](../../tests/reference/README.md), which shares neither method nor code with the engine. No peak is below what that program has read. The few scenes of which it does
not find an event itself are not counted.

Errors are per unit of sensitivity (how many times a small change of the record has grown by then; 1 at least): of displacements
relative to the largest; of the beginning of an impact what the floors approach each other by in the time that it is off,
relative to the largest displacement; of impulses relative to the largest. Made by `benchmarks/random_scenes.py`.

| scenes with | scenes | impacts | displacement: median | worst | beginning: median | worst | impulse: median | worst |
|---|---|---|---|---|---|---|---|---|
"""

if __name__ == "__main__":
    main()
