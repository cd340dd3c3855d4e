"""Commands for everybody: the help, the examples, records, reports; and what a run says of itself."""

import os
import re
import signal
import subprocess
import sys
import time
from fractions import Fraction

import fmus
import numpy as np
import pounding_fmu
import pytest
from pounding_fmu.__main__ import COMMANDS
from pounding_fmu.record import Motion
from test_command import run, well

SCENES = ["feup", "isolated", "neighbours", "offices", "two_blocks", "yielding"]


def without(package, folder):
    """An environment in which a package is not installed."""
    (folder / "sitecustomize.py").write_text(
        f"import sys\nclass No:\n    def find_spec(self, name, *_):\n"
        f"        if name.partition('.')[0] == {package!r}: raise ModuleNotFoundError(name=name)\n"
        f"sys.meta_path.insert(0, No())\n"
    )
    paths = [str(folder), *filter(None, [os.environ.get("PYTHONPATH")])]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(paths)}


def test_the_help_names_every_command_with_an_example():
    text = well("--help")
    for name, about, example, _ in COMMANDS:
        assert f"  {name:<12}{about}\n" in text and f"pounding-fmu {example}\n" in text
    assert "--platform" in text and max(map(len, text.partition("Options of")[0].splitlines())) < 90
    assert text == well("-h") == well("help")


@pytest.mark.parametrize("name", [command.name for command in COMMANDS[1:]])
def test_every_command_has_a_help(name):
    text = well(name, "--help")
    assert f"pounding-fmu {name}" in text and text == well("help", name)


@pytest.mark.parametrize(
    ("word", "said"),
    [
        ("studdy", "studdy: no such command; did you mean study? A scene is a file, such as studdy.toml"),
        ("simulat", "simulat: no such command; did you mean simulate?"),
        ("xyzzy", "xyzzy: no such command; pounding-fmu --help lists them."),
    ],
)
def test_words_that_are_no_command(word, said, tmp_path):
    done = run(word, "x.toml", cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, "") and done.stderr.startswith(f"error: {said}")


@pytest.mark.parametrize("word", ["studdy.toml", "./studdy", "folder/scene.TOML"])
def test_words_that_are_scenes(word, tmp_path):
    done = run(word, cwd=tmp_path)
    assert done.returncode == 1 and "No such file" in done.stderr and "command" not in done.stderr


def test_a_scene_may_be_called_anything(tmp_path):
    (tmp_path / "studdy").write_text("name = 3")
    assert "is not a scene that can be built" in run("studdy", cwd=tmp_path).stderr


def test_a_reader_that_has_seen_enough(tmp_path):
    command = f"{sys.executable} -m pounding_fmu record {fmus.RECORD} | head -1"
    done = subprocess.run(command, shell=True, capture_output=True, text=True)
    assert (done.stdout, done.stderr) == (f"{fmus.RECORD}\n", "")


@pytest.mark.skipif(os.name == "nt", reason="no SIGINT for another process")
def test_ctrl_c_in_a_command_in_python(tmp_path):
    code = "import time\ndef main(arguments):\n    print('on', flush=True)\n    time.sleep(60)\n"
    start = f"import sys, types; m = types.ModuleType('m'); exec({code!r}, m.__dict__); import pounding_fmu.__main__ as c"
    start += "; sys.modules['pounding_fmu.record'] = m; sys.argv[1:] = ['record', 'x']; sys.exit(c.main())"
    process = subprocess.Popen([sys.executable, "-c", start], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "on\n"
    time.sleep(0.2)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=20)
    assert (process.returncode, errors) == (130, "")


def test_a_bug_is_one_line(monkeypatch, capsys):
    from pounding_fmu import __main__, example

    monkeypatch.setattr(example, "scenes", lambda: 1 / 0)
    assert __main__.carry_out("example", []) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("error: pounding-fmu has met a bug of its own (ZeroDivisionError: ")


def test_examples_are_listed():
    lines = well("example").splitlines()
    assert [line.split()[0] for line in lines[: len(SCENES)]] == SCENES
    assert all(len(line.split()) > 1 for line in lines[: len(SCENES)])
    assert any(line.startswith("offices ") and "Office buildings of five and three storeys" in line for line in lines)


