"""For everyone: by keys alone, with a screen reader's names, dark and light, on a phone, without motion."""

import io

from .visit import FOLDER, PHONE, WIDE, now, says, visit

NAMELESS = """() => [...document.querySelectorAll("button, input, select, textarea, progress, canvas[role], [role=tabpanel], nav, dialog")]
    .filter((one) => !one.closest("[aria-hidden=true]") && !(one.getAttribute("aria-label") || one.labels?.length
        || one.getAttribute("aria-labelledby") || (one.tagName === "BUTTON" && one.textContent.trim())))
    .map((one) => one.outerHTML.slice(0, 80))"""
# Ratio of the luminances of a text and what is behind it, as WCAG has it; texts below 4.5.
FAINT = """() => {
    const numbers = (colour) => colour.match(/[\\d.]+/g).map(Number);
    const light = ([r, g, b]) => [r, g, b].map((c) => c / 255).map((c) => (c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4))
        .reduce((sum, c, at) => sum + c * [0.2126, 0.7152, 0.0722][at], 0);
    const behind = (one) => {
        for (; one; one = one.parentElement) {
            const colour = numbers(getComputedStyle(one).backgroundColor);
            if (colour.length < 4 || colour[3] === 1) return colour;
        }
        return [255, 255, 255];
    };
    const faint = [];
    for (const one of document.querySelectorAll("body *")) {
        const own = [...one.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim());
        if (!own || !one.checkVisibility({ visibilityProperty: true }) || one.id === "scene" || one.matches(":disabled, :disabled *, option, script, style")) continue;
        const [text, back] = [light(numbers(getComputedStyle(one).color)), light(behind(one))];
        const ratio = (Math.max(text, back) + 0.05) / (Math.min(text, back) + 0.05);
        if (ratio < 4.5) faint.push(`${ratio.toFixed(2)} ${one.tagName} ${one.id || one.className} ${one.textContent.slice(0, 30)}`);
    }
    return faint;
}"""
SMALL = """() => [...document.querySelectorAll("button, select, input:not([type=checkbox]), .file, summary, label.check")]
    .filter((one) => one.checkVisibility() && !one.closest(".file input, th") && one.type !== "file")
    .map((one) => [one.getBoundingClientRect(), one])
    .filter(([box]) => box.width > 0 && box.height < 43.5)
    .map(([box, one]) => `${box.height.toFixed(0)} ${one.tagName} ${one.id || one.className || one.textContent}`)"""


def has_names_for_everything(browser):
    with visit(browser) as page:
        for tab in ["peaks", "loops", "study", "spectrum", "impacts"]:
            page.locator(f"#tab-{tab}").click()
            assert page.evaluate(NAMELESS) == []
        for id in ["scene", "record", "gap", "strength", "run", "stop", "problems", "impacts", "save-fmu", "save-csv", "save-report", "save-scene"]:
            assert page.locator(f"#{id}").count() == 1, id
        page.locator("#chart-list [role=img][aria-label^=Energy]").wait_for()
        charts = page.locator("#chart-list [role=img]").evaluate_all("charts => charts.map(chart => chart.getAttribute('aria-label'))")
        assert charts[0].startswith("Displacement of floors [mm]: left 2 from -44.6 to "), charts
        live = page.locator("[aria-live=polite], [role=status]").evaluate_all("ones => ones.map(one => one.id)")
        assert {"happened", "problems", "saved", "record-says", "study-says"} <= set(live), live


