/* Impact laws: force for penetration d, rate v, approach velocity V. */
#include "reference.h"

#include <math.h>
#include <string.h>

/* ---- coefficients ---- */

static real kelvin_damping(const Law *law, real m)
{
    real log_e = logq(law->e);
    real xi = -log_e / sqrtq(M_PIq * M_PIq + log_e * log_e);
    return 2 * xi * sqrtq(law->k * m);
}

static real jankowski_damping(const Law *law, real m)
{
    real e = law->e;
    real xi = 9 * sqrtq(5) / 2 * (1 - e * e) / (e * (e * (9 * M_PIq - 16) + 16));
    return 2 * xi * sqrtq(law->k * m);
}

/* a of the exact relation a (1 + e) = ln((1 + a) / (1 - a e)), by bisection on 0 < a < 1/e. */
static real exact_damping(real e)
{
    if (e == 1)
        return 0;
    real lo = 0, hi = 1 / e;
    for (int i = 0; i < 250; i++) {
        real a = (lo + hi) / 2;
        /* the difference is -(1 - e^2) a^2 / 2 near a = 0 and + infinity at 1/e */
        if (log1pq(a) - log1pq(-a * e) - a * (1 + e) > 0)
            hi = a;
        else
            lo = a;
    }
    return (lo + hi) / 2;
}

static real hertz_damping(const char *formula, real e)
{
    const struct {
        const char *name;
        real a;
    } table[] = {
        {"lankarani_nikravesh", 3 * (1 - e * e) / 4},
        {"ye_printed", 3 * (1 - e * e) / (8 * e)},
        {"ye", 8 * (1 - e) / (5 * e)},
        {"barros_khatami", 8 * (1 - e) / (5 * e)}, /* on a spring 3k/2 */
        {"barros_khatami_damper", 24 * (1 - e) / (10 * e)},
        {"exact", exact_damping(e)},
        {"hunt_crossley", 3 * (1 - e) / 2},
        {"herbert_mcwhannell", 6 * (1 - e) / ((2 * e - 1) * (2 * e - 1) + 3)},
        {"lee_wang", 3 * (1 - e) / 4},
        {"gonthier", (1 - e * e) / e},
        {"zhiying_qishao", 3 * (1 - e * e) * expq(2 * (1 - e)) / 4},
        {"gharib_hurmuzlu", 1 / e},
        {"hu_guo", 3 * (1 - e) / (2 * e)},
        {"safaeifar_farshidianfar", 5 * (1 - e) / (4 * e)},
        {"carvalho_martins", 3 * (1 - e) * (11 - e) / (2 * (1 + 9 * e))},
    };
    for (unsigned i = 0; i < sizeof table / sizeof *table; i++)
        if (formula && strcmp(formula, table[i].name) == 0)
            return table[i].a;
    fail("contact: unknown damping formula '%s'", formula ? formula : "");
}

/* The smallest q up to 10 for which d^n is a power series in t^(1/q) where d passes 0. */
static void find_clock(Law *law)
{
    for (int q = 1; q <= 10; q++)
        if (fabsq(q * law->n - roundq(q * law->n)) < 1e-12Q) {
            law->clock = q;
            return;
        }
    law->clock = 10;
    law->exact_clock = false;
}

void prepare_law(Law *law, real m, const char *formula)
{
    law->clock = 1;
    law->exact_clock = true;
    switch (law->kind) {
    case KELVIN_VOIGT:
    case KELVIN_VOIGT_NO_TENSION:
        law->damping = kelvin_damping(law, m);
        break;
    case JANKOWSKI:
        law->n = 1.5Q;
        law->damping = jankowski_damping(law, m);
        law->clock = 4; /* d^(1/4) */
        break;
    case HERTZ_DAMPED:
        law->damping = hertz_damping(formula, law->e);
        if (strcmp(formula, "barros_khatami") == 0)
            law->k *= 1.5Q;
        find_clock(law);
        break;
    case HERTZ:
        find_clock(law);
        break;
    case LINEAR:
    case STEREOMECHANICAL:
        break;
    }
}

/* ---- forces ---- */

static real power(real d, real n)
{
    if (d <= 0)
        return 0;
    if (n == 1.5Q)
        return d * sqrtq(d);
    if (n == 1)
        return d;
    return powq(d, n);
}

static real fourth_root(real d) { return d > 0 ? sqrtq(sqrtq(d)) : 0; }

real law_force(const Law *law, Mode mode, real V, real d, real v)
{
    if (mode == OPEN || mode == CLIPPED)
        return 0;
    switch (law->kind) {
    case LINEAR:
        return law->k * d;
    case KELVIN_VOIGT:
    case KELVIN_VOIGT_NO_TENSION:
        return law->k * d + law->damping * v;
    case HERTZ:
        return law->k * power(d, law->n);
    case JANKOWSKI: {
        real spring = law->k * power(d, law->n);
        return mode == RESTORING ? spring : spring + law->damping * fourth_root(d) * v;
    }
    case HERTZ_DAMPED:
        return law->k * power(d, law->n) * (V > 0 ? 1 + law->damping * v / V : 1);
    case STEREOMECHANICAL:
        return 0; /* the reaction of a stuck contact is a matter of the equations of motion */
    }
    return 0;
}

real law_force_rate(const Law *law, Mode mode, real V, real d, real v, real a)
{
    if (mode == OPEN || mode == CLIPPED)
        return 0;
    real slope = law->k * law->n * (d > 0 ? powq(d, law->n - 1) : 0); /* of the spring */
    switch (law->kind) {
    case LINEAR:
        return law->k * v;
    case KELVIN_VOIGT:
    case KELVIN_VOIGT_NO_TENSION:
        return law->k * v + law->damping * a;
    case HERTZ:
        return slope * v;
    case JANKOWSKI: {
        real root = fourth_root(d);
        if (mode == RESTORING || root == 0)
            return slope * v;
        return slope * v + law->damping * (root * a + v * v * root / (4 * d));
    }
    case HERTZ_DAMPED: {
        real b = V > 0 ? law->damping / V : 0;
        return slope * v * (1 + b * v) + law->k * power(d, law->n) * b * a;
    }
    case STEREOMECHANICAL:
        return 0;
    }
    return 0;
}

/* ---- laws that only push ---- */

bool law_is_clipped(const Law *law, real V)
{
    return law->kind == KELVIN_VOIGT_NO_TENSION || (law->kind == HERTZ_DAMPED && V > 0);
}

real law_push(const Law *law, real V, real d, real v)
{
    return law->kind == HERTZ_DAMPED ? V + law->damping * v : law->k * d + law->damping * v;
}

real law_push_rate(const Law *law, real V, real v, real a)
{
    (void)V;
    return law->kind == HERTZ_DAMPED ? law->damping * a : law->k * v + law->damping * a;
}
