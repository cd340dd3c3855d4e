"""Many runs at once: the bits of single runs in any order on any number of threads, and what can go wrong."""

import os
import pickle
import re
import signal
import subprocess
import sys
import threading
import time
import warnings

import fmus
import numpy as np
import pounding_fmu
import pytest
from pounding_fmu import simulate_batch

FEUP = fmus.FEUP
OUTPUTS = [
    "impacts",
    "contact[2].peak_force",
    "contact[1].active",
    "left.frequency[1]",
    "contact[1].gap",
    "left.peak_drift[1]",
]
GAPS = np.linspace(0.002, 0.05, 12)
MASSES = np.linspace(3, 4, 12)


def single(**more):
    """The last rows of single runs, one for each gap."""
    rows = []
    for gap, mass in zip(GAPS, MASSES):
        parameters = {"contact[1].gap": gap, "contact[2].gap": 0.004, "left.mass[1]": mass}
        result = pounding_fmu.simulate(FEUP, outputs=OUTPUTS, parameters=parameters, **more)
        rows.append([result[name][-1] for name in OUTPUTS])
    return np.array(rows, dtype=np.float64)


@pytest.mark.parametrize("threads", [None, 1, 3, 100])
@pytest.mark.parametrize("step", [None, 0.01, 0.37, 1e12])
def test_bits_and_order_are_those_of_single_runs(threads, step):
    parameters = {"contact[1].gap": GAPS, "contact[2].gap": 0.004, "left.mass[1]": list(MASSES)}
    batch = simulate_batch(FEUP, parameters, OUTPUTS, threads=threads, step=step)
    assert batch.shape == (12, 6) and batch.dtype == np.float64
    assert fmus.same_bits(batch, single())
    assert len({tuple(row) for row in batch}) == 12


def test_the_fmu_over_one_step_has_these_bits(build):
    batch = simulate_batch(FEUP, {"contact[1].gap": GAPS[:3]}, OUTPUTS)
    for gap, row in zip(GAPS, batch):
        end = build(FEUP).run([0.0, 20.0], {"contact[1].gap": float(gap)})
        assert fmus.same_bits(row, [end[name][-1] for name in OUTPUTS])


def test_without_a_record_the_steps_are_those_of_the_fmu(build):
    scene = fmus.without_record().replace(
        "damping = { ratio = 0.01 }", "damping = { ratio = 0.01 }\ninitial_velocity = [0.5, 0.1]", 1
    )
    times = [k * 0.25 for k in range(21)]
    end = build(scene).run(times)
    batch = simulate_batch(scene, {}, OUTPUTS, step=0.25, stop=5.0)
    assert fmus.same_bits(batch, [[end[name][-1] for name in OUTPUTS]])


def pulses(folder, count):
    """Record files, and what is in them."""
    made = []
    for k in range(count):
        times = np.linspace(0, 2 + k, 41)
        accelerations = (2 + k) * np.sin(3 * times)
        file = folder / f"pulse {k}.csv"
        rows = "".join(f"{t!r},{a!r}\n" for t, a in zip(times.tolist(), accelerations.tolist()))
        file.write_text("time_s,accel_m_s2\n" + rows)
        made.append((file, (times, accelerations)))
    return made


