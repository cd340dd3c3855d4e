"""Going back: states recorded and restored by an importer that is not ours, and taken on in another process."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

import harness

STEP = 1 / 256
STEPS = 640

LAWS = {
    "stereomechanical": 'law = "stereomechanical"\nrestitution = 0.1',
    "linear": 'law = "linear"\nstiffness = 1.0e5',
    "kelvin_voigt": 'law = "kelvin_voigt"\nstiffness = 1.0e5\nrestitution = 0.5',
    "kelvin_voigt_no_tension": 'law = "kelvin_voigt_no_tension"\nstiffness = 1.0e5\nrestitution = 0.5',
    "hertz": 'law = "hertz"\nstiffness = 1.0e6',
    "jankowski": 'law = "jankowski"\nstiffness = 1.0e6\nrestitution = 0.5',
    "hertz_damped": 'law = "hertz_damped"\nstiffness = 1.0e6\nrestitution = 0.5\ndamping_formula = "exact"',
}

# One run for all laws: each pair of floors has its own.
SCENE = (
    'name = "AllLaws"\n[ground]\nrecord = "RECORD"\n[outputs]\nenergy = true\n'
    + "".join(
        f"[{side}]\nmass = {[mass] * 7}\nstiffness = {[4000.0] * 7}\ndamping = {{ ratio = 0.03 }}\n"
        for side, mass in [("left", 3.0), ("right", 4.0)]
    )
    + "".join(
        f"[[contact]]\nleft_floor = {i}\nright_floor = {i}\ngap = {0.0 if i == 1 else 0.002}\n{law}\n"
        for i, law in enumerate(LAWS.values(), start=1)
    )
)


@pytest.fixture(scope="session")
def all_laws(build):
    return build(SCENE.replace("RECORD", str(harness.RECORD)))


def go_on(instance, first, count):
    """All outputs after each of so many steps, bit for bit."""
    names = [v for v in instance.fmu.description.modelVariables if v.causality == "output"]
    reals = [v.valueReference for v in names if v.type == "Real"]
    integers = [v.valueReference for v in names if v.type == "Integer"]
    rows = []
    for k in range(first, first + count):
        instance.doStep(k * STEP, STEP)
        rows.append(np.array(instance.getReal(reals) + instance.getInteger(integers), dtype=float).tobytes())
    return rows


def touching(instance):
    return {p for p in range(1, 8) if instance.getBoolean([instance.fmu.reference[f"contact[{p}].active"]])[0]}


def test_the_description_declares_it(all_laws):
    declared = all_laws.description.coSimulation
    assert declared.canGetAndSetFMUstate and declared.canSerializeFMUstate


def test_going_back_gives_the_same_bits_and_messages(all_laws):
    plain = all_laws.instance().start()
    expected = go_on(plain, 0, STEPS)

    instance = all_laws.instance().start()
    states, seen, logged = [], set(), []
    for k in range(STEPS):
        states.append(instance.getFMUState())
        logged.append(len(instance.messages))
        assert go_on(instance, k, 1) == expected[k : k + 1], f"saving has changed point {k}"
        seen |= touching(instance)
    messages = list(instance.messages)
    assert messages == plain.messages and seen == set(range(1, 8)), "every law has been met in mid-contact"

    for k in range(STEPS - 3, 0, -5):
        instance.setFMUState(states[k])
        del instance.messages[:]
        assert go_on(instance, k, 3) == expected[k : k + 3], f"from point {k}"
        end = logged[k + 3] if k + 3 < STEPS else None
        assert instance.messages == messages[logged[k] : end], f"from point {k}"
    for state in states:
        instance.freeFMUState(state)
        assert state.value is None


def test_another_process_goes_on_to_the_same_bits(all_laws, tmp_path):
    start = {"ground.scale": 1.25}
    rows = go_on(all_laws.instance().start(**start), 0, STEPS)
    instance, points = all_laws.instance().start(**start), []
    for k in range(STEPS - 3):
        if touching(instance):
            points.append(k)
            (tmp_path / f"{k}.state").write_bytes(instance.serializeFMUState(instance.getFMUState()))
        go_on(instance, k, 1)
    assert len(points) > 100
    (tmp_path / "expected.json").write_text(json.dumps([row.hex() for row in rows]))

    program = f"""
import json
from pathlib import Path
import harness, test_state
folder = Path({str(tmp_path)!r})
expected = json.loads((folder / "expected.json").read_text())
instance = harness.Fmu({all_laws.path!r}, folder / "unpacked again").instance()
for k in {points}:
    state = instance.deserializeFMUState((folder / f"{{k}}.state").read_bytes())
    instance.setFMUState(state)
    rows = [row.hex() for row in test_state.go_on(instance, k, 3)]
    assert rows == expected[k : k + 3], k
    instance.freeFMUState(state)
print("the same")
"""
    here = Path(__file__).parent
    result = subprocess.run([sys.executable, "-c", program], cwd=here, capture_output=True, text=True)
    assert result.stdout == "the same\n", result.stderr


def test_going_back_with_the_ground_as_an_input_and_after_an_error(feup_input):
    times, accelerations = harness.read_record()

    def drive(instance, first, count):
        rows = []
        for k in range(first, first + count):
            instance.set({"ground.acceleration": float(np.interp(k * STEP, times, accelerations))})
            rows += go_on(instance, k, 1)
        return rows

    instance = feup_input.instance().start()
    states, expected, active = [], [], 0
    for k in range(STEPS):
        states.append(instance.getFMUState())
        expected += drive(instance, k, 1)
        active += any(instance.getBoolean([instance.fmu.reference[f"contact[{p}].active"] for p in (1, 2)]))
    assert active > 10
    for k in range(STEPS - 3, 0, -7):
        with pytest.raises(FMICallException):
            instance.doStep(1e3, STEP)
        instance.setFMUState(states[k])
        assert drive(instance, k, 3) == expected[k : k + 3], k
    instance.reset()
    instance.setFMUState(states[100])
    assert drive(instance, 100, 50) == expected[100:150]


def test_damaged_and_foreign_states_are_refused(all_laws, feup):
    instance = all_laws.instance().start()
    go_on(instance, 0, 100)
    good = instance.serializeFMUState(instance.getFMUState())
    random = np.random.default_rng(1)
    bad = [good[:n] for n in random.integers(0, len(good), 200)]
    bad += [good + random.bytes(n) for n in range(1, 100)]
    for place in random.integers(0, len(good), 2000):
        altered = bytearray(good)
        altered[place] ^= int(random.integers(1, 256))
        bad.append(bytes(altered))
    for data in bad:
        del instance.messages[:]
        with pytest.raises(FMICallException):
            instance.deserializeFMUState(data)
        assert len(instance.messages) == 1 and "serializedState" in instance.messages[0]
    other = feup.instance().start()
    with pytest.raises(FMICallException):
        other.deserializeFMUState(good)
    assert all_laws.description.guid in other.messages[-1]
    instance.setFMUState(instance.deserializeFMUState(good))
    go_on(instance, 100, 1)
