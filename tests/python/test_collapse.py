"""A run that a collapse ends, as importers see it: by the status functions of the standard."""

import csv

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2Discard, fmi2LastSuccessfulTime, fmi2Terminated

import harness

# Elastic-perfectly plastic, with twice its weight on it: it falls at 5.8252975576741 s (quadruple precision).
COLLAPSE = 5.8252975576741
SCENE = f"""name = "Falls"
stop_time = 20.0
[left]
mass = [100e3]
height = [3.0]
p_delta = true
gravity_load = [1961330.0]
stiffness = [6.0e6]
yield_force = [100e3]
damping = {{ ratio = 0.05 }}
[ground]
record = "{harness.RECORD}"
[[contact]]
left_floor = 1
wall = "left"
gap = 5.0
law = "linear"
stiffness = 1e8
"""
STEP = 0.01


@pytest.fixture(scope="session")
def falling(build):
    return build(SCENE)


def fall(instance, step=STEP):
    """Steps to the one that is discarded, and returns where that began."""
    k = 0
    while True:
        try:
            instance.doStep(k * step, step)
        except FMICallException as refusal:
            assert refusal.status == fmi2Discard
            return k * step
        assert not instance.getBooleanStatus(fmi2Terminated)
        k += 1


def test_fmpy_ends_at_the_collapse(falling):
    for step in (STEP, 0.5, 20.0):
        rows = falling.simulate(step)
        assert rows["time"][-1] == pytest.approx(COLLAPSE, abs=1e-10) == rows["left.collapse_time"][-1]
        assert rows["left.collapsed"][-1] and not rows["left.collapsed"][:-1].any()
        assert abs(rows["left.displacement[1]"][-1]) == pytest.approx(1.5, rel=1e-12)


def test_the_status_functions(falling):
    instance = falling.instance().start(20.0)
    begin = fall(instance)
    assert begin < COLLAPSE < begin + STEP
    for _ in range(2):
        assert instance.getBooleanStatus(fmi2Terminated)
        assert instance.getRealStatus(fmi2LastSuccessfulTime) == instance.get("left.collapse_time")[0]
        assert instance.getBoolean([falling.reference["left.collapsed"]]) == [True]
        assert "storey 1 of the left building has collapsed at 5.825297558 s" in instance.messages[-1]
        # Whatever is asked for, the run is over.
        with pytest.raises(FMICallException) as refusal:
            instance.doStep(begin + STEP, STEP)
        assert refusal.value.status == fmi2Discard
    instance.terminate()


def test_the_step_does_not_matter(falling):
    ends = []
    for step in (0.003, 0.5, 20.0):
        instance = falling.instance().start()
        fall(instance, step)
        ends.append(instance.get("left.collapse_time", "left.displacement[1]", "left.velocity[1]").tobytes())
    assert len(set(ends)) == 1


def test_states_before_and_after(falling):
    instance = falling.instance().start()
    for k in range(580):
        instance.doStep(k * STEP, STEP)
    before = instance.getFMUState()
    names = [v.valueReference for v in falling.description.modelVariables if v.causality == "output" and v.type == "Real"]
    ends = []
    for _ in range(2):
        for k in range(580, 600):
            try:
                instance.doStep(k * STEP, STEP)
            except FMICallException:
                break
        ends.append(np.array(instance.getReal(names)).tobytes())
        after = instance.getFMUState()
        instance.setFMUState(before)
        assert not instance.getBooleanStatus(fmi2Terminated)
    assert ends[0] == ends[1]
    instance.setFMUState(after)
    assert instance.getBooleanStatus(fmi2Terminated) and np.array(instance.getReal(names)).tobytes() == ends[0]
    copy = instance.deSerializeFMUstate(instance.serializeFMUstate(after))
    instance.setFMUState(before)
    instance.setFMUState(copy)
    assert instance.getBooleanStatus(fmi2Terminated) and np.array(instance.getReal(names)).tobytes() == ends[0]


def test_both_commands_say_so_and_end_well(falling, tmp_path):
    said = "collapse     storey 1 of the left building collapsed at 5.825298 s; the run ends there"
    built = harness.run(harness.CARGO_FMU, falling.scene, "-o", tmp_path / "x.fmu")
    assert said in built and "583 steps of 0.01 s" in built and "warning" not in built
    assert "a storey of the left building collapsed at 5.825298 s" in harness.run(harness.CARGO_FMU, "check", falling.path)
    page, table = tmp_path / "x.html", tmp_path / "x.csv"
    simulated = harness.run(harness.SIMULATE, falling.scene, "--csv", table, "--html", page)
    assert said in simulated and "583 steps of 0.01 s" in simulated
    rows = list(csv.DictReader(table.open()))
    assert len(rows) == 584 and float(rows[-1]["time"]) == pytest.approx(COLLAPSE, abs=1e-10)
    assert rows[-1]["left.collapsed"] == "1"
    assert "storey 1 of the left building collapsed, and the run ends there" in page.read_text()
