"""What commands read stays as it is, whatever they are told to write."""

import os

import fmus
import pounding_fmu
import pytest
from test_command import run, well

ITSELF = "itself, which stays as it is; expected another name"


@pytest.fixture
def folder(tmp_path):
    """Scenes with and without a record, and links to both kinds of file."""
    record = fmus.RECORD.read_text().splitlines(keepends=True)[:200]
    (tmp_path / "rec.csv").write_text("".join(record))
    scene = fmus.feup(str(fmus.RECORD), "rec.csv")
    for name in ("s.toml", "s.png", "s.gif", "s.fmu"):
        (tmp_path / name).write_text(scene)
    (tmp_path / "norec.toml").write_text(scene.replace('record = "rec.csv"\n', ""))
    (tmp_path / "below").mkdir()
    os.link(tmp_path / "s.toml", tmp_path / "hard.toml")
    (tmp_path / "soft.csv").symlink_to("rec.csv")
    return tmp_path


def refused(folder, arguments, said):
    before = {file: file.read_bytes() for file in folder.rglob("*") if file.is_file()}
    done = run(*arguments, cwd=folder)
    assert (done.returncode, done.stdout) == (1, ""), arguments
    assert said in done.stderr and len(done.stderr.splitlines()) == 1, (arguments, done.stderr)
    assert {file: file.read_bytes() for file in folder.rglob("*") if file.is_file()} == before, arguments


@pytest.mark.parametrize("option", ["--csv", "--impacts", "--html", "--layout"])
@pytest.mark.parametrize(
    ("output", "what"),
    [("s.toml", "scene"), ("below/../s.toml", "scene"), ("hard.toml", "scene"), ("rec.csv", "record"), ("soft.csv", "record")],
)
def test_simulate(option, output, what, folder):
    refused(folder, ["simulate", "s.toml", option, output], f"error: {output}: this is the {what} {ITSELF}")


@pytest.mark.parametrize(
    ("arguments", "output", "what"),
    [
        (["simulate", "norec.toml", "--record", "rec.csv", "--csv"], "./rec.csv", "record"),
        (["report", "s.toml", "-o"], "s.toml", "scene"),
        (["report", "s.toml", "-o"], "rec.csv", "record"),
        (["gap", "s.toml", "-o"], "s.toml", "scene"),
        (["gap", "s.toml", "-o"], "rec.csv", "record"),
        (["gap", "norec.toml", "--records", "rec.csv", "-o"], "soft.csv", "record"),
        (["plot", "s.png", "-o"], "s.png", "scene"),
        (["animate", "s.gif", "-o"], "s.gif", "scene"),
        (["record", "rec.csv", "-o"], "soft.csv", "record"),
        (["s.fmu", "-o"], "s.fmu", "scene"),
    ],
)
def test_other_commands(arguments, output, what, folder):
    refused(folder, [*arguments, output], f"error: {output}: this is the {what} {ITSELF}")


def test_the_page_of_a_scene(folder):
    done = run("page", "s.toml", "-o", "s.toml", cwd=folder)
    assert done.returncode == 1 and (ITSELF in done.stderr or "without the page" in done.stderr)
    assert (folder / "s.toml").read_bytes() == (folder / "s.png").read_bytes()


@pytest.mark.parametrize("picture", ["gaps_FeupFrames_1.png", "fragility_FeupFrames_1.png", "varied_FeupFrames.png"])
def test_pictures_of_a_study(picture, folder):
    (folder / "s.png").rename(folder / picture)
    options = ["--gaps", "0.005", "--pga", "1", "--stop", "0.5", "--vary", "left.mass[1]=3,4", "-o", "."]
    done = run("study", picture, "--records", "rec.csv", *options, cwd=folder)
    assert done.returncode == 1 and done.stderr.endswith(f"error: {picture}: this is the scene {ITSELF}\n")
    assert (folder / picture).read_bytes() == (folder / "s.toml").read_bytes()


def test_two_tables_are_two_files(folder):
    (folder / "there.csv").write_text("mine")
    for name in ("new.csv", "there.csv"):
        arguments = ["simulate", "s.toml", "--csv", name, "--impacts", f"below/../{name}"]
        refused(folder, arguments, f"error: --impacts below/../{name}: this is the file of --csv; expected another name")


def test_a_channel_of_a_record_is_its_file(folder):
    """`record` too looks at the file and not at the name that asks for a channel of it."""
    refused(folder, ["record", "rec.csv#1", "-o", "rec.csv"], f"this is the record {ITSELF}")


def test_an_fmu_goes_over_no_scene(folder):
    with pytest.raises(ValueError, match=f"s.fmu: this is the scene {ITSELF}"):
        pounding_fmu.build_fmu(folder / "s.fmu", folder / "below/../s.fmu")


def test_what_is_no_file_may_be_written_twice(folder):
    well("simulate", "s.toml", "--stop", "0.1", "--csv", os.devnull, "--impacts", os.devnull, cwd=folder)
