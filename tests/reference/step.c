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

/* The mass matrix^-1 times a matrix of stiffness or damping. */
static void divide_matrix(const Scene *scene, const real matrix[MAX_UNKNOWNS][MAX_UNKNOWNS],
                          real out[MAX_UNKNOWNS][MAX_UNKNOWNS])
{
    for (int j = 0; j < scene->unknowns; j++) {
        real column[MAX_UNKNOWNS];
        for (int i = 0; i < scene->unknowns; i++)
            column[i] = matrix[i][j];
        divide_by_masses(scene, column);
        for (int i = 0; i < scene->unknowns; i++)
            out[i][j] = column[i];
    }
}

/* What a force along a form that follows from the same form depends on. */
static void mark_used(const Form *form, bool used[MAX_UNKNOWNS][MAX_UNKNOWNS])
{
    for (int p = 0; p < form->pushes; p++)
        for (int w = 0; w < form->weights; w++)
            used[form->pushed[p]][form->of[w]] = true;
}

void prepare_solver(Solver *solver, const Scene *scene, int stages)
{
    memset(solver, 0, sizeof *solver);
    solver->scene = scene;
    prepare_gauss(&solver->gauss, stages);
    divide_matrix(scene, scene->K, solver->k_over_m);
    divide_matrix(scene, scene->C, solver->c_over_m);
    static bool used[MAX_UNKNOWNS][MAX_UNKNOWNS];
    memset(used, 0, sizeof used);
    for (int s = 0; s < scene->storeys; s++)
        mark_used(&scene->storey[s].form, used);
    for (int l = 0; l < scene->leans; l++)
        mark_used(&scene->lean[l].form, used);
    for (int i = 0; i < scene->unknowns; i++)
        for (int j = 0; j < scene->unknowns; j++)
            if (used[i][j] || scene->C[i][j] != 0 || solver->k_over_m[i][j] != 0 || solver->c_over_m[i][j] != 0)
                solver->column[i][solver->entries[i]++] = j;
}

void set_mode(Solver *solver, int contact, Mode mode)
{
    Phases *phases = &solver->phases;
    const Contact *of = solver->scene->contact;
    real matrix[MAX_CONTACTS][MAX_CONTACTS], column[MAX_CONTACTS];
    phases->mode[contact] = mode;
    phases->held = 0;
    for (int c = 0; c < solver->scene->contacts; c++)
        if (phases->mode[c] == STUCK)
            phases->held_contact[phases->held++] = c;
    int n = phases->held;
    for (int k = 0; k < n; k++) {
        for (int i = 0; i < n; i++) {
            column[i] = i == k;
            for (int j = 0; j < n; j++)
                matrix[i][j] = coupling(&of[phases->held_contact[i]].form, &of[phases->held_contact[j]].form);
        }
        solve_linear(n, matrix, column);
        for (int i = 0; i < n; i++)
            phases->held_inverse[i][k] = column[i];
    }
}

void held_forces(const Phases *phases, const real *rate, real *force)
{
    for (int k = 0; k < phases->held; k++) {
        force[k] = 0;
        for (int l = 0; l < phases->held; l++)
            force[k] += phases->held_inverse[k][l] * rate[l];
    }
}

/* -M^-1 (K x + C y). */
static void restore(const Solver *solver, const real *x, const real *y, real *out)
{
    for (int i = 0; i < solver->scene->unknowns; i++) {
        real sum = 0;
        for (int e = 0; e < solver->entries[i]; e++) {
            int j = solver->column[i][e];
            sum += solver->k_over_m[i][j] * x[j] + solver->c_over_m[i][j] * y[j];
        }
        out[i] = -sum;
    }
}

/* What a plastic drift takes from the force of an elastic storey. */
static void relieve(const Storey *storey, real plastic, real *unknowns)
{
    push(&storey->form, (1 - storey->ratio) * storey->k * plastic, unknowns);
}

