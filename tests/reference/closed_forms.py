"""Checks the reference solver itself against closed forms: free impacts of two masses, of a mass with columns and with
a wall, stereomechanical contact of two oscillators, impacts of three masses at once, storeys that yield, linked
oscillators, buildings on soil, rows of three masses.

    python3 tests/reference/closed_forms.py

Needs gcc and Python 3.11. Restitution and peak force do not depend on anything that the solver was tuned with.
"""
import math
import pathlib
import subprocess
import sys
import tempfile
from decimal import Decimal

import link_forms
import row_forms
import soil_forms
import yielding_forms

FAMILIES = yielding_forms.FAMILIES + link_forms.FAMILIES + soil_forms.FAMILIES + row_forms.FAMILIES
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


def pressed_pairs():
    """(lines of the scene, expected (quantity of the last episode, value, tolerance)...)

    Bounces: two oscillators of one frequency w, whose distance r obeys r'' = -w^2 r, with a gap of -g: each rebound
    r = -g cos(w t) - (v/w) sin(w t) is back at -g after (2/w) atan(v/(w g)), as fast as it left.

    Held together: m1 and m2 on springs k1, k2 swing as one with W^2 = (k1 + k2)/(m1 + m2); the reaction is
    m (k2/m2 - k1/m1) u, u = u0 cos(W t), and ends where u passes 0.
    """
    w, g, e, speed, m = 3.0, 0.02, 0.4, 0.3, 6.0 / 5.0
    end = sum(2 / w * math.atan(e**j * speed / (w * g)) for j in range(1, 60))
    yield (
        f"stop 3\nbuilding 1\nmass 2\nstiffness {2 * w * w}\ndisplacement {-g}\nvelocity {speed}\n"
        f"building 1\nmass 3\nstiffness {3 * w * w}\ncontact 1 1 {-g} stereomechanical restitution {e}\n",
        (("start_s", end, 1e-15), ("peak_force", m * w * w * g, 1e-15), ("approach_velocity", 0.0, 0.0)),
    )
    k1, k2, u0 = 50.0, 700.0, 0.03
    frequency, rate = math.sqrt((k1 + k2) / 5.0), m * (k2 / 3.0 - k1 / 2.0)
    for law in ("restitution 0", "restitution 0.7", "restitution 1"):
        yield (
            f"stop 0.2\nbuilding 1\nmass 2\nstiffness {k1}\ndisplacement {u0}\n"
            f"building 1\nmass 3\nstiffness {k2}\ndisplacement {u0}\ncontact 1 1 0 stereomechanical {law}\n",
            (("start_s", 0.0, 0.0), ("end_s", math.pi / 2 / frequency, 1e-15), ("peak_force", rate * u0, 1e-14),
             ("impulse", rate * u0 / frequency, 1e-15), ("separation_velocity", 0.0, 0.0)),
        )


def columns_and_walls(m1, below, above):
    """(places of a contact, reduced mass): a mass meets the columns of a storey, or a wall."""
    for s, shape, storey in ((0.3, "fixed", 1), (0.3, "fixed", 2), (0.8, "straight", 1), (0.65, "straight", 2)):
        N = s if shape == "straight" else 3 * s**2 - 2 * s**3
        lower = (1 - N) ** 2 / below if storey == 2 else 0.0
        yield f"1 columns:{storey}:{s}:{shape}", 1 / (1 / m1 + lower + N * N / (above if storey == 2 else below))
    yield "1 wall", m1


def impacts_of_rows():
    """All masses are free: as if two met of which m is the reduced mass."""
    m1, below, above, speed, e, k = 5.0, 3.0, 2.0, 0.5, 0.6, 2.0e5
    head = f"stop 2\nbuilding 1\nmass {m1}\nstiffness 0\nvelocity {speed}\n"
    head += f"building 2\nmass {below} {above}\nstiffness 0 0\n"
    for places, m in columns_and_walls(m1, below, above):
        both = (("start_s", 0.02, 1e-17), ("approach_velocity", speed, 1e-16))
        parting = ("separation_velocity", e * speed, 2e-16)
        impulse = ("impulse", (1 + e) * m * speed, 4e-16 * m)
        loss = ("dissipated_energy", m * (1 - e * e) * speed**2 / 2, 4e-16 * m)
        returned = (*both, parting, impulse, loss)
        yield head + f"contact {places} 0.01 stereomechanical restitution {e}\n", returned
        yield head + f"contact {places} 0.01 kelvin_voigt stiffness {k} restitution {e}\n", returned
        peak = ("peak_force", speed * math.sqrt(k * m), 1e-12)
        yield head + f"contact {places} 0.01 linear stiffness {k}\n", (*both, peak)


