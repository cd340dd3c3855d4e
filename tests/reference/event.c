/* Where a contact changes its mode: entry, release, turn of the rate, clip; where a storey yields or turns. */
#include "reference.h"

/* ---- guards ---- */

/* At most 2. */
static int contact_guards(const Solver *solver, int c, Guard guards[2])
{
    const Law *law = &solver->scene->contact[c].law;
    switch (solver->phases.mode[c]) {
    case OPEN:
        guards[0] = (Guard){c, PENETRATION, +1};
        return 1;
    case STUCK:
        guards[0] = (Guard){c, REACTION, -1};
        return 1;
    case PUSHING:
        guards[0] = (Guard){c, PENETRATION, -1};
        if (law->kind == JANKOWSKI)
            guards[1] = (Guard){c, RATE, -1};
        else if (law_is_clipped(law, solver->phases.V[c]))
            guards[1] = (Guard){c, PUSH, -1};
        else
            return 1;
        return 2;
    case RESTORING:
        guards[0] = (Guard){c, PENETRATION, -1};
        guards[1] = (Guard){c, RATE, +1};
        return 2;
    case CLIPPED:
        guards[0] = (Guard){c, PENETRATION, -1};
        guards[1] = (Guard){c, PUSH, +1};
        return 2;
    }
    return 0;
}

int present_guards(const Solver *solver, Guard guards[MAX_GUARDS])
{
    int count = 0;
    for (int c = 0; c < solver->scene->contacts; c++)
        count += contact_guards(solver, c, guards + count);
    for (int s = 0; s < solver->scene->storeys; s++)
        count += storey_guards(solver, s, guards + count);
    return count;
}

real guard_value(const Solver *solver, Guard guard, const Point *p)
{
    int c = guard.of;
    switch (guard.quantity) {
    case PENETRATION:
        return guard.sign * p->d[c];
    case RATE:
        return guard.sign * p->rate[c];
    case PUSH:
        return guard.sign * law_push(&solver->scene->contact[c].law, solver->phases.V[c], p->d[c], p->rate[c]);
    case REACTION:
        return guard.sign * p->force[c];
    case YIELD:
        return guard.sign * p->z[c] - solver->scene->storey[c].limit;
    case TURN:
        return guard.sign * p->drift_rate[c];
    case COLLAPSE:
        return guard.sign * (p->z[c] + p->plastic[c]) - solver->scene->storey[c].collapse;
    }
    return 0;
}

real guard_rate(const Solver *solver, Guard guard, const Point *p)
{
    int c = guard.of;
    switch (guard.quantity) {
    case PENETRATION:
        return guard.sign * p->rate[c];
    case RATE:
        return guard.sign * p->rate_change[c];
    case PUSH:
        return guard.sign *
               law_push_rate(&solver->scene->contact[c].law, solver->phases.V[c], p->rate[c], p->rate_change[c]);
    case REACTION:
        return guard.sign * reaction_rate(solver, c, p);
    case YIELD:
    case COLLAPSE:
        return guard.sign * p->drift_rate[c];
    case TURN:
        return guard.sign * p->drift_change[c];
    }
    return 0;
}

real guard_scale(const Solver *solver, Guard guard)
{
    if (guard.quantity >= YIELD)
        return guard.quantity == TURN ? solver->v_scale : solver->u_scale;
    const Contact *contact = &solver->scene->contact[guard.of];
    real largest = 0; /* stiffness over mass */
    for (int w = 0; w < contact->form.weights; w++)
        largest = fmaxq(largest, solver->k_over_m[contact->form.of[w]][contact->form.of[w]]);
    switch (guard.quantity) {
    case PENETRATION:
        return solver->u_scale;
    case RATE:
        return solver->v_scale;
    case PUSH:
        return fabsq(law_push(&contact->law, solver->v_scale, solver->u_scale, solver->v_scale));
    case REACTION:
        return contact->mass * largest * solver->u_scale;
    case YIELD:
    case TURN:
    case COLLAPSE:
        break;
    }
    return 0;
}

/* ---- finding them in a solved step ---- */

/* Illinois variant of false position; f is negative (or 0) at lo and positive at hi. */
real dense_root(const Solver *solver, const Step *step, real lo, real hi, PointFunction *f, const void *context)
{
    static Point p;
    dense_point(solver, step, lo, &p);
    real f_lo = f(solver, context, &p);
    dense_point(solver, step, hi, &p);
    real f_hi = f(solver, context, &p);
    int side = 0;
    for (int i = 0; i < 60 && hi - lo > 1e-16Q * hi; i++) {
        real x = f_hi > f_lo ? lo - f_lo * (hi - lo) / (f_hi - f_lo) : lo;
        if (!(x > lo && x < hi))
            x = (lo + hi) / 2;
        dense_point(solver, step, x, &p);
        real f_x = f(solver, context, &p);
        if (f_x > 0) {
            hi = x, f_hi = f_x;
            if (side == 1)
                f_lo /= 2;
            side = 1;
        } else {
            lo = x, f_lo = f_x;
            if (side == -1)
                f_hi /= 2;
            side = -1;
        }
    }
    return hi;
}

static real value_of(const Solver *solver, const void *guard, const Point *p)
{
    return guard_value(solver, *(const Guard *)guard, p);
}

static real falling(const Solver *solver, const void *guard, const Point *p)
{
    return -guard_rate(solver, *(const Guard *)guard, p);
}

