/* One solution: where steps stop, how the run starts, what is written down. */
#include "reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* ---- times at which steps stop ---- */

typedef struct {
    double time;
    bool output;
} Stop;

static int by_time(const void *a, const void *b)
{
    double x = ((const Stop *)a)->time, y = ((const Stop *)b)->time;
    return (x > y) - (x < y);
}

/* Record samples, multiples of the output step and the end; one entry per time. */
static Stop *list_stops(const Scene *scene, int *count)
{
    int outputs = (int)(scene->stop / scene->output_step * (1 - 1e-12)) + 1, n = 0;
    Stop *stops = malloc((outputs + scene->record.count + 1) * sizeof *stops);
    for (int k = 1; k < outputs; k++)
        stops[n++] = (Stop){k * scene->output_step, true};
    stops[n++] = (Stop){scene->stop, true};
    for (int i = 0; i < scene->record.count; i++)
        if (scene->record.time[i] > 0 && scene->record.time[i] < scene->stop)
            stops[n++] = (Stop){(double)scene->record.time[i], false};
    qsort(stops, n, sizeof *stops, by_time);
    *count = 0;
    for (int i = 0; i < n; i++) {
        if (*count > 0 && stops[*count - 1].time == stops[i].time)
            stops[*count - 1].output |= stops[i].output;
        else
            stops[(*count)++] = stops[i];
    }
    return stops;
}

/* The piece of the record that begins at or before t; no motion outside the record. */
static void set_segment(Run *run, real t)
{
    const Record *record = &run->scene->record;
    int i = 0;
    while (i < record->count && record->time[i] <= t)
        i++;
    Solver *solver = &run->solver;
    solver->segment_time = t;
    solver->segment_ground = solver->segment_slope = 0;
    if (i > 0 && i < record->count) {
        solver->segment_time = record->time[i - 1];
        solver->segment_ground = record->acceleration[i - 1];
        solver->segment_slope =
            (record->acceleration[i] - record->acceleration[i - 1]) / (record->time[i] - record->time[i - 1]);
    }
}

/* ---- start ---- */

static void start_scales(Run *run)
{
    const Scene *scene = run->scene;
    real w = 0, pga = 0, u = 0;
    for (int i = 0; i < scene->unknowns; i++) {
        w = fmaxq(w, sqrtq(fabsq(run->solver.k_over_m[i][i])));
        u = fmaxq(u, fabsq(scene->u0[i]));
    }
    for (int i = 0; i < scene->record.count; i++)
        pga = fmaxq(pga, fabsq(scene->record.acceleration[i]));
    run->solver.v_scale = fmaxq(u * w, pga / 1000);
    for (int c = 0; c < scene->contacts; c++)
        run->solver.v_scale = fmaxq(run->solver.v_scale, -scene->contact[c].gap * w);
    update_scales(run);
    if (run->solver.v_scale == 0)
        run->solver.v_scale = 1;
    run->solver.u_scale = fmaxq(run->solver.u_scale, run->solver.v_scale / (w + 1));
}

/* The account at the present time. */
static Energy energy_now(const Run *run)
{
    const Scene *scene = run->scene;
    Energy energy = run->energy;
    real speed[MAX_UNKNOWNS];
    absolute(scene, run->now.v, speed);
    energy.kinetic = energy.strain = 0;
    for (int i = 0; i < scene->unknowns; i++) {
        energy.kinetic += scene->mass[i] * speed[i] * speed[i] / 2;
        for (int j = 0; j < scene->unknowns; j++)
            energy.strain += run->now.u[i] * scene->K[i][j] * run->now.u[j] / 2;
    }
    energy.strain += recoverable_change(run);
    energy.hysteretic = hysteretic_energy(run);
    energy.gravity = gravity_energy(scene, run->now.u);
    return energy;
}

static void start(Run *run)
{
    const Scene *scene = run->scene;
    Point *p = &run->now;
    memcpy(p->u, scene->u0, sizeof p->u);
    memcpy(p->v, scene->v0, sizeof p->v);
    set_segment(run, 0);
    start_scales(run);
    for (int c = 0; c < scene->contacts; c++) {
        const Contact *contact = &scene->contact[c];
        p->d[c] = along(&contact->form, p->u) - contact->gap;
        run->solution->episodes.current[c] = -1;
    }
    start_storeys(run);
    complete_point(&run->solver, p);
    close_at_start(run);
    complete_point(&run->solver, p);
    Energy energy = energy_now(run);
    run->initial_energy = energy.kinetic + energy.strain + energy.gravity;
}

static void write_row(Run *run)
{
    Row *row = &run->solution->row[run->solution->rows++];
    row->time = run->now.t;
    absolute(run->scene, run->now.u, row->u);
    absolute(run->scene, run->now.v, row->v);
    Energy *e = &row->energy;
    *e = energy_now(run);
    for (int s = 0; s < run->scene->storeys; s++)
        row->storey[s] = storey_row(run, s);
    real error = run->initial_energy + e->input - e->kinetic - e->strain - e->gravity - e->viscous - e->impact -
                 e->hysteretic;
    real largest = fmaxq(fmaxq(fabsq(e->input), e->kinetic), fmaxq(fmaxq(e->strain, e->viscous), fabsq(e->impact)));
    largest = fmaxq(largest, fmaxq(e->hysteretic, -e->gravity));
    if (largest > 0)
        run->solution->energy_residual = fmax(run->solution->energy_residual, (double)fabsq(error / largest));
}

void solve(const Scene *scene, int stages, real tolerance, Solution *solution)
{
    clock_t began = clock();
    int count;
    Stop *stops = list_stops(scene, &count);
    Run *run = calloc(1, sizeof *run);
    *solution = (Solution){.stages = stages, .tolerance = tolerance};
    solution->row = calloc(count + 1, sizeof *solution->row);
    run->scene = scene;
    run->solution = solution;
    run->tolerance = tolerance;
    run->H_open = run->H_closed = scene->stop;
    prepare_solver(&run->solver, scene, stages);
    start(run);
    write_row(run);
    for (int i = 0; i < count && !run->solver.phases.collapsed; i++) {
        set_segment(run, run->now.t);
        complete_point(&run->solver, &run->now);
        advance(run, stops[i].time);
        if (stops[i].output || run->solver.phases.collapsed)
            write_row(run);
    }
    solution->steps = run->solver.steps;
    solution->rejected = run->solver.rejected;
    solution->iterations = run->solver.iterations;
    solution->seconds = (double)(clock() - began) / CLOCKS_PER_SEC;
    free(run);
    free(stops);
}
