"""The engine's own program: its tables, and how it refuses."""

import csv
import subprocess
from decimal import Decimal
from math import pi, sin, sqrt

import pytest

import harness

EPISODE = [
    "contact",
    "start_s",
    "end_s",
    "approach_velocity",
    "separation_velocity",
    "peak_force",
    "peak_time_s",
    "peak_penetration",
    "impulse",
    "dissipated_energy",
]


def simulate(*arguments):
    return subprocess.run([*harness.SIMULATE, *map(str, arguments)], cwd=harness.ROOT, capture_output=True, text=True)


def tables(scene, folder, *arguments):
    """The rows of both tables, as text."""
    motion, impacts = folder / "motion.csv", folder / "impacts.csv"
    result = simulate(scene, "--csv", motion, "--impacts", impacts, *arguments)
    assert result.returncode == 0, result.stderr
    last = result.stdout.splitlines()[-1]
    assert last.startswith("solve_seconds=") and 0 < float(last.removeprefix("solve_seconds=")) < 60
    return [list(csv.DictReader(table.open())) for table in (motion, impacts)]


def test_episodes_add_up_to_what_the_outputs_say(feup, tmp_path):
    motion, episodes = tables(feup.scene, tmp_path)
    assert list(episodes[0]) == EPISODE
    assert [float(e["start_s"]) for e in episodes] == sorted(float(e["start_s"]) for e in episodes)
    end = motion[-1]
    assert len(episodes) == int(end["impacts"]) > 0
    for p in "12":
        own = [e for e in episodes if e["contact"] == p]
        assert len(own) == int(end[f"contact[{p}].impacts"])
        assert max(float(e["peak_force"]) for e in own) == float(end[f"contact[{p}].peak_force"])
        assert own[-1]["approach_velocity"] == end[f"contact[{p}].approach_velocity"]
        for total in ["impulse", "dissipated_energy"]:
            assert sum(float(e[total]) for e in own) == pytest.approx(float(end[f"contact[{p}].{total}"]), rel=1e-12)
    for e in episodes:
        assert float(e["start_s"]) <= float(e["peak_time_s"]) <= float(e["end_s"])
        # kelvin_voigt gives a free impact the restitution 0.65; in a fast one the storeys have no time to change much.
        approach, separation = float(e["approach_velocity"]), float(e["separation_velocity"])
        assert approach < 0.5 or separation / approach == pytest.approx(0.65, abs=0.01)


def test_an_episode_that_is_still_open_has_no_end(feup, tmp_path):
    _, episodes = tables(feup.scene, tmp_path)
    first = episodes[0]
    middle = (float(first["start_s"]) + float(first["end_s"])) / 2
    motion, episodes = tables(feup.scene, tmp_path, "--stop", repr(middle))
    assert len(episodes) == 1
    assert episodes[0]["end_s"] == "" and episodes[0]["start_s"] == first["start_s"]
    assert motion[-1][f"contact[{first['contact']}].active"] == "1"
    assert motion[0][f"contact[{first['contact']}].active"] == "0"


def test_rows_lie_at_multiples_of_the_step_and_at_the_end(feup, tmp_path):
    motion, _ = tables(feup.scene, tmp_path, "--step", "0.3", "--stop", "1")
    assert [float(row["time"]) for row in motion] == [0, 0.3, 0.6, 3 * 0.3, 1]
    motion, _ = tables(feup.scene, tmp_path)
    assert [float(row["time"]) for row in motion] == [*(k * 0.01 for k in range(2000)), 20]


def test_numbers_are_the_shortest_that_read_back(feup, tmp_path):
    motion, episodes = tables(feup.scene, tmp_path, "--stop", "3")
    cells = [cell for row in [*motion, *episodes] for cell in row.values()]
    assert all(Decimal(cell) == Decimal(repr(float(cell))) for cell in cells)


def test_natural_frequencies_are_printed(feup):
    """Those of equal floors and storeys, by their closed form."""
    printed = simulate(feup.scene, "--stop", "0.1").stdout.splitlines()
    for side, storeys in [("left", 2), ("right", 3)]:
        angles = [(2 * mode - 1) * pi / (4 * storeys + 2) for mode in range(1, storeys + 1)]
        frequencies = [sqrt(2910.0 / 3.65) * sin(angle) / pi for angle in angles]
        (line,) = [line for line in printed if line.startswith(f"  {side} ") and "floors" in line]
        assert f"(frequencies {', '.join(f'{f:.4f}' for f in frequencies)} Hz)" in line


def test_a_record_is_for_a_scene_without_one(feup):
    result = simulate(feup.scene, "--record", harness.RECORD)
    assert result.returncode == 1 and "ground.record" in result.stderr


@pytest.mark.parametrize(
    "arguments, code, said",
    [
        (["no/such/scene.toml"], 1, "no/such/scene.toml"),
        (["examples/scenes/feup.toml", "--csv", "no/such/place.csv"], 1, "no/such/place.csv"),
        (["examples/scenes/feup.toml", "--step", "0"], 2, "> 0"),
        (["examples/scenes/feup.toml", "--stop", "nan"], 2, "> 0"),
        (["examples/scenes/feup.toml", "--stop", "1e300"], 2, "at most 1e12"),
        (["examples/scenes/feup.toml", "--step", "1e-300"], 1, "2.0e301 rows; expected at most 1e12, by a larger step"),
        (["examples/scenes/feup.toml", "--csv", "examples/scenes/feup.toml"], 1, "this is the scene itself"),
        ([], 2, "SCENE.toml"),
    ],
)
def test_refusals_name_what_is_wrong(arguments, code, said):
    result = simulate(*arguments)
    assert result.returncode == code and said in result.stderr and "panicked" not in result.stderr