def test_records(tmp_path):
    (one, one_arrays), (other, other_arrays) = pulses(tmp_path, 2)
    scene = fmus.feup("stop_time = 20.0")
    ends = []
    for record in (one, other, one, None):
        result = pounding_fmu.simulate(scene, record=record, outputs=OUTPUTS)
        ends.append([result[name][-1] for name in OUTPUTS])
    for records in (
        [one, str(other), one, None],
        [one_arrays, other_arrays, one_arrays, None],
        [one, other_arrays, [list(column) for column in one_arrays], ""],
        (one, other, one_arrays, fmus.RECORD),
        # Rows of an array are objects that are gone when the next ones are made.
        [np.array(one_arrays), np.array(other_arrays), np.array(one_arrays), None],
        (record for record in (one, other, one, None)),
    ):
        assert fmus.same_bits(simulate_batch(scene, {}, OUTPUTS, records=records), ends)
    assert fmus.same_bits(simulate_batch(scene, {"ground.record": [one, other, one, ""]}, OUTPUTS), ends)
    for one_for_all in (one, str(one), one_arrays, np.array(one_arrays)):
        batch = simulate_batch(scene, {"ground.scale": np.ones(2)}, OUTPUTS, records=one_for_all)
        assert fmus.same_bits(batch, [ends[0]] * 2)
    assert fmus.same_bits(simulate_batch(scene, {"ground.record": one}, OUTPUTS), ends[:1])
    many = pulses(tmp_path, 6)
    of_files = simulate_batch(scene, {}, OUTPUTS, records=[file for file, _ in many])
    assert fmus.same_bits(simulate_batch(scene, {}, OUTPUTS, records=np.array([arrays for _, arrays in many])), of_files)
    assert fmus.same_bits(simulate_batch(scene, {}, OUTPUTS, records=iter([file for file, _ in many[:2]])), of_files[:2])
    assert fmus.same_bits(simulate_batch(scene, {"ground.record": map(str, [one, other])}, OUTPUTS), ends[:2])
    # A scene without a record gets them as its own.
    bare = fmus.without_record().replace("stop_time = 20.0", "")
    assert fmus.same_bits(simulate_batch(bare, {}, OUTPUTS, records=[one, other_arrays]), ends[:2])
    with pytest.raises(ValueError, match="records: the scene has no record of its own: expected one for each case"):
        simulate_batch(bare, {}, OUTPUTS, records=[one, None])


def test_a_changed_file_is_read_again(tmp_path):
    ((file, _), (other, _)) = pulses(tmp_path, 2)
    before = simulate_batch(FEUP, {}, ["left.peak_displacement[1]"], records=file)
    file.write_bytes(other.read_bytes())
    after = simulate_batch(FEUP, {}, ["left.peak_displacement[1]"], records=file)
    assert after != before and after == simulate_batch(FEUP, {}, ["left.peak_displacement[1]"], records=[other])


def test_shapes():
    assert simulate_batch(FEUP, {}, ["impacts"], stop=1).shape == (1, 1)
    assert simulate_batch(FEUP, {"contact[1].gap": 0.1}, [], stop=1).shape == (1, 0)
    assert simulate_batch(FEUP, {"contact[1].gap": []}, ["impacts"]).shape == (0, 1)
    assert simulate_batch(FEUP, {}, ["impacts", "impacts"], records=[]).shape == (0, 2)
    masses = np.array([1, 2], dtype=np.int8)
    assert simulate_batch(FEUP, {"left.mass[1]": masses}, ["left.mass[1]"], stop=1).tolist() == [[1], [2]]


