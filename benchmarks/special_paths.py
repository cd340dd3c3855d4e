"""What each special path of the engine brings to those who use it: instructions of whole runs without it, relative to those with all.

"$(ci/environment benchmarks)" benchmarks/special_paths.py                   # two hours; renews docs/benchmark/special_paths.md
"$(ci/environment benchmarks)" benchmarks/special_paths.py --path windows onset+time_map   # some paths, alone or together
"$(ci/environment benchmarks)" benchmarks/special_paths.py --page            # the page anew from what has been measured, as it is
"$(ci/environment benchmarks)" benchmarks/special_paths.py --quick           # one path, two scenes: shows that it works

Each path has one line in the engine, `cfg!(without = "...")`, that switches it off. The library of an FMU is compiled once for
each, and for some together, as paths cover for each other; a program in C (drive.c) makes the steps of an importer, which
callgrind counts: that needs no quiet machine. Set-up is taken off. What has been measured is kept below target/ and measured
again when the library has changed.

The rule: a path stays if the user's set without it, or without it and those that cover for it, takes 1.10 times the instructions
in the geometric mean, or one whole group of it 1.25 times.
"""

import argparse
import hashlib
import json
import math
import shutil
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path

import instructions
import record
import scenes
from progress import Progress

ROOT = Path(__file__).resolve().parents[1]
WORK = ROOT / "target/benchmarks/special_paths"
PAGE = ROOT / "docs/benchmark/special_paths.md"
EXAMPLES = ROOT / "examples"
LAWS = ["linear", "kelvin_voigt", "hertz", "jankowski", "hertz_damped"]
STUDY = "study of 100 gaps"
MEAN, GROUP = 1.10, 1.25  # what a path has to bring
# Settings of cargo, by which the library is that of `cargo fmu`, in a quarter of the time of a release's.
AS_CARGO_FMU = {"CARGO_PROFILE_RELEASE_LTO": "false", "CARGO_PROFILE_RELEASE_CODEGEN_UNITS": "8"}

# By the name of its switch: what it is, and where.
PATHS = {
    "windows": "a whole contact in one or two collocation windows (`engine/window/`)",
    "onset": "the double series after an entry under a power law (`engine/onset/`)",
    "time_map": "series in a stretched time near entries and releases (`engine/taylor/time_map.rs`)",
    "floors": "floors instead of modes where these are many (`structure/floors.rs`)",
    "oscillators": "coupled damping as oscillators in flights (`structure/complex_modes.rs`)",
    "dismissal": "for how long pairs cannot meet (`flight/broad_phase.rs`)",
    "certificate": "no entry, shown by both ends of a flight (`bounds/certificate.rs`)",
    "envelopes": "no entry, shown by amplitudes (`bounds/oscillation.rs`)",
    "short_flight": "a short flight straight to its end (`structure/short_flight.rs`)",
    "flight_work": "work over a flight as a quadratic form (`structure/flight_work.rs`)",
    "flight_log": "peaks of flights read many at once (`peaks/fold.rs`, `bounds/span.rs`)",
    "peak_clearance": "for how long no peak can rise (`peaks/clearance.rs`)",
    "settled": "modes whose swing is below rounding (`peaks/settled.rs`)",
}

# Paths that cover for each other.
TOGETHER = [
    ("onset", "time_map"),
    ("windows", "onset", "time_map"),
    ("dismissal", "certificate"),
    ("certificate", "envelopes", "short_flight"),
]


