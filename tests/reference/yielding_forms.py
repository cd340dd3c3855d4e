"""Closed forms of storeys that yield, for closed_forms.py: (scene, ((file, row, column, expected, tolerance), ...)).

Row -1 is the last one, "rows" instead of a column their number. RECORD stands for the path of a record file, which
follows after a line `---`. All is undamped; dy is the yield drift, p the plastic drift.
"""
import math
from decimal import Decimal, getcontext

getcontext().prec = 60
MASS, K, FORCE = 2.0, 200.0, 4.0
W, DY = 10.0, 0.02
ONE_MASS = f"building 1\nmass {MASS}\nstiffness {K}\nyield_force {FORCE}\n"


def pushed_once():
    """With v0 at the start: yields once, then swings about p with the amplitude dy and only just reaches its limits."""
    v0 = 0.5
    v1 = math.sqrt(v0**2 - (W * DY) ** 2)
    t1 = math.asin(W * DY / v0) / W
    t2, p = t1 + MASS * v1 / FORCE, MASS * v1**2 / (2 * FORCE)
    for sign in (1, -1):
        yield f"stop 30\n{ONE_MASS}velocity {sign * v0}\n", (
            ("yields", 0, "time_s", t1, 1e-16), ("yields", 0, "drift_rate_m_s", sign * v1, 2e-16),
            ("yields", 1, "time_s", t2, 2e-16), ("yields", -1, "rows", 2, 0),
            ("displacements", -1, "left.displacement[1]", sign * (p + DY * math.cos(W * (30 - t2))), 1e-15),
            ("storeys", -1, "left.plastic_drift[1]", sign * p, 1e-16),
            ("storeys", -1, "left.ductility[1]", p / DY + 1, 2e-15),
            ("displacements", -1, "energy.hysteretic", FORCE * p, 2e-16),
        )


def starts_beyond():
    """Displaced beyond its limit as if pushed slowly: the excess is plastic, energies start at 0."""
    p = 0.03
    yield f"stop 3\n{ONE_MASS}displacement {-p - DY}\n", (
        ("displacements", -1, "left.displacement[1]", -p - DY * math.cos(W * 3), 1e-16), ("yields", -1, "rows", 0, 0),
        ("storeys", 0, "left.plastic_drift[1]", -p, 1e-16), ("storeys", 0, "left.ductility[1]", 1 + p / DY, 1e-15),
        ("displacements", 0, "energy.strain", K * DY**2 / 2, 1e-16), ("displacements", -1, "energy.hysteretic", 0, 0),
    )


def step_loads():
    """A force F from `begin` on, as ground acceleration. F < FORCE: its work is what spring and yielding take, so that
    the ductility is 1/(2 (1 - F/FORCE)). F > FORCE: a parabola without end from the yield on."""
    for begin in (0.0, 0.5):
        for share in (0.6, 0.75, 0.875):
            record = f"{begin},{-share * FORCE / MASS}\n100,{-share * FORCE / MASS}"
            yield f"stop 4\nrecord RECORD\n{ONE_MASS}---\n{record}\n", (
                ("storeys", -1, "left.ductility[1]", 1 / (2 * (1 - share)), 2e-15), ("yields", -1, "rows", 2, 0),
            )
        load = 1.5 * FORCE
        t1 = math.acos(1 - FORCE / load) / W
        v1, t = load / K * W * math.sin(W * t1), 5 - t1
        u = DY + v1 * t + (load - FORCE) / MASS * t * t / 2
        record = f"{begin},{-load / MASS}\n100,{-load / MASS}"
        yield f"stop {5 + begin}\nrecord RECORD\n{ONE_MASS}---\n{record}\n", (
            ("displacements", -1, "left.displacement[1]", u, 1e-14), ("storeys", -1, "left.yielding[1]", 1, 0),
            ("storeys", -1, "left.storey_shear[1]", FORCE, 0),
        )


