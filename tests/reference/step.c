/* One step by Gauss-Legendre collocation in a clock that tames the roots of the laws. */
#include "reference.h"

#include <string.h>

/* ---- clocks ---- */

static real power_of(real x, int q)
{
    real y = 1;
    for (int i = 0; i < q; i++)
        y *= x;
    return y;
}

real clock_time(Clock clock, real H, real x)
{
    switch (clock.kind) {
    case FROM_ENTRY:
        return H * power_of(x, clock.q);
    case TO_RELEASE:
        return H * (1 - power_of(1 - x, clock.q));
    case PLAIN:
        break;
    }
    return H * x;
}

static real clock_rate(Clock clock, real H, real x)
{
    switch (clock.kind) {
    case FROM_ENTRY:
        return H * clock.q * power_of(x, clock.q - 1);
    case TO_RELEASE:
        return H * clock.q * power_of(1 - x, clock.q - 1);
    case PLAIN:
        break;
    }
    return H;
}

/* ---- equations of motion ---- */

void prepare_solver(Solver *solver, const Scene *scene, int stages)
{
    memset(solver, 0, sizeof *solver);
    solver->scene = scene;
    prepare_gauss(&solver->gauss, stages);
    for (int i = 0; i < scene->floors; i++)
        for (int j = 0; j < scene->floors; j++)
            if (scene->K[i][j] != 0 || scene->C[i][j] != 0) {
                solver->k_over_m[i][j] = scene->K[i][j] / scene->mass[i];
                solver->c_over_m[i][j] = scene->C[i][j] / scene->mass[i];
                solver->column[i][solver->entries[i]++] = j;
            }
}

static real contact_force(const Solver *solver, int c, const Point *p)
{
    const Contact *contact = &solver->scene->contact[c];
    Mode mode = solver->phases.mode[c];
    if (mode == STUCK) /* the force that makes both floors accelerate alike; p->a is without contacts here */
        return contact->mass * (p->a[contact->left] - p->a[contact->right]);
    return law_force(&contact->law, mode, solver->phases.V[c], p->d[c], p->rate[c]);
}

real reaction_rate(const Solver *solver, int c, const Point *p)
{
    const Contact *contact = &solver->scene->contact[c];
    int floor[2] = {contact->left, contact->right};
    real jerk[2];
    for (int side = 0; side < 2; side++) {
        int i = floor[side];
        jerk[side] = -solver->segment_slope;
        for (int e = 0; e < solver->entries[i]; e++) {
            int j = solver->column[i][e];
            jerk[side] -= solver->k_over_m[i][j] * p->v[j] + solver->c_over_m[i][j] * p->a[j];
        }
    }
    return contact->mass * (jerk[0] - jerk[1]);
}

void complete_point(const Solver *solver, Point *p)
{
    const Scene *scene = solver->scene;
    p->ground = solver->segment_ground + solver->segment_slope * (p->t - solver->segment_time);
    for (int i = 0; i < scene->floors; i++) {
        real sum = 0;
        for (int e = 0; e < solver->entries[i]; e++) {
            int j = solver->column[i][e];
            sum += solver->k_over_m[i][j] * p->u[j] + solver->c_over_m[i][j] * p->v[j];
        }
        p->a[i] = -p->ground - sum;
    }
    for (int c = 0; c < scene->contacts; c++) {
        p->rate[c] = p->v[scene->contact[c].left] - p->v[scene->contact[c].right];
        p->force[c] = contact_force(solver, c, p);
    }
    for (int c = 0; c < scene->contacts; c++) {
        const Contact *contact = &scene->contact[c];
        p->a[contact->left] -= p->force[c] / scene->mass[contact->left];
        p->a[contact->right] += p->force[c] / scene->mass[contact->right];
    }
    for (int c = 0; c < scene->contacts; c++)
        p->rate_change[c] = p->a[scene->contact[c].left] - p->a[scene->contact[c].right];
}

/* ---- collocation ---- */

/* p = start + sum of row[j] dt/dx[j] times the stages' accelerations (for v) or velocities (for u). */
static void integrate_velocity(const Solver *solver, const Step *step, const real *weight, Point *p)
{
    for (int i = 0; i < solver->scene->floors; i++) {
        real change = 0;
        for (int j = 0; j < solver->gauss.stages; j++)
            change += weight[j] * step->point[j + 1].a[i];
        p->v[i] = step->point[0].v[i] + change;
    }
}

static void integrate_displacement(const Solver *solver, const Step *step, const real *weight, Point *p)
{
    const Scene *scene = solver->scene;
    const Point *start = &step->point[0];
    real change[MAX_FLOORS];
    for (int i = 0; i < scene->floors; i++) {
        change[i] = 0;
        for (int j = 0; j < solver->gauss.stages; j++)
            change[i] += weight[j] * step->point[j + 1].v[i];
        p->u[i] = start->u[i] + change[i];
    }
    /* from the changes, not from u: so d keeps its leading digits where it is small */
    for (int c = 0; c < scene->contacts; c++)
        p->d[c] = solver->phases.mode[c] == STUCK
                      ? 0
                      : start->d[c] + (change[scene->contact[c].left] - change[scene->contact[c].right]);
}

