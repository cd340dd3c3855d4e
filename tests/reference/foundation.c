/* Floors on foundations that sway and rock. The unknowns of the floors are relative to the moving, rocking foundation, as
   textbooks have them: stiffness and damping are those of a building on a base that does not move, and what couples floors
   and foundation is the mass matrix, which is full. */
#include "reference.h"

void add_rigid(const Scene *scene, Form *form, int building, real level, real weight)
{
    const Building *of = &scene->building[building];
    if (of->sway >= 0)
        add_weight(form, of->sway, weight);
    if (of->rocking >= 0 && level != 0)
        add_weight(form, of->rocking, weight * level);
}

void add_floor(const Scene *scene, Form *form, int building, int floor, real weight)
{
    const Building *of = &scene->building[building];
    if (floor > 0)
        add_weight(form, of->first + floor - 1, weight);
    add_rigid(scene, form, building, floor > 0 ? of->level[floor - 1] : 0, weight);
}

/* Adds mass times velocity^2 / 2 of a form to the kinetic energy's matrix. */
static void add_mass(Scene *scene, const Form *form, real mass)
{
    for (int i = 0; i < form->weights; i++)
        for (int j = 0; j < form->weights; j++)
            scene->factor[form->of[i]][form->of[j]] += form->weight[i] * form->weight[j] * mass;
}

static void form_mass_matrix(Scene *scene)
{
    for (int b = 0; b < scene->buildings; b++) {
        const Building *building = &scene->building[b];
        for (int i = 0; i < building->floors; i++) {
            Form floor = {.weights = 0};
            add_floor(scene, &floor, b, i + 1, 1);
            add_mass(scene, &floor, scene->mass[building->first + i]);
        }
        if (building->sway >= 0)
            scene->factor[building->sway][building->sway] += scene->mass[building->sway];
        if (building->rocking >= 0)
            scene->factor[building->rocking][building->rocking] += scene->mass[building->rocking];
    }
}

void factor_masses(Scene *scene)
{
    form_mass_matrix(scene);
    int n = scene->unknowns;
    for (int k = 0; k < n; k++)
        for (int i = k + 1; i < n; i++) {
            real share = scene->factor[i][k] / scene->factor[k][k];
            for (int j = k + 1; j <= i; j++)
                scene->factor[i][j] -= share * scene->factor[j][k];
        }
    for (int k = 0; k < n; k++)
        for (int i = k + 1; i < n; i++)
            scene->factor[i][k] /= scene->factor[k][k];
}

void divide_by_masses(const Scene *scene, real *unknowns)
{
    int n = scene->unknowns;
    for (int i = 0; i < n; i++)
        for (int k = 0; k < i; k++)
            unknowns[i] -= scene->factor[i][k] * unknowns[k];
    for (int i = 0; i < n; i++)
        unknowns[i] /= scene->factor[i][i];
    for (int i = n - 1; i >= 0; i--)
        for (int k = i + 1; k < n; k++)
            unknowns[i] -= scene->factor[k][i] * unknowns[k];
}

void absolute(const Scene *scene, const real *unknowns, real *out)
{
    for (int i = 0; i < scene->unknowns; i++)
        out[i] = unknowns[i];
    for (int b = 0; b < scene->buildings; b++) {
        const Building *of = &scene->building[b];
        for (int i = 0; i < of->floors; i++) {
            if (of->sway >= 0)
                out[of->first + i] += unknowns[of->sway];
            if (of->rocking >= 0)
                out[of->first + i] += of->level[i] * unknowns[of->rocking];
        }
    }
}
