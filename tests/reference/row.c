/* Contacts as rows of weights over the floors of both buildings. */
#include "reference.h"

void add_weight(Contact *contact, int floor, real weight)
{
    if (contact->weights == MAX_WEIGHTS)
        fail("a contact of more than %d floors", MAX_WEIGHTS);
    contact->floor[contact->weights] = floor;
    contact->weight[contact->weights++] = weight;
}

real reduced_mass(const Scene *scene, const Contact *contact) { return 1 / coupling(scene, contact, contact); }

real along(const Contact *contact, const real *floors)
{
    real sum = 0;
    for (int w = 0; w < contact->weights; w++)
        sum += contact->weight[w] * floors[contact->floor[w]];
    return sum;
}

void push_apart(const Scene *scene, const Contact *contact, real force, real *floors)
{
    for (int w = 0; w < contact->weights; w++)
        floors[contact->floor[w]] -= contact->weight[w] * force / scene->mass[contact->floor[w]];
}

real coupling(const Scene *scene, const Contact *a, const Contact *b)
{
    real sum = 0;
    for (int i = 0; i < a->weights; i++)
        for (int j = 0; j < b->weights; j++)
            if (a->floor[i] == b->floor[j])
                sum += a->weight[i] * b->weight[j] / scene->mass[a->floor[i]];
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
