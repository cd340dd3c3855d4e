"""Random rows of three to six buildings as text, with everything that buildings of a row may have."""

import numpy as np
from random_frames import Frame, contact, number, numbers

SIDES = ("left", "right")
STOP = 2.0  # s; the other program takes a minute for some of them


def scene(rng):
    """The text of a scene, without its record."""
    row = [Building(rng, place) for place in range(1, rng.integers(3, 7) + 1)]
    lines = ['name = "Random"', f"stop_time = {STOP}"]
    for building in row:
        lines += building.lines(rng)
    lines += facing(rng, row) if rng.random() < 0.4 else between(rng, row)
    for building in row:
        lines += walls(rng, building)
    return "\n".join([*lines, *links(rng, row)]) + "\n"


class Building(Frame):
    def __init__(self, rng, place):
        super().__init__(rng, rng.choice([1, 2, 3], p=[0.4, 0.4, 0.2]))
        self.name, self.has_name = rng.choice([(f"b{place}", ""), (f"house_{place}", "named")])
        self.floors = len(self.mass)
        # A building by its matrix stays elastic and stands on a fixed base.
        self.has_matrix = self.floors > 1 and rng.random() < 0.25
        self.has_soil = not self.has_matrix and rng.random() < 0.4
        self.yields, self.leans = not self.has_matrix and rng.random() < 0.5, rng.random() < 0.4
        # m; within the tolerance of [facing] or not.
        self.base_level = round(rng.choice([0.0, rng.uniform(-0.04, 0.04), rng.uniform(-2.0, 2.0)]), 2)

    def lines(self, rng):
        lines = ["[[building]]", *([f'name = "{self.name}"'] if self.has_name else [])]
        lines += super().lines(rng, self.yields, self.leans)
        lines.append(f"base_level = {number(self.base_level)}")
        if self.has_matrix:
            lines = [self.by_matrix(rng) if line.startswith("stiffness") else line for line in lines]
            lines = [self.damped(rng) if line.startswith("damping") else line for line in lines]
        return lines + (self.foundation(rng, "building") if self.has_soil else [])

    def matrix(self, storeys):
        upper = np.diag(storeys) + np.diag(np.append(storeys[1:], 0.0))
        return upper - np.diag(storeys[1:], 1) - np.diag(storeys[1:], -1)

    def by_matrix(self, rng):
        """Its storeys, and springs from floors to the ground."""
        braced = np.diag(self.stiffness * rng.uniform(0.0, 0.3, self.floors))
        return f"stiffness_matrix = {rows(self.matrix(self.stiffness) + braced)}"

    def damped(self, rng):
        """A damping matrix that is not that of its modes."""
        dashpots = rng.uniform(0.0, 0.02, self.floors) * np.sqrt(self.stiffness * self.mass)
        return f"damping = {{ matrix = {rows(self.matrix(dashpots))} }}"


def rows(matrix):
    return f"[{', '.join(map(numbers, matrix))}]"


def facing(rng, row):
    """Contacts of all neighbours by the levels of their floors, with one law."""
    _, gap, *law = contact(rng, row, [])
    gaps = 10 ** rng.uniform(-3.3, -1.7, len(row) - 1)
    shape = f'column_shape = "{rng.choice(["fixed", "straight"])}"'
    return ["[facing]", rng.choice([gap, f"gap = {numbers(gaps)}"]), shape, *law]


def between(rng, row):
    """Contacts of most neighbours: at the roof of the lower one and below, some with columns."""
    lines = []
    for left, right in zip(row, row[1:], strict=False):
        lowest = min(left.floors, right.floors)
        ends = [f'left = "{left.name}"', f'right = "{right.name}"']
        for floor in range(1, lowest + 1):
            if floor == lowest or rng.random() < 0.5:
                lines += contact(rng, [left, right], [*ends, f"left_floor = {floor}", f"right_floor = {floor}"])
        if rng.random() < 0.3:
            side, other = rng.permutation(SIDES)
            storeys = {"left": left, "right": right}
            place = [*ends, f"{side}_floor = {rng.integers(1, storeys[side].floors + 1)}"]
            place.append(f"{other}_storey = {rng.integers(1, storeys[other].floors + 1)}")
            place.append(f"{other}_position = {number(rng.uniform(0.1, 0.9))}")
            place.append(f'column_shape = "{rng.choice(["fixed", "straight"])}"')
            lines += contact(rng, [left, right], place)
    return lines


def walls(rng, building):
    if rng.random() < 0.8:
        return []
    side, wall = rng.choice(SIDES, 2)
    floor = rng.integers(1, building.floors + 1)
    return contact(rng, [building], [f'{side} = "{building.name}"', f"{side}_floor = {floor}", f'wall = "{wall}"'])


def links(rng, row):
    """Between some neighbours, at any floors or the foundations; a few to the ground."""
    lines = []
    for left, right in zip(row, row[1:], strict=False):
        if rng.random() < 0.4:
            lines += ["[[link]]", f'left = "{left.name}"', f'right = "{right.name}"']
            lines += [f"{side}_floor = {floor(rng, of)}" for side, of in zip(SIDES, (left, right), strict=True)]
            lines += device(rng, [left, right])
    for building in row:
        if rng.random() < 0.1:
            side, wall = rng.permutation(SIDES)
            lines += ["[[link]]", f'{side} = "{building.name}"', f"{side}_floor = {floor(rng, building)}"]
            lines += [f'wall = "{wall}"', *device(rng, [building], may_slip=side == "left")]
    return lines


def floor(rng, building):
    return rng.integers(0 if building.has_soil else 1, building.floors + 1)


def device(rng, ends, may_slip=True):
    """Springs that slip have a floor on their left in the other program."""
    softest = min(building.stiffness.min() for building in ends)
    lines = [f"stiffness = {number(softest * rng.uniform(0.05, 1.0))}"]
    lines.append(f"dashpot = {number(softest * rng.choice([0.0, rng.uniform(0.0, 0.01)]))}")
    if may_slip and rng.random() < 0.5:
        lines.append(f"slip_force = {number(softest * 10 ** rng.uniform(-4.0, -2.0))}")
        lines.append(f"post_yield_ratio = {number(rng.choice([0.0, rng.uniform(0, 0.5)]))}")
    return lines
