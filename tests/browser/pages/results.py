"""What a run shows: motion, charts, impacts, peaks, loops, the study of the gap; and a long run that is stopped."""

import re

from .visit import FOLDER, KNOWN, impacts_of, line_at, lines, now, pixels, says, stretch, visit

# Two undamped frames that hit each other for ever, and hours of it.
LONG = [("stop_time = 20.0", "stop_time = 2e5"), ("ratio = 0.01", "ratio = 0.0"), ('"kelvin_voigt"', '"linear"'), ("restitution = 0.65", "")]

# Friction between the roofs of frames that yield, a dashpot between their first floors, in kN and m.
LINKS = """
[[link]]
left_floor = 3
right_floor = 3
stiffness = 30e3
slip_force = 60
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


def plays_and_stands_still(browser):
    with visit(browser) as page:
        page.locator("body").click(position={"x": 3, "y": 300})
        playing = page.locator("#play")
        assert playing.get_attribute("aria-label") == "Pause"
        page.keyboard.press("Space")
        assert playing.get_attribute("aria-label") == "Play"
        stands = now(page)
        page.wait_for_timeout(300)
        assert now(page) == stands
        page.locator("#speed").select_option("4")
        page.locator("body").click(position={"x": 3, "y": 300})
        page.keyboard.press("Space")
        page.wait_for_timeout(1000)
        page.keyboard.press("Space")
        assert 1.5 < now(page) - stands < 8.0, (stands, now(page))
        page.locator("#time").focus()
        page.keyboard.press("Home")
        assert now(page) == 0.0
        page.keyboard.press("n")
        assert abs(now(page) - 1.72) < 0.02, "the first impact"
        page.keyboard.press("n")
        page.keyboard.press("p")
        assert abs(now(page) - 1.72) < 0.02
        # Larger motion is drawn wider, and the bar of the scale says so.
        before = page.locator("#scale").inner_text()
        page.locator("#size").focus()
        for _ in range(8):
            page.keyboard.press("ArrowRight")
        page.wait_for_timeout(100)
        assert page.locator("#scale").inner_text() != before
        assert "roof" in page.locator("#buildings").get_attribute("aria-label")


def shows_both_with_and_without_contact(browser):
    with visit(browser) as page:
        page.locator("#alone").check()
        # On a slow machine the run without contact is still on its way when the page would say that it computes.
        page.evaluate("""() => {
            const { engine } = pounding, simulate = engine.simulate.bind(engine);
            engine.simulate = async (scene, options, heard, lane) => {
                if (lane === "alone") await new Promise((over) => setTimeout(over, 600));
                return simulate(scene, options, heard, lane);
            };
        }""")
        page.locator("#example").select_option(label="A frame that would fall without the neighbour that it leans on, 20 mm apart")
        says(page, "^32 impacts")
        page.wait_for_timeout(1200)
        says(page, "^32 impacts", seconds=1)
        page.locator("#time").focus()
        page.keyboard.press("End")
        page.wait_for_timeout(800)
        page.screenshot(path=FOLDER / "page_alone.png")
        # Held up on the left half, fallen on the right one: the blue slab there is elsewhere.
        held, fallen = page.locator("#buildings").evaluate("""canvas => {
            const pen = canvas.getContext("2d"), half = Math.floor(canvas.width / 2);
            const slab = (from) => {
                const { data } = pen.getImageData(from, 20, half, 60);
                const blue = (at) => data[at] === 0 && data[at + 1] === 114 && data[at + 2] === 178;
                return Math.min(...Array.from(data, (_, at) => (at % 4 === 0 && blue(at) ? (at / 4) % half : half)));
            };
            return [slab(0), slab(canvas.width - half)];
        }""")
        assert 0 < held < fallen - 15, (held, fallen)


def zooms_all_charts_together(browser):
    with visit(browser) as page:
        overs = page.locator("#chart-list .u-over")
        assert overs.count() == 6, overs.count()
        overs.nth(1).scroll_into_view_if_needed()
        box = overs.nth(1).bounding_box()
        across = lambda share: (box["x"] + share * box["width"], box["y"] + 50)  # noqa: E731
        page.mouse.move(*across(0.1))
        page.mouse.down()
        page.mouse.move(*across(0.2), steps=5)
        page.mouse.up()
        page.wait_for_timeout(100)
        assert all(abs(at - wanted) < 0.1 for at, wanted in zip(stretch(page), [2.0, 4.0])), stretch(page)
        page.mouse.click(*across(0.5))
        assert abs(now(page) - 3.0) < 0.06, now(page)
        assert all(abs(place - 0.5) < 0.02 for place in moments(page)), moments(page)
        page.mouse.move(*across(0.25))
        values = page.locator("#chart-list .u-legend .u-series:first-child .u-value").all_inner_texts()
        assert len(set(values)) == 1 and abs(float(values[0].split()[0]) - 2.5) < 0.06, values
        page.locator("#later").click()
        assert abs(stretch(page)[0] - 3.0) < 0.1
        page.mouse.dblclick(*across(0.5))
        page.wait_for_timeout(100)
        assert stretch(page) == [0.0, 20.0], stretch(page)
        page.locator("#nearer").click()
        assert abs(stretch(page)[1] - stretch(page)[0] - 10.0) < 0.1
        page.locator("#earlier").click()
        page.wait_for_timeout(100)
        wanted = (now(page) - stretch(page)[0]) / 10.0
        assert all(abs(place - wanted) < 0.02 for place in moments(page)), (moments(page), wanted)
        page.locator("#whole").click()
        assert stretch(page) == [0.0, 20.0]
        page.locator("#floors summary").click()
        page.locator("#floor-choice label", has_text="left 1").click()
        page.wait_for_timeout(100)
        assert "left 1" in " ".join(page.locator("[data-chart=displacement] .u-legend").inner_text().split())


def moments(page):
    """Where the line of the picture's time stands in each chart, as a share of its width."""
    return page.locator("#chart-list .moment").evaluate_all(
        "lines => lines.map(line => parseFloat(line.style.transform.match(/[\\d.]+/)[0]) / line.parentElement.clientWidth)"
    )


