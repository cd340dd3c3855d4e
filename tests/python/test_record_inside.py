"""With the record inside the FMU the trajectory belongs to the scene: whatever communication step the master takes,
it reads the engine's numbers."""

import numpy as np
import pytest

import harness

# 1/128 s is a binary fraction, so every communication point is exact in the master and in the engine.
EXACT_STEP = 1 / 128


def same(names, ours, theirs):
    return {name: (ours[name], theirs[name]) for name in names if not np.array_equal(ours[name], theirs[name])}


def test_every_output_has_the_bits_of_the_engine(feup, tmp_path):
    run = feup.simulate(EXACT_STEP)
    engine = harness.engine(feup.scene, tmp_path, EXACT_STEP)
    assert list(engine.dtype.names) == ["time", *feup.outputs()]
    assert len(run) == len(engine) == 20 * 128 + 1
    assert run["impacts"][-1] > 0
    assert same(engine.dtype.names, run, engine) == {}


@pytest.mark.parametrize("step", [0.01, 0.001, 0.037, 20.0])
def test_any_communication_step_reads_the_same_trajectory(feup, tmp_path, step):
    run = feup.simulate(step)
    engine = harness.engine(feup.scene, tmp_path, step)
    assert len(run) == len(engine)
    # The master's k * step and t + h differ by a rounding of t, in which a floor moves by 1e-15 m.
    assert np.allclose(run["time"], engine["time"], rtol=0, atol=1e-14)
    for name in feup.outputs():
        if ".displacement[" in name or ".peak_drift[" in name:
            largest = np.max(np.abs(engine[name]))
            assert np.max(np.abs(run[name] - engine[name])) <= 1e-13 * largest, name
    for name in ["impacts", "contact[1].impacts", "contact[2].impacts"]:
        assert np.array_equal(run[name], engine[name]), name


def test_communication_steps_agree_where_they_meet(feup):
    fine, coarse, once = (feup.simulate(step) for step in [0.001, 0.01, 20.0])
    for name in feup.outputs():
        largest = np.max(np.abs(fine[name]))
        if ".displacement[" in name:
            assert np.max(np.abs(fine[name][::10] - coarse[name])) <= 1e-13 * largest, name
            assert abs(fine[name][-1] - once[name][-1]) <= 1e-13 * largest, name
        if ".peak_drift[" in name or name.endswith("impacts") or name.endswith("peak_force"):
            assert fine[name][-1] == coarse[name][-1] == once[name][-1], name


def test_reading_outputs_changes_nothing(feup):
    read = feup.simulate(0.01)
    unread = feup.simulate(0.01, output=["left.displacement[1]"])
    assert np.array_equal(read["left.displacement[1]"], unread["left.displacement[1]"])


def test_the_energy_account_closes(feup):
    residual = feup.simulate(0.01)["energy.residual"]
    assert np.max(np.abs(residual[500:])) < 1e-9
