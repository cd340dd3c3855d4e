/* Impulses of stereomechanical contacts that touch at the same time, whether they share floors or not. */
#include "reference.h"

/* The contacts that can take part in an impact. w = V' + e V of each is wanted, V' its rate after it. */
typedef struct {
    int count, contact[MAX_CONTACTS];
    real before[MAX_CONTACTS], e[MAX_CONTACTS], impulse[MAX_CONTACTS];
} Impact;

void hold_together(Run *run)
{
    const Phases *phases = &run->solver.phases;
    real rate[MAX_CONTACTS], impulse[MAX_CONTACTS];
    for (int k = 0; k < phases->held; k++)
        rate[k] = along(&run->scene->contact[phases->held_contact[k]].form, run->now.v);
    held_forces(phases, rate, impulse);
    for (int k = 0; k < phases->held; k++)
        push(&run->scene->contact[phases->held_contact[k]].form, -impulse[k], run->now.v);
}

real returned_share(const Run *run, int c, real rate)
{
    real e = run->scene->contact[c].law.e;
    return e * rate < 1e-15Q * run->solver.v_scale ? 0 : e;
}

/* `first`, all contacts that are held together, and those that touch at the same time and do not part. The last of a
   dying sequence brings to rest what is held together with it, none of which parts. */
static void gather(const Run *run, int first, bool last, Impact *impact)
{
    impact->count = 0;
    for (int c = 0; c < run->scene->contacts; c++) {
        bool rigid = run->scene->contact[c].law.kind == STEREOMECHANICAL;
        bool held = run->solver.phases.mode[c] == STUCK;
        bool touches = fabsq(run->now.d[c]) <= 1e-30Q * run->solver.u_scale;
        real rate = held ? 0 : run->now.rate[c];
        if (!rigid || !(c == first || held || (touches && !last && rate >= -1e-29Q * run->solver.v_scale)))
            continue;
        impact->contact[impact->count] = c;
        impact->before[impact->count] = rate;
        impact->e[impact->count++] = returned_share(run, c, rate);
    }
}

/* Impulses p of the contacts of a set (bits) so that w = 0 for them, 0 for the others. */
static void solve_set(const Run *run, Impact *impact, unsigned long set)
{
    const Contact *of = run->scene->contact;
    real matrix[MAX_CONTACTS][MAX_CONTACTS], p[MAX_CONTACTS];
    int n = 0, acting[MAX_CONTACTS];
    for (int i = 0; i < impact->count; i++)
        if (set >> i & 1)
            acting[n++] = i;
    for (int i = 0; i < n; i++) {
        p[i] = (1 + impact->e[acting[i]]) * impact->before[acting[i]];
        for (int j = 0; j < n; j++)
            matrix[i][j] = coupling(&of[impact->contact[acting[i]]].form, &of[impact->contact[acting[j]]].form);
    }
    solve_linear(n, matrix, p);
    for (int i = 0; i < impact->count; i++)
        impact->impulse[i] = 0;
    for (int i = 0; i < n; i++)
        impact->impulse[acting[i]] = p[i];
}

/* Whether p >= 0 and w <= 0. */
static bool fits(const Run *run, const Impact *impact)
{
    const Contact *of = run->scene->contact;
    for (int i = 0; i < impact->count; i++) {
        real w = (1 + impact->e[i]) * impact->before[i];
        for (int j = 0; j < impact->count; j++)
            w -= coupling(&of[impact->contact[i]].form, &of[impact->contact[j]].form) * impact->impulse[j];
        if (impact->impulse[i] < 0 || w > 1e-30Q * run->solver.v_scale)
            return false;
    }
    return true;
}

/* p >= 0, w <= 0, p w = 0 for every contact, by trying the sets of those that act: the only one that fits. */
static void solve_impulses(const Run *run, Impact *impact)
{
    if (impact->count > 12)
        fail("more than 12 stereomechanical contacts at once");
    for (unsigned long set = 1; set < 1UL << impact->count; set++) {
        solve_set(run, impact, set);
        if (fits(run, impact))
            return;
    }
    fail("no impulses fit at t = %.17g", (double)run->now.t);
}

/* An impulse of floors that are held together belongs to their sustained contact. */
static void record_impulse(Run *run, int c, real before, real after, real impulse)
{
    Episodes *episodes = &run->solution->episodes;
    bool held = run->solver.phases.mode[c] == STUCK;
    Episode *episode = held ? &episodes->list[episodes->current[c]]
                            : begin_episode(episodes, c, &run->now, before);
    real lost = impulse * (before + after) / 2;
    episode->impulse += impulse;
    episode->dissipated += lost;
    run->energy.impact += lost;
    if (held)
        return;
    end_episode(episodes, c, &run->now);
    episode->separation_velocity = -after;
}

static void let_go(Run *run, int c)
{
    set_mode(&run->solver, c, OPEN);
    end_episode(&run->solution->episodes, c, &run->now);
}

/* An impulse changes the rates of all contacts and storeys of its floors, and so what the laws of closed contacts and
   storeys that yield do. */
static void renew_modes(Run *run)
{
    for (int c = 0; c < run->scene->contacts; c++) {
        const Law *law = &run->scene->contact[c].law;
        Mode mode = run->solver.phases.mode[c];
        real V = run->solver.phases.V[c], d = run->now.d[c], rate = run->now.rate[c];
        if (mode == OPEN || mode == STUCK)
            continue;
        if (law->kind == JANKOWSKI)
            set_mode(&run->solver, c, rate > 0 ? PUSHING : RESTORING);
        else if (law_is_clipped(law, V))
            set_mode(&run->solver, c, law_push(law, V, d, rate) < 0 ? CLIPPED : PUSHING);
    }
    renew_storeys(run);
    complete_point(&run->solver, &run->now);
}

void exchange_momentum(Run *run, int first)
{
    static Impact impact;
    real V = run->now.rate[first];
    bool last = V < 1e-13Q * run->solver.v_scale && returned_share(run, first, V) == 0;
    gather(run, first, last, &impact);
    if (last)
        solve_set(run, &impact, (1UL << impact.count) - 1);
    else
        solve_impulses(run, &impact);
    for (int i = 0; i < impact.count; i++)
        push(&run->scene->contact[impact.contact[i]].form, -impact.impulse[i], run->now.v);
    complete_point(&run->solver, &run->now);
    for (int i = 0; i < impact.count; i++) {
        int c = impact.contact[i];
        real after = run->now.rate[c];
        if (impact.impulse[i] != 0)
            record_impulse(run, c, impact.before[i], after, impact.impulse[i]);
        else if (run->solver.phases.mode[c] == STUCK && after < -1e-29Q * run->solver.v_scale)
            let_go(run, c);
    }
    renew_modes(run);
}
