"""Runs at the extremes of every parameter, and what came of them: a map, the drift of the energy, an hour of shaking.

"$(ci/environment benchmarks)" benchmarks/extremes.py            # some minutes; renews docs/stability/ and its pictures
"$(ci/environment benchmarks)" benchmarks/extremes.py --quick    # one law and few impacts: shows that the command works
"$(ci/environment benchmarks)" benchmarks/extremes.py --draw     # the pictures alone, from the files of the last run
"""

import argparse
import csv
import json
import subprocess
import textwrap
from pathlib import Path

import extremes_map
import machine

ROOT = Path(__file__).resolve().parents[1]
RESULTS = ROOT / "docs/stability"
PAGE = ROOT / "docs/stability.md"
IMAGES = ROOT / "docs/images"
# s; a run that is given up by the engine takes ten, and there are few of them.
TOO_LONG = 3600


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--draw", action="store_true", help="draw the files of the last run again")
    options = parser.parse_args()
    results = ROOT / "target/benchmarks/stability" if options.quick else RESULTS
    images = results if options.quick else IMAGES
    results.mkdir(parents=True, exist_ok=True)
    if not options.draw:
        program = build()
        measure(program, ["grid", *(["hertz"] if options.quick else [])], results / "grid.csv")
        measure(program, ["drift", "300" if options.quick else "100000"], results / "drift.csv")
        if not options.quick:
            measure(program, ["hour"], results / "hour.csv")
            (results / "machine.txt").write_text(f"{machine.processor()}\n{machine.first_line(['rustc', '--version'])}\n")
    grid = read(results / "grid.csv")
    extremes_map.draw(grid, images / "extremes.png")
    extremes_map.draw_drift(read(results / "drift.csv"), images / "energy_drift.png")
    if not options.quick:
        renew("grid", summary(grid))
        renew("hour", hour(read(results / "hour.csv")))
        renew("message", message(grid))
    print(f"results: {results.relative_to(ROOT)}, pictures: {images.relative_to(ROOT)}")


def build():
    command = ["cargo", "build", "--release", "--example", "extremes", "--message-format=json-render-diagnostics"]
    made = subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout
    programs = [json.loads(line).get("executable") for line in made.splitlines()]
    return next(program for program in programs if program)


def measure(program, words, file):
    """Lets the program write the rows of a file."""
    with file.open("w") as out:
        subprocess.run([program, *words], check=True, stdout=out, timeout=TOO_LONG)


def read(file):
    with file.open(newline="") as rows:
        return list(csv.DictReader(rows))


def summary(grid):
    """How the runs came out, law by law."""
    lines = [
        "| law | runs | to the end | largest residual | refused | given up | median time, ms | longest, s |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for law in dict.fromkeys(row["law"] for row in grid):
        rows = [row for row in grid if row["law"] == law]
        count = {outcome: [row for row in rows if row["outcome"] == outcome] for outcome in ("ended", "refused", "stopped")}
        worst = max(abs(float(row["residual"])) for row in count["ended"])
        times = sorted(float(row["seconds"]) for row in rows)
        lines.append(
            f"| `{law}` | {len(rows)} | {len(count['ended'])} | {worst:.0e} | {len(count['refused'])} | "
            f"{len(count['stopped'])} | {1e3 * times[len(times) // 2]:.2g} | {times[-1]:.1f} |"
        )
    return "\n".join(lines) + "\n"


def hour(rows):
    lines = ["| law | contacts | largest residual | difference, m | time of both runs, s |", "|---|---|---|---|---|"]
    for row in rows:
        law = row["law"].split()[2]
        figures = [f"{float(row[name]):.0e}" for name in ("residual", "difference")]
        lines.append(f"| `{law}` | {row['impacts']} | {' | '.join(figures)} | {float(row['seconds']):.1f} |")
    return "\n".join(lines) + "\n"


def message(grid):
    """What is said of a run that was given up."""
    given_up = next(row["message"] for row in grid if row["outcome"] == "stopped")
    return f"```text\n{textwrap.fill(given_up, 120)}\n```\n"


def renew(name, table):
    """Puts a table, or other text, between its marks in the page."""
    before, rest = PAGE.read_text().split(f"<!-- {name} -->\n")
    after = rest.split(f"<!-- end of {name} -->\n")[1]
    PAGE.write_text(f"{before}<!-- {name} -->\n{table}<!-- end of {name} -->\n{after}")


if __name__ == "__main__":
    main()
