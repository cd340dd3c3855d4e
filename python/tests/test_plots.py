"""Pictures: what they know of a scene, that they show the numbers of the run, and the commands that make them."""

import sys

import matplotlib
import numpy as np
import pounding_fmu
import pytest
from matplotlib.figure import Figure
from pounding_fmu._scenes import read_scene
from pounding_fmu.__main__ import carry_out
from pounding_fmu.plots.animation import FRAMES_PER_SECOND
from pounding_fmu.plots.command import PICTURES, draw
from pounding_fmu.plots.devices import APART, BELOW, DRAWN
from pounding_fmu.plots.elevation import Elevation
from pounding_fmu.plots.layout import Layout, clamped
from pounding_fmu.plots.runs import Run, Runs
from pounding_fmu.plots.soil import Foot
from PIL import Image

FEUP = pounding_fmu.example_scene
RECORD = FEUP.parent.parent / "records" / "el_centro_1940_ns.csv"
LAW = {"gap": 0.004, "law": "hertz", "stiffness": 1e6}


def building(heights, **more):
    count = len(heights)
    keys = {"mass": [3.65] * count, "stiffness": [2910.0] * count, "damping": {"ratio": 0.02}, "height": heights}
    return {**keys, **more}


def scene_of(left, right=None, **more):
    sides = {"left": left} if right is None else {"left": left, "right": right}
    return {"name": "Scene", "stop_time": 8.0, "ground": {"record": str(RECORD)}, **sides, **more}


def facing():
    """Left floors at 0.5, 0.9, 1.3 m beside right ones at 0.65 and 0.9 m."""
    left, right = building([0.5, 0.4, 0.4]), building([0.6, 0.25], base_level=0.05)
    return scene_of(left, right, facing={**LAW, "level_tolerance": 0.02})


def walls():
    contacts = [{"left_floor": 1, **LAW, "wall": wall, "gap": gap} for wall, gap in [("left", 0.01), ("right", 0.015)]]
    return scene_of(building([0.1, 0.5], base_level=-0.1), contact=contacts)


def rigid():
    contact = {"left_floor": 2, "right_floor": 2, "gap": 0.004, "law": "stereomechanical", "restitution": 0.5}
    return scene_of(building([0.5, 0.5]), building([0.5, 0.5], mass=[1.0, 1.0]), contact=[contact])


def yields():
    left, right = building([0.5, 0.5], yield_force=[30.0, 40.0], post_yield_ratio=0.05), building([0.5, 0.5])
    return scene_of(left, right, contact=[{"left_floor": 2, "right_floor": 2, **LAW}])


def linked():
    """Friction between the roofs, a spring and a dashpot from left floor 1 to the ground on its right."""
    links = [
        {"left_floor": 2, "right_floor": 2, "stiffness": 3000.0, "slip_force": 2.0},
        {"left_floor": 1, "wall": "right", "stiffness": 100.0, "dashpot": 5.0},
    ]
    return {**yields(), "link": links}


def on_soil():
    """The left one sways and rocks and yields, the right one rocks; the upper left floor meets columns of the right one."""
    soil = {"mass": 2.0, "inertia": 0.3, "rocking": {"stiffness": 4e3, "dashpot": 8.0}}
    left = building([0.5, 0.5], yield_force=[30.0, 40.0], foundation={**soil, "sway": {"stiffness": 8e3}})
    contacts = [{"left_floor": 1, "right_floor": 1, **LAW}, {"left_floor": 2, "right_storey": 2, **LAW}]
    return scene_of(left, building([0.5, 0.8], foundation=soil), contact=contacts)


def row_of(names, stiffness, contacts=(), **more):
    """Buildings of two storeys of 0.5 m, of different stiffness."""
    row = [{"name": name, **building([0.5, 0.5], stiffness=[k, k])} for name, k in zip(names, stiffness)]
    return {"name": "Row", "stop_time": 8.0, "ground": {"record": str(RECORD)}, "building": row, "contact": [*contacts], **more}


def joint(left, right, gap, floor=2):
    return {**LAW, "left": left, "right": right, "left_floor": floor, "right_floor": floor, "gap": gap}


