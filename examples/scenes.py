"""Scenes as dictionaries: read from their files, changed where a parameter is varied, and run."""

import json
import tomllib
from decimal import Decimal
from math import inf, pi, sin

import engine


# What is in t or with kN in a scene with units = "kN-t", in the tables of buildings, dampings and contacts.
SCALED = {"mass", "stiffness", "stiffness_matrix", "matrix", "dashpots", "yield_force"}


def read(file):
    """A scene file in SI units, its record by an absolute path so that its text can lie anywhere."""
    scene = tomllib.loads(file.read_text())
    if scene.pop("units", "SI") == "kN-t":
        scene = in_si_units(scene)
    if "record" in scene.get("ground", {}):
        scene["ground"]["record"] = str((file.parent / scene["ground"]["record"]).resolve())
    return scene


def in_si_units(value, is_scaled=False):
    """The numbers of a scene in t and kN in kg and N: the doubles that their digits with the point moved are."""
    if isinstance(value, dict):
        return {key: in_si_units(inner, key in SCALED) for key, inner in value.items()}
    if isinstance(value, list):
        return [in_si_units(inner, is_scaled) for inner in value]
    return float(Decimal(repr(value)).scaleb(3)) if is_scaled else value


def text(scene):
    """The scene as TOML."""
    tables = {name: value for name, value in scene.items() if isinstance(value, dict)}
    lines = [f"{name} = {literal(value)}" for name, value in scene.items() if name not in tables and name != "contact"]
    for name, table in tables.items():
        lines += [f"[{name}]", *(f"{key} = {literal(value)}" for key, value in table.items())]
    for contact in scene.get("contact", []):
        lines += ["[[contact]]", *(f"{key} = {literal(value)}" for key, value in contact.items())]
    return "\n".join(lines) + "\n"


def literal(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {literal(inner)}" for key, inner in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(literal, value)) + "]"
    # JSON writes strings, Booleans and finite numbers as TOML does.
    return "inf" if value == inf else json.dumps(float(value) if isinstance(value, float) else value)


def run(scene, **how):
    return engine.simulate(text(scene), **how)


def contacts(law, gap, floors):
    """One contact at each of the lowest floors."""
    return [{"left_floor": floor, "right_floor": floor, "gap": gap, **law} for floor in range(1, floors + 1)]


def shear_building(mass, stiffness, storeys, damping_ratio):
    """Equal floors and equal storeys."""
    return {"mass": [mass] * storeys, "stiffness": [stiffness] * storeys, "damping": {"ratio": damping_ratio}}


def storey_stiffness(mass, period, storeys):
    """N/m that gives a shear building of equal floors and storeys its first period, s.

    Its circular frequencies are 2 sqrt(k/m) sin((2 j - 1) pi/(4 N + 2)).
    """
    return mass * (2 * pi / period / (2 * sin(pi / (4 * storeys + 2)))) ** 2
