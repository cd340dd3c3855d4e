"""The study of the examples: a killed one goes on, and where it runs makes no difference."""

import csv
import importlib.util
import os
import shlex
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import harness

STUDY = harness.ROOT / "examples/study.py"
GAPS, PGA, RECORDS = [0.0, 0.01], [1.0, 2.0, 4.0], 4
NEVER_CLOSES = 1000.0
CASES = (len(GAPS) + 1) * len(PGA) * (RECORDS + 1)


def command(folder, *more):
    plan = ["--gaps", *GAPS, "--pga", *PGA, "--synthetic", RECORDS, "--stop", 5.0, "--output", folder]
    return [sys.executable, str(STUDY), *map(str, [*plan, *more])]


def example(name):
    """A module of the examples."""
    spec = importlib.util.spec_from_file_location(name, harness.ROOT / f"examples/{name}.py")
    module = sys.modules[name] = importlib.util.module_from_spec(spec)
    sys.path.insert(0, str(harness.ROOT / "examples"))
    try:
        spec.loader.exec_module(module)
    finally:
        sys.path.remove(str(harness.ROOT / "examples"))
    return module


ENVIRONMENT = {**os.environ, "CARGO_FMU": shlex.join(map(str, harness.CARGO_FMU))}


def study(folder, *more):
    """Runs the study and returns its table as text, and what it said."""
    result = subprocess.run(command(folder, *more), env=ENVIRONMENT, capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    return (folder / "results.csv").read_text(), result.stderr


@pytest.fixture(scope="module")
def serial(tmp_path_factory):
    return study(tmp_path_factory.mktemp("serial"), "--workers", 1)[0]


def test_its_numbers_are_those_of_the_engine(serial, feup, tmp_path):
    rows = list(csv.DictReader(serial.splitlines()))
    assert len(rows) == CASES and not any(row["error"] for row in rows)
    own = [row for row in rows if row["record"] == "el_centro_1940_ns"]
    for row in own:
        pga, gap = float(row["pga_m_s2"]), float(row["gap_m"])
        text = harness.replaced(harness.scene_with_record(), "gap = 0.005", f"gap = {gap}")
        text = harness.replaced(text, 'el_centro_1940_ns.csv"', f'el_centro_1940_ns.csv"\npga = {pga}')
        scene = tmp_path / "scene.toml"
        scene.write_text(text)
        end = harness.engine(scene, tmp_path, 5.0, stop=5.0)[-1]
        peaks = [end[f"contact[{p}].peak_force"] for p in (1, 2)]
        drifts = [end[f"right.peak_drift[{storey}]"] for storey in (1, 2, 3)]
        assert int(row["impacts"]) == end["impacts"]
        # The scale of the record is rounded once by the study and once by the engine.
        assert float(row["peak_force_n"]) == pytest.approx(max(peaks), rel=1e-10)
        assert float(row["right_drift_m"]) == pytest.approx(max(drifts), rel=1e-10)


def test_without_a_gap_everything_grows_with_the_ground_motion(serial):
    """Linear buildings, a linear law, no gap: twice the ground motion is twice the response."""
    rows = [row for row in csv.DictReader(serial.splitlines()) if float(row["gap_m"]) == 0.0]
    for record in {row["record"] for row in rows}:
        forces = [float(row["peak_force_n"]) / float(row["pga_m_s2"]) for row in rows if row["record"] == record]
        assert len(forces) == len(PGA) and forces == pytest.approx([forces[0]] * len(PGA), rel=1e-9)


def test_a_dask_cluster_and_processes_write_the_same_bytes(serial, tmp_path):
    assert study(tmp_path / "processes", "--workers", 2)[0] == serial
    assert study(tmp_path / "dask", "--scheduler", "local", "--workers", 2)[0] == serial


def test_a_killed_study_goes_on(serial, tmp_path):
    table = tmp_path / "results.csv"
    running = subprocess.Popen(command(tmp_path, "--workers", 1), env=ENVIRONMENT, stderr=subprocess.DEVNULL)
    give_up = time.monotonic() + 60
    while running.poll() is None and time.monotonic() < give_up:
        if table.exists() and table.read_bytes().count(b"\n") > 5:
            break
        time.sleep(0.001)
    running.send_signal(signal.SIGKILL if hasattr(signal, "SIGKILL") else signal.SIGTERM)
    running.wait()
    done = table.read_bytes().count(b"\n") - 1
    assert done >= 4
    if done == CASES:
        # It was faster than its killer: take back what it has done last.
        done = CASES // 2
        table.write_text("".join(table.read_text().splitlines(keepends=True)[: done + 1]))
    # As if it had been writing when it was killed.
    with table.open("a") as file:
        file.write("FeupFrames,half a r")
    text, said = study(tmp_path, "--workers", 1)
    assert f"{done} of them done" in said and f"{CASES - done} cases in" in said
    assert text == serial


def test_two_studies_do_not_write_at_once(tmp_path):
    fcntl = pytest.importorskip("fcntl")
    with (tmp_path / "results.csv").open("a") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        result = subprocess.run(command(tmp_path), env=ENVIRONMENT, capture_output=True, text=True)
    assert result.returncode == 1 and "another study" in result.stderr and "Traceback" not in result.stderr


def test_what_comes_after_a_torn_row_is_whole(tmp_path):
    """Killed while writing, gone on, killed again: only the torn row is missing."""
    results, worker = example("study_results"), example("study_worker")
    cases = [worker.Case("A", "a", "R", "r", pga, 0.01, 5.0) for pga in (1.0, 2.0, 3.0)]
    found = {"impacts": 1, "peak_force": 2.0, "impulse": 0.1, "dissipated_energy": 0.5, "left_drift": 0.01}
    row = {**found, "right_drift": 0.02, "error": ""}
    table = tmp_path / "results.csv"
    for case in cases[:2]:
        opened = results.Results(table)
        opened.add([(case, row)])
        opened.close()
        with table.open("a") as file:
            file.write("A,a,R,r,9.0,0.0")
    opened = results.Results(table)
    assert opened.missing(cases) == cases[2:] and len(opened.rows) == 2
    assert [line["pga_m_s2"] for line in opened.of(cases)] == [1.0, 2.0]
    assert opened.of(cases)[1]["peak_force_n"] == 2.0


def test_synthetic_motions_are_what_they_say(tmp_path):
    motions = example("ground_motions")
    one, other = (motions.write(tmp_path, seed).read_text() for seed in (1, 2))
    assert one.startswith("# SYNTHETIC") and one != other and one == motions.write(tmp_path / "again", 1).read_text()
    # While the envelope stays at 1 the mean power over many motions is that of the filters.
    powers = []
    for seed in range(100):
        time, motion = motions.acceleration(seed)
        still = (time >= motions.STRONG[0]) & (time < motions.STRONG[1])
        powers.append(np.abs(np.fft.rfft(motion[still] / np.std(motion[still]))) ** 2)
    frequency = np.fft.rfftfreq(still.sum(), motions.STEP)
    # Kanai and Tajimi's formula for 15.6 rad/s and 0.6; from 2 Hz on the high-pass does not matter.
    r = 2 * np.pi * frequency / 15.6
    expected = (1 + 1.44 * r**2) / ((1 - r**2) ** 2 + 1.44 * r**2)
    bands = [(2, 3), (4, 5), (8, 10), (15, 20)]
    measured, wanted = (
        [np.mean(power[(frequency >= low) & (frequency < high)]) for low, high in bands]
        for power in (np.mean(powers, axis=0), expected)
    )
    assert np.array(measured) / measured[0] == pytest.approx(np.array(wanted) / wanted[0], rel=0.15)
