/* Reads the lines of a building. Their format is described at the head of reference.c. */
#include "input.h"

#include <math.h>
#include <string.h>

/* m/s2; the nearest double, as in the engine. */
#define STANDARD_GRAVITY 9.80665

/* Adds springs (dashpots) between the floors to K (C). */
static void add_storeys(real matrix[MAX_UNKNOWNS][MAX_UNKNOWNS], int first, int n, const real *storey)
{
    for (int i = 0; i < n; i++) {
        int floor = first + i;
        matrix[floor][floor] += storey[i];
        if (i > 0) {
            matrix[floor - 1][floor - 1] += storey[i];
            matrix[floor][floor - 1] -= storey[i];
            matrix[floor - 1][floor] -= storey[i];
        }
    }
}

/* The name that a line gives to a building; without one it is left, a second one right. */
static void name_building(Scene *scene, int number, const Line *line)
{
    static const char *const names[] = {"left", "right"};
    const char *name = line->count > 2 || number > 1 ? word(line, 2) : names[number];
    for (int b = 0; b < number; b++)
        if (strcmp(scene->building[b].name, name) == 0)
            fail("line %d: a second building '%s'", line->number, name);
    if (strlen(name) >= MAX_NAME || strchr(name, ':'))
        fail("line %d: a name of less than %d characters without ':'", line->number, MAX_NAME);
    strcpy(scene->building[number].name, name);
}

void begin_building(Reader *reader, const Line *line)
{
    Scene *scene = reader->scene;
    int floors = (int)value(line, 1);
    int number = scene->buildings++;
    if (scene->complete || scene->buildings > MAX_BUILDINGS)
        fail("line %d: at most %d buildings, before contacts and links", line->number, MAX_BUILDINGS);
    if (floors < 1 || scene->unknowns + floors > MAX_UNKNOWNS)
        fail("1 to %d floors and ways in which foundations move altogether", MAX_UNKNOWNS);
    *reader = (Reader){.scene = scene, .building = number, .first = scene->unknowns, .floors = floors,
                       .storeys = scene->storeys};
    for (int i = 0; i < floors; i++)
        reader->load[i] = -1;
    scene->building[number] = (Building){.first = scene->unknowns, .floors = floors, .sway = -1, .rocking = -1};
    name_building(scene, number, line);
    scene->unknowns += floors;
}

static void read_damping(Reader *reader, const Line *line)
{
    Scene *scene = reader->scene;
    const char *kind = word(line, 1);
    real numbers[MAX_UNKNOWNS];
    int n = reader->floors;
    if (strcmp(kind, "ratio") == 0) {
        values(line, 2, 1, numbers);
        for (int i = 1; i < n; i++)
            numbers[i] = numbers[0];
        damping_from_ratios(scene, reader->first, n, numbers);
    } else if (strcmp(kind, "ratios") == 0) {
        values(line, 2, n, numbers);
        damping_from_ratios(scene, reader->first, n, numbers);
    } else if (strcmp(kind, "rayleigh") == 0) {
        values(line, 2, 3, numbers);
        int mode_1 = (int)numbers[1], mode_2 = (int)numbers[2];
        if (mode_1 < 1 || mode_1 > n || mode_2 < 1 || mode_2 > n)
            fail("line %d: modes out of range", line->number);
        damping_rayleigh(scene, reader->first, n, numbers[0], mode_1, mode_2);
    } else if (strcmp(kind, "dashpots") == 0) {
        values(line, 2, n, numbers);
        add_storeys(scene->C, reader->first, n, numbers);
    } else {
        fail("line %d: unknown damping '%s'", line->number, kind);
    }
}

