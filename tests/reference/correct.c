/* Newton correction of the stage accelerations. The residual is known in quadruple precision; the linear equations for
   the correction need only a few digits and are solved in double precision, by functional iteration. */
#include "reference.h"

#include <math.h>

/* Derivatives of the accelerations by the displacements and velocities, in double precision. */
typedef struct {
    double k_over_m[MAX_FLOORS][MAX_FLOORS], c_over_m[MAX_FLOORS][MAX_FLOORS];
    double by_d[MAX_STAGES][MAX_CONTACTS], by_rate[MAX_STAGES][MAX_CONTACTS]; /* of the contact forces */
    double weight[MAX_CONTACTS][MAX_WEIGHTS], weight_over_m[MAX_CONTACTS][MAX_WEIGHTS];
    double held_inverse[MAX_CONTACTS][MAX_CONTACTS];
    double relief[MAX_FLOORS]; /* of the stiffness of storeys that yield */
    double gravity[MAX_FLOORS]; /* N/m, of the storey below each floor */
} Jacobian;

static void round_rows(const Solver *solver, Jacobian *jacobian)
{
    const Scene *scene = solver->scene;
    const Phases *phases = &solver->phases;
    for (int c = 0; c < scene->contacts; c++)
        for (int w = 0; w < scene->contact[c].weights; w++) {
            real weight = scene->contact[c].weight[w];
            jacobian->weight[c][w] = (double)weight;
            jacobian->weight_over_m[c][w] = (double)(weight / scene->mass[scene->contact[c].floor[w]]);
        }
    for (int i = 0; i < phases->held; i++)
        for (int j = 0; j < phases->held; j++)
            jacobian->held_inverse[i][j] = (double)phases->held_inverse[i][j];
    for (int s = 0; s < scene->storeys; s++)
        jacobian->relief[s] =
            phases->yielding[s] ? (double)((1 - scene->storey[s].ratio) * scene->storey[s].k) : 0;
    for (int i = 0; i < scene->floors; i++)
        jacobian->gravity[i] = (double)scene->gravity[i];
}

static void differentiate(const Solver *solver, const Step *step, Jacobian *jacobian)
{
    const Scene *scene = solver->scene;
    for (int i = 0; i < scene->floors; i++)
        for (int e = 0; e < solver->entries[i]; e++) {
            int k = solver->column[i][e];
            jacobian->k_over_m[i][k] = (double)solver->k_over_m[i][k];
            jacobian->c_over_m[i][k] = (double)solver->c_over_m[i][k];
        }
    round_rows(solver, jacobian);
    for (int j = 0; j < solver->gauss.stages; j++)
        for (int c = 0; c < scene->contacts; c++) {
            const Point *p = &step->point[j + 1];
            const Law *law = &scene->contact[c].law;
            Mode mode = solver->phases.mode[c];
            real V = solver->phases.V[c], d = p->d[c], v = p->rate[c], F = p->force[c];
            jacobian->by_d[j][c] = jacobian->by_rate[j][c] = 0;
            if (mode == OPEN || mode == CLIPPED || mode == STUCK)
                continue;
            real delta_d = 1e-10Q * (fabsq(d) + 1e-20Q), delta_v = 1e-10Q * (fabsq(v) + 1e-20Q);
            jacobian->by_d[j][c] = (double)((law_force(law, mode, V, d + delta_d, v) - F) / delta_d);
            jacobian->by_rate[j][c] = (double)((law_force(law, mode, V, d, v + delta_v) - F) / delta_v);
        }
}

/* The row of contact c times a vector of all floors. */
static double row_times(const Solver *solver, const Jacobian *jacobian, int c, const double *floors)
{
    const Contact *contact = &solver->scene->contact[c];
    double sum = 0;
    for (int w = 0; w < contact->weights; w++)
        sum += jacobian->weight[c][w] * floors[contact->floor[w]];
    return sum;
}

static void push(const Solver *solver, const Jacobian *jacobian, int c, double force, double *a)
{
    const Contact *contact = &solver->scene->contact[c];
    for (int w = 0; w < contact->weights; w++)
        a[contact->floor[w]] -= jacobian->weight_over_m[c][w] * force;
}

/* The reactions of the contacts that are held together. */
static void push_held(const Solver *solver, const Jacobian *jacobian, double *a)
{
    const Phases *phases = &solver->phases;
    double rate[MAX_CONTACTS];
    for (int k = 0; k < phases->held; k++)
        rate[k] = row_times(solver, jacobian, phases->held_contact[k], a);
    for (int k = 0; k < phases->held; k++) {
        double force = 0;
        for (int l = 0; l < phases->held; l++)
            force += jacobian->held_inverse[k][l] * rate[l];
        push(solver, jacobian, phases->held_contact[k], force, a);
    }
}

