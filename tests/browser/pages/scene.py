"""The scene: seen at once, edited by text and by handles, undone, kept, sent in a link; records."""

import json
import math
import re

from .visit import (
    FOLDER,
    KNOWN,
    ROOT,
    impacts_of,
    line_at,
    lines,
    make_page,
    now,
    pixels,
    says,
    says_the_run,
    visit,
)

# A mass in t where kg are expected.
TOO_LIGHT = """name = "Light"
left = { mass = [150.0], stiffness = [180e6], damping = { ratio = 0.05 } }
right = { mass = [120e3], stiffness = [150e6], damping = { ratio = 0.05 } }
"""
AT2 = "A test\nby hand\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= {0}, DT= .0100 SEC\n{1}\n"


def shows_a_collision_before_anything_is_done(browser):
    with visit(browser) as page:
        assert impacts_of(page) == KNOWN[5][0]
        assert page.locator("#welcome").is_visible()
        assert page.locator("#impacts tbody tr").count() > 50
        begun = now(page)
        page.wait_for_timeout(700)
        assert now(page) > begun + 0.1, "the buildings do not move by themselves"
        # The flash of an impact, and both buildings in their colours.
        page.locator("#after").click()
        page.wait_for_timeout(200)
        seen = pixels(page, "#buildings")
        assert all(seen.get(colour, 0) > 100 for colour in ["240,228,66", "0,114,178", "213,94,0"]), seen
        page.locator("#understood").click()
        assert page.locator("#welcome").is_hidden()
        page.reload()
        says(page, "^108 impacts")
        assert page.locator("#welcome").is_hidden()


def says_what_is_wrong_at_its_line(browser):
    with visit(browser) as page:
        page.locator("#scene").focus()
        place = lines(page).index("mass = [3.65, 3.65]")
        page.keyboard.press("Control+Home")
        for _ in range(place):
            page.keyboard.press("ArrowDown")
        page.keyboard.press("End")
        page.keyboard.press("Backspace")
        says(page, "mistake in the scene; what you see is the last run")
        page.keyboard.type("]")
        says(page, "^108 impacts")
        for _ in range(2):
            page.keyboard.press("Backspace")
        page.keyboard.type("x]")
        says(page, "^[12] mistakes? in the scene")
        problem = page.locator("#problems li.problem").first.inner_text()
        assert f"line {place + 1}" in problem, problem
        assert page.locator(".gutter .problem").all_inner_texts() == ["\u2715"]
        assert page.locator("#impacts tbody tr").count() == KNOWN[5][0], "the last good run is gone"
        assert page.locator("#scene").get_attribute("aria-invalid") == "true"
        page.locator("#problems button").first.click()
        start = page.locator("#scene").evaluate("area => area.selectionStart")
        assert page.locator("#scene").input_value()[:start].count("\n") == place
        page.keyboard.press("Control+z")
        says(page, "^108 impacts")
        assert page.locator("#problems li").count() == 0


def warns_of_slips(browser):
    with visit(browser) as page:
        page.locator("#scene").fill(TOO_LIGHT)
        says(page, "left.mass", at="#problems")
        assert page.locator("#problems li.warning").count() >= 1
        assert page.evaluate("pounding.warnings(document.querySelector('#scene').value)")[0] in page.locator("#problems").inner_text()


def has_handles_that_write_the_text(browser):
    with visit(browser) as page:
        page.locator("#gap").focus()
        for _ in range(30):
            page.keyboard.press("ArrowRight")
        says_the_run(page, gap=20)
        assert line_at(page, "gap") == ["gap = 0.02"] * 2
        assert page.locator("#gap-number").input_value() == "20"
        # One step back is the whole way of the slider.
        page.keyboard.press("Control+z")
        says(page, "^108 impacts")
        assert page.locator("#gap").input_value() == "0.005"
        page.keyboard.press("Control+Shift+z")
        says_the_run(page, gap=20)
        page.locator("#gap-number").fill("110")
        page.keyboard.press("Enter")
        says(page, "^0 impacts")
        assert page.locator("#no-impacts").is_visible()
        # The text moves the handles.
        page.locator("#scene").fill(page.locator("#scene").input_value().replace("gap = 0.11", "gap = 0.05"))
        says_the_run(page, gap=50)
        assert page.locator("#gap-number").input_value() == "50"
        page.locator("#gap-of").select_option("2")
        page.locator("#gap-number").fill("60")
        page.keyboard.press("Enter")
        page.wait_for_timeout(300)
        assert line_at(page, "gap") == ["gap = 0.05", "gap = 0.06"]


