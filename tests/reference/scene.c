/* Reads the input file. Its format is described at the head of reference.c. */
#include "reference.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void fail(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fprintf(stderr, "reference: ");
    vfprintf(stderr, format, arguments);
    fprintf(stderr, "\n");
    va_end(arguments);
    exit(1);
}

/* ---- words and numbers of a line ---- */

enum { MAX_WORDS = 256, MAX_LINE = 8192 };

typedef struct {
    int number, count;
    char text[MAX_LINE], *word[MAX_WORDS];
} Line;

static bool next_line(FILE *file, Line *line)
{
    while (fgets(line->text, MAX_LINE, file)) {
        line->number++;
        char *comment = strchr(line->text, '#');
        if (comment)
            *comment = '\0';
        line->count = 0;
        for (char *word = strtok(line->text, " \t\r\n"); word; word = strtok(NULL, " \t\r\n")) {
            if (line->count == MAX_WORDS)
                fail("line %d: too many words", line->number);
            line->word[line->count++] = word;
        }
        if (line->count > 0)
            return true;
    }
    return false;
}

/* A decimal number becomes the nearest double, as in the engine, and is exact from there on. */
static double number(const char *text, const char *where, int line)
{
    char *end;
    double x = strtod(text, &end);
    if (end == text || *end || !isfinite(x))
        fail("%s, line %d: '%s' is not a finite number", where, line, text);
    return x;
}

static const char *word(const Line *line, int i)
{
    if (i >= line->count)
        fail("line %d: '%s' wants more words", line->number, line->word[0]);
    return line->word[i];
}

static double value(const Line *line, int i) { return number(word(line, i), "input", line->number); }

static void values(const Line *line, int from, int n, real *out)
{
    if (line->count != from + n)
        fail("line %d: '%s' wants %d numbers", line->number, line->word[0], n);
    for (int i = 0; i < n; i++)
        out[i] = value(line, from + i);
}

/* ---- record ---- */

static void read_record(const char *path, Record *record)
{
    FILE *file = fopen(path, "r");
    if (!file)
        fail("cannot open the record %s", path);
    int capacity = 0, line_number = 0;
    char line[512];
    while (fgets(line, sizeof line, file)) {
        line_number++;
        line[strcspn(line, "\r\n")] = '\0';
        char *comma = strchr(line, ',');
        if (line[0] == '#' || line[0] == '\0' || strncmp(line, "time_s", 6) == 0)
            continue;
        if (!comma)
            fail("%s, line %d: expected time_s,accel_m_s2", path, line_number);
        *comma = '\0';
        if (record->count == capacity) {
            capacity = capacity ? 2 * capacity : 4096;
            record->time = realloc(record->time, capacity * sizeof(real));
            record->acceleration = realloc(record->acceleration, capacity * sizeof(real));
        }
        record->time[record->count] = number(line, path, line_number);
        record->acceleration[record->count] = number(comma + 1, path, line_number);
        if (record->count > 0 && record->time[record->count] <= record->time[record->count - 1])
            fail("%s, line %d: times must increase", path, line_number);
        record->count++;
    }
    fclose(file);
    if (record->count < 2)
        fail("%s: fewer than two samples", path);
}

static void scale_record(Record *record, real scale, real pga)
{
    if (pga > 0) {
        real peak = 0;
        for (int i = 0; i < record->count; i++)
            peak = fmaxq(peak, fabsq(record->acceleration[i]));
        scale = pga / peak;
    }
    for (int i = 0; i < record->count; i++)
        record->acceleration[i] *= scale;
}

/* ---- buildings ---- */

/* m/s2; the nearest double, as in the engine. */
#define STANDARD_GRAVITY 9.80665

typedef struct {
    Scene *scene;
    int first, floors; /* the building that is being read */
    int stiffness_rows, damping_rows;
    real stiffness[MAX_FLOORS]; /* of its storeys, in a shear building */
    real height[MAX_FLOORS];    /* of its storeys that gravity pushes on; infinite: not this one */
    bool leans;                 /* whether heights have been read */
    real load[MAX_FLOORS];      /* N, weights of its floors; below 0: those of their masses */
    int storeys;                /* of all buildings that can yield, those of this one left out */
} Reader;