real reaction_rate(const Solver *solver, int contact, const Point *p)
{
    const Scene *scene = solver->scene;
    const Phases *phases = &solver->phases;
    real jerk[MAX_UNKNOWNS], rate[MAX_CONTACTS] = {0}, force[MAX_CONTACTS];
    restore(solver, p->v, p->a, jerk);
    push_on(scene, p->v, jerk);
    for (int i = 0; i < scene->unknowns; i++)
        jerk[i] -= scene->carried[i] * solver->segment_slope;
    for (int s = 0; s < scene->storeys; s++)
        if (phases->yielding[s])
            relieve(&scene->storey[s], p->drift_rate[s], jerk);
    for (int c = 0; c < scene->contacts; c++)
        if (phases->mode[c] != STUCK)
            push(&scene->contact[c].form,
                 -law_force_rate(&scene->contact[c].law, phases->mode[c], phases->V[c], p->d[c], p->rate[c],
                                 p->rate_change[c]),
                 jerk);
    for (int k = 0; k < phases->held; k++)
        rate[k] = along(&scene->contact[phases->held_contact[k]].form, jerk);
    held_forces(phases, rate, force);
    for (int k = 0; k < phases->held; k++)
        if (phases->held_contact[k] == contact)
            return force[k];
    return 0;
}

void complete_point(const Solver *solver, Point *p)
{
    const Scene *scene = solver->scene;
    const Phases *phases = &solver->phases;
    real rate[MAX_CONTACTS], force[MAX_CONTACTS];
    p->ground = solver->segment_ground + solver->segment_slope * (p->t - solver->segment_time);
    restore(solver, p->u, p->v, p->a);
    push_on(scene, p->u, p->a);
    for (int i = 0; i < scene->unknowns; i++)
        p->a[i] -= scene->carried[i] * p->ground;
    for (int s = 0; s < scene->storeys; s++) {
        p->drift_rate[s] = along(&scene->storey[s].form, p->v);
        relieve(&scene->storey[s], p->plastic[s], p->a);
    }
    for (int c = 0; c < scene->contacts; c++) {
        const Contact *contact = &scene->contact[c];
        p->rate[c] = along(&contact->form, p->v);
        p->force[c] = law_force(&contact->law, phases->mode[c], phases->V[c], p->d[c], p->rate[c]);
        if (p->force[c] != 0)
            push(&contact->form, -p->force[c], p->a);
    }
    /* the reactions make the floors of contacts that are held together accelerate alike */
    for (int k = 0; k < phases->held; k++)
        rate[k] = along(&scene->contact[phases->held_contact[k]].form, p->a);
    held_forces(phases, rate, force);
    for (int k = 0; k < phases->held; k++) {
        p->force[phases->held_contact[k]] = force[k];
        push(&scene->contact[phases->held_contact[k]].form, -force[k], p->a);
    }
    for (int c = 0; c < scene->contacts; c++)
        p->rate_change[c] = along(&scene->contact[c].form, p->a);
    for (int s = 0; s < scene->storeys; s++)
        p->drift_change[s] = along(&scene->storey[s].form, p->a);
}

/* ---- collocation ---- */

/* p = start + sum of row[j] dt/dx[j] times the stages' accelerations (for v) or velocities (for u). */
static void integrate_velocity(const Solver *solver, const Step *step, const real *weight, Point *p)
{
    for (int i = 0; i < solver->scene->unknowns; i++) {
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
    real change[MAX_UNKNOWNS];
    for (int i = 0; i < scene->unknowns; i++) {
        change[i] = 0;
        for (int j = 0; j < solver->gauss.stages; j++)
            change[i] += weight[j] * step->point[j + 1].v[i];
        p->u[i] = start->u[i] + change[i];
    }
    /* from the changes, not from u: so d keeps its leading digits where it is small */
    for (int c = 0; c < scene->contacts; c++)
        p->d[c] = solver->phases.mode[c] == STUCK ? 0 : start->d[c] + along(&scene->contact[c].form, change);
    for (int s = 0; s < scene->storeys; s++) {
        real drift = along(&scene->storey[s].form, change);
        p->z[s] = start->z[s] + (solver->phases.yielding[s] ? 0 : drift);
        p->plastic[s] = start->plastic[s] + (solver->phases.yielding[s] ? drift : 0);
    }
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
    static real residual[MAX_STAGES][MAX_UNKNOWNS], assumed[MAX_STAGES][MAX_UNKNOWNS];
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
        for (int i = 0; i < solver->scene->unknowns; i++) {
            residual[j][i] = p->a[i] - assumed[j][i];
            largest = fmaxq(largest, fabsq(residual[j][i]) * step->dt_dx[j]);
        }
    }
    if (largest < 1e-33Q * solver->v_scale)
        return largest;
    if (!correct_stages(solver, step, residual))
        return -1;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < solver->scene->unknowns; i++)
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
    for (int i = 0; i < solver->scene->unknowns; i++) {
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
