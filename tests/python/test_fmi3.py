"""FMI 3.0 in FMPy: whatever the flags the bits of FMI 2.0, and every event at its own time."""

import json
import subprocess
import sys
from itertools import islice
from pathlib import Path

import fmpy.validation
import numpy as np
import pytest
from test_collapse import SCENE as FALLING

import harness

STEP, STOP = 0.02, 10.0
SCENES = {
    "feup": "examples/scenes/feup.toml",
    "offices": "examples/scenes/offices.toml",
    "yielding": "examples/scenes/yielding.toml",
    "isolated": "examples/scenes/isolated.toml",
    "columns": "tests/reference/scenes/columns_stereomechanical.toml",
    "touching": "tests/reference/scenes/touching.toml",
    "driven": "ci/scenes/two_blocks_with_inputs.toml",
}
# The scenes in which no two events share an instant, impulses without duration aside.
ONE_BY_ONE = ["feup", "offices", "yielding", "isolated", "touching"]
FLAGS = [(False, False), (False, True), (True, False), (True, True)]


@pytest.fixture(scope="module")
def both(build):
    """The FMUs of a scene in FMI 2.0 and 3.0."""

    def both(name):
        text = harness.scene_at(SCENES[name])
        return build(text), build(text, fmi=3)

    return both


class Run:
    """A run in FMPy of an FMU of FMI 3.0: its rows, and which of them come after an Event Mode."""

    def __init__(self, fmu, event_mode, early_return, **more):
        counts = [1]
        self.rows = fmu.simulate(
            STEP,
            use_event_mode=event_mode,
            early_return_allowed=early_return,
            step_finished=lambda _, recorder: counts.append(len(recorder.rows)) or True,
            **more,
        )
        counts = np.array(counts)
        self.after = counts[1:][np.diff(counts) == 2] - 1
        self.is_driven = more.get("input") is not None
        self.discrete = [v.name for v in fmu.description.modelVariables if v.variability == "discrete"]

    def at(self, times, side="right"):
        """The rows at the points of a grid: of several the last, at the start the first; all first ones for "left"."""
        which = np.searchsorted(self.rows["time"], times, side) - (side == "right")
        which[0] = 0
        assert np.array_equal(self.rows["time"][which], times)
        return self.rows[which]

    def changes(self, row):
        """The discrete outputs that are not what they were in the row before."""
        return [name for name in self.discrete if self.rows[name][row] != self.rows[name][row - 1]]

    def onsets(self, contact):
        """s, when its episodes have begun."""
        return np.repeat(self.rows["time"], np.diff(self.rows[f"contact[{contact}].impacts"], prepend=0))

    def ends(self, contact):
        """s, when it has ceased to be in contact."""
        active = self.rows[f"contact[{contact}].active"].astype(int)
        return self.rows["time"][1:][np.diff(active) < 0]


def different(rows, others, names):
    """The columns that have not the same bits."""
    return [name for name in names if rows[name].tobytes() != others[name].tobytes()]


def inputs(fmu):
    """Ground motion and forces that jump at communication points, to powers of two: what FMPy makes of them between two is
    exactly what they are there."""
    names = [v.name for v in fmu.description.modelVariables if v.causality == "input"]
    random = np.random.default_rng(7)
    times = [k * STEP for k in range(int(STOP / STEP) + 1)]
    table = np.zeros(2 * len(times) - 2, dtype=[("time", float), *((name, float) for name in names)])
    table["time"] = np.repeat(times, 2)[1:-1]
    for name in names:
        size = 1.0 if name == "ground.acceleration" else 2.0**15
        values = random.choice([-1.0, 1.0], len(times) - 1) * 2.0 ** random.integers(0, 3, len(times) - 1)
        table[name] = np.repeat(size * values, 2)
    return table


def driven_by(fmu):
    """What `simulate_fmu` is told of the inputs, where there are any."""
    return {"stop": STOP, "input": inputs(fmu) if "left.force[1]" in fmu.reference else None}


