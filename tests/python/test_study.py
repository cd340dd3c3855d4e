"""The study of the examples: a killed one goes on, and where it runs makes no difference."""

import csv
import math
import os
import shlex
import signal
import subprocess
import sys
import time

import numpy as np
import pyarrow.parquet
import pytest

import harness

STUDY = harness.ROOT / "examples/study.py"
GAPS, PGA, RECORDS = [0.0, 0.01], [1.0, 2.0, 4.0], 4
NEVER_CLOSES = 1000.0
CASES = (len(GAPS) + 1) * len(PGA) * (RECORDS + 1)


def command(folder, *more):
    plan = ["--gaps", *GAPS, "--pga", *PGA, "--synthetic", RECORDS, "--stop", 5.0, "--output", folder]
    return [sys.executable, str(STUDY), *map(str, [*plan, *more])]


ENVIRONMENT = {**os.environ, "CARGO_FMU": shlex.join(map(str, harness.CARGO_FMU))}


def study(folder, *more):
    """Runs the study and returns its table as text, and what it said."""
    result = subprocess.run(command(folder, *more), env=ENVIRONMENT, capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    return (folder / "results.csv").read_text(), result.stderr


@pytest.fixture(scope="module")
def serial(tmp_path_factory):
    return study(tmp_path_factory.mktemp("serial"), "--workers", 1)[0]


def engine_end(gap, pga, folder):
    """The engine's own values at the end of such a case."""
    text = harness.replaced(harness.scene_with_record(), "gap = 0.005", f"gap = {gap}")
    text = harness.replaced(text, 'el_centro_1940_ns.csv"', f'el_centro_1940_ns.csv"\npga = {pga}')
    scene = folder / "scene.toml"
    scene.write_text(text)
    return harness.engine(scene, folder, 5.0, stop=5.0)[-1]


STOREYS = {"left": 2, "right": 3}


def test_its_numbers_are_those_of_the_engine(serial, feup, tmp_path):
    rows = list(csv.DictReader(serial.splitlines()))
    assert len(rows) == CASES and not any(row["error"] for row in rows)
    own = [row for row in rows if row["record"] == "el_centro_1940_ns"]
    for row in own:
        pga, gap = float(row["pga_m_s2"]), float(row["gap_m"])
        end, alone = engine_end(gap, pga, tmp_path), engine_end(NEVER_CLOSES, pga, tmp_path)
        assert int(row["impacts"]) == end["impacts"]
        # The scale of the record is rounded once by the study and once by the engine.
        assert float(row["peak_force_n"]) == pytest.approx(max(end[f"contact[{p}].peak_force"] for p in (1, 2)), rel=1e-10)
        for side, storeys in STOREYS.items():
            assert float(row[f"{side}_base_shear_n"]) == pytest.approx(end[f"{side}.peak_base_shear"], rel=1e-10)
            for what, column in [("drift", "drift_m"), ("acceleration", "acceleration_m_s2")]:
                names = [f"{side}.peak_{what}[{i}]" for i in range(1, storeys + 1)]
                peaks = [float(row[f"{side}_{column}[{i}]"]) for i in range(1, storeys + 1)]
                assert peaks == pytest.approx([end[name] for name in names], rel=1e-10)
                assert float(row[f"{side}_{column}"]) == max(peaks)
                ratio = max(end[name] / alone[name] for name in names)
                assert float(row[f"{side}_{what}_ratio"]) == pytest.approx(ratio, rel=1e-9)


def test_a_ratio_is_that_of_a_storey_and_not_of_the_largest_ones(serial):
    """Where a storey that drifts little alone drifts much with contact the two are not the same."""
    rows = list(csv.DictReader(serial.splitlines()))
    free = {(row["record"], row["pga_m_s2"]): row for row in rows if float(row["gap_m"]) == NEVER_CLOSES}
    differ = 0
    for row in rows:
        of_maxima = float(row["right_drift_m"]) / float(free[row["record"], row["pga_m_s2"]]["right_drift_m"])
        assert float(row["right_drift_ratio"]) >= of_maxima
        differ += float(row["right_drift_ratio"]) > 1.2 * of_maxima
    assert differ > len(rows) / 4


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


def interrupted(command, begun):
    """Starts a program, presses Ctrl-C once it has begun, and returns its exit code and what it said."""
    running = subprocess.Popen(
        list(map(str, command)),
        env=ENVIRONMENT,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        # A shell that has started the tests in the background has it ignored.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    give_up = time.monotonic() + 60
    while running.poll() is None and not begun() and time.monotonic() < give_up:
        time.sleep(0.001)
    # As a terminal does: to the program and all that it has started.
    os.killpg(running.pid, signal.SIGINT)
    said = running.communicate(timeout=60)[1]
    return running.returncode, said


@pytest.mark.skipif(not hasattr(os, "killpg"), reason="no process groups here")
@pytest.mark.parametrize("where", [["--workers", 1], ["--workers", 2], ["--workers", 2, "--scheduler", "local"]], ids=str)
def test_ctrl_c_ends_without_a_traceback(tmp_path, where):
    table = tmp_path / "results.csv"
    long = [*command(tmp_path, *where), "--synthetic", "60", "--stop", "30"]
    code, said = interrupted(long, lambda: table.exists() and table.read_bytes().count(b"\n") > 5)
    assert code == 130 and "goes on from here" in said
    assert "Traceback" not in said and "Error" not in said, said
    done = table.read_bytes().count(b"\n") - 1
    result = subprocess.run([*long, "--synthetic", "0"], env=ENVIRONMENT, capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    assert table.read_bytes().count(b"\n") - 1 >= done


@pytest.mark.skipif(not hasattr(os, "killpg"), reason="no process groups here")
def test_ctrl_c_while_workers_begin(tmp_path):
    table = tmp_path / "results.csv"
    # They have been started, and load their libraries: for tenths of a second.
    begun = lambda: table.exists() and time.time() - table.stat().st_mtime > 0.15  # noqa: E731
    code, said = interrupted(command(tmp_path, "--workers", 4), begun)
    assert code == 130 and "Traceback" not in said, said


@pytest.mark.skipif(not hasattr(os, "killpg"), reason="no process groups here")
def test_ctrl_c_before_there_is_anything_to_do(tmp_path):
    code, said = interrupted(command(tmp_path), lambda: True)
    assert code in (130, -signal.SIGINT) and "Traceback" not in said, said
    code, said = interrupted(command(tmp_path), (tmp_path / "records").exists)
    assert code == 130 and "Traceback" not in said, said


@pytest.mark.skipif(not hasattr(os, "killpg"), reason="no process groups here")
def test_ctrl_c_is_left_to_the_program_that_run_py_runs(tmp_path):
    program, begun = tmp_path / "program.py", tmp_path / "begun"
    program.write_text(
        "import pathlib, sys, time\ntry:\n"
        f"    pathlib.Path({str(begun)!r}).touch()\n    time.sleep(60)\n"
        "except KeyboardInterrupt:\n    time.sleep(1)\n    sys.exit(17)\n"
    )
    (tmp_path / "requirements.txt").touch()
    driver = tmp_path / "driver.py"
    driver.write_text(
        f"import sys\nsys.path.insert(0, {str(harness.ROOT / 'examples')!r})\nimport run\n"
        "run.Environment.prepare = lambda self: None\nwanted = run.Environment.__init__\n"
        "def here(self, folder):\n    wanted(self, folder)\n    self.python = sys.executable\n"
        f"run.Environment.__init__ = here\nsys.argv = ['run.py', {str(program)!r}]\nrun.main()\n"
    )
    assert interrupted([sys.executable, driver], begun.exists) == (17, "")


def test_two_scenes_of_one_name_are_not_taken_for_one(tmp_path):
    one, other = tmp_path / "one.toml", tmp_path / "other.toml"
    one.write_text(harness.scene_with_record())
    other.write_text(harness.scene_with_record().replace("2910.0", "3000.0"))
    result = subprocess.run(command(tmp_path / "out", one, other), env=ENVIRONMENT, capture_output=True, text=True)
    assert result.returncode == 1 and "Traceback" not in result.stderr
    assert all(str(file) in result.stderr for file in (one, other)) and "FeupFrames" in result.stderr
    assert not (tmp_path / "out/results.csv").exists()


def test_a_record_with_the_name_of_a_formula_runs_once(tmp_path):
    record = tmp_path / "=1+1.csv"
    record.write_bytes(harness.RECORD.read_bytes())
    plan = ["--records", record, "--gaps", 0.01, "--pga", 2, "--stop", 3, "--workers", 1, "--output", tmp_path]
    run = [sys.executable, str(STUDY), *map(str, plan)]
    for expected in ("2 cases, 0 of them done", "2 cases, 2 of them done"):
        result = subprocess.run(run, env=ENVIRONMENT, capture_output=True, text=True)
        assert result.returncode == 0 and expected in result.stderr, result.stderr
    assert (tmp_path / "results.csv").read_text().count("'=1+1,") == 2
    assert pyarrow.parquet.read_table(tmp_path / "results.parquet")["record"].to_pylist() == ["=1+1"] * 2


def test_the_table_has_the_spectral_accelerations_of_its_buildings(serial):
    """Of k/m = 2910/3.65, two and three equal storeys: w = 2 sqrt(k/m) sin(pi/10), sin(pi/14)."""
    motion = harness.read_record()
    for row in csv.DictReader(serial.splitlines()):
        for side, share in [("left", 10), ("right", 14)]:
            period = math.pi / math.sqrt(2910 / 3.65) / math.sin(math.pi / share)
            assert float(row[f"{side}_period_s"]) == pytest.approx(period, rel=1e-12)
            if row["record"] == "el_centro_1940_ns":
                scaled = motion[1] * (float(row["pga_m_s2"]) / np.abs(motion[1]).max())
                strength = harness.example("spectra").pseudo_acceleration(motion[0], scaled, period)
                assert float(row[f"{side}_sa_m_s2"]) == pytest.approx(strength, rel=1e-12)


def test_of_one_building_between_walls_the_other_columns_are_empty(tmp_path):
    scene = harness.ROOT / "examples/scenes/isolated.toml"
    plan = ["--workers", 1, "--stop", 7.0, "--synthetic", 0, "--pga", 5.0]
    text, _ = study(tmp_path, *plan, "--gaps", 0.1, "--", scene)
    row, alone = csv.DictReader(text.splitlines())
    assert not any(row[name] or alone[name] for name in row if name.startswith("right_") or name == "error")
    engine = harness.engine(scene, tmp_path, 7.0, stop=7.0)[-1]
    assert int(row["impacts"]) == engine["impacts"] > 0
    assert float(row["left_drift_m"]) == pytest.approx(engine["left.peak_drift[1]"], rel=1e-10)
    assert float(row["left_drift_ratio"]) > 2.0
    # What is there is read again.
    text_again, said = study(tmp_path, *plan, "--gaps", 0.1, "--", scene)
    assert text_again == text and "2 cases, 2 of them done" in said


def test_where_storeys_yield_the_table_has_ductility_and_residual_drift(tmp_path):
    scene = harness.ROOT / "examples/scenes/yielding.toml"
    plan = ["--workers", 1, "--stop", 7.0, "--synthetic", 0, "--pga", 3.43, "--gaps", 0.02, "--ductility-limit", 3.0]
    text, _ = study(tmp_path, *plan, "--", scene)
    row = next(row for row in csv.DictReader(text.splitlines()) if float(row["gap_m"]) == 0.02)
    engine = harness.engine(scene, tmp_path, 7.0, stop=7.0)[-1]
    assert engine["impacts"] > 0
    for side, storeys in [("left", 4), ("right", 3)]:
        ductilities, residuals = (
            [engine[f"{side}.{what}[{i}]"] for i in range(1, storeys + 1)] for what in ("ductility", "residual_drift")
        )
        assert float(row[f"{side}_ductility"]) == pytest.approx(max(ductilities), rel=1e-10)
        assert float(row[f"{side}_residual_drift_m"]) == pytest.approx(max(map(abs, residuals)), rel=1e-10)
    lines = list(csv.DictReader((tmp_path / "fragility_Yielding.csv").open()))
    found = {(line["demand"], line["limit"], line["exceeding"]) for line in lines if line["gap_m"] == "0.02"}
    assert ("ductility", "3.0", "1") in found
    # Without a limit of its own it is the median, here of one run, which is not above itself.
    largest = max((row[f"{side}_residual_drift_m"] for side in ("left", "right")), key=float)
    assert ("residual drift", largest, "0") in found


def test_the_parameters_of_the_curves_are_in_a_table(tmp_path):
    study(tmp_path, "--workers", 1)
    lines = list(csv.DictReader((tmp_path / "fragility_FeupFrames.csv").open()))
    # All gaps for the force and for pounding, those and no contact for drift and acceleration.
    assert len(lines) == 2 * len(GAPS) + 2 * (len(GAPS) + 1)
    touching = next(line for line in lines if line["demand"] == "pounding" and float(line["gap_m"]) == 0.0)
    runs = str(len(PGA) * (RECORDS + 1))
    assert (touching["runs"], touching["exceeding"], touching["median_m_s2"]) == (runs, runs, "")


def test_synthetic_motions_are_what_they_say(tmp_path):
    motions = harness.example("ground_motions")
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
