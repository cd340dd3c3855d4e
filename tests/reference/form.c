/* Distances that forces act along: penetrations, drifts, leans. Each is a sum of weights times unknowns. */
#include "reference.h"

void add_weight(Form *form, int unknown, real weight)
{
    if (form->weights == MAX_WEIGHTS)
        fail("a distance between more than %d unknowns", MAX_WEIGHTS);
    form->of[form->weights] = unknown;
    form->weight[form->weights++] = weight;
}

void find_pushes(const Scene *scene, Form *form)
{
    real push[MAX_UNKNOWNS] = {0};
    for (int w = 0; w < form->weights; w++)
        push[form->of[w]] += form->weight[w];
    divide_by_masses(scene, push);
    form->pushes = 0;
    for (int i = 0; i < scene->unknowns; i++)
        if (push[i] != 0) {
            form->pushed[form->pushes] = i;
            form->push[form->pushes++] = push[i];
        }
}

real along(const Form *form, const real *unknowns)
{
    real sum = 0;
    for (int w = 0; w < form->weights; w++)
        sum += form->weight[w] * unknowns[form->of[w]];
    return sum;
}

void push(const Form *form, real force, real *unknowns)
{
    for (int p = 0; p < form->pushes; p++)
        unknowns[form->pushed[p]] += form->push[p] * force;
}

real coupling(const Form *a, const Form *b)
{
    real sum = 0;
    for (int w = 0; w < a->weights; w++)
        for (int p = 0; p < b->pushes; p++)
            if (a->of[w] == b->pushed[p])
                sum += a->weight[w] * b->push[p];
    return sum;
}

/* Elimination; the pivots of a positive definite matrix need no search. */
void solve_linear(int n, real a[MAX_CONTACTS][MAX_CONTACTS], real *b)
{
    for (int k = 0; k < n; k++) {
        if (!(a[k][k] > 0))
            fail("contacts whose rows depend on each other are held together: their reactions are not unique");
        for (int i = k + 1; i < n; i++) {
            real factor = a[i][k] / a[k][k];
            for (int j = k + 1; j < n; j++)
                a[i][j] -= factor * a[k][j];
            b[i] -= factor * b[k];
        }
    }
    for (int k = n - 1; k >= 0; k--) {
        for (int j = k + 1; j < n; j++)
            b[k] -= a[k][j] * b[j];
        b[k] /= a[k][k];
    }
}
