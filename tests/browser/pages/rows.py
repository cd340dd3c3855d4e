"""Rows of buildings: drawn, run, changed by the handles, and charted two at a time."""

import re

from .visit import FOLDER, line_at, lines, says, visit

LAW = 'law = "kelvin_voigt"\nstiffness = 4e8\nrestitution = 0.6\n'
# As the style sheet has them in the light.
COLOURS = [(0, 114, 178), (213, 94, 0), (51, 34, 136), (230, 159, 0), (136, 34, 85), (153, 153, 51), (102, 17, 0), (204, 121, 167)]


def row(names, gap, floors=lambda at: 2 + at % 3, more=""):
    """A row that is pushed apart in turn, all neighbours by the same gap or each by its own."""
    text = 'name = "Row"\nstop_time = 4.0\n'
    for at, name in enumerate(names):
        count = floors(at)
        list_of = lambda value: f"[{', '.join([value] * count)}]"  # noqa: B023, E731
        text += f'\n[[building]]\nname = "{name}"\nmass = {list_of("1e5")}\nstiffness = {list_of(f"{50 + 9 * (at % 4)}e6")}\n'
        text += f"height = {list_of('3.0')}\ndamping = {{ ratio = 0.05 }}\ninitial_velocity = {list_of(f'{0.6 * (-1) ** at}')}\n"
    return f"{text}{more}\n[facing]\ngap = {gap}\n{LAW}"


def opens(page, scene):
    """What the page says when the scene has run."""
    page.locator("#scene").fill("")
    says(page, "mistake")
    page.locator("#scene").fill(scene)
    return says(page, r"^\d+ impacts? in ", seconds=60)


def reach_of(page):
    """Of each colour of a row the leftmost and the rightmost column of pixels, as shares of the width."""
    return page.locator("#buildings").evaluate("""(canvas, colours) => {
        const { width, height } = canvas, { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
        return colours.map((colour) => {
            let [least, most] = [Infinity, -Infinity];
            for (let at = 0; at < data.length; at += 4) {
                if (!colour.every((part, of) => data[at + of] === part)) continue;
                const x = ((at / 4) % width) / width;
                [least, most] = [Math.min(least, x), Math.max(most, x)];
            }
            return [least, most];
        });
    }""", [list(colour) for colour in COLOURS])


def rest(page):
    """The picture at time 0."""
    page.locator("#time").evaluate("(bar) => { bar.value = 0; bar.dispatchEvent(new Event('input')); }")
    page.wait_for_timeout(200)


def legend(page, chart="displacement"):
    return page.locator(f"[data-chart={chart}] .u-legend").inner_text()


def draws_a_row_and_charts_two_of_it(browser):
    with visit(browser) as page:
        opens(page, row("ABC", "[0.01, 0.04]"))
        rest(page)
        reach = reach_of(page)
        for (_, most), (least, _) in zip(reach[:2], reach[1:3]):
            assert 0 < most < least < 1, reach
        # The second gap is four times the first, and no other colour is there.
        gaps = [reach[at + 1][0] - reach[at][1] for at in (0, 1)]
        assert 3 < gaps[1] / gaps[0] < 5 and reach[3][1] == float("-inf"), (gaps, reach)
        page.screenshot(path=FOLDER / "page_row.png")
        hardest = page.locator("#happened").inner_text()
        pair = re.search(r"between (\w) .* and (\w) ", hardest).groups()
        assert all(f"{name} " in legend(page) for name in pair), (hardest, legend(page))
        other = next(name for name in "ABC" if name not in pair)
        assert f"{other} " not in legend(page), legend(page)
        page.locator("#pair-first").select_option("A")
        page.locator("#pair-second").select_option("C")
        assert "A 2" in legend(page) and "C 4" in legend(page) and "B 3" not in legend(page), legend(page)
        keys = page.locator("[data-chart=displacement] .line-key line")
        for what in ("stroke", "stroke-dasharray"):
            first, second = (keys.nth(at).get_attribute(what) for at in (0, 1))
            assert first != second, ("told apart in grey, too", what, first)
        page.locator("#floors summary").click()
        page.locator("#floor-choice label", has_text="C 1").click()
        assert "C 1" in legend(page)
        assert page.locator("#floor-choice label").count() == 6
        page.locator("#pair-first").select_option("")
        assert f"{other} " not in legend(page), legend(page)
        cells = page.locator("#impacts tbody tr").first.locator("td").all_inner_texts()
        assert cells[1] in ("A, B", "B, C"), cells
        page.locator("#tab-peaks").click()
        rows = page.locator("#panel-peaks table", has_text="The row").locator("tbody tr").all_inner_texts()
        assert [text[0] for text in rows] == ["A", "B", "C"], rows
        assert page.locator("#panel-peaks caption", has_text="storeys").count() == 2


