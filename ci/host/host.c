/* Drives an FMU of this project through the C interface of FMI 2.0 or 3.0 and writes everything that comes out, bit for
 * bit.
 *
 *     host RUN...
 *
 * Each RUN is a text file that ci/releasing/runs.py writes: what to load, which variables to read, how far to go, which
 * states to save. Its file names are relative to the current directory. Nothing is computed here but times, so that
 * whatever differs between two platforms, or between two versions, differs in the FMU. */

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "host.h"
#include "library.h"

static const char *run_name = "";

void fail(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    fflush(stdout);
    fprintf(stderr, "%s: ", run_name);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    exit(1);
}

void require(int status, const char *function, long point) {
    if (status > WARNING) fail("%s at point %ld returned status %d", function, point, status);
}

void *room(size_t count, size_t size) {
    void *bytes = calloc(count + 1, size);
    if (!bytes) fail("no memory for %lu times %lu bytes", (unsigned long)count, (unsigned long)size);
    return bytes;
}

static FILE *opened(const char *name, const char *mode) {
    FILE *file = fopen(name, mode);
    if (!file) fail("cannot open %s", name);
    return file;
}

static void write_all(FILE *file, const void *bytes, size_t size, size_t count) {
    if (fwrite(bytes, size, count, file) != count) fail("cannot write");
}

/* ---- the run, read from its file ---- */

static void read_text(FILE *file, char *text) {
    if (fscanf(file, "%4095s", text) != 1) fail("a word is missing");
}

static long read_number(FILE *file) {
    long number;
    if (fscanf(file, "%ld", &number) != 1) fail("a number is missing");
    return number;
}

static Variables read_variables(FILE *file) {
    Variables variables = {(size_t)read_number(file), NULL};
    variables.references = room(variables.count, sizeof(unsigned));
    for (size_t i = 0; i < variables.count; i++) variables.references[i] = (unsigned)read_number(file);
    return variables;
}

static void read_states(FILE *file, Run *run) {
    run->states = (size_t)read_number(file);
    if (run->states > MOST_STATES) fail("more than %d states", MOST_STATES);
    for (size_t i = 0; i < run->states; i++) {
        run->state_points[i] = read_number(file);
        read_text(file, run->state_files[i]);
    }
}

static void read_run(const char *name, Run *run) {
    FILE *file = opened(name, "r");
    char key[NAME];
    memset(run, 0, sizeof *run);
    run->fmi = 2;
    while (fscanf(file, "%4095s", key) == 1) {
        if (!strcmp(key, "library")) read_text(file, run->library);
        else if (!strcmp(key, "resources")) read_text(file, run->resources);
        else if (!strcmp(key, "name")) read_text(file, run->name);
        else if (!strcmp(key, "guid")) read_text(file, run->guid);
        else if (!strcmp(key, "inputs_file")) read_text(file, run->inputs_file);
        else if (!strcmp(key, "output_file")) read_text(file, run->output_file);
        else if (!strcmp(key, "start_state")) read_text(file, run->start_state);
        else if (!strcmp(key, "fmi")) run->fmi = read_number(file);
        else if (!strcmp(key, "stops")) run->stops = read_number(file);
        else if (!strcmp(key, "start")) run->start = read_number(file);
        else if (!strcmp(key, "stop")) run->stop = read_number(file);
        else if (!strcmp(key, "reals")) run->reals = read_variables(file);
        else if (!strcmp(key, "integers")) run->integers = read_variables(file);
        else if (!strcmp(key, "booleans")) run->booleans = read_variables(file);
        else if (!strcmp(key, "inputs")) run->inputs = read_variables(file);
        else if (!strcmp(key, "partials")) run->partials = read_variables(file);
        else if (!strcmp(key, "states")) read_states(file, run);
        else if (!strcmp(key, "step")) {
            if (fscanf(file, "%lf", &run->step) != 1) fail("no step");
        } else fail("unknown key %s", key);
    }
    fclose(file);
}

static void free_run(Run *run) {
    free(run->reals.references);
    free(run->integers.references);
    free(run->booleans.references);
    free(run->inputs.references);
    free(run->partials.references);
}

/* ---- the FMU ---- */