def follows_a_handle_while_it_is_dragged(browser):
    with visit(browser) as page:
        box = page.locator("#gap").bounding_box()
        at = lambda gap: box["x"] + 8 + gap / 0.2 * (box["width"] - 16)  # noqa: E731
        page.mouse.move(at(0.005), box["y"] + box["height"] / 2)
        page.mouse.down()
        seen = set()
        for step in range(40):
            page.mouse.move(at(0.005 + 0.115 * step / 39), box["y"] + box["height"] / 2)
            page.wait_for_timeout(40)
            seen.add(page.locator("#happened").inner_text().split()[0])
        assert len(seen) > 8, seen
        says(page, "^0 impacts")
        # However long it is held there.
        page.wait_for_timeout(1200)
        # And back to where it was, in one go.
        page.mouse.move(at(0.005), box["y"] + box["height"] / 2)
        page.mouse.up()
        says(page, "^1[01]. impacts")
        assert abs(float(line_at(page, "gap")[0].split("=")[1]) - 0.005) < 0.0011
        page.keyboard.press("Control+z")
        says(page, "^108 impacts")


def changes_strength_law_and_storeys(browser):
    with visit(browser) as page:
        page.locator("#strength-number").fill("0.5")
        page.keyboard.press("Enter")
        says(page, r"peak 0\.159 g", at="#strength-says")
        assert line_at(page, "scale") == ["scale = 0.5"]
        page.locator("#strength").focus()
        page.keyboard.press("Home")
        says(page, "^0 impacts")
        assert line_at(page, "scale") == ["scale = 0.0"] and page.locator("#strength-number").input_value() == "0"
        page.keyboard.press("Control+z")
        says(page, "^(?!0 )")
        before = len([line for line in lines(page) if line.startswith("#")])
        page.locator("#law").select_option("stereomechanical")
        says(page, r"N s at ")
        assert line_at(page, "law") == ['law = "stereomechanical"'] * 2 and not line_at(page, "exponent")
        page.get_by_role("button", name="One storey more on the left").click()
        says(page, "^3$", at="#left-storeys")
        page.get_by_role("button", name="One storey more on the right").click()
        says(page, "^4$", at="#right-storeys")
        masses = line_at(page, "mass")
        assert [mass.count("3.65") for mass in masses] == [3, 4], masses
        assert len([line for line in lines(page) if line.startswith("#")]) == before, "comments are gone"
        page.get_by_role("button", name="One storey less on the right").click()
        says(page, "^3$", at="#right-storeys")
        while page.locator("#undo").is_enabled():
            page.locator("#undo").click()
        says(page, "^108 impacts")
        assert page.locator("#undo").is_disabled()


def opens_every_example(browser):
    with visit(browser) as page:
        for at, example in enumerate(page.locator("#example option").all_inner_texts()[1:]):
            page.locator("#example").select_option(label=example)
            page.wait_for_timeout(150)
            assert example in page.locator("#scene").input_value(), at
            says(page, r"impacts? in [\d.]+ s")
            assert page.locator("#problems li.problem").count() == 0
            for tab in ["peaks", "loops", "spectrum", "impacts"]:
                page.locator(f"#tab-{tab}").click()
                text = page.locator(f"#panel-{tab}").inner_text()
                assert text and not re.search(r"NaN|undefined|null|Infinity|\[object", text), (example, tab, text)
                # The mark of a number that is not there stands in legends only.
                assert tab == "spectrum" or "\u2013" not in text, (example, tab, text)
            page.screenshot(path=FOLDER / f"page_example_{at}.png")


