/* How far a solution can be trusted: a second one, and how errors grow. */
#include "reference.h"

#include <stdio.h>
#include <stdlib.h>

static real largest_difference(const Scene *scene, const Row *a, const Row *b, bool velocity)
{
    real largest = 0;
    for (int i = 0; i < scene->unknowns; i++)
        largest = fmaxq(largest, velocity ? fabsq(a->v[i] - b->v[i]) : fabsq(a->u[i] - b->u[i]));
    return largest;
}

/* A collapse ends a run: the last row of both may be at other output times. */
static int fewer_rows(const Solution *a, const Solution *b) { return a->rows < b->rows ? a->rows : b->rows; }

static real largest_value(const Scene *scene, const Solution *s, bool velocity)
{
    static const Row zero;
    real largest = 0;
    for (int r = 0; r < s->rows; r++)
        largest = fmaxq(largest, largest_difference(scene, &s->row[r], &zero, velocity));
    return largest > 0 ? largest : 1;
}

static void compare(const Scene *scene, const Solution *best, Proof *proof)
{
    const Solution *second = &proof->second;
    real du = 0, dv = 0, dt = 0;
    for (int r = 0; r < fewer_rows(best, second); r++) {
        du = fmaxq(du, largest_difference(scene, &best->row[r], &second->row[r], false));
        dv = fmaxq(dv, largest_difference(scene, &best->row[r], &second->row[r], true));
    }
    proof->same_impacts = best->episodes.count == second->episodes.count;
    for (int i = 0; proof->same_impacts && i < best->episodes.count; i++) {
        const Episode *x = &best->episodes.list[i], *y = &second->episodes.list[i];
        proof->same_impacts = x->contact == y->contact && x->open == y->open;
        dt = fmaxq(dt, fmaxq(fabsq(x->start - y->start), fabsq(x->end - y->end)));
    }
    proof->u = (double)(du / largest_value(scene, best, false));
    proof->v = (double)(dv / largest_value(scene, best, true));
    proof->time = (double)dt;
}

/* The largest difference of two rows' plastic drifts, or plastic drift of the first. */
static real largest_plastic(const Scene *scene, const Row *a, const Row *b)
{
    real largest = 0;
    for (int s = 0; s < scene->storeys; s++)
        largest = fmaxq(largest, fabsq(a->storey[s].plastic - (b ? b->storey[s].plastic : 0)));
    return largest;
}

/* The next switch of a storey from *at on; NULL: no more. Yields of no more than `least` are left out, with their ends:
   there the limit is only just reached, which makes no difference to the motion. */
static const Switch *next_switch(const Solution *s, int storey, real least, int *at)
{
    while (*at < s->switches) {
        const Switch *found = &s->switched[(*at)++], *end = found;
        if (found->storey != storey)
            continue;
        while (++end < s->switched + s->switches && end->storey != storey)
            ;
        bool lasts = end == s->switched + s->switches;
        if (found->direction == 0 || lasts || fabsq(end->plastic - found->plastic) > least)
            return found;
        *at = end - s->switched + 1;
    }
    return NULL;
}

static void compare_storeys(const Scene *scene, const Solution *best, Proof *proof)
{
    const Solution *second = &proof->second;
    real difference = 0, largest = 0, dt = 0;
    for (int r = 0; r < fewer_rows(best, second); r++) {
        difference = fmaxq(difference, largest_plastic(scene, &best->row[r], &second->row[r]));
        largest = fmaxq(largest, largest_plastic(scene, &best->row[r], NULL));
    }
    proof->same_yields = true;
    for (int s = 0; s < scene->storeys; s++)
        for (int i = 0, j = 0;;) {
            real least = 1e-18Q * largest_value(scene, best, false);
            const Switch *x = next_switch(best, s, least, &i), *y = next_switch(second, s, least, &j);
            if (!x || !y || x->direction != y->direction) {
                proof->same_yields = proof->same_yields && !x && !y;
                break;
            }
            dt = fmaxq(dt, fabsq(x->time - y->time));
        }
    proof->plastic = (double)(largest > 0 ? difference / largest : difference);
    proof->yield_time = (double)dt;
}

/* 1 + part or 1 - part, always in the same order (linear congruential generator). */
static real shaken(real part)
{
    static unsigned long long state = 1;
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return state >> 63 ? 1 + part : 1 - part;
}

static void find_sensitivity(const Scene *scene, const Solution *best, Proof *proof)
{
    static Scene changed;
    static Solution solution;
    const real part = 1e-18Q;
    changed = *scene;
    changed.record.acceleration = malloc((scene->record.count + 1) * sizeof(real));
    for (int i = 0; i < scene->record.count; i++)
        changed.record.acceleration[i] = scene->record.acceleration[i] * shaken(part);
    for (int i = 0; i < scene->unknowns; i++) {
        changed.u0[i] *= shaken(part);
        changed.v0[i] *= shaken(part);
    }
    solve(&changed, proof->second.stages, proof->second.tolerance, &solution);
    real largest = 0, scale = part * largest_value(scene, &proof->second, false);
    proof->sensitivity = calloc(best->rows, sizeof(double));
    for (int r = 0; r < best->rows; r++) {
        if (r < fewer_rows(&solution, &proof->second))
            largest = fmaxq(largest, largest_difference(scene, &solution.row[r], &proof->second.row[r], false) / scale);
        proof->sensitivity[r] = (double)largest;
    }
}

void prove(const Scene *scene, const Solution *best, Proof *proof)
{
    solve(scene, best->stages * 3 / 4, best->tolerance * 1000, &proof->second);
    print_run(&proof->second);
    compare(scene, best, proof);
    printf("agreement: displacements %.1e, velocities %.1e, impact times %.1e s, impacts %s\n", proof->u, proof->v,
           proof->time, proof->same_impacts ? "the same" : "DIFFERENT");
    compare_storeys(scene, best, proof);
    if (scene->storeys)
        printf("agreement: plastic drifts %.1e, yields and turns %.1e s, %s\n", proof->plastic, proof->yield_time,
               proof->same_yields ? "the same" : "DIFFERENT");
    find_sensitivity(scene, best, proof);
    printf("sensitivity: %.1e\n", proof->sensitivity[best->rows - 1]);
}
