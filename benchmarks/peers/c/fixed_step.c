/*
 * Fixed steps, as a structural engineer's script has them, in C: `newmark` (constant average acceleration, contact
 * forces iterated by Newton's method to 1e-13 m) and `rk4`. A contact is closed in a step where d > 0; V is the closing
 * velocity at the last step before. Storeys that yield have their return mapping: the plastic drift follows from the
 * drift and from the plastic drift at the last step. SETTING is the step in s.
 */
#include "problem.h"

#include <math.h>
#include <string.h>

typedef struct {
    const Problem *p;
    double step;
    double *u, *v, *V, *plastic;     /* the state; V and the plastic drift one per contact */
    double *F;                       /* contact forces */
    double *work;                    /* RK4: eight vectors */
    /* Newmark: */
    double *a, *factor, *change;
    double *compliance;              /* floors x contacts: effective stiffness^-1 B, in rows of contacts */
    double *G;                       /* contacts x contacts: B^T effective stiffness^-1 B */
    double *d, *d0, *v0, *free, *residual, *jacobian;
} March;

/* The return mapping: how far a drift lies beyond the elastic range that the plastic drift at the last step leaves. */
static double beyond(const March *m, int i, double drift)
{
    double elastic = drift - m->plastic[i], excess = fabs(elastic) - m->p->contact[i].yield_drift;
    return excess > 0.0 ? copysign(excess, elastic) : 0.0;
}

/* Force of a contact or of a storey that yields, and its derivatives by d and by v where they are asked for. */
static double force(const March *m, int i, double d, double v, double *by_d, double *by_v)
{
    const Contact *c = &m->p->contact[i];
    if (by_d)
        *by_d = *by_v = 0.0;
    if (c->yield_drift > 0.0) {
        double slip = beyond(m, i, d);
        if (by_d && slip != 0.0)
            *by_d = -c->k;
        return -c->k * (m->plastic[i] + slip);
    }
    if (d <= 0.0)
        return 0.0;
    if (by_d)
        contact_tangent(c, d, v, m->V[i], by_d, by_v);
    return contact_force(c, d, v, m->V[i]);
}

/* Banded Cholesky factor (lower, in rows) of the effective stiffness. */
static void factorise(March *m, double on_mass, double on_damping)
{
    const Problem *p = m->p;
    int n = p->floors, w = p->band;
    for (int i = 0; i < n; i++)
        for (int j = i > w ? i - w : 0; j <= i; j++) {
            double sum = p->K[(long)i * n + j] + on_damping * p->C[(long)i * n + j];
            sum += i == j ? on_mass * p->mass[i] : 0.0;
            for (int k = i > w ? i - w : 0; k < j; k++)
                sum -= m->factor[(long)i * n + k] * m->factor[(long)j * n + k];
            m->factor[(long)i * n + j] = i == j ? sqrt(sum) : sum / m->factor[(long)j * n + j];
        }
}

static void solve_factored(const March *m, double *x)
{
    int n = m->p->floors, w = m->p->band;
    for (int i = 0; i < n; i++) {
        for (int k = i > w ? i - w : 0; k < i; k++)
            x[i] -= m->factor[(long)i * n + k] * x[k];
        x[i] /= m->factor[(long)i * n + i];
    }
    for (int i = n - 1; i >= 0; i--) {
        x[i] /= m->factor[(long)i * n + i];
        for (int k = i > w ? i - w : 0; k < i; k++)
            x[k] -= m->factor[(long)i * n + k] * x[i];
    }
}

static void solve_dense(int n, double *A, double *x)
{
    for (int k = 0; k < n; k++) {
        int pivot = k;
        for (int i = k + 1; i < n; i++)
            if (fabs(A[i * n + k]) > fabs(A[pivot * n + k]))
                pivot = i;
        for (int j = 0; j < n && pivot != k; j++) {
            double swap = A[k * n + j];
            A[k * n + j] = A[pivot * n + j], A[pivot * n + j] = swap;
        }
        double swap = x[k];
        x[k] = x[pivot], x[pivot] = swap;
        for (int i = k + 1; i < n; i++) {
            double factor = A[i * n + k] / A[k * n + k];
            if (factor == 0.0)
                continue;
            for (int j = k; j < n; j++)
                A[i * n + j] -= factor * A[k * n + j];
            x[i] -= factor * x[k];
        }
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int j = i + 1; j < n; j++)
            x[i] -= A[i * n + j] * x[j];
        x[i] /= A[i * n + i];
    }
}

