"""Closed forms of buildings on soil, for closed_forms.py, as in yielding_forms.py. They are worked out in displacements
relative to the ground, with a mass matrix that is diagonal; the solver's are relative to the foundation.
"""
import math

M, K, H = 2.0, 312.5, 3.0
M_0, I_0 = 1.25, 4.0
K_H, K_R = 1250.0, 9000.0
GRAVITY = 9.80665


def two_modes(masses, stiffness, coupling, start, beta):
    """(x, y) after 3 s of two masses, at rest in (start, 0) at first, from K = ((stiffness[0], coupling), (coupling,
    stiffness[1])) and C = beta K."""
    a, b, c = stiffness[0] / masses[0], stiffness[1] / masses[1], coupling * coupling / (masses[0] * masses[1])
    root = math.sqrt((a - b) ** 2 + 4 * c)
    squares = [(a + b + sign * root) / 2 for sign in (-1, 1)]
    # Of y in each mode, over x.
    first, second = [(masses[0] * square - stiffness[0]) / coupling for square in squares]
    slow, fast = [start * released(square, beta * square / 2, 3) / (second - first) for square in squares]
    return second * slow - first * fast, first * second * (slow - fast)


def released(square, decay, time):
    w = math.sqrt(square - decay * decay)
    return math.exp(-decay * time) * (math.cos(w * time) + decay / w * math.sin(w * time))


def one_way():
    """A storey on a foundation that sways alone, or rocks alone; and two that push on each other through the soil while
    they move against each other. All dashpots are beta times their springs."""
    link = 200.0
    for beta in (0.0, 0.004):
        storey = f"building 1\nmass {M}\nstiffness {K}\ndamping dashpots {beta * K!r}\nheight {H}\n"
        swaying = f"{storey}sway {M_0} {K_H} {beta * K_H!r}\n"
        u, u_0 = two_modes((M, M_0), (K, K + K_H), -K, 0.02, beta)
        yield f"stop 3\n{swaying}displacement 0.02\n", (
            ("displacements", -1, "left.displacement[1]", u, 1e-16),
            ("displacements", -1, "left.foundation.displacement", u_0, 1e-16),
        )
        u, phi = two_modes((M, I_0), (K, K * H * H + K_R), -K * H, 0.02, beta)
        yield f"stop 3\n{storey}rocking {I_0} {K_R} {beta * K_R!r}\ndisplacement 0.02\n", (
            ("displacements", -1, "left.displacement[1]", u, 1e-16),
            ("displacements", -1, "left.foundation.rotation", phi, 1e-16),
        )
        u, u_0 = two_modes((M, M_0), (K, K + K_H + 2 * link), -K, 0.02, beta)
        yield (
            f"stop 3\n{swaying}displacement 0.02\n{swaying}displacement -0.02\n"
            f"link 0 0 stiffness {link} dashpot {beta * link!r}\n",
            (("displacements", -1, "left.displacement[1]", u, 1e-16),
             ("displacements", -1, "right.foundation.displacement", -u_0, 1e-16)),
        )


def at_rest_under_a_steady_force():
    """The ground begins to accelerate by a: what stands on it comes to rest by -F (1/k + 1/k_h + h^2/k_r), and half of the
    work done becomes heat, here in the soil alone. A weight P that leans adds to the force what P times the lean / h is."""
    a = 0.5
    force, pulled = M * a, (M + M_0) * a
    strain = (force**2 / K + pulled**2 / K_H + (force * H) ** 2 / K_R) / 2
    tail = f"sway {M_0} {K_H} 25\nrocking {I_0} {K_R} 400\n---\n0,{a}\n1000,{a}\n"
    head = f"stop 80\nrecord RECORD\nbuilding 1\nmass {M}\nstiffness {K}\nheight {H}\n"
    u = force * (1 / K + H * H / K_R) + pulled / K_H
    yield head + tail, (
        ("displacements", -1, "left.displacement[1]", -u, 1e-17),
        ("displacements", -1, "left.foundation.displacement", -pulled / K_H, 1e-18),
        ("displacements", -1, "left.foundation.rotation", -force * H / K_R, 1e-18),
        ("displacements", -1, "left.velocity[1]", 0.0, 1e-18),
        *(("displacements", -1, f"energy.{name}", value, 1e-17)
          for name, value in (("strain", strain), ("viscous", strain), ("soil", strain), ("input", 2 * strain))),
    )
    weight = 90.0
    flexibility = 1 / K + H * H / K_R
    lean = force * flexibility / (1 - weight / H * flexibility)
    pushed = force + weight / H * lean
    yield f"{head}gravity_load {weight}\nlean {H}\n{tail}", (
        ("displacements", -1, "left.displacement[1]", -lean - pulled / K_H, 1e-17),
        ("displacements", -1, "left.foundation.rotation", -pushed * H / K_R, 1e-18),
        ("displacements", -1, "energy.gravity", -weight / H * lean * lean / 2, 1e-17),
    )