@dataclass(frozen=True)
class Use:
    """A scene, the group that it counts for, and which of its peaks are read at each step: none, one or all."""

    group: str
    name: str
    text: str
    peaks_read: str = "none"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--page", action="store_true", help="compile and count nothing")
    parser.add_argument("--path", nargs="+", metavar="PATH[+PATH]", help="those to switch off")
    options = parser.parse_args()
    if not shutil.which("valgrind"):
        raise SystemExit("valgrind is missing: it is in the Debian package valgrind")
    switches = [(path,) for path in PATHS] + TOGETHER
    if options.path:
        switches = [tuple(path.split("+")) for path in options.path]
    if unknown := {path for paths in switches for path in paths} - PATHS.keys():
        parser.error(f"unknown: {', '.join(sorted(unknown))}")
    switches, uses = ([("dismissal",)], users()[:2]) if options.quick else (switches, users())
    WORK.mkdir(parents=True, exist_ok=True)
    if options.page:
        measured = {paths: kept(paths) for paths in switches if known_file(paths).exists()}
        found = {paths: runs for paths, runs in measured.items() if len(runs) == len(uses)}
        PAGE.write_text(report(kept(()), found, uses))
        return
    record.write(WORK / "record.csv", 0.01)
    runs = [Run(use) for use in uses]
    progress = Progress(len(switches) + 1)
    with_all = measure((), build(()), runs, progress)
    # While one library is counted the next is compiled.
    with ThreadPoolExecutor(1) as builder:
        libraries = [builder.submit(build, paths) for paths in switches]
        found = {paths: measure(paths, library.result(), runs, progress) for paths, library in zip(switches, libraries)}
    progress.clear()
    page = PAGE if not (options.quick or options.path) else WORK / "page.md"
    page.write_text(report(with_all, found, uses))
    print(f"results: {page.relative_to(ROOT)}")


def users():
    """What people run, with peaks as the default has them."""
    examples = sorted((EXAMPLES / "scenes").glob("*.toml"))
    uses = [Use("examples", scene.stem, scene.read_text().replace("../records/", f"{EXAMPLES}/records/")) for scene in examples]
    uses += [Use(name, f"{name} {law}", of_benchmark(scenes.problem(name, law))) for name in ("S1", "S2", "S3", "S4") for law in LAWS]
    uses.append(Use("32 + 32 storeys", "32 + 32 storeys, one contact, hertz", of_benchmark(tall())))
    uses.append(Use(STUDY, STUDY, uses[0].text))
    readers = {
        "all": ("peaks read", {"feup", "neighbours", "on_soil", "S2 hertz", "S4 jankowski"}),
        "one": ("one peak read", {"offices", "feup", "S1 linear", "S3 linear"}),
    }
    read = [
        replace(use, group=group, name=f"{use.name}, {group}", peaks_read=which)
        for which, (group, names) in readers.items()
        for use in uses
        if use.name in names
    ]
    return uses + read


def of_benchmark(problem):
    return problem.toml().replace('"record.csv"', f'"{WORK}/record.csv"')


def tall():
    """Towers of 32 storeys of about the periods of S4, whose tops meet."""
    mean = scenes.TEMPLATES["S4"]
    of = lambda mass, stiffness: scenes.shear(32, mass, stiffness, scenes.RAYLEIGH, 0.05)
    template = replace(mean, left=of(3e5, 1.28e9), right=of(4e5, 7.5e8), pairs=1, lowest=31)
    return scenes.Problem("towers", "hertz", template)


class Run:
    """What is counted of a use: steps of 10 ms, of which one less is taken off; or a study, of which one case is."""

    def __init__(self, use):
        self.use = use
        place = WORK / "scenes" / (use.name.replace(" ", "_").replace(",", "") + ".toml")
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(use.text)
        self.case = instructions.Case(place, use.peaks_read)
        self.digest = hashlib.sha256(use.text.encode()).hexdigest()

    def count(self, driver, library):
        if self.use.group == STUDY:
            return self.case.study(driver, library, 100)
        return self.case.instructions(driver, library)


def build(paths):
    """The library without some paths: the one crate that has them is compiled for each."""
    place = WORK / "libraries" / f"{'+'.join(paths) or 'all'}.so"
    switches = [part for path in paths for part in ("--cfg", f'without="{path}"')]
    return instructions.built(WORK / "cargo", place, *switches, **AS_CARGO_FMU)


