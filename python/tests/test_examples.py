"""The programs in `examples/` run with the wheel, and give what they and the documents promise."""

import importlib
import os
import subprocess
import sys

import fmus
import numpy as np
import pytest

ROOT = fmus.EXAMPLES.parent


def module(name):
    sys.path.insert(0, str(fmus.EXAMPLES))
    try:
        return importlib.import_module(name)
    finally:
        sys.path.remove(str(fmus.EXAMPLES))


def orders(rows, column):
    return np.log2([one[column] / other[column] for one, other in zip(rows, rows[1:])])


def test_two_coupled_fmus_converge_to_one():
    rows = list(module("couple_two_fmus").compare([0.004, 0.002, 0.001], 4.0))
    for _, _, _, *impacts in rows:
        assert impacts[0] > 5 and impacts[1:] == impacts[:1] * 2
    assert orders(rows, 1) == pytest.approx(1.0, abs=0.1), rows
    assert orders(rows, 2) == pytest.approx(2.0, abs=0.1), rows
    assert rows[-1][2] < 2e-5, rows


def test_a_master_that_goes_back_converges_to_one_fmu():
    rows = list(module("iterate_with_rollback").compare([0.004, 0.002, 0.001]))
    for _, _, _, *impacts, tries in rows:
        assert impacts[0] > 10 and impacts[1:] == impacts[:1] * 2
        assert 2.0 < tries <= 3.0  # the secant rule, of a force that the answer depends on linearly
    assert orders(rows, 1) == pytest.approx(1.0, abs=0.1), rows
    assert orders(rows, 2) == pytest.approx(2.0, abs=0.1), rows


def test_without_going_back_the_iteration_is_wrong(monkeypatch):
    """What the master is an example of is needed: without roll-back it does not even end."""
    example = module("iterate_with_rollback")
    monkeypatch.setattr(example.FMU2Slave, "setFMUState", lambda self, state: None)
    with pytest.raises(Exception, match="fmi2DoStep"):
        list(example.compare([0.004]))


def test_a_master_that_reacts_at_each_impact_is_exact_whatever_its_step():
    rows = list(module("react_to_impacts").compare([0.01, 0.0025], 4.0))
    for _, looking, events, *impacts in rows:
        assert impacts[1] >= 8
        assert events < 1e-12 and looking > 1e-3, rows


def test_rows_with_early_return_have_every_impact_at_its_time():
    example = module("stop_at_impacts")
    _, stops = example.simulate_both(example.STOP)
    run = example.pounding_fmu.simulate(example.pounding_fmu.example_scene, stop=example.STOP)
    expected = run.impacts[run.impacts["contact"] == example.CONTACT]
    times, speeds = example.impacts(stops)
    assert len(times) > 60
    np.testing.assert_array_equal(times, expected["start_s"])
    np.testing.assert_array_equal(speeds, expected["approach_velocity"])


@pytest.mark.parametrize("program", ["one_run", "many_runs"])
def test_short_programs(program):
    done = subprocess.run([sys.executable, fmus.EXAMPLES / f"{program}.py"], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
    lines = (fmus.EXAMPLES / f"{program}.py").read_text().splitlines()
    assert done.stdout.splitlines() == [line.removeprefix("# ") for line in lines if line.startswith("# ")]


# Recordings of Kobe may not be passed on with the project: who has one names it.
KOBE = os.environ.get("KOBE_RECORD")


def test_the_pages_about_the_paper_are_what_their_command_writes(tmp_path):
    command = [sys.executable, "examples/paper/all.py", "--check", "--pictures", tmp_path]
    command += ["--kobe", KOBE] if KOBE else []
    check = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert check.returncode == 0, check.stderr
    assert list(tmp_path.glob("*.png"))
    assert "docs/paper.md: compared free impacts," in check.stdout
    assert "docs/validation.md: compared closed forms," in check.stdout
    assert ("heights under Kobe" in check.stdout) == bool(KOBE)
    assert "does not agree" not in (ROOT / "docs/validation.md").read_text()
