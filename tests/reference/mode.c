/* What happens at an event: entry, release, turn, clip, exchange of momentum; storeys yield and unload. */
#include "reference.h"

/* A time in which the contact force turns the approach around, roughly. */
static real contact_time(const Contact *contact, real V)
{
    real n = contact->law.n;
    return powq(contact->mass / (contact->law.k * powq(fmaxq(V, 1e-6Q), n - 1)), 1 / (n + 1));
}

static void close_contact(Run *run, int c, real V, bool damped)
{
    const Contact *contact = &run->scene->contact[c];
    Phases *phases = &run->solver.phases;
    set_mode(&run->solver, c, PUSHING);
    phases->V[c] = V;
    if (contact->law.kind == HERTZ_DAMPED)
        phases->V[c] = damped ? fmaxq(V, run->scene->min_approach_velocity) : 0;
    if (run->H_entry[c] == 0)
        run->H_entry[c] = contact_time(contact, V) / 4;
    run->H_closed = run->H_entry[c];
    begin_episode(&run->solution->episodes, c, &run->now, V);
}

void close_at_start(Run *run)
{
    for (int c = 0; c < run->scene->contacts; c++) {
        const Law *law = &run->scene->contact[c].law;
        real d = run->now.d[c], rate = run->now.rate[c];
        if (d <= 0)
            continue;
        if (law->kind == STEREOMECHANICAL && d < 1e-15Q * run->solver.u_scale) { /* touching, as written in the scene */
            run->now.d[c] = 0;
            continue;
        }
        if (law->kind == STEREOMECHANICAL)
            fail("contact %d: stereomechanical with penetration at the start", c + 1);
        close_contact(run, c, 0, false);
        if (law->kind == JANKOWSKI && rate <= 0)
            set_mode(&run->solver, c, RESTORING);
        else if (law_is_clipped(law, 0) && law_push(law, 0, d, rate) < 0)
            set_mode(&run->solver, c, CLIPPED);
    }
}

/* Sustained contact. It begins where the geometric series of rebounds not followed up any more ends, `rest` from now;
   what happens until then is below the digits of everything else. */
static void stick(Run *run, int c, real rest)
{
    Point *p = &run->now;
    if (rest > 1e-9Q)
        fail("contact %d: rebounds at t = %.17g die too slowly to be summed up", c + 1, (double)p->t);
    set_mode(&run->solver, c, STUCK);
    hold_together(run);
    complete_point(&run->solver, p);
    Episode *episode = begin_episode(&run->solution->episodes, c, p, 0);
    episode->start = episode->peak_time = p->t + rest;
    episode->peak_force = p->force[c] + rest * reaction_rate(&run->solver, c, p);
    episode->impulse = -p->force[c] * rest;
}

/* A rebound too slow to matter is none: it ends a dying sequence, and the floors stay together if pressed. Without any
   speed there is no impulse either: only pressure brings floors together that touch. */
static void impact(Run *run, int c)
{
    real V = run->now.rate[c], e = run->scene->contact[c].law.e, scale = run->solver.v_scale;
    bool dying = returned_share(run, c, V) == 0, still = V < 1e-29Q * scale;
    if (!still)
        exchange_momentum(run, c);
    real A = run->now.rate_change[c];
    if (still)
        stick(run, c, 0);
    else if (dying && A > 0)
        stick(run, c, 2 * e * V / (A * (1 - e)));
}

static void enter(Run *run, int c)
{
    run->now.d[c] = 0;
    if (run->scene->contact[c].law.kind == STEREOMECHANICAL) {
        impact(run, c);
        return;
    }
    close_contact(run, c, run->now.rate[c], true);
    run->fresh[c] = run->scene->contact[c].law.clock > 1;
}

static void release(Run *run, int c)
{
    run->now.d[c] = 0;
    run->fresh[c] = false;
    set_mode(&run->solver, c, OPEN);
    end_episode(&run->solution->episodes, c, &run->now);
}

static void change_mode(Run *run, Guard guard)
{
    int c = guard.of;
    Mode mode = run->solver.phases.mode[c];
    switch (guard.quantity) {
    case PENETRATION:
        if (mode == OPEN)
            enter(run, c);
        else
            release(run, c);
        break;
    case REACTION:
        release(run, c);
        break;
    case RATE:
        set_mode(&run->solver, c, mode == PUSHING ? RESTORING : PUSHING);
        break;
    case PUSH:
        set_mode(&run->solver, c, mode == PUSHING ? CLIPPED : PUSHING);
        break;
    case YIELD:
    case TURN:
    case COLLAPSE:
        switch_storey(run, guard);
        break;
    }
    complete_point(&run->solver, &run->now);
}

/* A guard of another contact or storey that is 0 at the same time. */
static bool simultaneous_guard(const Run *run, Guard *guard)
{
    Guard guards[MAX_GUARDS];
    int count = present_guards(&run->solver, guards);
    for (int g = 0; g < count; g++) {
        real least = 1e-30Q * guard_scale(&run->solver, guards[g]);
        real slow = guards[g].quantity == YIELD ? resting_rate(&run->solver) : least;
        if (fabsq(guard_value(&run->solver, guards[g], &run->now)) <= least &&
            guard_rate(&run->solver, guards[g], &run->now) > slow) {
            *guard = guards[g];
            return true;
        }
    }
    return false;
}

void fire(Run *run, Guard guard)
{
    change_mode(run, guard);
    for (int i = 0; simultaneous_guard(run, &guard); i++) {
        if (i > 1000) /* impulses of rigid contacts of one floor may follow each other for long */
            fail("mode changes without end at t = %.17g", (double)run->now.t);
        change_mode(run, guard);
    }
}