def row():
    """The third one is softer, and the last two meet hardest; a wall on the left of the last one within the last gap."""
    contacts = [joint("a", "b", 0.03), joint("b", "c", 0.002), joint("c", "d", 0.01), joint("c", "d", 0.014, floor=1)]
    wall = {**LAW, "right": "d", "right_floor": 1, "wall": "left", "gap": 0.008}
    link = {"left": "b", "right": "c", "left_floor": 1, "right_floor": 2, "stiffness": 100.0}
    return row_of("abcd", [2910.0, 2910.0, 1500.0, 2910.0], [*contacts, wall], link=[link])


def told(scene):
    return Layout(read_scene(scene))


def runs_of(scene, stop=8.0, *window):
    return Runs(read_scene(scene), stop, *window)


def panels(figure, label):
    """The axes whose vertical axis is called so."""
    return [axes for axes in figure.axes if axes.get_ylabel().startswith(label)]


def curves(axes):
    """What lines show, by their labels."""
    return {line.get_label(): line.get_xydata().T for line in axes.get_lines()}


def test_contacts_by_heights():
    scene = told(facing())
    assert scene.name == "Scene" and scene.floors == {"left": 3, "right": 2}
    assert scene.levels["right"] == pytest.approx([0.05, 0.65, 0.9])
    names = ["left floor 1, columns of right storey 1", "right floor 1, columns of left storey 2", "floor 2 of both"]
    assert [contact.meeting for contact in scene.contacts] == names
    assert [contact.height for contact in scene.contacts] == pytest.approx([0.5, 0.65, 0.9])
    assert [contact.gap for contact in scene.contacts] == [0.004] * 3


@pytest.mark.parametrize("make", [facing, walls, on_soil, row])
def test_edges_overlap_by_the_penetration(make):
    scene = make()
    run = Run(pounding_fmu.simulate(scene, rows_per_impact=4), set())
    for p, contact in enumerate(told(scene).contacts, 1):
        left, right = contact.edges(run)
        penetration = run[f"contact[{p}].penetration"]
        assert np.max(penetration) > 0.0
        assert np.max(np.abs(left - right - penetration)) < 1e-14


def test_columns_are_drawn_as_they_bend():
    contact = told(facing()).contacts[1]
    position = contact.surfaces["left"]["position"]
    shares = {(side, name): weight for side, name, weight in contact.row}
    assert position == pytest.approx(0.15 / 0.4)
    assert [shares["left", f"displacement[{floor}]"] for floor in (2, 1)] == pytest.approx([clamped(position), 1.0 - clamped(position)])


def test_one_building_between_walls():
    scene = told(walls())
    assert scene.floors == {"left": 2} and scene.bottom == -0.1 and scene.top == pytest.approx(0.5)
    names = ["left floor 1, wall on its left, level 0 m", "left floor 1, wall on its right, level 0 m"]
    assert [contact.name for contact in scene.contacts] == names


def test_without_heights_storeys_are_equally_high():
    left, right = building([0.5, 0.4]), building([0.6])
    del right["height"]
    contact = {"left_floor": 2, "right_storey": 1, "right_position": 0.25, **LAW}
    scene = told(scene_of(left, right, contact=[contact]))
    assert not scene.has_levels and list(scene.levels["left"]) == [0, 1, 2]
    assert scene.contacts[0].name == "left floor 2, columns of right storey 1"
    assert scene.contacts[0].height_on("right", scene.levels) == 0.25