void *loaded(const char *path) {
    Library library = load_library(path);
    if (!library) fail("cannot load %s: %s", path, loading_error());
    return (void *)library;
}

void *found(void *library, const char *name) {
    void *function = library_symbol((Library)library, name);
    if (!function) fail("the library has no %s", name);
    return function;
}

static void restore(const Common *common, void *fmu, const Run *run) {
    FILE *file = opened(run->start_state, "rb");
    fseek(file, 0, SEEK_END);
    size_t size = (size_t)ftell(file);
    rewind(file);
    unsigned char *bytes = room(size, 1);
    void *state = NULL;
    if (fread(bytes, 1, size, file) != size) fail("cannot read %s", run->start_state);
    fclose(file);
    require(common->deserialize(fmu, bytes, size, &state), "deserialization of a state", run->start);
    require(common->set(fmu, state), "setting of a state", run->start);
    require(common->release(fmu, &state), "freeing of a state", run->start);
    free(bytes);
}

static void save(const Common *common, void *fmu, const char *name, long point) {
    void *state = NULL;
    size_t size = 0;
    require(common->get(fmu, &state), "getting of a state", point);
    require(common->size(fmu, state, &size), "size of a state", point);
    unsigned char *bytes = room(size, 1);
    require(common->serialize(fmu, state, bytes, size), "serialization of a state", point);
    require(common->release(fmu, &state), "freeing of a state", point);
    FILE *file = opened(name, "wb");
    write_all(file, bytes, 1, size);
    if (fclose(file)) fail("cannot write %s", name);
    free(bytes);
}

/* One row of the output file: Reals, their first derivatives, Integers, Booleans, partial derivatives. */
static void observe(const Version *version, void *fmu, const Run *run, FILE *output, long point) {
    size_t reals = run->reals.count, integers = run->integers.count, booleans = run->booleans.count;
    double *numbers = room(reals, sizeof(double));
    int32_t *whole = room(integers + booleans, sizeof(int32_t));
    version->reals(fmu, &run->reals, numbers, point);
    write_all(output, numbers, sizeof(double), reals);
    version->rates(fmu, &run->reals, numbers, point);
    write_all(output, numbers, sizeof(double), reals);
    version->integers(fmu, &run->integers, whole, point);
    version->booleans(fmu, &run->booleans, whole + integers, point);
    write_all(output, whole, sizeof(int32_t), integers + booleans);
    for (size_t i = 0; i < run->partials.count; i += 2) {
        double partial = version->partial(fmu, run->partials.references + i, point);
        write_all(output, &partial, sizeof(double), 1);
    }
    free(numbers);
    free(whole);
}

static double *read_inputs(const Run *run) {
    size_t count = 2 * run->inputs.count * (size_t)(run->stop + 1);
    double *rows = room(count, sizeof(double));
    if (!count) return rows;
    FILE *file = opened(run->inputs_file, "rb");
    if (fread(rows, sizeof(double), count, file) != count) fail("%s is too short", run->inputs_file);
    fclose(file);
    return rows;
}

static void drive(const Run *run) {
    const Version *version = run->fmi == 3 ? &version3 : &version2;
    Common common = version->load(run->library);
    void *fmu = version->initialized(run);
    double *inputs = read_inputs(run);
    size_t count = run->inputs.count;
    FILE *output = opened(run->output_file, "wb");
    if (run->start_state[0]) restore(&common, fmu, run);
    for (long point = run->start; point <= run->stop; point++) {
        /* The values of all inputs, then their slopes. */
        const double *row = inputs + 2 * count * (size_t)point;
        if (count) version->set_inputs(fmu, run, row, row + count, point);
        observe(version, fmu, run, output, point);
        for (size_t i = 0; i < run->states; i++)
            if (run->state_points[i] == point) save(&common, fmu, run->state_files[i], point);
        if (point < run->stop) version->advance(fmu, run, point);
    }
    if (fclose(output)) fail("cannot write %s", run->output_file);
    require(common.terminate(fmu), "termination", run->stop);
    common.free_instance(fmu);
    free(inputs);
}

int main(int count, char **arguments) {
    for (int i = 1; i < count; i++) {
        Run run;
        run_name = arguments[i];
        read_run(run_name, &run);
        drive(&run);
        free_run(&run);
    }
    return 0;
}
