"""Life and death of instances: several at once, again and again, and those that must not come to life."""

import shutil
import urllib.parse
from pathlib import Path

import numpy as np
import pytest

STEP = 1 / 64


def test_two_instances_in_one_process_do_not_know_each_other(feup):
    alone = feup.instance().start().steps(STEP, 640)
    one, two = feup.instance("one").start(), feup.instance("two").start(**{"ground.scale": 0.5})
    together = []
    for k in range(640):
        together.append(one.steps(STEP, 1, first=k)[0])
        two.steps(STEP, 1, first=k)
    assert np.array_equal(np.array(together), alone)
    assert not np.array_equal(two.get("left.displacement[1]"), one.get("left.displacement[1]"))


def test_reset_begins_anew(feup):
    instance = feup.instance()
    first = instance.start(**{"ground.scale": 2.0}).steps(STEP, 320)
    instance.reset()
    second = instance.start().steps(STEP, 320)
    instance.terminate()
    instance.reset()
    third = instance.start().steps(STEP, 320)
    assert np.array_equal(second, third)
    assert not np.array_equal(first, second)


def test_many_lives(feup):
    expected = feup.instance().start().steps(STEP, 20)
    for _ in range(50):
        instance = feup.instance()
        assert np.array_equal(instance.start().steps(STEP, 20), expected)
        instance.terminate()
        instance.fmi2FreeInstance(instance.component)


def test_a_wrong_guid_is_refused_with_a_message(feup):
    instance = feup.instance(guid="{00000000-0000-0000-0000-000000000000}")
    assert instance.component is None
    assert "00000000-0000-0000-0000-000000000000" in instance.messages[-1]
    assert feup.description.guid.strip("{}") in instance.messages[-1]


def test_resources_of_another_scene_are_refused_with_a_message(feup, feup_input):
    instance = feup.instance(resources=Path(feup_input.directory, "resources").as_uri())
    assert instance.component is None
    assert feup.description.guid.strip("{}") in instance.messages[-1]


@pytest.mark.parametrize("uri", ["file:///no/such/place", "", "http://example.org/resources", "file://elsewhere/x"])
def test_resources_that_are_not_there_are_refused_with_a_message(feup, uri):
    instance = feup.instance(resources=uri)
    assert instance.component is None
    assert instance.messages and instance.messages[-1]


def test_an_altered_scene_is_refused(feup, tmp_path):
    resources = tmp_path / "resources"
    shutil.copytree(Path(feup.directory, "resources"), resources)
    scene = resources / "scene.toml"
    scene.write_text(scene.read_text().replace("gap = 0.005", "gap = 0.006"))
    assert feup.instance(resources=resources.as_uri()).component is None
    scene.write_text("name = ")
    instance = feup.instance(resources=resources.as_uri())
    assert instance.component is None
    assert "line 1" in instance.messages[-1]


@pytest.mark.parametrize("form", ["{path}", "file:{path}", "file://{path}", "file://localhost{path}", "file:///{path}"])
@pytest.mark.parametrize("encoded", [True, False], ids=["encoded", "plain"])
@pytest.mark.parametrize("end", ["", "/"])
def test_every_way_to_write_the_resource_location(feup, tmp_path, form, encoded, end):
    resources = tmp_path / "with blank & ümlaut"
    shutil.copytree(Path(feup.directory, "resources"), resources)
    path = urllib.parse.quote(str(resources)) if encoded else str(resources)
    instance = feup.instance(resources=form.format(path=path) + end)
    assert instance.component is not None, instance.messages
    instance.start().steps(STEP, 2)
