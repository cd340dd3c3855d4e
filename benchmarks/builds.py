#!/usr/bin/env python3
"""How long whoever begins with the sources waits: in a fresh clone, with the crates downloaded.

    benchmarks/builds.py                    the first `cargo fmu`, the second, a changed scene, a changed line of the engine
    benchmarks/builds.py --tests            `cargo test --workspace` in a fresh clone, too
    benchmarks/builds.py --against COMMIT   the same of another commit, in turn, and the quotients

Prints seconds of the clock and of the processors. The machine should have nothing else to do.
"""

import argparse
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tests", action="store_true", help="time the tests as well")
    parser.add_argument("--against", metavar="COMMIT", help="another commit to compare with")
    arguments = parser.parse_args()
    print(f"{os.cpu_count()} processors, {os.getloadavg()[0]:.1f} programs at work before")
    measured = [waits(commit, arguments.tests) for commit in ["HEAD", arguments.against] if commit]
    for what in measured[0]:
        columns = [f"{clock:7.1f} s {processor:7.1f} s" for clock, processor in (waited[what] for waited in measured)]
        quotients = ""
        if len(measured) == 2:
            ours, others = (waited[what] for waited in measured)
            quotients = f"   {ours[0] / others[0]:.2f} {ours[1] / others[1]:.2f}"
        print(f"{what:28}", *columns, quotients)


def waits(commit, with_tests):
    """By what is done, seconds of the clock and of the processors."""
    with tempfile.TemporaryDirectory() as folder:
        clone = Path(folder) / "clone"
        subprocess.run(["git", "clone", "--quiet", ROOT, clone], check=True)
        subprocess.run(["git", "checkout", "--quiet", revision(commit)], cwd=clone, check=True)
        subprocess.run(["cargo", "fetch", "--locked", "--quiet"], cwd=clone, check=True)
        scene = clone / "examples/scenes/feup.toml"
        waited = {"first cargo fmu": timed(clone, "cargo", "fmu")}
        waited["second cargo fmu"] = timed(clone, "cargo", "fmu")
        scene.write_text(scene.read_text().replace("gap = 0.005", "gap = 0.006"))
        waited["a changed scene"] = timed(clone, "cargo", "fmu")
        engine = clone / "src/engine/mod.rs"
        engine.write_text(engine.read_text() + "\n// A line more.\n")
        waited["a changed line of src/"] = timed(clone, "cargo", "fmu")
        if with_tests:
            subprocess.run(["git", "checkout", "--quiet", "."], cwd=clone, check=True)
            subprocess.run(["rm", "-rf", clone / "target"], check=True)
            waited["cargo test --workspace"] = timed(clone, "cargo", "test", "--workspace", "--quiet")
        return waited


def revision(commit):
    return subprocess.run(["git", "rev-parse", commit], cwd=ROOT, check=True, capture_output=True, text=True).stdout.strip()


def timed(folder, *command):
    clock, before = time.monotonic(), resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}\n{done.stdout}{done.stderr}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return time.monotonic() - clock, used


if __name__ == "__main__":
    main()
