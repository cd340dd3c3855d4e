"""The guide's numbers are those that its commands give."""

import subprocess
import sys

import pytest

import harness

GUIDE = (harness.ROOT / "docs/guide.md").read_text()
SCENE = harness.replaced(
    (harness.ROOT / "examples/scenes/offices.toml").read_text(),
    '"../records/el_centro_1940_ns.csv"',
    f'"{harness.RECORD}"',
)


@pytest.fixture(scope="module")
def offices(build):
    return build(SCENE)


def test_the_gaps_are_those_that_the_guide_quotes(offices):
    command = [sys.executable, harness.ROOT / "examples/choose_gap.py", offices.path]
    printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert f"```text\n{printed}```" in GUIDE


def rows():
    """The table of contacts: stiffness, restitution, and what is written beside them."""
    lines = [line for line in GUIDE.splitlines() if line.startswith("| 2.75e")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def test_there_are_five_contacts_in_the_table():
    assert len(rows()) == 5


@pytest.mark.parametrize("row", rows(), ids=lambda row: f"{row[0]}, {row[1]}")
def test_the_table_of_contacts(offices, row):
    stiffness, restitution = map(float, row[:2])
    start = {}
    for p in (1, 2, 3):
        start |= {f"contact[{p}].stiffness": stiffness, f"contact[{p}].restitution": restitution}
    names = ["impacts", "left.peak_drift[5]", "right.peak_drift[1]", *(f"contact[{p}].peak_force" for p in (1, 2, 3))]
    stop = offices.description.defaultExperiment.stopTime
    last = offices.simulate(0.02, stop, start_values=start, output=names)[-1]
    impacts, left, right, *forces = (last[name] for name in names)
    assert row[2:] == [f"{impacts}", f"{max(forces) / 1e6:.1f} MN", f"{1e3 * left:.1f} mm", f"{1e3 * right:.1f} mm"]
