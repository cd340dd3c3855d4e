"""Studies of rows of buildings: their columns beside single runs, factors on gaps, and the picture of ends and middle."""

import subprocess
import sys

import fmus
import numpy as np
import pounding_fmu
import pytest
from pounding_fmu.study import pictures, run_study, table
from pounding_fmu.study.cases import by_width

NAMES = ["a", "a_b", "foundation"]
PLAN = {"records": [fmus.RECORD], "pga": [3.0], "stop": 6.0}


def scene(**more):
    """Three buildings of two and three storeys with names that begin alike, or as other columns end; all meet at each floor."""
    stiffness = {"a": [6e7, 5e7], "a_b": [9e7, 8e7, 8e7], "foundation": [3e7, 3e7]}
    row = [
        {"name": name, "mass": [1.5e5] * len(k), "stiffness": k, "damping": {"ratio": 0.05}, "height": [3.0] * len(k)}
        for name, k in stiffness.items()
    ]
    facing = {"gap": [0.004, 0.01], "law": "kelvin_voigt", "stiffness": 5e8, "restitution": 0.6}
    return {"name": "Row", "building": row, "facing": facing, **more}


def run_alone(gaps, **more):
    scale = 3.0 / np.abs(np.loadtxt(fmus.RECORD, delimiter=",", comments=("#", "t"))[:, 1]).max()
    parameters = {"ground.scale": scale, **{f"contact[{p}].gap": gap for p, gap in enumerate(gaps, 1)}, **more}
    return pounding_fmu.simulate(scene(), 6.0, 6.0, parameters=parameters, record=fmus.RECORD)


def test_columns_are_what_a_run_has():
    near, free = run_study(scene(), gaps=[0.004], **PLAN)
    run, apart = run_alone([0.004] * 4), run_alone([1e3] * 4)
    for name, storeys in zip(NAMES, (2, 3, 2)):
        drifts = [f"peak_drift[{i}]" for i in range(1, storeys + 1)]
        found = [near[f"{name}_{drift.replace('peak_drift', 'drift_m')}"] for drift in drifts]
        assert found == [run[f"{name}.{drift}"][-1] for drift in drifts] and near[f"{name}_drift_m"] == max(found)
        ratios = [run[f"{name}.{drift}"][-1] / apart[f"{name}.{drift}"][-1] for drift in drifts]
        assert near[f"{name}_drift_ratio"] == pytest.approx(max(ratios), rel=1e-12)
        assert near[f"{name}_base_shear_n"] == run[f"{name}.peak_base_shear"][-1]
    forces = [run[f"contact[{p}].peak_force"][-1] for p in (1, 2, 3, 4)]
    assert [near[f"contact_force_n[{p}]"] for p in (1, 2, 3, 4)] == forces and min(forces) > 0
    assert [near[f"contact_impacts[{p}]"] for p in (1, 2, 3, 4)] == [run[f"contact[{p}].impacts"][-1] for p in (1, 2, 3, 4)]
    assert near["hardest_contact"] == int(np.argmax(forces)) + 1 and near["peak_force_n"] == max(forces)
    assert free["hardest_contact"] is None and free["contact_impacts[1]"] == 0


def test_factors_multiply_the_gaps_of_the_scene():
    study = run_study(scene(), gap_factors=[0.5, 3.0], **PLAN)
    assert study.column("gap_factor").tolist()[:2] == [0.5, 3.0]
    for factor in (0.5, 3.0):
        run = run_alone([factor * gap for gap in (0.004, 0.004, 0.01, 0.01)])
        (row,) = (row for row in study if row["gap_factor"] == factor)
        assert row["gap_m"] is None and row["peak_force_n"] == max(run.impacts["peak_force"])
        assert study.column("impacts", gap_factor=factor) == [len(run.impacts)]
        assert row["a_drift_ratio"] is not None


def test_a_star_before_the_dot_is_any_building():
    softly = {f"{name}.damping_ratio": 0.1 for name in NAMES}
    plan = {**PLAN, "gaps": [0.004]}
    found = run_study(scene(), vary={"*.damping_ratio": [0.05, 0.1]}, **plan)
    forces = found.column("peak_force_n", gap=0.004, varied={"*.damping_ratio": 0.1})
    assert forces.tolist() == [max(run_alone([0.004] * 4, **softly).impacts["peak_force"])]
    with pytest.raises(ValueError, match=r"\*\.dampings: the scene has no such parameter"):
        run_study(scene(), vary={"*.dampings": [0.1]}, **plan)
    # Not an index of any building, and no number of a contact.
    for name in ("a*.damping_ratio", "*.gap"):
        with pytest.raises(ValueError, match="the scene has no such parameter"):
            run_study(scene(), vary={name: [0.1]}, **plan)