@pytest.mark.filterwarnings("ignore::pounding_fmu.SceneWarning")
@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        (
            {"parameters": {"contact[1].gap": [1, 2], "left.mass[1]": [1, 2, 3]}},
            ValueError,
            "arrays of different lengths: contact[1].gap has 2, left.mass[1] has 3",
        ),
        (
            {"parameters": {"contact[1].gap": [1, 2]}, "records": [fmus.RECORD]},
            ValueError,
            "contact[1].gap has 2, records has 1",
        ),
        (
            {"parameters": {"contact[1].gp": [1], "x": 2}, "outputs": ["y"]},
            KeyError,
            "contact[1].gp: the scene has no such variable; did you mean contact[1].gap?; x: the scene has no such "
            "variable; y: the",
        ),
        (
            {"parameters": {"left.mass[1]": [1, -2, np.nan]}},
            ValueError,
            "case 1: left.mass[1] = -2.0: expected a finite mass > 0 kg\n"
            "case 2: left.mass[1] = nan: expected a finite mass > 0 kg",
        ),
        (
            {"parameters": {"left.mass[1]": -np.arange(30)}},
            ValueError,
            "case 19: left.mass[1] = -19.0: expected a finite mass > 0 kg\nand 10 more",
        ),
        (
            {"parameters": {"left.mass[1]": ["a", "b"], "contact[1].gap": [[1]]}},
            ValueError,
            "left.mass[1] = ['a', 'b']: expected a number, or an array of numbers with one dimension\n"
            "contact[1].gap = [[1]]: expected",
        ),
        ({"parameters": {"left.mass[1]": [1, None]}}, ValueError, "left.mass[1] = [1, None]: expected a number"),
        ({"parameters": {"left.mass[1]": [1j]}}, ValueError, "left.mass[1] = [1j]: expected a number"),
        ({"parameters": {"impacts": [1]}}, ValueError, "impacts is computed and cannot be set"),
        (
            {"parameters": {"ground.scale": [1, 1e9]}},
            ValueError,
            "case 1: ground.scale = 1000000000.0: expected accelerations up to",
        ),
        ({"outputs": "impacts"}, TypeError, "outputs = 'impacts': expected a list of names"),
        ({"outputs": ["ground.record"]}, ValueError, "ground.record is a text"),
        ({"threads": 0}, ValueError, "threads = 0: expected a whole number > 0"),
        ({"threads": 1.5}, ValueError, "threads = 1.5: expected a whole number > 0"),
        ({"parameters": [1]}, TypeError, "parameters = [1]: expected a dict by names of parameters"),
        ({"stop": 1e300}, ValueError, "stop = 1e+300: expected a number of seconds > 0 and at most 1e+12"),
        ({"step": -1}, ValueError, "step = -1: expected a number of seconds > 0"),
        ({"progress": 3}, TypeError, "progress = 3: expected a function"),
        ({"records": 3}, TypeError, "records = 3: expected a record, or a list of records"),
        ({"records": "missing.csv"}, FileNotFoundError, "missing.csv"),
        (
            {"records": [fmus.RECORD, "missing.csv", ([0, 0], [1, 1]), 5]},
            ValueError,
            "records[1] = 'missing.csv': expected a record file, but No such file or directory\n"
            "records[2]: time 0 s: expected more than the time before it, 0 s\n"
            "records[3]: expected a path or a pair of arrays",
        ),
        (
            {"records": fmus.RECORD, "parameters": {"ground.record": "a"}},
            ValueError,
            "ground.record and records: expected one of them",
        ),
    ],
)
def test_arguments_that_cannot_be(arguments, error, message):
    arguments = {"parameters": {}, "outputs": ["impacts"]} | arguments
    with pytest.raises(error, match=re.escape(message)):
        simulate_batch(FEUP, **arguments)


def test_a_record_that_the_scene_cannot_scale():
    scene = fmus.feup("[ground]\n", "[ground]\npga = 3.0\n")
    flat = (np.linspace(0, 1, 5), np.zeros(5))
    with pytest.raises(ValueError, match=r"records\[1\]: ground.record = .*: expected a record with a peak"):
        simulate_batch(scene, {}, ["impacts"], records=[fmus.RECORD, flat])


def test_slips_are_told_once():
    def caught(parameters):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            simulate_batch(FEUP, parameters, ["impacts"], stop=1)
        assert all(warning.filename == __file__ for warning in caught)
        return [str(warning.message) for warning in caught]

    assert caught({"contact[1].gap": GAPS}) == []
    (text,) = caught({"contact[1].gap": [0.01, 5.0, 0.01, 6.0]})
    assert text.startswith("contact[1].gap = 5.0: ") and text.endswith(" (case 1 and 1 more)")
    (text,) = caught({"contact[1].gap": [0.01, 5.0]})
    assert text.endswith(" (case 1)")
    (text,) = caught({"contact[1].gap": [5.0, 6.0]})
    assert text.startswith("contact[1].gap = 5.0: ") and "case" not in text


