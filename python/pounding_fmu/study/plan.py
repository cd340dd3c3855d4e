"""What a study runs: scenes, records, all cases, and how strong the ground motion is for each building."""

from __future__ import annotations

import hashlib
import itertools
import json
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import _native, spectra
from .._scenes import Names, read_record, read_scene, refuse, unknown
from .cases import FACTOR, NEVER_CLOSES, Case, Materials, Motion, Readings, Row, readings, varied_text
from .records import label, read_records

if TYPE_CHECKING:
    from .._scenes import Record, Scene

NEEDED = {"gaps": "a contact", "sides": "the outputs {}.peak_acceleration[i] (outputs.peaks = true)"}


@dataclass
class Plan:
    """All that a study needs to know before it runs."""

    cases: list[Case]
    materials: Materials
    storeys: dict[str, int]
    """Of each building in the tallest scene, links and contacts of rows in that with the most."""
    warnings: list[str]
    strengths: dict[tuple[str, str], dict[str, tuple[float, float]]] = field(default_factory=dict)
    """By fingerprints of scene and record, of each building: period, s, and spectral acceleration there for a peak of 1."""

    def with_intensity(self, case: Case, row: Row) -> Row:
        """The row of a case with its case and with how strong the ground motion is for each building."""
        known: Row = {"scene": case.scene, "scene_id": case.scene_id, "record": case.record, "record_id": case.record_id}
        known |= {"pga_m_s2": case.pga, "gap_m": case.gap, "stop_s": case.stop, "varied": case.varied, FACTOR: case.factor}
        for side, (period, strength) in self.strengths[case.scene_id, case.record_id].items():
            known |= {f"{side}_period_s": period, f"{side}_sa_m_s2": case.pga * strength}
        return known | row


@dataclass(frozen=True)
class ReadScene:
    """A scene that can be studied."""

    label: str
    name: str
    text: str
    read: _native.Scene
    readings: Readings

    @property
    def fingerprint(self) -> str:
        return _fingerprint(_native.__version__.encode(), self.text.encode())


def plan(
    scenes: Iterable[Scene],
    records: Mapping[str, Record],
    gaps: Sequence[float],
    pga: Sequence[float],
    stop: float | None,
    vary: Mapping[str, Sequence[float]],
    factors: Sequence[float] | None = None,
) -> Plan:
    """All cases, and what they need; factors on the gaps of each scene take the place of gaps.

    Raises:
        ValueError: everything that is wrong with the scenes and the records.
    """
    problems: list[str] = []
    found = _scenes(scenes, problems)
    settings = [dict(zip(vary, values)) for values in itertools.product(*vary.values())]
    for scene in found:
        problems += [f"{scene.label}: {text}" for text in _not_varied(scene, vary)]
    motions = {key: record.samples() for key, record in read_records(records, problems).items()}
    refuse(problems)
    ids = {name: _fingerprint(*(column.tobytes() for column in motion)) for name, motion in motions.items()}
    widths: list[tuple[float | None, float | None]] = [(gap, None) for gap in gaps] if factors is None else [(None, of) for of in factors]
    cases = [
        Case(scene.name, scene.fingerprint, name, ids[key], peak, gap, stop or _end(scene, motions[key]), varied, factor)
        for scene in found
        for key, name in ((key, label(key)) for key in motions)
        for varied in dict.fromkeys(map(varied_text, settings))
        for peak in dict.fromkeys(pga)
        for gap, factor in dict.fromkeys([*widths, (NEVER_CLOSES, None)])
    ]
    materials = Materials(
        {scene.fingerprint: scene.text for scene in found}, {ids[key]: motion for key, motion in motions.items()}
    )
    counts = [scene.readings.counts() for scene in found]
    storeys = {of: max(count.get(of, 0) for count in counts) for of in itertools.chain(*counts)}
    storeys[FACTOR] = int(factors is not None)
    # The same record twice, by two paths, is one.
    planned = Plan(list(dict.fromkeys(cases)), materials, storeys, _warnings(found))
    for scene in found:
        for key, motion in motions.items():
            planned.strengths[scene.fingerprint, ids[key]] = _strengths(scene, key, motion)
    return planned


def _fingerprint(*contents: bytes) -> str:
    digest = hashlib.sha256()
    for content in contents:
        digest.update(len(content).to_bytes(8, "little") + content)
    return digest.hexdigest()[:12]


def _scenes(scenes: Iterable[Scene], problems: list[str]) -> list[ReadScene]:
    """The scenes, each once. The name is that of the FMU, of pictures, and in the table."""
    found: dict[str, ReadScene] = {}
    for number, scene in enumerate(scenes, 1):
        is_path = isinstance(scene, os.PathLike) or isinstance(scene, str) and "\n" not in scene
        label = os.fsdecode(scene) if is_path else f"scene {number}"  # type: ignore[arg-type]
        try:
            read = studied(label, scene)
        except (OSError, ValueError) as error:
            said = error.strerror if isinstance(error, OSError) else None
            problems += [f"{label}: {line}" for line in (said or str(error)).split("\n")]
            continue
        other = found.setdefault(read.name, read)
        if other.text != read.text:
            problems.append(f"{other.label} and {label} are both named {read.name!r}: give one another name")
    return list(found.values())


def studied(label: str, scene: Scene) -> ReadScene:
    """A scene that has what a study reads."""
    read = read_scene(scene)
    text = read.without_ground()
    of = readings(text)
    lacking = [why.format(of.buildings[0]) for needed, why in NEEDED.items() if not getattr(of, needed)]
    if lacking:
        raise ValueError(f"expected a scene with {' and '.join(lacking)}")
    return ReadScene(label, json.loads(read.layout())["name"], text, read, of)


def _not_varied(scene: ReadScene, vary: Mapping[str, Sequence[float]]) -> list[str]:
    """What is wrong with the parameters that are to be varied, and with their values."""
    names, problems = Names(scene.read), []
    for key, values in vary.items():
        meant = scene.readings.meant(key)
        if not meant:
            problems.append(unknown(key, names.variables, "the scene has no such parameter"))
        elif key == "ground.scale" or key.endswith("].gap"):
            problems.append(f"{key} is what gaps and pga set: expected another parameter")
        else:
            for value in values:
                try:
                    names.check(meant, [])
                    scene.read.with_parameters([(names.references[name], value) for name in meant])
                except ValueError as error:
                    problems += str(error).split("\n")
    return list(dict.fromkeys(problems))


def _end(scene: ReadScene, motion: Motion) -> float:
    """s: the end of the record, or the scene's `stop_time` where that is later, as free motion may close the gap, too."""
    alone, _ = _native.Scene.parse(scene.text)
    assert alone is not None
    return max(alone.with_record(read_record(motion, "records")).stop(), float(motion[0][-1]))


def _warnings(scenes: Sequence[ReadScene]) -> list[str]:
    told = [(scene.label, text) for scene in scenes for text in scene.read.warnings()]
    return [text if len(scenes) == 1 else f"{label}: {text}" for label, text in told]


def _strengths(scene: ReadScene, key: str, motion: Motion) -> dict[str, tuple[float, float]]:
    """Of each building its first period and the spectral acceleration there that goes with a peak of 1 m/s2."""
    times, accelerations = motion
    unit = accelerations / np.abs(accelerations).max()
    periods: dict[str, Any] = {side: mode and mode[0] for side, mode in zip(scene.read.buildings(), scene.read.first_modes())}
    try:
        return {
            side: (period, spectra.pseudo_acceleration(times, unit, period)) for side, period in periods.items() if period
        }
    except ValueError as error:
        raise ValueError(f"{key}: {error}") from None
