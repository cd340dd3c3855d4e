"""The study of the examples: its table has the same bytes whatever runs the cases, and wherever."""

import csv
import os
import re
import subprocess
import sys

import pytest

import fmus

STUDY = fmus.EXAMPLES / "study.py"
# Where the module is not used, the FMU is that of its command: neither needs cargo.
ENVIRONMENT = {**os.environ, "CARGO_FMU": f"'{sys.executable}' -m pounding_fmu"}


def study(folder, scene, *options):
    plan = ["--gaps", "0", "0.01", "--pga", "1", "4", "--synthetic", "2", "--stop", "5", "--output", folder]
    command = [sys.executable, STUDY, scene, *plan, *options]
    result = subprocess.run([*map(str, command)], env=ENVIRONMENT, capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    return (folder / "results.csv").read_text(), result.stderr


WAYS = {
    "one_thread": ["--workers", "1"],
    "three_threads": ["--workers", "3"],
    "dask": ["--scheduler", "local", "--workers", "2"],
    "fmus": ["--through", "fmus", "--workers", "1"],
    "dask_with_fmus": ["--through", "fmus", "--scheduler", "local", "--workers", "2"],
}


def test_every_way_writes_the_same_table(tmp_path):
    tables = {way: study(tmp_path / way, fmus.FEUP, *options)[0] for way, options in WAYS.items()}
    rows = list(csv.DictReader(tables["fmus"].splitlines()))
    assert len(rows) == 18 and not any(row["error"] for row in rows)
    assert sum(int(row["impacts"]) for row in rows) > 100
    for way, table in tables.items():
        assert table == tables["fmus"], way


@pytest.mark.parametrize(
    "law, pga, error",
    [
        # Contacts that no number can hold, and a record that may not be scaled so far.
        ('law = "hertz"\nstiffness = 1e300', ["--pga", "1", "9e5"], "fmi2DoStep: the motion exceeds what"),
        ('law = "linear"\nstiffness = 1e5', ["--pga", "1", "2e6"], "fmi2SetReal: ground.scale = "),
    ],
)
def test_cases_that_fail_say_the_same(tmp_path, law, pga, error):
    scene = tmp_path / "scene.toml"
    head, *contacts = fmus.feup().split("[[contact]]")
    floors = [re.findall(r"(?:left_floor|right_floor|gap) = .*\n", contact) for contact in contacts]
    scene.write_text("[[contact]]\n".join([head, *("".join([*lines, law, "\n"]) for lines in floors)]))
    ways = {way: study(tmp_path / way, scene, *WAYS[way], *pga) for way in ("three_threads", "fmus")}
    rows = list(csv.DictReader(ways["fmus"][0].splitlines()))
    failed = [row for row in rows if row["error"]]
    assert 0 < len(failed) < len(rows), rows
    assert all(row["error"].startswith(error) for row in failed), failed
    assert ways["three_threads"][0] == ways["fmus"][0]
