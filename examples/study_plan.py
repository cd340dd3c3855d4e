"""What a study runs: an FMU of each scene, the records, all cases, and how strong each is."""

import csv
import hashlib
import importlib.util
import os
import shlex
import shutil
import tempfile
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

import ground_motions
import spectra
from engine import EL_CENTRO, STANDARD_GRAVITY
from runs import run_or_stop
from study_table import NEVER_CLOSES, SIDES
from study_worker import Case, Description, Materials

CARGO_FMU = shlex.split(os.environ.get("CARGO_FMU", "cargo fmu"))
NEEDED = {
    "ground.record": "a record in [ground]",
    "contact[1].gap": "a [[contact]]",
    "left.peak_acceleration[1]": "the outputs left.peak_acceleration[i]",
}


@dataclass
class Plan:
    cases: list
    materials: Materials
    storeys: dict  # of each building, in the tallest scene
    # By scene_id: period of each building, s; by scene_id and record_id: spectral acceleration there for 1 m/s2 of peak.
    periods: dict = field(default_factory=dict)
    spectra: dict = field(default_factory=dict)

    def with_intensity(self, case, row):
        """The row of a case with its case and with how strong the ground motion is for each building."""
        known = {"scene": case.scene, "scene_id": case.scene_id, "record": case.record, "record_id": case.record_id}
        known |= {"pga_m_s2": case.pga, "gap_m": case.gap, "stop_s": case.stop}
        for side, period in self.periods[case.scene_id].items():
            known[f"{side}_period_s"] = period
            known[f"{side}_sa_m_s2"] = case.pga * self.spectra[case.scene_id, case.record_id][side]
        return known | row


def plan(options):
    """All cases, and what they need."""
    scenes = named_scenes(options.scenes)
    records = chosen_records(options)
    motions = {record: read_record(record) for record in records}
    with_module = uses_module(options)
    fmus = {name: build(file, options.output / "fmus" / f"{name}.fmu", with_module) for name, file in scenes.items()}
    descriptions = {name: Description(fmu.read_bytes()) for name, fmu in fmus.items()}
    ids = {name: description.guid.strip("{}") for name, description in descriptions.items()}
    contents = {record: record.read_bytes() for record in records}
    names = {record: hashlib.sha256(content).hexdigest()[:12] for record, content in contents.items()}
    peaks = {record: float(np.abs(motion[1]).max()) for record, motion in motions.items()}
    materials = Materials(
        fmus={ids[name]: fmu.read_bytes() for name, fmu in fmus.items()},
        records={names[record]: (record.suffix.lower(), contents[record], peaks[record]) for record in records},
        with_module=with_module,
    )
    cases = [
        Case(scene, ids[scene], record.stem, names[record], pga, gap, options.stop or float(motions[record][0][-1]))
        for scene in fmus
        for record in records
        for pga in dict.fromkeys(options.pga)
        for gap in dict.fromkeys([*options.gaps, NEVER_CLOSES])
    ]
    storeys = {side: max(description.storeys(side) for description in descriptions.values()) for side in SIDES}
    # The same record twice, by two paths, is one.
    found = Plan(list(dict.fromkeys(cases)), materials, storeys)
    for name, fmu in fmus.items():
        found.periods[ids[name]] = first_periods(fmu, descriptions[name].sides, with_module)
        for record, motion in motions.items():
            found.spectra[ids[name], names[record]] = strengths(record, motion, found.periods[ids[name]])
    return found


def named_scenes(files):
    """The scenes by name: the name is that of the FMU, of pictures, and in the table."""
    scenes = {}
    for file in dict.fromkeys(file.resolve() for file in files):
        name = name_of(file)
        if name in scenes:
            raise SystemExit(f"{scenes[name]} and {file} are both named {name!r}: give one another name")
        scenes[name] = file
    return scenes


def name_of(file):
    try:
        return tomllib.loads(file.read_text())["name"]
    except (OSError, ValueError, KeyError) as error:
        raise SystemExit(f"{file}: not a scene: {error}") from None


def chosen_records(options):
    synthetic = range(options.seed, options.seed + options.synthetic)
    return options.records or [
        EL_CENTRO,
        *(ground_motions.write(options.output / "records", seed) for seed in synthetic),
    ]


def uses_module(options):
    """Whether the Python module of this project runs the cases, as it does where it is installed."""
    is_there = importlib.util.find_spec("pounding_fmu") is not None
    if options.through == "module" and not is_there:
        raise SystemExit("--through module: the Python module pounding_fmu is not installed here")
    return is_there and options.through != "fmus"


def build(scene, fmu, with_module):
    """The FMU of a scene."""
    fmu.parent.mkdir(parents=True, exist_ok=True)
    if with_module:
        import pounding_fmu

        try:
            pounding_fmu.build_fmu(scene, fmu)
        except (ValueError, OSError) as error:
            raise SystemExit(f"error: {error}") from None
    else:
        run_or_stop([*CARGO_FMU, scene, "-o", fmu])
    names = Description(fmu.read_bytes()).names
    lacking = [why for needed, why in NEEDED.items() if needed not in names]
    if lacking:
        raise SystemExit(f"{scene}: a study needs a scene with {', '.join(lacking)}")
    return fmu


def first_periods(fmu, sides, with_module):
    """s, of each building of an FMU alone."""
    names = [f"{side}.frequency[1]" for side in sides]
    with tempfile.TemporaryDirectory(prefix="study") as folder:
        copy = shutil.copy(fmu, folder)
        if with_module:
            import study_module

            frequencies = study_module.first_values(study_module.scene_of(Path(copy)), names)
        else:
            import study_fmus

            frequencies = study_fmus.first_values(copy, names)
    return {side: 1.0 / frequency for side, frequency in zip(sides, frequencies)}


def strengths(record, motion, periods):
    """Of each building's first period, the spectral acceleration that goes with a peak of 1 m/s2."""
    times, accelerations = motion
    unit = accelerations / np.abs(accelerations).max()
    try:
        return {side: spectra.pseudo_acceleration(times, unit, period) for side, period in periods.items()}
    except ValueError as error:
        raise SystemExit(f"{record}: {error}") from None


def read_record(path):
    """Times, s, and accelerations, m/s2, of a record."""
    try:
        times, accelerations = read_at2(path) if path.suffix.lower() == ".at2" else read_csv(path)
    except (ValueError, IndexError, OSError):
        raise SystemExit(f"{path}: expected CSV with the columns time_s,accel_m_s2, or PEER AT2") from None
    if len(times) < 2 or not np.all(np.isfinite([times, accelerations])) or np.any(np.diff(times) <= 0):
        raise SystemExit(f"{path}: expected two samples or more, finite, at times that increase")
    if not accelerations.any():
        raise SystemExit(f"{path}: the ground does not move, so it cannot be scaled to a peak")
    if not path.stem.isprintable():
        raise SystemExit(f"{str(path)!r}: expected a file name without line breaks and the like")
    return times, accelerations


def read_csv(path):
    lines = path.read_text().splitlines()
    rows = list(csv.reader(line for line in lines if line.strip() and not line.startswith("#")))[1:]
    time, acceleration = np.array(rows, float).T
    return time, acceleration


def read_at2(path):
    lines = path.read_text().splitlines()
    step = float(lines[3].upper().split("DT=")[1].split()[0].strip(","))
    values = np.array(" ".join(lines[4:]).split(), float) * STANDARD_GRAVITY
    return step * np.arange(len(values)), values
