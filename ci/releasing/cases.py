"""The reference scenes as cases to run: an unpacked FMU each, of which the host gets the resources.

Every scene of the examples, of the comparison with the reference solution and of the stress tests, and one in
ci/scenes/ with every kind of input.
"""

import shutil
import struct
import tomllib
import xml.etree.ElementTree as ElementTree
import zipfile
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from releasing.cargo import fmu_command
from releasing.commands import Failure, run
from releasing.places import ROOT, WORK
from releasing.platforms import LINUX

FOLDER = WORK / "runs/cases"
SCENES = ("examples", "tests/reference/scenes", "tests/physics/stress", "ci/scenes")
# Those of which an FMU of FMI 3.0 runs too: linear, yielding, falling, driven, with impulses.
FMI3 = (
    "examples-scenes-feup",
    "examples-scenes-yielding",
    "tests-reference-scenes-p_delta_fall",
    "ci-scenes-two_blocks_with_inputs",
    "tests-reference-scenes-yielding_impulses",
)
STEP = 0.01  # s
STEPS = 2000


def scenes():
    """The files by the names of their cases, in a fixed order. A name is a path: no two files have the same."""
    files = [file for folder in SCENES for file in sorted((ROOT / folder).rglob("*.toml"))]
    files = [file for file in files if {"left", "building"} & tomllib.loads(file.read_text()).keys()]
    return {"-".join(file.relative_to(ROOT).with_suffix("").parts): file for file in files}


def prepare(libraries):
    """Makes the FMUs of all scenes and unpacks what the host needs of them."""
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    for name, scene in scenes().items():
        unpack(scene, libraries, FOLDER / name)
        if name in FMI3:
            unpack(scene, libraries, FOLDER / name / "fmi3", "--fmi", "3")
    return found()


def unpack(scene, libraries, folder, *options):
    """Makes an FMU, of which the description and the resources stay."""
    fmu = FOLDER / "scene.fmu"
    run(fmu_command(), scene, "--libraries", libraries, "--platform", LINUX.name, *options, "-o", fmu)
    with zipfile.ZipFile(fmu) as archive:
        wanted = [name for name in archive.namelist() if name.startswith(("modelDescription.xml", "resources/"))]
        archive.extractall(folder, wanted)
    fmu.unlink()


def found(folder=FOLDER):
    """The cases that have been prepared, here or on another machine."""
    cases = [Case(path.parent) for path in sorted(folder.glob("*/modelDescription.xml"))]
    if not cases:
        raise Failure(f"{folder} holds no cases")
    return cases


@dataclass(frozen=True)
class Case:
    folder: Path

    @property
    def name(self):
        return self.folder.name

    @cached_property
    def description(self):
        return ElementTree.parse(self.folder / "modelDescription.xml").getroot()

    @cached_property
    def fmi3(self):
        """The description in FMI 3.0, where there is one."""
        file = self.folder / "fmi3/modelDescription.xml"
        return ElementTree.parse(file).getroot() if file.exists() else None

    @cached_property
    def references_of_fmi3(self):
        """Value references by name."""
        return {variable.get("name"): variable.get("valueReference") for variable in self.fmi3.find("ModelVariables")}

    @cached_property
    def variables(self):
        return self.description.findall("ModelVariables/ScalarVariable")

    def of(self, causality, kind):
        return [
            variable
            for variable in self.variables
            if variable.get("causality") == causality and variable.find(kind) is not None
        ]

    @cached_property
    def inputs(self):
        return self.of("input", "Real")

    @cached_property
    def partials(self):
        """Pairs of an output and an input on which it depends at once."""
        pairs = []
        for unknown in self.description.findall("ModelStructure/Outputs/Unknown"):
            knowns = [self.variables[int(index) - 1] for index in unknown.get("dependencies", "").split()]
            pairs += [
                (self.variables[int(unknown.get("index")) - 1], known) for known in knowns if known in self.inputs
            ]
        return pairs

    @cached_property
    def columns(self):
        """Name and size in bytes of everything in a row of the host's output, in its order."""
        reals = [(variable.get("name"), 8) for variable in self.of("output", "Real")]
        rates = [(f"der({name})", size) for name, size in reals]
        whole = [(variable.get("name"), 4) for kind in ("Integer", "Boolean") for variable in self.of("output", kind)]
        partials = [(f"d {unknown.get('name')} / d {known.get('name')}", 8) for unknown, known in self.partials]
        return reals + rates + whole + partials

    @property
    def row_size(self):
        return sum(size for _, size in self.columns)

    def input_rows(self, is_held=False):
        """Values and slopes of all inputs at every point, as the host reads them: a sawtooth, near resonance.

        Without slopes, as FMI 3.0 has none, if inputs are held.

        The limits of an input are those of a million m/s2 (docs/coupling.md): 3e-6 of them is an earthquake.
        """
        peaks = [3e-6 * float(variable.find("Real").get("max")) for variable in self.inputs]

        def value(index, point):
            return peaks[index] * ((3 * point + 17 * index) % 101 - 50) / 50

        rows = []
        for point in range(STEPS + 1):
            now = [value(index, point) for index in range(len(peaks))]
            then = [value(index, point + 1) for index in range(len(peaks))]
            slopes = [0.0 if is_held else (later - earlier) / STEP for earlier, later in zip(now, then)]
            rows += now + slopes
        return struct.pack(f"<{len(rows)}d", *rows)

    def middle(self, outputs):
        """Where states are saved: in contact, if the second third of the run has such a point, else half way."""
        offset, flags = 0, []
        for name, size in self.columns:
            if name.endswith(".active"):
                flags.append(offset)
            offset += size
        for point in range(STEPS // 3, 2 * STEPS // 3):
            if any(outputs[point * offset + flag] for flag in flags):
                return point
        return STEPS // 2
