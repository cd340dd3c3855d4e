"""Closed forms of links between two equal oscillators, for closed_forms.py, as in yielding_forms.py. The oscillators move
against each other, so that each is one mass on its own spring and twice that of the link; all is undamped but the dashpot.
"""
import math

MASS, K, LINK, SPEED = 2.0, 200.0, 312.5, 0.5
PAIR = "".join(f"building 1\nmass {MASS}\nstiffness {K}\nvelocity {sign * SPEED}\n" for sign in (1, -1))


def spring_and_dashpot():
    """w^2 = (k + 2 k_l) / m and a decay of c_l / m."""
    for dashpot in (0.0, 3.0):
        decay = dashpot / MASS
        w = math.sqrt((K + 2 * LINK) / MASS - decay**2)
        at = SPEED / w * math.exp(-decay * 3) * math.sin(w * 3)
        yield f"stop 3\n{PAIR}link 1 1 stiffness {LINK} dashpot {dashpot}\n", (
            ("displacements", -1, "left.displacement[1]", at, 5e-15),
            ("displacements", -1, "right.displacement[1]", -at, 5e-15),
        )


def friction_damper():
    """The first slip is at asin(w x / v) / w with x = V / (2 k_l), half of what stretches the spring to its limit."""
    force = 5.0
    w, x = math.sqrt((K + 2 * LINK) / MASS), force / (2 * LINK)
    first = math.asin(w * x / SPEED) / w
    slow, speed = math.sqrt(K / MASS), math.sqrt(SPEED**2 - (w * x) ** 2)
    # While it slips each mass swings about -V / k.
    turn = first + math.atan(speed / (slow * (x + force / K))) / slow
    yield f"stop 1\n{PAIR}link 1 1 stiffness {LINK} slip_force {force}\n", (
        ("yields", 0, "time_s", first, 1e-15), ("yields", 1, "time_s", turn, 1e-15),
        ("yields", 0, "drift_m", 2 * x, 1e-15),
        ("yields", 1, "drift_m", 2 * (math.hypot(x + force / K, speed / slow) - force / K), 1e-14),
    )


FAMILIES = (spring_and_dashpot, friction_damper)