/* Adds springs (dashpots) between the floors to K (C). */
static void add_storeys(real matrix[MAX_FLOORS][MAX_FLOORS], int first, int n, const real *storey)
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

static void begin_building(Reader *reader, int floors)
{
    Scene *scene = reader->scene;
    if (floors < 1 || scene->floors + floors > MAX_FLOORS)
        fail("1 to %d floors altogether", MAX_FLOORS);
    reader->first = scene->floors;
    reader->floors = floors;
    reader->stiffness_rows = reader->damping_rows = 0;
    reader->stiffness[0] = 0;
    reader->leans = false;
    for (int i = 0; i < floors; i++)
        reader->load[i] = -1;
    reader->storeys = scene->storeys;
    scene->floors += floors;
    if (reader->first == 0)
        scene->left_floors = floors;
    else
        scene->right_floors = floors;
}

static void read_damping(Reader *reader, const Line *line)
{
    Scene *scene = reader->scene;
    const char *kind = word(line, 1);
    real numbers[MAX_FLOORS];
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
        Storey storey = {.above = reader->first + i, .below = i > 0 ? reader->first + i - 1 : -1,
                         .k = reader->stiffness[i], .force = value(line, 1 + i)};
        if (!(storey.k > 0 && storey.force > 0))
            fail("line %d: a storey that yields needs a stiffness and a yield force > 0", line->number);
        storey.limit = storey.force / storey.k;
        scene->storey[scene->storeys++] = storey;
    }
}

/* Of all storeys of the building; those that stay elastic need none. */
static void read_post_yield_ratios(Reader *reader, const Line *line)
{
    Scene *scene = reader->scene;
    real ratio[MAX_FLOORS];
    values(line, 1, reader->floors, ratio);
    for (int s = reader->storeys; s < scene->storeys; s++) {
        scene->storey[s].ratio = ratio[scene->storey[s].above - reader->first];
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
        scene->has_gravity = scene->has_gravity || leans;
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
        real height = reader->height[scene->storey[s].above - reader->first];
        scene->storey[s].collapse = isinfq(height) ? 0 : ratio * height;
    }
}

/* true where the line is one of a building. */
static bool read_building_line(Reader *reader, const Line *line)
{
    Scene *scene = reader->scene;
    const char *key = line->word[0];
    int first = reader->first, n = reader->floors;
    if (n == 0)
        return false;
    if (strcmp(key, "mass") == 0) {
        values(line, 1, n, scene->mass + first);
    } else if (strcmp(key, "stiffness") == 0) {
        values(line, 1, n, reader->stiffness);
        add_storeys(scene->K, first, n, reader->stiffness);
    } else if (strcmp(key, "yield_force") == 0) {
        read_yield_forces(reader, line);
    } else if (strcmp(key, "post_yield_ratio") == 0) {
        read_post_yield_ratios(reader, line);
    } else if (strcmp(key, "gravity_load") == 0) {
        values(line, 1, n, reader->load);
    } else if (strcmp(key, "lean") == 0) {
        read_lean(reader, line);
    } else if (strcmp(key, "collapse_drift_ratio") == 0) {
        read_collapse_drift_ratio(reader, line);
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
    } else if (strcmp(key, "displacement") == 0) {
        values(line, 1, n, scene->u0 + first);
    } else if (strcmp(key, "velocity") == 0) {
        values(line, 1, n, scene->v0 + first);
    } else {
        return false;
    }
    return true;
}

/* ---- contacts ---- */

static LawKind law_kind(const char *name, int line)
{
    static const char *const names[] = {"linear", "kelvin_voigt",  "kelvin_voigt_no_tension", "hertz",
                                        "jankowski", "hertz_damped", "stereomechanical"};
    for (unsigned i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(name, names[i]) == 0)
            return (LawKind)i;
    fail("line %d: unknown law '%s'", line, name);
}