def measure(paths, library, runs, progress):
    """Instructions and a hash of the results of all runs, by their names."""
    progress.begin("+".join(paths) or "all")
    file = known_file(paths)
    code = hashlib.sha256(library.read_bytes()).hexdigest()
    known = json.loads(file.read_text()) if file.exists() else {}
    found = known["runs"] if known.get("library") == code else {}
    driver = instructions.compiled_driver()
    for run in runs:
        progress.show(run.use.name)
        if found.get(run.use.name, {}).get("scene") != run.digest:
            count, bits = run.count(driver, library)
            found[run.use.name] = {"scene": run.digest, "instructions": count, "bits": bits}
            file.write_text(json.dumps({"library": code, "runs": found}))
    progress.end()
    return found


def known_file(paths):
    return WORK / f"{'+'.join(paths) or 'all'}.json"


def kept(paths):
    """What has been measured before."""
    return json.loads(known_file(paths).read_text())["runs"]


def report(with_all, found, uses):
    """The page."""
    groups = list(dict.fromkeys(use.group for use in uses))
    lines = [
        "<!-- Written by benchmarks/special_paths.py. -->",
        "# What the special paths bring",
        "",
        "Instructions of FMU runs without a path, relative to those with all: the geometric mean over all scenes and over each",
        "group, then the scene where it brings most, and in how many scenes it changes a bit of what is read. Bold is what lets",
        f"a path stay: {MEAN:.2f} in the mean of all, or {GROUP:.2f} in that of a group, alone or with those that cover for it.",
        "",
        "| without | all | " + " | ".join(groups) + " | most | bits |",
        "|---|" + "---|" * (len(groups) + 3),
    ]
    for paths, measured in found.items():
        ratio = {use.name: measured[use.name]["instructions"] / with_all[use.name]["instructions"] for use in uses}
        mean = lambda of: math.exp(sum(math.log(ratio[use.name]) for use in of) / len(of))
        cells = [cell(mean(uses), MEAN), *(cell(mean([use for use in uses if use.group == group]), GROUP) for group in groups)]
        most = max(ratio, key=ratio.get)
        changed = sum(measured[name]["bits"] != with_all[name]["bits"] for name in ratio)
        what = f"`{paths[0]}`: {PATHS[paths[0]]}" if len(paths) == 1 else ", ".join(f"`{path}`" for path in paths)
        lines.append("| " + " | ".join([what, *cells, f"{most} {ratio[most]:.2f}", f"{changed} of {len(uses)}"]) + " |")
    total = {group: sum(with_all[use.name]["instructions"] for use in uses if use.group == group) / 1e6 for group in groups}
    lines += [
        "",
        "The scenes, all with peaks as the default has them: those of `examples/scenes`; S1 to S4 ([README.md](README.md)) under",
        "`linear`, `kelvin_voigt`, `hertz`, `jankowski` and `hertz_damped`; two towers of 32 storeys that meet at their tops;",
        f"100 gaps from 1 to 100 mm of `{uses[0].name}`, each one step to its end; five of the scenes with all peaks read at each",
        "step, four with one peak read, as by who watches a drift. 2000 steps of 10 ms, at which the top displacements and contact",
        "forces are read, and all Real outputs at the end.",
        "",
        "Millions of instructions with all paths: " + ", ".join(f"{group} {count:.0f}" for group, count in total.items()) + ".",
        "",
    ]
    counted = {path for paths in found for path in paths}
    if missing := [f"`{path}`: {what}" for path, what in PATHS.items() if path not in counted]:
        lines += ["Not counted here: " + "; ".join(missing) + ".", ""]
    return "\n".join(lines)


def cell(ratio, enough):
    return f"**{ratio:.2f}**" if ratio >= enough else f"{ratio:.2f}"


if __name__ == "__main__":
    main()
