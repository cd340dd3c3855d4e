"""Small libraries for the tests, good ones and broken ones, by the compilers that a release needs anyway."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from releasing import gates, reading
from releasing.cargo import VARIABLES
from releasing.commands import environment

LINUX = ("cc",)
WINDOWS = ("x86_64-w64-mingw32-gcc",)
MACOS = (sys.executable, "-m", "ziglang", "cc", "-target", "aarch64-macos.12.0")
FUNCTIONS = sorted(gates.functions_of_fmi())


def code(functions=FUNCTIONS):
    """C code that exports these."""
    export = "#ifdef _WIN32\n#define EXPORT __declspec(dllexport)\n#else\n#define EXPORT\n#endif\n"
    return export + "".join(f"EXPORT int {name}(void) {{ return 0; }}\n" for name in functions)


def library(text, *options, compiler=LINUX, stripped=True):
    """The bytes of the library that this code gives.

    A test that needs a compiler which is not there is skipped on a machine of somebody's, and fails where CI is set.
    """
    if not shutil.which(compiler[0]) and not os.environ.get("CI"):
        raise unittest.SkipTest(f"{compiler[0]} is not installed")
    with tempfile.TemporaryDirectory() as folder:
        source, output = Path(folder) / "code.c", Path(folder) / "library.so"
        source.write_text(text)
        strip = ["-s"] if stripped else []
        subprocess.run(
            [*compiler, "-shared", "-fPIC", "-O1", *strip, source, "-o", output, *options],
            check=True,
            env=environment(VARIABLES),
        )
        return output.read_bytes()


def read(*arguments, **named):
    return reading.read_bytes(library(*arguments, **named))