def test_the_overview_shows_the_numbers_of_the_run():
    """Every row of a run of the user's own is on the curves, and the peaks are those of its table of impacts."""
    result = pounding_fmu.simulate(FEUP, stop=8, outputs=["time"])
    figure = pounding_fmu.plots.figure(result)
    again = pounding_fmu.simulate(FEUP, stop=8)
    (edges,), forces = panels(figure, "position [mm]"), panels(figure, "force [N]")[0]
    shown = curves(edges)
    for label, factor in [("left building", 0.0), ("right building", 5.0)]:
        at, position = shown[label]
        rows = np.searchsorted(at, again["time"])
        assert np.array_equal(at[rows], again["time"])
        side = label.split()[0]
        assert position[rows] == pytest.approx(1e3 * again[f"{side}.displacement[2]"] + factor, abs=1e-9)
    of_contact = again.impacts[again.impacts["contact"] == 2]
    assert np.array_equal(shown["impact"][0], of_contact["start_s"])
    dots = [line for line in forces.get_lines() if line.get_marker() == "."]
    assert np.array_equal(dots[1].get_ydata(), of_contact["peak_force"])
    assert curves(forces)["contact 2"][1].max() == pytest.approx(of_contact["peak_force"].max(), rel=1e-12)
    assert forces.get_ylim()[1] > again.impacts["peak_force"].max() and edges.get_xlim() == (0.0, 8.0)
    hardest = again.impacts[again.impacts["peak_force"].argmax()]
    said = f"{len(again.impacts)} impacts, the hardest with {hardest['peak_force']:.3g} N at contact {hardest['contact']}"
    assert said in figure.get_suptitle()


def test_drifts_are_least_and_largest():
    runs = runs_of(facing())
    axes = draw(runs, "drifts").axes[0]
    filled, low, high = (patch.get_data() for patch in axes.patches[:3])
    drift = 1e3 * np.diff([0 * runs.run.time, *(runs.run[f"left.displacement[{i}]"] for i in (1, 2, 3))], axis=0)
    assert low.values == pytest.approx(drift.min(axis=1)) and high.values == pytest.approx(drift.max(axis=1))
    assert np.array_equal(filled.edges, [0.0, 0.5, 0.9, 1.3])
    assert axes.get_xlim()[1] > max(abs(drift.min()), drift.max())


def test_loops_are_those_of_the_storeys_that_yield():
    runs = runs_of(yields())
    for figure in (draw(runs, "loops"), draw(runs, "overview")):
        axes = next(axes for axes in figure.axes if axes.get_title(loc="left").startswith("Left storey 1: ductility"))
        drift, shear = curves(axes)["left, pounding"]
        assert np.array_equal(drift, 1e3 * runs.run["left.displacement[1]"])
        assert np.array_equal(shear, runs.run["left.storey_shear[1]"])
        assert runs.run["left.ductility[1]"][-1] > 1
        assert f"{runs.run['left.ductility[1]'][-1]:.1f} ({runs.alone['left.ductility[1]'][-1]:.1f})" in axes.get_title(loc="left")


def test_drifts_on_soil_are_those_that_strain():
    """At every row at most the engine's peak, and that peak at some row, to what a step of 1 ms misses; the lean is larger."""
    runs = runs_of(on_soil())
    for side, count in runs.scene.floors.items():
        for storey in range(1, count + 1):
            drift = np.abs(runs.scene.drift(runs.run, side, storey))
            peak = pounding_fmu.simulate(on_soil(), outputs=[f"{side}.peak_drift[{storey}]"])[f"{side}.peak_drift[{storey}]"][-1]
            assert peak * (1 - 2e-3) < drift.max() <= peak * (1 + 1e-9)


