#!/usr/bin/env python3
"""What an FMU's library costs an importer, in instructions: the same on any day and beside any other work.

    benchmarks/instructions.py                      the library of a release beside that of `cargo fmu`
    benchmarks/instructions.py LIBRARY ...          these, beside the first

A program in C (drive.c) makes 2000 steps of 0.01 s with each example scene and some of the reference scenes, and reads the top
displacements and all contact forces at each step and all Real outputs at the end; `valgrind --tool=callgrind` counts. A run of one step is taken off: what is
left is the work of the steps. The bits that are read must be the same for all libraries. Needs gcc and valgrind.
"""

import math
import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
WORK = ROOT / "target/instructions"
SCENES = [
    *sorted((ROOT / "examples/scenes").glob("*.toml")),
    *(
        ROOT / f"tests/reference/scenes/{name}.toml"
        for name in ("feup_hertz", "feup_hertz_damped_ye", "feup_jankowski", "eight_and_nine_storeys")
    ),
]
STEPS, STEP = 2000, "0.01"


def main():
    libraries = [Path(name).resolve() for name in sys.argv[1:]] or [released(), packed()]
    driver = compiled_driver()
    cases = [Case(scene) for scene in SCENES]
    factors = [[] for _ in libraries]
    print("million instructions, and how many times those of the first library")
    for case in cases:
        counted = [case.instructions(driver, library) for library in libraries]
        if len({bits for _, bits in counted}) != 1:
            sys.exit(f"{case.name}: other bits: {counted}")
        first = counted[0][0]
        for of_library, (count, _) in zip(factors, counted):
            of_library.append(count / first)
        print(f"{case.name:24}", *(f"{count / 1e6:8.2f} {count / first:6.3f}" for count, _ in counted), flush=True)
    for library, of_library in zip(libraries, factors):
        mean = math.exp(sum(map(math.log, of_library)) / len(of_library))
        print(f"{library}: geometric mean {mean:.3f}, largest {max(of_library):.3f}")


def run(*command, **settings):
    done = subprocess.run([*map(str, command)], cwd=ROOT, capture_output=True, text=True, env=os.environ | settings)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done


def released():
    """The library of a release, for this machine."""
    return built(WORK / "release", WORK / "released.so")


def built(target, place, *switches, **settings):
    """A library, compiled below a target folder with these switches of the compiler and settings of cargo."""
    command = "cargo rustc --release --lib --crate-type cdylib --package pounding-fmu --target-dir"
    run(*command.split(), target, "--", "--cfg", "fmi_exports", *switches, **settings)
    place.parent.mkdir(parents=True, exist_ok=True)
    shutil.copy(target / "release/libpounding.so", place)
    return place


def packed():
    """That in an FMU of `cargo fmu`."""
    fmu, place = WORK / "packed.fmu", WORK / "cargo-fmu.so"
    run("cargo", "fmu", SCENES[0], "-o", fmu)
    with zipfile.ZipFile(fmu) as archive:
        (name,) = (name for name in archive.namelist() if name.startswith("binaries/linux64/") and not name.endswith("/"))
        place.write_bytes(archive.read(name))
    return place


def compiled_driver():
    WORK.mkdir(parents=True, exist_ok=True)
    driver = WORK / "drive"
    run("gcc", "-O1", "-Wall", "-o", driver, ROOT / "benchmarks/drive.c", "-ldl", "-lm")
    return driver


class Case:
    """A scene as an unpacked FMU, of which no peaks, one or all may be read at each step."""

    def __init__(self, scene, peaks_read="none"):
        self.name = scene.stem
        folder = WORK / "cases" / scene.stem
        run("cargo", "fmu", scene, "-o", f"{folder}.fmu")
        with zipfile.ZipFile(f"{folder}.fmu") as archive:
            archive.extractall(folder)
        self.resources = (folder / "resources").as_uri()
        description = ElementTree.parse(folder / "modelDescription.xml").getroot()
        self.guid = description.get("guid")
        variables = {v.get("name"): v for v in description.iter("ScalarVariable")}
        references = {name: v.get("valueReference") for name, v in variables.items()}
        floors = {}
        for name in references:
            if of_floor := re.fullmatch(r"(\w+)\.displacement\[\d+\]", name):
                floors.setdefault(of_floor[1], []).append(name)
        tops = [max(names, key=number) for names in floors.values()]
        forces = [name for name in references if re.fullmatch(r"contact\[\d+\]\.force", name)]
        reals = [name for name, v in variables.items() if v.get("causality") == "output" and v.find("Real") is not None]
        peaks = [name for name in reals if "peak" in name]
        peaks = {"none": [], "one": [name for name in peaks if "peak_drift[" in name][:1], "all": peaks}[peaks_read]
        self.references = [references[name] for name in tops + forces + peaks]
        self.at_end = [references[name] for name in reals]
        self.gaps = [references[name] for name in references if re.fullmatch(r"contact\[\d+\]\.gap", name)]
        self.stop = description.find("DefaultExperiment").get("stopTime")

    def instructions(self, driver, library):
        """Of the steps, and what was read."""
        (whole, bits), (start, _) = (self.count(driver, library, steps, STEP) for steps in (STEPS, 1))
        return whole - start, bits

    def study(self, driver, library, cases):
        """Of all but the first of these cases, which have gaps of their own, and what was read."""
        counted = (self.count(driver, library, count, self.stop, "--", *self.gaps) for count in (cases, 1))
        (whole, bits), (start, _) = counted
        return whole - start, bits

    def count(self, driver, library, steps, length, *more):
        command = [driver, library, self.guid, self.resources, steps, length, *self.references, "--", *self.at_end, *more]
        done = run("valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", *command)
        return int(re.search(r"Collected : (\d+)", done.stderr)[1]), done.stdout


def number(name):
    return int(re.search(r"\[(\d+)\]", name)[1])


if __name__ == "__main__":
    main()
