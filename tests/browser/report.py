"""Looks at the HTML report of a run in a browser, as a person would: reads, hovers, zooms, chooses, sorts.

    "$(ci/environment tests/browser)" tests/browser/report.py

Needs a Chromium (Debian: apt-get install chromium, or chromium-headless-shell; elsewhere name it in BROWSER); fails
where there is none. Leaves pictures of the page in target/browser. tests/python/test_report.py tests the structure of
the page without a browser.
"""

import csv
import io
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

from browser import listen, started

ROOT = Path(__file__).resolve().parents[2]
SCENES = ROOT / "examples/scenes"
FOLDER = ROOT / "target/browser"
SIMULATE = shlex.split(os.environ.get("SIMULATE", "cargo run --release --quiet --example simulate --"))
# Friction between the roofs, a spring and a dashpot to the ground, and a dashpot between the buildings, in kN and m.
LINKS = """
[[link]]
left_floor = 3
right_floor = 3
stiffness = 30e3
slip_force = 60
[[link]]
left_floor = 2
wall = "right"
stiffness = 5e3
dashpot = 500
[[link]]
left_floor = 1
right_floor = 1
dashpot = 600
"""
# Soil under both frames: the left one sways and rocks, the right one rocks.
SOIL = """
[left.foundation]
mass = 120
inertia = 3000
sway = { stiffness = 400e3, dashpot = 5e3 }
rocking = { stiffness = 15e6, dashpot = 80e3 }
[right.foundation]
mass = 90
inertia = 2000
rocking = { stiffness = 12e6 }
"""
# Three buildings, of which the last two meet hardest, and a wall before the first one.
ROW = f"""name = "Row"
description = ""
stop_time = 10.0
[ground]
record = "{ROOT}/examples/records/el_centro_1940_ns.csv"
[facing]
gap = [0.3, 0.005]
law = "linear"
stiffness = 5e8
[[contact]]
right = "corner"
right_floor = 1
wall = "left"
gap = 0.06
law = "linear"
stiffness = 5e8
""" + "".join(
    f"""[[building]]
name = "{name}"
mass = {[15e4] * floors}
stiffness = {[stiffness] * floors}
damping = {{ ratio = 0.05 }}
height = {[3.2] * floors}
"""
    for name, floors, stiffness in [("corner", 2, 9e7), ("middle", 4, 9e7), ("tail", 3, 4e7)]
)
# The example ends with its outputs.
NO_PEAKS = "peaks = false\n"
HOSTILE = "</script><script>alert(1)</script><img src=x onerror=alert(2)> & <b>bold</b>"


def main():
    html, scene, impacts = make_report("feup")
    with started(viewport={"width": 1300, "height": 900}) as context:
        page = context.new_page()
        troubles = listen(page)
        page.goto(html.as_uri())
        for look in [reads, tells_apart, hovers, zooms, chooses, sorts, finds_an_impact, is_narrow]:
            look(page, scene, impacts)
            print(f"{look.__name__.replace('_', ' ')}: well")
        pages = [(has_levels, "neighbours", ""), (stands_alone, "isolated", ""), (yields, "yielding", "")]
        pages += [(is_linked, "yielding", LINKS), (stands_on_soil, "yielding", SOIL), (has_no_peaks, "yielding", NO_PEAKS + SOIL)]
        for look, name, more in pages:
            page.set_viewport_size({"width": 1300, "height": 900})
            html, _, impacts = make_report(name, more)
            page.goto(html.as_uri())
            look(page, impacts)
            print(f"{look.__name__.replace('_', ' ')}: well")
        html, _, impacts = report_of("row", ROW)
        page.goto(html.as_uri())
        stands_in_a_row(page, impacts)
        print("stands in a row: well")
        assert not troubles, troubles
        print("nothing loaded, no error")


def make_report(name, more=""):
    """The report of an example with a description that would like to be markup, and more keys; its text and its impacts."""
    text = (SCENES / f"{name}.toml").read_text().replace("../records", str(ROOT / "examples/records"))
    return report_of(name, re.sub(r'description = ".*"', f'description = "{HOSTILE}"', text) + more)


