"""A building that another program has, beside one that is ours: its storeys are OpenSeesPy's, all collisions are exact.

    "$(ci/environment)" examples/couple_opensees.py

The left building is asked for its restoring forces at each step, by `pounding_fmu.couple`. Here its storeys are bilinear, so that
one FMU can have the whole problem as well (`yield_force`), and errors can be seen. With `--opensees` they are Steel01 of
OpenSeesPy (`pip install openseespy`; its licence is not free for all uses); without it `Storeys`, which says the same in a few lines.
"""

import argparse

import numpy as np
import pounding_fmu

STIFFNESS, YIELD, RATIO = np.array([200e6, 190e6, 160e6, 110e6]), np.array([1490e3, 1330e3, 1010e3, 530e3]), 0.05  # N/m, N
STOP, STEPS = 20.0, [0.01, 0.005, 0.0025, 0.00125]  # s


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
    """Any model of OpenSeesPy, here springs in a row: floors are moved to where they are to be, and hold with their reactions."""

    def __init__(self):
        import openseespy.opensees as ops

        self.ops, self.floors = ops, [(i, 1) for i in range(1, len(STIFFNESS) + 1)]  # node and direction, lowest first
        ops.wipe()
        ops.model("basic", "-ndm", 1, "-ndf", 1)
        ops.node(0, 0.0)
        ops.fix(0, 1)
        for i, (stiffness, strength) in enumerate(zip(STIFFNESS.tolist(), YIELD.tolist()), 1):
            ops.node(i, 0.0)
            ops.uniaxialMaterial("Steel01", i, strength, stiffness, RATIO)
            ops.element("zeroLength", i, i - 1, i, "-mat", i, "-dir", 1)
        ops.timeSeries("Constant", 1)
        ops.pattern("Plain", 1, 1)
        # Lagrange: displacements are exact. Penalty leaves a little; others fail where all freedoms are prescribed.
        ops.constraints("Lagrange")
        ops.numberer("Plain")
        ops.system("FullGeneral")
        ops.test("NormDispIncr", 1e-12, 50)
        ops.algorithm("Newton")
        ops.integrator("LoadControl", 0.0)
        ops.analysis("Static", "-noWarnings")

    def initial_stiffness(self):
        return STIFFNESS

    def move(self, displacements):
        self.ops.remove("loadPattern", 1)
        self.ops.pattern("Plain", 1, 1)
        for (node, direction), displacement in zip(self.floors, displacements.tolist()):
            self.ops.sp(node, direction, displacement)
        if self.ops.analyze(1) != 0:  # which commits: it is asked once a step
            raise RuntimeError("OpenSees finds no equilibrium")
        self.ops.reactions()
        return [self.ops.nodeReaction(node, direction) for node, direction in self.floors]


def scene(**left):
    """Frames of four and three storeys, 3 mm apart; `couple` takes the stiffness of the left one from the model."""
    contact = {"gap": 0.003, "law": "hertz_damped", "damping_formula": "exact", "stiffness": 2.75e9, "restitution": 0.65}
    right = {"yield_force": [1150e3, 940e3, 540e3], "post_yield_ratio": RATIO, "damping": {"ratio": 0.05}}
    return {
        "name": "Neighbours",
        "stop_time": STOP,
        "left": {"mass": [200e3, 200e3, 200e3, 160e3], "stiffness": STIFFNESS, "damping": {"ratio": 0.05}, **left},
        "right": {"mass": [170e3, 170e3, 130e3], "stiffness": [250e6, 230e6, 170e6], **right},
        "ground": {"record": str(pounding_fmu.example_scene.parent.parent / "records/el_centro_1940_ns.csv"), "pga": 3.43},
        "contact": [{"left_floor": i, "right_floor": i, **contact} for i in (1, 2, 3)],
    }


def compare(model):
    """Of each way and step the error of all left floors over the largest displacement, impacts, and the largest base shear."""
    names = [f"left.displacement[{i}]" for i in (1, 2, 3, 4)]
    for how in ("held", "line", "twice"):
        for step in STEPS:
            whole = pounding_fmu.simulate(scene(yield_force=YIELD, post_yield_ratio=RATIO), step)
            coupled = pounding_fmu.couple(scene(), left=model(), step=step, how=how)
            exact, found = (np.column_stack([run[name] for name in names]) for run in (whole, coupled))
            error = np.abs(found - exact).max() / np.abs(exact).max()
            shears = [run["left.peak_base_shear"][-1] for run in (whole, coupled)]
            yield how, step, error, whole["impacts"][-1], coupled["impacts"][-1], *shears


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--opensees", action="store_true", help="the storeys are OpenSeesPy's")
    model = OpenSees if parser.parse_args().opensees else Storeys
    print("how     step [ms]      error   impacts (one FMU, coupled)   largest base shear [kN] (likewise)")
    for how, step, error, inside, outside, exact, found in compare(model):
        print(f"{how:5}   {1e3 * step:9.3f}   {error:.2e}   {f'{inside}, {outside}':26}   {exact / 1e3:.1f}, {found / 1e3:.1f}")
