"""What FMPy's validator says, and what the archive and the description hold."""

import zipfile
from pathlib import Path

import fmpy.validation
import pytest

import harness


@pytest.mark.parametrize("which", ["feup", "feup_input"])
def test_fmpy_finds_nothing_wrong(which, request):
    fmu = request.getfixturevalue(which)
    assert fmpy.validation.validate_fmu(fmu.path) == []


def test_the_scene_and_its_record_travel_inside_unchanged(feup):
    with zipfile.ZipFile(feup.path) as archive:
        names = archive.namelist()
        record = archive.read("resources/record.csv")
        assert archive.read("resources/scene.toml") == feup.scene.read_bytes()
    assert names[0] == "modelDescription.xml"
    assert "documentation/licenses/license.txt" in names
    assert record == harness.RECORD.read_bytes()


def test_the_library_tells_nothing_of_the_machine_that_built_it(feup):
    with zipfile.ZipFile(feup.path) as archive:
        library = next(name for name in archive.namelist() if name.startswith("binaries/"))
        binary = archive.read(library)
    for place in [Path.home(), harness.ROOT]:
        assert f"{place}/".encode() not in binary


def test_inputs_and_outputs_follow_the_scene(feup, feup_input):
    def causality(fmu):
        return {v.name: v.causality for v in fmu.description.modelVariables}

    assert causality(feup)["ground.acceleration"] == "output"
    assert causality(feup_input)["ground.acceleration"] == "input"
    assert "ground.scale" not in causality(feup_input)
    assert "left.force[1]" not in causality(feup)
