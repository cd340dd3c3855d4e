"""The gaps of a row: closed forms, each two neighbours as a scene of their own, and runs with the gaps that were found."""

import csv
import math

import fmus
import numpy as np
import pounding_fmu
import pytest
from pounding_fmu.gap import required_gap
from pounding_fmu.gap import row as of_row
from test_gap import STEP, gap, oscillator

STIFFNESS = {"a": 40e3, "b": 90e3, "c": 250e3}
LAW = {"law": "linear", "stiffness": 1e6}


def oscillators():
    """Of 1 t each, undamped, a wall on the right of the last one."""
    row = [{"name": name, **oscillator(stiffness)} for name, stiffness in STIFFNESS.items()]
    contacts = [{"left": left, "right": right, "left_floor": 1, "right_floor": 1, "gap": 0.5, **LAW} for left, right in ("ab", "bc")]
    wall = {"left": "c", "left_floor": 1, "wall": "right", "gap": 0.5, **LAW}
    return {"name": "Three", "stop_time": 30.0, "building": row, "contact": [*contacts, wall]}


def houses(**more):
    """Of two to four storeys; the tall one yields."""
    stiffness = {"west": [6e7, 5e7], "tall": [9e7, 8e7, 8e7, 7e7], "low": [8e7, 7e7], "east": [4e7, 4e7, 3e7]}
    row = [
        {"name": name, "mass": [1.5e5] * len(k), "stiffness": k, "damping": {"ratio": 0.05}, "height": [3.0] * len(k)}
        for name, k in stiffness.items()
    ]
    row[1] |= {"yield_force": [1.5e6] * 4, "post_yield_ratio": 0.1}
    facing = {"gap": [0.02, 0.01, 0.015], "law": "kelvin_voigt", "stiffness": 5e8, "restitution": 0.6}
    ground = {"record": str(fmus.RECORD)}
    return {"name": "Houses", "stop_time": 12.0, "building": row, "facing": facing, "ground": ground, **more}


def approaches():
    """m, the largest of each gap, of a/w2 (1 - cos w t) in fine samples."""
    time = np.linspace(0, 30, 300_001)
    moves = [2.0 / (k / 1e3) * (1 - np.cos(math.sqrt(k / 1e3) * time)) for k in STIFFNESS.values()]
    return [(moves[0] - moves[1]).max(), (moves[1] - moves[2]).max(), 4.0 / (STIFFNESS["c"] / 1e3)]


def test_gaps_of_oscillators_are_their_largest_approaches():
    rows = required_gap(oscillators(), {"step": STEP})
    assert [row.between for row in rows] == ["a, b", "b, c", "c, wall"]
    assert [row.contact for row in rows] == [1, 2, 3]
    for row, exact in zip(rows, approaches()):
        assert -1e-9 < row.gap - exact < 1.1e-6
    a, b, c = (4.0 / (k / 1e3) for k in STIFFNESS.values())
    assert [row.absolute_sum for row in rows] == pytest.approx([a + b, b + c, c], rel=1e-9)
    assert [row.srss for row in rows] == pytest.approx([math.hypot(a, b), math.hypot(b, c), c], rel=1e-9)
    assert rows[2].eurocode is None and rows[0].eurocode == pytest.approx(0.7 * rows[0].srss)


def test_what_rows_of_a_run_miss_is_searched_for(monkeypatch):
    """Of a run that shows less than there is, another one finds that they meet."""
    monkeypatch.setattr(of_row, "largest", lambda time, value, rate: 0.99 * value.max())
    rows = required_gap(oscillators(), {"step": STEP})
    for row, exact in zip(rows, approaches()):
        assert -1e-9 < row.gap - exact < 1.1e-6


def test_the_largest_value_is_that_between_rows():
    """A sine, 1 at its tops, of rows that have none of them, a tenth of a radian apart; and values that only rise."""
    time = np.arange(0.0, 20.0, 0.1)
    tops = [of_row.largest(time + start, np.sin(time + start), np.cos(time + start)) for start in (0.003, 0.02, 0.05)]
    assert tops == pytest.approx([1.0] * 3, abs=0.1**4 / 384 + 1e-12)
    assert np.sin(time + 0.003).max() < 1.0 - 1e-5
    assert of_row.largest(time, time, np.ones_like(time)) == time[-1]


def test_each_gap_is_that_of_two_buildings_alone():
    found = required_gap(houses())
    row = houses()["building"]
    assert len(found) == 3
    for at, one in enumerate(found):
        left, right = ({key: value for key, value in of.items() if key != "name"} for of in row[at : at + 2])
        alone = {**houses(), "left": left, "right": right, "facing": {**houses()["facing"], "gap": 0.01}}
        del alone["building"]
        [two] = required_gap(alone)
        assert one.gap == pytest.approx(two.gap, abs=1.5e-6) and one.gap > 0.005
        for rule in ("absolute_sum", "srss", "eurocode", "ddc"):
            assert getattr(one, rule) == pytest.approx(getattr(two, rule), rel=1e-9)
        first = sum(int(name.endswith("].gap")) for name in pounding_fmu.variables({**alone}))
        assert 1 <= one.contact - sum(storeys(left_of, right_of) for left_of, right_of in zip(row[:at], row[1:])) <= first


