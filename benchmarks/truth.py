"""Truth: the quadruple-precision program of tests/reference, run once per problem and kept below target/."""

import subprocess
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
REFERENCE = ROOT / "tests/reference"
OUTPUT_STEP = 0.05  # s


class Truth:
    """Displacements in rows of floors, their largest magnitude, and the number of impacts."""

    def __init__(self, displacements, impacts):
        self.displacements = displacements
        self.impacts = impacts
        self.largest = np.abs(displacements).max()

    def error(self, displacements):
        """Largest difference at any floor and output time, relative to the largest displacement of all."""
        difference = np.abs(displacements - self.displacements).max() / self.largest
        return float(difference) if np.isfinite(difference) else float("inf")


def of(problem, folder: Path):
    """Reads the truth of a problem whose files are in `folder`, made first if it is not of this very scene."""
    stem = folder / f"{problem.name}.truth"
    solve(folder / f"{problem.name}.toml", stem, OUTPUT_STEP)
    return read(stem, sum(problem.floors))


def solve(scene, stem, step, *options):
    """Writes the tables of a scene beside `stem`, unless they are of this very scene; a CalledProcessError says why not."""
    made_of, fingerprint = Path(f"{stem}.input"), scene_input(scene, stem.parent, step)
    if not made_of.exists() or made_of.read_text() != fingerprint:
        command = [program(stem.parent), "-", stem, *options]
        subprocess.run(command, input=fingerprint, text=True, check=True, capture_output=True)
        made_of.write_text(fingerprint)


def scene_input(scene, folder, step):
    convert = [sys.executable, REFERENCE / "scene_to_input.py", scene.name, "--step", str(step)]
    return subprocess.run(convert, cwd=folder, text=True, check=True, capture_output=True).stdout.replace(
        "record ", f"record {folder}/", 1
    )


def program(folder):
    """The reference solver, compiled where it is older than its sources."""
    built, sources = folder / "reference", sorted(REFERENCE.glob("*.[ch]"))
    if not built.exists() or built.stat().st_mtime < max(source.stat().st_mtime for source in sources):
        compile = ["gcc", "-O2", "-o", built, *(s for s in sources if s.suffix == ".c"), "-lquadmath", "-lm"]
        subprocess.run(compile, check=True)
    return built


def read(stem, floors):
    lines = [line for line in Path(f"{stem}.displacements.csv").read_text().splitlines() if not line.startswith("#")]
    table = np.loadtxt(lines[1:], delimiter=",", usecols=range(1, 1 + floors), ndmin=2)
    rows = [line for line in Path(f"{stem}.impacts.csv").read_text().splitlines() if not line.startswith("#")]
    return Truth(table, len(rows) - 1)