@pytest.mark.parametrize("name", SCENES)
def test_an_example_runs_where_it_is_written(name, tmp_path):
    """With the bits of the scene in the package."""
    said = well("example", name, "-o", "a folder", cwd=tmp_path).splitlines()
    scene = tmp_path / "a folder" / f"{name}.toml"
    assert said[-1] == f'go on with: pounding-fmu "a folder/{name}.toml"'
    assert {tmp_path / line for line in said[:-1]} == {file for file in tmp_path.rglob("*") if file.is_file()}
    written, packaged = (pounding_fmu.simulate(path) for path in (scene, fmus.EXAMPLES / "scenes" / f"{name}.toml"))
    assert list(written) == list(packaged)
    assert all(fmus.same_bits(written[column], packaged[column]) for column in written)


def test_an_example_is_written_over_nothing(tmp_path):
    well("example", "feup", cwd=tmp_path)
    well("example", "offices.toml", cwd=tmp_path)  # the record that is there is the same
    (tmp_path / "feup.toml").write_text("mine")
    done = run("example", "feup", cwd=tmp_path)
    assert done.returncode == 1 and done.stderr.startswith("error: feup.toml: already there")
    assert (tmp_path / "feup.toml").read_text() == "mine"
    (tmp_path / "records/el_centro_1940_ns.csv").write_text("mine")
    done = run("example", "yielding", cwd=tmp_path)
    assert done.returncode == 1 and "el_centro_1940_ns.csv: already there" in done.stderr
    assert not (tmp_path / "yielding.toml").exists()


def test_no_such_example(tmp_path):
    done = run("example", "ofices", cwd=tmp_path)
    assert done.returncode == 1 and "ofices: there is no such example; did you mean offices?" in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_a_report_of_a_scene(tmp_path):
    assert well("report", fmus.FEUP, cwd=tmp_path).startswith("FeupFrames.html: ")
    well("simulate", fmus.FEUP, "--html", "other.html", cwd=tmp_path)
    assert (tmp_path / "FeupFrames.html").read_bytes() == (tmp_path / "other.html").read_bytes()
    well("report", fmus.FEUP, "-o", "here.html", cwd=tmp_path)
    assert (tmp_path / "here.html").is_file()
    done = run("report", fmus.FEUP, "-o", "no/such/place.html", cwd=tmp_path)
    assert done.returncode == 1 and "cannot write no/such/place.html" in done.stderr
    done = run("report", "missing.toml", cwd=tmp_path)
    assert done.returncode == 1 and "missing.toml" in done.stderr


def untimed(text):
    return re.sub(r"solved in [0-9.]+ ms|solve_seconds=.*\n", "", text)


@pytest.mark.parametrize("name", SCENES)
def test_the_summary_is_that_of_the_command(name, tmp_path):
    """What the FMU shows, `simulate` and the module say with the same words and digits."""
    scene = fmus.EXAMPLES / "scenes" / f"{name}.toml"
    lines = well(scene, "-o", tmp_path / "x.fmu").splitlines(keepends=True)
    of_the_fmu = [line for line in lines if not line.startswith(("  file ", "  guid ", "  libraries "))]
    assert len(lines) - len(of_the_fmu) == 3
    summary = pounding_fmu.simulate(scene, outputs=[]).summary()
    assert untimed("".join(of_the_fmu)) == untimed(summary) == untimed(well("simulate", scene))
    assert untimed(well("simulate", scene, "--rows-per-impact", "4")) == untimed(summary)


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


def test_read_record():
    time, acceleration = pounding_fmu.read_record(fmus.RECORD)
    rows = [line.split(",") for line in fmus.RECORD.read_text().splitlines() if line[0].isdigit()]
    assert time.dtype == acceleration.dtype == np.float64
    assert time.tolist() == [float(row[0]) for row in rows]
    assert acceleration.tolist() == [float(row[1]) for row in rows]
    with pytest.raises(FileNotFoundError, match="missing.csv"):
        pounding_fmu.read_record("missing.csv")


UNEVEN = "time_s,accel_m_s2\n0.5,0\n0.75,1.1\n1.5,-0.3\n1.625,0.7\n"


def test_a_record_is_shown(tmp_path):
    (tmp_path / "uneven.csv").write_text(UNEVEN)
    text = well("record", "uneven.csv", cwd=tmp_path)
    for line in [
        "  samples     4, uneven, 0.125 s to 0.75 s apart",
        "  duration    1.125 s, from 0.5 s to 1.625 s",
        "  peak        1.1 m/s2, 0.1122 g, at 0.75 s",
        "  lowest      -0.3 m/s2, -0.03059 g, at 1.5 s",
    ]:
        assert line in text.splitlines(), text
    even = well("record", fmus.RECORD)
    assert "1560, every 0.02 s (50 Hz)" in even and "about 0\n" in even and "not about 0" not in even