def test_foundations_are_drawn_with_their_soil_and_move_with_it():
    """A lean of so many pixels upright is a slope of as many across: slabs stay at a right angle to it."""
    scene = told(on_soil())
    assert scene.foundations["left"]["sway"] == ["spring"] and scene.foundations["right"]["sway"] == []
    assert scene.foundations["right"]["rocking"] == ["spring", "dashpot"] and told(yields()).foundations == {}
    figure = Figure(figsize=(3.0, 6.0), dpi=100)
    axes = figure.subplots()
    elevation = Elevation(axes, scene, 100.0)
    axes.set(xlim=(-150.0, 150.0), ylim=(-0.5, 1.5))
    left, right = (elevation.foundations[side] for side in ("left", "right"))
    assert right.device is None and len(right.posts) == 4 == len(left.posts)
    before, post = left.device.get_xdata(), left.posts[0].get_xdata()
    lean = np.array([500.0 * 0.02, 1000.0 * 0.02])
    elevation.place({"left": 3.0 + lean, "right": np.zeros(2)}, {"left": Foot(3.0, 0.02)})
    figure.draw_without_rendering()
    after = left.device.get_xdata()
    assert np.nanmin(after) == np.nanmin(before) and np.nanmax(after) == pytest.approx(np.nanmax(before) + 3.0)
    # Its lower end stays in the pit, its upper one goes with the block.
    assert left.posts[0].get_xdata()[0] == post[0] and np.nanmin(left.posts[0].get_ydata()) == pytest.approx(left.bottom)
    columns = [axes.transData.transform(column.get_xy()) for column in elevation.buildings["left"].columns]
    for slab in [*elevation.buildings["left"].slabs, left.block]:
        corners = axes.transData.transform(slab.get_xy())
        along = corners[1] - corners[0]
        for column in columns:
            up = column[len(column) // 2 - 2] - column[0]
            assert along @ up == pytest.approx(0.0, abs=1e-6 * np.hypot(*along) * np.hypot(*up))
        assert along[1] < -1.0
    # What they stand on is the tilted block.
    for column, share in zip(columns, [0.085, 0.915]):
        corners = axes.transData.transform(left.block.get_xy())
        assert column[0][1] == pytest.approx(corners[3][1] + share * (corners[2] - corners[3])[1], abs=0.5)
    slab = elevation.buildings["right"].slabs[0].get_xy()
    assert slab[0][1] == slab[1][1]


def test_links_of_a_scene():
    scene = told(linked())
    assert [link.name for link in scene.links] == ["floor 2 of both", "left floor 1, ground on its right"]
    assert [link.parts for link in scene.links] == [["friction"], ["spring", "dashpot"]]
    assert told(yields()).links == []


def test_loops_of_links_show_their_forces():
    """Friction without hardening pushes with its slip force at most; it reaches that both ways."""
    runs = runs_of(linked())
    figure = draw(runs, "loops")
    titles = [axes.get_title(loc="left").splitlines() for axes in figure.axes]
    (axes,) = (axes for axes, title in zip(figure.axes, titles) if title and title[0] == "Link 1, floor 2 of both")
    displacement, force = curves(axes)["link, pounding"]
    moved = [runs.run[f"{side}.displacement[2]"] for side in ("left", "right")]
    assert displacement == pytest.approx(1e3 * (moved[0] - moved[1]), abs=1e-9)
    assert force.max() == pytest.approx(2.0, rel=1e-12) and force.min() == pytest.approx(-2.0, rel=1e-12)
    assert ["Link 1, floor 2 of both", "friction: 2 N (2 N)"] in titles
    assert [title for title in titles if title and title[0].startswith("Link 2, left floor 1, ground")]
    assert sum(bool(title) and "storey" in title[0] for title in titles) == 2
    assert not any(axes.get_title(loc="left").startswith("Link") for axes in draw(runs_of(yields()), "loops").axes)


def test_links_are_drawn_between_the_floors_and_move_with_them():
    """The gap is 4 mm at rest. An end on the ground stays where it is; a link below another one hangs lower."""
    scene = told({**linked(), "link": [*linked()["link"], {"left_floor": 2, "right_floor": 1, "dashpot": 1.0}]})
    elevation = Elevation(Figure().subplots(), scene, 100.0)
    across = [device.get_xdata() for device in elevation.devices]
    elevation.place({"left": np.array([3.0, 7.0]), "right": np.array([-2.0, -5.0])})
    for device, before, (left, right) in zip(elevation.devices, across, [(7.0, -5.0), (3.0, 0.0), (7.0, -2.0)]):
        after = device.get_xdata()
        assert np.nanmin(after) - np.nanmin(before) == pytest.approx(left)
        assert np.nanmax(after) - np.nanmax(before) == pytest.approx(right)
    assert np.nanmin(across[0]) < 0.0 and np.nanmax(across[0]) > 4.0
    first, _, third = (device.get_ydata() for device in elevation.devices)
    assert np.nanmax(first) == 1.0 and np.nanmin(third) == pytest.approx(0.5 - 0.5 * (BELOW + APART))


def test_what_is_skew_is_drawn_upright_to_its_line():
    """A spring from an upper floor down to a lower one, in pixels: its bends are evenly spaced along it and equally far aside."""
    scene = told({**linked(), "link": [{"left_floor": 2, "right_floor": 1, "stiffness": 1.0}]})
    figure = Figure(figsize=(3.0, 6.0), dpi=100)
    axes = figure.subplots()
    (spring,) = Elevation(axes, scene, 100.0).devices
    axes.set(xlim=(-150.0, 150.0), ylim=(0.0, 1.1))
    figure.draw_without_rendering()
    at = axes.transData.transform(spring.get_xydata())
    first = next(i for i in range(6, len(at)) if not np.isnan(at[i]).any())
    begin, *_, end = points = at[first : first + 12]
    along = (end - begin) / np.hypot(*(end - begin))
    assert abs(along[1]) > 0.8
    bends = points[2:-2] - begin
    assert np.diff(bends @ along) == pytest.approx(np.full(7, np.diff(bends @ along).mean()), rel=1e-9)
    aside = bends @ [-along[1], along[0]]
    assert aside == pytest.approx([aside[0], -aside[0]] * 4, rel=1e-9) and abs(aside[0]) > 3.0


@pytest.mark.parametrize("length", [5.0, 10.0, 20.0])
def test_a_piston_stays_in_its_cup(length):
    (_, end), piston, cup, (bottom, _) = DRAWN["dashpot"](length, 10.0)
    assert cup[0][0] < piston[0][0] == end[0] < cup[1][0] == bottom[0] < length
    assert length != 10.0 or end[0] == pytest.approx((cup[0][0] + cup[1][0]) / 2)


def test_rigid_contacts_are_drawn_by_impulses():
    runs = runs_of(rigid())
    largest = runs.run.impacts["impulse"].max()
    assert runs.run.hardest()["impulse"] == largest
    figure = draw(runs, "overview")
    assert f"the hardest with {largest:.3g} N s" in figure.get_suptitle()
    (axes,) = panels(figure, "impulse")
    tops = [segment[1][1] for segment in axes.collections[0].get_segments()]
    assert np.array_equal(tops, runs.run.impacts["impulse"])


@pytest.mark.parametrize("make", [facing, walls, rigid, yields, linked, on_soil])
def test_nothing_runs_off_a_picture(make):
    runs = runs_of(make())
    for name in PICTURES:
        try:
            figure = draw(runs, name)
        except ValueError as error:
            assert f"no picture of {name}" in str(error)
            continue
        figure.draw_without_rendering()
        page = figure.bbox.padded(1.0)
        texts = [axes.title for axes in figure.axes] + [axes._left_title for axes in figure.axes]
        texts += [label for axes in figure.axes for label in (axes.xaxis.label, axes.yaxis.label)]
        texts += [figure._suptitle] if figure._suptitle else []
        for text in texts:
            box = text.get_window_extent()
            assert not text.get_text() or (page.contains(*box.min) and page.contains(*box.max)), (name, text.get_text())


def test_nothing_of_matplotlib_stays_changed():
    import matplotlib.pyplot as plt

    before = dict(matplotlib.rcParams)
    pounding_fmu.simulate(FEUP, stop=3).plot()
    assert dict(matplotlib.rcParams) == before and plt.get_fignums() == []


def plot(*arguments, command="command"):
    return carry_out(f"plots.{command}", [str(argument) for argument in arguments])


@pytest.mark.parametrize(
    "suffix, begins", [(".png", b"\x89PNG"), (".svg", b"<?xml"), (".pdf", b"%PDF"), (".PNG", b"\x89PNG")]
)
def test_a_file_of_each_format(suffix, begins, tmp_path, capsys):
    file = tmp_path / f"run{suffix}"
    assert plot(FEUP, "--stop", 3, "-o", file) == 0
    assert capsys.readouterr() == (f"{file}\n", "")
    first = file.read_bytes()
    assert first.startswith(begins)
    assert plot(FEUP, "--stop", 3, "-o", file) == 0
    # In an SVG names of parts may differ.
    assert suffix == ".svg" or file.read_bytes() == first


def test_pictures_by_name(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert plot(FEUP, "--stop", 3, "--picture", "floors", "loops") == 0
    out, err = capsys.readouterr()
    assert out == "FeupFrames_floors.png\n" and "no picture of loops" in err
    assert [file.name for file in tmp_path.iterdir()] == ["FeupFrames_floors.png"]
    assert plot(FEUP, "--stop", 3, "--picture", "loops") == 1


def test_what_is_shown(tmp_path):
    figure = pounding_fmu.plots.figure(pounding_fmu.simulate(FEUP, stop=6), 2, 4)
    assert panels(figure, "position [mm]")[0].get_xlim() == (2.0, 4.0)
    runs = runs_of(FEUP, 20.0)
    impacts = runs.run.impacts
    total = lambda start: impacts["impulse"][(impacts["start_s"] >= start) & (impacts["start_s"] < start + 5)].sum()  # noqa: E731
    start, end = runs.window
    assert end - start == 5.0 and total(start) >= max(map(total, range(16))) > total(0)


@pytest.mark.parametrize(
    "arguments, said",
    [
        (["-o", "run.jpg"], "run.jpg: expected a name that ends in .png, .svg, .pdf"),
        (["-o", "nowhere/run.png"], "run.png: expected a folder that is there"),
        (["--from", 2, "--to", 1], "from = 2: expected a time before 1 s"),
        (["--from", 3], "from = 3: expected a time before 3 s"),
        (["--to", 3.5], "to = 3.5: expected a time within the run, from 0 to 3 s"),
        (["--from", -1], "from = -1: expected a time within the run"),
        (["--from", "nan"], "from = nan: expected a time within the run"),
        (["--record", "none.csv"], "none.csv"),
    ],
)
def test_mistakes(arguments, said, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert plot(FEUP, "--stop", 3, *arguments) == 1
    out, err = capsys.readouterr()
    assert out == "" and err.startswith("error: ") and said in err and err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_what_cannot_be_drawn(tmp_path, capsys):
    scene = tmp_path / "still.toml"
    keys = "mass = [1.0]\nstiffness = [100.0]\ndamping = { ratio = 0.05 }\n"
    contact = '[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 0.01\nlaw = "linear"\nstiffness = 1e4\n'
    scene.write_text(f'name = "Still"\n[left]\n{keys}[right]\n{keys}{contact}')
    assert plot(scene, "--stop", 1, "-o", tmp_path / "x.png") == 1
    assert "nothing moves in this scene: give it a ground motion with --record FILE" in capsys.readouterr().err
    assert plot(scene, "--stop", 1, "-o", tmp_path / "x.png", "--record", RECORD) == 0
    assert plot(scene, "-o", tmp_path / "y.png", "--picture", "contacts") == 0
    scene.write_text("name = 1\n")
    assert plot(scene) == 1 and "name = 1" in capsys.readouterr().err
    assert plot(tmp_path / "none.toml") == 1 and "none.toml" in capsys.readouterr().err


@pytest.mark.parametrize("arguments", [[], [FEUP, "--from", "soon"], [FEUP, "--picture", "cats"]])
def test_wrong_usage(arguments):
    assert plot(*arguments) == 2


@pytest.mark.parametrize("command", ["command", "animate"])
def test_without_matplotlib(command, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    assert plot(FEUP, command=command) == 1
    assert 'pip install "pounding-fmu[plot]"' in capsys.readouterr().err
    with pytest.raises(ImportError, match="pip install"):
        pounding_fmu.simulate(FEUP, stop=1).plot()


def test_an_animation(tmp_path, capsys):
    file = tmp_path / "run.gif"
    assert plot(FEUP, "-o", file, "--from", 2.6, "--to", 3, "--speed", 0.5, command="animate") == 0
    frames = round(0.4 / 0.5 * FRAMES_PER_SECOND)
    assert f"{frames} frames" in capsys.readouterr().out
    with Image.open(file) as film:
        # What stays the same for longer is one image.
        durations = [film.seek(frame) or film.info["duration"] for frame in range(film.n_frames)]
    assert sum(durations) == frames * 1000 // FRAMES_PER_SECOND
    for arguments, said in [
        (["-o", tmp_path / "run.avi"], "expected a name that ends in .gif or .mp4"),
        (["--speed", 0], "speed = 0: expected a finite number > 0"),
    ]:
        assert plot(FEUP, *arguments, command="animate") == 1
        assert said in capsys.readouterr().err


def test_a_film_needs_ffmpeg(tmp_path, monkeypatch, capsys):
    """A coder that is there gets every frame in raw pixels; without one that is said."""
    monkeypatch.setenv("PATH", str(tmp_path))
    film = ["-o", tmp_path / "run.mp4", "--from", 2.6, "--to", 2.8]
    assert plot(FEUP, *film, command="animate") == 1
    assert "MP4 needs ffmpeg, which is not installed" in capsys.readouterr().err
    coder = tmp_path / "ffmpeg"
    coder.write_text(f"#!{sys.executable}\nimport sys\nopen(sys.argv[-1][5:], 'wb').write(sys.stdin.buffer.read())\n")
    coder.chmod(0o755)
    assert plot(FEUP, *film, command="animate") == 0
    assert (tmp_path / "run.mp4").stat().st_size == 8 * 520 * 460 * 3
    coder.write_text(f"#!{sys.executable}\nimport sys\nsys.exit('no such coder')\n")
    assert plot(FEUP, *film, command="animate") == 1
    assert "ffmpeg could not write it: no such coder" in capsys.readouterr().err


def test_a_picture_says_which_storey_fell_and_when():
    runs = runs_of(FEUP.with_name("leaning.toml"), 25.0)
    assert runs.collapse(runs.run) is None
    side, storey, time = runs.collapse(runs.alone)
    assert (side, storey) == ("left", 1) and abs(time - 19.661357) < 1e-6
    titles = [axes.get_title(loc="left") for axes in draw(runs, "loops").axes]
    assert titles[0].endswith("(50.0, fell at 19.7 s)") and "fell" not in titles[1], titles


def test_a_row_stands_with_its_gaps():
    """From the right edge of a slab to the next building's left one it is the gap there, above and below the contacts as at
    them, between them on a line."""
    scene = told(row())
    elevation = Elevation(Figure().subplots(), scene, 100.0)
    edges = elevation.edges
    assert scene.names == list(edges) == ["a", "b", "c", "d"]
    gaps = {pair: edges[pair[1]] - edges[pair[0]] - 100.0 for pair in ("ab", "bc", "cd")}
    assert gaps["ab"] == pytest.approx([30.0, 30.0]) and gaps["bc"] == pytest.approx([2.0, 2.0])
    assert gaps["cd"] == pytest.approx([14.0, 10.0]) and elevation.ends() == (-100.0, pytest.approx(346.0))
    assert elevation.faces == pytest.approx([0.0, 130.0, 232.0, 232.0, 238.0])


def test_a_wall_in_a_row_stands_within_the_gap():
    """Its face is 8 mm from the building, of a gap of 14 mm there."""
    scene = told(row())
    axes = Figure().subplots()
    elevation = Elevation(axes, scene, 100.0)
    before = len(axes.patches)
    elevation.draw_surroundings(axes, (-150.0, 400.0))
    (wall,) = axes.patches[before:]
    near, far = wall.get_x() + np.array([0.0, wall.get_width()])
    assert near == pytest.approx(238.0) and 232.0 < far < 238.0


def test_links_of_a_row_move_with_its_floors():
    scene = told(row())
    assert scene.links[0].name == "b floor 1, c floor 2"
    elevation = Elevation(Figure().subplots(), scene, 100.0)
    (device,) = elevation.devices
    before = device.get_xdata()
    moved = dict.fromkeys("ad", np.zeros(2)) | {"b": np.array([3.0, 9.0]), "c": np.array([-4.0, 5.0])}
    elevation.place(moved)
    after = device.get_xdata()
    assert np.nanmin(after) - np.nanmin(before) == pytest.approx(3.0)
    assert np.nanmax(after) - np.nanmax(before) == pytest.approx(5.0)
    # From within b, whose right edge is at 130 mm, to within c, which begins 2 mm from there.
    assert np.nanmin(before) == pytest.approx(110.0) and np.nanmax(before) == pytest.approx(152.0)


def test_charts_of_a_row_are_of_its_hardest_impact():
    runs = runs_of(row())
    impacts = pounding_fmu.simulate(row()).impacts
    hardest = impacts[impacts["peak_force"].argmax()]
    assert hardest["contact"] == 3 and runs.buildings == ["c", "d"] and runs.contacts == [3, 4, 5]
    figure = draw(runs, "overview")
    assert f"{len(impacts)} impacts, {(impacts['contact'] > 2).sum()} of them at c and d" in figure.get_suptitle()
    (edges,) = panels(figure, "position [mm]")
    position = curves(edges)["d"][1]
    assert position == pytest.approx(10.0 + 1e3 * runs.run["d.displacement[2]"], abs=1e-9)
    titles = [axes.get_title(loc="left") for axes in draw(runs, "drifts").axes]
    assert titles == ["c", "d"]
    assert [text.get_text() for text in figure.axes[0].get_xticklabels()] == ["a", "b", "c", "d"]


def test_buildings_that_are_named_are_charted():
    """Neighbours with the contacts between them; others with all that they have."""
    named = lambda *names: Runs(read_scene(row()), 8.0, None, None, names)  # noqa: E731
    assert (named("d", "c").buildings, named("d", "c").contacts) == (["c", "d"], [3, 4, 5])
    assert (named("a", "c").buildings, named("a", "c").contacts) == (["a", "c"], [1, 2, 3, 4])
    assert (named("d").buildings, named("d").contacts) == (["d"], [5])
    axes = draw(named("d", "c"), "accelerations").axes[0]
    assert axes.get_title(loc="left").startswith("Floor 2, c: up to")
    for names, said in [(("e",), "e: the scene has no such building; expected one or two of a, b, c, d"), (tuple("abc"), "buildings = a b c")]:
        with pytest.raises(ValueError, match=said):
            named(*names)
    figure = pounding_fmu.simulate(row(), stop=2).plot(picture="drifts", buildings="d")
    assert [axes.get_title(loc="left") for axes in figure.axes] == ["d"]


def test_the_command_charts_the_buildings_that_it_is_told(tmp_path, capsys):
    assert plot(FEUP, "--stop", 1, "--buildings", "middle", "-o", tmp_path / "x.png") == 1
    assert "buildings: middle: the scene has no such building; expected one or two of left, right" in capsys.readouterr().err
    assert plot(FEUP, "--stop", 3, "--buildings", "left", "-o", tmp_path / "x.png") == 0


def test_eight_buildings_are_told_apart():
    """By eyes of every kind, as Machado, Oliveira and Fernandes (2009) model them, in CIELAB; and in grey by their lines."""
    blind = {
        "none": np.eye(3),
        "protan": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
        "deutan": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
        "tritan": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
    }

    def lab(linear):
        xyz = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]) @ linear
        x, y, z = np.cbrt(np.clip(xyz / [0.95047, 1.0, 1.08883], 1e-9, None))
        return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])

    looks = list(told(row_of([f"n{i}" for i in range(9)], [2910.0] * 9)).looks.values())
    assert looks[8] == looks[0] and len({str(look["linestyle"]) for look in looks[:8]}) == 8
    rgb = np.array([matplotlib.colors.to_rgb(look["color"]) for look in looks[:8]])
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    for seen in blind.values():
        colours = [lab(np.clip(np.array(seen) @ colour, 0.0, 1.0)) for colour in linear]
        apart = [np.linalg.norm(one - other) for i, one in enumerate(colours) for other in colours[:i]]
        assert min(apart) > 13.0