def sorts_impacts_and_goes_to_them(browser):
    with visit(browser) as page:
        page.wait_for_timeout(300)
        rows = page.locator("#impacts tbody tr")
        assert rows.count() == 108
        page.locator("#impacts th button", has_text="peak force").click()
        column = page.locator("#impacts thead th", has_text="peak force").evaluate("cell => cell.cellIndex")
        page.wait_for_timeout(300)
        forces = [float(text) for text in page.locator(f"#impacts tbody td:nth-child({column + 1})").all_inner_texts()]
        assert forces == sorted(forces, reverse=True) and abs(forces[0] - KNOWN[5][1]) < 1
        rows.first.click()
        start, end = stretch(page)
        assert start < 2.7119 < 2.7162 < end < start + 0.05, (start, end)
        assert abs(now(page) - 2.7135) < 1e-3 and page.locator("#impacts tr.chosen").count() == 1
        page.wait_for_timeout(200)
        page.screenshot(path=FOLDER / "page_impact.png")
        page.keyboard.press("ArrowDown") if rows.first.evaluate("row => row === document.activeElement") else rows.first.focus()
        page.keyboard.press("ArrowDown")
        page.keyboard.press("Enter")
        assert page.locator("#impacts tr.chosen").get_attribute("data-row") in ("1", "2")
        page.locator("#tab-loops").click()
        says(page, r"^Impact, contact", at="#panel-loops figcaption")


def says_the_peaks(browser):
    with visit(browser) as page:
        page.locator("#tab-impacts").focus()
        page.keyboard.press("ArrowRight")
        panel = page.locator("#panel-peaks")
        assert panel.is_visible() and page.locator("#panel-impacts").is_hidden()
        headings = panel.locator("th[scope=col]").all_inner_texts()
        assert "drift [mm]" in headings and "acceleration [g]" in headings
        # The README's largest drift of the right frame's first storey, for this gap.
        cells = panel.locator("table").nth(1).locator("tr").last.locator("td").first.inner_text()
        assert cells.split()[0] == "31.3", cells
        panel.locator(".goes").first.click()
        assert now(page) > 1.0


def draws_loops_where_storeys_yield(browser):
    with visit(browser) as page:
        page.locator("#example").select_option(label="Frames of four and three storeys that yield, 20 mm apart")
        says(page, "^4 impacts in 31.18 s")
        page.locator("#tab-loops").click()
        page.wait_for_timeout(300)
        captions = page.locator("#panel-loops figcaption").all_inner_texts()
        assert len(captions) == 8 and sum("ductility" in caption for caption in captions) == 7
        seen = pixels(page, "#panel-loops figure:nth-of-type(2) canvas")
        assert max(seen.get("213,94,0", 0), seen.get("0,114,178", 0)) > 100, seen
        page.screenshot(path=FOLDER / "page_loops.png")


