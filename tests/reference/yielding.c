/* Storeys that yield: bilinear, kinematic hardening. Their plastic drifts are further unknowns of a step, constant in an
   elastic storey, changing as the drift in one that yields. The shear is continuous through every change of phase. */
#include "reference.h"

#include <stdlib.h>

static real drift(const Point *p, int s) { return p->z[s] + p->plastic[s]; }

/* ---- phases ---- */

int storey_guards(const Solver *solver, int s, Guard guards[2])
{
    int direction = solver->phases.yielding[s];
    if (direction) { /* a drift larger than all before is reached only while the storey yields */
        guards[0] = (Guard){s, TURN, -direction};
        guards[1] = (Guard){s, COLLAPSE, direction};
        return solver->scene->storey[s].collapse > 0 && !solver->phases.collapsed ? 2 : 1;
    }
    guards[0] = (Guard){s, YIELD, +1};
    guards[1] = (Guard){s, YIELD, -1};
    return 2;
}

void start_storeys(Run *run)
{
    Point *p = &run->now;
    for (int s = 0; s < run->scene->storeys; s++) {
        const Storey *storey = &run->scene->storey[s];
        real all = along(&storey->form, p->u);
        p->z[s] = fmaxq(-storey->limit, fminq(all, storey->limit));
        p->plastic[s] = all - p->z[s];
        run->peak[s] = fabsq(all);
    }
}

static void note_switch(Run *run, int s, int direction)
{
    Solution *solution = run->solution;
    const Point *p = &run->now;
    if (solution->switches == solution->switch_capacity) {
        solution->switch_capacity = 2 * solution->switch_capacity + 256;
        solution->switched = realloc(solution->switched, solution->switch_capacity * sizeof(Switch));
    }
    solution->switched[solution->switches++] =
        (Switch){s, direction, p->t, drift(p, s), p->plastic[s], p->drift_rate[s]};
}

static void set_phase(Run *run, int s, int direction)
{
    run->solver.phases.yielding[s] = direction;
    note_switch(run, s, direction);
}

void switch_storey(Run *run, Guard guard)
{
    int s = guard.of;
    if (guard.quantity == COLLAPSE) {
        run->solver.phases.collapsed = true;
        note_switch(run, s, 2 * guard.sign);
    } else if (guard.quantity == YIELD) {
        run->now.z[s] = guard.sign * run->scene->storey[s].limit;
        set_phase(run, s, guard.sign);
    } else if (run->solver.phases.yielding[s]) { /* an elastic storey that turns stays elastic */
        set_phase(run, s, 0);
    }
}

void renew_storeys(Run *run)
{
    for (int s = 0; s < run->scene->storeys; s++) {
        int direction = run->solver.phases.yielding[s];
        if (direction * run->now.drift_rate[s] < -resting_rate(&run->solver))
            set_phase(run, s, 0);
    }
}

/* ---- what is recorded ---- */

static real drift_rate(const Solver *solver, const void *storey, const Point *p)
{
    (void)solver;
    return p->drift_rate[*(const int *)storey];
}

static real minus_drift_rate(const Solver *solver, const void *storey, const Point *p)
{
    return -drift_rate(solver, storey, p);
}

/* The largest |drift| of the points of a step and of the turns between them. */
static real largest_drift(const Solver *solver, const Step *step, int s)
{
    static Point turn;
    real largest = fabsq(drift(&step->point[solver->gauss.stages + 1], s));
    for (int k = 1; k < solver->gauss.stages + 2; k++) {
        real before = step->point[k - 1].drift_rate[s], after = step->point[k].drift_rate[s];
        if (!(before < 0 && after > 0) && !(before > 0 && after < 0))
            continue;
        PointFunction *rises = after > 0 ? drift_rate : minus_drift_rate;
        dense_point(solver, step, dense_root(solver, step, step->x[k - 1], step->x[k], rises, &s), &turn);
        largest = fmaxq(largest, fabsq(drift(&turn, s)));
    }
    return largest;
}

void record_storeys(Run *run, const Step *step)
{
    const Solver *solver = &run->solver;
    for (int s = 0; s < run->scene->storeys; s++) {
        real change = step->point[solver->gauss.stages + 1].plastic[s] - step->point[0].plastic[s];
        run->cumulative[s] += fabsq(change);
        run->peak[s] = fmaxq(run->peak[s], largest_drift(solver, step, s));
    }
}

StoreyRow storey_row(const Run *run, int s)
{
    const Storey *storey = &run->scene->storey[s];
    const Point *p = &run->now;
    return (StoreyRow){
        .shear = storey->k * (storey->ratio * drift(p, s) + (1 - storey->ratio) * p->z[s]),
        .plastic = p->plastic[s],
        .cumulative = run->cumulative[s],
        .peak = run->peak[s],
        .yielding = run->solver.phases.yielding[s],
    };
}

/* ---- energy ---- */

real recoverable_change(const Run *run)
{
    real sum = 0;
    for (int s = 0; s < run->scene->storeys; s++) {
        const Storey *storey = &run->scene->storey[s];
        const Point *p = &run->now; /* z^2 - drift^2 = -plastic (z + drift) */
        sum -= (1 - storey->ratio) * storey->k * p->plastic[s] * (p->z[s] + drift(p, s)) / 2;
    }
    return sum;
}

real hysteretic_energy(const Run *run)
{
    real sum = 0;
    for (int s = 0; s < run->scene->storeys; s++) {
        const Storey *storey = &run->scene->storey[s];
        sum += (1 - storey->ratio) * storey->force * run->cumulative[s];
    }
    return sum;
}