def goes_by_keys_alone(browser):
    with visit(browser) as page:
        seen = []
        for _ in range(75):
            page.keyboard.press("Tab")
            seen.append(page.evaluate("""() => {
                const one = document.activeElement;
                const shown = one.closest(".file, .editor") ?? one;
                const box = shown.getBoundingClientRect();
                const style = getComputedStyle(shown);
                const visible = box.width > 2 && box.height > 2 && style.outlineStyle !== "none" && parseFloat(style.outlineWidth) >= 1;
                return [one.id || one.textContent.trim().slice(0, 20) || one.tagName, one === document.body || visible];
            }"""))
            if page.evaluate("document.activeElement.id") == "scene":
                # A textarea keeps no tabulator to itself.
                continue
        names = [name for name, _ in seen]
        assert all(visible for _, visible in seen), [name for name, visible in seen if not visible]
        for wanted in ["example", "run", "theme", "play", "time", "speed", "gap", "gap-number", "strength", "law", "record", "scene", "tab-impacts", "save-fmu", "link"]:
            assert wanted in names, (wanted, names)
        page.keyboard.press("Control+Enter")
        says(page, "^108 impacts")


def is_dark_and_light(browser):
    for scheme in ["light", "dark"]:
        with visit(browser, color_scheme=scheme) as page:
            page.locator("#after").click()
            page.wait_for_timeout(200)
            page.screenshot(path=FOLDER / f"page_{scheme}.png")
            for tab in ["peaks", "loops", "study", "spectrum", "impacts"]:
                page.locator(f"#tab-{tab}").click()
                assert (faint := page.evaluate(FAINT)) == [], (scheme, tab, faint)
            page.locator("#scene").fill("name = 3\n")
            says(page, "mistake")
            page.wait_for_timeout(100)
            assert (faint := page.evaluate(FAINT)) == [], (scheme, faint)
            back = "getComputedStyle(document.body).backgroundColor"
            before = page.evaluate(back)
            page.locator("#theme").click()
            other = page.evaluate(back)
            assert other != before
            page.reload()
            page.wait_for_timeout(300)
            assert page.evaluate(back) == other, "the choice is kept"


def fits_a_phone(browser):
    for scheme in ["light", "dark"]:
        with visit(browser, viewport=PHONE, color_scheme=scheme, has_touch=True, is_mobile=True, device_scale_factor=2) as page:
            page.screenshot(path=FOLDER / f"page_phone_{scheme}.png", full_page=True)
            assert page.locator("#buildings").bounding_box()["y"] < 844 / 2, "the buildings are seen at once"
            for tab in ["peaks", "loops", "study", "spectrum", "impacts"]:
                page.locator(f"#tab-{tab}").tap()
                assert page.evaluate("document.documentElement.scrollWidth") <= 390, tab
                assert (small := page.evaluate(SMALL)) == [], (tab, small)
            page.locator("#example").select_option(label="Six storeys beside four of other heights, 40 mm apart")
            says(page, "^50 impacts")
            assert page.evaluate("document.documentElement.scrollWidth") <= 390
            page.locator("#play").tap()
            page.locator("#chart-list .u-over").first.tap()
    with visit(browser, viewport={"width": 844, "height": 390}) as page:
        assert page.evaluate("document.documentElement.scrollWidth") <= 844
    for width in [1024, 1280]:
        with visit(browser, viewport={"width": width, "height": 768}) as page:
            assert page.evaluate("document.documentElement.scrollWidth") <= width
            theme, save = page.locator("#theme").bounding_box(), page.locator(".save").bounding_box()
            assert theme["x"] + theme["width"] < save["x"] or theme["y"] + theme["height"] <= save["y"], (theme, save)


def stands_still_where_motion_is_unwelcome(browser):
    from PIL import Image

    with visit(browser, reduced_motion="reduce", viewport=WIDE) as page:
        page.wait_for_timeout(400)
        stands = now(page)
        page.wait_for_timeout(400)
        assert now(page) == stands and abs(stands - 2.7135) < 1e-3, "the hardest impact, standing still"
        page.locator("#understood").click()
        page.wait_for_timeout(300)
        # Of 256 colours: the picture of docs/page.md, a third of the size that all take.
        Image.open(io.BytesIO(page.screenshot())).convert("RGB").quantize(256).save(FOLDER / "page.png", optimize=True)


LOOKS = [
    has_names_for_everything, goes_by_keys_alone, is_dark_and_light, fits_a_phone, stands_still_where_motion_is_unwelcome,
]  # fmt: skip
