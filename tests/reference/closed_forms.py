"""Checks the reference solver itself against closed forms of the free impact of two masses.

    python3 tests/reference/closed_forms.py

Needs gcc and Python 3.11. Restitution and peak force do not depend on anything that the solver was tuned with.
"""
import math
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).parent
M1, M2, K, V = 50000.0, 75000.0, 3.0e7, 0.5
M = M1 * M2 / (M1 + M2)

# a of F = k d^n (1 + a v/V) for e = 0.5
DAMPING = {
    "lankarani_nikravesh": 0.5625,
    "ye_printed": 0.5625,
    "ye": 1.6,
    "barros_khatami": 1.6,
    "barros_khatami_damper": 2.4,
    "hunt_crossley": 0.75,
    "herbert_mcwhannell": 1.0,
    "lee_wang": 0.375,
    "gonthier": 1.5,
    "zhiying_qishao": 0.5625 * math.e,
    "gharib_hurmuzlu": 2.0,
    "hu_guo": 1.5,
    "safaeifar_farshidianfar": 1.25,
    "carvalho_martins": 63.0 / 44.0,
}


def restitution(a):
    """e_out of the exact relation a (1 + e) = ln((1 + a)/(1 - a e)), by bisection."""
    low, high = 0.0, min(1.0, 1.0 / a)
    for _ in range(200):
        e = (low + high) / 2
        if a * e < 1 and math.log((1 + a) / (1 - a * e)) < a * (1 + e):
            low = e
        else:
            high = e
    return low


def cases():
    """(law and its keys, quantity, expected value, tolerance)"""
    for e in (0.1, 0.5, 0.65, 0.9):
        yield f"kelvin_voigt stiffness {K} restitution {e}", "restitution", e, 2e-16
        yield f"hertz_damped stiffness {K} restitution {e} damping_formula exact", "restitution", e, 2e-16
        log = math.log(e)
        xi = -log / math.hypot(math.pi, log)
        cut = math.exp(-2 * xi * math.acos(xi) / math.sqrt(1 - xi * xi))
        yield f"kelvin_voigt_no_tension stiffness {K} restitution {e}", "restitution", cut, 1e-15
    for formula, a in DAMPING.items():
        for n in (1.0, 1.3, 1.5, 2.0):
            law = f"hertz_damped stiffness {K} exponent {n} restitution 0.5 damping_formula {formula}"
            yield law, "restitution", restitution(a), 1e-14
    yield f"jankowski stiffness {K} restitution 0.5", "restitution", 0.49459, 5e-6
    yield f"linear stiffness {K}", "restitution", 1.0, 0.0
    yield f"linear stiffness {K}", "peak_force", V * math.sqrt(K * M), 1e-10
    yield f"hertz stiffness {K}", "restitution", 1.0, 0.0
    yield f"hertz stiffness {K}", "peak_force", K**0.4 * (1.25 * M * V * V) ** 0.6, 1e-9
    yield "stereomechanical restitution 0.7", "restitution", 0.7, 2e-16


def impact(program, folder, law):
    scene = f"stop 2\noutput_step 1\nbuilding 1\nmass {M1}\nstiffness 0\nvelocity {V}\n"
    scene += f"building 1\nmass {M2}\nstiffness 0\ncontact 1 1 0.05 {law}\n"
    subprocess.run([program, "-", folder / "free"], input=scene, text=True, check=True, stdout=subprocess.DEVNULL)
    lines = [line for line in (folder / "free.impacts.csv").read_text().splitlines() if not line.startswith("#")]
    if len(lines) != 2:
        raise SystemExit(f"{law}: {len(lines) - 1} impacts instead of 1")
    row = dict(zip(lines[0].split(","), map(float, lines[1].split(","))))
    return {"restitution": row["separation_velocity"] / row["approach_velocity"], **row}


def main():
    failures = count = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        program = folder / "reference"
        sources = sorted(HERE.glob("*.c"))
        subprocess.run(["gcc", "-O2", "-o", program, *sources, "-lquadmath", "-lm"], check=True)
        for law, quantity, expected, tolerance in cases():
            found = impact(program, folder, law)[quantity]
            count += 1
            if not abs(found - expected) <= tolerance:
                failures += 1
                print(f"{law}: {quantity} = {found!r}, expected {expected!r}")
    print(f"{count - failures} of {count} closed forms met")
    return failures > 0


if __name__ == "__main__":
    sys.exit(main())