def moves_the_gaps_and_storeys_of_a_row(browser):
    with visit(browser) as page:
        opens(page, row("ABC", "[0.01, 0.04]"))

        def types(gap):
            page.locator("#gap-number").fill(str(gap))
            page.keyboard.press("Enter")
            page.wait_for_timeout(400)
            return line_at(page, "gap")

        assert page.locator("#gap-of option").all_inner_texts() == ["all contacts", "A, B", "B, C"]
        page.locator("#gap-of").select_option(label="all contacts")
        assert types(25) == ["gap = [0.025, 0.025]"]
        page.locator("#gap-of").select_option(label="B, C")
        assert types(30) == ["gap = [0.025, 0.03]"]
        # One gap of many becomes a list.
        opens(page, row("ABC", "0.01"))
        page.locator("#gap-of").select_option(label="A, B")
        assert types(5) == ["gap = [0.005, 0.01]"]
        page.locator("#storeys-of").select_option("B")
        says(page, "^3$", at="#row-storeys")
        page.get_by_role("button", name="One storey more").locator("visible=true").click()
        says(page, "^4$", at="#row-storeys")
        page.wait_for_timeout(400)
        assert line_at(page, "mass")[1] == "mass = [1e5, 1e5, 1e5, 1e5]", line_at(page, "mass")
        says(page, r"^\d+ impacts? in ")
        # A mistake is marked at its line.
        head, tail = page.locator("#scene").input_value().rsplit("mass = [1e5", 1)
        page.locator("#scene").fill(f"{head}mass = [-1{tail}")
        says(page, r"building\[3\]\.mass\[1\]", at="#problems")
        at = max(number for number, line in enumerate(lines(page)) if line.startswith("mass"))
        page.locator("#scene").evaluate("area => area.scrollTop = 0")
        page.wait_for_timeout(200)
        marks = page.locator(".gutter div").evaluate_all("rows => rows.map((row) => row.className)")
        assert marks.index("problem") == at, (marks, at)


def studies_a_row(browser):
    with visit(browser) as page:
        opens(page, row("ABC", "0.01"))
        page.locator("#tab-study").click()
        page.locator("#study").click()
        says(page, "From .* on they never touch", at="#study-says", seconds=60)
        drifts = page.locator("#study-charts .u-legend").nth(1).inner_text()
        assert re.match("gap\\W*A\\W*B\\W*C\\W*$", drifts), drifts


def draws_rows_of_any_length(browser):
    with visit(browser) as page:
        for count in (1, 2, 5, 20, 50, 100):
            names = [f"house{at + 1}" for at in range(count)]
            law = "" if count > 1 else f'\n[[contact]]\nleft = "house1"\nleft_floor = 1\nwall = "right"\ngap = 0.01\n{LAW}'
            scene = row(names, 0.01, floors=lambda at: 1 + at % 3 if count > 20 else 2 + at % 4)  # noqa: B023
            opens(page, scene if count > 1 else scene[: scene.index("\n[facing]")] + law)
            rest(page)
            page.screenshot(path=FOLDER / f"page_row_{count}.png")
            reach = reach_of(page)
            assert page.locator("#pair").is_visible() == (count > 2), count
            first, last = reach[0][0], max(most for _, most in reach)
            assert 0 < first < 0.5 < last < 1, (count, reach)
            if count > 2:
                assert first < 0.2 and last > 0.8, (count, reach)


def draws_one_building_and_its_wall(browser):
    scene = f"""name = "One"
stop_time = 3.0
[left]
mass = [1e5, 1e5]
stiffness = [5e7, 5e7]
damping = {{ ratio = 0.05 }}
initial_velocity = [0.5, 0.5]
[[contact]]
left_floor = 2
wall = "right"
gap = 0.01
{LAW}"""
    with visit(browser) as page:
        opens(page, scene)
        assert "left 2" in legend(page)
        page.get_by_role("button", name="One storey more on the left").click()
        says(page, "^3$", at="#left-storeys")
        assert page.get_by_role("button", name="One storey more on the right").is_disabled()
        page.screenshot(path=FOLDER / "page_one.png")


LOOKS = [
    draws_a_row_and_charts_two_of_it, moves_the_gaps_and_storeys_of_a_row, studies_a_row, draws_rows_of_any_length,
    draws_one_building_and_its_wall,
]  # fmt: skip
