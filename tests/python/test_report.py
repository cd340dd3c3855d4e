"""The HTML report of a run: its structure and its data. tests/browser/report.py looks at it in a browser."""

import csv
import json
import re
from html.parser import HTMLParser

import numpy as np
import pytest

import harness

HOSTILE = '</script><script>alert(1)</script><!-- <script> & "quoted" \u2028 ü'


class Page(HTMLParser):
    """The elements of a page; the text of each script."""

    def __init__(self, text):
        super().__init__()
        self.elements, self.scripts, self.inside = [], [], None
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))
        self.inside = tag
        if tag == "script":
            self.scripts.append("")

    def handle_endtag(self, tag):
        self.inside = None

    def handle_data(self, text):
        if self.inside == "script":
            self.scripts[-1] += text

    def run(self):
        return json.loads(self.scripts[0])


def report(scene, folder, *more):
    harness.run(harness.SIMULATE, scene, "--html", folder / "run.html", *more)
    text = (folder / "run.html").read_text()
    return text, Page(text)


def motion_of(table):
    """The columns of a table of the motion by name."""
    with table.open() as lines:
        names = next(lines).strip().split(",")
        return dict(zip(names, np.loadtxt(lines, delimiter=",", unpack=True)))


def columns(run):
    """Times and values of each column by its name."""
    times = np.array(run["times"])
    for column in run["columns"]:
        rows = slice(None) if column["steps"] is None else np.cumsum(column["steps"])
        yield column["name"], times[rows], np.array(column["values"])


def test_it_loads_nothing_and_no_text_of_a_scene_becomes_markup(tmp_path):
    scene = tmp_path / "scene.toml"
    text = harness.scene_with_record() + f"\n# {HOSTILE}\n"
    described = re.search(r'description = "(.*)"', text)[1]
    scene.write_text(harness.replaced(text, described, HOSTILE.replace('"', '\\"')))
    text, page = report(scene, tmp_path)
    kinds = [attributes.get("type") for tag, attributes in page.elements if tag == "script"]
    assert kinds == ["application/json", None, None]
    run = page.run()
    assert run["description"] == HOSTILE and run["scene"] == scene.read_text()
    assert not any({"src", "href", "action"} & set(a) for tag, a in page.elements if a.get("href", "#")[0] != "#")
    [policy] = [a["content"] for _, a in page.elements if a.get("http-equiv") == "Content-Security-Policy"]
    assert policy.startswith("default-src 'none'")
    assert not any(mark in text for mark in ("/*data*/", "/*report.js*/", "/*drawing*/"))
    # Its licence goes with the library.
    assert (harness.ROOT / "simulate/src/uplot/LICENSE").read_text() in text


def test_its_numbers_are_those_of_the_tables(feup, tmp_path):
    table, impacts = tmp_path / "motion.csv", tmp_path / "impacts.csv"
    _, page = report(feup.scene, tmp_path, "--csv", table, "--impacts", impacts, "--step", "0.01")
    run = page.run()
    motion = motion_of(table)
    assert ["time", *(column["name"] for column in run["columns"])] == list(motion)
    for name, times, values in columns(run):
        place = np.searchsorted(times, motion["time"] - 1e-12)
        assert np.allclose(times[place], motion["time"], rtol=0, atol=1e-12)
        largest = np.max(np.abs(motion[name]))
        assert np.max(np.abs(values[place] - motion[name])) <= 1e-5 * largest, name
    rows = list(csv.reader(impacts.open()))[1:]
    assert [[float(cell) if cell else None for cell in row] for row in rows] == run["impacts"]
    assert len(rows) == 108


def test_every_impact_can_be_seen(feup, tmp_path):
    run = report(feup.scene, tmp_path)[1].run()
    forces = {name: (times, values) for name, times, values in columns(run) if name.endswith("].force")}
    for contact, start, end, _, _, peak, *_ in run["impacts"]:
        times, values = forces[f"contact[{contact:.0f}].force"]
        within = values[(times >= start) & (times <= end)]
        assert len(within) > 20 and within.max() == pytest.approx(peak, rel=1e-5)


def test_a_long_table_is_thinned_and_keeps_its_extremes(tmp_path):
    """Twelve storeys each, a contact at every floor: more numbers than a page should hold."""
    floors = 12
    building = f"mass = {[3.65] * floors}\nstiffness = {[2910.0 * floors] * floors}\ndamping = {{ ratio = 0.02 }}\n"
    text = f'name = "Tall"\nstop_time = 20.0\n[left]\n{building}[right]\n{building.replace("3.65", "7.3")}'
    text += f"[ground]\nrecord = '{harness.RECORD}'\n"
    for floor in range(1, floors + 1):
        text += (
            f'[[contact]]\nleft_floor = {floor}\nright_floor = {floor}\ngap = 0.004\nlaw = "hertz"\nstiffness = 1e7\n'
        )
    scene, table, impacts = (tmp_path / name for name in ["scene.toml", "motion.csv", "impacts.csv"])
    scene.write_text(text)
    page, parsed = report(scene, tmp_path, "--csv", table, "--impacts", impacts, "--rows-per-impact", 24)
    run = parsed.run()
    assert len(page) < 8e6
    assert any(column["steps"] is not None for column in run["columns"])
    motion = motion_of(table)
    for name, times, values in columns(run):
        assert np.all(np.diff(times) > 0) and times[0] == 0 and times[-1] == 20, name
        # Both tables have the rows within impacts, where forces and accelerations have their extremes.
        if ".acceleration[" in name or name.endswith("].force"):
            bound = 1e-5 * np.max(np.abs(motion[name])) + 1e-300
            assert values.max() >= motion[name].max() - bound and values.min() <= motion[name].min() + bound, name


def test_rows_within_impacts(feup, tmp_path):
    table = tmp_path / "motion.csv"
    harness.run(harness.SIMULATE, feup.scene, "--csv", table, "--impacts", tmp_path / "i.csv", "--rows-per-impact", 3)
    motion = motion_of(table)
    time = motion["time"]
    assert np.all(np.diff(time) > 0)
    assert np.all(np.isin([k * 0.01 for k in range(2000)], time))
    for row in csv.DictReader((tmp_path / "i.csv").open()):
        contact, start, end = row["contact"], float(row["start_s"]), float(row["end_s"])
        within = (time > start) & (time < end)
        assert np.sum(within) >= 6 and float(row["peak_time_s"]) in time
        assert np.all(motion[f"contact[{contact}].active"][within] == 1)
        around = [np.searchsorted(time, start) - 1, np.searchsorted(time, end, side="right")]
        assert np.all(motion[f"contact[{contact}].active"][around] == 0)
        # Just outside: nothing of a jump is missed.
        assert np.all(np.abs(time[around] - [start, end]) < 1e-3 * (end - start) + 1e-8)


def test_without_contacts_nothing_hits(feup, tmp_path):
    table = tmp_path / "motion.csv"
    harness.run(harness.SIMULATE, feup.scene, "--csv", table, "--without-contacts")
    alone = motion_of(table)
    far = feup.simulate(0.01, start_values={"contact[1].gap": 10.0, "contact[2].gap": 10.0})
    assert not any(name.startswith("contact") for name in alone)
    for name in ["left.displacement[2]", "right.acceleration[3]"]:
        assert np.max(np.abs(alone[name] - far[name])) <= 1e-12 * np.max(np.abs(far[name]))
