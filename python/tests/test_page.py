"""The command `pounding-fmu page`. The template stands in for that of `ci/page`, which tests/browser opens in a browser."""

import json
import re

import fmus
import pounding_fmu
import pytest
from pounding_fmu import _page, page

HEAD = "<!DOCTYPE html><title>template</title>\n"
ELEMENT = '<script type="application/json" id="{}">{}</script>\n'
EMPTY = {"records": {"other.csv": "H4s="}, "libraries": {}, "given": None}


@pytest.fixture
def template(tmp_path, monkeypatch):
    file = tmp_path / "template.html"
    file.write_text(HEAD + "".join(ELEMENT.format(name, json.dumps(value)) for name, value in EMPTY.items()))
    monkeypatch.setattr(page, "TEMPLATE", file)
    monkeypatch.chdir(tmp_path)
    return file


def held(file):
    """What is before the elements, and what they hold."""
    text = file.read_bytes().decode()
    parts = re.findall(r'<script type="application/json" id="(\w+)">(.*?)</script>', text)
    return text.partition("<script")[0], {name: json.loads(content) for name, content in parts}


def unpacked(contents):
    return {name: _page.unpacked(content) for name, content in contents.items()}


def test_it_has_the_libraries_of_the_wheel(template, tmp_path, capsys):
    assert page.main([]) == 0
    assert capsys.readouterr().out == f"pounding.html: open it in a browser; its FMUs are for {fmus.HOST}\n"
    head, parts = held(tmp_path / "pounding.html")
    assert head == HEAD and parts | {"libraries": {}} == EMPTY
    assert unpacked(parts["libraries"]) == fmus.libraries(fmus.REFERENCES / "feup.fmu")


def test_it_opens_with_a_scene_and_its_record(template, tmp_path):
    scene = tmp_path / "own.toml"
    scene.write_text(fmus.FEUP.read_text().replace("FEUP laboratory frames", "</script><b>é</b>").replace("../records/", ""))
    (tmp_path / fmus.RECORD.name).write_bytes(fmus.RECORD.read_bytes())
    assert page.main([str(scene)]) == 0
    made = tmp_path / "FeupFrames.page.html"
    _, parts = held(made)
    assert parts["given"] == {"file": "own.toml", "text": scene.read_text()}
    assert parts["records"].keys() == {"other.csv", fmus.RECORD.name}
    assert _page.unpacked(parts["records"][fmus.RECORD.name]) == fmus.RECORD.read_bytes()
    first = made.read_bytes()
    assert page.main([str(scene), "-o", str(made)]) == 0 and made.read_bytes() == first


def test_of_a_file_with_channels_it_has_the_whole(template, tmp_path):
    record = fmus.EXAMPLES.parent / "fuzz/seeds/record_other/csmip.v2"
    (tmp_path / "record.v2").write_bytes(record.read_bytes())
    (tmp_path / "own.toml").write_text(fmus.FEUP.read_text().replace("../records/el_centro_1940_ns.csv", "record.v2#1"))
    with pytest.warns(pounding_fmu.SceneWarning):  # it is short
        assert page.main(["own.toml"]) == 0
    _, parts = held(tmp_path / "FeupFrames.page.html")
    assert _page.unpacked(parts["records"]["record.v2"]) == record.read_bytes()


def test_mistakes_of_the_scene_are_told(template, tmp_path):
    (tmp_path / "bad.toml").write_text(fmus.FEUP.read_text().replace("[3.65, 3.65]", "[-3.65, 3.65]"))
    with pytest.raises(ValueError, match=r"bad.toml: left.mass\[1\] = -3.65: expected a finite mass > 0 kg\nbad.toml: ground"):
        page.main(["bad.toml"])
    with pytest.raises(FileNotFoundError):
        page.main(["nowhere.toml"])
    assert not list(tmp_path.glob("*.page.html"))


def test_a_wheel_without_the_page_says_so(tmp_path, monkeypatch):
    monkeypatch.setattr(page, "TEMPLATE", tmp_path / "nothing.html")
    with pytest.raises(ValueError, match="this wheel has been built without the page"):
        page.main([])


def test_a_template_of_another_version_is_refused(template):
    template.write_text(HEAD)
    with pytest.raises(ValueError, match="the template has no place for libraries"):
        page.main([])
