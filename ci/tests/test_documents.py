"""The blocks of a page, what has to be said of them, and what is printed against what is shown."""

import unittest

from documenting import compare, follow, pages

PAGE = """# A page

Type `pounding-fmu plot a.toml --form svg` or `other --option`:

```sh
pounding-fmu a.toml   # a remark
pounding-fmu gap a.toml \\
    --force 3 | head
```

which prints

```text
gap 3 mm
```

```python
import pounding_fmu
pounding_fmu.simulate("a.toml")
```

```text
by itself
```

```text
and another
```
"""
LISTED = {"wheel": [], "listed": [], "by_hand": [], "varies": []}


class Reader:
    """Prints what it is told to, and remembers what it has run."""

    def __init__(self, *printed):
        self.printed, self.ran = list(printed), []

    def folder(self, page):
        return page

    def run(self, kind, text, folder):
        self.ran.append((kind, text))
        return self.printed.pop(0)


def page(text=PAGE):
    return pages.read("page.md", text)


class Blocks(unittest.TestCase):
    def test_programs_and_what_stands_below_them(self):
        (commands, first), (script, second) = page().pairs()
        self.assertEqual((commands.kind, first.text, commands.line), ("sh", "gap 3 mm\n", 5))
        self.assertEqual((script.kind, second.text), ("python", "by itself\n"))

    def test_commands_in_blocks_and_sentences(self):
        found = [words for _, words in page().commands()]
        plot, one, gap = (["plot", "a.toml", "--form", "svg"], ["a.toml"], ["gap", "a.toml", "--force", "3"])
        self.assertEqual([words[1:] for words in found], [plot, one, gap])

    def test_a_session_is_judged_by_what_it_prints(self):
        for shown, code in (("3", 0), ("4", 1)):
            kind, text = pages.Block("page.md", 1, "python", f">>> 1 + 2\n{shown}\n").program
            self.assertEqual(kind, "python")
            with self.assertRaises(SystemExit) as ended:
                exec(text, {})
            self.assertEqual(int(ended.exception.code), code)


    def test_a_session_goes_on(self):
        text = "```python\n>>> a = 1\n```\n\n```sh\nls\n```\n\n```python\n>>> a\n1\n```\n"
        session, command = page(text).blocks
        self.assertEqual((session.text, command.kind), (">>> a = 1\n\n>>> a\n1\n", "sh"))


class Accounts(unittest.TestCase):
    def test_a_block_that_nobody_runs(self):
        problems = follow.unaccounted([page()], LISTED)
        self.assertEqual([problem.split(":")[1] for problem in problems], ["5", "13", "17", "22", "26"])

    def test_what_stands_below_a_block_is_compared_and_nothing_else(self):
        (problem,) = follow.unaccounted([page()], LISTED | {"wheel": ["ARCHITECTURE.md", "page.md"]})[:1]
        self.assertIn("page.md:26: nothing runs or compares this block: and another", problem)

    def test_a_reason_excuses_the_text_below_no_more(self):
        listed = [{"page": "page.md", "block": "import pounding_fmu", "why": "a reason"}]
        problems = follow.unaccounted([page()], LISTED | {"listed": listed})
        self.assertEqual([problem.split(":")[1] for problem in problems], ["5", "13", "22", "26"])

    def test_reasons_for_blocks_that_are_gone(self):
        gone = {"page": "page.md", "block": "gone", "why": "a reason"}
        (problem,) = follow.unaccounted([page("")], LISTED | {"listed": [gone], "wheel": []})
        self.assertEqual(problem, "ci/documents.toml: page.md has no block 'gone'")


class Following(unittest.TestCase):
    LISTED = LISTED | {"wheel": ["page.md"]}

    def follow(self, *printed, **listed):
        reader = Reader(*printed)
        return follow.follow(page(), self.LISTED | listed, reader), reader

    def test_in_order_and_compared(self):
        problems, reader = self.follow((0, "gap 3 mm\n"), (0, "by itself"))
        self.assertEqual((problems, [kind for kind, _ in reader.ran]), ([], ["sh", "python"]))

    def test_another_number(self):
        problems, reader = self.follow((0, "gap 4 mm\n"))
        self.assertEqual(len(reader.ran), 1)
        self.assertIn("page.md:13: not printed: 'gap 3 mm'", problems[0])

    def test_a_command_that_fails(self):
        problems, _ = self.follow((2, "no such file"))
        self.assertEqual(problems, ["page.md:5: ended with code 2:\nno such file"])

    def test_what_is_done_by_hand(self):
        by_hand = [{"page": "page.md", "before": "import pounding_fmu", "do": "edit"}]
        _, reader = self.follow((0, "gap 3 mm"), (0, ""), (0, "by itself"), by_hand=by_hand)
        self.assertEqual(reader.ran[1], ("sh", "edit"))

    def test_what_a_command_of_the_checkout_prints(self):
        for command, wrong in (("echo and another", 0), ("echo another", 1), ("echo and another; exit 3", 1)):
            listed = [{"page": "page.md", "block": "and another", "checkout": command}]
            problems = follow.follow(page(), LISTED | {"listed": listed}, Reader())
            self.assertEqual(len(problems), wrong, problems)

    def test_nothing_of_other_pages(self):
        self.assertEqual(follow.follow(page(), LISTED, Reader()), [])


class Compared(unittest.TestCase):
    def test_lines_one_after_another_anywhere(self):
        self.assertIsNone(compare.difference("b\nc\n", "a\nb\nd\nb  \nc\ne\n"))

    def test_the_line_that_differs(self):
        self.assertEqual(compare.difference("b\nc 1\n", "a\nb\nc 2\n"), "shown:   c 1\nprinted: c 2")
        self.assertEqual(compare.difference("b\nc\n", "a\nb\n"), "shown:   c\nprinted: the end")

    def test_what_varies(self):
        self.assertIsNone(compare.difference("took 3 ms", "took 14 ms", [r"\d+ ms"]))
        self.assertIsNotNone(compare.difference("took 3 ms", "gone 3 ms", [r"\d+ ms"]))


class Names(unittest.TestCase):
    def test_commands_and_options(self):
        def run(program, command, _):
            return {"plot": (0, "usage [--format {svg,png}]"), "": (0, "--output"), "gap": (2, "")}[command]

        problems = follow.command_problems([page()], run)
        self.assertEqual(problems[0], "page.md:3: pounding-fmu plot has no option --form")
        self.assertEqual(problems[1:], ["page.md:5: there is no command pounding-fmu gap"])

    def test_python(self):
        self.assertEqual(follow.name_problems([page()], lambda text: True), [])
        problems = follow.name_problems([page()], lambda text: not text.endswith("simulate"))
        self.assertEqual(problems, ["page.md: pounding_fmu has no simulate"])