def test_a_table_takes_factors_and_gaps(tmp_path):
    """One after the other, each with its own rows; the table finds all of them again."""
    first = run_study(scene(), gaps=[0.004], output=tmp_path, **PLAN)
    assert "gap_factor" not in first[0]
    second = run_study(scene(), gap_factors=[1.0], output=tmp_path, **PLAN)
    done = []
    again = run_study(scene(), gaps=[0.004], output=tmp_path, progress=lambda *counts: done.append(counts), **PLAN)
    assert done[0] == (2, 2)
    assert [row["impacts"] for row in again] == [row["impacts"] for row in first]
    assert len((tmp_path / "results.csv").read_text().splitlines()) == 4 and len(second) == 2


def test_a_row_and_a_pair_share_a_table(tmp_path):
    feup = pounding_fmu.example_scene
    study = run_study([feup, scene()], gaps=[0.004], output=tmp_path, **PLAN)
    alone = run_study(feup, gaps=[0.004], **PLAN)
    both, (pair, _) = study.rows, alone.rows
    assert {name: both[0][name] for name in pair} == pair
    assert both[0]["a_drift_m"] is both[0]["hardest_contact"] is both[2]["left_drift_m"] is None
    assert [row["impacts"] for row in run_study([feup, scene()], gaps=[0.004], output=tmp_path, **PLAN)] == [row["impacts"] for row in both]


def test_columns_of_left_and_right_are_what_they_were():
    """No column of a contact, and both buildings, also where one of them is not there."""
    wall = {"left_floor": 1, "wall": "right", "gap": 0.01, "law": "linear", "stiffness": 1e8}
    [row, _] = run_study({"name": "Wall", "left": left(), "contact": [wall]}, gaps=[0.004], **PLAN)
    assert list(row) == list(table.columns({"left": 2, "right": 0}))
    assert not any(name.startswith(("contact_", "hardest", "gap_factor")) for name in row) and "right_drift_m" in row


def left():
    return {key: value for key, value in scene()["building"][0].items() if key != "name"}


def test_the_picture_shows_the_medians_over_the_row():
    study = run_study(scene(), gap_factors=[0.5, 3.0], records=None, synthetic=2, pga=[2.0, 4.0], stop=4.0)
    closing = by_width([row for row in study if row["gap_factor"] is not None])
    figure = pictures._row(closing, (None, None))
    top = figure.axes[0]
    assert top.get_title().startswith("storey drift, 0.20 g") or top.get_title(loc="left").startswith("storey drift, 0.20 g")
    lines = {line.get_label(): line.get_ydata() for line in top.get_lines()}
    for factor in (0.5, 3.0):
        medians = [np.median(study.column(f"{name}_drift_ratio", gap_factor=factor, pga=2.0)) for name in NAMES]
        assert lines[f"\N{MULTIPLICATION SIGN} {factor:g}"] == pytest.approx(medians, rel=1e-12)
        assert max(medians) < top.get_ylim()[1]
    assert [text.get_text() for text in figure.axes[-1].get_xticklabels()] == NAMES


TEXT = "[[building]]\nmass = [1e5]\nstiffness = [{}]\ndamping = {{ ratio = 0.05 }}\nheight = [3.0]\n"


def command(tmp_path, *arguments):
    text = "".join(TEXT.format(stiffness) for stiffness in (2e7, 5e7, 1e7))
    (tmp_path / "row.toml").write_text(f'name = "Row"\n{text}[facing]\ngap = 0.01\nlaw = "linear"\nstiffness = 1e8\n')
    plan = ["--records", fmus.RECORD, "--pga", "3", "--stop", "4", "-o", tmp_path]
    line = [sys.executable, "-m", "pounding_fmu", "study", tmp_path / "row.toml", *plan, *arguments]
    return subprocess.run([*map(str, line)], capture_output=True, text=True)


def test_the_command_draws_the_row(tmp_path):
    done = command(tmp_path, "--gap-factors", "0.5", "1", "--intensity", "b3_sa")
    assert done.returncode == 0 and "Traceback" not in done.stderr, done.stderr
    assert {path.name for path in tmp_path.glob("*.png")} == {f"{what}_Row.png" for what in ("gaps", "fragility", "row")}
    head, *lines = (tmp_path / "fragility_Row.csv").read_text().splitlines()
    assert head.split(",")[3] == "gap_factor" and lines[0].split(",")[3:5] == ["0.5", "b3_sa"]


def test_mistakes_of_the_command(tmp_path):
    wrong = command(tmp_path, "--intensity", "left_sa")
    assert wrong.returncode == 1 and "intensity = left_sa: expected one of pga, b1_sa, b2_sa, b3_sa" in wrong.stderr
    assert not (tmp_path / "results.csv").exists()
    assert command(tmp_path, "--gaps", "0.1", "--gap-factors", "1").returncode == 2
    wrong = command(tmp_path, "--gap-factors", "-1")
    assert wrong.returncode == 1 and "gap_factors: -1.0: expected a finite number >= 0" in wrong.stderr
