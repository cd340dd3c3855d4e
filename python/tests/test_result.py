"""What a run says of itself: summary, columns, rows within impacts, table, notebook."""

import os
import re
import subprocess
import sys

import fmus
import numpy as np
import pounding_fmu
import pytest
from test_command import run
from test_commands import SCENES


def without(package, folder):
    """An environment in which a package is not installed."""
    (folder / "sitecustomize.py").write_text(
        f"import sys\nclass No:\n    def find_spec(self, name, *_):\n"
        f"        if name.partition('.')[0] == {package!r}: raise ModuleNotFoundError(name=name)\n"
        f"sys.meta_path.insert(0, No())\n"
    )
    paths = [str(folder), *filter(None, [os.environ.get("PYTHONPATH")])]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(paths)}


def untimed(text):
    return re.sub(r"solved in [0-9.]+ ms|solve_seconds=.*\n", "", text)


def told(*arguments):
    """What the command prints; of the scene that may fall it warns."""
    done = run(*arguments)
    assert done.returncode == 0 and all(line.startswith("warning: left.p_delta") for line in done.stderr.splitlines())
    return done.stdout


@pytest.mark.parametrize("name", SCENES)
def test_the_summary_is_that_of_the_command(name, tmp_path):
    """What the FMU shows, `simulate` and the module say with the same words and digits."""
    scene = fmus.EXAMPLES / "scenes" / f"{name}.toml"
    lines = told(scene, "-o", tmp_path / "x.fmu").splitlines(keepends=True)
    of_the_fmu = [line for line in lines if not line.startswith(("  file ", "  guid ", "  libraries "))]
    assert len(lines) - len(of_the_fmu) == 3
    summary = pounding_fmu.simulate(scene, outputs=[]).summary()
    assert untimed("".join(of_the_fmu)) == untimed(summary) == untimed(told("simulate", scene))
    assert untimed(told("simulate", scene, "--rows-per-impact", "4")) == untimed(summary)


def test_the_summary_is_of_the_run():
    result = pounding_fmu.simulate(fmus.FEUP, stop=5, parameters={"contact[1].gap": 0.012})
    lines = result.summary().splitlines()
    assert any("0 s to 5 s (as asked), 500 steps of 0.01 s" in line for line in lines)
    assert any("gaps from 5 mm to 12 mm" in line for line in lines)
    assert f"  impacts      {len(result.impacts)}" in lines


def test_columns_that_there_are_not():
    result = pounding_fmu.simulate(fmus.FEUP, stop=1, outputs=["left.displacement[1]"])
    for name, said in {
        "left.displacment[1]": "the run has no such column; did you mean left.displacement[1]?",
        "contact[1].gap": "not among the outputs of this run",
        "left.dis": "did you mean left.displacement[1]?",
        "time ": "did you mean time?",
    }.items():
        with pytest.raises(KeyError, match=re.escape(said)):
            result[name]
        assert name not in result and result.get(name) is None


def test_rows_within_impacts():
    coarse, fine = (pounding_fmu.simulate(fmus.FEUP, stop=5, rows_per_impact=rows) for rows in (None, 8))
    regular = np.isin(fine["time"], coarse["time"])
    assert all(fmus.same_bits(fine[name][regular], coarse[name]) for name in coarse)
    for impact in fine.impacts:
        within = (fine["time"] > impact["start_s"]) & (fine["time"] < impact["end_s"])
        assert within.sum() >= 11
    with pytest.raises(ValueError, match="rows_per_impact = -1: expected a whole number >= 0"):
        pounding_fmu.simulate(fmus.FEUP, rows_per_impact=-1)


def test_without_contacts():
    scene = fmus.feup().split("[[contact]]")[0]
    alone = pounding_fmu.simulate(fmus.FEUP, stop=5, without_contacts=True)
    with pytest.warns(pounding_fmu.SceneWarning, match="no contact"):
        bare = pounding_fmu.simulate(scene, stop=5)
    assert len(alone.impacts) == 0 and not any(name.startswith("contact[") for name in alone)
    assert all(fmus.same_bits(alone[name], bare[name]) for name in bare)


