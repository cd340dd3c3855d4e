"""The gap that two buildings need: closed forms, the free motion, and runs with the gap that was found."""

import csv
import math
import subprocess
import sys

import fmus
import numpy as np
import pounding_fmu
import pytest
from pounding_fmu.gap import required_gap
from pounding_fmu.gap.search import Search, correlation
from test_command import run

OFFICES = fmus.EXAMPLES / "scenes/offices.toml"
STEP = ([0.0, 30.0], [-2.0, -2.0])  # m/s2, to the left: the floors go to the right first


def oscillator(stiffness, ratio=0.0):
    return {"mass": [1e3], "stiffness": [stiffness], "damping": {"ratio": ratio}}


def contact(**more):
    return {"left_floor": 1, "gap": 0.5, "law": "linear", "stiffness": 1e6, **more}


def test_the_gap_to_a_wall_is_twice_the_static_displacement():
    """An undamped oscillator, suddenly pushed by m a: at most 2 a/w2, here with w2 = 40 and 160 1/s2."""
    for stiffness in (40e3, 160e3):
        scene = {"name": "Wall", "left": oscillator(stiffness), "contact": [contact(wall="right")], "stop_time": 30.0}
        [row] = required_gap(scene, {"step": STEP})
        exact = 2 * 2.0 / (stiffness / 1e3)
        assert exact <= row.gap < exact + 1.1e-6
        assert row.contact == 1 and row.absolute_sum == row.srss == row.ddc == pytest.approx(exact, rel=1e-9)
        assert row.eurocode is None and (row.record, row.pga) == ("step", 2.0)


def test_the_gap_between_two_floors_is_their_largest_approach():
    """a/w2 (1 - cos w t) of one minus that of the other, largest in fine samples: below by less than its curvature."""
    scene = {"name": "Two", "left": oscillator(40e3), "right": oscillator(90e3), "stop_time": 30.0}
    [row] = required_gap({**scene, "contact": [contact(right_floor=1)]}, {"step": STEP}, pga=[1.5])
    time = np.linspace(0, 30, 300_001)
    left, right = (1.5 / w**2 * (1 - np.cos(w * time)) for w in (math.sqrt(40), math.sqrt(90)))
    assert 0 < row.gap - (left - right).max() < 1.1e-6
    assert row.absolute_sum == pytest.approx(2 * 1.5 * (1 / 40 + 1 / 90), rel=1e-9)
    assert row.srss == pytest.approx(2 * 1.5 * math.hypot(1 / 40, 1 / 90), rel=1e-9)
    assert row.eurocode == pytest.approx(0.7 * row.srss) and row.pga == 1.5


@pytest.mark.parametrize("name", ["offices", "neighbours", "yielding"])
def test_the_gap_is_how_much_the_contacts_close_without_it(name):
    scene = fmus.EXAMPLES / f"scenes/{name}.toml"
    [row] = required_gap(scene)
    gaps = {of: 1e3 for of in pounding_fmu.variables(scene) if of.endswith("].gap")}
    free = pounding_fmu.simulate(scene, 1e-3, parameters=gaps)
    closes = [free[of.replace("gap", "penetration")].max() + 1e3 for of in gaps]
    # 1 ms: rows miss less than 1e-3 of the largest value.
    assert max(closes) <= row.gap + 1e-9 and row.gap == pytest.approx(max(closes), rel=1e-3)
    assert row.contact == int(np.argmax(closes)) + 1
    assert row.gap < row.absolute_sum and row.srss < row.absolute_sum


def test_the_rules_take_the_columns_between_their_floors():
    """A slab at mid-height of fixed columns: half of the displacements of both floors."""
    scene = {"name": "Columns", "left": oscillator(40e3), "stop_time": 30.0}
    scene["right"] = {"mass": [1e3, 1e3], "stiffness": [2e5, 1e5], "damping": {"ratio": 0.05}}
    scene["contact"] = [contact(right_storey=2, right_position=0.5)]
    [row] = required_gap(scene, {"step": STEP})
    peaks = pounding_fmu.simulate({**scene, "contact": [contact(right_storey=2, right_position=0.5, gap=9.0)]}, record=STEP)
    left, low, high = (peaks[f"{floor[:-1]}.peak_displacement[{floor[-1]}]"][-1] for floor in ("left1", "right1", "right2"))
    assert row.absolute_sum == pytest.approx(left + 0.5 * (low + high), rel=1e-9)
    assert row.eurocode is None


def forces(gaps):
    outputs = [f"contact[{p}].peak_force" for p in (1, 2, 3)]
    parameters = {f"contact[{p}].gap": gaps for p in (1, 2, 3)}
    return pounding_fmu.simulate_batch(OFFICES, parameters, outputs).max(axis=1)


