"""Missing packages, the versions of Debian's sources, the tests on Windows, the lists of what files need."""

import subprocess
import tempfile
import tomllib
import unittest
import zipfile
from pathlib import Path

from releasing import cases, debian, debian_sources, needs, unit_tests
from releasing.commands import Failure
from releasing.places import ROOT
from releasing.platforms import CROSS
from tests.compiled import WINDOWS, code, library


class Packages(unittest.TestCase):
    def test_all_missing_ones_are_told_at_once(self):
        there = debian.Need("there", "is there", lambda: True)
        gone = [debian.Need(name, f"for {name}", lambda: False) for name in ("one", "two")]
        with self.assertRaises(Failure) as failure:
            debian.require([gone[0], there, gone[1]])
        self.assertIn("install them: apt-get install one two", str(failure.exception))
        debian.require([there])

    def test_a_path_with_blanks(self):
        self.assertEqual(debian.blanks_in(Path("/srv/pounding")), [])
        self.assertIn("/srv/two words: ", debian.blanks_in(Path("/srv/two words"))[0])

    def test_what_is_for_one_platform_names_a_platform(self):
        named = {need.platform for need in debian.NEEDS} - {None}
        self.assertEqual(named, {platform.name for platform in CROSS[1:]})
        self.assertEqual([need.package for need in debian.EVERYWHERE], ["gcc", "python3-venv"])


class Scenes(unittest.TestCase):
    def test_all_are_cases_under_names_of_their_own(self):
        scenes = [file for folder in ("ci", "examples", "tests") for file in ROOT.glob(f"{folder}/**/scenes/*.toml")]
        self.assertLess(len({file.stem for file in scenes}), len(scenes), "two scenes of the same file name")
        self.assertLessEqual(set(scenes), set(cases.scenes().values()))

    def test_published_fmus_have_names_of_their_own(self):
        names = [tomllib.loads(file.read_text())["name"] for file in (ROOT / "examples/scenes").glob("*.toml")]
        self.assertEqual(len(set(names)), len(names), names)


class Sources(unittest.TestCase):
    def test_the_version_of_the_compiler_and_no_other(self):
        offered = ["1.97.1+dfsg1-1", "1.95.0+dfsg1-2~bpo13+1", "1.95.01-1", "1.9.0-1"]
        self.assertEqual(debian_sources.fitting("1.95.0", offered), "1.95.0+dfsg1-2~bpo13+1")
        with self.assertRaises(Failure) as failure:
            debian_sources.fitting("1.95", offered)
        self.assertIn("1.97.1+dfsg1-1", str(failure.exception))


class OnWindows(unittest.TestCase):
    def test_only_tests_that_ran_count(self):
        self.assertEqual(unit_tests.judged(0, "test result: ok. 8 passed; 0 failed"), [])
        for failed in (
            (0, "test result: ok. 0 passed; 0 failed"),
            (101, "test result: FAILED. 7 passed; 1 failed"),
            (0, ""),
            (1, "test result: ok. 8 passed; 0 failed"),
        ):
            self.assertEqual(len(unit_tests.judged(*failed)), 1)


class Needs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        text = code() + "#include <sys/random.h>\nint use(void *p) { return getrandom(p, 1, 0); }\n"
        (self.folder / "libraries/linux64").mkdir(parents=True)
        (self.folder / "libraries/linux64/pounding.so").write_bytes(library(text))
        with zipfile.ZipFile(self.folder / "Two.fmu", "w") as archive:
            archive.writestr("binaries/win64/Two.dll", library(code(), compiler=WINDOWS))
            archive.writestr("binaries/linux64/Two.so", library(text))

    def test_lines_come_from_the_files(self):
        fmu, linux = needs.write(self.folder)
        self.assertEqual(linux, "libraries/linux64/pounding.so  Linux, x86-64 processor, glibc 2.25 or later")
        self.assertRegex(
            fmu, r"^Two\.fmu +linux64: Linux, .*glibc 2\.25 or later; win64: Windows, x86-64 .*kernel32\.dll"
        )
        self.assertEqual((self.folder / "NEEDS").read_text().splitlines(), [fmu, linux])

    def test_the_page(self):
        (self.folder / "pounding.html").write_text("<!DOCTYPE html>")
        self.assertRegex(needs.write(self.folder)[-1], r"^pounding\.html +a browser, no network$")

    def test_checksums(self):
        needs.write(self.folder)
        needs.write(self.folder)
        check = ["sha256sum", "--check", "--strict", "SHA256SUMS"]
        self.assertEqual(subprocess.run(check, cwd=self.folder, capture_output=True).returncode, 0)
        self.assertEqual(len((self.folder / "SHA256SUMS").read_text().splitlines()), 3)
        (self.folder / "Two.fmu").write_bytes(b"")
        self.assertNotEqual(subprocess.run(check, cwd=self.folder, capture_output=True).returncode, 0)