static void time_weights(const Solver *solver, const Step *step, const real *row, real *weight)
{
    for (int j = 0; j < solver->gauss.stages; j++)
        weight[j] = row[j] * step->dt_dx[j];
}

static void integrate_row(const Solver *solver, const Step *step, const real *row, Point *p)
{
    real weight[MAX_STAGES];
    time_weights(solver, step, row, weight);
    integrate_velocity(solver, step, weight, p);
    integrate_displacement(solver, step, weight, p);
    complete_point(solver, p);
}

/* One Newton iteration on the accelerations of the stages; returns the largest residual as a velocity, < 0 where the
   correction cannot be found. */
static real iterate(const Solver *solver, Step *step)
{
    int n = solver->gauss.stages;
    static real residual[MAX_STAGES][MAX_FLOORS], assumed[MAX_STAGES][MAX_FLOORS];
    real weight[MAX_STAGES][MAX_STAGES], largest = 0;
    for (int j = 0; j < n; j++) {
        memcpy(assumed[j], step->point[j + 1].a, sizeof assumed[j]);
        time_weights(solver, step, solver->gauss.integral[j], weight[j]);
        integrate_velocity(solver, step, weight[j], &step->point[j + 1]);
    }
    for (int j = 0; j < n; j++) {
        Point *p = &step->point[j + 1];
        integrate_displacement(solver, step, weight[j], p);
        complete_point(solver, p);
        for (int i = 0; i < solver->scene->floors; i++) {
            residual[j][i] = p->a[i] - assumed[j][i];
            largest = fmaxq(largest, fabsq(residual[j][i]) * step->dt_dx[j]);
        }
    }
    if (largest < 1e-33Q * solver->v_scale)
        return largest;
    if (!correct_stages(solver, step, residual))
        return -1;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < solver->scene->floors; i++)
            step->point[j + 1].a[i] = assumed[j][i] + residual[j][i];
    return largest;
}

/* The first guess is constant acceleration, or what is there from a step of almost the same length. */
static void prepare_stages(const Solver *solver, Step *step, Clock clock, real H)
{
    const Point *start = &step->point[0];
    int n = solver->gauss.stages;
    bool warm = step->solved && step->clock.kind == clock.kind && fabsq(H - step->H) < 1e-3Q * H;
    step->clock = clock;
    step->H = H;
    step->x[0] = 0;
    step->x[n + 1] = 1;
    for (int j = 0; j < n; j++) {
        Point *p = &step->point[j + 1];
        real x = solver->gauss.node[j];
        real elapsed = clock_time(step->clock, step->H, x);
        step->x[j + 1] = x;
        step->dt_dx[j] = clock_rate(step->clock, step->H, x);
        p->t = start->t + elapsed;
        if (warm)
            continue;
        memcpy(p->a, start->a, sizeof p->a);
    }
}

static real legendre_tail(const Solver *solver, const Step *step)
{
    real largest = 0;
    for (int i = 0; i < solver->scene->floors; i++) {
        real sum = 0;
        for (int k = 0; k < 2; k++) {
            real coefficient = 0;
            for (int j = 0; j < solver->gauss.stages; j++)
                coefficient += solver->gauss.tail[k][j] * step->dt_dx[j] * step->point[j + 1].a[i];
            sum += fabsq(coefficient);
        }
        largest = fmaxq(largest, sum);
    }
    return largest;
}

static bool converge(Solver *solver, Step *step)
{
    real last = 1e30Q;
    for (step->iterations = 1; step->iterations <= 30; step->iterations++) {
        real residual = iterate(solver, step) / solver->v_scale;
        if (residual < 0 || !(residual < 1e6Q))
            return false;
        if (residual < 1e-33Q || (residual < 1e-29Q && residual > last / 100))
            return true;
        if (step->iterations > 8 && residual > last)
            return false;
        last = residual;
    }
    return false;
}

bool solve_step(Solver *solver, Step *step, Clock clock, real H)
{
    prepare_stages(solver, step, clock, H);
    bool converged = converge(solver, step);
    solver->iterations += step->iterations;
    step->solved = converged;
    if (!converged)
        return false;
    Point *end = step_end(solver, step);
    end->t = step->point[0].t + H;
    integrate_row(solver, step, solver->gauss.weight, end);
    step->tail = legendre_tail(solver, step);
    return true;
}

void dense_point(const Solver *solver, const Step *step, real x, Point *p)
{
    real row[MAX_STAGES];
    integral_row(&solver->gauss, x, row);
    p->t = step->point[0].t + clock_time(step->clock, step->H, x);
    integrate_row(solver, step, row, p);
}