/* The first floor of a building and, in `floors`, their number; 0: left, 1: right. */
static int first_floor(const Scene *scene, int building, int *floors)
{
    *floors = building ? scene->right_floors : scene->left_floors;
    return building ? scene->left_floors : 0;
}

static void add_floor(const Scene *scene, Contact *contact, int building, int number, real weight, int line)
{
    int floors, first = first_floor(scene, building, &floors);
    if (number < 1 || number > floors)
        fail("line %d: no such floor", line);
    add_weight(contact, first + number - 1, weight);
}

/* columns:STOREY:POSITION:SHAPE: the columns move as the floors below and above do, in shares 1 - N and N. */
static void add_columns(const Scene *scene, Contact *contact, int building, const char *place, real sign, int line)
{
    int storey;
    char position[64], shape[16];
    if (sscanf(place, "columns:%d:%63[^:]:%15s", &storey, position, shape) != 3)
        fail("line %d: '%s' not understood", line, place);
    real s = number(position, "input", line), N = strcmp(shape, "straight") == 0 ? s : s * s * (3 - 2 * s);
    if (!(s > 0 && s < 1) || (strcmp(shape, "straight") != 0 && strcmp(shape, "fixed") != 0))
        fail("line %d: '%s': a position between 0 and 1, fixed or straight", line, place);
    if (storey > 1) /* the first storey stands on the ground */
        add_floor(scene, contact, building, storey - 1, sign * (1 - N), line);
    add_floor(scene, contact, building, storey, sign * N, line);
}

/* What is on the left (0) or right (1) of a contact. */
static void add_place(const Scene *scene, Contact *contact, int side, const char *place, int line)
{
    real sign = side ? -1 : 1;
    if (strcmp(place, "wall") == 0)
        return;
    if (strncmp(place, "columns:", 8) == 0)
        add_columns(scene, contact, side, place, sign, line);
    else if (strncmp(place, "left:", 5) == 0)
        add_floor(scene, contact, 0, (int)number(place + 5, "input", line), sign, line);
    else if (strncmp(place, "right:", 6) == 0)
        add_floor(scene, contact, 1, (int)number(place + 6, "input", line), sign, line);
    else
        add_floor(scene, contact, side, (int)number(place, "input", line), sign, line);
}

/* contact LEFT RIGHT GAP LAW [key value ...] */
static void read_contact(Scene *scene, const Line *line)
{
    if (scene->contacts == MAX_CONTACTS)
        fail("at most %d contacts", MAX_CONTACTS);
    Contact *contact = &scene->contact[scene->contacts++];
    *contact = (Contact){.weights = 0};
    for (int side = 0; side < 2; side++)
        add_place(scene, contact, side, word(line, 1 + side), line->number);
    if (contact->weights == 0)
        fail("line %d: a wall needs a floor", line->number);
    contact->gap = value(line, 3);
    contact->law = (Law){.kind = law_kind(word(line, 4), line->number), .n = 1, .e = 1};
    if (contact->law.kind == HERTZ || contact->law.kind == HERTZ_DAMPED)
        contact->law.n = 1.5Q;
    const char *formula = NULL;
    for (int i = 5; i < line->count; i += 2) {
        const char *key = line->word[i];
        if (strcmp(key, "stiffness") == 0)
            contact->law.k = value(line, i + 1);
        else if (strcmp(key, "exponent") == 0)
            contact->law.n = value(line, i + 1);
        else if (strcmp(key, "restitution") == 0)
            contact->law.e = value(line, i + 1);
        else if (strcmp(key, "damping_formula") == 0)
            formula = word(line, i + 1);
        else
            fail("line %d: unknown key '%s'", line->number, key);
    }
    contact->mass = reduced_mass(scene, contact);
    prepare_law(&contact->law, contact->mass, formula);
}

/* ---- links ---- */

