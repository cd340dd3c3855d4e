"""Masters with code of their own, in C++ and C: they step differently, and get the bits that FMPy gets for such steps."""

import json
import os
import platform
import shutil
import subprocess
import sys
from itertools import accumulate
from pathlib import Path

import numpy as np
import pytest
from fmpy import simulate_fmu

import harness

STEP, COUNT, EVERY = 0.01, 2000, 50
NAMES = ["left.displacement[2]", "right.velocity[3]", "contact[1].peak_force", "contact[2].impulse", "energy.viscous"]


def products():
    """Communication points k h, their differences as steps."""
    times = [k * STEP for k in range(COUNT + 1)]
    return [(a, b - a) for a, b in zip(times, times[1:])]


def sums():
    """Time is summed up, with its rounding errors."""
    times = accumulate([STEP] * COUNT, initial=0.0)
    return [(time, STEP) for time, _ in zip(times, range(COUNT))]


def fmpy(fmu, steps, every=EVERY):
    instance = fmu.instance().start()
    rows = []
    for k, (time, step) in enumerate(steps, start=1):
        instance.doStep(time, step)
        if k % every == 0:
            rows.append(instance.get(*NAMES))
    return np.array(rows)


def other(master, fmu, step=STEP, count=COUNT, every=EVERY):
    """What a master prints, in a process of its own: its libraries are not those of the tests."""
    script = Path(__file__).parent / "masters" / f"{master}.py"
    # Where a wheel puts shared libraries that others need.
    libraries = {"LD_LIBRARY_PATH": str(Path(sys.prefix) / "lib")}
    arguments = [fmu.path, repr(step), count, every, *NAMES]
    result = subprocess.run(
        [sys.executable, script, *map(str, arguments)],
        env=os.environ | libraries,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert result.returncode == 0, result.stdout[-2000:] + result.stderr[-2000:]
    rows = [line.split()[1:] for line in result.stdout.splitlines() if line.startswith("values ")]
    return np.array([[float.fromhex(value) for value in row] for row in rows])


# The list of requirements has all of them on such a processor: one that is missing there is a failure.
on_intel = pytest.mark.skipif(
    platform.machine() not in ["x86_64", "AMD64"], reason="the other masters come as binaries for x86-64"
)


@on_intel
@pytest.mark.parametrize(("master", "steps"), [("libcosim", products), ("ecos", sums)])
def test_another_master_gets_the_same_bits(feup, master, steps):
    found = other(master, feup)
    assert found.shape == (COUNT // EVERY, len(NAMES))
    assert np.array_equal(found, fmpy(feup, steps()))


@on_intel
def test_ecos_runs_fmi3(build, feup):
    """It asks for neither Event Mode nor early returns."""
    step, count, every = 1 / 128, 2560, 64
    found = other("ecos", build(harness.scene_with_record(), fmi=3), step, count, every)
    assert found.shape == (count // every, len(NAMES)) and np.all(np.any(found, axis=0))
    assert np.array_equal(found, fmpy(feup, [(k * step, step) for k in range(count)], every))


@on_intel
def test_inside_another_fmu(feup, tmp_path):
    """The container of fmu-manipulation-toolbox is an FMU in C that is the master of those inside it."""
    # It takes no file names with blanks.
    shutil.copy(feup.path, tmp_path / "inner.fmu")
    container = {
        "name": "container.fmu",
        "step_size": STEP,
        "fmu": ["inner.fmu"],
        "output": [["inner.fmu", name, f"output_{i}"] for i, name in enumerate(NAMES)],
        **{f"auto_{what}": False for what in ["link", "input", "output", "parameter"]},
    }
    (tmp_path / "container.json").write_text(json.dumps(container))
    command = [Path(sys.executable).parent / "fmucontainer", "-fmu-directory", ".", "-container", "container.json"]
    made = subprocess.run(list(map(str, command)), cwd=tmp_path, capture_output=True, text=True, timeout=120)
    assert made.returncode == 0, made.stdout + made.stderr
    table = simulate_fmu(
        str(tmp_path / "container.fmu"), stop_time=COUNT * STEP, step_size=STEP, output_interval=STEP
    )
    found = np.array([[table[f"output_{i}"][k] for i in range(len(NAMES))] for k in range(EVERY, COUNT + 1, EVERY)])
    # It says k h and h: the two need not add up to (k + 1) h.
    assert np.array_equal(found, fmpy(feup, [(k * STEP, STEP) for k in range(COUNT)]))