/* The storeys of a shear building that have a finite yield force, from the lowest up. */
static void read_yield_forces(Reader *reader, const Line *line)
{
    Scene *scene = reader->scene;
    if (!(reader->stiffness[0] > 0) || scene->storeys > reader->storeys || line->count != 1 + reader->floors)
        fail("line %d: %d yield forces, once, after the stiffness of the storeys", line->number, reader->floors);
    for (int i = 0; i < reader->floors; i++) {
        if (strcmp(word(line, 1 + i), "inf") == 0)
            continue;
        Storey storey = {.building = reader->building, .number = i + 1};
        storey.k = reader->stiffness[i];
        storey.force = value(line, 1 + i);
        if (!(storey.k > 0 && storey.force > 0))
            fail("line %d: a storey that yields needs a stiffness and a yield force > 0", line->number);
        storey.limit = storey.force / storey.k;
        add_weight(&storey.form, reader->first + i, 1);
        if (i > 0)
            add_weight(&storey.form, reader->first + i - 1, -1);
        scene->storey[scene->storeys++] = storey;
    }
}

/* Of all storeys of the building; those that stay elastic need none. */
static void read_post_yield_ratios(Reader *reader, const Line *line)
{
    Scene *scene = reader->scene;
    real ratio[MAX_UNKNOWNS];
    values(line, 1, reader->floors, ratio);
    for (int s = reader->storeys; s < scene->storeys; s++) {
        scene->storey[s].ratio = ratio[scene->storey[s].number - 1];
        if (!(scene->storey[s].ratio >= 0 && scene->storey[s].ratio < 1))
            fail("line %d: a post-yield ratio of at least 0 and less than 1", line->number);
    }
}

/* What gravity takes of the stiffness of each storey, from the weights that floors carry: without a line of these, those
   of their masses. */
static void read_lean(Reader *reader, const Line *line)
{
    Scene *scene = reader->scene;
    real above = 0;
    if (line->count != 1 + reader->floors)
        fail("line %d: %d heights", line->number, reader->floors);
    for (int i = reader->floors - 1; i >= 0; i--) {
        int floor = reader->first + i;
        bool leans = strcmp(word(line, 1 + i), "inf") != 0;
        reader->height[i] = leans ? value(line, 1 + i) : HUGE_VALQ;
        above += reader->load[i] >= 0 ? reader->load[i] : scene->mass[floor] * STANDARD_GRAVITY;
        scene->gravity[floor] = leans ? above / reader->height[i] : 0;
    }
    reader->leans = true;
}

/* A storey that leans and can yield has collapsed where its drift is this share of its height. */
static void read_collapse_drift_ratio(Reader *reader, const Line *line)
{
    Scene *scene = reader->scene;
    real ratio;
    values(line, 1, 1, &ratio);
    if (!reader->leans || scene->storeys == reader->storeys || !(ratio > 0))
        fail("line %d: a ratio > 0, after lean and yield_force", line->number);
    for (int s = reader->storeys; s < scene->storeys; s++) {
        real height = reader->height[scene->storey[s].number - 1];
        scene->storey[s].collapse = isinfq(height) ? 0 : ratio * height;
    }
}

/* One more way in which a foundation moves, with what it weighs there, a spring and a dashpot. */
static int add_way(Scene *scene, real mass, real stiffness, real dashpot, int line)
{
    int unknown = scene->unknowns++;
    if (scene->unknowns > MAX_UNKNOWNS)
        fail("1 to %d floors and ways in which foundations move altogether", MAX_UNKNOWNS);
    if (!(mass > 0 && stiffness > 0 && dashpot >= 0))
        fail("line %d: a mass or inertia and a stiffness > 0 and a dashpot >= 0", line);
    scene->mass[unknown] = mass;
    scene->K[unknown][unknown] = stiffness;
    scene->C[unknown][unknown] = scene->soil[unknown] = dashpot;
    scene->has_foundation = true;
    return unknown;
}

