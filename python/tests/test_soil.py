"""Soil in Python: what the summary says, the gap that buildings on soil need, and studies that vary the soil."""

import re

import fmus
import numpy as np
import pounding_fmu
import pytest
from pounding_fmu.gap import required_gap
from pounding_fmu.gap.command import main as gap_command
from pounding_fmu.study import run_study

FRAME = {"mass": [10e3, 8e3], "stiffness": [6e6, 5e6], "height": [3.0, 3.0], "damping": {"ratio": 0.05}}
SOIL = {"mass": 5e3, "inertia": 40e3, "rocking": {"stiffness": 60e6, "dashpot": 0.3e6}}
SWAY = {"stiffness": 12e6, "dashpot": 60e3}
CONTACT = {"left_floor": 1, "right_floor": 1, "gap": 0.02, "law": "linear", "stiffness": 2e8}
PGA = 3.43  # m/s2
OUTPUTS = {
    "displacement_m": "peak_displacement",
    "rotation_rad": "peak_rotation",
    "force_n": "peak_force",
    "moment_n_m": "peak_moment",
}


def scene(right_height=3.0, **contact):
    """The left frame sways and rocks, the right one rocks."""
    right = {**FRAME, "height": [3.0, right_height], "foundation": SOIL}
    return {
        "name": "Soil",
        "stop_time": 8.0,
        "left": {**FRAME, "foundation": {**SOIL, "sway": SWAY}},
        "right": right,
        "contact": [{**CONTACT, **contact}],
        "ground": {"record": str(fmus.RECORD)},
        "outputs": {"energy": True},
    }


def text(value):
    """A scene as TOML."""
    ground = value["ground"]["record"]
    soil = "mass = 5e3\ninertia = 40e3\nrocking = { stiffness = 60e6, dashpot = 0.3e6 }\n"
    frame = "mass = [10e3, 8e3]\nstiffness = [6e6, 5e6]\nheight = [3.0, 3.0]\ndamping = { ratio = 0.05 }\n"
    sway = "sway = { stiffness = 12e6, dashpot = 60e3 }\n"
    contact = "[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 0.02\nlaw = \"linear\"\nstiffness = 2e8\n"
    buildings = f"[left]\n{frame}[left.foundation]\n{soil}{sway}[right]\n{frame}[right.foundation]\n{soil}"
    return f'name = "Soil"\nstop_time = 8.0\n{buildings}{contact}[ground]\nrecord = "{ground}"\n[outputs]\nenergy = true\n'


def test_the_summary_has_a_line_for_each_foundation():
    result = pounding_fmu.simulate(scene())
    said = result.summary()
    table = said[said.index("  foundation ") :]
    left, right = (re.search(rf"^  {side} +(1\.\d+) +(.*)$", table, re.M) for side in ("left", "right"))
    factors = {"peak_displacement": 1.0, "peak_rotation": 1e3, "peak_force": 1e-3, "peak_moment": 1e-3}
    last = {name: factor * result[f"left.foundation.{name}"][-1] for name, factor in factors.items()}
    assert [float(number) for number in left[2].split()] == pytest.approx(list(last.values()), rel=1e-4)
    assert len(right[2].split()) == 2
    assert f"on its soil the first period is {float(left[1]):.4g} times that" in said
    assert re.search(r"soil, a part of viscous +\d", said) and result["energy.soil"][-1] > 0.0


def test_rules_for_gaps_have_the_displacements_of_what_meets():
    """A floor, and columns at the share 2/3 of a first storey of 4.5 m, by the shares of both ends and the rotation."""
    facing = scene()
    facing["right"] = {**facing["right"], "height": [4.5, 3.0]}
    del facing["contact"][0]["right_floor"]
    facing["contact"][0] |= {"right_storey": 1}
    [row] = required_gap(facing)
    with pytest.warns(pounding_fmu.SceneWarning, match="no contact"):
        free = pounding_fmu.simulate({**facing, "contact": []})
    peak = {name: free[name][-1] for name in free if "peak" in name}
    s = 3.0 / 4.5
    upper = s * s * (3 - 2 * s)
    columns = upper * peak["right.peak_displacement[1]"] + abs(s - upper) * 4.5 * peak["right.foundation.peak_rotation"]
    assert row.absolute_sum == pytest.approx(peak["left.peak_displacement[1]"] + columns, rel=1e-9)
    assert row.ddc is None and row.srss is not None


def test_the_command_says_what_soil_is_to_the_gap(tmp_path, capsys):
    file = tmp_path / "soil.toml"
    file.write_text(text(scene()))
    assert gap_command([str(file)]) == 0
    assert "on a fixed base, has no value" in capsys.readouterr().out


def test_rows_of_a_study_are_runs_on_that_soil(tmp_path):
    name, values = "left.foundation.rocking_stiffness", [50e6, 120e6]
    rows = run_study(text(scene()), [fmus.RECORD], gaps=[0.02], pga=[PGA], stop=4.0, vary={name: values}, output=tmp_path)
    assert not rows.failures
    peak = np.abs(np.loadtxt(fmus.RECORD, delimiter=",", comments=("#", "t"), usecols=1)).max()
    for value in values:
        run = pounding_fmu.simulate(scene(), 4.0, 4.0, parameters={"ground.scale": PGA / peak, name: value})
        for column, what in OUTPUTS.items():
            found = rows.column(f"left_foundation_{column}", gap=0.02, varied={name: value})
            assert found == pytest.approx([run[f"left.foundation.{what}"][-1]], rel=1e-9)
    assert "right_foundation_rotation_rad" in rows[0] and rows[0]["right_foundation_displacement_m"] is None


def test_the_period_of_a_study_is_that_on_the_soil():
    """As the intensity of a ground motion for a building that stands there."""
    (period, _), _ = pounding_fmu._scenes.read_scene(scene()).first_modes()
    run = pounding_fmu.simulate(scene(), 1.0, 1.0, outputs=["left.frequency[1]", "left.foundation.period_ratio"])
    assert period == pytest.approx(run["left.foundation.period_ratio"][-1] / run["left.frequency[1]"][-1], rel=1e-12)
    assert run["left.foundation.period_ratio"][-1] > 1.05