@pytest.mark.parametrize("name", SCENES)
def test_the_bits_of_fmi2_with_all_flags(both, name):
    older, newer = both(name)
    assert fmpy.validation.validate_fmu(newer.path) == []
    expected = older.simulate(STEP, **driven_by(older))
    assert older.outputs() == newer.outputs() and len(expected) == STOP / STEP + 1
    assert expected["impacts"][-1] > 3, "contacts are met"
    counts = []
    for flags in FLAGS:
        run = Run(newer, *flags, **driven_by(newer))
        # Where inputs jump, accelerations do: FMI 2.0 shows them before that, as FMI 3.0 does before Event Mode.
        before = run.at(expected["time"], "left" if run.is_driven and flags[0] else "right")
        continuous = [output for output in newer.outputs() if output not in run.discrete]
        assert different(before, expected, continuous) == [], flags
        assert different(run.at(expected["time"]), expected, run.discrete) == [], flags
        counts.append(len(run.rows))
    without, early, modes, both_flags = counts
    assert without == len(expected) < early < both_flags and without < modes < both_flags


@pytest.mark.parametrize("name", [name for name in SCENES if name != "driven"])
def test_events_are_where_the_engine_has_them(both, tmp_path, name):
    older, newer = both(name)
    run = Run(newer, True, True, stop=STOP)
    episodes, motion = tmp_path / "impacts.csv", tmp_path / "motion.csv"
    harness.run(
        harness.SIMULATE, older.scene, "--step", STOP, "--stop", STOP, "--impacts", episodes, "--csv", motion,
        "--rows-per-impact", 0,
    )  # fmt: skip
    contact, start, end, peak = np.genfromtxt(episodes, delimiter=",", skip_header=1, usecols=(0, 1, 2, 6), unpack=True)
    for which in np.unique(contact):
        assert np.array_equal(run.onsets(int(which)), start[contact == which])
        lasting = (contact == which) & (end > start)
        assert np.array_equal(run.ends(int(which)), end[lasting])
    times = run.rows["time"][run.after]
    moments = np.concatenate([start[start > 0.0], end[~np.isnan(end)]])
    # Storeys that begin to yield or turn back have rows of their own, beside those that show the shape of a contact.
    shown = np.genfromtxt(motion, delimiter=",", skip_header=1, usecols=0)
    last = np.where(np.isnan(end), STOP, end)
    jump = np.maximum(1e-4 * (last - start), 1e-9 * (1.0 + last))
    shape = np.concatenate([start - jump, start + jump, peak, last - jump, last + jump, [0.0, STOP]])
    switches = shown[~np.isin(shown, shape)]
    assert set(times) == set(moments) | set(switches)
    assert (len(switches) > 20) == (name == "yielding")
    if name in ONE_BY_ONE:
        assert len(run.after) == len(moments) + len(switches)
    early = Run(newer, False, True, stop=STOP)
    assert len(early.rows) == len(run.rows) - len(run.after)
    assert all(np.array_equal(early.onsets(int(which)), start[contact == which]) for which in np.unique(contact))


@pytest.mark.parametrize("name", SCENES)
def test_discrete_outputs_change_in_event_mode_alone(both, name):
    _, newer = both(name)
    for early_return in (False, True):
        run = Run(newer, True, early_return, **driven_by(newer))
        between = np.setdiff1d(np.arange(1, len(run.rows)), run.after)
        assert [row for row in between if run.changes(row)] == []
        # A master enters it where its inputs jump, too.
        assert name == "driven" or [row for row in run.after if not run.changes(row)] == []
        assert len(run.after) > 3


def test_a_state_at_an_event_goes_on_elsewhere(both, tmp_path):
    """Every state of a run from event to event, before and after each, in a new instance and in another process."""
    _, fmu = both("feup")
    count = 240
    instance, places, expected = fmu.instance_of_3(True, True).start(), [], []
    for time, waits in islice(instance.go_on(STEP), count):
        places.append((time, waits))
        expected.append(instance.bits().hex())
        state = instance.getFMUState()
        (tmp_path / f"{len(places) - 1}.state").write_bytes(instance.serializeFMUState(state))
        instance.freeFMUState(state)
    assert sum(waits for _, waits in places) > 30
    (tmp_path / "run.json").write_text(json.dumps([fmu.path, places, expected]))
    assert all_go_on(tmp_path, fmu) == count - 3
    program = "import sys, test_fmi3; from pathlib import Path; print(test_fmi3.all_go_on(Path(sys.argv[1])))"
    here = Path(__file__).parent
    result = subprocess.run([sys.executable, "-c", program, tmp_path], cwd=here, capture_output=True, text=True)
    assert result.stdout == f"{count - 3}\n", result.stderr


