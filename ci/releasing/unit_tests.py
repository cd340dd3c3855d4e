"""Unit tests of the library that say something on Windows only, compiled for it and run under wine."""

import json
import re
import shutil

from releasing.commands import run

# What a master passes as the location of the resources: drives and servers.
TESTS = "resource_location"
# They take no time to run, but what all tests need takes minutes to optimise.
QUICKLY = ("--config", "profile.dev.opt-level=0", "--config", "profile.dev.debug=false")


def on_windows(host, toolchain):
    """What is wrong, a line each."""
    messages = run(
        *"cargo test --locked --package pounding-units --lib --no-run --target".split(),
        host.platform.triple,
        *QUICKLY,
        "--message-format=json-render-diagnostics",
        variables=toolchain.variables,
        aloud=True,
    )
    programs = [json.loads(line).get("executable") for line in messages.splitlines()]
    # Beside the host, where wine finds what it lacks.
    program = host.folder / "unit-tests.exe"
    shutil.copy(next(program for program in programs if program), program)
    code, said = host.start(program, [TESTS])
    return judged(code, said)


def judged(code, said):
    """A selection of no tests passes as well: it would be a mistake here."""
    passed = re.search(r"test result: ok\. (\d+) passed", said)
    if code == 0 and passed and int(passed[1]) > 0:
        return []
    return [f"unit tests {TESTS} on Windows ended with code {code}:\n{said}"]
