"""Each gate lets a good library pass and stops one that is broken in just the way that it guards against."""

import tempfile
import unittest
import zipfile
from pathlib import Path

from releasing import archives, gates, reading
from releasing.platforms import ARM, LINUX, NATIVE, WINDOWS
from tests.compiled import FUNCTIONS, MACOS, WINDOWS as MINGW, code, library, read

NEW_SYMBOL = "#include <sys/random.h>\nint use(void *p) { return getrandom(p, 1, 0); }\n"  # GLIBC_2.25
OLD_SYMBOL = "#include <stdlib.h>\nint use(void) { return abs(rand()); }\n"  # GLIBC_2.2.5
RUNTIME = "unsigned __int128 quotient(unsigned __int128 a, unsigned __int128 b) { return a / b; }\n"


class Exports(unittest.TestCase):
    def test_all_of_them(self):
        of = {version: sum(name.startswith(version) for name in FUNCTIONS) for version in ("fmi2", "fmi3")}
        self.assertEqual((of, len(FUNCTIONS)), ({"fmi2": 44, "fmi3": 75}, 119))
        for compiler in (("cc",), MINGW):
            self.assertEqual(gates.exports(read(code(), compiler=compiler), frozenset(FUNCTIONS)), [])

    def test_one_is_missing(self):
        for compiler in (("cc",), MINGW):
            problems = gates.exports(read(code(FUNCTIONS[1:]), compiler=compiler), frozenset(FUNCTIONS))
            self.assertEqual(problems, ["fmi2CancelStep is not exported"])
            problems = gates.exports(read(code(FUNCTIONS[:-1]), compiler=compiler), frozenset(FUNCTIONS))
            self.assertEqual(problems, [f"{FUNCTIONS[-1]} is not exported"])
            self.assertTrue(FUNCTIONS[-1].startswith("fmi3"))

    def test_one_too_many(self):
        for compiler in (("cc",), MINGW):
            problems = gates.exports(read(code([*FUNCTIONS, "helper"]), compiler=compiler), frozenset(FUNCTIONS))
            self.assertEqual(problems, ["helper is exported and no function of FMI"])

    def test_data_count_too(self):
        problems = gates.exports(read(code() + "int table[4] = {1, 2, 3, 4};\n"), frozenset(FUNCTIONS))
        self.assertEqual(problems, ["table is exported and no function of FMI"])


class SystemLibraries(unittest.TestCase):
    def test_those_of_the_system_pass(self):
        self.assertEqual(gates.system_libraries(read(code() + OLD_SYMBOL), LINUX), [])
        self.assertEqual(gates.system_libraries(read(code(), compiler=MINGW), WINDOWS), [])

    def test_a_runtime_of_the_compiler_does_not(self):
        self.assertEqual(
            gates.system_libraries(read(code() + RUNTIME, "-shared-libgcc", compiler=MINGW), WINDOWS),
            ["needs libgcc_s_seh-1.dll, which is no part of the system"],
        )
        self.assertEqual(
            gates.system_libraries(read(code() + RUNTIME, "-Wl,--no-as-needed", "-lgcc_s"), LINUX),
            ["needs libgcc_s.so.1, which is no part of the system"],
        )


class SymbolVersions(unittest.TestCase):
    def test_old_ones_pass(self):
        self.assertEqual(gates.symbol_versions(read(OLD_SYMBOL), LINUX), [])

    def test_a_newer_one_does_not(self):
        self.assertEqual(gates.symbol_versions(read(NEW_SYMBOL), LINUX), ["needs GLIBC_2.25, expected none above 2.17"])

    def test_numbers_are_compared_as_numbers(self):
        # As text 2.9 is more than 2.17.
        symbol = "#include <sys/epoll.h>\nint use(void) { return epoll_create1(0); }\n"  # GLIBC_2.9
        self.assertEqual(read(symbol).newest_glibc(), (2, 9))
        self.assertEqual(gates.symbol_versions(read(symbol), LINUX), [])