def test_a_dataframe():
    result = pounding_fmu.simulate(fmus.FEUP, stop=1)
    frame = result.to_dataframe()
    assert list(frame.columns) == list(result) and frame.columns[0] == "time"
    assert all(fmus.same_bits(frame[name].to_numpy(), result[name]) for name in result)
    assert frame["contact[1].active"].dtype == bool


def test_in_a_notebook(tmp_path):
    scene = fmus.feup('name = "FeupFrames"', 'name = "FeupFrames"\n')
    text = pounding_fmu.simulate(scene, stop=5)._repr_html_()
    assert "<b>FeupFrames</b>" in text and "<td>28</td>" in text and "data:image/png;base64,iVBOR" in text
    nothing = pounding_fmu.simulate(scene, stop=1, outputs=[])._repr_html_()
    assert "<td>0</td>" in nothing and "<img" not in nothing
    code = f"import pounding_fmu as p; t = p.simulate({scene!r}, stop=5)._repr_html_(); assert '28' in t and 'img' not in t"
    subprocess.run([sys.executable, "-c", code], env=without("matplotlib", tmp_path), check=True)


@pytest.mark.parametrize(
    ("package", "call", "line"),
    [
        ("matplotlib", "plot", 'pip install "pounding-fmu[plot]"'),
        ("pandas", "to_dataframe", "pip install pandas"),
    ],
)
def test_what_is_not_installed_is_named(package, call, line, tmp_path):
    code = f"import pounding_fmu as p\ntry: p.simulate(p.example_scene, stop=1).{call}()\nexcept ImportError as e: print(e)"
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, env=without(package, tmp_path), capture_output=True, text=True)
    assert done.stdout == f"this needs {package}, which is not installed: {line}\n", done.stderr


def test_a_long_row_has_a_line_for_each_building():
    """With the largest of its floors; and a line for the hardest contacts, which have the largest forces."""
    house = {"mass": [1.5e5, 1.2e5], "damping": {"ratio": 0.05}, "height": [3.0, 3.0]}
    row = [{**house, "stiffness": [4e7 + 1e7 * i, 4e7]} for i in range(13)]
    facing = {"gap": 0.002, "law": "linear", "stiffness": 5e8}
    ground = {"record": str(pounding_fmu.example_scene.parent.parent / "records" / "el_centro_1940_ns.csv")}
    result = pounding_fmu.simulate({"name": "Long", "building": row, "facing": facing, "ground": ground})
    tables = [table.splitlines() for table in result.summary().split("\n\n")]
    (floors,) = (table for table in tables if table[0].split()[:2] == ["building", "floors"])
    for place in (1, 7, 13):
        (line,) = (line.split() for line in floors if line.split()[:1] == [f"b{place}"])
        peaks = [result[f"b{place}.peak_{what}[{i}]"][-1] for what in ("displacement", "acceleration", "drift") for i in (1, 2)]
        largest = [max(peaks[at : at + 2]) for at in (0, 2, 4)]
        assert [float(number) for number in line[1:5]] == pytest.approx([2, *largest], rel=1e-4)
    (contacts,) = (table[2:] for table in tables if table[0].split()[:2] == ["hardest", "contacts"])
    named = [re.match(r"  contact (\d+): between b(\d+) floor ([12]) and b(\d+) floor ([12]) ", line) for line in contacts]
    told = {int(match[1]) for match in named}
    assert all(int(match[2]) + 1 == int(match[4]) and match[3] == match[5] for match in named)
    forces = sorted((result[f"contact[{p}].peak_force"][-1] for p in range(1, 25)), reverse=True)
    assert len(told) == 20 and min(result[f"contact[{p}].peak_force"][-1] for p in told) == forces[19]
