"""Inputs that are linear within a step, and forces on floors."""

import numpy as np
import pytest

import harness

MASS = 3.65  # kg, of every floor of the default scene


@pytest.fixture(scope="module")
def pushed(build):
    """The default scene at rest, with a force on every floor."""
    return build(harness.scene_without_record() + "\n[inputs]\nfloor_forces = true\n")


def displacements(fmu):
    return [name for name in fmu.outputs() if ".displacement[" in name]


def drive(instance, inputs, stop):
    """Steps from sample to sample of the record, each step cut once; `inputs` are (name, factor on the record)."""
    times, accelerations = harness.read_record()
    references = [instance.fmu.reference[name] for name, _ in inputs]
    factors = np.array([factor for _, factor in inputs])
    rows = []
    for k in range(round(stop / 0.02)):
        slope = (accelerations[k + 1] - accelerations[k]) / (times[k + 1] - times[k])
        instance.setReal(references, list(factors * accelerations[k]))
        instance.setRealInputDerivatives(references, [1] * len(references), list(factors * slope))
        middle = times[k] + 0.4 * (times[k + 1] - times[k])
        instance.doStep(times[k], middle - times[k])
        between = instance.getReal(references[:1])[0]
        assert between == pytest.approx(factors[0] * (accelerations[k] + slope * (middle - times[k])), abs=1e-13)
        instance.doStep(middle, times[k + 1] - middle)
        rows.append(instance.get(*displacements(instance.fmu)))
    return np.array(rows)


def assert_same(rows, feup, stop):
    run = feup.simulate(0.02, stop=stop)
    assert run["impacts"][-1] > 20
    for column, name in zip(rows.T, displacements(feup)):
        error = np.max(np.abs(column - run[name][1:])) / np.max(np.abs(run[name]))
        # The record's errors grow by 57 in the whole earthquake.
        assert error <= 1e-11, (name, error)


def test_a_linear_acceleration_is_the_record(feup, feup_input):
    rows = drive(feup_input.instance().start(), [("ground.acceleration", 1.0)], 10.0)
    assert_same(rows, feup, 10.0)


def test_linear_forces_on_all_floors_are_the_record(feup, pushed):
    inputs = [(name, -MASS) for name in pushed.reference if ".force[" in name and not name.startswith("contact")]
    assert len(inputs) == 5
    rows = drive(pushed.instance().start(), inputs, 10.0)
    assert_same(rows, feup, 10.0)


def test_a_force_is_read_back_and_moves_its_floor(pushed):
    instance = pushed.instance().start()
    instance.set({"left.force[2]": 7.3})
    assert instance.get("left.force[2]", "left.acceleration[2]") == pytest.approx([7.3, 2.0], rel=1e-14)
    of = [instance.fmu.reference[name] for name in ("left.acceleration[2]", "left.acceleration[1]")]
    by = [instance.fmu.reference["left.force[2]"]]
    assert instance.getDirectionalDerivative(of, by, [MASS]) == pytest.approx([1.0, 0.0], abs=1e-15)
