"""What the peaks of the floors cost: runs with and without them, in turn; the table docs/benchmark/peaks.md.

"$(ci/environment benchmarks)" benchmarks/peak_price.py            # a few minutes; renews docs/benchmark/
"$(ci/environment benchmarks)" benchmarks/peak_price.py --quick    # seconds, few scenes: shows that the command works
"""

import argparse
import subprocess
from dataclasses import replace
from pathlib import Path

import machine
import record
import scaling
import scenes
from peers import compiled
from progress import Progress

ROOT = Path(__file__).resolve().parents[1]
WORK = ROOT / "target/benchmarks/peak_price"
STEP = "0.01"  # s
HEIGHTS = [8, 16, 64, 200]
WAYS = {
    "end": "Peaks read at the end, a record inside",
    "read": "All peaks read at each of 2000 communication points, a record inside",
    "ground": "A master sets the ground acceleration at each of 2000 communication points",
    "forces": "A master sets forces on all floors at each of 2000 communication points",
}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    WORK.mkdir(parents=True, exist_ok=True)
    record.write(WORK / "record.csv")
    program = compiled.build_engine(program="peak_price")
    folder = ROOT / ("target/benchmarks/quick" if options.quick else "docs/benchmark")
    tables, progress = [], Progress(len(WAYS))
    for way, title in WAYS.items():
        progress.show(title)
        tables.append(table(title, run(program, way, problems(way, options.quick), 1 if options.quick else 7)))
        progress.end()
    progress.clear()
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "peaks.md").write_text("\n".join([HEADING.format(processor=machine.processor()), *tables]))
    print(f"results: {(folder / 'peaks.md').relative_to(ROOT)}")


def problems(way, quick):
    """Names and texts of the scenes."""
    heights = HEIGHTS[:2] if quick else HEIGHTS
    found = {f"{n} storeys, apart": scaling.pair_of(scenes.TEMPLATES["S4"], n, 0).toml() for n in heights}
    if way in ("ground", "forces"):
        found = {name: text.replace('[ground]\nrecord = "record.csv"\n', "") for name, text in found.items()}
        forces = "\n[inputs]\nfloor_forces = true\n"
        return {name: text + forces for name, text in found.items()} if way == "forces" else found
    laws = ["hertz"] if quick else ["hertz", "jankowski", "linear"]
    scene_names = ["S1"] if quick else ["S1", "S2", "S3", "S4"]
    with_contact = {f"{name}, {law}": scenes.problem(name, law).toml() for name in scene_names for law in laws}
    tall = {f"{n} storeys, one contact": scaling.pair_of(scenes.TEMPLATES["S4"], n, 1).toml() for n in heights}
    return with_contact | found | (tall if way == "end" else {})


def run(program, way, texts, repeats):
    """Rows: scene, milliseconds without and with peaks, impacts."""
    files = []
    for k, text in enumerate(texts.values()):
        files.append(WORK / f"{way}_{k:02}.toml")
        files[-1].write_text(text)
    lines = subprocess.run([program, STEP, str(repeats), way, *files], check=True, capture_output=True, text=True).stdout
    rows = [line.split() for line in lines.splitlines()[1:]]
    return [(name, float(row[1]), float(row[2]), int(row[4])) for name, row in zip(texts, rows)]


def table(title, rows):
    lines = [f"## {title}", "", "| scene | impacts | without, ms | with, ms | quotient |", "|---|---|---|---|---|"]
    for name, without, with_peaks, impacts in rows:
        lines.append(f"| {name} | {impacts} | {without:.2f} | {with_peaks:.2f} | {with_peaks / without:.2f} |")
    return "\n".join([*lines, ""])


HEADING = """# The price of peaks

Largest displacements, drifts, accelerations and base shears of all floors in continuous time (`outputs.peaks`), 20 s in
communication steps of 0.01 s, the engine without FMI, the best of 7 runs in turn on {processor}. Made by
`benchmarks/peak_price.py`.
"""

if __name__ == "__main__":
    main()