def all_go_on(folder, fmu=None):
    """Takes each state of a folder on for three steps, and returns how many did so to the bits that are expected."""
    path, places, expected = json.loads((folder / "run.json").read_text())
    fmu = fmu or harness.Fmu(path, folder / "unpacked again")
    good = 0
    for k, (time, waits) in enumerate(places[:-3]):
        instance = fmu.instance_of_3(True, True)
        state = instance.deserializeFMUState((folder / f"{k}.state").read_bytes())
        instance.setFMUState(state)
        assert instance.bits().hex() == expected[k], k
        found = [(*place, instance.bits().hex()) for place in islice(instance.go_on(STEP, time, waits), 3)]
        assert found == [(*places[k + i], expected[k + i]) for i in (1, 2, 3)], k
        good += 1
        instance.freeFMUState(state)
        instance.freeInstance()
    return good


@pytest.mark.parametrize("name", ["feup", "yielding", "columns"])
def test_events_are_read_within_steps_that_go_on(both, name):
    """The turns of an intermediate update are where steps with early returns end, and show the same there."""
    _, fmu = both(name)
    stopping, stops = fmu.instance_of_3(False, True), []
    turns = []
    wanted = [fmu.reference["left.displacement[1]"]]

    def turn(_, time, asks_for_inputs, shows_outputs, is_finished, can_return, *__):
        assert (asks_for_inputs, shows_outputs, is_finished, can_return) == (False, True, True, False)
        turns.append((time, going_on.bits()))

    going_on = fmu.instance_of_3(False, False, intermediateUpdate=turn, requiredIntermediateVariables=wanted)
    for instance in (stopping, going_on):
        instance.enterInitializationMode()
        instance.exitInitializationMode()
    for k in range(round(STOP / STEP)):
        time, end = k * STEP, (k + 1) * STEP
        assert going_on.doStep(time, end - time)[:3] == (False, False, False)
        while time < end:
            _, _, is_early, last = stopping.doStep(time, end - time)
            time = last if is_early else end
            if is_early:
                stops.append((time, stopping.bits()))
        assert going_on.bits() == stopping.bits(), time
    assert turns == stops and len(turns) > 3


def test_adjoint_derivatives_are_those_of_the_directional_ones(both):
    _, fmu = both("driven")
    knowns = [v.valueReference for v in fmu.description.modelVariables if v.causality == "input"]
    unknowns = [fmu.reference[f"{side}.acceleration[{floor}]"] for side in ("left", "right") for floor in (1, 2)]
    random = np.random.default_rng(3)
    instance, met = fmu.instance_of_3(True, True).start(), set()
    for k, (_, waits) in enumerate(islice(instance.go_on(STEP), 300)):
        if k % 10 == 0:
            # As a master does, in Step Mode: an event that waits is handled by that.
            instance.setFloat64(knowns[:1], [float(random.uniform(-4.0, 4.0))])
        met.add(waits)
        columns = [instance.getDirectionalDerivative(unknowns, [known], [1.0]) for known in knowns]
        seed = random.uniform(-1.0, 1.0, len(unknowns))
        adjoint = instance.getAdjointDerivative(unknowns, knowns, seed, nSensitivity=len(knowns))
        terms = np.array(columns) * seed
        assert np.any(terms)
        assert np.all(np.abs(adjoint - terms.sum(axis=1)) <= 1e-14 * np.abs(terms).sum(axis=1))
    assert met == {False, True}


def test_a_run_ends_at_a_collapse(build):
    older, newer = build(FALLING), build(FALLING, fmi=3)
    last = older.simulate(STEP)[-1:]
    collapse = last["time"][0]
    assert collapse % STEP > 0.0 and last["left.collapsed"][0]
    for event_mode, early_return in FLAGS:
        run = Run(newer, event_mode, early_return, stop=20.0)
        # Where a step says that the run is over, FMPy does not enter Event Mode: it sees discrete outputs all the same.
        assert different(run.rows[-1:], last, newer.outputs()) == []
        # FMPy names the end of the step that was asked for, where it has not allowed an early return.
        end = collapse if early_return else np.ceil(collapse / STEP) * STEP
        assert run.rows["time"][-1] == end
        assert not run.rows["left.collapsed"][run.rows["time"] < collapse].any()
