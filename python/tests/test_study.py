"""The study: its rows are those of runs and of FMUs, a killed one goes on, and where it runs makes no difference."""

import csv
import math
import os
import signal
import subprocess
import sys
import time

import fmus
import matplotlib.backends.backend_agg
import numpy as np
import pounding_fmu
import pyarrow.parquet
import pytest
from pounding_fmu import _terminal, spectra
from pounding_fmu.study import cases as of_cases
from pounding_fmu.study import command as of_command
from pounding_fmu.study import fragility as pictures_of
from pounding_fmu.study import motions, pictures, run_study

GAPS, PGA, RECORDS = [0.0, 0.01], [1.0, 2.0, 4.0], 4
NEVER_CLOSES = 1000.0
CASES = (len(GAPS) + 1) * len(PGA) * (RECORDS + 1)
STOREYS = {"left": 2, "right": 3}
PEAKS = {"drift_m": "peak_drift", "acceleration_m_s2": "peak_acceleration"}


def command(folder, *more):
    plan = ["--gaps", *GAPS, "--pga", *PGA, "--synthetic", RECORDS, "--stop", 5.0, "-o", folder]
    return [sys.executable, "-m", "pounding_fmu", "study", *map(str, [*more, *plan])]


def study(folder, *more):
    """Runs the command and returns its table as text, and what it said."""
    result = subprocess.run(command(folder, *more), capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    return (folder / "results.csv").read_text(), result.stderr


def refused(folder, *more, code=1):
    result = subprocess.run(command(folder, *more), capture_output=True, text=True)
    assert result.returncode == code and "Traceback" not in result.stderr, result.stderr
    return result.stderr


@pytest.fixture(scope="module")
def serial(tmp_path_factory):
    return study(tmp_path_factory.mktemp("serial"), "--workers", 1)[0]


@pytest.fixture(scope="module")
def rows(serial):
    return list(csv.DictReader(serial.splitlines()))


def motion(path=fmus.RECORD):
    return np.loadtxt(path, delimiter=",", comments=("#", "t"), unpack=True)


def end_of(scene, gap, pga, stop, **more):
    """The values at the end of a run with this gap at all contacts, its record at this peak."""
    names = pounding_fmu.variables(scene)
    gaps = {name: gap for name in names if name.endswith("].gap")}
    scale = {"ground.scale": pga / np.abs(motion()[1]).max()}
    run = pounding_fmu.simulate(scene, stop, stop, parameters=gaps | scale, **more)
    return {name: run[name][-1] for name in run}


def test_its_numbers_are_those_of_runs(rows):
    assert len(rows) == CASES and not any(row["error"] for row in rows)
    own = [row for row in rows if row["record"] == "el_centro_1940_ns"]
    for row in own:
        pga, gap = float(row["pga_m_s2"]), float(row["gap_m"])
        end, alone = end_of(fmus.FEUP, gap, pga, 5.0), end_of(fmus.FEUP, NEVER_CLOSES, pga, 5.0)
        assert int(row["impacts"]) == end["impacts"]
        assert float(row["peak_force_n"]) == max(end[f"contact[{p}].peak_force"] for p in (1, 2))
        for side, storeys in STOREYS.items():
            assert float(row[f"{side}_base_shear_n"]) == end[f"{side}.peak_base_shear"]
            for column, what in PEAKS.items():
                names = [f"{side}.{what}[{i}]" for i in range(1, storeys + 1)]
                peaks = [float(row[f"{side}_{column}[{i}]"]) for i in range(1, storeys + 1)]
                assert peaks == [end[name] for name in names]
                assert float(row[f"{side}_{column}"]) == max(peaks)
                ratio = max(end[name] / alone[name] for name in names)
                assert float(row[f"{side}_{what.removeprefix('peak_')}_ratio"]) == pytest.approx(ratio, rel=1e-12)


def test_its_numbers_are_those_of_the_fmu(rows, build):
    fmu = build(fmus.FEUP)
    for row in [row for row in rows if row["record"] == "el_centro_1940_ns"][::3]:
        gap, scale = float(row["gap_m"]), float(row["pga_m_s2"]) / np.abs(motion()[1]).max()
        parameters = {"contact[1].gap": gap, "contact[2].gap": gap, "ground.scale": scale}
        end = {name: values[-1] for name, values in fmu.run([0.0, 5.0], parameters).items()}
        assert int(row["impacts"]) == end["impacts"]
        for column, what in PEAKS.items():
            for side, storeys in STOREYS.items():
                for i in range(1, storeys + 1):
                    assert float(row[f"{side}_{column}[{i}]"]) == end[f"{side}.{what}[{i}]"]


def test_a_ratio_is_that_of_a_storey_and_not_of_the_largest_ones(rows):
    """Where a storey that drifts little alone drifts much with contact the two are not the same."""
    free = {(row["record"], row["pga_m_s2"]): row for row in rows if float(row["gap_m"]) == NEVER_CLOSES}
    differ = 0
    for row in rows:
        of_maxima = float(row["right_drift_m"]) / float(free[row["record"], row["pga_m_s2"]]["right_drift_m"])
        assert float(row["right_drift_ratio"]) >= of_maxima
        differ += float(row["right_drift_ratio"]) > 1.2 * of_maxima
    assert differ > len(rows) / 4


def test_what_columns_have_to_bear_is_in_the_table():
    """A storey whose columns a slab hits, and every storey of a shear building."""
    scene = fmus.EXAMPLES / "scenes/neighbours.toml"
    (row, _) = run_study(scene, [fmus.RECORD], gaps=[0.02], pga=[4.0], stop=8.0)
    end = end_of(scene, 0.02, 4.0, 8.0)
    for side in STOREYS:
        for column, what in [("column_force_n", "peak_column_force"), ("storey_shear_n", "peak_storey_shear")]:
            struck = [i for i in range(1, 7) if f"{side}.{what}[{i}]" in end]
            assert struck and all(row[f"{side}_{column}[{i}]"] == end[f"{side}.{what}[{i}]"] for i in struck)
        assert row[f"{side}_column_force_n"] == max(end[f"{side}.peak_column_force[{i}]"] for i in struck) > 1e6
        assert row.get(f"{side}_column_force_n[1]") is None
    stiffness = [pounding_fmu.variables(scene)[f"left.stiffness[{i}]"].start for i in range(1, 7)]
    shears = [stiffness[i - 1] * end[f"left.peak_drift[{i}]"] for i in range(1, 7)]
    assert row["left_storey_shear_n"] == pytest.approx(max(shears), rel=1e-14)


def test_the_shear_of_storeys_that_yield_is_that_of_their_loops():
    scene = fmus.EXAMPLES / "scenes/yielding.toml"
    (row, _) = run_study(scene, [fmus.RECORD], gaps=[0.02], pga=[3.43], stop=8.0)
    loops = pounding_fmu.simulate(scene, 1e-4, 8.0)
    assert row["left_ductility"] > 3.0
    for side, storeys in [("left", 4), ("right", 3)]:
        for i in range(1, storeys + 1):
            sampled = np.abs(loops[f"{side}.storey_shear[{i}]"]).max()
            assert sampled <= row[f"{side}_storey_shear_n[{i}]"] * (1 + 1e-12)
            assert row[f"{side}_storey_shear_n[{i}]"] == pytest.approx(sampled, rel=1e-5)


def test_it_runs_on_to_the_end_of_the_scene_where_that_is_after_the_record():
    """A pulse of a second; a slow building pounds long after it."""
    building = {"mass": [1e3], "damping": {"ratio": 0.01}}
    sides = {"left": {**building, "stiffness": [1e4]}, "right": {**building, "stiffness": [2e4]}}
    contact = {"left_floor": 1, "right_floor": 1, "gap": 0.01, "law": "linear", "stiffness": 1e6}
    scene = {"name": "Slow", "stop_time": 20.0, **sides, "contact": [contact]}
    pulse = {"pulse": ([0.0, 0.5, 1.0], [0.0, 2.0, 0.0])}
    found = {of: run_study(of_scene, pulse, gaps=[0.01], pga=[2.0]) for of, of_scene in [("long", scene), ("short", {**scene, "stop_time": 0.5})]}
    assert [found[of].rows[0]["stop_s"] for of in ("long", "short")] == [20.0, 1.0]
    run = pounding_fmu.simulate(scene, record=pulse["pulse"])
    assert found["long"].rows[0]["impacts"] == len(run.impacts) > found["short"].rows[0]["impacts"] + 3


def test_without_a_gap_everything_grows_with_the_ground_motion(rows):
    """Linear buildings, a linear law, no gap: twice the ground motion is twice the response."""
    rows = [row for row in rows if float(row["gap_m"]) == 0.0]
    for record in {row["record"] for row in rows}:
        forces = [float(row["peak_force_n"]) / float(row["pga_m_s2"]) for row in rows if row["record"] == record]
        assert len(forces) == len(PGA) and forces == pytest.approx([forces[0]] * len(PGA), rel=1e-9)


def test_a_dask_cluster_and_threads_write_the_same_bytes(serial, tmp_path):
    assert study(tmp_path / "threads", "--workers", 3)[0] == serial
    assert study(tmp_path / "dask", "--scheduler", "local", "--workers", 2)[0] == serial


def test_a_killed_study_goes_on(serial, tmp_path):
    table = tmp_path / "results.csv"
    running = subprocess.Popen(command(tmp_path, "--workers", 1), stderr=subprocess.DEVNULL)
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
        result = subprocess.run(command(tmp_path), capture_output=True, text=True)
    assert result.returncode == 1 and "another study" in result.stderr and "Traceback" not in result.stderr


def interrupted(command, begun):
    """Starts a program, presses Ctrl-C once it has begun, and returns its exit code and what it said."""
    running = subprocess.Popen(
        list(map(str, command)),
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
    result = subprocess.run([*long, "--synthetic", "0"], capture_output=True, text=True)
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
    code, said = interrupted(command(tmp_path), (tmp_path / "records").exists)
    assert code == 130 and "Traceback" not in said, said


def test_two_scenes_of_one_name_are_not_taken_for_one(tmp_path):
    one, other = tmp_path / "one.toml", tmp_path / "other.toml"
    one.write_text(fmus.feup())
    other.write_text(fmus.feup("2910.0", "3000.0"))
    said = refused(tmp_path / "out", one, other)
    assert all(str(file) in said for file in (one, other)) and "FeupFrames" in said
    assert not (tmp_path / "out/results.csv").exists()


def test_a_record_with_the_name_of_a_formula_runs_once(tmp_path):
    record = tmp_path / "=1+1.csv"
    record.write_bytes(fmus.RECORD.read_bytes())
    for expected in (f"{CASES // 5} cases, 0 of them done", f"{CASES // 5} cases, {CASES // 5} of them done"):
        text, said = study(tmp_path, "--records", record)
        assert expected in said
    assert text.count("'=1+1,") == CASES // 5
    assert pyarrow.parquet.read_table(tmp_path / "results.parquet")["record"].to_pylist() == ["=1+1"] * (CASES // 5)


def test_the_table_has_the_spectral_accelerations_of_its_buildings(rows):
    """Of k/m = 2910/3.65, two and three equal storeys: w = 2 sqrt(k/m) sin(pi/10), sin(pi/14)."""
    times, accelerations = motion()
    for row in rows:
        for side, share in [("left", 10), ("right", 14)]:
            period = math.pi / math.sqrt(2910 / 3.65) / math.sin(math.pi / share)
            assert float(row[f"{side}_period_s"]) == pytest.approx(period, rel=1e-12)
            if row["record"] == "el_centro_1940_ns":
                scaled = accelerations * (float(row["pga_m_s2"]) / np.abs(accelerations).max())
                strength = spectra.pseudo_acceleration(times, scaled, period)
                assert float(row[f"{side}_sa_m_s2"]) == pytest.approx(strength, rel=1e-12)


def test_of_one_building_between_walls_the_other_columns_are_empty(tmp_path):
    scene = fmus.EXAMPLES / "scenes/isolated.toml"
    plan = {"records": [fmus.RECORD], "gaps": [0.1], "pga": [5.0], "stop": 7.0, "output": tmp_path}
    row, alone = run_study(scene, **plan)
    assert not any(of[name] for of in (row, alone) for name in of if name.startswith("right_") or name == "error")
    end = end_of(scene, 0.1, 5.0, 7.0)
    assert row["impacts"] == end["impacts"] > 0
    assert row["left_drift_m"] == end["left.peak_drift[1]"] and row["left_drift_ratio"] > 2.0
    # What is there is read again.
    before, told = (tmp_path / "results.csv").read_bytes(), []
    run_study(scene, **plan, progress=lambda *counts: told.append(counts))
    assert (tmp_path / "results.csv").read_bytes() == before and told == [(2, 2)]


def test_where_storeys_yield_the_table_has_ductility_and_residual_drift(tmp_path):
    scene = fmus.EXAMPLES / "scenes/yielding.toml"
    plan = ["--records", fmus.RECORD, "--ductility-limit", 3.0, "--stop", 7.0, "-o", tmp_path]
    assert of_command.main([str(scene), "--gaps", "0.02", "--pga", "3.43", *map(str, plan)]) == 0
    text = (tmp_path / "results.csv").read_text()
    row = next(row for row in csv.DictReader(text.splitlines()) if float(row["gap_m"]) == 0.02)
    end = end_of(scene, 0.02, 3.43, 7.0)
    assert end["impacts"] > 0
    for side, storeys in [("left", 4), ("right", 3)]:
        for column, what in [("ductility", "ductility"), ("residual_drift_m", "residual_drift")]:
            expected = max(abs(end[f"{side}.{what}[{i}]"]) for i in range(1, storeys + 1))
            assert float(row[f"{side}_{column}"]) == expected
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
    one, other = (motions.write(tmp_path, seed).read_text() for seed in (1, 2))
    assert one.startswith("# SYNTHETIC") and one != other and one == motions.write(tmp_path / "again", 1).read_text()
    # While the envelope stays at 1 the mean power over many motions is that of the filters.
    powers = []
    for seed in range(100):
        time, shaking = motions.acceleration(seed)
        still = (time >= motions.STRONG[0]) & (time < motions.STRONG[1])
        powers.append(np.abs(np.fft.rfft(shaking[still] / np.std(shaking[still]))) ** 2)
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


def test_progress_moves_case_by_case_and_tells_of_what_was_done_before(tmp_path, monkeypatch):
    """Within a batch as well, as far as the batch tells."""
    batch = of_cases.simulate_batch

    def one_by_one(*arguments, progress, **more):
        ends = batch(*arguments, **more)
        for done in range(1, len(ends) + 1):
            progress(done, len(ends))
        return ends

    monkeypatch.setattr(of_cases, "simulate_batch", one_by_one)
    plan = {"records": [fmus.RECORD], "pga": [1.0], "stop": 3.0, "workers": 1, "output": tmp_path}
    told = []
    run_study(fmus.FEUP, gaps=[0.01 * i for i in range(9)], **plan, progress=lambda *counts: told.append(counts))
    assert list(dict.fromkeys(told)) == [(done, 10) for done in range(11)]
    told.clear()
    run_study(fmus.FEUP, gaps=[0.01 * i for i in range(11)], **plan, progress=lambda *counts: told.append(counts))
    assert list(dict.fromkeys(told)) == [(10, 12), (11, 12), (12, 12)]


def test_progress_is_for_terminals(capsys, monkeypatch):
    for terminal in (False, True):
        monkeypatch.setattr(sys.stderr, "isatty", lambda terminal=terminal: terminal)
        progress = _terminal.Progress("cases")
        for done in range(5):
            progress(done, 4)
        said = capsys.readouterr().err
        assert [f"{done}/4 cases" in said for done in range(5)] == [terminal] * 5


def text_of(figure):
    """All titles of a picture, each with whether it is wholly inside."""
    matplotlib.backends.backend_agg.FigureCanvasAgg(figure).draw()
    texts = [figure._suptitle, *(text for panel in figure.axes for text in (panel._left_title, panel.xaxis.label, panel.yaxis.label))]
    boxes = {text.get_text(): text.get_window_extent() for text in texts if text.get_text()}
    return {text: box.x0 >= 0 and box.y0 >= 0 and box.x1 <= figure.bbox.x1 and box.y1 <= figure.bbox.y1 for text, box in boxes.items()}


@pytest.fixture(scope="module")
def named_at_length():
    scene = fmus.feup('name = "FeupFrames"', f'name = "{"Frames_of_two_and_three_storeys_" * 4}"')
    gaps = [0.005, 0.01, 0.015, 0.02, 0.025, 0.03, 0.06]
    return run_study(scene, [fmus.RECORD], gaps=gaps, pga=[0.3, 0.6, 1.2, 2.4, 3.3, 4.5, 6.0], stop=4.0)


def drawn(monkeypatch, draw):
    """The figure that a picture is made of."""
    figures = []
    monkeypatch.setattr(pictures, "save", lambda figure, _: figures.append(figure))
    draw()
    return figures[0]


def test_no_title_runs_off_its_picture(named_at_length, monkeypatch, tmp_path):
    found = curves(named_at_length, "pga")
    for draw in (
        lambda: pictures.gaps(named_at_length.rows, tmp_path / "gaps.png"),
        lambda: pictures.fragility(found, 1, tmp_path / "fragility.png"),
    ):
        inside = text_of(drawn(monkeypatch, draw))
        assert any("Frames_of_two" in text and "not drawn" in text.replace("\n", " ") for text in inside)
        assert all(inside.values()), [text for text, is_inside in inside.items() if not is_inside]


def curves(found, intensity):
    return pictures_of.curves(found.rows, pictures_of.demands(found.rows, {}), intensity)


def test_who_looks_chooses_gaps_and_intensities(named_at_length, monkeypatch, tmp_path):
    figure = drawn(monkeypatch, lambda: pictures.gaps(named_at_length.rows, tmp_path / "a.png", [0.6, 4.5]))
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["0.06 g", "0.46 g"]
    found = curves(named_at_length, "pga")
    figure = drawn(monkeypatch, lambda: pictures.fragility(found, 1, tmp_path / "a.png", [0.01, 0.06]))
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["10 mm", "60 mm", "no contact"]
    said = refused(tmp_path, "--show-gaps", 0.01, 0.07, code=2)
    assert "--show-gaps 0.01 0.07: expected at most 7 of --gaps, which are 0 0.01" in said


def test_no_curve_goes_beyond_what_was_run(monkeypatch, tmp_path):
    from test_fragility import curve_of

    beyond, falling = curve_of([0, 0, 2, 8]), curve_of([0, 15, 6, 20], gap=0.02)
    figure = drawn(monkeypatch, lambda: pictures.fragility([beyond, falling], 20, tmp_path / "a.png"))
    panel = figure.axes[0]
    (line,) = [line for line in panel.lines if len(line.get_xdata()) > 10]
    assert (line.get_xdata()[0], line.get_xdata()[-1]) == pytest.approx((1.0 / 9.80665, 8.0 / 9.80665), rel=1e-12)
    note = panel.get_xlabel().replace("\n", " ").replace("\N{NO-BREAK SPACE}", " ")
    assert f"median beyond all runs: 10 mm ({beyond.fit[0] / 9.80665:.2f} g)" in note
    assert "no curve, shares fall: 20 mm (41 of 80)" in note


def test_everything_that_is_wrong_is_said_at_once(tmp_path):
    scene, record = tmp_path / "scene.toml", tmp_path / "still.csv"
    scene.write_text(fmus.feup("mass = [3.65, 3.65]", "mass = [-1, 3.65]"))
    record.write_text("time_s,accel_m_s2\n0,0\n1,0\n")
    said = refused(tmp_path / "out", scene, tmp_path / "nowhere.toml", "--records", record, tmp_path / "none.csv")
    assert "scene.toml: left.mass[1] = -1" in said and "nowhere.toml: No such file" in said
    assert "still.csv': the ground does not move" in said and "none.csv': expected a record file" in said
    with pytest.raises(ValueError) as wrong:
        run_study(fmus.FEUP, gaps=[2e3], pga=[-1.0], workers=0)
    assert [line.split(":")[0] for line in str(wrong.value).split("\n")] == ["gaps", "pga", "workers = 0"]


def test_a_scheduler_that_is_not_there_and_a_package_that_is_not(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(ImportError, match=r'pip install "pounding-fmu\[study\]"'):
        run_study(fmus.FEUP, scheduler="local", synthetic=0, output=tmp_path)


def test_without_a_folder_the_table_is_returned_alone(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    found = run_study(fmus.FEUP, {"mine": tuple(motion())}, gaps=[0.01], pga=[2.0, 3.0], stop=4.0)
    assert repr(found) == "<Study: 4 cases of FeupFrames, 0 failed>" and not list(tmp_path.iterdir())
    assert found.column("gap_m", pga=3.0).tolist() == [0.01, NEVER_CLOSES] and found.path is None
    with pytest.raises(KeyError, match="peak_forc: the study has no such column; did you mean peak_force_n?"):
        found.column("peak_forc")
    frame = found.to_dataframe() if pytest.importorskip("pandas") else None
    assert frame["peak_force_n"].tolist() == found.column("peak_force_n").tolist()


def test_a_case_that_fails_says_why_and_harms_no_other():
    found = run_study(fmus.FEUP, [fmus.RECORD], gaps=[0.01], pga=[1.0, 2e6], stop=4.0)
    assert [row["pga_m_s2"] for row in found.rows] == [1.0, 1.0]
    assert [row["error"].partition(" = ")[0] for row in found.failures] == ["ground.scale"] * 2
