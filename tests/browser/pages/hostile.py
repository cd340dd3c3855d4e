"""Input that means no good, or too much of it: a sentence each, and the page goes on."""

import math
import random

from .scene import drop
from .visit import FOLDER, says, visit

MARKUP = "<img src=x onerror=alert(1)><script>alert(2)</script>"


def takes_markup_for_text(browser):
    with visit(browser) as page:
        text = page.locator("#scene").input_value().replace('description = "', f'description = "{MARKUP} ')
        page.locator("#scene").fill(text.replace("restitution = 0.65", f'restitution = "{MARKUP}"'))
        says(page, "mistake")
        assert MARKUP.split(">")[0] in page.locator("#problems").inner_text()
        page.locator("#scene").fill(text)
        says(page, "^108 impacts")
        drop(page, f"{MARKUP.replace('/', '')}.csv", "time_s,accel_m_s2\n0,0\n1,3\n2,0\n")
        says(page, "3 samples", at="#record-says")
        page.locator("#tab-spectrum").click()
        says(page, "<img src=x", at="#record-facts")
        assert page.locator("img").count() == 0


def takes_bytes_of_any_kind(browser):
    random.seed(1)
    with visit(browser) as page:
        for size in [0, 1, 1000, 2_000_000]:
            junk = b"\xff" + random.randbytes(size)
            page.locator("#record").set_input_files({"name": "junk", "mimeType": "x/y", "buffer": junk})
            says(page, "junk.*expected", at="#record-says")
            page.locator("#open-scene").set_input_files({"name": "junk.toml", "mimeType": "x/y", "buffer": junk})
            says(page, "junk.toml is no text", at="#saved")
        assert page.locator("#impacts tbody tr").count() > 50
        assert "FeupFrames" in page.locator("#scene").input_value()


def takes_fifty_megabytes(browser):
    FOLDER.mkdir(parents=True, exist_ok=True)
    junk, scene, record = (FOLDER / name for name in ["junk.txt", "large.toml", "large.csv"])
    junk.write_bytes(b"1 2 3 x\n" * 6_250_000)
    scene.write_bytes(b"a = 1\n" * 8_300_000)
    period = "".join(f"{{}}.{k:03d},{math.sin(2 * math.pi * k / 1000):.3f}\n" for k in range(1000))
    record.write_text("time_s,accel_m_s2\n" + "".join(period.replace("{}", str(second)) for second in range(3300)))
    with visit(browser) as page:
        page.locator("#record").set_input_files(junk)
        says(page, "junk.txt.*expected a record file", at="#record-says", seconds=60)
        page.locator("#open-scene").set_input_files(scene)
        says(page, "expected a scene of at most", at="#saved", seconds=60)
        page.locator("#scene").evaluate("area => { area.value = 'x'.repeat(5e7); area.dispatchEvent(new Event('input')); }")
        says(page, "50.0 million letters: expected a scene of at most", at="#saved")
        assert "FeupFrames" in page.locator("#scene").input_value()
        page.locator("#record").set_input_files(record)
        says(page, "3300000 samples", at="#record-says", seconds=120)
        says(page, "impacts? in 20 s", seconds=60)
        page.locator("#scene").focus()
        page.keyboard.press("Control+z")
        says(page, "1560 samples", at="#record-says", seconds=60)
    for file in [junk, scene, record]:
        file.unlink()


def takes_absurd_numbers(browser):
    with visit(browser) as page:
        good = page.locator("#scene").input_value()
        for old, new in [("gap = 0.005", "gap = 1e308"), ("gap = 0.005", "gap = nan"), ("[3.65, 3.65]", "[1e-300, 3.65]"), ("stop_time = 20.0", "stop_time = 1e300"),
                         ("stop_time = 20.0", "stop_time = 1e-300"), ("stiffness = 1.0e6", "stiffness = 1e300"), ('record = "', 'scale = 1e300\nrecord = "')]:  # fmt: skip
            page.locator("#scene").fill(good.replace(old, new))
            page.wait_for_timeout(600)
            assert page.locator("#happened").inner_text().strip(), new
            # The run may have ended by itself: a click on a button that is disabled does nothing.
            page.locator("#stop").evaluate("button => button.click()")
        page.locator("#scene").fill(good)
        says(page, "The scene has changed|^108 impacts")
        page.locator("#run").click()
        says(page, "^108 impacts")
        page.locator("#gap-number").fill("1e400")
        page.keyboard.press("Enter")
        page.locator("#gap-number").fill("-1")
        page.keyboard.press("Enter")
        page.wait_for_timeout(500)
        assert page.locator("#happened").inner_text()


def sends_nothing_anywhere(browser):
    """The other visits see that nothing is asked for; here that it could not be."""
    with visit(browser) as page:
        policy = page.locator("meta[http-equiv=Content-Security-Policy]").get_attribute("content")
        assert policy.startswith("default-src 'none'") and "connect-src" not in policy and "http" not in policy


LOOKS = [takes_markup_for_text, takes_bytes_of_any_kind, takes_fifty_megabytes, takes_absurd_numbers, sends_nothing_anywhere]
