/* Damping matrices from ratios. The only place where modes appear: C is then used in physical coordinates. */
#include "reference.h"

typedef struct {
    int n;
    real w[MAX_UNKNOWNS];               /* rad/s, ascending */
    real q[MAX_UNKNOWNS][MAX_UNKNOWNS];   /* orthonormal eigenvectors in columns */
} Modes;

/* One Jacobi rotation that annihilates s[i][j]. */
static void rotate(int n, real s[MAX_UNKNOWNS][MAX_UNKNOWNS], real q[MAX_UNKNOWNS][MAX_UNKNOWNS], int i, int j)
{
    real theta = (s[j][j] - s[i][i]) / (2 * s[i][j]);
    real t = (theta >= 0 ? 1 : -1) / (fabsq(theta) + sqrtq(theta * theta + 1));
    real c = 1 / sqrtq(t * t + 1), sn = t * c;
    for (int k = 0; k < n; k++) {
        real a = s[k][i], b = s[k][j];
        s[k][i] = c * a - sn * b;
        s[k][j] = sn * a + c * b;
    }
    for (int k = 0; k < n; k++) {
        real a = s[i][k], b = s[j][k];
        s[i][k] = c * a - sn * b;
        s[j][k] = sn * a + c * b;
        a = q[k][i], b = q[k][j];
        q[k][i] = c * a - sn * b;
        q[k][j] = sn * a + c * b;
    }
}

static void sort_modes(Modes *modes)
{
    for (int i = 0; i < modes->n; i++)
        for (int j = i + 1; j < modes->n; j++)
            if (modes->w[j] < modes->w[i]) {
                real w = modes->w[i];
                modes->w[i] = modes->w[j];
                modes->w[j] = w;
                for (int k = 0; k < modes->n; k++) {
                    real x = modes->q[k][i];
                    modes->q[k][i] = modes->q[k][j];
                    modes->q[k][j] = x;
                }
            }
}

/* Eigenvalues of M^-1/2 K M^-1/2 by cyclic Jacobi rotations, K being that under gravity. */
static void find_modes(const Scene *scene, int first, int n, Modes *modes)
{
    static real s[MAX_UNKNOWNS][MAX_UNKNOWNS];
    modes->n = n;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            s[i][j] = stiffness_under_gravity(scene, first + i, first + j) / sqrtq(scene->mass[first + i] * scene->mass[first + j]);
            modes->q[i][j] = i == j;
        }
    for (int sweep = 0; sweep < 40; sweep++)
        for (int i = 0; i < n; i++)
            for (int j = i + 1; j < n; j++)
                if (fabsq(s[i][j]) > 1e-40Q * (fabsq(s[i][i]) + fabsq(s[j][j])))
                    rotate(n, s, modes->q, i, j);
    for (int i = 0; i < n; i++)
        modes->w[i] = sqrtq(s[i][i]);
    sort_modes(modes);
}

/* C = M phi diag(2 zeta w) phi^T M with phi = M^-1/2 q. */
void damping_from_ratios(Scene *scene, int first, int n, const real *ratios)
{
    static Modes modes;
    find_modes(scene, first, n, &modes);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            real sum = 0;
            for (int k = 0; k < n; k++)
                sum += modes.q[i][k] * 2 * ratios[k] * modes.w[k] * modes.q[j][k];
            scene->C[first + i][first + j] = sqrtq(scene->mass[first + i] * scene->mass[first + j]) * sum;
        }
}

/* C = alpha M + beta K with the same ratio in two modes, counted from 1. */
void damping_rayleigh(Scene *scene, int first, int n, real ratio, int mode_1, int mode_2)
{
    static Modes modes;
    find_modes(scene, first, n, &modes);
    real w1 = modes.w[mode_1 - 1], w2 = modes.w[mode_2 - 1];
    real alpha = 2 * ratio * w1 * w2 / (w1 + w2), beta = 2 * ratio / (w1 + w2);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            scene->C[first + i][first + j] =
                beta * stiffness_under_gravity(scene, first + i, first + j) +
                (i == j ? alpha * scene->mass[first + i] : 0);
}