def storeys(left, right):
    """How many contacts face each other."""
    return min(len(left["mass"]), len(right["mass"]))


def test_alike_buildings_need_no_gap():
    twins = {**oscillators(), "building": [{"name": name, **oscillator(4e4, 0.05)} for name in STIFFNESS]}
    first, second, wall = required_gap(twins, {"step": STEP})
    assert (first.gap, first.contact, second.gap) == (0.0, None, 0.0) and wall.gap > 0.05


def gaps_by(factor):
    names = [name for name in pounding_fmu.variables(houses()) if name.endswith("].gap")]
    own = {name: pounding_fmu.variables(houses())[name].start for name in names}
    return {name: np.atleast_1d(factor) * width for name, width in own.items()}


def largest_force(factor):
    outputs = [name.replace("gap", "peak_force") for name in gaps_by(1.0)]
    return pounding_fmu.simulate_batch(houses(), gaps_by(factor), outputs, stop=31.18).max(axis=1)


def test_a_factor_on_all_gaps_for_a_force():
    rows = required_gap(houses(), force=2e6)
    (factor,) = {row.force_factor for row in rows}
    assert [row.force_gap / factor for row in rows] == pytest.approx([0.02, 0.01, 0.015])
    below, at = largest_force(np.array([factor - 1e-4, factor]))
    assert below > 2e6 >= at
    assert rows[0].hardest_force == largest_force(rows[0].hardest_gap / 0.02)[0] > 2e6


def test_between_two_with_what_the_others_do():
    """As they are in the scene, which has the first two and the last two meet."""
    [row] = required_gap(houses(), between=["low", "tall"])
    contacts = [p for p in range(1, 7) if 2 < p <= 4]
    met = lambda width: sum(  # noqa: E731
        pounding_fmu.simulate(houses(), 31.18, parameters={f"contact[{p}].gap": width for p in contacts})[f"contact[{p}].impacts"][-1]
        for p in contacts
    )
    assert row.between == "tall, low" and row.contact in contacts
    assert met(row.gap) == 0 < met(row.gap - 2.1e-6)
    alone = next(of for of in required_gap(houses()) if of.between == "tall, low")
    assert abs(row.gap - alone.gap) > 1e-3


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ({"between": ["low", "tal"]}, "between: tal: the scene has no such building; did you mean tall?"),
        ({"between": ["west", "low"]}, "between = west low: expected two neighbours of west, tall, low, east"),
        ({"force": 1e6, "gap": [0.0, 0.01, 0.01]}, "contact[1].gap = 0.0: expected a gap > 0, which a factor makes wider"),
    ],
)
def test_what_is_wrong_with_a_row_is_said(more, said):
    scene = houses()
    scene["facing"] = {**scene["facing"], "gap": more.pop("gap", 0.01)}
    with pytest.raises(ValueError) as wrong:
        required_gap(scene, **more)
    assert said in str(wrong.value)


TEXT = """name = "Row"
{buildings}
[facing]
gap = 0.02
law = "linear"
stiffness = 1e8
[ground]
record = "{record}"
"""


def test_the_command_tells_each_gap(tmp_path):
    scene, table = tmp_path / "row.toml", tmp_path / "row.csv"
    one = "[[building]]\nmass = [1e5]\nstiffness = [{}]\ndamping = {{ ratio = 0.05 }}\nheight = [3.0]\n"
    buildings = "".join(one.format(stiffness) for stiffness in (2e7, 5e7, 1e7))
    scene.write_text(TEXT.format(buildings=buildings, record=fmus.RECORD))
    done = gap(scene, "--pga", 2, 4, "-o", table)
    assert done.returncode == 0 and done.stderr == "", done.stderr
    rows = required_gap(scene, pga=[2.0, 4.0])
    head, *lines = done.stdout.splitlines()
    assert head.split()[:3] == ["between", "ground", "motion"]
    for line, row in zip(lines, rows):
        assert line.startswith(row.between)
        assert line.split()[2:6] == [row.record, f"{row.pga:g}", f"{1e3 * row.gap:.1f}", f"contact[{row.contact}]"]
    assert [row.between for row in rows] == ["b1, b2", "b2, b3"] * 2
    found = list(csv.DictReader(table.open()))
    assert [(of["between"], float(of["gap"])) for of in found] == [(row.between, row.gap) for row in rows]
    assert "force_factor" not in found[0]
    # All gaps that are needed: nothing meets, and none of it is stronger; no gap at all: 0 %.
    (enough,) = (line.split() for line in done.stdout.splitlines() if line.startswith("101 %"))
    assert enough[2:5] == ["0", "0", "0"] and set(enough[5:]) == {"1.00"}
