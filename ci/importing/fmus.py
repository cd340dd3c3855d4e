"""The FMUs that every importer is given: the default scene in both versions, as it is and with numbers only."""

import subprocess
import sys

from releasing.places import ROOT, TARGET

SCENE = ROOT / "examples/scenes/feup.toml"

# The columns of the table, and the options behind them.
KINDS = {
    "2.0": ["--fmi", "2"],
    "3.0": ["--fmi", "3"],
    "2.0, numbers only": ["--fmi", "2", "--numbers-only"],
    "3.0, numbers only": ["--fmi", "3", "--numbers-only"],
}


def build():
    """Each by its column."""
    folder = TARGET / "importers/fmus"
    folder.mkdir(parents=True, exist_ok=True)
    built = {}
    for kind, options in KINDS.items():
        # Without blanks, which containers do not take.
        built[kind] = folder / f"{''.join(options).replace('-', '')}.fmu"
        command = ["cargo", "fmu", SCENE, *options, "-o", built[kind]]
        if subprocess.run(command, cwd=ROOT, stdout=sys.stderr).returncode != 0:
            sys.exit(f"error: {' '.join(map(str, command))}")
    return built