def takes_records(browser):
    sine = [0.3 * math.sin(2 * math.pi * 2.0 * 0.01 * k) for k in range(2000)]
    at2 = AT2.format(len(sine), "\n".join(" ".join(f"{a:.6E}" for a in sine[k : k + 5]) for k in range(0, len(sine), 5)))
    with visit(browser) as page:
        page.locator("#record").set_input_files({"name": "SINE.AT2", "mimeType": "text/plain", "buffer": at2.encode()})
        says(page, r"2000 samples, 19\.99 s, peak 0\.299 g", at="#record-says")
        assert line_at(page, "record") == ['record = "SINE.AT2"']
        says(page, "^(?!108).* impacts in")
        page.locator("#tab-spectrum").click()
        page.wait_for_selector("#record-charts .chart:nth-of-type(2) canvas")
        page.wait_for_timeout(200)
        # At its own period a mast of 5 % swings 1 / (2 x 0.05) times as far as it would stand.
        box = page.locator("#record-charts .u-over").nth(1).bounding_box()
        share = math.log(0.5 / 0.04) / math.log(5.0 / 0.04)
        page.mouse.move(box["x"] + share * box["width"], box["y"] + 40)
        period, value = page.locator("#record-charts .chart").nth(1).locator(".u-value").all_inner_texts()
        ratio = float(period.removesuffix(" s")) / 0.5
        swing = 1.0 / math.hypot(1 - ratio**2, 2 * 0.05 * ratio)
        assert abs(float(value) / (0.3 * swing) - 1.0) < 0.03, (period, value, swing)
        assert "0.36 s" in page.locator("#record-charts").inner_text(), "the first period of the left frame"
        page.screenshot(path=FOLDER / "page_record.png")
        drop(page, "dropped.csv", "time_s,accel_m_s2\n0,0\n1,3\n2,-4\n3,0\n")
        says(page, r"4 samples, 3 s, peak 0\.408 g", at="#record-says")
        assert page.locator("#ground-record option:checked").inner_text() == "dropped.csv"
        page.locator("#ground-record").select_option(label="SINE.AT2")
        says(page, "2000 samples", at="#record-says")
        drop(page, "none.txt", "this is no record")
        says(page, "none.txt.*expected a record file", at="#record-says")
        assert line_at(page, "record") == ['record = "SINE.AT2"']


def reads_what_a_file_does_not_say(browser):
    sine = [0.3 * math.sin(2 * math.pi * 2.0 * 0.01 * k) for k in range(2000)]
    with visit(browser) as page:
        drop(page, "one.txt", "\n".join(f"{a:.6f}" for a in sine))
        says(page, "one.txt.*1 column of numbers.*step", at="#record-says")
        assert page.locator("#record-unsaid").get_attribute("open") is not None
        before = page.locator("#scene").input_value()
        page.locator("#record-step").fill("0.01")
        page.locator("#record-step").blur()
        says(page, "nothing says the unit", at="#record-says")
        assert page.locator("#scene").input_value() == before, "a record that cannot be read yet changes nothing"
        page.locator("#record-unit").select_option("g")
        says(page, r"2000 samples, 19\.99 s, peak 0\.299 g", at="#record-says")
        assert line_at(page, "record") == ['record = { file = "one.txt", step = 0.01, unit = "g" }']
        page.screenshot(path=FOLDER / "page_unsaid.png")
        # Two components about another level, of which the second is wanted.
        rows = "".join(f"{0.01 * k:.2f},{a:.6f},{2 * a + 0.5:.6f}\n" for k, a in enumerate(sine))
        drop(page, "two.csv", f"time [s],N-S [m/s2],E-W [m/s2]\n{rows}")
        says(page, "two.csv.*3 columns of numbers.*#3 E-W", at="#record-says")
        page.locator("#record-column").fill("E-W")
        page.locator("#record-column").blur()
        says(page, r"2000 samples, 19\.99 s, peak 0\.112 g", at="#record-says")
        assert line_at(page, "record") == ['record = { file = "two.csv", column = "E-W" }']
        says(page, "its mean is 0.5 m/s2", at="#problems")
        page.locator("#record-remove-mean").check()
        says(page, r"2000 samples, 19\.99 s, peak 0\.0611 g", at="#record-says")
        assert line_at(page, "record") == ['record = { file = "two.csv", column = "E-W", remove_mean = true }']
        # What says everything itself leaves nothing of that.
        drop(page, "plain.csv", "time_s,accel_m_s2\n0,0\n1,3\n2,-4\n3,0\n")
        says(page, r"4 samples, 3 s, peak 0\.408 g", at="#record-says")
        assert line_at(page, "record") == ['record = "plain.csv"']
        assert not page.locator("#record-remove-mean").is_checked() and page.locator("#record-unit").input_value() == ""


