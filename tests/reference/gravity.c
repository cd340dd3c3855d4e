/* Gravity on storeys that lean (P-delta). A weight P above a storey of height h whose floors have moved apart by d pushes
   them apart with P d / h: one more force, beside that of the columns, which stay what they are. A storey whose foundation
   has turned leans with it. */
#include "reference.h"

static bool is_lowest(const Scene *scene, int floor)
{
    for (int b = 0; b < scene->buildings; b++)
        if (floor == scene->building[b].first)
            return true;
    return false;
}

void find_leans(Scene *scene)
{
    for (int b = 0; b < scene->buildings; b++)
        for (int i = 0; i < scene->building[b].floors; i++) {
            real stiffness = scene->gravity[scene->building[b].first + i];
            if (stiffness == 0)
                continue;
            Lean *lean = &scene->lean[scene->leans++];
            const Building *of = &scene->building[b];
            lean->stiffness = stiffness;
            add_weight(&lean->form, of->first + i, 1);
            if (i > 0)
                add_weight(&lean->form, of->first + i - 1, -1);
            if (of->rocking >= 0)
                add_weight(&lean->form, of->rocking, of->level[i] - (i > 0 ? of->level[i - 1] : 0));
            find_pushes(scene, &lean->form);
        }
}

void push_on(const Scene *scene, const real *lean, real *unknowns)
{
    for (const Lean *of = scene->lean; of < scene->lean + scene->leans; of++)
        push(&of->form, of->stiffness * along(&of->form, lean), unknowns);
}

real gravity_energy(const Scene *scene, const real *displacements)
{
    real sum = 0;
    for (const Lean *of = scene->lean; of < scene->lean + scene->leans; of++) {
        real lean = along(&of->form, displacements);
        sum -= of->stiffness * lean * lean / 2;
    }
    return sum;
}

real stiffness_under_gravity(const Scene *scene, int i, int j)
{
    if (i != j) {
        int upper = i > j ? i : j, lower = i > j ? j : i;
        bool is_storey = upper == lower + 1 && !is_lowest(scene, upper);
        return scene->K[i][j] + (is_storey ? scene->gravity[upper] : 0);
    }
    bool has_storey_above = i + 1 < scene->unknowns && !is_lowest(scene, i + 1);
    return scene->K[i][i] - scene->gravity[i] - (has_storey_above ? scene->gravity[i + 1] : 0);
}