class OtherProperties(unittest.TestCase):
    def test_machine(self):
        self.assertEqual(gates.machine(read(code()), LINUX), [])
        self.assertEqual(gates.machine(read(code()), ARM), ["made for x86-64, expected aarch64"])

    def test_stripped(self):
        for compiler in (("cc",), MINGW):
            self.assertEqual(gates.stripped(read(code(), compiler=compiler)), [])
            self.assertNotEqual(gates.stripped(read(code(), compiler=compiler, stripped=False)), [])
            for options in (["-g"], ["-Wl,--strip-debug"]):  # the names of functions alone
                self.assertNotEqual(gates.stripped(read(code(), *options, compiler=compiler, stripped=False)), [])


class MacOs(unittest.TestCase):
    """Where no Mac is at hand: zig links for it too."""

    def test_what_its_files_say(self):
        found = read(code(), compiler=MACOS)
        # zig exports two names that Apple's linker does not.
        self.assertEqual(found.exports - {"__dso_handle", "_mh_dylib_header"}, frozenset(FUNCTIONS))
        self.assertEqual((found.machine, found.minimum_system), ("aarch64", "12.0"))
        self.assertEqual(gates.system_libraries(found, NATIVE["Darwin", "arm64"]), [])
        self.assertEqual(gates.machine(found, NATIVE["Darwin", "x86_64"]), ["made for aarch64, expected x86-64"])

    def test_stripped(self):
        self.assertEqual(gates.stripped(read(code(), compiler=MACOS)), [])
        self.assertNotEqual(gates.stripped(read(code(), "-g", compiler=MACOS, stripped=False)), [])


class PrivatePaths(unittest.TestCase):
    PATHS = ["/some/checkout", "/root", "/root/.cargo"]

    def problems(self, text):
        content = library(code() + f"const char *where(void) {{ return {text}; }}\n")
        return gates.private_paths(content, self.PATHS)

    def test_none(self):
        for text in ('"/pounding-fmu/src/lib.rs"', '"/cargo/registry/src/x"', '"/some/checkouts/x"', '"/x/root/y"'):
            self.assertEqual(self.problems(text), [], text)

    def test_each_is_found(self):
        for path in self.PATHS:
            # Rust writes its strings one behind the other: what stands before a path is no sign.
            text = f'"{path}/src/lib.rs"' if path == "/root" else f'"unwrapped{path}/src/lib.rs"'
            self.assertIn(f"contains the path {path}:", "\n".join(self.problems(text)))

    def test_as_windows_writes_it(self):
        found = gates.private_paths(rb"panicked at C:\Users\me\checkout\src\lib.rs", [r"C:\Users\me\checkout"])
        self.assertEqual(len(found), 1)


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_every_problem_of_a_library_is_told_at_once(self):
        text = code(FUNCTIONS[1:]) + NEW_SYMBOL + 'const char *where(void) { return "/some/checkout/src"; }\n'
        file = self.folder / "pounding.so"
        file.write_bytes(library(text, stripped=False))
        problems = "\n".join(gates.of_file(file, reading.read(file), LINUX, ["/some/checkout"]))
        for part in ("fmi2CancelStep is not", "use is exported", "GLIBC_2.25", "not stripped", "/some/checkout"):
            self.assertIn(part, problems)

    def test_members_of_archives(self):
        wheel = self.folder / "x.whl"
        with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("x/_native.abi3.so", library(NEW_SYMBOL))
            archive.writestr("x/text.txt", "made in /some/checkout/target")
            archive.writestr("x/data/libraries/linux64/pounding.so", library(NEW_SYMBOL))  # data: not Python's
        problems = archives.check(wheel, LINUX, ["/some/checkout"])
        self.assertEqual(len(problems), 2, problems)
        self.assertIn("x.whl: x/_native.abi3.so needs GLIBC_2.25", problems[0])
        self.assertIn("x.whl: x/text.txt contains the path /some/checkout", problems[1])
