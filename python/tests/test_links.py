"""Links in Python: frequencies of what they join, the gap that linked buildings need, and studies that vary links."""

import math
import subprocess
import sys

import fmus
import numpy as np
import pounding_fmu
import pytest
from pounding_fmu.gap import required_gap
from pounding_fmu.study import run_study

STEP = ([0.0, 30.0], [-2.0, -2.0])  # m/s2, to the left: the floors go to the right first
OFFICES = (fmus.EXAMPLES / "scenes/offices.toml").read_text()
NOTHING = 1.0  # N s/m, against 1e7 that would be critical
DASHPOTS = [NOTHING, 1e6]
LINK_COLUMNS = {"force_n": "peak_force", "displacement_m": "peak_displacement", "energy_j": "dissipated_energy"}
NEVER_CLOSES = 1000.0
PGA = 3.43  # m/s2
SCALE = PGA / np.abs(np.loadtxt(fmus.RECORD, delimiter=",", comments=("#", "t"), usecols=1)).max()


def oscillator(stiffness):
    return {"mass": [1e3], "stiffness": [stiffness], "damping": {"ratio": 0.0}}


def pair(link, **meets):
    contact = {"left_floor": 1, "gap": 0.5, "law": "linear", "stiffness": 1e6, **meets}
    scene = {"name": "Pair", "left": oscillator(40e3), "stop_time": 30.0, "contact": [contact]}
    right = {} if "wall" in meets else {"right": oscillator(90e3)}
    return scene | right | {"link": [{"left_floor": 1, **meets, **link}]}


def linked(dashpot):
    """The offices with viscous dampers at three floors."""
    links = [f"[[link]]\nleft_floor = {i}\nright_floor = {i}\ndashpot = {dashpot!r}\n" for i in (1, 2, 3)]
    text = OFFICES.replace('record = "../records/', f'record = "{fmus.RECORD.parent}/')
    return "\n".join([text, "[outputs]\nenergy = true\n", *links])


def test_the_frequencies_of_the_system_are_those_of_both_with_the_spring():
    scene = pair({"stiffness": 25e3}, right_floor=1)
    run = pounding_fmu.simulate(scene, 1.0, 1.0, outputs=["system.frequency[1]", "system.frequency[2]"])
    squares = np.linalg.eigvalsh(np.array([[65.0, -25.0], [-25.0, 115.0]]))
    assert [run[name][-1] for name in run if name != "time"] == pytest.approx(np.sqrt(squares) / (2 * math.pi), rel=1e-12)


def test_a_spring_to_the_ground_makes_the_gap_smaller():
    """An undamped oscillator, suddenly pushed by m a: at most 2 a/w2, with w2 = 40 + 25 1/s2."""
    [row] = required_gap(pair({"stiffness": 25e3}, wall="right"), {"step": STEP})
    exact = 2 * 2.0 / 65.0
    assert exact <= row.gap < exact + 1.1e-6 and row.srss == pytest.approx(exact, rel=1e-9)
    assert row.ddc is None  # whose modes are those without the spring


def test_the_gap_of_linked_buildings_is_the_largest_approach_of_their_modes():
    [row] = required_gap(pair({"stiffness": 25e3}, right_floor=1), {"step": STEP})
    squares, shapes = np.linalg.eigh(np.array([[65.0, -25.0], [-25.0, 115.0]]))
    time = np.linspace(0, 30, 300_001)
    modes = 2.0 * (shapes.sum(axis=0) / squares)[:, None] * (1 - np.cos(np.sqrt(squares)[:, None] * time))
    left, right = shapes @ modes
    assert 0 < row.gap - (left - right).max() < 1.1e-6
    assert row.absolute_sum == pytest.approx(left.max() + right.max(), rel=1e-6)
    assert row.srss is row.eurocode is row.ddc is None


def test_the_command_says_what_links_are_to_the_gap(tmp_path):
    (tmp_path / "linked.toml").write_text(linked(3e6))
    command = [sys.executable, "-m", "pounding_fmu", "gap", tmp_path / "linked.toml"]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout.split("\n")[1].split()[-3:] == ["-", "-", "-"] and "links     are in all runs" in done.stdout


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    folder = tmp_path_factory.mktemp("links")
    plan = {"gaps": [0.03], "pga": [PGA], "stop": 4.0, "vary": {"link[*].dashpot": DASHPOTS}, "output": folder}
    return run_study(linked(2e6), [fmus.RECORD], **plan), plan