def test_from_the_gap_for_a_force_on_no_wider_one_has_more():
    for force in (1.0e6, 2.0e6, 2.9e6):
        [row] = required_gap(OFFICES, force=force)
        assert 0 < row.force_gap < row.gap
        below, at = forces(np.array([row.force_gap - 2e-6, row.force_gap]))
        assert below > force >= at
        assert (forces(np.linspace(row.force_gap, row.gap, 57)) <= force).all()
        assert row.hardest_force == forces(np.array([row.hardest_gap]))[0] > 3e6


def test_a_force_that_no_gap_reaches_needs_none():
    [row] = required_gap(OFFICES, force=1e8)
    assert row.force_gap == 0.0 and row.hardest_force < 1e8


@pytest.mark.parametrize("modes", [((0.5, 0.05), (0.45, 0.05)), ((0.5, 0.02), (0.7, 0.1)), ((1.0, 0.2), (0.9, 0.03))])
def test_the_correlation_is_that_of_white_noise(modes):
    """The integral of both transfer functions over all frequencies."""
    frequency = np.linspace(0, 400, 1_000_001)[1:]
    one, other = (
        1 / ((2 * np.pi / period) ** 2 - frequency**2 + 2j * ratio * (2 * np.pi / period) * frequency)
        for period, ratio in modes
    )
    integral = (one * other.conj()).real.sum() / math.sqrt((abs(one) ** 2).sum() * (abs(other) ** 2).sum())
    assert correlation(*modes) == pytest.approx(integral, rel=1e-4)
    assert correlation(*modes) == pytest.approx(correlation(*modes[::-1]), rel=1e-12)


def test_buildings_of_one_period_move_together():
    """Then the double difference is the difference: 0 of twins, and no gap is needed but what holds them apart."""
    twins = {"name": "Twins", "left": oscillator(4e4, 0.05), "right": oscillator(4e4, 0.05), "stop_time": 30.0}
    [row] = required_gap({**twins, "contact": [contact(right_floor=1)]}, {"step": STEP})
    assert row.ddc == pytest.approx(0.0, abs=1e-7) and row.gap <= 1e-6 and row.srss > 0.1


def test_it_runs_on_to_the_end_of_the_scene():
    """A pulse; two slow buildings come closest long after it."""
    scene = {"name": "Slow", "left": oscillator(1e4), "right": oscillator(1.3e4), "contact": [contact(right_floor=1)]}
    pulse = {"pulse": ([0.0, 0.5, 1.0], [0.0, 2.0, 0.0])}
    long, short = (required_gap({**scene, "stop_time": stop}, pulse)[0].gap for stop in (40.0, 0.5))
    assert long > 1.5 * short


