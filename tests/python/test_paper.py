"""docs/paper.md and docs/validation.md say what the engine's runs give, to the printed digits."""

import os
import subprocess
import sys

import pytest

import harness

# Recordings of Kobe may not be passed on with the project: who has one names it.
KOBE = os.environ.get("KOBE_RECORD")


@pytest.fixture(scope="module")
def check():
    """The command that writes both pages, asked to compare them with new runs."""
    command = [sys.executable, "examples/paper/all.py", "--check", *(["--kobe", KOBE] if KOBE else [])]
    variables = {**os.environ, "PYTHONPATH": str(harness.ROOT / "examples")}
    return subprocess.run(command, cwd=harness.ROOT, env=variables, capture_output=True, text=True)


def test_the_pages_are_what_their_command_writes(check):
    assert check.returncode == 0, check.stderr
    assert "docs/paper.md: compared free impacts," in check.stdout
    assert "docs/validation.md: compared closed forms," in check.stdout


def test_the_numbers_of_kobe_are_among_them(check):
    if not KOBE:
        pytest.skip("no record of Kobe here: the numbers under Kobe were not compared; KOBE_RECORD=FILE names one")
    assert "heights under Kobe" in check.stdout


def test_closed_forms_and_published_frequencies_agree():
    assert "does not agree" not in (harness.ROOT / "docs/validation.md").read_text()