def test_arias_intensity_is_the_integral():
    """Of the square of straight lines, in exact arithmetic."""
    time, acceleration = [0, Fraction(1, 4), 1, Fraction(9, 8)], [0, Fraction(11, 8), Fraction(-3, 8), Fraction(3, 4)]
    integral = sum(
        (t1 - t0) * (a0 * a0 + a0 * a1 + a1 * a1) / 3
        for t0, t1, a0, a1 in zip(time, time[1:], acceleration, acceleration[1:])
    )
    found = Motion(np.array(time, float), np.array(acceleration, float)).arias_intensity()
    assert found == pytest.approx(np.pi / (2 * 9.80665) * float(integral), rel=1e-14)
    fine = np.linspace(0, 1.125, 2_000_001)
    squares = np.interp(fine, np.array(time, float), np.array(acceleration, float)) ** 2
    assert np.trapezoid(squares, fine) == pytest.approx(float(integral), rel=1e-9)


def test_the_spectrum_is_that_of_a_step():
    """An acceleration that comes at once and stays: the oscillator swings to 1 + exp(-pi z / sqrt(1 - z^2)) times its rest."""
    motion = Motion(np.array([0.0, 1e-9, 100.0]), np.array([0.0, 2.0, 2.0]))
    from pounding_fmu.record import spectral

    for period in (0.1, 0.5, 2.0):
        expected = 2.0 * (1 + np.exp(-np.pi * 0.05 / np.sqrt(1 - 0.05**2)))
        assert spectral(motion, period) == pytest.approx(expected, rel=1e-6)


def test_a_record_is_converted_bit_by_bit(tmp_path):
    (tmp_path / "a.AT2").write_text("PEER\nstation\nACCELERATION IN UNITS OF G\nNPTS= 5, DT= .01 SEC\n .1E-1 -.2 .3 .123456789 .5\n")
    well("record", "a.AT2", "-o", "a.csv", cwd=tmp_path)
    one, other = (pounding_fmu.read_record(tmp_path / name) for name in ("a.AT2", "a.csv"))
    assert all(fmus.same_bits(a, b) for a, b in zip(one, other)) and len(one[0]) == 5


def test_a_mean_that_is_not_0_is_told_and_taken_away_on_demand(tmp_path):
    time = np.arange(200) / 100
    acceleration = 0.03 + np.sin(2 * np.pi * 4 * time) * np.exp(-time)
    rows = "".join(f"{t!r},{a!r}\n" for t, a in zip(time.tolist(), acceleration.tolist()))
    (tmp_path / "offset.csv").write_text("time_s,accel_m_s2\n" + rows)
    text = well("record", "offset.csv", "-o", "same.csv", cwd=tmp_path)
    assert "not about 0" in text and "--remove-mean" in text
    assert fmus.same_bits(pounding_fmu.read_record(tmp_path / "same.csv")[1], acceleration)
    text = well("record", "offset.csv", "--remove-mean", "-o", "less.csv", cwd=tmp_path)
    assert "has been taken away" in text and "not about 0" not in text
    less = pounding_fmu.read_record(tmp_path / "less.csv")[1]
    assert fmus.same_bits(less, acceleration - np.float64(sum(map(Fraction, acceleration.tolist())) / 200))
    assert "without its mean of" in (tmp_path / "less.csv").read_text().splitlines()[0]


@pytest.mark.parametrize("suffix", ["png", "svg", "pdf"])
def test_a_record_is_drawn(suffix, tmp_path):
    well("record", fmus.RECORD, "--plot", f"x.{suffix}", cwd=tmp_path)
    beginning = {"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF"}[suffix]
    assert (tmp_path / f"x.{suffix}").read_bytes().startswith(beginning)


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        ([], 2, "the following arguments are required: FILE"),
        (["missing.csv"], 1, "missing.csv: No such file"),
        (["feup.toml"], 1, "expected a record file, but"),
        (["r.csv", "-o", "r.csv"], 1, "r.csv: this is the record itself"),
        (["r.csv", "-o", "no/such/r.csv"], 1, "no/such/r.csv: No such file"),
        (["r.csv", "--plot", "r.jpg"], 1, "r.jpg: expected a name that ends in .png, .svg, .pdf"),
    ],
)
def test_mistakes_with_records(arguments, code, said, tmp_path):
    (tmp_path / "r.csv").write_text(UNEVEN)
    (tmp_path / "feup.toml").write_text(fmus.feup())
    done = run("record", *arguments, cwd=tmp_path)
    assert done.returncode == code and said in done.stderr and "Traceback" not in done.stderr
    assert (tmp_path / "r.csv").read_text() == UNEVEN
