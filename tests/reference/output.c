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
static void write_header(FILE *file, const char *made_by, const Solution *best, const Proof *proof)
{
    fprintf(file, "# made by: %s\n", made_by);
    describe(file, best);
    if (proof) {
        describe(file, &proof->second);
        fprintf(file,
                "# the two agree: displacements to %.1e of the largest, velocities to %.1e, impact times to %.1e s%s\n",
                proof->u, proof->v, proof->time, proof->same_impacts ? "" : "; IMPACTS DIFFER");
        fprintf(file, "# sensitivity of the displacements to record and initial state: %.1e\n",
                proof->sensitivity[best->rows - 1]);
    }
}

static void write_columns(FILE *file, const Scene *scene, const char *quantity)
{
    for (int i = 0; i < scene->floors; i++) {
        bool left = i < scene->left_floors;
        fprintf(file, ",%s.%s[%d]", left ? "left" : "right", quantity, 1 + (left ? i : i - scene->left_floors));
    }
}

static void write_displacements(FILE *file, const Scene *scene, const Solution *s, const Proof *proof)
{
    fprintf(file, "time");
    write_columns(file, scene, "displacement");
    write_columns(file, scene, "velocity");
    fprintf(file, ",energy.input,energy.kinetic,energy.strain,energy.viscous,energy.impact%s\n",
            proof ? ",sensitivity" : "");
    for (int r = 0; r < s->rows; r++) {
        const Row *row = &s->row[r];
        fprintf(file, "%.17g", (double)row->time);
        for (int i = 0; i < scene->floors; i++)
            put(file, row->u[i]);
        for (int i = 0; i < scene->floors; i++)
            put(file, row->v[i]);
        put(file, row->energy.input);
        put(file, row->energy.kinetic);
        put(file, row->energy.strain);
        put(file, row->energy.viscous);
        put(file, row->energy.impact);
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

void print_run(const Solution *s)
{
    printf("%d stages, tolerance %.0e: %d impacts, %ld steps, %ld rejected, %ld iterations, ", s->stages,
           (double)s->tolerance, s->episodes.count, s->steps, s->rejected, s->iterations);
    printf("energy balance %.1e, %.2f s\n", s->energy_residual, s->seconds);
}

void write_files(const char *output, const char *made_by, const Scene *scene, const Solution *best, const Proof *proof)
{
    FILE *displacements = create(output, "displacements"), *impacts = create(output, "impacts");
    write_header(displacements, made_by, best, proof);
    write_displacements(displacements, scene, best, proof);
    write_header(impacts, made_by, best, proof);
    write_impacts(impacts, best);
    bool written = !ferror(displacements) && !ferror(impacts);
    if (fclose(displacements) || fclose(impacts) || !written)
        fail("cannot write %s", output);
}
