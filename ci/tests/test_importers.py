"""The table of importers: what is renewed, what is kept, and what counts as the same as FMPy."""

import unittest
from types import SimpleNamespace

from importing import table, trial
from importing.fmus import KINDS

ABOVE, BELOW = "# Importers\n\nWords.\n\n", "\nMore words.\n"

RUNS = {**dict.fromkeys(KINDS, "runs"), "gap": "runs"}


def importer(name, **more):
    return SimpleNamespace(NAME=name, PACKAGES=[f"{name}==1.0", "fmpy==0.3"], TAKE="2.0", KNOW="much", **more)


def page(*rows):
    return table.join(ABOVE, {table.cells(row)[0]: row for row in rows}, BELOW)


class Table(unittest.TestCase):
    def test_what_has_been_written_is_read_again(self):
        rows = [table.of(importer(name), RUNS, "May 2026") for name in ("a", "B", "c")]
        above, found, below = table.split(page(*reversed(rows)))
        self.assertEqual((above, list(found), below), (ABOVE, ["a", "B", "c"], BELOW))
        self.assertEqual(list(found.values()), rows)

    def test_a_row_that_is_not_renewed_keeps_its_text(self):
        old = "| a | `pip install a==0.9`, May 2025 | runs |  |  |  |  | 2.0 | what somebody has written |\n"
        above, rows, below = table.split(page(old))
        rows["b"] = table.of(importer("b"), RUNS, "May 2026")
        text = table.join(above, rows, below)
        self.assertIn(old, text)
        self.assertIn("| b | `pip install b==1.0`, May 2026 | runs | runs | runs | runs | runs | 2.0 | much |\n", text)

    def test_a_page_without_rows_has_a_table(self):
        self.assertEqual(table.split(page())[1], {})

    def test_another_way_to_get_it(self):
        crate = importer("crate", GET="cargo add crate@1")
        self.assertIn("| `cargo add crate@1`, May 2026 |", table.of(crate, RUNS, "May 2026"))

    def test_what_runs_no_more_is_lost(self):
        before = table.of(importer("a"), RUNS, "May 2025")
        after = table.of(importer("a"), {**RUNS, "3.0": "no", "gap": "no"}, "May 2026")
        self.assertEqual(table.losses(before, after), ["3.0", "gap"])
        self.assertEqual(table.losses(after, before), [])


class Comparison(unittest.TestCase):
    def test_counts_are_the_same_and_peaks_nearly(self):
        trial.compare([108, 990.0 * (1 + 1e-10), 0.03], [108, 990.0, 0.03], 1e-9)
        trial.compare([0, 0.0, 0.04], [0, 0.0, 0.04], 1e-9)
        for found in ([109, 990.0, 0.03], [108, 990.0 * (1 + 1e-8), 0.03], [108, 990.0, 0.03 - 1e-10], [108, 990.0, float("nan")]):
            with self.assertRaisesRegex(trial.Failure, "where FMPy has"):
                trial.compare(found, [108, 990.0, 0.03], 1e-9)

    def test_an_importer_that_does_not_run_is_told_of(self):
        said = []

        def fails():
            raise trial.Failure("it cannot")

        self.assertEqual(trial.attempt("a, 2.0", said.append, fails), "no")
        self.assertEqual(trial.attempt("b, 2.0", said.append, list), "runs")
        self.assertEqual(said, ["a, 2.0: no, it cannot", "b, 2.0: runs"])

    def test_every_importer_says_what_its_row_needs(self):
        from importing import one

        files = trial.importers([])
        self.assertGreater(len(files), 10)
        for file in files:
            loaded = one.load(file)
            row = table.of(loaded, RUNS, "May 2026")
            self.assertEqual(len(table.cells(row)), len(table.HEADINGS), file)
            self.assertTrue(callable(loaded.run) and (loaded.PACKAGES or loaded.GET), file)
        self.assertEqual(trial.importers(["estim8"]), [trial.TRIED / "estim8.py"])
        with self.assertRaisesRegex(SystemExit, "nobody: expected"):
            trial.importers(["nobody"])


if __name__ == "__main__":
    unittest.main()