def draws_links(browser):
    """Devices in the picture, which move with the floors and show when they slip; charts, loops and peaks of them."""
    with visit(browser) as page:
        page.locator("#example").select_option(label="Frames of four and three storeys that yield, 20 mm apart")
        says(page, "^4 impacts in 31.18 s")
        assert page.locator("[data-chart^=link]").count() == 0
        # No impact, whose star has the colour of a block that slips.
        page.locator("#scene").fill(page.locator("#scene").input_value().replace("gap = 0.02 ", "gap = 0.1 ") + LINKS)
        says(page, "^0 impacts in 31.18 s")
        assert "the link slips" in page.locator("#scale").inner_text()
        seen = [devices_at(page, 0.05 * step) for step in range(1, 160)]
        assert seen[0]["filled"] == 0 and any(one["filled"] > 20 for one in seen), "a block that slips is filled"
        farthest = max(seen, key=lambda one: one["roof"])
        assert farthest["roof"] > 20 and farthest["leftmost"] > seen[0]["leftmost"] + 4, (farthest, seen[0])
        page.screenshot(path=FOLDER / "page_links.png")
        charts = [f"[data-chart=link-{part}] .u-legend" for part in ("force", "displacement")]
        assert all("link 1" in page.locator(chart).inner_text() for chart in charts)
        page.locator("#tab-peaks").click()
        cells = page.locator("#panel-peaks table", has_text="what it joins").locator("tbody tr").all_inner_texts()
        assert len(cells) == 2 and "left floor 3" in cells[0] and re.search(r"\b60(\.0)?\b", cells[0]), cells
        page.locator("#tab-loops").click()
        captions = page.locator("#panel-loops figcaption").all_inner_texts()
        assert len(captions) == 9 and sum(caption.startswith("Link") for caption in captions) == 2, captions
        friction = next(caption for caption in captions if "friction" in caption)
        assert friction.startswith("Link 1 between") and friction.endswith("60\xa0kN"), friction
        page.wait_for_timeout(300)
        page.screenshot(path=FOLDER / "page_link_loops.png")


def draws_foundations(browser):
    """The soil in the picture, where slabs are level at rest and tilt as their foundation rocks; charts and peaks of it."""
    with visit(browser) as page:
        page.locator("#example").select_option(label="Frames of four and three storeys that yield, 20 mm apart")
        says(page, "^4 impacts in 31.18 s")
        assert page.locator("[data-chart^=foundation]").count() == 0
        page.locator("#scene").fill(page.locator("#scene").input_value() + SOIL)
        says(page, r"^\d\d impacts in 31.18 s")
        for part, sides in (("displacement", "left"), ("rotation", "right"), ("force", "left"), ("moment", "right")):
            assert sides in page.locator(f"[data-chart=foundation-{part}] .u-legend").inner_text(), part
        assert "right" not in page.locator("[data-chart=foundation-displacement] .u-legend").inner_text()
        tilted = [tilt_of(page, 0.05 * step) for step in range(120)]
        assert abs(tilted[0]) < 0.002 and max(tilted) > 0.02 and min(tilted) < -0.02, (tilted[0], min(tilted), max(tilted))
        tilt_of(page, 0.05 * max(range(120), key=lambda step: abs(tilted[step])))
        page.screenshot(path=FOLDER / "page_soil.png")
        page.locator("#tab-peaks").click()
        rows = page.locator("#panel-peaks table", has_text="on a fixed base").locator("tr").all_inner_texts()
        assert len(rows) == 3 and "rotation [mrad]" in rows[0] and rows[1].startswith("left\t1.28"), rows
        assert len(re.findall(r"\d s\b", rows[1])) == 4 and len(re.findall(r"\d s\b", rows[2])) == 2, rows
        page.locator("#tab-loops").click()
        assert page.locator("#panel-loops figcaption", has_text="ductility").count() == 7


def tilt_of(page, time):
    """At a time, the slope of the left roof: pixels down for each to the right, by the tops of its outermost columns of pixels."""
    page.locator("#time").evaluate("(bar, time) => { bar.value = time; bar.dispatchEvent(new Event('input')); }", time)
    return page.evaluate("""() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => {
        const { width, height } = document.querySelector("#buildings"), { data } = document.querySelector("#buildings")
            .getContext("2d").getImageData(0, 0, width, height);
        const is = (x, y) => [0, 114, 178].every((part, i) => Math.abs(data[4 * (y * width + x) + i] - part) < 60);
        const tops = [];
        for (let x = 0; x < width; x++) for (let y = 0; y < height; y++) if (is(x, y)) { tops.push([x, y]); break; }
        // The roof alone, which is the highest: the block below it may stand out.
        const highest = Math.min(...tops.map(([, y]) => y));
        const roof = tops.filter(([, y]) => y < highest + 25);
        const [from, to] = [roof[3], roof.at(-4)];
        done((to[1] - from[1]) / (to[0] - from[0]));
    })))""")


