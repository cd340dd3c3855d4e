/*
 * SUNDIALS CVODE, Adams with fixed-point iteration, in two ways: `events` (entry, release and every other switch of a
 * law is a root; the integration starts anew there) and `plain` (the right-hand side asks whether d > 0). SETTING is
 * the relative tolerance.
 */
#include "problem.h"

#include <cvode/cvode.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <string.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

enum { ROOTS = 2 };                   /* functions per contact: penetration, and the switch of its law */

typedef struct {
    const Problem *p;
    bool events;
    bool *closed;
    bool *slack;                      /* closed, on the other branch of the law: without its damper, or without force */
    double *V, *F;
} Run;

/* The force of a closed contact on its present branch, smooth beyond the ends of the branch. */
static double branch_force(const Run *run, int i, double d, double v)
{
    Contact c = run->p->contact[i];
    if (run->slack[i] && !c.only_approaching)
        return 0.0;
    if (run->slack[i])
        c.c = 0.0;
    c.only_approaching = false;
    c.tension = true;
    return contact_force(&c, fmax(d, 0.0), v, run->V[i]);
}

static int slope(realtype t, N_Vector y, N_Vector ydot, void *data)
{
    Run *run = data;
    const Problem *p = run->p;
    const double *u = N_VGetArrayPointer(y), *v = u + p->floors;
    double *out = N_VGetArrayPointer(ydot);
    for (int i = 0; i < p->contacts; i++) {
        const Contact *c = &p->contact[i];
        double d = penetration(c, u), w = rate(c, v);
        if (run->events)
            run->F[i] = run->closed[i] ? branch_force(run, i, d, w) : 0.0;
        else
            run->F[i] = d > 0.0 ? contact_force(c, d, w, 1.0) : 0.0;
    }
    memcpy(out, v, p->floors * sizeof *out);
    acceleration(p, u, v, ground_acceleration(p, t), run->F, out + p->floors);
    return 0;
}

/* Changes sign where a closed contact changes branch. */
static double branch_switch(const Run *run, int i, double d, double v)
{
    const Contact *c = &run->p->contact[i];
    if (!run->closed[i])
        return 1.0;
    if (c->only_approaching)
        return v;
    if (c->a != 0.0)
        return 1.0 + c->a * v / run->V[i];
    if (c->c != 0.0 && !c->tension)
        return c->k * d + c->c * v;
    return 1.0;
}

static int roots(realtype t, N_Vector y, realtype *out, void *data)
{
    (void)t;
    Run *run = data;
    const double *u = N_VGetArrayPointer(y), *v = u + run->p->floors;
    for (int i = 0; i < run->p->contacts; i++) {
        double d = penetration(&run->p->contact[i], u), w = rate(&run->p->contact[i], v);
        out[ROOTS * i] = d;
        out[ROOTS * i + 1] = branch_switch(run, i, d, w);
    }
    return 0;
}

/* Changes the phase of the contacts whose roots were found; returns how many were entered. */
static int handle(Run *run, const int *found, const double *y)
{
    int entered = 0;
    for (int i = 0; i < run->p->contacts; i++) {
        double v = rate(&run->p->contact[i], y + run->p->floors);
        if (found[ROOTS * i] > 0 && !run->closed[i]) {
            run->closed[i] = true;
            run->slack[i] = false;
            run->V[i] = fmax(v, 1e-4);
            entered++;
        } else if (found[ROOTS * i] < 0 && run->closed[i]) {
            run->closed[i] = false;
        } else if (found[ROOTS * i + 1] != 0 && run->closed[i]) {
            run->slack[i] = found[ROOTS * i + 1] < 0;
        }
    }
    return entered;
}

static int integrate(const Problem *p, const char *method, double tolerance, double *out)
{
    int n = p->floors, impacts = 0;
    Run run = {.p = p, .events = strcmp(method, "events") == 0};
    run.closed = allocate(p->contacts, sizeof *run.closed);
    run.slack = allocate(p->contacts, sizeof *run.slack);
    run.V = allocate(p->contacts, sizeof *run.V);
    run.F = allocate(p->contacts, sizeof *run.F);
    int *found = allocate(ROOTS * p->contacts, sizeof *found);

    SUNContext context;
    SUNContext_Create(NULL, &context);
    N_Vector y = N_VNew_Serial(2 * n, context);
    N_VConst(0.0, y);
    void *solver = CVodeCreate(CV_ADAMS, context);
    CVodeInit(solver, slope, 0.0, y);
    CVodeSStolerances(solver, tolerance, 0.01 * tolerance); /* m and m/s: motions are 0.01 to 1 of these */
    CVodeSetUserData(solver, &run);
    SUNNonlinearSolver iteration = SUNNonlinSol_FixedPoint(y, 0, context);
    CVodeSetNonlinearSolver(solver, iteration);
    CVodeSetMaxNumSteps(solver, 10000000);
    if (run.events)
        CVodeRootInit(solver, ROOTS * p->contacts, roots);

    long rows = lround(p->stop / p->output_step);
    memcpy(out, N_VGetArrayPointer(y), n * sizeof *out);
    for (long row = 1, sample = 1; row <= rows; row++) {
        double end = row * p->output_step, t = end - p->output_step;
        while (t < end) {
            /* No step across a sample, where the slope of the ground acceleration jumps. */
            while (sample < p->samples - 1 && p->time[sample] <= t + 1e-9)
                sample++;
            CVodeSetStopTime(solver, p->time[sample]);
            int status = CVode(solver, end, y, &t, CV_NORMAL);
            if (status < 0)
                fail("CVode returned %d at %g s", status, t);
            if (status == CV_ROOT_RETURN) {
                CVodeGetRootInfo(solver, found);
                impacts += handle(&run, found, N_VGetArrayPointer(y));
                CVodeReInit(solver, t, y);
            }
            if (end - t < 1e-9)
                break;
        }
        memcpy(out + row * n, N_VGetArrayPointer(y), n * sizeof *out);
    }
    if (!run.events)
        impacts = -1; /* nobody counts them */
    CVodeFree(&solver);
    SUNNonlinSolFree(iteration);
    N_VDestroy(y);
    SUNContext_Free(&context);
    return impacts;
}

int main(int count, char **word)
{
    return run_program(count, word, integrate);
}