def says_when_a_record_is_not_there_any_more(browser):
    rows = "".join(f"{0.01 * k:.2f},{(k * 7919) % 1000 / 500 - 1:.9f}\n" for k in range(130_000))
    with visit(browser) as page:
        drop(page, "large.csv", f"time_s,accel_m_s2\n{rows}")
        says(page, "large.csv is read. It is too large for the browser to keep", at="#saved")
        says(page, "130000 samples", at="#record-says")
        page.wait_for_timeout(900)
        page.reload()
        says(page, "1 mistake in the scene; nothing has run yet")
        says(page, "large.csv.*not in the browser", at="#record-says")
        drop(page, "large.csv", f"time_s,accel_m_s2\n{rows}")
        says(page, "impacts? in 20 s")
        drop(page, "__proto__", "time_s,accel_m_s2\n0,0\n1,3\n2,0\n")
        says(page, "3 samples", at="#record-says")


def takes_one_channel_of_several(browser):
    block = "2 points of accel data equally spaced at .5 sec, in g. (8f10.3)\n{:10.3f}{:10.3f}\n"
    with visit(browser) as page:
        drop(page, "CHAN.v2", block.format(0.1, 0.2) + "/&  ----------  End of data for channel  1  ----------\n" + block.format(0.3, 0.4))
        says(page, r"2 samples, 0\.5 s, peak 0\.2 g", at="#record-says")
        page.locator("#ground-record").select_option("CHAN.v2#2")
        says(page, r"peak 0\.4 g", at="#record-says")
        assert line_at(page, "record") == ['record = "CHAN.v2#2"']


def opens_the_scene_that_it_was_made_for(browser):
    record = "time_s,accel_m_s2\n0,0\n1,2\n2,-1\n3,0\n"
    scene = (ROOT / "examples/scenes/two_blocks.toml").read_text().replace("../records/el_centro_1940_ns.csv", "mine/own.csv")
    file = make_page("page_given.html", scene={"file": "own.toml", "text": scene}, records={"mine/own.csv": record.encode()})
    with visit(browser, file=file, waits=False) as page:
        says(page, r"impacts? in 20 s")
        assert page.locator("#scene").input_value() == scene
        says(page, "4 samples, 3 s", at="#record-says")
        assert page.locator("#example option:checked").inner_text() == "own.toml"
        page.locator("#example").select_option(label="FEUP laboratory frames, 2 and 3 storeys, 5 mm apart, El Centro 1940 NS")
        says(page, "^108 impacts")
        page.locator("#example").select_option(label="own.toml")
        assert page.locator("#scene").input_value() == scene


def drop(page, name, text):
    """Drops a file anywhere."""
    page.evaluate("""([name, text]) => {
        const carried = new DataTransfer();
        carried.items.add(new File([text], name));
        for (const type of ["dragenter", "dragover", "drop"]) {
            document.body.dispatchEvent(new DragEvent(type, { dataTransfer: carried, bubbles: true, cancelable: true }));
        }
    }""", [name, text])  # fmt: skip


