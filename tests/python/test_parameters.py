"""Parameters set before the run take effect; calculated ones are what the seed paper prints."""

import numpy as np
import pytest

import harness

# Seed paper, section 3.2, to the digits that its mass and stiffness give.
FREQUENCIES = {"left": [2.7774, 7.2712], "right": [2.0000, 5.6038, 8.0977]}

FEUP_TAIL = harness.FEUP[harness.FEUP.rindex("[[contact]]") :].split("[outputs]")[0]


def displacements(fmu):
    return [name for name in fmu.outputs() if ".displacement[" in name]


def test_natural_frequencies_are_the_paper_s(feup):
    instance = feup.instance().start()
    for side, expected in FREQUENCIES.items():
        found = instance.get(*(f"{side}.frequency[{i + 1}]" for i in range(len(expected))))
        assert found == pytest.approx(expected, abs=5e-5)


def test_frequencies_follow_mass_and_stiffness(feup):
    instance = feup.instance()
    masses = {f"left.mass[{i}]": 4 * 3.65 for i in (1, 2)}
    instance.start(**masses)
    assert instance.get("left.frequency[1]", "left.frequency[2]") == pytest.approx([2.7774 / 2, 7.2712 / 2], abs=5e-5)
    assert instance.get("right.frequency[1]") == pytest.approx([2.0], abs=5e-5)


# A parameter, its value, and the same in the text of the scene.
LEFT = "stiffness = [2910.0, 2910.0]\ndamping = { ratio = %s }"
CHANGES = [
    ("ground.scale", 0.5, 'el_centro_1940_ns.csv"', 'el_centro_1940_ns.csv"\nscale = 0.5'),
    ("left.mass[2]", 5.0, "mass = [3.65, 3.65]\n", "mass = [3.65, 5.0]\n"),
    ("right.stiffness[1]", 4000.0, "[2910.0, 2910.0, 2910.0]", "[4000.0, 2910.0, 2910.0]"),
    ("left.damping_ratio", 0.05, LEFT % 0.01, LEFT % 0.05),
    ("contact[1].gap", 0.002, "right_floor = 1\ngap = 0.005", "right_floor = 1\ngap = 0.002"),
    ("contact[2].stiffness", 2e5, FEUP_TAIL, FEUP_TAIL.replace("1.0e6", "2.0e5")),
    ("contact[2].restitution", 0.4, FEUP_TAIL, FEUP_TAIL.replace("0.65", "0.4")),
    ("solver.relative_tolerance", 1e-6, "[outputs]", "[solver]\nrelative_tolerance = 1e-6\n[outputs]"),
]


@pytest.mark.parametrize("name, value, old, new", CHANGES, ids=[change[0] for change in CHANGES])
def test_a_parameter_does_what_the_scene_s_key_does(feup, tmp_path, name, value, old, new):
    scene = tmp_path / "scene.toml"
    scene.write_text(harness.replaced(harness.scene_with_record(), old, new))

    run = feup.simulate(1 / 128, start_values={name: value})
    engine = harness.engine(scene, tmp_path, 1 / 128)
    plain = feup.simulate(1 / 128)
    for output in displacements(feup):
        assert np.array_equal(run[output], engine[output]), output
    assert any(not np.array_equal(run[output], plain[output]) for output in displacements(feup))


def test_another_record_can_be_named(feup, tmp_path):
    times, accelerations = harness.read_record()
    other = harness.write_record(tmp_path / "half.csv", times, accelerations / 2)
    named = feup.simulate(0.01, start_values={"ground.record": str(other)})
    scaled = feup.simulate(0.01, start_values={"ground.scale": 0.5})
    for name in displacements(feup):
        assert np.array_equal(named[name], scaled[name]), name


REFUSED = [("left.mass[1]", -1.0), ("contact[1].restitution", 1.4), ("ground.scale", float("nan"))]


@pytest.mark.parametrize("name, value", REFUSED, ids=[name for name, _ in REFUSED])
def test_a_value_out_of_range_is_refused_with_a_message(feup, name, value):
    instance = feup.instance()
    with pytest.raises(Exception, match="fmi2SetReal failed with status 3"):
        instance.set({name: value})
    assert name in instance.messages[-1]
    instance.reset()
    instance.start().steps(0.01, 10)


def test_a_fixed_parameter_is_refused_after_initialization(feup):
    instance = feup.instance().start()
    with pytest.raises(Exception, match="status 3"):
        instance.set({"left.mass[1]": 4.0})
    assert "left.mass[1]" in instance.messages[-1]
