"""What each special path of the engine brings: instructions of whole runs without it, relative to those with all paths.

"$(ci/environment benchmarks)" benchmarks/special_paths.py                  # an hour; renews docs/benchmark/special_paths.md
"$(ci/environment benchmarks)" benchmarks/special_paths.py --path windows   # some paths only
"$(ci/environment benchmarks)" benchmarks/special_paths.py --quick          # one path, two scenes: shows that it works

Each path has one line in the engine, `cfg!(without = "...")`, that switches it off. The program of run_time.rs is
compiled once for each and counted by callgrind, which needs no quiet machine. What has been measured is kept below
target/ and is measured again when the program has changed.
"""

import argparse
import hashlib
import json
import os
import re
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

import record
import scenes
from peers import compiled
from progress import Progress

ROOT = Path(__file__).resolve().parents[1]
WORK = ROOT / "target/benchmarks/special_paths"
PAGE = ROOT / "docs/benchmark/special_paths.md"
FRAMES = ROOT / "examples/scenes/feup.toml"
DEFAULT, USUAL = 1e-12, 1e-9  # tolerances: of a scene that says nothing, of the other benchmarks
COUNTED = "*run_time*solve*"  # the function of run_time.rs that is counted

# By the name of its switch: what it is, and where.
PATHS = {
    "windows": "a whole contact in one or two collocation windows (`engine/window/`)",
    "onset": "the double series after an entry under a power law (`engine/onset/`)",
    "time_map": "series in a stretched time near entries and releases (`engine/taylor/time_map.rs`)",
    "few_modes": "up to 16 modes in registers, all pairs abreast (`pairs/jacobian.rs`)",
    "floors": "floors instead of modes where these are many (`structure/floors.rs`)",
    "at_once": "a pair's own force without a detour by the motion (`taylor/pair_forces.rs`)",
    "fast_flight": "many segments in one loop (`advance/fast_flight.rs`)",
    "dismissal": "for how long pairs cannot meet (`flight/broad_phase.rs`)",
    "certificate": "no entry, shown by both ends of a flight (`bounds/certificate.rs`)",
    "envelopes": "no entry, shown by amplitudes (`bounds/oscillation.rs`)",
    "short_flight": "a short flight straight to its end (`structure/short_flight.rs`)",
}


@dataclass(frozen=True)
class Case:
    """A run: a scene, how it is read, and the column that it counts for."""

    column: str
    name: str
    text: str
    method: str = "engine"
    tolerance: float = DEFAULT

    @property
    def key(self):
        return f"{self.column} {self.name} {self.method} {self.tolerance:g}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--path", nargs="+", choices=PATHS, default=list(PATHS), help="those to switch off")
    options = parser.parse_args()
    if not shutil.which("valgrind"):
        raise SystemExit("valgrind is missing: it is in the Debian package valgrind")
    paths, runs = (["fast_flight"], cases()[:2]) if options.quick else (options.path, cases())
    write_records()
    progress = Progress(len(paths) + 1)
    with_all = measure(None, build(None), runs, progress)
    # While one program is counted the next is compiled.
    with ThreadPoolExecutor(1) as builder:
        programs = [builder.submit(build, path) for path in paths]
        found = {path: measure(path, program.result(), runs, progress) for path, program in zip(paths, programs)}
    progress.clear()
    page = WORK / "quick.md" if options.quick else PAGE
    page.write_text(report(with_all, found, runs))
    print(f"results: {page.relative_to(ROOT)}")


def cases():
    """All runs."""
    found = [
        Case(scene, law, scenes.problem(scene, law).toml(), tolerance=tolerance)
        for scene in scenes.TEMPLATES
        for law, tolerance in [
            ("linear", DEFAULT),
            ("hertz", DEFAULT),
            ("jankowski", DEFAULT),
            ("hertz_damped", USUAL),
            ("stereomechanical", DEFAULT),
        ]
        if not scenes.problem(scene, law).yielding_storeys
    ]
    frames = FRAMES.read_text()
    assert "gap = 0.005" in frames and "energy = true" in frames and "../records/" in frames
    frames = frames.replace("../records/", f"{FRAMES.parents[1]}/records/")
    found.append(Case("feup", "feup", frames, "whole"))
    for gap in (0.005, 0.05, 10.0):
        for outputs in ("energy = false", "energy = false\npeaks = false"):
            text = frames.replace("gap = 0.005", f"gap = {gap}").replace("energy = true", outputs)
            what = "without account or peaks" if "peaks" in outputs else "without account"
            found.append(Case("study", f"gap {gap} {what}", text, "whole"))
    return found + others()


def others():
    """Runs unlike those of the benchmark: finer or coarser samples, short communication steps, no record."""
    single, frames, tall = (scenes.TEMPLATES[name] for name in ("S1", "S2", "S4"))
    problem = lambda name, template, **more: scenes.Problem(name, "linear", template, **more)
    swinging = {name: without_record(problem(name, template)) for name, template in (("S2", frames), ("S4", tall))}
    for_long = without_record(problem("long", replace(frames, gap=0.2), stop=2000.0))
    return [
        Case("other", "S2 samples of 5 ms", problem("fine", frames, record="record_0.005.csv").toml(), "whole"),
        Case("other", "S1 samples of 20 ms", problem("coarse", single, record="record_0.02.csv").toml(), "coupled"),
        Case("other", "S4 apart", problem("apart", replace(tall, gap=10.0)).toml(), "coupled"),
        Case("other", "S4 apart with peaks", with_peaks(problem("apart", replace(tall, gap=10.0))), "whole"),
        Case("other", "S2 swinging", swinging["S2"], "coupled"),
        Case("other", "S4 swinging", swinging["S4"], "whole"),
        Case("other", "S2 swinging for 2000 s", for_long, "whole"),
    ]


