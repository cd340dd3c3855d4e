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


def test_a_building_of_another_program_converges_to_one_fmu():
    """The table of docs/coupling.md: how, step, error, impacts and largest base shear inside and coupled."""
    example = module("couple_opensees")
    rows = list(example.compare(example.Storeys))
    for how, order in [("held", 1.0), ("line", 2.0), ("twice", 2.0)]:
        errors = [error for way, _, error, *_ in rows if way == how]
        assert np.log2(errors[0] / errors[-1]) / 3 == pytest.approx(order, abs=0.2), errors
        *_, (impacts, (exact, found)) = [both for way, _, _, *both in rows if way == how]
        assert impacts == [17, 17]
        assert found == pytest.approx(exact, rel={"held": 2e-2, "line": 2e-4, "twice": 2e-4}[how])


def test_masters_of_fmi_2_and_3_do_what_couple_does():
    example = module("couple_opensees")
    couple, whole, errors = example.pounding_fmu.couple, example.inside(0.005, 6.0), []
    for how in ("line", "twice"):
        run = couple(example.scene(), example.Storeys(), step=0.005, how=how, stop=6.0)
        errors.append(example.error(example.left_floors(run), whole))
    by_states = next(module("couple_with_saved_states").compare())
    assert by_states[1:] == pytest.approx(errors, rel=1e-6)
    by_turns = next(module("couple_with_intermediate_update").compare())
    assert by_turns[2] == pytest.approx(errors[0], rel=1e-6)


def test_storeys_that_degrade_are_no_stiffer_than_at_first_and_stay_below_their_envelope(tmp_path):
    example = module("couple_degrading")
    degrading, bilinear = example.runs()
    assert np.abs(degrading["left.storey_shear[1]"]).max() < 1.1 * np.abs(bilinear["left.storey_shear[1]"]).max()
    assert degrading["left.peak_drift[1]"][-1] > 1.3 * bilinear["left.peak_drift[1]"][-1]
    # By hand: out to six yield drifts, back, and out again.
    storey = example.Storey(2.0, 1.0)
    assert storey.move(0.25) == 0.5 and storey.move(0.5) == pytest.approx(1.0)
    assert storey.move(3.0) == pytest.approx(1.0 + 0.05 * 2.0 * 1.5 - 0.05 * 2.0 * 1.0)
    top = storey.shear
    assert storey.move(2.9) == pytest.approx(top - 0.2)
    assert storey.move(-0.1) == pytest.approx(-1.0 * (3.0 - top / 2.0 + 0.1) / (3.0 - top / 2.0 + 0.5))
    example.draw(degrading, bilinear, tmp_path / "degrading.png")
    assert (tmp_path / "degrading.png").stat().st_size > 20_000


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
