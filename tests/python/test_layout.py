"""What pictures know of a scene: levels, and what meets where."""

import csv

import numpy as np
import pytest

import harness

LAW = 'gap = {gap}\nlaw = "hertz"\nstiffness = 1e6\n'
BUILDING = "mass = [{mass}]\nstiffness = [{stiffness}]\ndamping = {{ ratio = 0.02 }}\n"


def building(side, heights, level=0.0, has_levels=True):
    count = len(heights)
    text = BUILDING.format(mass=", ".join(["3.65"] * count), stiffness=", ".join(["2910.0"] * count))
    return f"[{side}]\n{text}" + (f"height = {heights}\nbase_level = {level}\n" if has_levels else "")


def scene_of(folder, *parts):
    file = folder / "scene.toml"
    file.write_text("\n".join(['name = "Scene"\nstop_time = 8.0', *parts, f"[ground]\nrecord = '{harness.RECORD}'\n"]))
    return file


def facing(folder):
    left, right = building("left", [0.5, 0.4, 0.4]), building("right", [0.6, 0.25], 0.05)
    return scene_of(folder, left, right, "[facing]\nlevel_tolerance = 0.02\n" + LAW.format(gap=0.004))


def walls(folder):
    contacts = [
        f'[[contact]]\nleft_floor = 1\nwall = "{wall}"\n' + LAW.format(gap=gap)
        for wall, gap in [("left", 0.01), ("right", 0.015)]
    ]
    return scene_of(folder, building("left", [0.1, 0.5], -0.1), *contacts)


def told(file):
    """The scene as pictures see it."""
    return harness.example("layout").Scene(file)


def test_contacts_by_heights(tmp_path):
    """Left floors at 0.5, 0.9, 1.3 m beside right ones at 0.65 and 0.9 m."""
    scene = told(facing(tmp_path))
    assert scene.name == "Scene" and scene.floors == {"left": 3, "right": 2}
    assert scene.levels["right"] == pytest.approx([0.05, 0.65, 0.9])
    names = ["left floor 1, columns of right storey 1", "right floor 1, columns of left storey 2", "floor 2 of both"]
    assert [contact.meeting for contact in scene.contacts] == names
    assert [contact.height for contact in scene.contacts] == pytest.approx([0.5, 0.65, 0.9])
    assert [contact.gap for contact in scene.contacts] == [0.004] * 3


@pytest.mark.parametrize("make", [facing, walls])
def test_edges_overlap_by_the_penetration(make, tmp_path):
    file = make(tmp_path)
    scene = told(file)
    harness.run(harness.SIMULATE, file, "--csv", tmp_path / "motion.csv", "--rows-per-impact", 4)
    with (tmp_path / "motion.csv").open() as lines:
        names = next(csv.reader(lines))
        columns = dict(zip(names, np.loadtxt(lines, delimiter=",", unpack=True)))
    run = harness.example("runs").Run(columns, [])
    for p, contact in enumerate(scene.contacts, 1):
        left, right = contact.edges(run)
        penetration = run[f"contact[{p}].penetration"]
        assert np.max(penetration) > 0.0
        assert np.max(np.abs(left - right - penetration)) < 1e-14


def test_columns_are_drawn_as_they_bend(tmp_path):
    scene = told(facing(tmp_path))
    contact = scene.contacts[1]
    position = contact.surfaces["left"]["position"]
    shares = {(side, floor): weight for side, floor, weight in contact.row}
    clamped = harness.example("layout").clamped
    assert position == pytest.approx(0.15 / 0.4)
    assert [shares["left", floor] for floor in (2, 1)] == pytest.approx([clamped(position), 1.0 - clamped(position)])


def test_one_building_between_walls(tmp_path):
    scene = told(walls(tmp_path))
    assert scene.floors == {"left": 2} and scene.bottom == -0.1 and scene.top == pytest.approx(0.5)
    names = ["left floor 1, wall on its left, level 0 m", "left floor 1, wall on its right, level 0 m"]
    assert [contact.name for contact in scene.contacts] == names


def test_without_heights_storeys_are_equally_high(tmp_path):
    left, right = building("left", [0.5, 0.4]), building("right", [0.6], has_levels=False)
    contact = "[[contact]]\nleft_floor = 2\nright_storey = 1\nright_position = 0.25\n" + LAW.format(gap=0.004)
    scene = told(scene_of(tmp_path, left, right, contact))
    assert not scene.has_levels and list(scene.levels["left"]) == [0, 1, 2]
    assert scene.contacts[0].name == "left floor 2, columns of right storey 1"
    assert scene.contacts[0].height_on("right", scene.levels) == 0.25


def test_what_is_no_scene_is_told(tmp_path):
    file = tmp_path / "scene.toml"
    file.write_text("name = 1\n")
    with pytest.raises(SystemExit, match="name = 1"):
        told(file)
