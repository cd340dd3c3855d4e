"""With the record inside the FMU the trajectory belongs to the scene: whatever communication step the master takes,
it reads the engine's numbers."""

import numpy as np
import pytest

import harness


@pytest.mark.parametrize("step", [0.01, 0.001, 0.037, 1 / 128, 20.0])
def test_every_output_has_the_bits_of_the_engine(feup, tmp_path, step):
    run = feup.simulate(step)
    engine = harness.engine(feup.scene, tmp_path, step)
    assert list(engine.dtype.names) == ["time", *feup.outputs()]
    assert len(run) == len(engine) == int(np.ceil(20 / step - 1e-9)) + 1
    assert run["impacts"][-1] > 0
    assert [name for name in engine.dtype.names if not np.array_equal(run[name], engine[name])] == []


def test_communication_steps_agree_where_they_meet(feup):
    fine, coarse, uneven, once = (feup.simulate(step) for step in [0.001, 0.01, 0.037, 20.0])
    meetings = [(fine[::10], coarse), (fine[::37], uneven[:-1]), (fine[-1:], once[-1:]), (fine[-1:], uneven[-1:])]
    for one, other in meetings:
        # 37 * 0.001 is not 0.037: a rounding of the time, in which a floor moves by 1e-15 m.
        assert np.allclose(one["time"], other["time"], rtol=0, atol=1e-14)
        for name in feup.outputs():
            if ".displacement[" in name:
                assert np.max(np.abs(one[name] - other[name])) <= 1e-13 * np.max(np.abs(fine[name])), name
            if name.endswith("impacts"):
                assert np.array_equal(one[name], other[name]), name
            if ".peak_" in name:
                # While a peak grows it differs as the times do.
                assert np.allclose(one[name], other[name], rtol=1e-13, atol=0), name
                assert np.all(np.diff(one[name]) >= 0) and np.all(np.diff(other[name]) >= 0), name


def test_reading_outputs_changes_nothing(feup):
    read = feup.simulate(0.01)
    unread = feup.simulate(0.01, output=["left.displacement[1]"])
    assert np.array_equal(read["left.displacement[1]"], unread["left.displacement[1]"])


def test_the_energy_account_closes(feup):
    residual = feup.simulate(0.01)["energy.residual"]
    assert np.max(np.abs(residual[500:])) < 1e-9
