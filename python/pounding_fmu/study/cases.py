"""The cases of a study: what each of them is, and what a worker, in this process or on another machine, does with them.

Everything that a worker needs comes with the cases: the texts of the scenes and the samples of the records.
"""

from __future__ import annotations

import functools
import itertools
import re
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from .. import _native
from .._batch import BatchError, simulate_batch
from .._scenes import SceneWarning

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

Row = dict[str, Any]
Motion = tuple["NDArray[np.float64]", "NDArray[np.float64]"]  # s and m/s2


def largest(columns: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
    """The largest number of each row."""
    import numpy as np

    return functools.reduce(np.maximum, columns)


SIDES = ("left", "right")  # both have columns, also where one building stands alone
NEVER_CLOSES = 1e3  # m, the gap of the runs without contact
# Columns by what they are made of: outputs of all contacts, and of the storeys or floors of a building.
OF_CONTACTS: dict[str, tuple[str, Callable[[Any], Any]]] = {
    "peak_force_n": ("peak_force", largest),
    "impulse_n_s": ("impulse", sum),
    "dissipated_energy_j": ("dissipated_energy", sum),
}
OF_STOREYS = {
    "drift_m": "peak_drift",
    "acceleration_m_s2": "peak_acceleration",
    "column_force_n": "peak_column_force",
}
# Of each link; the energy of a dashpot is there with `outputs.energy` alone.
OF_LINKS = {"force_n": "peak_force", "displacement_m": "peak_displacement", "energy_j": "dissipated_energy"}
LINK = "link"
# Of each foundation, in the ways in which it moves.
OF_FOUNDATIONS = {
    "displacement_m": "peak_displacement", "rotation_rad": "peak_rotation", "force_n": "peak_force", "moment_n_m": "peak_moment",
}  # fmt: skip
FOUNDATION = "foundation"
ANY_FOUNDATION = "any foundation"  # what a table has room for: no name of a building
# Of each contact of a row of buildings, and the number of the one with the largest force.
OF_EACH_CONTACT = {"force_n": "peak_force", "impacts": "impacts"}
CONTACT = "contact"
HARDEST = "hardest_contact"
FACTOR = "gap_factor"
OF_YIELDING = {"ductility": "ductility", "residual_drift_m": "residual_drift"}
STRENGTH = ("stiffness", "yield_force", "post_yield_ratio")


@dataclass(frozen=True)
class Case:
    """One run. Scene and record by name and by a fingerprint of what is in them."""

    scene: str
    scene_id: str
    record: str
    record_id: str
    pga: float
    """m/s2"""
    gap: float | None
    """m, of all contacts; None with a factor"""
    stop: float
    """s"""
    varied: str = ""
    """The other parameters that it sets, as `varied_text` writes them."""
    factor: float | None = None
    """by which all gaps of the scene are multiplied"""

    def width(self, own: float) -> float:
        """m, of a gap that is so wide in the scene."""
        return own * self.factor if self.factor is not None else self.gap or 0.0


@dataclass(frozen=True)
class Materials:
    """What all cases need."""

    scenes: Mapping[str, str]
    """By their fingerprint: their texts without ``[ground]``."""
    records: Mapping[str, Motion]
    """By their fingerprint."""


class Readings:
    """What is read at the end of a run of a scene, and the row of a table that is made of it."""

    def __init__(self, variables: Mapping[str, Any], buildings: Sequence[str]) -> None:
        """Of all variables with their starts, and the names of the buildings."""
        names = list(variables)
        self.is_row = not {*buildings} <= {*SIDES}
        self.buildings = list(buildings) if self.is_row else list(SIDES)
        self.gaps: dict[str, float] = {name: variables[name] for name in _of_contacts(names, "gap")}
        self.each_contact = {
            what: _numbered(names, f"{CONTACT}[", f"].{what}") if self.is_row else {}
            for what in (*OF_EACH_CONTACT.values(), "impulse")
        }
        self.contacts = {what: _of_contacts(names, what) for what, _ in OF_CONTACTS.values()}
        of_storeys = [*OF_STOREYS.values(), *OF_YIELDING.values(), *STRENGTH]
        self.storeys = {(side, what): _numbered(names, f"{side}.{what}[", "]") for side in self.buildings for what in of_storeys}
        self.links = {what: _numbered(names, f"{LINK}[", f"].{what}") for what in OF_LINKS.values()}
        of_foundations = {
            f"{side}_{FOUNDATION}_{column}": f"{side}.{FOUNDATION}.{what}"
            for column, what in OF_FOUNDATIONS.items()
            for side in self.buildings
        }
        self.foundations = {column: name for column, name in of_foundations.items() if name in names}
        self.names = names
        # One building may stand alone, between walls.
        self.sides = [side for side in self.buildings if self.storeys[side, "peak_acceleration"]]
        self.outputs = ["impacts", *itertools.chain(*self.contacts.values())]
        self.outputs += [name for of_side in self.storeys.values() for name in of_side.values()]
        self.outputs += [name for of_link in self.links.values() for name in of_link.values()]
        self.outputs += self.foundations.values()
        self.outputs += [f"{side}.peak_base_shear" for side in self.sides]
        self.collapses = {side: f"{side}.collapsed" for side in self.buildings if f"{side}.collapsed" in names}
        self.outputs += self.collapses.values()
        self.outputs += [name for of in self.each_contact.values() for name in of.values()]
        self.outputs = list(dict.fromkeys(self.outputs))

    def counts(self) -> dict[str, int]:
        """Storeys of each building, links, and contacts of a row; 1 where there are foundations."""
        others = {LINK: len(self.links["peak_force"]), ANY_FOUNDATION: int(bool(self.foundations))}
        others[CONTACT] = len(self.each_contact["impacts"])
        return {side: len(self.storeys[side, "peak_drift"]) for side in self.buildings} | others

    def meant(self, name: str) -> list[str]:
        """The variables that a name stands for, in which `*` is any number, or before the first dot any building."""
        first, dot, rest = name.partition(".")
        any_building = "(?:" + "|".join(map(re.escape, self.buildings)) + ")"
        begin = any_building if first == "*" and dot else re.escape(first).replace(r"\*", r"\d+")
        pattern = re.compile(begin + re.escape(dot + rest).replace(r"\*", r"\d+"))
        return [variable for variable in self.names if pattern.fullmatch(variable)]

    def rows(self, ends: NDArray[np.float64]) -> list[Row]:
        """The results of cases, of the values of the outputs at the end of each."""
        value = dict(zip(self.outputs, ends.T, strict=True))
        columns: dict[str, Any] = {"impacts": value["impacts"].astype(int)}
        for column, (what, summary) in OF_CONTACTS.items():
            columns[column] = summary([value[name] for name in self.contacts[what]])
        for column, what in OF_LINKS.items():
            columns |= {f"{LINK}_{column}[{i}]": value[name] for i, name in self.links[what].items()}
        columns |= {column: value[name] for column, name in self.foundations.items()}
        columns |= self.columns_of_contacts(value)
        for side in self.sides:
            columns[f"{side}_base_shear_n"] = value[f"{side}.peak_base_shear"]
            of_side = {
                what: {i: value[name] for i, name in self.storeys[side, what].items()}
                for what in [*OF_STOREYS.values(), *OF_YIELDING.values(), *STRENGTH]
            }
            peaks = {column: of_side[what] for column, what in OF_STOREYS.items()}
            peaks["storey_shear_n"] = storey_shears(of_side)
            columns |= {f"{side}_{column}[{i}]": peak for column, of in peaks.items() for i, peak in of.items()}
            peaks |= {column: of_side[what] for column, what in OF_YIELDING.items()}
            columns |= {f"{side}_{column}": largest([*map(abs, of.values())]) for column, of in peaks.items() if of}
        columns |= {f"{side}_collapsed": value[name].astype(int) for side, name in self.collapses.items()}
        return [dict(zip(columns, row)) for row in zip(*(column.tolist() for column in columns.values()))]

    def columns_of_contacts(self, value: Mapping[str, NDArray[np.float64]]) -> dict[str, Any]:
        """Of each contact of a row of buildings, and which was hit hardest: the force of rigid contacts says nothing, so without
        others it is the impulse. No one was where none was hit."""
        import numpy as np

        if not self.each_contact["impacts"]:
            return {}
        columns: dict[str, Any] = {}
        for column, what in OF_EACH_CONTACT.items():
            kind = int if what == "impacts" else float
            columns |= {f"{CONTACT}_{column}[{p}]": value[name].astype(kind) for p, name in self.each_contact[what].items()}
        hardest = np.full(len(value["impacts"]), None)
        for what in ("impulse", "peak_force"):
            found = np.array([value[name] for name in self.each_contact[what].values()])
            hit = found.any(axis=0)
            hardest[hit] = np.array([*self.each_contact[what]], object)[found.argmax(axis=0)[hit]]
        return columns | {HARDEST: hardest}


def collapsed(row: Row) -> bool:
    """Whether the run has ended by a collapse."""
    return any(value for name, value in row.items() if name.endswith("_collapsed"))


class Factor(float):
    """A gap as so many times that of the scene."""


def by_width(rows: Sequence[Row]) -> list[Row]:
    """Rows whose `gap_m` is what was set, a factor on gaps, too."""
    return [row if row.get(FACTOR) is None else {**row, "gap_m": Factor(row[FACTOR])} for row in rows]


def sides_of(row: Row) -> list[str]:
    """The names of the buildings that a row has columns of."""
    ending = "_period_s"
    return [name.removesuffix(ending) for name in row if name.endswith(ending)] or list(SIDES)


def _numbered(names: Sequence[str], start: str, end: str) -> dict[int, str]:
    """By their numbers the variables whose names are a number between these texts."""
    found = {name: name.removeprefix(start).removesuffix(end) for name in names if name.startswith(start)}
    return {int(number): name for name, number in found.items() if number.isdecimal()}


def varied_text(values: Mapping[str, float]) -> str:
    """Parameters and their values as the table has them."""
    return "; ".join(f"{name}={value!r}" for name, value in values.items())


def varied_values(text: str) -> dict[str, float]:
    """Parameters and their values of that text."""
    pairs = (setting.split("=") for setting in text.split("; ") if setting)
    return {name: float(value) for name, value in pairs}


def _of_contacts(names: Sequence[str], what: str) -> list[str]:
    return [name for name in names if name.startswith("contact[") and name.endswith(f"].{what}")]


def storey_shears(of_side: Mapping[str, Mapping[int, NDArray[np.float64]]]) -> dict[int, NDArray[np.float64]]:
    """N, the largest shear of each storey of a shear building, without damping: stiffness times the largest drift d, or,
    where the storey can yield, V = r k d + (1 - r) V_y beyond its yield drift, on which it is at that drift."""
    import numpy as np

    shears = {}
    for i, stiffness in of_side["stiffness"].items():
        elastic, ratio = stiffness * of_side["peak_drift"][i], of_side["post_yield_ratio"].get(i, 0.0)
        strength = of_side["yield_force"].get(i)
        shears[i] = elastic if strength is None else np.minimum(elastic, ratio * elastic + (1 - ratio) * strength)
    return shears


@functools.lru_cache(maxsize=64)
def readings(scene: str) -> Readings:
    """What is read of a scene, given by its text without ``[ground]``."""
    read, _ = _native.Scene.parse(scene)
    assert read is not None  # it has been read before
    return Readings({variable[0]: variable[7] for variable in read.variables()}, read.buildings())


def run_cases(
    cases: Sequence[Case],
    materials: Materials,
    threads: int | None = None,
    progress: Callable[[int], object] | None = None,
) -> list[tuple[Case, Row]]:
    """Each case and its row; where a run has failed, the row says why. ``progress`` is told how many are done."""
    rows: list[tuple[Case, Row]] = []
    for (scene, stop), group in itertools.groupby(cases, lambda case: (case.scene_id, case.stop)):
        of_group = list(group)
        tell = None if progress is None else _from(progress, len(rows))
        found = _run(materials.scenes[scene], of_group, materials.records, stop, threads, tell)
        rows += zip(of_group, found, strict=True)
    return rows


def _from(progress: Callable[[int], object], before: int) -> Callable[[int, int], object]:
    return lambda done, _: progress(before + done)


def _run(
    scene: str,
    cases: Sequence[Case],
    records: Mapping[str, Motion],
    stop: float,
    threads: int | None,
    progress: Callable[[int, int], object] | None,
) -> list[Row]:
    """The rows of cases of one scene that end at the same time."""
    import numpy as np

    read = readings(scene)
    motions = [records[case.record_id] for case in cases]
    parameters: dict[str, Any] = {name: [case.width(own) for case in cases] for name, own in read.gaps.items()}
    varied = [varied_values(case.varied) for case in cases]  # of the same parameters
    parameters |= {name: [of[key] for of in varied] for key in varied[0] for name in read.meant(key)}
    parameters["ground.scale"] = [case.pga / np.abs(motion[1]).max() for case, motion in zip(cases, motions)]
    failures: Mapping[int, str] = {}
    try:
        with warnings.catch_warnings():
            # Who has asked for the study has seen them.
            warnings.simplefilter("ignore", SceneWarning)
            ends = simulate_batch(scene, parameters, read.outputs, motions, threads, stop=stop, progress=progress)
    except BatchError as error:
        ends, failures = error.results, error.failures
    except ValueError as error:
        if len(cases) == 1:
            return [failed(str(error).removeprefix("case 0: "))]
        return [_run(scene, [case], records, stop, threads, None)[0] for case in cases]
    done = iter(read.rows(ends[[i not in failures for i in range(len(cases))]]))
    return [failed(failures[i]) if i in failures else {**next(done), "error": ""} for i in range(len(cases))]


def failed(text: str) -> Row:
    """The row of a case whose run has failed."""
    return {"error": " ".join(text.split())}
