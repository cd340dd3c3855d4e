/* Gauss-Legendre collocation on [0, 1]: nodes, weights, integration matrix. */
#include "reference.h"

/* P_0 .. P_n at z in [-1, 1]. */
static void legendre(int n, real z, real *p)
{
    p[0] = 1;
    p[1] = z;
    for (int k = 1; k < n; k++)
        p[k + 1] = ((2 * k + 1) * z * p[k] - k * p[k - 1]) / (k + 1);
}

static real node_near(int n, real z, real *slope)
{
    real p[MAX_STAGES + 1];
    for (int i = 0; i < 20; i++) {
        legendre(n, z, p);
        *slope = n * (z * p[n] - p[n - 1]) / (z * z - 1);
        z -= p[n] / *slope;
    }
    return z;
}

void integral_row(const Gauss *gauss, real x, real *row)
{
    int n = gauss->stages;
    real at_x[MAX_STAGES + 1], at_node[MAX_STAGES + 1];
    legendre(n, 2 * x - 1, at_x);
    for (int j = 0; j < n; j++) {
        legendre(n, 2 * gauss->node[j] - 1, at_node);
        real sum = at_node[0] * (2 * x); /* twice the integral of P_0 over [-1, z], and so on */
        for (int k = 1; k < n; k++)
            sum += at_node[k] * (at_x[k + 1] - at_x[k - 1]);
        row[j] = gauss->weight[j] * sum / 2;
    }
}

void prepare_gauss(Gauss *gauss, int stages)
{
    gauss->stages = stages;
    for (int i = 0; i < stages; i++) {
        real slope;
        real z = node_near(stages, -cosq(M_PIq * (i + 0.75Q) / (stages + 0.5Q)), &slope);
        gauss->node[i] = (1 + z) / 2;
        gauss->weight[i] = 1 / ((1 - z * z) * slope * slope);
    }
    for (int i = 0; i < stages; i++)
        integral_row(gauss, gauss->node[i], gauss->integral[i]);
    for (int j = 0; j < stages; j++) {
        real p[MAX_STAGES + 1];
        legendre(stages, 2 * gauss->node[j] - 1, p);
        for (int i = 0; i < 2; i++) {
            int k = stages - 2 + i;
            gauss->tail[i][j] = (2 * k + 1) * gauss->weight[j] * p[k];
        }
    }
}