def at_rest_after_yielding():
    """Where storeys have yielded once and are at rest: p are the plastic drifts, P the weights above,

        phi = sum P kept p / (k_r - sum P h / (1 - theta)),  drift = kept p + theta / (1 - theta) h phi,

    theta = P / (k h), kept = (1 - r) / (1 - theta)."""
    masses, heights, stiffness, ratios, limits = (2.0, 1.5), (3.0, 2.5), (300.0, 250.0), (0.0, 0.1), (0.02, 0.015)
    plastic = (0.01, 0.015)
    weights = [GRAVITY * (masses[0] + masses[1]), GRAVITY * masses[1]]
    theta = [P / (k * h) for P, k, h in zip(weights, stiffness, heights)]
    kept = [(1 - r) / (1 - t) for r, t in zip(ratios, theta)]
    stable = K_R - sum(P * h / (1 - t) for P, h, t in zip(weights, heights, theta))
    phi = sum(P * q * p for P, q, p in zip(weights, kept, plastic)) / stable
    drifts = [q * p + t / (1 - t) * h * phi for q, p, t, h in zip(kept, plastic, theta, heights)]
    first = heights[0] * phi + drifts[0]
    start = [limits[0] + plastic[0], limits[0] + plastic[0] + limits[1] + plastic[1]]
    pairs = ["{} {}".format(*two) for two in (masses, stiffness, [k * z for k, z in zip(stiffness, limits)], ratios)]
    yield (
        f"stop 30\nbuilding 2\nmass {pairs[0]}\nstiffness {pairs[1]}\nyield_force {pairs[2]}\n"
        f"post_yield_ratio {pairs[3]}\nlean {heights[0]} {heights[1]}\nheight {heights[0]} {heights[1]}\n"
        f"sway {M_0} {K_H} 25\nrocking {I_0} {K_R} 400\ndamping ratio 0.6\ndisplacement {start[0]} {start[1]}\n",
        (("yields", -1, "rows", 0, 0),
         ("displacements", -1, "left.foundation.rotation", phi, 1e-18),
         ("displacements", -1, "left.foundation.displacement", 0.0, 1e-18),
         ("displacements", -1, "left.displacement[1]", first, 1e-17),
         ("displacements", -1, "left.displacement[2]", first + heights[1] * phi + drifts[1], 2e-17)),
    )


def impacts_on_foundations():
    """A free mass meets a floor, or columns, of a building at rest: the impulse is (1 + e) m v with the weights of what it
    meets, each squared and over its mass: of the floors, of the foundation, and (s - N) h over its inertia."""
    free, below, above, speed, e = 5.0, 3.0, 2.0, 0.5, 0.6
    for sways, rocks in ((True, False), (False, True), (True, True)):
        soil = (f"sway {M_0} {K_H} 0\n" if sways else "") + (f"rocking {I_0} {K_R} 0\n" if rocks else "")
        for storey, s, shape in ((1, 0.3, "fixed"), (1, 0.8, "straight"), (2, 0.3, "fixed")):
            N = s if shape == "straight" else 3 * s**2 - 2 * s**3
            lower = 1 / below if storey == 2 else 1 / M_0 if sways else 0.0
            turning = ((s - N) * 2.5) ** 2 / I_0 if rocks else 0.0
            m = 1 / (1 / free + (1 - N) ** 2 * lower + N * N / (above if storey == 2 else below) + turning)
            yield (
                f"stop 0.03\nbuilding 1\nmass {free}\nstiffness 0\nvelocity {speed}\nbuilding 2\nmass {below} {above}\n"
                f"stiffness 300 250\nheight 2.5 2.5\n{soil}contact 1 columns:{storey}:{s}:{shape} 0.01 stereomechanical "
                f"restitution {e}\n",
                (("impacts", 0, "start_s", 0.02, 1e-17), ("impacts", 0, "impulse", (1 + e) * m * speed, 2e-15),
                 ("impacts", 0, "separation_velocity", e * speed, 1e-16)),
            )


FAMILIES = (one_way, at_rest_under_a_steady_force, at_rest_after_yielding, impacts_on_foundations)