/* Storeys that yield have less stiffness. */
static void relieve_storeys(const Solver *solver, const Jacobian *jacobian, const double *u, double *a)
{
    for (int s = 0; s < solver->scene->storeys; s++) {
        int above = solver->scene->storey[s].above, below = solver->scene->storey[s].below;
        if (jacobian->relief[s] == 0)
            continue;
        double force = jacobian->relief[s] * (u[above] - (below < 0 ? 0 : u[below]));
        a[above] += force / (double)solver->scene->mass[above];
        if (below >= 0)
            a[below] -= force / (double)solver->scene->mass[below];
    }
}

/* So have storeys on whose lean gravity acts. */
static void push_storeys_on(const Solver *solver, const Jacobian *jacobian, const double *u, double *a)
{
    const Scene *scene = solver->scene;
    for (int i = 0; i < scene->floors; i++) {
        bool lowest = stands_on_ground(scene, i);
        double force = jacobian->gravity[i] * (u[i] - (lowest ? 0 : u[i - 1]));
        a[i] += force / (double)scene->mass[i];
        if (!lowest)
            a[i - 1] -= force / (double)scene->mass[i - 1];
    }
}

/* a = Jacobian at stage j times (u, v). */
static void apply(const Solver *solver, const Jacobian *jacobian, int j, const double *u, const double *v, double *a)
{
    const Scene *scene = solver->scene;
    for (int i = 0; i < scene->floors; i++) {
        a[i] = 0;
        for (int e = 0; e < solver->entries[i]; e++) {
            int k = solver->column[i][e];
            a[i] -= jacobian->k_over_m[i][k] * u[k] + jacobian->c_over_m[i][k] * v[k];
        }
    }
    for (int c = 0; c < scene->contacts; c++) {
        double by_d = jacobian->by_d[j][c], by_rate = jacobian->by_rate[j][c];
        if (by_d != 0 || by_rate != 0)
            push(solver, jacobian, c,
                 by_d * row_times(solver, jacobian, c, u) + by_rate * row_times(solver, jacobian, c, v), a);
    }
    relieve_storeys(solver, jacobian, u, a);
    if (scene->has_gravity)
        push_storeys_on(solver, jacobian, u, a);
    push_held(solver, jacobian, a);
}

typedef double StageVectors[MAX_STAGES][MAX_FLOORS];

static void integrate(int stages, int floors, const double *weight, StageVectors of, double *out)
{
    for (int i = 0; i < floors; i++) {
        out[i] = 0;
        for (int k = 0; k < stages; k++)
            out[i] += weight[k] * of[k][i];
    }
}

/* One sweep of functional iteration a = r + Jacobian (integrals of a); returns its largest change relative to a. */
static double sweep(const Solver *solver, const Jacobian *jacobian, double weight[MAX_STAGES][MAX_STAGES],
                    StageVectors r, StageVectors a)
{
    static StageVectors v;
    int n = solver->gauss.stages, floors = solver->scene->floors;
    double u[MAX_FLOORS], product[MAX_FLOORS], change = 0, size = 0;
    for (int j = 0; j < n; j++)
        integrate(n, floors, weight[j], a, v[j]);
    for (int j = 0; j < n; j++) {
        integrate(n, floors, weight[j], v, u);
        apply(solver, jacobian, j, u, v[j], product);
        for (int i = 0; i < floors; i++) {
            double renewed = r[j][i] + product[i];
            change = fmax(change, fabs(renewed - a[j][i]));
            size = fmax(size, fabs(renewed));
            a[j][i] = renewed;
        }
    }
    return size > 0 ? change / size : 0;
}

bool correct_stages(const Solver *solver, const Step *step, real residual[MAX_STAGES][MAX_FLOORS])
{
    static Jacobian jacobian;
    static StageVectors a, r;
    int n = solver->gauss.stages, floors = solver->scene->floors;
    double weight[MAX_STAGES][MAX_STAGES], change = 1;
    differentiate(solver, step, &jacobian);
    for (int j = 0; j < n; j++) {
        for (int k = 0; k < n; k++)
            weight[j][k] = (double)(solver->gauss.integral[j][k] * step->dt_dx[k]);
        for (int i = 0; i < floors; i++)
            a[j][i] = r[j][i] = (double)residual[j][i];
    }
    for (int i = 0; i < 100 && change > 1e-14; i++)
        change = sweep(solver, &jacobian, weight, r, a);
    if (!(change < 1e-8))
        return false;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < floors; i++)
            residual[j][i] = a[j][i];
    return true;
}