/* sway MASS STIFFNESS DASHPOT, rocking INERTIA STIFFNESS DASHPOT */
static void read_way(Reader *reader, const Line *line)
{
    Building *building = &reader->scene->building[reader->building];
    bool rocks = strcmp(line->word[0], "rocking") == 0;
    int *way = rocks ? &building->rocking : &building->sway;
    real numbers[3];
    if (*way >= 0 || (rocks && !(reader->storey[0] > 0)))
        fail("line %d: once, and rocking after the heights of the storeys", line->number);
    values(line, 1, 3, numbers);
    *way = add_way(reader->scene, numbers[0], numbers[1], numbers[2], line->number);
    for (int i = 0; rocks && i < reader->floors; i++)
        building->level[i] = (i > 0 ? building->level[i - 1] : 0) + reader->storey[i];
}

/* true where the line is about the stiffness, strength or damping of a building. */
static bool read_structure_line(Reader *reader, const Line *line)
{
    Scene *scene = reader->scene;
    const char *key = line->word[0];
    int first = reader->first, n = reader->floors;
    if (strcmp(key, "stiffness") == 0) {
        values(line, 1, n, reader->stiffness);
        add_storeys(scene->K, first, n, reader->stiffness);
    } else if (strcmp(key, "yield_force") == 0) {
        read_yield_forces(reader, line);
    } else if (strcmp(key, "post_yield_ratio") == 0) {
        read_post_yield_ratios(reader, line);
    } else if (strcmp(key, "stiffness_row") == 0) {
        if (reader->stiffness_rows == n)
            fail("line %d: more rows than floors", line->number);
        values(line, 1, n, scene->K[first + reader->stiffness_rows++] + first);
    } else if (strcmp(key, "damping") == 0) {
        read_damping(reader, line);
    } else if (strcmp(key, "damping_row") == 0) {
        if (reader->damping_rows == n)
            fail("line %d: more rows than floors", line->number);
        values(line, 1, n, scene->C[first + reader->damping_rows++] + first);
    } else {
        return false;
    }
    return true;
}

bool read_building_line(Reader *reader, const Line *line)
{
    Scene *scene = reader->scene;
    const char *key = line->word[0];
    int first = reader->first, n = reader->floors;
    if (n == 0 || scene->complete)
        return false;
    if (strcmp(key, "mass") == 0)
        values(line, 1, n, scene->mass + first);
    else if (strcmp(key, "height") == 0)
        values(line, 1, n, reader->storey);
    else if (strcmp(key, "sway") == 0 || strcmp(key, "rocking") == 0)
        read_way(reader, line);
    else if (strcmp(key, "gravity_load") == 0)
        values(line, 1, n, reader->load);
    else if (strcmp(key, "lean") == 0)
        read_lean(reader, line);
    else if (strcmp(key, "collapse_drift_ratio") == 0)
        read_collapse_drift_ratio(reader, line);
    else if (strcmp(key, "displacement") == 0)
        values(line, 1, n, scene->u0 + first);
    else if (strcmp(key, "velocity") == 0)
        values(line, 1, n, scene->v0 + first);
    else
        return read_structure_line(reader, line);
    return true;
}

/* What the motion of the ground moves: foundations that sway and what stands on them, else the floors. */
static void find_ground(Scene *scene)
{
    for (int b = 0; b < scene->buildings; b++) {
        const Building *building = &scene->building[b];
        for (int i = 0; i < building->floors && building->sway < 0; i++)
            scene->carried[building->first + i] = 1;
        if (building->sway >= 0)
            scene->carried[building->sway] = 1;
    }
    absolute(scene, scene->carried, scene->pulled);
    for (int i = 0; i < scene->unknowns; i++)
        scene->pulled[i] *= scene->mass[i];
}

void complete_buildings(Scene *scene)
{
    if (scene->complete)
        return;
    for (int i = 0; i < scene->unknowns; i++)
        if (!(scene->mass[i] > 0))
            fail("every floor needs a mass > 0");
    factor_masses(scene);
    find_ground(scene);
    for (int s = 0; s < scene->storeys; s++)
        find_pushes(scene, &scene->storey[s].form);
    find_leans(scene);
    scene->complete = true;
}