ENDLESS = {
    "name": "Endless",
    "left": {"mass": [1e3], "stiffness": [1e6], "damping": {"ratio": 0.0}, "initial_velocity": [1.0]},
    "right": {"mass": [1e3], "stiffness": [2e6], "damping": {"ratio": 0.0}},
    "contact": [{"left_floor": 1, "right_floor": 1, "gap": 0.0, "law": "linear", "stiffness": 1e9}],
}


@pytest.mark.filterwarnings("ignore::pounding_fmu.SceneWarning")
def test_a_case_that_cannot_go_on_loses_no_other():
    # Undamped floors meet for ever: more work than one communication step may be, but where the gap keeps them apart.
    gaps = [1.0, 0.0, 2.0]
    with pytest.raises(pounding_fmu.BatchError) as caught:
        simulate_batch(ENDLESS, {"contact[1].gap": gaps}, ["impacts", "contact[1].gap"], stop=1e7)
    error = caught.value
    assert list(error.failures) == [1] and "smaller communication steps" in error.failures[1]
    assert fmus.same_bits(error.results[[0, 2]], [[0, 1], [0, 2]]) and np.isnan(error.results[1]).all()
    assert str(error).startswith("1 of 3 cases could not be run") and "case 1: " in str(error)
    assert isinstance(error, RuntimeError) and str(pickle.loads(pickle.dumps(error))) == str(error)
    with pytest.raises(RuntimeError, match="smaller communication steps"):
        pounding_fmu.simulate(ENDLESS, step=1e7, stop=1e7)


def test_progress():
    seen = []
    simulate_batch(
        FEUP,
        {"contact[1].gap": np.full(1000, 0.005)},
        ["impacts"],
        threads=1,  # for long enough on any machine
        progress=lambda *done: seen.append((threading.get_ident(), *done)),
    )
    assert seen[-1][1:] == (1000, 1000) and len(seen) > 1
    assert seen == sorted(seen) and {who for who, *_ in seen} == {threading.get_ident()}

    class Enough(Exception):
        pass

    def stop(done, count):
        raise Enough

    began = time.monotonic()
    with pytest.raises(Enough):
        simulate_batch(FEUP, {"contact[1].gap": np.full(100_000, 0.005)}, ["impacts"], stop=200, progress=stop)
    assert time.monotonic() - began < 60


def test_other_threads_go_on():
    ticks, over = [], threading.Event()

    def tick():
        while not over.wait(0.01):
            ticks.append(time.monotonic())

    thread = threading.Thread(target=tick)
    thread.start()
    began = time.monotonic()
    simulate_batch(FEUP, {"contact[1].gap": np.full(1000, 0.005)}, ["impacts"], threads=1)
    pounding_fmu.simulate(FEUP, step=1e-4, outputs=["impacts"])
    ended = time.monotonic()
    over.set()
    thread.join()
    inside = [moment for moment in ticks if began < moment < ended]
    assert len(inside) >= 10, (len(inside), ended - began)


@pytest.mark.skipif(os.name == "nt", reason="no SIGINT for another process")
@pytest.mark.parametrize(
    "call",
    [
        "p.simulate_batch(p.example_scene, {'contact[1].gap': np.full(10**6, 0.005)}, ['impacts'])",
        "p.simulate(p.example_scene, stop=1e4, step=1e-5, outputs=[])",
    ],
)
def test_ctrl_c(call):
    # A background job of a shell ignores SIGINT, and so would Python.
    heed = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)"
    code = f"{heed}; import numpy as np, pounding_fmu as p; print('go', flush=True); {call}"
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "go\n"
    time.sleep(1.5)
    assert process.poll() is None
    process.send_signal(signal.SIGINT)
    try:
        _, errors = process.communicate(timeout=10)
    finally:
        process.kill()
    assert errors.rstrip().endswith("KeyboardInterrupt") and process.returncode == -signal.SIGINT