static real rising(const Solver *solver, const void *guard, const Point *p)
{
    return guard_rate(solver, *(const Guard *)guard, p);
}

/* What the value of a guard at point k of a step may be wrong by: the polynomial is most exact at its end. */
static real doubt(const Solver *solver, Guard guard, int k, real error)
{
    bool inside = k > 0 && k <= solver->gauss.stages;
    return guard_scale(solver, guard) * (inside ? error + 1e-33Q : 1e-33Q);
}

/* Whether a guard that is 0 at a point turns positive there. z is 0 from its limit, without a rate, wherever a storey
   has just unloaded or its drift has turned exactly at the limit: then the second derivative decides. */
static bool leaves_zero(const Solver *solver, Guard guard, const Point *p)
{
    real rate = guard_rate(solver, guard, p);
    if (guard.quantity == YIELD && fabsq(rate) <= resting_rate(solver))
        return guard.sign * p->drift_change[guard.of] > 0;
    return rate >= 0;
}

/* A point before x where a guard that falls from 0 at the start of the step is negative. */
static real fallen_before(const Solver *solver, const Step *step, Guard guard, real x)
{
    static Point p;
    if (guard.quantity != YIELD)
        return dense_root(solver, step, 0, x, rising, &guard);
    for (real inside = x / 2; inside > 1e-12Q * x; inside /= 2) {
        dense_point(solver, step, inside, &p);
        if (guard_value(solver, guard, &p) < 0)
            return inside;
    }
    return x;
}

/* The crossing before point k, where the guard is positive. */
static real crossing_before(const Solver *solver, const Step *step, Guard guard, int k, real hi, real error)
{
    const Point *p = step->point;
    int j = k - 1;
    while (j > 0 && guard_value(solver, guard, &p[j]) >= -doubt(solver, guard, j, error))
        j--;
    real lo = step->x[j];
    /* a reaction jumps with the ground acceleration, and where an impact on another floor changes a damping force */
    if (j == 0 && guard.quantity == REACTION && guard_value(solver, guard, &p[0]) > 1e-25Q * guard_scale(solver, guard))
        return 0;
    if (j == 0 && guard_value(solver, guard, &p[0]) >= 0) {
        /* 0 because the contact has just changed its mode there, or because the floors touch at rest */
        if (leaves_zero(solver, guard, &p[0]))
            return 0;
        lo = fallen_before(solver, step, guard, hi);
    }
    return dense_root(solver, step, lo, hi, value_of, &guard);
}

/* A yield limit is often reached only just, or just not: an undamped storey swings to it in every cycle. Within this
   part of the largest displacement the polynomial does not tell which, and where. */
static const real GRAZE = 1e-12Q;

/* Where the guard has its maximum between points k - 1 and k; false where it has none. */
static bool maximum_before(const Solver *solver, const Step *step, Guard guard, int k, real *x)
{
    const Point *p = step->point;
    real least = guard.quantity == YIELD ? resting_rate(solver) : 0;
    if (!(guard_rate(solver, guard, &p[k - 1]) > least && guard_rate(solver, guard, &p[k]) < 0))
        return false;
    *x = dense_root(solver, step, step->x[k - 1], step->x[k], falling, &guard);
    return true;
}

/* The first x at which the guard turns positive. It counts as negative at the start of the step. Where a storey only
   just reaches its limit, or just not, the event is the turn of its drift: the step that ends there tells. */
static bool first_crossing(const Solver *solver, const Step *step, Guard guard, real error, Event *event)
{
    static Point peak;
    int last = solver->gauss.stages + 1;
    bool may_graze = guard.quantity == YIELD;
    for (int k = 1; k <= last; k++) {
        real hi = step->x[k], least = doubt(solver, guard, k, error);
        real value = guard_value(solver, guard, &step->point[k]);
        bool turns = (may_graze || value <= least) && maximum_before(solver, step, guard, k, &hi);
        if (turns) {
            dense_point(solver, step, hi, &peak);
            value = guard_value(solver, guard, &peak);
        }
        bool near = may_graze && value <= GRAZE * solver->u_scale, grazes = near && turns && value > -10 * least;
        if (!grazes && (value <= least || (near && k < last)))
            continue;
        real x = value > 0 ? crossing_before(solver, step, guard, k, hi, error) : hi;
        *event = grazes && x > 0 ? (Event){{guard.of, TURN, -guard.sign}, x, hi} : (Event){guard, x, x};
        return true;
    }
    return false;
}

bool first_event(const Solver *solver, const Step *step, real error, Event *event)
{
    Guard guards[MAX_GUARDS];
    int count = present_guards(solver, guards);
    Event next;
    bool found = false;
    for (int g = 0; g < count; g++)
        if (first_crossing(solver, step, guards[g], error, &next) && (!found || next.x < event->x)) {
            *event = next;
            found = true;
        }
    return found;
}

/* ---- exactly ---- */

bool locate(Solver *solver, Step *step, Clock clock, real H, Guard guard)
{
    real start = H, small = 1e-33Q * guard_scale(solver, guard);
    for (int i = 0; i < 12; i++) {
        if (!(H > 0 && H < 4 * start) || !solve_step(solver, step, clock, H))
            return false;
        const Point *end = step_end(solver, step);
        real value = guard_value(solver, guard, end), correction = value / guard_rate(solver, guard, end);
        if (fabsq(value) <= small || fabsq(correction) <= 1e-31Q * H)
            return true;
        H -= correction;
    }
    return false;
}