/* Where the spring of a link slips: its floors are a storey that lies between the buildings. */
static void add_slip(Scene *scene, const Contact *ends, const Storey *slip, int line)
{
    if (ends->weight[0] < 0 || !(slip->k > 0 && slip->force > 0 && slip->ratio >= 0 && slip->ratio < 1))
        fail("line %d: what slips needs a floor on its left, stiffness > 0, slip_force > 0 and 0 <= ratio < 1", line);
    if (scene->storeys == MAX_FLOORS)
        fail("line %d: at most %d storeys and links that yield or slip", line, MAX_FLOORS);
    Storey *storey = &scene->storey[scene->storeys++];
    *storey = *slip;
    storey->limit = slip->force / slip->k;
    storey->above = ends->floor[0];
    storey->below = ends->weights > 1 ? ends->floor[1] : -1;
}

/* link LEFT RIGHT [key value ...] */
static void read_link(Scene *scene, const Line *line)
{
    Contact ends = {.weights = 0};
    Storey slip = {.link = ++scene->links};
    real dashpot = 0;
    bool slips = false;
    for (int side = 0; side < 2; side++)
        add_place(scene, &ends, side, word(line, 1 + side), line->number);
    if (ends.weights == 0)
        fail("line %d: a wall needs a floor", line->number);
    for (int i = 3; i < line->count; i += 2) {
        const char *key = line->word[i];
        if (strcmp(key, "stiffness") == 0)
            slip.k = value(line, i + 1);
        else if (strcmp(key, "dashpot") == 0)
            dashpot = value(line, i + 1);
        else if (strcmp(key, "slip_force") == 0)
            slip.force = value(line, i + 1), slips = true;
        else if (strcmp(key, "post_yield_ratio") == 0)
            slip.ratio = value(line, i + 1);
        else
            fail("line %d: unknown key '%s'", line->number, key);
    }
    for (int i = 0; i < ends.weights; i++)
        for (int j = 0; j < ends.weights; j++) {
            scene->K[ends.floor[i]][ends.floor[j]] += ends.weight[i] * ends.weight[j] * slip.k;
            scene->C[ends.floor[i]][ends.floor[j]] += ends.weight[i] * ends.weight[j] * dashpot;
        }
    if (slips)
        add_slip(scene, &ends, &slip, line->number);
}

void read_scene(const char *path, Scene *scene)
{
    FILE *file = strcmp(path, "-") == 0 ? stdin : fopen(path, "r");
    if (!file)
        fail("cannot open %s", path);
    *scene = (Scene){.stop = -1, .min_approach_velocity = 1e-4 /* the nearest double */};
    static Line line;
    Reader reader = {.scene = scene};
    real scale = 1, pga = 0;
    while (next_line(file, &line)) {
        const char *key = line.word[0];
        if (strcmp(key, "stop") == 0)
            scene->stop = value(&line, 1);
        else if (strcmp(key, "output_step") == 0)
            scene->output_step = value(&line, 1);
        else if (strcmp(key, "record") == 0)
            read_record(word(&line, 1), &scene->record);
        else if (strcmp(key, "scale") == 0)
            scale = value(&line, 1);
        else if (strcmp(key, "pga") == 0)
            pga = value(&line, 1);
        else if (strcmp(key, "min_approach_velocity") == 0)
            scene->min_approach_velocity = value(&line, 1);
        else if (strcmp(key, "building") == 0 && !scene->right_floors)
            begin_building(&reader, (int)value(&line, 1));
        else if (strcmp(key, "contact") == 0 && scene->left_floors)
            read_contact(scene, &line);
        else if (strcmp(key, "link") == 0 && scene->left_floors)
            read_link(scene, &line);
        else if (!read_building_line(&reader, &line))
            fail("line %d: '%s' not understood here", line.number, key);
    }
    if (file != stdin)
        fclose(file);
    if (!scene->left_floors || !(scene->stop > 0) || !(scene->output_step > 0))
        fail("%s: a building, stop and output_step are needed", path);
    for (int i = 0; i < scene->floors; i++)
        if (!(scene->mass[i] > 0))
            fail("%s: every floor needs a mass > 0", path);
    if (scene->record.count)
        scale_record(&scene->record, scale, pga);
}
