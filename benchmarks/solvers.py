"""Which solvers there are, with what settings, and how each is made ready for a problem."""

import os
from dataclasses import dataclass
from typing import Callable

from peers import compiled, heyoka_taylor, opensees, scipy_ivp

OURS = "pounding"
WITHOUT_PEAKS = f"{OURS}, without peaks"
STEREOMECHANICAL = {"stereomechanical": "no impulses, no sustained contact"}
NEEDS_EVENTS = STEREOMECHANICAL | {"hertz_damped": "the approach velocity needs events"}


@dataclass(frozen=True)
class Entry:
    """A solver with the settings that it is run with, coarse to fine."""

    name: str
    parameter: str  # what a setting is
    settings: list
    quick_settings: list
    make: Callable  # (case, setting) -> an object with `setup` and `run()`
    without: dict  # laws that it cannot, with the reason
    yields: bool = False  # whether it can do storeys that yield

    def chosen(self, quick):
        return self.quick_settings if quick else self.settings


@dataclass(frozen=True)
class Case:
    """A problem with its files and its record."""

    problem: object
    scene_file: object
    scene_without_peaks: object
    numbers_file: object
    ground: tuple

    @property
    def floors(self):
        return sum(self.problem.floors)


def available(names=None):
    """The solvers that can be had here, ours first; and why the others cannot. Where CI is set all have to be there."""
    entries, missing = [], {}
    for group, prepare in GROUPS.items():
        if names and group != OURS and not any(name in group for name in names):
            continue
        try:
            entries += prepare()
        except Exception as error:  # whatever a peer's installation does: the benchmark goes on without it
            if os.environ.get("CI") and group not in OPTIONAL:
                raise
            missing[group] = f"{type(error).__name__}: {error}".splitlines()[0]
    return entries, missing


def decades(first, last, step=1):
    return [float(f"1e-{exponent}") for exponent in range(first, last + 1, step)]


def engine():
    program = compiled.build_engine()
    entries = []
    for name, scene in [(OURS, "scene_file"), (WITHOUT_PEAKS, "scene_without_peaks")]:
        make = lambda case, setting, scene=scene: compiled.Solver(
            program, getattr(case, scene), case.floors, "engine", setting
        )
        entries.append(Entry(name, "relative tolerance", decades(3, 13), decades(6, 12, 3), make, {}, yields=True))
    return entries


def heyoka():
    make = lambda case, setting: heyoka_taylor.Solver(case.problem, case.ground, setting)
    settings = [1e-5, 1e-7, 1e-9, 1e-10, 1e-11, 1e-12, 1e-14]
    return [Entry("heyoka", "tolerance", settings, [1e-7, 1e-11], make, heyoka_taylor.WITHOUT, yields=True)]


def cvode():
    program = compiled.build_cvode()
    entries = []
    for method, without in [("events", STEREOMECHANICAL), ("plain", NEEDS_EVENTS)]:
        make = lambda case, setting, method=method: compiled.Solver(
            program, case.numbers_file, case.floors, method, setting
        )
        name = f"CVODE Adams, {method}"
        entries.append(Entry(name, "relative tolerance", decades(4, 12, 2), decades(4, 8, 2), make, without))
    return entries


def fixed_step():
    program = compiled.build_fixed_step()
    entries = []
    for method, name in [("newmark", "Newmark"), ("rk4", "RK4")]:
        make = lambda case, setting, method=method: compiled.Solver(
            program, case.numbers_file, case.floors, method, setting
        )
        steps = [1e-3, 1e-4, 1e-5, 1e-6]
        entries.append(Entry(name, "step, s", steps, steps[:2], make, STEREOMECHANICAL, yields=True))
    return entries


def scipy():
    entries = []
    for method in ["DOP853", "LSODA"]:
        for events, without in [(True, STEREOMECHANICAL), (False, NEEDS_EVENTS)]:
            make = lambda case, setting, method=method, events=events: scipy_ivp.Solver(
                case.problem, case.ground, method, setting, events
            )
            name = f"SciPy {method}, {'events' if events else 'plain'}"
            entries.append(Entry(name, "relative tolerance", decades(4, 10, 3), [1e-6], make, without))
    return entries


def open_sees():
    module = opensees.load()
    make = lambda case, setting: opensees.Solver(case.problem, case.ground, module, setting)
    return [Entry("OpenSeesPy", "step, s", [1e-3, 1e-4, 1e-5], [1e-3], make, opensees.WITHOUT, yields=True)]


GROUPS = {
    OURS: engine,
    "heyoka": heyoka,
    "CVODE": cvode,
    "Newmark, RK4": fixed_step,
    "SciPy": scipy,
    "OpenSeesPy": open_sees,
}
# Of requirements-optional.txt.
OPTIONAL = {"OpenSeesPy"}
