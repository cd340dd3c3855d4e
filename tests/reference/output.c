/* The CSV files. */
#include "reference.h"

#include <stdio.h>

static FILE *create(const char *output, const char *kind)
{
    char path[4096];
    snprintf(path, sizeof path, "%s.%s.csv", output, kind);
    FILE *file = fopen(path, "w");
    if (!file)
        fail("cannot write %s", path);
    return file;
}

static void put(FILE *file, real x)
{
    char text[64];
    quadmath_snprintf(text, sizeof text, "%.25Qg", x);
    fprintf(file, ",%s", text);
}

static void describe(FILE *file, const Solution *s)
{
    fprintf(file, "# %d stages, tolerance %.0e: %d impacts, energy balance closes to %.1e\n", s->stages,
            (double)s->tolerance, s->episodes.count, s->energy_residual);
}

/* proof: NULL without one. */
static void write_header(FILE *file, const char *made_by, const Scene *scene, const Solution *best,
                         const Proof *proof)
{
    fprintf(file, "# made by: %s\n", made_by);
    describe(file, best);
    if (proof) {
        describe(file, &proof->second);
        fprintf(file,
                "# the two agree: displacements to %.1e of the largest, velocities to %.1e, impact times to %.1e s%s\n",
                proof->u, proof->v, proof->time, proof->same_impacts ? "" : "; IMPACTS DIFFER");
        if (scene->storeys)
            fprintf(file, "# plastic drifts to %.1e of the largest, yields and turns to %.1e s%s\n", proof->plastic,
                    proof->yield_time, proof->same_yields ? "" : "; YIELDS DIFFER");
        fprintf(file, "# sensitivity of the displacements to record and initial state: %.1e\n",
                proof->sensitivity[best->rows - 1]);
    }
}

static const char *place(const Scene *scene, const Storey *storey)
{
    return storey->building == LINK ? "link" : scene->building[storey->building].name;
}

/* Of floors and foundations, in the order of the unknowns; the ways in which these move have names of their own. */
static void write_columns(FILE *file, const Scene *scene, const char *of_floor, const char *of_sway, const char *of_rocking)
{
    for (int i = 0; i < scene->unknowns; i++)
        for (int b = 0; b < scene->buildings; b++) {
            const Building *building = &scene->building[b];
            int floor = i - building->first;
            if (floor >= 0 && floor < building->floors)
                fprintf(file, ",%s.%s[%d]", building->name, of_floor, 1 + floor);
            else if (i == building->sway || i == building->rocking)
                fprintf(file, ",%s.foundation.%s", building->name, i == building->sway ? of_sway : of_rocking);
        }
}

static void write_displacements(FILE *file, const Scene *scene, const Solution *s, const Proof *proof)
{
    fprintf(file, "time");
    write_columns(file, scene, "displacement", "displacement", "rotation");
    write_columns(file, scene, "velocity", "velocity", "rotation_rate");
    fprintf(file, ",energy.input,energy.kinetic,energy.strain,energy.viscous,energy.impact%s%s%s%s\n",
            scene->storeys ? ",energy.hysteretic" : "", scene->leans ? ",energy.gravity" : "",
            scene->has_foundation ? ",energy.soil" : "", proof ? ",sensitivity" : "");
    for (int r = 0; r < s->rows; r++) {
        const Row *row = &s->row[r];
        fprintf(file, "%.17g", (double)row->time);
        for (int i = 0; i < scene->unknowns; i++)
            put(file, row->u[i]);
        for (int i = 0; i < scene->unknowns; i++)
            put(file, row->v[i]);
        put(file, row->energy.input);
        put(file, row->energy.kinetic);
        put(file, row->energy.strain);
        put(file, row->energy.viscous);
        put(file, row->energy.impact);
        if (scene->storeys)
            put(file, row->energy.hysteretic);
        if (scene->leans)
            put(file, row->energy.gravity);
        if (scene->has_foundation)
            put(file, row->energy.soil);
        if (proof)
            fprintf(file, ",%.2e", proof->sensitivity[r]);
        fprintf(file, "\n");
    }
}