def impacts_at_once():
    """Contacts that share a floor and meet at once: w = V' + e V <= 0 for each, complementary to its impulse."""
    l, r1, r2, v, e1, e2 = 5.0, 2.0, 3.0, 0.7, 0.2, 0.9
    after = (l * v - r1 * e1 * v - r2 * e2 * v) / (l + r1 + r2)
    buildings = f"stop 0.1\nbuilding 1\nmass {l}\nstiffness 0\nvelocity {v}\n"
    buildings += f"building 2\nmass {r1} {r2}\nstiffness 0 0\n"
    law = "0.01 stereomechanical restitution"
    yield (
        buildings + f"contact 1 1 {law} {e1}\ncontact 1 2 {law} {e2}\n",
        (("contact", 2, 0.0), ("impulse", r2 * (after + e2 * v), 1e-15)),
    )
    # L rests against a wall and is hit by R: it stays where it is, and the wall takes what R gives.
    buildings = f"stop 0.1\nbuilding 1\nmass {l}\nstiffness 0\nbuilding 1\nmass {r1}\nstiffness 0\nvelocity {-v}\n"
    hit, rests = f"contact 1 1 {law} {e2}\n", "contact wall left:1 0 stereomechanical restitution 0.3\n"
    impulse = ("impulse", (1 + e2) * r1 * v, 1e-15)
    yield buildings + hit + rests, (("contact", 2, 0.0), impulse, ("separation_velocity", 0.0, 1e-30))
    yield buildings + rests + hit, (("contact", 2, 0.0), impulse, ("separation_velocity", e2 * v, 2e-16))


def held_by_columns():
    """A mass m on a spring k1 rests against the columns of a first storey k2 with a mass M, u = N w: w'' = -W^2 w with
    W^2 = (k2 + N^2 k1) / (M + N^2 m). The reaction is N (m W^2 - k1) w, w = w0 cos(W t), and ends where w passes 0."""
    m, M, k1, k2, N, w0 = 2.0, 3.0, 50.0, 700.0, 0.75, 0.0625
    frequency = math.sqrt((k2 + N * N * k1) / (M + N * N * m))
    peak = N * (m * frequency**2 - k1) * w0
    yield (
        f"stop 0.2\nbuilding 1\nmass {m}\nstiffness {k1}\ndisplacement {N * w0}\n"
        f"building 1\nmass {M}\nstiffness {k2}\ndisplacement {w0}\n"
        f"contact 1 columns:1:{N}:straight 0 stereomechanical restitution 0.5\n",
        (("start_s", 0.0, 0.0), ("end_s", math.pi / 2 / frequency, 1e-15), ("peak_force", peak, 4e-15),
         ("impulse", peak / frequency, 1e-15)),
    )


def run(program, folder, scene):
    scene, _, record = scene.partition("---\n")
    (folder / "record.csv").write_text(record)
    scene = "output_step 1\n" + scene.replace("RECORD", str(folder / "record.csv"))
    subprocess.run([program, "-", folder / "case"], input=scene, text=True, check=True, stdout=subprocess.DEVNULL)


def table(folder, name):
    """The rows of a file, as text by column."""
    lines = [line for line in (folder / f"case.{name}.csv").read_text().splitlines() if not line.startswith("#")]
    return [dict(zip(lines[0].split(","), line.split(","))) for line in lines[1:]]


def episodes(program, folder, scene):
    run(program, folder, scene)
    return [{key: float(x or "nan") for key, x in row.items()} for row in table(folder, "impacts")]


def from_tables(program, folder, scene, checks):
    """(scene, quantity, expected, tolerance, values by quantity) for checks of yielding_forms, link_forms and soil_forms."""
    run(program, folder, scene)
    tables = {name: table(folder, name) for name, *_ in checks}
    for name, at, column, expected, tolerance in checks:
        if column == "rows":
            found = len(tables[name])
        elif isinstance(at, slice):
            found = sum(Decimal(row[column]) for row in tables[name][at])
        else:
            found = float(tables[name][at][column])
        yield scene, column, expected, tolerance, {column: found}


def impact(program, folder, law):
    scene = f"stop 2\nbuilding 1\nmass {M1}\nstiffness 0\nvelocity {V}\n"
    scene += f"building 1\nmass {M2}\nstiffness 0\ncontact 1 1 0.05 {law}\n"
    rows = episodes(program, folder, scene)
    if len(rows) != 1:
        raise SystemExit(f"{law}: {len(rows)} impacts instead of 1")
    return {"restitution": rows[0]["separation_velocity"] / rows[0]["approach_velocity"], **rows[0]}


def main():
    failures = count = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        program = folder / "reference"
        sources = sorted(HERE.glob("*.c"))
        subprocess.run(["gcc", "-O2", "-o", program, *sources, "-lquadmath", "-lm"], check=True)
        checks = [(law, *case, impact(program, folder, law)) for law, *case in cases()]
        scenes = (pressed_pairs, impacts_of_rows, impacts_at_once, held_by_columns)
        for scene, expected in (case for some in scenes for case in some()):
            rows = episodes(program, folder, scene)
            checks += [(scene, *case, rows[-1]) for case in expected]
        for scene, expected in (case for family in FAMILIES for case in family()):
            checks += from_tables(program, folder, scene, expected)
        for law, quantity, expected, tolerance, row in checks:
            found = row[quantity]
            count += 1
            if not abs(found - expected) <= tolerance:
                failures += 1
                print(f"{law}: {quantity} = {found!r}, expected {expected!r}")
    print(f"{count - failures} of {count} closed forms met")
    return failures > 0


if __name__ == "__main__":
    sys.exit(main())
