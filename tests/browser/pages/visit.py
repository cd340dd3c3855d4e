"""A visit to the page: opened in a fresh profile without network; at its end nothing may have gone wrong."""

import re
import sys
from contextlib import contextmanager
from pathlib import Path

from browser import listen

ROOT = Path(__file__).resolve().parents[3]
FOLDER = ROOT / "target/browser"
TEMPLATE = ROOT / "target/page/template.html"
WIDE = {"width": 1440, "height": 900}
PHONE = {"width": 390, "height": 844}
# What the default scene does, as the README prints it: impacts by gap in mm, and the largest force in N.
KNOWN = {5: (108, 990), 20: (37, 1089), 50: (9, 1312), 110: (0, 0)}
# Not a library, but bytes that an FMU can be made with.
LIBRARIES = {"linux64": b"\x7fELF a library" * 99, "win64": b"MZ another" * 99}


def make_page(name="page.html", **given):
    """The page with libraries, and with a scene and records that are given; returns its file."""
    sys.path.insert(0, str(ROOT / "ci"))
    from releasing.page import assembly

    if not TEMPLATE.exists():
        sys.exit(f"{TEMPLATE} is not there: ci/page makes it")
    FOLDER.mkdir(parents=True, exist_ok=True)
    (FOLDER / name).write_text(assembly.assembled(TEMPLATE.read_text(), LIBRARIES, **given))
    return FOLDER / name


@contextmanager
def visit(browser, hash="", waits=True, file=FOLDER / "page.html", **context):
    """The page after its first run, in a context of its own."""
    options = {"viewport": WIDE, "offline": True, "accept_downloads": True} | context
    profile = browser.new_context(**options)
    page = profile.new_page()
    troubles = listen(page, "blob:", "data:")
    page.goto(file.as_uri() + hash)
    if waits:
        says(page, r"^\d+ impacts? in ")
    yield page
    assert not troubles, troubles
    profile.close()


def says(page, pattern, seconds=20, at="#happened"):
    """Waits until a line of the page says something, and returns it."""
    line = page.locator(at)
    for _ in range(int(seconds * 20)):
        text = line.inner_text()
        if re.search(pattern, text):
            return text
        page.wait_for_timeout(50)
    raise AssertionError(f"{at} says {text!r}, expected {pattern!r}")


def says_the_run(page, gap):
    """Waits until the page tells of the default scene's run with a gap in mm: a slow machine computes those on the way."""
    impacts, force = KNOWN[gap]
    return says(page, rf"^{impacts} impacts in .*hardest: {force}\sN")


def impacts_of(page):
    """How many impacts the page says that there are."""
    return int(re.match(r"(\d+) impact", page.locator("#happened").inner_text())[1])


def lines(page):
    """The scene's text, by lines."""
    return page.locator("#scene").input_value().split("\n")


def line_at(page, key):
    """The lines that set a key."""
    return [line for line in lines(page) if re.match(rf"{key}\s*=", line)]


def stretch(page):
    """From where to where the charts show time, as the page says it."""
    return [float(number) for number in re.findall(r"[\d.]+", page.locator("#shown").inner_text())]


def now(page):
    """The time of the picture, s."""
    return float(page.locator("#now").inner_text().removesuffix(" s"))


def pixels(page, canvas):
    """How many pixels of a canvas have each colour, as [r, g, b, count]."""
    return page.locator(canvas).evaluate("""canvas => {
        const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
        const counts = new Map();
        for (let at = 0; at < data.length; at += 4) {
            const colour = `${data[at]},${data[at + 1]},${data[at + 2]}`;
            if (data[at + 3] > 250) counts.set(colour, (counts.get(colour) ?? 0) + 1);
        }
        return Object.fromEntries(counts);
    }""")