def shakedown(ratio, v0):
    """q of q'' = -w^2 (ratio q + (1 - ratio) z), yield at dq = 1: p after each plastic step, in 60 digits.

    From a turn at q = p + s to the yield at p - s on the other side, the elastic force gives v^2 = 4 ratio w^2 s p: it
    yields again only where s p > 0. With ratio 1/2 every p is about the square of the one before."""
    r, s = Decimal(ratio), 1
    p, kinetic = Decimal(0), (Decimal(v0) ** 2 - 1) / 2
    while kinetic > Decimal("1e-30"):
        resists = 1 + r * s * p  # the force where it yields; the step x obeys r x^2/2 + resists x = kinetic
        p += s * ((resists**2 + 2 * r * kinetic).sqrt() - resists) / r
        yield p
        kinetic, s = 2 * r * s * p, -s


def words(values):
    return " ".join(map(repr, values))


def all_at_once():
    """Three storeys in mode 1, whose drifts and yield drifts are in the same proportion (4 : 2 : 1): all switch at once
    and move as one bilinear oscillator. All numbers are exact; w = 8, the unit of q is 2^-10 of phi."""
    masses, phi, drifts, w, unit = (3.0, 5.0, 2.0), (4.0, 6.0, 7.0), (4.0, 2.0, 1.0), 8.0, 2.0**-10
    k = [w * w * sum(masses[j] * phi[j] for j in range(i, 3)) / drifts[i] for i in range(3)]
    forces = [k[i] * drifts[i] * unit for i in range(3)]
    for ratio, v0 in ((0.5, 2.0), (0.5, 5.0), (0.125, 4.0)):
        scene = f"stop 6\nbuilding 3\nmass {words(masses)}\nstiffness {words(k)}\nyield_force {words(forces)}\n"
        scene += f"post_yield_ratio {words([ratio] * 3)}\nvelocity {words(x * unit * w * v0 for x in phi)}\n"
        v1, soft = math.sqrt(v0**2 - 1), math.sqrt(ratio)  # in units of w
        times = [math.asin(1 / v0) / w]
        times.append(times[0] + math.atan(v1 * soft) / soft / w)
        steps = list(shakedown(ratio, v0))
        checks = [("yields", -1, "rows", 6 * len(steps), 0)]
        checks += [("yields", 3 * n + i, "time_s", times[n], 3e-16) for n in range(2) for i in range(3)]
        for n, p in enumerate(steps):
            total = sum(Decimal(drifts[i]) for i in range(3)) * Decimal(unit) * p
            checks.append(("yields", slice(6 * n + 3, 6 * n + 6), "plastic_drift_m", total, Decimal("1e-26")))
        yield scene, checks


def unloaded_by_impulse():
    """A mass that yields hits a wall at g > dy and goes back with e times its speed: elastic at once, z = dy. The other
    limit is reached with the same speed, after (pi - 2 phi)/w, tan(phi) = e v/(w dy)."""
    v0, g, e = 0.5, 0.05, 0.6
    v1 = math.sqrt(v0**2 - (W * DY) ** 2)
    v = math.sqrt(v1**2 - 2 * FORCE / MASS * (g - DY))
    t1 = math.asin(W * DY / v0) / W + (v1 - v) * MASS / FORCE
    t2 = t1 + (math.pi - 2 * math.atan(e * v / (W * DY))) / W
    yield f"stop 0.5\n{ONE_MASS}velocity {v0}\ncontact 1 wall {g} stereomechanical restitution {e}\n", (
        ("impacts", 0, "start_s", t1, 2e-16), ("yields", 1, "time_s", t1, 2e-16), ("yields", 1, "drift_m", g, 1e-16),
        ("yields", 1, "drift_rate_m_s", -e * v, 3e-16), ("yields", 2, "time_s", t2, 3e-16),
        ("yields", 2, "drift_rate_m_s", -e * v, 5e-16), ("yields", 2, "plastic_drift_m", g - DY, 1e-16),
    )