@pytest.mark.parametrize(
    "change, more, said",
    [
        ({"contact": []}, {}, "expected a scene with contacts"),
        ({"outputs": {"peaks": False}}, {}, "outputs.peaks = true"),
        ({}, {"records": None}, "the scene has no record"),
        ({}, {"records": {}}, "records: expected at least one"),
        ({}, {"pga": [1.0, -2.0]}, "pga: -2.0: expected a number of m/s2 > 0"),
        ({}, {"force": -1.0}, "force = -1.0: expected a number of N > 0"),
        ({"contact": [{"left_floor": 1, "right_floor": 1, "gap": 0.1, "law": "stereomechanical", "restitution": 0.5}]}, {"force": 1.0}, "contact[1] is stereomechanical"),
        ({}, {"records": {"still": ([0.0, 1.0], [0.0, 0.0])}}, "'still': the ground does not move"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_said(change, more, said):
    scene = {"name": "Two", "left": oscillator(4e4), "right": oscillator(9e4), "contact": [contact(right_floor=1)]}
    with pytest.raises(ValueError) as wrong:
        required_gap({**scene, **change}, **{"records": {"step": STEP}, **more})
    assert said in str(wrong.value)


def gap(*arguments):
    command = [sys.executable, "-m", "pounding_fmu", "gap", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True)


def test_the_command_prints_each_record_and_all(tmp_path):
    one, other, table = (tmp_path / name for name in ("one.csv", "other.csv", "table.csv"))
    samples = np.loadtxt(fmus.RECORD, delimiter=",", comments=("#", "t"))[:300]
    for path, sign in (one, 1), (other, -1):
        np.savetxt(path, samples * [1, sign], delimiter=",", header="time_s,accel_m_s2", comments="")
    done = gap(OFFICES, "--records", one, other, "--pga", 2, 3.43, "--force", 2e6, "-o", table)
    assert done.returncode == 0 and done.stderr == "", done.stderr
    rows = required_gap(OFFICES, [one, other], pga=[2.0, 3.43], force=2e6)
    head, *lines = done.stdout.splitlines()
    for line, row in zip(lines, rows):
        assert line.split()[:4] == [row.record, f"{row.pga:g}", f"{1e3 * row.gap:.1f}", f"contact[{row.contact}]"]
        lengths = (row.absolute_sum, row.srss, row.eurocode, row.ddc, row.force_gap)
        assert line.split()[4:9] == [f"{1e3 * length:.1f}" for length in lengths]
    of_2 = [1e3 * row.gap for row in rows if row.pga == 2.0]
    assert lines[4].split()[:3] == ["largest", "2", f"{max(of_2):.1f}"]
    assert lines[5].split()[:3] == ["mean", "2", f"{sum(of_2) / 2:.1f}"]
    found = list(csv.DictReader(table.open()))
    assert [float(row["gap"]) for row in found] == [row.gap for row in rows]
    widest = max(row.gap for row in rows)
    (last,) = [line.split() for line in lines if line.startswith("0.0 ")]
    [cost] = [cost for cost in Search(OFFICES, [one, other], [2.0, 3.43], None, None, None).costs(widest) if cost.gap == 0]
    assert last == ["0.0", "4", str(cost.impacts), f"{cost.force / 1e3:.4g}", *(f"{ratio:.2f}" for ratio in cost.drift_ratios.values())]


def test_the_costs_are_those_of_runs():
    search = Search(OFFICES, None, None, None, None, None)
    *_, touching = search.costs(0.08)
    near, free = (
        {name: run[name][-1] for name in run}
        for run in (
            pounding_fmu.simulate(OFFICES, 31.18, parameters={f"contact[{p}].gap": width for p in (1, 2, 3)})
            for width in (0.0, 1e3)
        )
    )
    assert (touching.gap, touching.pounding, touching.impacts) == (0.0, 1, near["impacts"])
    assert touching.force == max(near[f"contact[{p}].peak_force"] for p in (1, 2, 3))
    for side, storeys in [("left", 5), ("right", 3)]:
        names = [f"{side}.peak_drift[{i}]" for i in range(1, storeys + 1)]
        assert touching.drift_ratios[side] == pytest.approx(max(near[name] / free[name] for name in names), rel=1e-12)


def test_mistakes_of_the_command():
    wrong = gap("nowhere.toml")
    assert wrong.returncode == 1 and "nowhere.toml: No such file" in wrong.stderr
    wrong = gap(OFFICES, "--records", "nowhere.csv", "--pga", "-1")
    assert wrong.returncode == 1 and "nowhere.csv" in wrong.stderr and "pga: -1.0" in wrong.stderr
    assert gap(OFFICES, "--force", "much").returncode == 2


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("stop_time = 20.0", "stop_time = -1.0"), "stop_time = -1.0: expected"),
        (('record = "rec', '#record = "rec'), "the scene has no record"),
        (("[outputs]", "[outputs]\npeaks = false"), "expected a scene with peaks"),
    ],
)
def test_the_command_names_the_scene_that_is_wrong(change, said, tmp_path):
    scene = tmp_path / "s.toml"
    scene.write_text(fmus.feup(str(fmus.RECORD), "rec.csv").replace(*change))
    (tmp_path / "rec.csv").write_bytes(fmus.RECORD.read_bytes())
    assert f"error: {scene}: {said}" in gap(scene).stderr


def test_pictures_and_pages_name_the_scene_that_is_wrong(tmp_path):
    (tmp_path / "s.toml").write_text("name = 3")
    for command in ("plot", "animate", "page"):
        done = run(command, "s.toml", *["-o", "a.gif"] * (command == "animate"), cwd=tmp_path)
        assert done.stderr.startswith("error: s.toml: name = 3: ") or "without the page" in done.stderr


def test_what_falls_by_itself_is_said():
    scene = fmus.EXAMPLES / "scenes/leaning.toml"
    with pytest.warns(pounding_fmu.SceneWarning):
        [row] = required_gap(scene)
    gaps = {"contact[1].gap": 10.0}
    with pytest.warns(pounding_fmu.SceneWarning):
        free = pounding_fmu.simulate(scene, 0.01, parameters=gaps)
    assert free["left.collapsed"][-1] and row.collapsed == "left"
    assert row.gap < 1.5 < row.absolute_sum, "half of the height, where the run ends"
    told = gap(str(scene))
    assert "collapse  el_centro_1940_ns at -3.13 m/s2: apart, left falls; all here is until then" in told.stdout
    assert required_gap(OFFICES)[0].collapsed is None
