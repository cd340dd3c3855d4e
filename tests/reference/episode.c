/* What is recorded of each contact episode: impulse, work, peaks. */
#include "reference.h"

#include <stdlib.h>

Episode *begin_episode(Episodes *episodes, int contact, const Point *p, real V)
{
    if (episodes->count == episodes->capacity) {
        episodes->capacity = episodes->capacity ? 2 * episodes->capacity : 256;
        episodes->list = realloc(episodes->list, episodes->capacity * sizeof(Episode));
    }
    episodes->current[contact] = episodes->count;
    Episode *episode = &episodes->list[episodes->count++];
    *episode = (Episode){.contact = contact, .open = true, .start = p->t, .approach_velocity = V, .peak_time = p->t,
                         .peak_penetration = p->d[contact]};
    return episode;
}

void end_episode(Episodes *episodes, int contact, const Point *p)
{
    Episode *episode = &episodes->list[episodes->current[contact]];
    episode->open = false;
    episode->end = p->t;
    episode->separation_velocity = 0 - p->rate[contact];
    episodes->current[contact] = -1;
}

static void see_point(Episode *episode, const Point *p)
{
    int c = episode->contact;
    if (p->t < episode->start) /* sustained contact that is about to begin */
        return;
    if (p->force[c] > episode->peak_force) {
        episode->peak_force = p->force[c];
        episode->peak_time = p->t;
    }
    episode->peak_penetration = fmaxq(episode->peak_penetration, p->d[c]);
}

/* ---- peaks within a step ---- */

static real minus_rate(const Solver *solver, const void *contact, const Point *p)
{
    (void)solver;
    return -p->rate[*(const int *)contact];
}

static real force_rate(const Solver *solver, int c, const Point *p)
{
    if (solver->phases.mode[c] == STUCK)
        return reaction_rate(solver, c, p);
    return law_force_rate(&solver->scene->contact[c].law, solver->phases.mode[c], solver->phases.V[c], p->d[c],
                          p->rate[c], p->rate_change[c]);
}

static real minus_force_rate(const Solver *solver, const void *contact, const Point *p)
{
    return -force_rate(solver, *(const int *)contact, p);
}

/* Looks at the maximum near the time H into the step, where f passes 0 with the given slope: shortens the step to it.
   H comes from the collocation polynomial; the end of a step is far more exact than the polynomial within it. */
static void see_peak(Solver *solver, Episode *episode, const Step *step, Step *scratch, real H, PointFunction *f,
                     real slope)
{
    Clock clock = step->clock.kind == TO_RELEASE ? (Clock){PLAIN, 1} : step->clock;
    scratch->point[0] = step->point[0];
    scratch->solved = false;
    for (int i = 0; i < 4; i++) {
        if (!(H > 0) || !solve_step(solver, scratch, clock, H))
            return;
        real correction = f(solver, &episode->contact, step_end(solver, scratch)) / slope;
        if (!(fabsq(correction) > 1e-11Q * H)) { /* the value is good to the square of that */
            step_end(solver, scratch)->t -= correction;
            break;
        }
        H -= correction;
    }
    see_point(episode, step_end(solver, scratch));
}

/* Looks for maxima within a step of a quantity whose derivative is -f. */
static void find_peaks(Solver *solver, Episode *episode, const Step *step, Step *scratch, PointFunction *f)
{
    static Point p;
    int c = episode->contact, n = solver->gauss.stages + 2;
    for (int k = 1; k < n; k++) {
        /* the rate of a force may be infinite at the start, and is then given as 0 */
        real before = f(solver, &c, &step->point[k - 1]), after = f(solver, &c, &step->point[k]);
        if (!(before < 0 && after > 0))
            continue;
        real x = dense_root(solver, step, step->x[k - 1], step->x[k], f, &c);
        dense_point(solver, step, x, &p);
        if (p.force[c] < 0.999Q * episode->peak_force && p.d[c] < 0.999Q * episode->peak_penetration)
            continue;
        real t = p.t, f_t = f(solver, &c, &p);
        dense_point(solver, step, x - 1e-5Q * (x - step->x[k - 1]), &p);
        real slope = (f_t - f(solver, &c, &p)) / (t - p.t);
        see_peak(solver, episode, step, scratch, t - step->point[0].t, f, slope);
    }
}

/* ---- a step ---- */

static void add_integrals(const Solver *solver, Episode *episode, const Step *step)
{
    int c = episode->contact;
    for (int j = 0; j < solver->gauss.stages; j++) {
        const Point *p = &step->point[j + 1];
        real impulse = solver->gauss.weight[j] * step->dt_dx[j] * p->force[c];
        episode->impulse += impulse;
        episode->dissipated += impulse * p->rate[c];
    }
}

void record_step(Solver *solver, Episodes *episodes, const Step *step, Step *scratch)
{
    for (int c = 0; c < solver->scene->contacts; c++) {
        if (episodes->current[c] < 0)
            continue;
        Episode *episode = &episodes->list[episodes->current[c]];
        add_integrals(solver, episode, step);
        see_point(episode, &step->point[0]);
        see_point(episode, &step->point[solver->gauss.stages + 1]);
        if (solver->phases.mode[c] != STUCK)
            find_peaks(solver, episode, step, scratch, minus_rate);
        find_peaks(solver, episode, step, scratch, minus_force_rate);
    }
}