def held_while_yielding():
    """m1 on k1, at its limit, and m2 on an elastic k2 move together from the start. Yielding: M u'' = -k2 u - FORCE up
    to the turn at u2, where the reaction (m1 k2 u - m2 V)/M is largest; elastic from there, V = FORCE + k1 (u - u2),
    until the reaction is 0."""
    m1, m2, k1, k2, v0 = 2.0, 3.0, 50.0, 700.0, 0.4
    u0 = FORCE / k1
    M, centre = m1 + m2, -FORCE / k2
    w = math.sqrt(k2 / M)
    t2 = math.atan(v0 / (w * (u0 - centre))) / w
    u2 = centre + math.hypot(u0 - centre, v0 / w)
    peak = (m1 * k2 * u2 - m2 * FORCE) / M
    w, centre = math.sqrt((k1 + k2) / M), (k1 * u2 - FORCE) / (k1 + k2)
    u3 = m2 * (FORCE - k1 * u2) / (m1 * k2 - m2 * k1)
    end = t2 + math.acos((u3 - centre) / (u2 - centre)) / w
    together = f"displacement {u0}\nvelocity {v0}\n"
    yield (
        f"stop 0.4\nbuilding 1\nmass {m1}\nstiffness {k1}\nyield_force {FORCE}\n{together}building 1\nmass {m2}\n"
        f"stiffness {k2}\n{together}contact 1 1 0 stereomechanical restitution 0.5\n"
    ), (
        ("yields", 0, "time_s", 0, 1e-16), ("yields", 1, "time_s", t2, 1e-16), ("yields", 1, "drift_m", u2, 1e-16),
        ("impacts", 0, "start_s", 0, 0), ("impacts", 0, "peak_force", peak, 2e-14), ("impacts", 0, "end_s", end, 2e-16),
    )



def leaning():
    """A weight takes theta = 1/4 of the stiffness and leaves -1/3 of the rest after yield. With less than the speed kappa D
    when it yields it turns and swings about (1 + 1/3) p; with more it falls, by exponentials, to 1 m."""
    theta, height, softening = 0.25, 2.0, 1 / 3
    w, reach = W * math.sqrt(1 - theta), DY / softening
    kappa, critical = w * math.sqrt(softening), DY + reach
    for share in (0.6, 1.25):
        v1 = share * kappa * reach
        v0 = math.hypot(v1, w * DY)
        t1 = math.asin(w * DY / v0) / w
        scene = (
            f"stop 3\nbuilding 1\nmass {MASS}\nstiffness {K}\nyield_force {FORCE}\ngravity_load {theta * K * height}\n"
            f"lean {height}\ncollapse_drift_ratio {1 / height}\nvelocity {v0}\n"
        )
        if share < 1:
            left = math.sqrt((1 - share) * (1 + share))
            t2, p = t1 + math.atanh(share) / kappa, reach * (1 - left)
            u = (1 + softening) * p + DY * left * math.cos(w * (3 - t2))
            yield scene, (
                ("yields", 0, "time_s", t1, 1e-16), ("yields", 1, "time_s", t2, 3e-16), ("yields", -1, "rows", 2, 0),
                ("storeys", -1, "left.plastic_drift[1]", p, 1e-16), ("displacements", -1, "left.displacement[1]", u, 2e-16),
                ("displacements", -1, "energy.gravity", -theta * K * u * u / 2, 1e-15),
            )
            continue
        y, grows, fades = 1 - critical, (v1 / kappa - reach) / 2, -(v1 / kappa + reach) / 2
        up = (y + math.sqrt(y * y - 4 * grows * fades)) / 2
        t2 = t1 + math.log(up / grows) / kappa
        yield scene, (
            ("yields", 0, "time_s", t1, 1e-16), ("yields", 1, "time_s", t2, 1e-15), ("yields", -1, "rows", 2, 0),
            ("yields", 1, "drift_m", 1, 1e-16), ("yields", 1, "drift_rate_m_s", kappa * (up - grows * fades / up), 2e-15),
            ("displacements", -1, "energy.gravity", -theta * K / 2, 1e-15),
        )


FAMILIES = (pushed_once, starts_beyond, step_loads, all_at_once, unloaded_by_impulse, held_while_yielding, leaning)
