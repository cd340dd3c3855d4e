"""OpenSeesPy: masses, springs with dashpots, storeys that yield (Steel01), impact materials in zero-length elements;
Newmark, fixed step; where the iteration fails, ten smaller steps, as scripts do.

Optional: its licence forbids commercial use without agreement, and the project does not depend on it.
"""

import ctypes
import importlib.util
import os
import time
from pathlib import Path

import numpy as np

from . import OUTPUT_STEP, Outcome

WITHOUT = {
    "kelvin_voigt_no_tension": "no material that is just this law",
    "stereomechanical": "no such material",
}


def load():
    """The module; where it does not find the libraries that its own wheel brings, they are loaded first."""
    try:
        import openseespy.opensees as ops
    except (ImportError, RuntimeError):
        wheel = importlib.util.find_spec("openseespylinux")
        if wheel is None:
            raise
        # The module's search path ($ORIGIN/lib) holds for what it needs itself, not for what its libraries need in
        # their turn: these two. Those of a system could want another libgfortran than the wheel's.
        for library in ["libquadmath.so.0", "libblas.so.3"]:
            ctypes.CDLL(str(Path(wheel.origin).parent / "lib" / library))
        import openseespy.opensees as ops
    return ops


class Solver:
    def __init__(self, problem, ground, ops, step):
        self.problem, self.ground, self.ops, self.step, self.setup = problem, ground, ops, step, 0.0

    def build(self):
        ops, problem = self.ops, self.problem
        mass, K, C = problem.matrices
        n = len(mass)
        ops.wipe()
        ops.logFile(os.devnull, "-noEcho")
        ops.model("basic", "-ndm", 1, "-ndf", 1)
        ops.node(1000, 0.0)
        ops.fix(1000, 1)
        for i in range(n):
            ops.node(i + 1, 0.0)
            ops.mass(i + 1, float(mass[i]))
        tag = 0
        # Any K and C are springs with dashpots between each two floors, and from each floor to the ground.
        links = [(i + 1, 1000, K[i].sum(), C[i].sum()) for i in range(n)]
        links += [(i + 1, j + 1, -K[i, j], -C[i, j]) for i in range(n) for j in range(i)]
        yielding = {(s.upper + 1, 1000 if s.lower is None else s.lower + 1): s for s in problem.yielding_storeys}
        for one, other, k, c in links:
            if storey := yielding.get((one, other)):
                tag += 1
                ops.uniaxialMaterial("Steel01", tag, storey.yield_force, storey.stiffness, storey.post_yield_ratio)
                ops.element("zeroLength", tag, one, other, "-mat", tag, "-dir", 1, "-doRayleigh", 0)
                k = 0.0
            if k != 0.0 or c != 0.0:
                tag += 1
                ops.uniaxialMaterial("Elastic", tag, float(k), float(c))
                ops.element("zeroLength", tag, one, other, "-mat", tag, "-dir", 1, "-doRayleigh", 0)
        for contact in problem.contacts:
            tag += 1
            self.material(contact, tag)
            # In compression where the left floor moves towards the right one.
            left, right = contact.floor + 1, problem.floors[0] + contact.floor + 1
            ops.element("zeroLength", tag, left, right, "-mat", tag, "-dir", 1)
        times, accelerations = self.ground
        ops.timeSeries("Path", 1, "-dt", float(times[1] - times[0]), "-values", *accelerations.tolist())
        ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
        ops.constraints("Plain")
        ops.numberer("Plain")
        ops.system("BandGeneral" if n > 2 else "FullGeneral")
        ops.test("NormDispIncr", 1e-12, 50)
        ops.algorithm("KrylovNewton")
        ops.integrator("Newmark", 0.5, 0.25)
        ops.analysis("Transient")

    def material(self, contact, tag):
        ops, law, gap = self.ops, contact.law, -contact.gap
        if law == "linear":
            ops.uniaxialMaterial("ElasticPPGap", tag, contact.stiffness, -1e30, gap)
        elif law == "kelvin_voigt":
            ops.uniaxialMaterial("ViscoelasticGap", tag, contact.stiffness, contact.damping, gap)
        elif law == "hertz":
            # Without dissipation: restitution 1.
            ops.uniaxialMaterial("Hertzdamp", tag, contact.stiffness, 0.0, gap, contact.exponent)
        elif law == "hertz_damped":
            ops.uniaxialMaterial("Hertzdamp", tag, contact.stiffness, contact.relative_damping, gap, contact.exponent)
        elif law == "jankowski":
            xi = contact.damping / (2.0 * np.sqrt(contact.stiffness * contact.mass))
            ops.uniaxialMaterial("JankowskiImpact", tag, contact.stiffness, xi, contact.mass, gap, contact.exponent)

    def run(self, warm_up=False):
        self.build()
        ops, n = self.ops, len(self.problem.matrices[0])
        per_row, rows = round(OUTPUT_STEP / self.step), round(self.problem.stop / OUTPUT_STEP)
        displacements = np.zeros((rows + 1, n))
        start = time.perf_counter()
        for row in range(1, rows + 1):
            for _ in range(per_row):
                if ops.analyze(1, self.step) != 0 and ops.analyze(10, self.step / 10.0) != 0:
                    raise RuntimeError(f"the iteration did not converge at {ops.getTime():.3f} s")
            displacements[row] = [ops.nodeDisp(i + 1, 1) for i in range(n)]
        return Outcome(time.perf_counter() - start, displacements, None)
