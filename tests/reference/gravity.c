/* Gravity on storeys that lean (P-delta). A weight P above a storey of height h whose drift is d pushes its floors apart
   with P d / h: one more force, beside that of the columns, which stay what they are. */
#include "reference.h"

/* Drift of the storey below a floor, from displacements; its rate, from velocities. */
static real lean_below(const Scene *scene, int floor, const real *floors)
{
    return floors[floor] - (stands_on_ground(scene, floor) ? 0 : floors[floor - 1]);
}

bool stands_on_ground(const Scene *scene, int floor) { return floor == 0 || floor == scene->left_floors; }

void push_on(const Scene *scene, const real *lean, real *floors)
{
    for (int i = 0; i < scene->floors; i++) {
        if (scene->gravity[i] == 0)
            continue;
        real force = scene->gravity[i] * lean_below(scene, i, lean);
        floors[i] += force / scene->mass[i];
        if (!stands_on_ground(scene, i))
            floors[i - 1] -= force / scene->mass[i - 1];
    }
}

real gravity_energy(const Scene *scene, const real *displacements)
{
    real sum = 0;
    for (int i = 0; i < scene->floors; i++) {
        real lean = lean_below(scene, i, displacements);
        sum -= scene->gravity[i] * lean * lean / 2;
    }
    return sum;
}

real stiffness_under_gravity(const Scene *scene, int i, int j)
{
    if (i != j) {
        int upper = i > j ? i : j, lower = i > j ? j : i;
        bool is_storey = upper == lower + 1 && !stands_on_ground(scene, upper);
        return scene->K[i][j] + (is_storey ? scene->gravity[upper] : 0);
    }
    bool has_storey_above = i + 1 < scene->floors && !stands_on_ground(scene, i + 1);
    return scene->K[i][i] - scene->gravity[i] - (has_storey_above ? scene->gravity[i + 1] : 0);
}