def report_of(name, text):
    """The report of a scene, its text and its impacts."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    scene, html, impacts = (FOLDER / f"{name}.{ending}" for ending in ["toml", "html", "csv"])
    scene.write_text(text)
    subprocess.run([*SIMULATE, scene, "--html", html, "--impacts", impacts], cwd=ROOT, check=True, stdout=sys.stderr)
    return html, text, list(csv.DictReader(impacts.open()))


def stretch(page):
    """From where to where the charts show time, as the page says it."""
    return [float(number) for number in re.findall(r"[\d.]+", page.locator("#shown").inner_text())]


def reads(page, scene, impacts):
    assert page.title() == "FeupFrames" and page.locator("#description").inner_text() == HOSTILE
    assert page.locator("#scene-text").text_content() == scene
    assert page.locator("img, b").count() == 0
    assert f"{len(impacts)} impacts" in page.locator("#happened").inner_text()
    assert page.locator("#impact-table tbody tr").count() == len(impacts)
    rows = page.locator("#contact-table tbody tr")
    counts = [int(rows.nth(row).locator("td").nth(4).inner_text()) for row in range(rows.count())]
    assert counts == [sum(impact["contact"] == contact for impact in impacts) for contact in "12"]
    assert page.locator(".chart").count() == 3
    drawn = """canvas => {
        const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
        return new Set(new Uint32Array(data.buffer)).size;
    }"""
    assert all(page.locator(".chart canvas").nth(chart).evaluate(drawn) > 20 for chart in range(3))
    page.screenshot(path=FOLDER / "whole.png")


def tells_apart(page, scene, impacts):
    """No two lines of a chart look the same, each is in its legend as it is drawn, and a quantity has one unit."""
    page.locator("#variables .group input").evaluate_all("boxes => boxes.forEach(box => box.checked || box.click())")
    for chart in page.locator(".chart").all():
        keys = chart.locator(".key line").evaluate_all(
            "keys => keys.map(key => key.getAttribute('stroke') + ' ' + key.getAttribute('stroke-dasharray'))"
        )
        assert len(set(keys)) == len(keys) == chart.locator(".u-legend .u-series").count() - 1 > 0, keys
    headings = page.locator(".chart h3, th").all_inner_texts()
    units = {unit for heading in headings for unit in re.findall(r"\[(.*)\]", " ".join(heading.split()))}
    for one, other in [("N", "kN"), ("N s", "kN s"), ("m", "mm"), ("m/s2", "g"), ("N", "kN s"), ("kN", "N s")]:
        assert not {one, other} <= units, units
    page.locator("#usual").click()
    # A box of a group stands for all that is below it.
    assert not page.locator('input[aria-label="all: velocity"]').is_checked()
    assert page.locator('input[aria-label="all: contact force"]').is_checked()


def over(page, chart, share):
    """A point of a chart: `share` of its width from the left."""
    box = page.locator(".chart .u-over").nth(chart).bounding_box()
    return box["x"] + share * box["width"], box["y"] + box["height"] / 2


def hovers(page, scene, impacts):
    page.mouse.move(*over(page, 0, 0.25))
    # All charts show their values at the time under the cursor.
    for chart in range(3):
        values = page.locator(".chart").nth(chart).locator(".u-legend .u-value").all_inner_texts()
        assert abs(float(values[0]) - 5.0) < 0.05 and all(re.fullmatch(r"-?[\d.]+(e-?\d+)?", value) for value in values)


def zooms(page, scene, impacts):
    page.mouse.move(*over(page, 1, 0.1))
    page.mouse.down()
    page.mouse.move(*over(page, 1, 0.2), steps=5)
    page.mouse.up()
    assert all(abs(at - wanted) < 0.05 for at, wanted in zip(stretch(page), [2.0, 4.0])), stretch(page)
    shown = page.evaluate("[...charts.values()].map(({ plot }) => [plot.scales.x.min, plot.scales.x.max])")
    assert len(shown) == 3 and all(one == shown[0] for one in shown), shown
    page.locator("#later").click()
    assert abs(stretch(page)[0] - 3.0) < 0.05
    page.screenshot(path=FOLDER / "zoomed.png")
    page.mouse.dblclick(*over(page, 0, 0.5))
    assert stretch(page) == [0.0, 20.0], stretch(page)


def chooses(page, scene, impacts):
    page.locator("#filter").fill("left acc")
    # Those at a time and the largest, of two floors.
    assert page.locator("#variables li:not(.group):visible").count() == 4
    page.locator("#filter").fill("")
    box = page.locator('input[data-name="contact[1].penetration"]')
    box.check()
    assert page.locator(".chart h3").all_inner_texts()[-1] == "penetration [mm]"
    box.uncheck()
    assert page.locator(".chart").count() == 3
    page.locator("#none").click()
    assert page.locator(".chart").count() == 0
    page.locator("#usual").click()
    assert page.locator(".chart").count() == 3


def sorts(page, scene, impacts):
    forces = sorted((float(impact["peak_force"]) for impact in impacts), reverse=True)
    heading = page.get_by_role("button", name="peak force")

    factor = {"N": 1.0, "kN": 1e3}[re.search(r"\[(.*)\]", heading.inner_text())[1]]

    def column():
        texts = page.locator("#impact-table tbody td:nth-child(6)").all_inner_texts()
        return [factor * float(text) for text in texts]

    for wanted in (forces, forces[::-1]):
        heading.click()
        assert all(abs(one - other) <= 1e-4 * abs(other) for one, other in zip(column(), wanted, strict=True))


def finds_an_impact(page, scene, impacts):
    from PIL import Image

    page.get_by_role("button", name="peak force").click()
    page.locator("#impact-table tbody tr").first.click()
    hardest = max(impacts, key=lambda impact: float(impact["peak_force"]))
    start, end = stretch(page)
    assert start < float(hardest["start_s"]) < float(hardest["end_s"]) < end < start + 0.05
    page.wait_for_timeout(300)
    # Of 256 colours: the picture of docs/pictures.md, a third of the size that all take.
    Image.open(io.BytesIO(page.screenshot())).convert("RGB").quantize(256).save(FOLDER / "impact.png", optimize=True)
    page.locator("#whole").click()


def is_narrow(page, scene, impacts):
    page.set_viewport_size({"width": 420, "height": 800})
    page.wait_for_timeout(200)
    assert page.evaluate("document.documentElement.scrollWidth") <= 420
    page.screenshot(path=FOLDER / "narrow.png")


def table(page, name):
    """Headings and rows of a table, as texts."""
    rows = page.locator(f"#{name}-table tr")
    cells = [rows.nth(row).locator("th, td").all_inner_texts() for row in range(rows.count())]
    return cells[0], cells[1:]


def has_levels(page, impacts):
    """Buildings with heights: beside each floor its level, and what each slab meets."""
    headings, rows = table(page, "peak")
    assert [row[0] for row in rows] == [*"654321"]
    pixels = drawn(page)
    assert min(pixels["left"], pixels["right"]) > 2000 and pixels["ink"] < 400, pixels
    # Nothing of what is not there.
    for section in ("yielding", "links"):
        assert not page.locator(f"#{section}").is_visible() and not page.locator(f"nav a[href='#{section}']").is_visible()
    for side, levels in [("left", ["20.2 m", "17 m", "13.8 m"]), ("right", ["", "", "15 m"])]:
        assert [row[headings.index(f"{side} level")] for row in rows[:3]] == levels
    meetings = [row[1] for row in table(page, "contact")[1]]
    assert len(meetings) == 7 and "columns of left storey 5 at 0.375" in meetings[-1]
    assert page.locator("#impact-table tbody tr").count() == len(impacts) > 0
    page.screenshot(path=FOLDER / "levels.png", full_page=True)


def stands_alone(page, impacts):
    """One building between walls: nothing of another one, and no text where a number is missing."""
    headings, rows = table(page, "peak")
    assert len(rows) == 5 and rows[-1][headings.index("left level")] == "0 m"
    assert not any("right" in heading for heading in headings)
    pixels = drawn(page)
    assert pixels["left"] > 2000 and pixels["right"] == 0, pixels
    assert page.locator(".chart").count() == 3
    texts = page.locator("body").inner_text()
    assert not re.search(r"NaN|undefined|null|Infinity", texts)
    assert [row[1].partition(" against ")[2] for row in table(page, "contact")[1]] == [
        "the wall on its left", "the wall on its right"
    ]  # fmt: skip
    page.screenshot(path=FOLDER / "alone.png", full_page=True)


def stands_in_a_row(page, impacts):
    """All buildings drawn, each in its colour; charts and table of the two that meet hardest, by their names."""
    hardest = max(impacts, key=lambda impact: float(impact["peak_force"]))
    (meeting,) = (row[1] for row in table(page, "contact")[1] if row[0] == hardest["contact"])
    assert "middle floor" in meeting and "tail floor" in meeting
    pixels = drawn(page)
    assert min(pixels["left"], pixels["right"], pixels["third"]) > 1000, pixels
    headings, rows = table(page, "peak")
    assert len(rows) == 4 and "tail level" in headings and not any("corner" in heading for heading in headings)
    labels = page.locator(".chart").first.locator(".u-legend .u-label").all_inner_texts()
    assert {label.split()[0] for label in labels[1:]} == {"middle", "tail"}, labels
    assert all(name in page.locator("#peak-shears").inner_text() for name in ("corner", "middle", "tail"))
    assert not re.search(r"NaN|undefined|null|Infinity", page.locator("body").inner_text())
    page.locator("#buildings").screenshot(path=FOLDER / "row.png")


def yields(page, impacts):
    """Storeys that can yield: a row each, and a loop within its axes that is as wide as the drifts are."""
    headings, rows = table(page, "yielding")
    assert [row[0] for row in rows] == ["left 4", "left 3", "left 2", "left 1", "right 3", "right 2", "right 1"]
    ductilities = [float(row[headings.index("ductility")]) for row in rows]
    assert max(ductilities) > 3.0 and min(ductilities) > 1.0
    figures = page.locator("#loops figure")
    captions = [figures.nth(at).locator("figcaption").inner_text() for at in range(figures.count())]
    named = [row[0].replace(" ", " storey ") for row in rows]
    assert captions == [f"{name}: ductility {float(f'{of:.3g}'):g}" for name, of in zip(named, ductilities)]
    yields_at = {"left 4": 530 / 110, "left 1": 1490 / 200, "right 1": 1150 / 250}  # mm
    for at, (row, ductility) in enumerate(zip(rows, ductilities)):
        lines, texts = figures.nth(at).locator("polyline"), figures.nth(at).locator("text").all_text_contents()
        x, y = zip(*(map(float, point.split(",")) for point in lines.get_attribute("points").split()))
        assert len(x) > 2000 and max(max(x) - 188, 188 - min(x)) > 120 and 9.9 <= min(y) <= max(y) <= 196.1
        assert texts[4:] == ["drift [mm]", "shear [kN]"]
        if row[0] in yields_at:
            assert abs(float(texts[2]) / (ductility * yields_at[row[0]]) - 1.0) < 6e-3, (row, texts)
    page.screenshot(path=FOLDER / "yielding.png", full_page=True)


def drawn(page):
    """How many pixels of the picture of the buildings have the colour of the left one, of the right one, of a third one and of links."""
    return page.evaluate("""() => {
        const canvas = document.getElementById("buildings");
        const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
        const colours = { left: [0, 114, 178], right: [213, 94, 0], third: [51, 34, 136], ink: [17, 17, 17] };
        const is = (at, colour) => data[at + 3] === 255 && colour.every((part, i) => Math.abs(data[at + i] - part) < 8);
        const starts = Array.from({ length: data.length / 4 }, (_, pixel) => 4 * pixel);
        const count = (colour) => starts.filter((at) => is(at, colour)).length;
        return Object.fromEntries(Object.entries(colours).map(([name, colour]) => [name, count(colour)]));
    }""")


def is_linked(page, impacts):
    """Links: a row, a loop and curves each, and what friction without hardening can only be: its force stays at that at which
    it slips, and it dissipates this force times the sum of all slips."""
    headings, rows = table(page, "link")
    assert [row[0] for row in rows] == ["1", "2", "3"]
    assert [row[2] for row in rows] == ["friction", "spring, dashpot", "dashpot"]
    assert rows[1][1].startswith("left floor 2") and rows[1][1].endswith("the ground"), rows[1]
    number = lambda row, heading: float(row[headings.index(heading)])  # noqa: E731
    assert number(rows[0], "peak force [kN]") == 60.0
    # In the unit of all lengths, which such a sum does not change.
    travel, dissipated = number(rows[0], "slip travel [mm]"), number(rows[0], "dissipated [kJ]")
    assert travel > 100.0 and abs(dissipated / (60.0 * travel * 1e-3) - 1.0) < 1e-3, (travel, dissipated)
    assert rows[2][headings.index("slip travel [mm]")] == ""
    assert drawn(page)["ink"] > 400, drawn(page)
    figures = page.locator("#link-loops figure")
    assert figures.count() == 3 and page.locator("#loops figure").count() == 7
    at_the_top = []
    for at in range(3):
        points = figures.nth(at).locator("polyline").get_attribute("points").split()
        ups = [float(point.split(",")[1]) for point in points]
        texts = figures.nth(at).locator("text").all_text_contents()
        assert len(points) > 2000 and texts[4:] == ["displacement [mm]", "force [kN]"]
        assert abs(float(texts[2]) / number(rows[at], "peak displacement [mm]") - 1.0) < 1e-2, texts
        at_the_top.append(sum(abs(up - min(ups)) < 0.2 for up in ups))
    assert at_the_top[0] > 100 > 20 > max(at_the_top[1:]), at_the_top
    charts = page.locator(".chart h3").all_inner_texts()
    assert {"link force [kN]", "link displacement [mm]"} <= set(charts) and len(charts) == 5, charts
    legend = page.locator(".chart", has_text="link force").locator(".u-legend .u-label").all_inner_texts()
    assert legend[1:] == ["link 1", "link 2", "link 3"], legend
    page.screenshot(path=FOLDER / "linked.png", full_page=True)


def stands_on_soil(page, impacts):
    """A row and curves for each foundation in the ways in which it moves; the rotation is the overturning moment over the
    stiffness where there is no dashpot. A loop of a storey that yields has the drift that strains it, up to its peak."""
    headings, rows = table(page, "foundation")
    assert [row[0] for row in rows] == ["left", "right"]
    number = lambda row, heading: float(row[headings.index(heading)])  # noqa: E731
    assert all(1.05 < number(row, "first period / on a fixed base") < 2.0 for row in rows), rows
    assert rows[1][headings.index("peak displacement [mm]")] == "" != rows[0][headings.index("peak displacement [mm]")]
    of_right = [number(rows[1], heading) for heading in ("peak moment [kN\u00a0m]", "peak rotation [mrad]")]
    assert abs(of_right[0] / of_right[1] / 12e3 - 1.0) < 1e-4, of_right
    charts = page.locator(".chart h3").all_inner_texts()
    assert {"foundation displacement [mm]", "foundation rotation [mrad]"} <= set(charts) and len(charts) == 5, charts
    legend = page.locator(".chart", has_text="foundation rotation").locator(".u-legend .u-label").all_inner_texts()
    assert legend[1:] == ["left", "right"], legend
    assert drawn(page)["ink"] > 300, drawn(page)
    _, drifts = table(page, "peak")
    peak = {f"{side} storey {row[0]}": float(row[at]) for row in drifts for side, at in (("left", 2), ("right", 7)) if row[at]}
    for figure in page.locator("#loops figure").all():
        storey = figure.locator("figcaption").inner_text().split(":")[0]
        assert abs(float(figure.locator("text").all_text_contents()[2]) / peak[storey] - 1.0) < 1e-2, (storey, peak)
    page.screenshot(path=FOLDER / "soil.png", full_page=True)


def has_no_peaks(page, impacts):
    """By how much the soil slows the buildings is said without peaks, too."""
    headings, rows = table(page, "foundation")
    assert headings == ["foundation", "first period / on a fixed base"] and len(rows) == 2, (headings, rows)
    assert page.locator("#foundations").is_visible() and not page.locator("#peaks").is_visible()


if __name__ == "__main__":
    main()
