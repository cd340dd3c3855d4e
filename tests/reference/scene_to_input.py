"""Converts a scene (TOML) to the input of the reference solver (format: head of reference.c).

    python3 tests/reference/scene_to_input.py SCENE.toml [--step S] [--stop T] [--record FILE] > INPUT

Python 3.11, standard library only. Numbers go through float64, as in the engine; levels and positions are worked out
with the decimal numbers of the scene (`facing.py`).
"""
import argparse
import os
import tomllib
from decimal import Decimal

from facing import contacts, neighbours, position, row

# What is in t or with kN where a scene says so.
IN_KN_T = {
    "mass", "inertia", "stiffness", "stiffness_matrix", "yield_force", "matrix", "dashpots", "gravity_load", "dashpot",
    "slip_force",
}


def in_si_units(value, is_scaled=False):
    if isinstance(value, dict):
        return {key: in_si_units(inner, key in IN_KN_T) for key, inner in value.items()}
    if isinstance(value, list):
        return [in_si_units(inner, is_scaled) for inner in value]
    return value * 1000 if is_scaled else value


def numbers(values):
    return " ".join(repr(float(value)) for value in values)


def damping_lines(damping):
    (kind, value), = damping.items()
    if kind == "ratio":
        return [f"damping ratio {numbers([value])}"]
    if kind in ("ratios", "dashpots"):
        return [f"damping {kind} {numbers(value)}"]
    if kind == "rayleigh":
        first, second = value["modes"]
        return [f"damping rayleigh {numbers([value['ratio']])} {first} {second}"]
    if kind == "matrix":
        return [f"damping_row {numbers(row)}" for row in value]
    raise SystemExit(f"damping: unknown kind {kind!r}")


def gravity_lines(building):
    leans = building.get("p_delta", False)
    leans = leans if isinstance(leans, list) else [leans] * len(building["mass"])
    if not any(leans):
        return []
    lines = [f"gravity_load {numbers(building['gravity_load'])}"] if "gravity_load" in building else []
    heights = [height if is_pushed else "inf" for height, is_pushed in zip(building["height"], leans, strict=True)]
    lines.append(f"lean {numbers(heights)}")
    if "yield_force" in building:
        lines.append(f"collapse_drift_ratio {numbers([building.get('collapse_drift_ratio', 0.5)])}")
    return lines


def foundation_lines(building):
    foundation = building.get("foundation", {})
    lines = [f"height {numbers(building['height'])}"] if foundation else []
    for way, weight in (("sway", "mass"), ("rocking", "inertia")):
        if way in foundation:
            spring = foundation[way]
            lines.append(f"{way} {numbers([foundation[weight], spring['stiffness'], spring.get('dashpot', 0)])}")
    return lines


def building_lines(building):
    lines = [f"building {len(building['mass'])} {building['name']}", f"mass {numbers(building['mass'])}"]
    if "stiffness" in building:
        lines.append(f"stiffness {numbers(building['stiffness'])}")
    else:
        lines += [f"stiffness_row {numbers(row)}" for row in building["stiffness_matrix"]]
    if "yield_force" in building:
        ratios = building.get("post_yield_ratio", 0)
        ratios = ratios if isinstance(ratios, list) else [ratios] * len(building["mass"])
        lines += [f"yield_force {numbers(building['yield_force'])}", f"post_yield_ratio {numbers(ratios)}"]
    lines += gravity_lines(building)
    lines += foundation_lines(building)
    lines += damping_lines(building["damping"])
    for key in ("displacement", "velocity"):
        if f"initial_{key}" in building:
            lines.append(f"{key} {numbers(building[f'initial_{key}'])}")
    return lines


def place(scene, contact, side):
    """What is on one side of a contact or link."""
    if contact.get("wall") == side:
        return "wall"
    if "wall" in contact:
        # The one building, whose floor may be named on the side of the wall.
        side, = (key[:-6] for key in contact if key.endswith("_floor"))
    name = neighbours(scene, contact)[side]["name"]
    if f"{side}_storey" in contact:
        share = float(contact.get(f"{side}_position", position(scene, contact, side)))
        return f"{name}:columns:{contact[f'{side}_storey']}:{share!r}:{contact.get('column_shape', 'fixed')}"
    return f"{name}:{contact[f'{side}_floor']}"


def contact_line(scene, contact):
    words = ["contact", *(place(scene, contact, side) for side in ("left", "right"))]
    words += [numbers([contact["gap"]]), contact["law"]]
    for key in ("stiffness", "exponent", "restitution"):
        if key in contact:
            words += [key, numbers([contact[key]])]
    if "damping_formula" in contact:
        words += ["damping_formula", contact["damping_formula"]]
    return " ".join(words)


def link_line(scene, link):
    words = ["link", *(place(scene, link, side) for side in ("left", "right"))]
    for key in ("stiffness", "dashpot", "slip_force", "post_yield_ratio"):
        if key in link:
            words += [key, numbers([link[key]])]
    return " ".join(words)


def record_lines(ground, scene_folder, other_record):
    record = other_record
    if record is None and "record" in ground:
        record = os.path.normpath(os.path.join(scene_folder, ground["record"]))
    if record is None:
        return []
    if not record.lower().endswith(".csv"):
        raise SystemExit(f"{record}: only CSV records")
    lines = [f"record {record}"]
    for key in ("scale", "pga"):
        if key in ground:
            lines.append(f"{key} {numbers([ground[key]])}")
    return lines


def convert(path, step, stop, record):
    with open(path, "rb") as file:
        scene = tomllib.load(file, parse_float=Decimal)
    if scene.get("units") == "kN-t":
        scene = in_si_units(scene)
    lines = [f"stop {numbers([scene['stop_time'] if stop is None else stop])}", f"output_step {numbers([step])}"]
    lines += record_lines(scene.get("ground", {}), os.path.dirname(path), record)
    if "min_approach_velocity" in scene.get("solver", {}):
        lines.append(f"min_approach_velocity {numbers([scene['solver']['min_approach_velocity']])}")
    for building in row(scene):
        lines += building_lines(building)
    lines += [contact_line(scene, contact) for contact in contacts(scene)]
    return lines + [link_line(scene, link) for link in scene.get("link", [])]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene")
    parser.add_argument("--step", type=float, default=0.5, help="output step, s")
    parser.add_argument("--stop", type=float, help="end, s; default: stop_time of the scene")
    parser.add_argument("--record", help="another record (CSV)")
    options = parser.parse_args()
    print("\n".join(convert(options.scene, options.step, options.stop, options.record)))


if __name__ == "__main__":
    main()
