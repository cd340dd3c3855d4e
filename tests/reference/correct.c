/* Newton correction of the stage accelerations. The residual is known in quadruple precision; the linear equations for
   the correction need only a few digits and are solved in double precision, by functional iteration. */
#include "reference.h"

#include <math.h>

/* Derivatives of the accelerations by the displacements and velocities, in double precision. */
typedef struct {
    double k_over_m[MAX_FLOORS][MAX_FLOORS], c_over_m[MAX_FLOORS][MAX_FLOORS];
    double by_d[MAX_STAGES][MAX_CONTACTS], by_rate[MAX_STAGES][MAX_CONTACTS]; /* of the contact forces */
} Jacobian;

static void differentiate(const Solver *solver, const Step *step, Jacobian *jacobian)
{
    const Scene *scene = solver->scene;
    for (int i = 0; i < scene->floors; i++)
        for (int e = 0; e < solver->entries[i]; e++) {
            int k = solver->column[i][e];
            jacobian->k_over_m[i][k] = (double)solver->k_over_m[i][k];
            jacobian->c_over_m[i][k] = (double)solver->c_over_m[i][k];
        }
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

/* a = Jacobian at stage j times (u, v). */
static void apply(const Solver *solver, const Jacobian *jacobian, int j, const double *u, const double *v, double *a)
{
    const Scene *scene = solver->scene;
    double force[MAX_CONTACTS];
    for (int i = 0; i < scene->floors; i++) {
        a[i] = 0;
        for (int e = 0; e < solver->entries[i]; e++) {
            int k = solver->column[i][e];
            a[i] -= jacobian->k_over_m[i][k] * u[k] + jacobian->c_over_m[i][k] * v[k];
        }
    }
    for (int c = 0; c < scene->contacts; c++) {
        int l = scene->contact[c].left, r = scene->contact[c].right;
        force[c] = solver->phases.mode[c] == STUCK
                       ? (double)scene->contact[c].mass * (a[l] - a[r])
                       : jacobian->by_d[j][c] * (u[l] - u[r]) + jacobian->by_rate[j][c] * (v[l] - v[r]);
    }
    for (int c = 0; c < scene->contacts; c++) {
        int l = scene->contact[c].left, r = scene->contact[c].right;
        a[l] -= force[c] / (double)scene->mass[l];
        a[r] += force[c] / (double)scene->mass[r];
    }
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