static void write_impacts(FILE *file, const Solution *s)
{
    fprintf(file, "contact,start_s,end_s,approach_velocity,separation_velocity,peak_force,peak_time_s,"
                  "peak_penetration,impulse,dissipated_energy\n");
    for (int i = 0; i < s->episodes.count; i++) {
        const Episode *e = &s->episodes.list[i];
        fprintf(file, "%d", e->contact + 1);
        put(file, e->start);
        if (e->open)
            fprintf(file, ",");
        else
            put(file, e->end);
        put(file, e->approach_velocity);
        if (e->open)
            fprintf(file, ",");
        else
            put(file, e->separation_velocity);
        put(file, e->peak_force);
        put(file, e->peak_time);
        put(file, e->peak_penetration);
        put(file, e->impulse);
        put(file, e->dissipated);
        fprintf(file, "\n");
    }
}

static void write_storeys(FILE *file, const Scene *scene, const Solution *solution)
{
    static const char *const quantities[] = {"storey_shear", "plastic_drift", "cumulative_plastic_drift",
                                             "hysteretic_energy", "ductility", "yielding"};
    fprintf(file, "time");
    for (int q = 0; q < 6; q++)
        for (int s = 0; s < scene->storeys; s++)
            fprintf(file, ",%s.%s[%d]", place(scene, &scene->storey[s]), quantities[q], scene->storey[s].number);
    fprintf(file, "\n");
    for (const Row *row = solution->row; row < solution->row + solution->rows; row++) {
        fprintf(file, "%.17g", (double)row->time);
        for (int q = 0; q < 6; q++)
            for (int s = 0; s < scene->storeys; s++) {
                const Storey *storey = &scene->storey[s];
                const StoreyRow *of = &row->storey[s];
                real energy = (1 - storey->ratio) * storey->force * of->cumulative;
                put(file, (real[]){of->shear, of->plastic, of->cumulative, energy, of->peak / storey->limit,
                                   of->yielding}[q]);
            }
        fprintf(file, "\n");
    }
}

static void write_yields(FILE *file, const Scene *scene, const Solution *solution)
{
    static const char *const kinds[] = {"collapses -", "yields -", "unloads", "yields +", "collapses +"};
    fprintf(file, "building,storey,kind,time_s,drift_m,plastic_drift_m,drift_rate_m_s\n");
    for (const Switch *at = solution->switched; at < solution->switched + solution->switches; at++) {
        const Storey *storey = &scene->storey[at->storey];
        fprintf(file, "%s,%d,%s", place(scene, storey), storey->number, kinds[at->direction + 2]);
        put(file, at->time);
        put(file, at->drift);
        put(file, at->plastic);
        put(file, at->rate);
        fprintf(file, "\n");
    }
}

void print_run(const Solution *s)
{
    printf("%d stages, tolerance %.0e: %d impacts, %ld steps, %ld rejected, %ld iterations, ", s->stages,
           (double)s->tolerance, s->episodes.count, s->steps, s->rejected, s->iterations);
    printf("energy balance %.1e, %.2f s\n", s->energy_residual, s->seconds);
}

void write_files(const char *output, const char *made_by, const Scene *scene, const Solution *best, const Proof *proof)
{
    static const char *const kinds[] = {"displacements", "impacts", "storeys", "yields"};
    for (int i = 0; i < (scene->storeys ? 4 : 2); i++) {
        FILE *file = create(output, kinds[i]);
        write_header(file, made_by, scene, best, proof);
        if (i == 0)
            write_displacements(file, scene, best, proof);
        else if (i == 1)
            write_impacts(file, best);
        else if (i == 2)
            write_storeys(file, scene, best);
        else
            write_yields(file, scene, best);
        bool written = !ferror(file);
        if (fclose(file) || !written)
            fail("cannot write %s", output);
    }
}