static void prepare_newmark(March *m)
{
    const Problem *p = m->p;
    double h = m->step;
    factorise(m, 4.0 / (h * h), 2.0 / h);
    for (int i = 0; i < p->contacts; i++) {
        double *column = m->compliance + (long)i * p->floors;
        column[p->contact[i].left] = 1.0;
        if (p->contact[i].right >= 0)
            column[p->contact[i].right] = -1.0;
        solve_factored(m, column);
    }
    for (int i = 0; i < p->contacts; i++)
        for (int j = 0; j < p->contacts; j++)
            m->G[i * p->contacts + j] = rate(&p->contact[i], m->compliance + (long)j * p->floors);
    memset(m->F, 0, p->contacts * sizeof *m->F);
    acceleration(p, m->u, m->v, ground_acceleration(p, 0.0), m->F, m->a);
}

/* Penetrations at the end of the step, from those without contact forces: d + G F(d) = free. */
static void iterate_contacts(March *m)
{
    const Problem *p = m->p;
    int n = p->contacts;
    double h = m->step, change = 1.0;
    for (int iteration = 0; iteration < 50 && change > 1e-13; iteration++) {
        bool any = false;
        for (int j = 0; j < n; j++) {
            double by_d, by_v, v = 2.0 / h * (m->d[j] - m->d0[j]) - m->v0[j];
            m->F[j] = force(m, j, m->d[j], v, &by_d, &by_v);
            any |= by_d != 0.0 || by_v != 0.0;
            for (int i = 0; i < n; i++)
                m->jacobian[i * n + j] = (i == j) + m->G[i * n + j] * (by_d + 2.0 / h * by_v);
        }
        change = 0.0;
        for (int i = 0; i < n; i++) {
            m->residual[i] = m->free[i] - m->d[i];
            for (int j = 0; j < n; j++)
                m->residual[i] -= m->G[i * n + j] * m->F[j];
        }
        if (any)
            solve_dense(n, m->jacobian, m->residual);
        for (int i = 0; i < n; i++) {
            m->d[i] += m->residual[i];
            change = fmax(change, fabs(m->residual[i]));
        }
    }
}

/* In increments of the displacement: sums of large terms would leave nothing at small steps. */
static void newmark_step(March *m, double t)
{
    const Problem *p = m->p;
    int n = p->floors, w = p->band;
    double h = m->step, ground = ground_acceleration(p, t + h);
    for (int i = 0; i < n; i++) {
        double sum = p->mass[i] * (4.0 / h * m->v[i] + m->a[i] - ground);
        for (int j = i > w ? i - w : 0; j <= i + w && j < n; j++)
            sum += p->C[(long)i * n + j] * m->v[j] - p->K[(long)i * n + j] * m->u[j];
        m->change[i] = sum;
    }
    solve_factored(m, m->change);
    bool touching = false;
    for (int i = 0; i < p->contacts; i++) {
        m->d0[i] = penetration(&p->contact[i], m->u);
        m->v0[i] = rate(&p->contact[i], m->v);
        m->free[i] = m->d[i] = m->d0[i] + rate(&p->contact[i], m->change);
        touching |= m->free[i] > 0.0 || p->contact[i].yield_drift > 0.0;
    }
    if (touching) {
        iterate_contacts(m);
        for (int j = 0; j < p->contacts; j++)
            for (int i = 0; i < n && m->F[j] != 0.0; i++)
                m->change[i] -= m->compliance[(long)j * n + i] * m->F[j];
    }
    for (int i = 0; i < n; i++) {
        double v = 2.0 / h * m->change[i] - m->v[i];
        m->a[i] = 4.0 / (h * h) * m->change[i] - 4.0 / h * m->v[i] - m->a[i];
        m->v[i] = v;
        m->u[i] += m->change[i];
    }
}

