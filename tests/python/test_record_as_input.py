"""The ground acceleration as an input: held from one communication point to the next."""

import numpy as np
import pytest

import harness


def staircase(times, accelerations):
    """The same held input as a record, which is linear between samples: each jump takes one rounding of its time."""
    jumps = np.nextafter(times[1:], np.inf)
    return np.sort(np.concatenate([times, jumps])), np.repeat(accelerations, 2)[:-1]


def as_input(times, accelerations):
    table = np.zeros(len(times), dtype=[("time", float), ("ground.acceleration", float)])
    table["time"], table["ground.acceleration"] = times, accelerations
    return table


@pytest.mark.parametrize("step", [0.02, 0.01])
def test_fmpy_s_input_gives_what_the_engine_gives_for_the_held_motion(feup_input, tmp_path, step):
    times, accelerations = harness.read_record()
    run = feup_input.simulate(step, input=as_input(times, accelerations))

    # FMPy interpolates its table at each communication point and holds that value during the step.
    points = run["time"]
    held = np.interp(points, times, accelerations)
    motion = harness.write_record(tmp_path / "held.csv", *staircase(points, held))
    engine = harness.engine(feup_input.scene, tmp_path, step, record=motion)

    assert run["impacts"][-1] > 0
    assert np.array_equal(run["impacts"], engine["impacts"])
    for name in feup_input.outputs():
        if ".displacement[" in name:
            largest = np.max(np.abs(engine[name]))
            assert np.max(np.abs(run[name] - engine[name])) <= 1e-11 * largest, name


def test_a_record_given_to_the_engine_is_the_record_of_the_scene(feup, feup_input, tmp_path):
    inside = harness.engine(feup.scene, tmp_path, 0.01)
    given = harness.engine(feup_input.scene, tmp_path, 0.01, record=harness.RECORD)
    for name in inside.dtype.names:
        assert np.array_equal(inside[name], given[name]), name


def test_without_an_input_nothing_moves(feup_input):
    run = feup_input.simulate(0.1, stop=2.0)
    assert not np.any(run["left.displacement[2]"]) and not np.any(run["right.displacement[3]"])
