/* Newton correction of the stage accelerations. The residual is known in quadruple precision; the linear equations for
   the correction need only a few digits and are solved in double precision, by functional iteration. */
#include "reference.h"

#include <math.h>

/* Derivatives of the accelerations by the displacements and velocities, in double precision. */
typedef struct {
    double k_over_m[MAX_UNKNOWNS][MAX_UNKNOWNS], c_over_m[MAX_UNKNOWNS][MAX_UNKNOWNS];
    double by_d[MAX_STAGES][MAX_CONTACTS], by_rate[MAX_STAGES][MAX_CONTACTS]; /* of the contact forces */
    double weight[MAX_CONTACTS][MAX_WEIGHTS], push[MAX_CONTACTS][MAX_UNKNOWNS]; /* of the contacts' forms */
    double held_inverse[MAX_CONTACTS][MAX_CONTACTS];
} Jacobian;

static void round_forms(const Solver *solver, Jacobian *jacobian)
{
    const Scene *scene = solver->scene;
    const Phases *phases = &solver->phases;
    for (int c = 0; c < scene->contacts; c++) {
        const Form *form = &scene->contact[c].form;
        for (int w = 0; w < form->weights; w++)
            jacobian->weight[c][w] = (double)form->weight[w];
        for (int p = 0; p < form->pushes; p++)
            jacobian->push[c][p] = (double)form->push[p];
    }
    for (int i = 0; i < phases->held; i++)
        for (int j = 0; j < phases->held; j++)
            jacobian->held_inverse[i][j] = (double)phases->held_inverse[i][j];
}

/* Takes a stiffness along a form away. */
static void soften(Jacobian *jacobian, const Form *form, real stiffness)
{
    for (int p = 0; p < form->pushes; p++)
        for (int w = 0; w < form->weights; w++)
            jacobian->k_over_m[form->pushed[p]][form->of[w]] -= (double)(form->push[p] * form->weight[w] * stiffness);
}

/* Storeys that yield have less stiffness, and so have those on whose lean gravity acts. */
static void round_matrices(const Solver *solver, Jacobian *jacobian)
{
    const Scene *scene = solver->scene;
    for (int i = 0; i < scene->unknowns; i++)
        for (int e = 0; e < solver->entries[i]; e++) {
            int k = solver->column[i][e];
            jacobian->k_over_m[i][k] = (double)solver->k_over_m[i][k];
            jacobian->c_over_m[i][k] = (double)solver->c_over_m[i][k];
        }
    for (int s = 0; s < scene->storeys; s++)
        if (solver->phases.yielding[s])
            soften(jacobian, &scene->storey[s].form, (1 - scene->storey[s].ratio) * scene->storey[s].k);
    for (int l = 0; l < scene->leans; l++)
        soften(jacobian, &scene->lean[l].form, scene->lean[l].stiffness);
}

static void differentiate(const Solver *solver, const Step *step, Jacobian *jacobian)
{
    const Scene *scene = solver->scene;
    round_matrices(solver, jacobian);
    round_forms(solver, jacobian);
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

/* The form of contact c times a vector of all unknowns. */
static double along_contact(const Solver *solver, const Jacobian *jacobian, int c, const double *unknowns)
{
    const Form *form = &solver->scene->contact[c].form;
    double sum = 0;
    for (int w = 0; w < form->weights; w++)
        sum += jacobian->weight[c][w] * unknowns[form->of[w]];
    return sum;
}

static void push_apart(const Solver *solver, const Jacobian *jacobian, int c, double force, double *a)
{
    const Form *form = &solver->scene->contact[c].form;
    for (int p = 0; p < form->pushes; p++)
        a[form->pushed[p]] -= jacobian->push[c][p] * force;
}

/* The reactions of the contacts that are held together. */
static void push_held(const Solver *solver, const Jacobian *jacobian, double *a)
{
    const Phases *phases = &solver->phases;
    double rate[MAX_CONTACTS];
    for (int k = 0; k < phases->held; k++)
        rate[k] = along_contact(solver, jacobian, phases->held_contact[k], a);
    for (int k = 0; k < phases->held; k++) {
        double force = 0;
        for (int l = 0; l < phases->held; l++)
            force += jacobian->held_inverse[k][l] * rate[l];
        push_apart(solver, jacobian, phases->held_contact[k], force, a);
    }
}

/* a = Jacobian at stage j times (u, v). */
static void apply(const Solver *solver, const Jacobian *jacobian, int j, const double *u, const double *v, double *a)
{
    const Scene *scene = solver->scene;
    for (int i = 0; i < scene->unknowns; i++) {
        a[i] = 0;
        for (int e = 0; e < solver->entries[i]; e++) {
            int k = solver->column[i][e];
            a[i] -= jacobian->k_over_m[i][k] * u[k] + jacobian->c_over_m[i][k] * v[k];
        }
    }
    for (int c = 0; c < scene->contacts; c++) {
        double by_d = jacobian->by_d[j][c], by_rate = jacobian->by_rate[j][c];
        if (by_d != 0 || by_rate != 0)
            push_apart(solver, jacobian, c,
                       by_d * along_contact(solver, jacobian, c, u) + by_rate * along_contact(solver, jacobian, c, v), a);
    }
    push_held(solver, jacobian, a);
}

typedef double StageVectors[MAX_STAGES][MAX_UNKNOWNS];

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
    int n = solver->gauss.stages, floors = solver->scene->unknowns;
    double u[MAX_UNKNOWNS], product[MAX_UNKNOWNS], change = 0, size = 0;
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

bool correct_stages(const Solver *solver, const Step *step, real residual[MAX_STAGES][MAX_UNKNOWNS])
{
    static Jacobian jacobian;
    static StageVectors a, r;
    int n = solver->gauss.stages, floors = solver->scene->unknowns;
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