def with_peaks(problem):
    return problem.toml().replace("peaks = false", "peaks = true")


def without_record(problem):
    """The left building is let go from where it leans; nothing shakes."""
    storeys = len(problem.template.left.mass)
    leaning = [0.05 * (floor + 1) / storeys for floor in range(storeys)]
    text = problem.toml().replace(f'[ground]\nrecord = "{problem.record}"\n', "")
    return text.replace("[left]\n", f"[left]\ninitial_displacement = {leaning}\n")


def write_records():
    for name, step in [("record.csv", 0.01), ("record_0.005.csv", 0.005), ("record_0.02.csv", 0.02)]:
        record.write(WORK / "scenes" / name, step)


def build(path):
    """The program without a path, with the names of its functions: stripped of them it has the same instructions.

    Only the packages of this workspace are compiled for each: what they need cargo keeps.
    """
    wrapper = WORK / "wrappers" / (path or "all")
    wrapper.parent.mkdir(parents=True, exist_ok=True)
    wrapper.write_text('#!/bin/sh\nexec "$@"' + (f" --cfg 'without=\"{path}\"'\n" if path else "\n"))
    wrapper.chmod(0o755)
    settings = {"RUSTC_WORKSPACE_WRAPPER": str(wrapper), "CARGO_PROFILE_RELEASE_STRIP": "none"}
    built = compiled.build_engine(os.environ | settings | {"CARGO_TARGET_DIR": str(WORK / "cargo")})
    program = WORK / "programs" / (path or "all")
    program.parent.mkdir(parents=True, exist_ok=True)
    shutil.copy(built, program)
    return program


def measure(path, program, runs, progress):
    """Instructions and results of all runs, by their keys."""
    progress.begin(path or "all")
    kept = WORK / f"{path or 'all'}.json"
    code = hashlib.sha256(program.read_bytes()).hexdigest()
    known = json.loads(kept.read_text()) if kept.exists() else {}
    found = known["runs"] if known.get("program") == code else {}
    for run in runs:
        progress.show(run.key)
        digest = hashlib.sha256(run.text.encode()).hexdigest()
        if found.get(run.key, {}).get("scene") != digest:
            found[run.key] = {"scene": digest} | count(program, run)
            kept.write_text(json.dumps({"program": code, "runs": found}))
    progress.end()
    return found


def count(program, run):
    scene, output = WORK / "scenes/scene.toml", WORK / "output.bin"
    scene.write_text(run.text)
    tool = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", f"--toggle-collect={COUNTED}"]
    command = [*tool, program, scene, run.method, str(run.tolerance), "1", output]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{program.name}, {run.key}: {done.stderr}")
    return {
        "instructions": int(re.search(r"Collected : (\d+)", done.stderr)[1]),
        "impacts": int(done.stdout.splitlines()[1]),
        "results": np.fromfile(output).tolist(),
    }


def report(with_all, found, runs):
    """The page."""
    columns = list(dict.fromkeys(run.column for run in runs))
    lines = [
        "<!-- Written by benchmarks/special_paths.py. -->",
        "# What the special paths bring",
        "",
        "Instructions of a whole run without a path, relative to the run with all paths: the largest of the scenes of",
        "a column, bold from 1.1 on; then the scene where it brings most, and by how much the results change, relative",
        "to the largest of a run. The paths are ways to the same answer: each change is of the size of what the",
        "tolerance allows or of amplified rounding, and 0 where a path does the same operations.",
        "",
        "| path | " + " | ".join(columns) + " | most in | change |",
        "|---|" + "---|" * (len(columns) + 2),
    ]
    for path, measured in found.items():
        ratios = {run: measured[run.key]["instructions"] / with_all[run.key]["instructions"] for run in runs}
        most = max(runs, key=ratios.get)
        cells = [cell(max(ratios[run] for run in runs if run.column == column)) for column in columns]
        changes = [change(measured[run.key], with_all[run.key]) for run in runs]
        row = [f"`{path}`: {PATHS[path]}", *cells, f"{most.column} {most.name}", f"{max(changes):.0e}"]
        lines.append("| " + " | ".join(row) + " |")
    lines += [
        "",
        "S1 to S4 under `linear`, `hertz`, `jankowski` and `stereomechanical` at the default tolerance of 1e-12, under",
        "`hertz_damped` at 1e-9, read every 0.05 s; feup: the frames of `examples/scenes/feup.toml` with their energy",
        "account; study: the same without it, with several gaps, read at the end alone; other: samples every 5 and",
        "20 ms, communication steps of 10 ms, buildings that never meet, and such that swing without a ground motion.",
        "",
        "A path that brings less than a tenth of every scene goes.",
        "",
    ]
    return "\n".join(lines)


def cell(ratio):
    return f"**{ratio:.2f}**" if ratio >= 1.1 else f"{ratio:.2f}"


def change(without, with_all):
    """Of the results of one run; where impacts differ, rounding decided about one."""
    ours, all_paths = np.array(without["results"]), np.array(with_all["results"])
    return abs(ours - all_paths).max() / (abs(all_paths).max() or 1.0)


if __name__ == "__main__":
    main()
