"""A building that another program has, beside one that is ours: its storeys are OpenSeesPy's, all collisions are exact.

    "$(ci/environment)" examples/couple_opensees.py

The left building is asked for its restoring forces at each step, by `pounding_fmu.couple`. Here its storeys are
bilinear, so that one FMU can have the whole problem as well (`yield_force`), and errors can be seen. With `--opensees`
they are Steel01 of OpenSeesPy (`pip install openseespy`; its licence is not free for all uses); without it `Storeys`,
which says the same in a few lines.
"""

import argparse

import numpy as np
import pounding_fmu

# N/m, N, and the share of the stiffness that is left after yield.
STIFFNESS, YIELD, RATIO = np.array([200e6, 190e6, 160e6, 110e6]), np.array([1490e3, 1330e3, 1010e3, 530e3]), 0.05
FLOORS = range(1, len(STIFFNESS) + 1)
STOP, STEPS = 20.0, [0.01, 0.005, 0.0025, 0.00125]  # s
RECORD = pounding_fmu.example_scene.parent.parent / "records/el_centro_1940_ns.csv"


class Storeys:
    """The other program, in its place."""

    def __init__(self):
        self.plastic = np.zeros(len(STIFFNESS))

    def initial_stiffness(self):
        return STIFFNESS  # N/m, of storeys; or a matrix over the floors

    def move(self, displacements):
        """The forces that hold the floors there, N."""
        drift = np.diff(displacements, prepend=0.0)
        limit = YIELD / STIFFNESS
        self.plastic = drift - np.clip(drift - self.plastic, -limit, limit)
        shear = RATIO * STIFFNESS * drift + (1 - RATIO) * STIFFNESS * (drift - self.plastic)
        return shear - np.append(shear[1:], 0.0)


class OpenSees:
    """Any model of OpenSeesPy: its floors are moved to where they are to be, and hold with their reactions."""

    def __init__(self, floors):
        """With the model that has just been built; `floors` are its nodes and their directions, lowest first."""
        import openseespy.opensees as ops

        self.ops, self.floors = ops, floors
        ops.timeSeries("Constant", 1)
        ops.pattern("Plain", 1, 1)
        # Lagrange: displacements are exact. Penalty leaves a little; others fail where all freedoms are prescribed.
        ops.constraints("Lagrange")
        ops.numberer("Plain")
        ops.system("FullGeneral")
        ops.test("NormDispIncr", 1e-9, 50)
        ops.algorithm("Newton")
        ops.integrator("LoadControl", 0.0)
        ops.analysis("Static", "-noWarnings")

    def initial_stiffness(self, by=1e-6):
        """By small moves to either side, so near to rest that it stays elastic; then it is back at rest."""
        moves = by * np.eye(len(self.floors))
        columns = [np.subtract(self.move(to), self.move(-to)) / (2 * by) for to in moves]
        self.move(np.zeros(len(self.floors)))
        return np.array(columns).T

    def move(self, displacements):
        self.ops.remove("loadPattern", 1)
        self.ops.pattern("Plain", 1, 1)
        for (node, direction), displacement in zip(self.floors, displacements.tolist()):
            self.ops.sp(node, direction, displacement)
        if self.ops.analyze(1) != 0:  # which commits: it is asked once a step
            raise RuntimeError("OpenSees finds no equilibrium")
        self.ops.reactions()
        return [self.ops.nodeReaction(node, direction) for node, direction in self.floors]


class Springs(OpenSees):
    """The storeys as springs in a row."""

    def __init__(self):
        import openseespy.opensees as ops

        ops.wipe()
        ops.model("basic", "-ndm", 1, "-ndf", 1)
        ops.node(0, 0.0)
        ops.fix(0, 1)
        for i, stiffness, strength in zip(FLOORS, STIFFNESS.tolist(), YIELD.tolist()):
            ops.node(i, 0.0)
            ops.uniaxialMaterial("Steel01", i, strength, stiffness, RATIO)
            ops.element("zeroLength", i, i - 1, i, "-mat", i, "-dir", 1)
        super().__init__([(i, 1) for i in FLOORS])


def scene(**left):
    """Frames of four and three storeys, 3 mm apart; `couple` takes the stiffness of the left one from the model."""
    law = {"law": "hertz_damped", "damping_formula": "exact", "stiffness": 2.75e9, "restitution": 0.65}
    right = {"yield_force": [1150e3, 940e3, 540e3], "post_yield_ratio": RATIO, "damping": {"ratio": 0.05}}
    return {
        "name": "Neighbours",
        "stop_time": STOP,
        "left": {"mass": [200e3, 200e3, 200e3, 160e3], "stiffness": STIFFNESS, "damping": {"ratio": 0.05}, **left},
        "right": {"mass": [170e3, 170e3, 130e3], "stiffness": [250e6, 230e6, 170e6], **right},
        "ground": {"record": str(RECORD), "pga": 3.43},
        "contact": [{"left_floor": i, "right_floor": i, "gap": 0.003, **law} for i in (1, 2, 3)],
    }


def inside(step, stop=STOP):
    """The run in which one FMU has it all."""
    return pounding_fmu.simulate(scene(yield_force=YIELD, post_yield_ratio=RATIO), step, stop)


def left_floors(run):
    """m, a row for each step and a column for each floor."""
    return np.column_stack([run[f"left.displacement[{i}]"] for i in FLOORS])


def error(found, whole):
    """Of all left floors over the largest displacement."""
    exact = left_floors(whole)
    return np.abs(found - exact).max() / np.abs(exact).max()


def compare(model):
    """Of each way and step the error, impacts, and the largest base shear, N: inside and coupled."""
    for how in ("held", "line", "twice"):
        for step in STEPS:
            whole, coupled = inside(step), pounding_fmu.couple(scene(), left=model(), step=step, how=how)
            impacts, shears = (
                [run[name][-1] for run in (whole, coupled)] for name in ("impacts", "left.peak_base_shear")
            )
            yield how, step, error(left_floors(coupled), whole), impacts, shears


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--opensees", action="store_true", help="the storeys are OpenSeesPy's")
    model = Springs if parser.parse_args().opensees else Storeys
    print("how     step [ms]      error   impacts (one FMU, coupled)   largest base shear [kN] (likewise)")
    for how, step, off, (one, other), (exact, found) in compare(model):
        impacts, shears = f"{one}, {other}", f"{exact / 1e3:.1f}, {found / 1e3:.1f}"
        print(f"{how:5}   {1e3 * step:9.3f}   {off:.2e}   {impacts:26}   {shears}")
