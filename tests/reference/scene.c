/* Reads the input file. Its format is described at the head of reference.c. */
#include "input.h"

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

const char *word(const Line *line, int i)
{
    if (i >= line->count)
        fail("line %d: '%s' wants more words", line->number, line->word[0]);
    return line->word[i];
}

double value(const Line *line, int i) { return number(word(line, i), "input", line->number); }

void values(const Line *line, int from, int n, real *out)
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

/* The displacement of a floor, from 1, or of a foundation that moves, 0. */
static void add_end(const Scene *scene, Form *form, int building, int floor, real weight, int line)
{
    const Building *of = &scene->building[building];
    int lowest = of->sway >= 0 || of->rocking >= 0 ? 0 : 1;
    if (floor < lowest || floor > of->floors)
        fail("line %d: no such floor", line);
    add_floor(scene, form, building, floor, weight);
}

/* columns:STOREY:POSITION:SHAPE: relative to the foundation the columns move as the floors below and above do, in shares
   1 - N and N; with it as whatever is at their level does. */
static void add_columns(const Scene *scene, Form *form, int building, const char *place, real sign, int line)
{
    const Building *of = &scene->building[building];
    int storey;
    char position[64], shape[16];
    if (sscanf(place, "columns:%d:%63[^:]:%15s", &storey, position, shape) != 3)
        fail("line %d: '%s' not understood", line, place);
    real s = number(position, "input", line), N = strcmp(shape, "straight") == 0 ? s : s * s * (3 - 2 * s);
    if (!(s > 0 && s < 1) || (strcmp(shape, "straight") != 0 && strcmp(shape, "fixed") != 0))
        fail("line %d: '%s': a position between 0 and 1, fixed or straight", line, place);
    if (storey < 1 || storey > of->floors)
        fail("line %d: no such storey", line);
    real bottom = storey > 1 ? of->level[storey - 2] : 0, top = of->level[storey - 1];
    if (storey > 1) /* the first storey stands on the foundation */
        add_weight(form, of->first + storey - 2, sign * (1 - N));
    add_weight(form, of->first + storey - 1, sign * N);
    add_rigid(scene, form, building, bottom + s * (top - bottom), sign);
}

/* Where a place begins with the name of a building, it goes on after that. */
static void take_name(const Scene *scene, const char **place, int *building)
{
    size_t length = strcspn(*place, ":");
    for (int b = 0; b < scene->buildings && (*place)[length]; b++)
        if (strlen(scene->building[b].name) == length && strncmp(*place, scene->building[b].name, length) == 0) {
            *building = b;
            *place += length + 1;
            return;
        }
}

/* What is on the left or right of a contact or link. */
static void add_place(const Scene *scene, Form *form, bool left, const char *place, int line)
{
    if (strcmp(place, "wall") == 0)
        return;
    real sign = left ? 1 : -1;
    int building = left ? 0 : 1;
    take_name(scene, &place, &building);
    if (building >= scene->buildings)
        fail("line %d: no such building", line);
    if (strncmp(place, "columns:", 8) == 0)
        add_columns(scene, form, building, place, sign, line);
    else
        add_end(scene, form, building, (int)number(place, "input", line), sign, line);
}

/* What is between the left and the right of a line: how much nearer they have come. */
static Form read_ends(const Scene *scene, const Line *line)
{
    Form form = {.weights = 0};
    add_place(scene, &form, true, word(line, 1), line->number);
    add_place(scene, &form, false, word(line, 2), line->number);
    if (form.weights == 0)
        fail("line %d: something that moves on at least one side", line->number);
    find_pushes(scene, &form);
    return form;
}

/* contact LEFT RIGHT GAP LAW [key value ...] */
static void read_contact(Scene *scene, const Line *line)
{
    if (scene->contacts == MAX_CONTACTS)
        fail("at most %d contacts", MAX_CONTACTS);
    Contact *contact = &scene->contact[scene->contacts++];
    *contact = (Contact){.form = read_ends(scene, line), .gap = value(line, 3)};
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
    contact->mass = 1 / coupling(&contact->form, &contact->form);
    prepare_law(&contact->law, contact->mass, formula);
}

/* ---- links ---- */

/* Where the spring of a link slips, it is a storey that lies between the buildings. */
static void add_slip(Scene *scene, const Storey *slip, int line)
{
    if (slip->form.weight[0] < 0 || !(slip->k > 0 && slip->force > 0 && slip->ratio >= 0 && slip->ratio < 1))
        fail("line %d: what slips needs a floor on its left, stiffness > 0, slip_force > 0 and 0 <= ratio < 1", line);
    if (scene->storeys == MAX_UNKNOWNS)
        fail("line %d: at most %d storeys and links that yield or slip", line, MAX_UNKNOWNS);
    Storey *storey = &scene->storey[scene->storeys++];
    *storey = *slip;
    storey->limit = slip->force / slip->k;
}

/* link LEFT RIGHT [key value ...] */
static void read_link(Scene *scene, const Line *line)
{
    Storey slip = {.building = LINK, .number = ++scene->links, .form = read_ends(scene, line)};
    const Form *ends = &slip.form;
    real dashpot = 0;
    bool slips = false;
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
    for (int i = 0; i < ends->weights; i++)
        for (int j = 0; j < ends->weights; j++) {
            scene->K[ends->of[i]][ends->of[j]] += ends->weight[i] * ends->weight[j] * slip.k;
            scene->C[ends->of[i]][ends->of[j]] += ends->weight[i] * ends->weight[j] * dashpot;
        }
    if (slips)
        add_slip(scene, &slip, line->number);
}

/* true where the line is a contact or a link, which follow the buildings. */
static bool read_connection(Scene *scene, const Line *line)
{
    bool is_contact = strcmp(line->word[0], "contact") == 0;
    if (!(is_contact || strcmp(line->word[0], "link") == 0) || scene->unknowns == 0)
        return false;
    complete_buildings(scene);
    if (is_contact)
        read_contact(scene, line);
    else
        read_link(scene, line);
    return true;
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
        else if (strcmp(key, "building") == 0)
            begin_building(&reader, &line);
        else if (!read_connection(scene, &line) && !read_building_line(&reader, &line))
            fail("line %d: '%s' not understood here", line.number, key);
    }
    if (file != stdin)
        fclose(file);
    if (!scene->unknowns || !(scene->stop > 0) || !(scene->output_step > 0))
        fail("%s: a building, stop and output_step are needed", path);
    complete_buildings(scene);
    if (scene->record.count)
        scale_record(&scene->record, scale, pga);
}
