"""Levels of the floors of a scene, positions of slabs between them, and the contacts that `[facing]` stands for.

Numbers of the scene are decimal (Decimal or int): levels and their differences are exact.
"""
from decimal import Decimal
from fractions import Fraction


def levels(building):
    """m: of the ground floor and of every floor above it."""
    level = [Decimal(building.get("base_level", 0))]
    for height in building["height"]:
        level.append(level[-1] + height)
    return level


def row(scene):
    """The buildings of a scene from left to right, each with its name."""
    if "building" in scene:
        return [{"name": f"b{place}"} | building for place, building in enumerate(scene["building"], 1)]
    return [{"name": side} | scene[side] for side in ("left", "right") if side in scene]


def neighbours(scene, between):
    """The buildings on the left and on the right of a contact or link, by side; at a wall there is one."""
    named = {building["name"]: building for building in row(scene)}
    names = {side: between.get(side) if "building" in scene else side for side in ("left", "right")}
    return {side: named[name] for side, name in names.items() if name in named}


def share(building, storey, level):
    """Where a level is in a storey, from its lower end: nearest float64."""
    below, above = levels(building)[storey - 1:storey + 1]
    return float(Fraction(level - below) / Fraction(above - below))


def other(side):
    return "right" if side == "left" else "left"


def position(scene, contact, side):
    """Where a floor of the other building meets a storey of this side's building; None where heights are missing."""
    pair = neighbours(scene, contact)
    if not all("height" in building for building in pair.values()):
        return None
    level = levels(pair[other(side)])[contact[f"{other(side)}_floor"]]
    return share(pair[side], contact[f"{side}_storey"], level)


def met_by(pair, side, floor, tolerance):
    """What a floor of one of two neighbours meets of the other one, as keys of a contact; None: nothing."""
    level = levels(pair[side])[floor]
    neighbour = levels(pair[other(side)])
    if level <= neighbour[0]:
        return None
    near = [i for i in range(1, len(neighbour)) if abs(neighbour[i] - level) <= tolerance]
    if near:
        return {f"{side}_floor": floor, f"{other(side)}_floor": min(near, key=lambda i: abs(neighbour[i] - level))}
    storeys = [i for i in range(1, len(neighbour)) if neighbour[i - 1] < level < neighbour[i]]
    return {f"{side}_floor": floor, f"{other(side)}_storey": storeys[0]} if storeys else None


def meetings(pair, tolerance):
    """What two neighbours meet with, as keys of contacts, from the lowest level up."""
    found = []
    for side in ("left", "right"):
        for floor, level in list(enumerate(levels(pair[side])))[1:]:
            meeting = met_by(pair, side, floor, tolerance)
            if meeting and all(meeting != earlier for _, earlier in found):
                found.append((level, meeting))
    return [meeting for _, meeting in sorted(found, key=lambda entry: entry[0])]


def contacts(scene):
    """The contacts of a scene: those of `[facing]` gap by gap from the left, then those that stand in it."""
    facing = scene.get("facing", {})
    keys = {key: value for key, value in facing.items() if key not in ("gap", "level_tolerance")}
    tolerance = facing.get("level_tolerance", Decimal("0.1"))
    buildings = row(scene) if facing else []
    gaps = facing.get("gap")
    gaps = gaps if isinstance(gaps, list) else [gaps] * (len(buildings) - 1)
    found = []
    for left, right, gap in zip(buildings, buildings[1:], gaps, strict=False):
        between = {"left": left["name"], "right": right["name"], "gap": gap} | keys
        found += [between | meeting for meeting in meetings({"left": left, "right": right}, tolerance)]
    return found + scene.get("contact", [])