def test_its_rows_are_runs_of_scenes_that_have_these_dampers(study):
    """Of scenes that are written so: without links for a dashpot of nearly nothing, else with these dashpots."""
    rows, _ = study
    assert len(rows) == 2 * len(DASHPOTS) and not rows.failures
    text = linked(DASHPOTS[1])
    for value, scene in zip(DASHPOTS, [text[: text.index("[[link]]")], text], strict=True):
        run = pounding_fmu.simulate(scene, 4.0, 4.0, parameters={"ground.scale": SCALE})
        chosen = {"gap": 0.03, "varied": {"link[*].dashpot": value}}
        assert rows.column("impacts", **chosen).tolist() == [run["impacts"][-1]]
        forces = [run[f"contact[{p}].peak_force"][-1] for p in (1, 2, 3)]
        assert rows.column("peak_force_n", **chosen) == pytest.approx([max(forces)], rel=1e-4)
        for column, what in LINK_COLUMNS.items():
            for i in (1, 2, 3):
                found = rows.column(f"link_{column}[{i}]", **chosen)
                if value == NOTHING:
                    assert found > 0
                else:
                    assert found == pytest.approx([run[f"link[{i}].{what}"][-1]], rel=1e-9)
    assert rows.column("impacts", gap=0.03)[0] > rows.column("impacts", gap=0.03)[1]


def test_ratios_are_to_the_run_without_contact_that_has_the_same_dampers(study):
    rows, _ = study
    for value in DASHPOTS:
        of_value = [row for row in rows if row["varied"] == f"link[*].dashpot={value!r}"]
        near, alone = of_value
        assert alone["gap_m"] == NEVER_CLOSES
        ratio = max(near[f"left_drift_m[{i}]"] / alone[f"left_drift_m[{i}]"] for i in range(1, 6))
        assert near["left_drift_ratio"] == pytest.approx(ratio, rel=1e-12)


def test_it_goes_on_from_what_is_there(study):
    rows, plan = study
    before, told = rows.path.read_bytes(), []
    run_study(linked(2e6), [fmus.RECORD], **plan, progress=lambda *counts: told.append(counts))
    assert told == [(4, 4)] and rows.path.read_bytes() == before


def test_what_cannot_be_varied_is_said_at_once():
    vary = {"link[1].dashpt": [1.0], "contact[1].gap": [0.1], "link[*].dashpot": [-1.0], "impacts": [1.0]}
    with pytest.raises(ValueError) as error:
        run_study(linked(2e6), [fmus.RECORD], vary=vary)
    said = str(error.value)
    for text in ("link[1].dashpt: the scene has no such", "contact[1].gap is what", "link[3].dashpot = -1", "impacts is computed"):
        assert text in said, said
    with pytest.raises(ValueError, match=r"vary: link\[1\].dashpot: expected at least one value"):
        run_study(linked(2e6), [fmus.RECORD], vary={"link[1].dashpot": []})


def test_the_command_draws_what_a_damper_does(tmp_path):
    (tmp_path / "linked.toml").write_text(linked(2e6))
    plan = ["--records", fmus.RECORD, "--gaps", "0.03", "--pga", "2", "--stop", "3", "-o", tmp_path]
    command = [sys.executable, "-m", "pounding_fmu", "study", tmp_path / "linked.toml", *plan, "--vary"]
    done = subprocess.run([*command, "link[*].dashpot=0,1e6", "--vary", "link[1].dashpot=0"], capture_output=True, text=True)
    assert done.returncode == 0 and "Traceback" not in done.stderr, done.stderr
    pictures = {path.name for path in tmp_path.glob("*.png")}
    each = {f"{what}_Offices_{i}.png" for what in ("gaps", "fragility") for i in (1, 2)}
    assert pictures == each | {"varied_Offices_1.png"}
    wrong = subprocess.run([*command, "link[1].dashpot=a"], capture_output=True, text=True)
    assert wrong.returncode == 2 and "expected NAME=VALUE,VALUE" in wrong.stderr
