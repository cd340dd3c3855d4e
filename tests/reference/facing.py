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


def share(building, storey, level):
    """Where a level is in a storey, from its lower end: nearest float64."""
    below, above = levels(building)[storey - 1:storey + 1]
    return float(Fraction(level - below) / Fraction(above - below))


def other(side):
    return "right" if side == "left" else "left"


def position(scene, contact, side):
    """Where a floor of the other building meets a storey of this side's building; None where heights are missing."""
    if not all("height" in scene[name] for name in ("left", "right")):
        return None
    level = levels(scene[other(side)])[contact[f"{other(side)}_floor"]]
    return share(scene[side], contact[f"{side}_storey"], level)


def met_by(scene, side, floor, tolerance):
    """What a floor of one building meets of the other one, as keys of a contact; None: nothing."""
    level = levels(scene[side])[floor]
    neighbour = levels(scene[other(side)])
    if level <= neighbour[0]:
        return None
    near = [i for i in range(1, len(neighbour)) if abs(neighbour[i] - level) <= tolerance]
    if near:
        return {f"{side}_floor": floor, f"{other(side)}_floor": min(near, key=lambda i: abs(neighbour[i] - level))}
    storeys = [i for i in range(1, len(neighbour)) if neighbour[i - 1] < level < neighbour[i]]
    return {f"{side}_floor": floor, f"{other(side)}_storey": storeys[0]} if storeys else None


def contacts(scene):
    """The contacts of a scene, those of `[facing]` from the lowest level up."""
    if "facing" not in scene:
        return scene.get("contact", [])
    keys = {key: value for key, value in scene["facing"].items() if key != "level_tolerance"}
    tolerance = scene["facing"].get("level_tolerance", Decimal("0.1"))
    found = []
    for side in ("left", "right"):
        for floor, level in list(enumerate(levels(scene[side])))[1:]:
            meeting = met_by(scene, side, floor, tolerance)
            if meeting and all(meeting != earlier for _, earlier in found):
                found.append((level, meeting))
    return [meeting | keys for _, meeting in sorted(found, key=lambda pair: pair[0])]