def survives_a_reload_and_travels_in_a_link(browser):
    with visit(browser) as page:
        drop(page, "mine.csv", "time_s,accel_m_s2\n0,0\n0.5,4\n1,-4\n1.5,0\n")
        says(page, "4 samples", at="#record-says")
        page.locator("#gap-number").fill("7")
        page.keyboard.press("Enter")
        page.wait_for_timeout(1500)
        text, happened = page.locator("#scene").input_value(), says(page, r"impacts in 20 s.*Computed")
        page.reload()
        again = says(page, r"impacts in 20 s")
        assert page.locator("#scene").input_value() == text and again.split(" Computed")[0] == happened.split(" Computed")[0]
        page.locator("#link").click()
        says(page, "the whole scene", at="#link-says")
        address = page.locator("#link-text").input_value()
        page.keyboard.press("Escape")
        assert page.locator("#link-box").is_hidden()
    hash = address[address.index("#") :]
    with visit(browser, hash=hash) as page:
        assert page.locator("#scene").input_value() == text
        assert page.locator("#happened").inner_text().split(" Computed")[0] == happened.split(" Computed")[0]
        # What is changed after that is what a reload brings, not the link again.
        page.locator("#gap-number").fill("9")
        page.keyboard.press("Enter")
        page.wait_for_timeout(1500)
        page.reload()
        says(page, r"impacts in 20 s")
        assert page.locator("#gap-number").input_value() == "9"
        page.evaluate("hash => { location.hash = hash; }", hash)
        says(page, r"impacts in 20 s.*Computed")
        assert page.locator("#scene").input_value() == text
    with visit(browser, hash="#scene=notpacked") as page:
        assert impacts_of(page) == 108
        says(page, "no scene that can be read", at="#saved")


def says_when_a_record_is_too_large_for_a_link(browser):
    rows = "\n".join(f"{0.001 * k:.3f},{(k * 7919) % 1000 / 500 - 1:.3f}" for k in range(9000))
    with visit(browser) as page:
        drop(page, "long.csv", f"time_s,accel_m_s2\n{rows}\n")
        says(page, "9000 samples", at="#record-says")
        page.locator("#link").click()
        says(page, "long.csv is too large for a link", at="#link-says")


def answers_scripts(browser):
    with visit(browser, waits=False) as page:
        page.evaluate("pounding.ready.then(() => 1)")
        text = page.evaluate("new Promise(done => setTimeout(() => done(document.querySelector('#scene').value), 500))")
        assert page.evaluate("scene => pounding.problems(scene)", text) == []
        assert page.evaluate("() => pounding.problems('name = 3')")
        run = page.evaluate("""async scene => {
            const { time, columns, impacts } = await pounding.simulate(scene, { step: 0.01, stop: 20, parameters: { "contact[1].gap": 0.02, "contact[2].gap": 0.02 } });
            return { rows: time.length, floats: columns.impacts instanceof Float64Array, impacts: impacts.length, keys: Object.keys(impacts[0]), last: columns.impacts.at(-1) };
        }""", text)  # fmt: skip
        assert run["rows"] == 2001 and run["floats"] and run["impacts"] == run["last"] == KNOWN[20][0], json.dumps(run)
        assert run["keys"][:3] == ["contact", "start_s", "end_s"]
        says(page, "^108 impacts")


LOOKS = [
    shows_a_collision_before_anything_is_done, says_what_is_wrong_at_its_line, warns_of_slips, has_handles_that_write_the_text,
    follows_a_handle_while_it_is_dragged,
    changes_strength_law_and_storeys, opens_every_example, takes_records, survives_a_reload_and_travels_in_a_link,
    says_when_a_record_is_too_large_for_a_link, takes_one_channel_of_several, reads_what_a_file_does_not_say,
    says_when_a_record_is_not_there_any_more, opens_the_scene_that_it_was_made_for,
    answers_scripts,
]  # fmt: skip
