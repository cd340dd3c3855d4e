#!/usr/bin/env python3
"""What rows of buildings cost, in instructions of the steps of an importer, as multiples of the pairs that they are made of.

    benchmarks/rows.py             with the library of `cargo fmu`
    benchmarks/rows.py LIBRARY     with this one

Each line is a row, what it is compared with, how many times that it costs, and how many times it may. Needs gcc and valgrind.
"""

import sys
from dataclasses import dataclass
from pathlib import Path

import instructions

ROOT = Path(__file__).resolve().parents[1]
FAR, NEAR = 1.0, 0.004  # m
HEAD = f"""stop_time = 20.0
[ground]
record = "{ROOT}/examples/records/el_centro_1940_ns.csv"
"""


@dataclass(frozen=True)
class Building:
    floors: int
    stiffness: float
    yields: bool = False

    def toml(self):
        def of(value):
            return [value] * self.floors

        keys = f"[[building]]\nmass = {of(2e5)}\nstiffness = {of(self.stiffness)}\ndamping = {{ ratio = 0.05 }}\n"
        return keys + (f"yield_force = {of(4e5)}\npost_yield_ratio = 0.05\n" if self.yields else "")


def row(name, buildings, gaps):
    """The text of a row whose neighbours may meet with each floor that both have; a gap of None has no contact."""
    contacts = "".join(
        f'[[contact]]\nleft = "b{left}"\nright = "b{left + 1}"\nleft_floor = {floor}\nright_floor = {floor}\n'
        f'gap = {gap}\nlaw = "kelvin_voigt"\nstiffness = 5e8\nrestitution = 0.6\n'
        for left, (gap, pair) in enumerate(zip(gaps, zip(buildings, buildings[1:])), 1)
        if gap is not None
        for floor in range(1, min(building.floors for building in pair) + 1)
    )
    return f'name = "{name}"\n{HEAD}' + "".join(building.toml() for building in buildings) + contacts


LOW = Building(2, 1.2e8)
OTHER = Building(2, 7e7)
YIELDING = [Building(3, stiffness, yields=True) for stiffness in (9e7, 1.6e8, 7e7, 2e8, 1.1e8)]
PAIR_APART = row("pair_apart", [LOW, LOW], [FAR])
PAIR = row("pair", [LOW, OTHER], [NEAR])
ALONE = row("alone", [LOW], [])


def pairs(buildings):
    return [row(f"pair_{k}", list(pair), [NEAR]) for k, pair in enumerate(zip(buildings, buildings[1:]), 1)]


def main():
    library = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else instructions.packed()
    driver = instructions.compiled_driver()

    def count(text):
        name = text.split('"')[1]
        place = instructions.WORK / "rows" / f"{name}.toml"
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text)
        return instructions.Case(place).instructions(driver, library)[0]

    apart, pair, alone = count(PAIR_APART), count(PAIR), count(ALONE)
    yielding = max(count(text) for text in pairs(YIELDING))
    lines = [
        ("ten that never meet", row("ten_apart", [LOW] * 10, [FAR] * 9), "a pair that never meets", apart, 6.0),
        (
            "ten, of which two collide",
            row("ten", [LOW, OTHER] + [LOW] * 8, [NEAR] + [FAR] * 8),
            "these two, and eight alone",
            pair + 8 * alone,
            1.5,
        ),
        ("five that yield and collide", row("five", YIELDING, [NEAR] * 4), "the dearest of their pairs", yielding, 5.0),
        (
            "fifty of six floors, no contact",
            row("fifty", [Building(6, 4e8)] * 50, [None] * 49),
            "a pair of two floors",
            apart,
            75.0,
        ),
    ]
    too_dear = []
    for name, text, other, price, most in lines:
        factor = count(text) / price
        print(f"{name:34} {factor:6.2f} times {other} (at most {most:g})", flush=True)
        if factor > most:
            too_dear.append(name)
    if too_dear:
        sys.exit(f"too dear: {', '.join(too_dear)}")


if __name__ == "__main__":
    main()
