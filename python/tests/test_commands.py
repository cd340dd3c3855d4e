"""The command `pounding-fmu`: its help, words that are no command, examples, reports."""

import json
import os
import re
import shlex
import signal
import subprocess
import sys
import time

import fmus
import pounding_fmu
import pytest
from pounding_fmu.__main__ import COMMANDS
from test_command import run, well

SCENES = ["block", "bridge", "clinic", "feup", "isolated", "leaning", "neighbours", "offices", "on_soil", "two_blocks", "yielding"]


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


@pytest.mark.parametrize("arguments", [["record", fmus.RECORD], ["simulate", fmus.FEUP], ["example"]])
def test_a_reader_that_has_seen_enough(arguments):
    reading, writing = os.pipe()
    os.close(reading)
    command = ["pounding-fmu", *map(str, arguments)]
    done = subprocess.run(command, stdout=writing, stderr=subprocess.PIPE, text=True)
    os.close(writing)
    assert (done.returncode, done.stderr) == (0, "")


SPEAKING = [
    ["example"],
    ["record", fmus.RECORD],
    ["record", fmus.RECORD, "-o", "converted.csv"],
    ["simulate", fmus.FEUP, "--stop", "1", "--csv", "motion.csv"],
    ["gap", fmus.FEUP],
    [fmus.FEUP],
    ["check", fmus.REFERENCES / "feup.fmu"],
    *([*command, "--help"] for command in ([], ["simulate"], ["example"], ["study"])),
    ["--version"],
]


@pytest.mark.skipif(os.name == "nt", reason="needs a shell that closes streams")
@pytest.mark.parametrize("closed", [">&-", "<&- >&-", "<&- >&- 2>&-"])
@pytest.mark.parametrize("arguments", SPEAKING)
def test_closed_streams(arguments, closed, tmp_path):
    """Nobody reads it; what is written to files is what is written there otherwise."""
    command = shlex.join(["pounding-fmu", *map(str, arguments)])
    done = subprocess.run(f"{command} {closed}", shell=True, cwd=tmp_path, capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    written = {file: file.read_bytes() for file in tmp_path.iterdir()}
    well(*arguments, cwd=tmp_path)
    assert {file: file.read_bytes() for file in tmp_path.iterdir()} == written


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no device that is always full")
@pytest.mark.parametrize("arguments", SPEAKING)
def test_lost_output_is_no_success(arguments, tmp_path):
    command = ["pounding-fmu", *map(str, arguments)]
    with open("/dev/full", "w") as full:
        done = subprocess.run(command, cwd=tmp_path, stdout=full, stderr=subprocess.PIPE, text=True)
    assert done.returncode == 1 and "No space left on device" in done.stderr and done.stderr.startswith("error: ")
    assert len(done.stderr.splitlines()) == 1, done.stderr


@pytest.mark.skipif(os.name == "nt", reason="no SIGINT for another process")
def test_ctrl_c_in_a_command_in_python(tmp_path):
    code = "import time\ndef main(arguments):\n    print('on', flush=True)\n    time.sleep(60)\n"
    # Also where this runs in the background, where shells have processes ignore it.
    code += "import signal\nsignal.signal(signal.SIGINT, signal.default_int_handler)\n"
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
    assert "two_blocks  Two small blocks of concrete: the scene of the README." in lines  # has no description


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


ROW = "[[building]]\nname = \"{}\"\nmass = [1e5]\nstiffness = [{}]\ndamping = {{ ratio = 0.05 }}\nheight = [3.0]\n"


def test_a_report_begins_with_the_buildings_that_are_named(tmp_path):
    text = "".join(ROW.format(name, stiffness) for name, stiffness in [("a", 2e7), ("b", 5e7), ("c", 1e7)])
    ground = f'[ground]\nrecord = "{fmus.RECORD}"\n[facing]\ngap = 0.01\nlaw = "linear"\nstiffness = 1e8\n'
    (tmp_path / "row.toml").write_text(f'name = "Row"\n{text}{ground}')
    for named, charted in (([], None), (["--buildings", "c", "a"], ["a", "c"])):
        well("report", "row.toml", *named, cwd=tmp_path)
        page = (tmp_path / "Row.html").read_text()
        data = json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', page)[1])
        assert data["charted"] == charted and [building["name"] for building in data["buildings"]] == ["a", "b", "c"]
    for named, said in (["d"], "d: the scene has no such building; expected one or two of a, b, c"), (["a", "b", "c"], "a b c: expected"):
        done = run("report", "row.toml", "--buildings", *named, cwd=tmp_path)
        assert done.returncode == 1 and f"--buildings {said}" in done.stderr


def test_ctrl_c_within_an_exec_is_an_exit_code_too(tmp_path):
    (tmp_path / "ends.py").write_text(
        "import importlib, sys, types\n"
        "from pounding_fmu.__main__ import carry_out\n"
        "importlib.import_module = lambda _: types.SimpleNamespace(main=lambda _: exec('raise KeyboardInterrupt'))\n"
        "sys.exit(carry_out('any', []))\n"
    )
    assert subprocess.run([sys.executable, "-m", "ends"], cwd=tmp_path).returncode == 130


def test_ctrl_c_within_a_callback_is_not_lost(tmp_path):
    (tmp_path / "ends.py").write_text(
        "import importlib, signal, sys, time, types, weakref\n"
        "from pounding_fmu.__main__ import carry_out\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "class One: pass\n"
        "def come(_):\n"
        "    raise KeyboardInterrupt\n"
        "def main(_):\n"
        "    one = One()\n"
        "    kept = weakref.ref(one, come)\n"
        "    del one\n"
        "    for _ in range(200):\n"
        "        time.sleep(0.1)\n"
        "    return 0\n"
        "importlib.import_module = lambda _: types.SimpleNamespace(main=main)\n"
        "sys.exit(carry_out('any', []))\n"
    )
    done = subprocess.run([sys.executable, "-m", "ends"], cwd=tmp_path, stderr=subprocess.PIPE, text=True)
    assert (done.returncode, done.stderr) == (130, "")