def devices_at(page, time):
    """At a time: the leftmost pixel of lines of devices, how many pixels are filled as a block that slips, and the displacement of
    the left roof, mm."""
    page.locator("#time").evaluate("(bar, time) => { bar.value = time; bar.dispatchEvent(new Event('input')); }", time)
    found = page.evaluate("""() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => {
        const canvas = document.querySelector("#buildings"), [width, height] = [canvas.width, canvas.height - 60];
        const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
        let [leftmost, filled] = [width, 0];
        for (let at = 0; at < data.length; at += 4) {
            const is = (r, g, b) => data[at] === r && data[at + 1] === g && data[at + 2] === b;
            const dark = data[at + 3] > 250 && Math.max(data[at], data[at + 1], data[at + 2]) < 130;
            if (dark) leftmost = Math.min(leftmost, (at / 4) % width);
            if (is(240, 228, 66)) filled++;
        }
        done({ leftmost, filled });
    })))""")
    roof = re.search(r"left roof (\S+) mm", page.locator("#buildings").get_attribute("aria-label"))[1]
    return {**found, "roof": float(roof)}


def studies_the_gap(browser):
    with visit(browser) as page:
        page.locator("#tab-study").click()
        page.locator("#study").click()
        text = says(page, "From .* on they never touch", at="#study-says")
        # As the scene's own comment has it.
        assert "From 102\xa0mm on" in text and "100 runs in" in text, text
        page.wait_for_timeout(200)
        page.screenshot(path=FOLDER / "page_study.png")
        charts = page.locator("#study-charts .u-over")
        assert charts.count() == 3
        box = charts.first.bounding_box()
        page.mouse.click(box["x"] + 0.999 * box["width"], box["y"] + 30)
        says(page, "^0 impacts in 20 s")
        gap = float(line_at(page, "gap")[0].split("=")[1])
        assert 0.12 < gap < 0.14, gap
        page.mouse.move(box["x"] + 0.5 * box["width"], box["y"] + 30)
        assert re.match(r"1[01][.\d]* mm", page.locator("#study-charts .u-value").first.inner_text())


def stops_a_long_run(browser):
    with visit(browser) as page:
        text = page.locator("#scene").input_value()
        for old, new in LONG:
            text = text.replace(old, new)
        page.locator("#scene").fill(text)
        says(page, "of 200000 s, .* impacts so far")
        # The page answers while it computes.
        longest = page.evaluate("""() => new Promise((done) => {
            let [last, longest, frames] = [performance.now(), 0, 0];
            const frame = (now) => {
                longest = Math.max(longest, now - last);
                last = now;
                if (++frames < 60) requestAnimationFrame(frame);
                else done(longest);
            };
            requestAnimationFrame(frame);
        })""")
        assert longest < 500, longest
        assert 0 < float(page.locator("#progress").get_attribute("value")) < 1
        took = page.evaluate("""() => {
            const begun = performance.now();
            document.querySelector("#stop").click();
            return [performance.now() - begun, document.querySelector("#stop").disabled];
        }""")
        assert took[0] < 200 and took[1], took
        says(page, "^Stopped at .* s of 200000 s: what you see goes up to there")
        page.keyboard.press("Control+z")
        says(page, "The scene has changed|^108 impacts")
        page.locator("#run").click()
        says(page, "^108 impacts")
        assert len(lines(page)) > 20


def is_fast_with_many_impacts(browser):
    with visit(browser) as page:
        text = page.locator("#scene").input_value()
        for old, new in LONG:
            text = text.replace(old, new.replace("2e5", "200.0"))
        # A machine that is never idle calls only what does not wait for that.
        page.evaluate("""() => {
            window.requestIdleCallback = (act, options) => options ? setTimeout(act, options.timeout) : 1;
        }""")
        page.locator("#scene").fill(text)
        says(page, r"^1\d\d\d impacts in 200 s")
        count = impacts_of(page)
        page.locator(f"#impacts tbody tr[data-row='{count - 1}']").wait_for(state="attached")
        assert page.locator("#impacts tbody tr").count() == count
        # Until the table stands sorted; the best of some, since others may use the machine.
        took = page.evaluate("""() => Math.min(...Array.from({ length: 4 }, () => {
            const begun = performance.now();
            document.querySelector("#impacts th button[data-key=impulse]").click();
            document.querySelector("#impacts").getBoundingClientRect();
            return performance.now() - begun;
        }))""")
        assert took < 150, took


LOOKS = [
    plays_and_stands_still, shows_both_with_and_without_contact, zooms_all_charts_together, sorts_impacts_and_goes_to_them,
    says_the_peaks, draws_loops_where_storeys_yield, draws_links, draws_foundations, studies_the_gap, stops_a_long_run,
    is_fast_with_many_impacts,
]  # fmt: skip
