"""Closed forms of rows of masses, for closed_forms.py, as in yielding_forms.py: stereomechanical impacts of three."""
import math

SPEED, GAP = 0.5, 0.01


def masses(values, stiffness, velocities):
    parts = zip("abc", values, velocities, strict=True)
    return "".join(f"building 1 {n}\nmass {m}\nstiffness {stiffness * m!r}\nvelocity {v}\n" for n, m, v in parts)


def contacts(gaps, e):
    ends = zip(("a:1 b:1", "b:1 c:1"), gaps, strict=True)
    return "".join(f"contact {places} {gap} stereomechanical restitution {e}\n" for places, gap in ends)


def velocities(expected, tolerance):
    return [("displacements", -1, f"{n}.velocity[1]", v, tolerance) for n, v in zip("abc", expected, strict=True)]


def one_after_the_other():
    """Free masses, and a cradle of equal oscillators: each hands on what it has at the gap."""
    m_1, m_2, m_3, e = 2.0, 3.0, 1.25, 0.6
    first = SPEED * (1 + e) * m_1 / (m_1 + m_2)
    after = (SPEED - first * m_2 / m_1, first * (m_2 - e * m_3) / (m_2 + m_3), first * (1 + e) * m_2 / (m_2 + m_3))
    text = masses((m_1, m_2, m_3), 0.0, (SPEED, 0, 0)) + contacts((GAP, GAP), e)
    yield f"stop 0.07\n{text}", [("impacts", None, "rows", 2, 0), *velocities(after, 2e-16)]
    w = 9.0
    handed_on = SPEED * math.sqrt(1 - (w * GAP / SPEED) ** 2)
    twice = math.sqrt(handed_on**2 - (w * GAP) ** 2)
    times = [math.asin(w * GAP / speed) / w for speed in (SPEED, handed_on)]
    text = masses((2.0, 2.0, 2.0), w * w, (SPEED, 0, 0)) + contacts((GAP, GAP), 1)
    yield f"stop 0.06\n{text}", (
        ("impacts", 0, "start_s", times[0], 1e-17), ("impacts", 1, "start_s", sum(times), 2e-17),
        ("impacts", 0, "approach_velocity", handed_on, 2e-16), ("impacts", 1, "approach_velocity", twice, 2e-16),
        ("impacts", 1, "separation_velocity", twice, 2e-16),
    )


def all_at_once():
    """Masses that touch share an impulse by one rule; two that come from both sides leave the one between them at rest."""
    for e in (0.0, 0.4, 1.0):
        share = SPEED * (1 + e) / 3
        touching = masses((2.0, 2.0, 2.0), 0.0, (SPEED, 0, 0)) + contacts((GAP, 0.0), e)
        squeezed = masses((2.0, 3.0, 2.0), 0.0, (SPEED, 0, -SPEED)) + contacts((GAP, GAP), e)
        after = {touching: (SPEED - 2 * share, share, share), squeezed: (-e * SPEED, 0, e * SPEED)}
        for text, expected in after.items():
            yield f"stop 0.03\n{text}", [("impacts", None, "rows", 2, 0), *velocities(expected, 2e-16)]


FAMILIES = (one_after_the_other, all_at_once)