static void rk4_slope(March *m, const double *u, const double *v, double t, double *a)
{
    const Problem *p = m->p;
    for (int i = 0; i < p->contacts; i++)
        m->F[i] = force(m, i, penetration(&p->contact[i], u), rate(&p->contact[i], v), NULL, NULL);
    acceleration(p, u, v, ground_acceleration(p, t), m->F, a);
}

static void rk4_step(March *m, double t)
{
    int n = m->p->floors;
    double h = m->step, *u = m->work, *v1 = m->work + n, *v2 = v1 + n, *v3 = v2 + n;
    double *a0 = v3 + n, *a1 = a0 + n, *a2 = a1 + n, *a3 = a2 + n;
    rk4_slope(m, m->u, m->v, t, a0);
    for (int i = 0; i < n; i++)
        u[i] = m->u[i] + 0.5 * h * m->v[i], v1[i] = m->v[i] + 0.5 * h * a0[i];
    rk4_slope(m, u, v1, t + 0.5 * h, a1);
    for (int i = 0; i < n; i++)
        u[i] = m->u[i] + 0.5 * h * v1[i], v2[i] = m->v[i] + 0.5 * h * a1[i];
    rk4_slope(m, u, v2, t + 0.5 * h, a2);
    for (int i = 0; i < n; i++)
        u[i] = m->u[i] + h * v2[i], v3[i] = m->v[i] + h * a2[i];
    rk4_slope(m, u, v3, t + h, a3);
    for (int i = 0; i < n; i++) {
        m->u[i] += h / 6.0 * (m->v[i] + 2.0 * v1[i] + 2.0 * v2[i] + v3[i]);
        m->v[i] += h / 6.0 * (a0[i] + 2.0 * a1[i] + 2.0 * a2[i] + a3[i]);
    }
}

static March new_march(const Problem *p, double step)
{
    int n = p->floors, c = p->contacts;
    double *memory = allocate(16L * n + (long)n * n + (long)n * c + 2L * c * c + 9L * c, sizeof *memory);
    March m = {.p = p, .step = step};
    struct { double **vector; long length; } parts[] = {
        {&m.u, n}, {&m.v, n}, {&m.a, n}, {&m.change, n}, {&m.work, 8L * n}, {&m.factor, (long)n * n},
        {&m.compliance, (long)n * c}, {&m.G, (long)c * c}, {&m.jacobian, (long)c * c}, {&m.V, c}, {&m.F, c},
        {&m.plastic, c}, {&m.d, c}, {&m.d0, c}, {&m.v0, c}, {&m.free, c}, {&m.residual, c},
    };
    for (unsigned i = 0; i < sizeof parts / sizeof *parts; i++) {
        *parts[i].vector = memory;
        memory += parts[i].length;
    }
    return m;
}

static int march(const Problem *p, const char *method, double step, double *out)
{
    bool newmark = strcmp(method, "newmark") == 0;
    if (!newmark && strcmp(method, "rk4") != 0)
        fail("method '%s' not understood", method);
    long steps = lround(p->stop / step), every = lround(p->output_step / step);
    March m = new_march(p, step);
    if (newmark)
        prepare_newmark(&m);
    int impacts = 0;
    for (long k = 0; k <= steps; k++) {
        if (k % every == 0)
            memcpy(out + k / every * p->floors, m.u, p->floors * sizeof *out);
        for (int i = 0; i < p->contacts; i++)
            if (penetration(&p->contact[i], m.u) <= 0.0)
                m.V[i] = fmax(rate(&p->contact[i], m.v), 1e-4);
        if (k == steps)
            break;
        for (int i = 0; i < p->contacts; i++)
            m.d0[i] = penetration(&p->contact[i], m.u);
        newmark ? newmark_step(&m, k * step) : rk4_step(&m, k * step);
        for (int i = 0; i < p->contacts; i++) {
            double d = penetration(&p->contact[i], m.u);
            if (p->contact[i].yield_drift > 0.0)
                m.plastic[i] += beyond(&m, i, d);
            else
                impacts += m.d0[i] <= 0.0 && d > 0.0;
        }
    }
    return impacts;
}

int main(int count, char **word)
{
    return run_program(count, word, march);
}
