/* Drives an FMU of this project through the C interface of FMI 2.0 and writes everything that comes out, bit for bit.
 *
 *     host RUN...
 *
 * Each RUN is a text file that ci/releasing/runs.py writes: what to load, which variables to read, how far to go, which
 * states to save. Its file names are relative to the current directory. Nothing is computed here but k * step, so that
 * whatever differs between two platforms differs in the FMU. */

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2.h"
#include "library.h"

enum { NAME = 4096, MOST_STATES = 4 };

typedef struct {
    size_t count;
    unsigned *references;
} Variables;

typedef struct {
    char library[NAME], resources[NAME], name[NAME], guid[NAME], inputs_file[NAME], output_file[NAME];
    Variables reals, integers, booleans, inputs;
    Variables partials; /* an output and the input by which it is differentiated, in turn */
    double step;
    long start, stop; /* communication points, counted from 0 */
    char start_state[NAME];
    size_t states;
    long state_points[MOST_STATES];
    char state_files[MOST_STATES][NAME];
} Run;

static const char *run_name = "";

static void fail(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    fflush(stdout);
    fprintf(stderr, "%s: ", run_name);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    exit(1);
}

static void require(int status, const char *function, long point) {
    if (status > FMI2_WARNING) fail("%s at point %ld returned status %d", function, point, status);
}

static void *room(size_t count, size_t size) {
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
    while (fscanf(file, "%4095s", key) == 1) {
        if (!strcmp(key, "library")) read_text(file, run->library);
        else if (!strcmp(key, "resources")) read_text(file, run->resources);
        else if (!strcmp(key, "name")) read_text(file, run->name);
        else if (!strcmp(key, "guid")) read_text(file, run->guid);
        else if (!strcmp(key, "inputs_file")) read_text(file, run->inputs_file);
        else if (!strcmp(key, "output_file")) read_text(file, run->output_file);
        else if (!strcmp(key, "start_state")) read_text(file, run->start_state);
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

static void log_message(void *environment, const char *name, int status, const char *category, const char *message,
                        ...) {
    (void)environment, (void)name, (void)category;
    if (status <= FMI2_DISCARD) return;
    va_list arguments;
    va_start(arguments, message);
    vfprintf(stderr, message, arguments);
    fputc('\n', stderr);
    va_end(arguments);
}

static const Callbacks callbacks = {log_message, calloc, free, NULL, NULL};

static Functions loaded(const char *path) {
    Functions functions;
    Library library = load_library(path);
    if (!library) fail("cannot load %s: %s", path, loading_error());
#define FIND(type, name)                                    \
    *(void **)&functions.name = library_symbol(library, "fmi2" #name); \
    if (!functions.name) fail("%s has no fmi2" #name, path);
    FOR_EACH_FUNCTION(FIND)
#undef FIND
    return functions;
}

static void restore(const Functions *fmi, void *fmu, const Run *run) {
    FILE *file = opened(run->start_state, "rb");
    fseek(file, 0, SEEK_END);
    size_t size = (size_t)ftell(file);
    rewind(file);
    unsigned char *bytes = room(size, 1);
    void *state = NULL;
    if (fread(bytes, 1, size, file) != size) fail("cannot read %s", run->start_state);
    fclose(file);
    require(fmi->DeSerializeFMUstate(fmu, bytes, size, &state), "fmi2DeSerializeFMUstate", run->start);
    require(fmi->SetFMUstate(fmu, state), "fmi2SetFMUstate", run->start);
    require(fmi->FreeFMUstate(fmu, &state), "fmi2FreeFMUstate", run->start);
    free(bytes);
}

static void save(const Functions *fmi, void *fmu, const char *name, long point) {
    void *state = NULL;
    size_t size = 0;
    require(fmi->GetFMUstate(fmu, &state), "fmi2GetFMUstate", point);
    require(fmi->SerializedFMUstateSize(fmu, state, &size), "fmi2SerializedFMUstateSize", point);
    unsigned char *bytes = room(size, 1);
    require(fmi->SerializeFMUstate(fmu, state, bytes, size), "fmi2SerializeFMUstate", point);
    require(fmi->FreeFMUstate(fmu, &state), "fmi2FreeFMUstate", point);
    FILE *file = opened(name, "wb");
    write_all(file, bytes, 1, size);
    if (fclose(file)) fail("cannot write %s", name);
    free(bytes);
}

/* The values of all inputs, then their slopes. */
static void set_inputs(const Functions *fmi, void *fmu, const Run *run, const double *rows, long point) {
    size_t count = run->inputs.count;
    const double *row = rows + 2 * count * (size_t)point;
    int *orders = room(count, sizeof(int));
    if (!count) return free(orders);
    for (size_t i = 0; i < count; i++) orders[i] = 1;
    require(fmi->SetReal(fmu, run->inputs.references, count, row), "fmi2SetReal", point);
    require(fmi->SetRealInputDerivatives(fmu, run->inputs.references, count, orders, row + count),
            "fmi2SetRealInputDerivatives", point);
    free(orders);
}

/* One row of the output file: Reals, their first derivatives, Integers, Booleans, partial derivatives. */
static void observe(const Functions *fmi, void *fmu, const Run *run, FILE *output, long point) {
    size_t reals = run->reals.count, integers = run->integers.count, booleans = run->booleans.count;
    double *numbers = room(reals, sizeof(double));
    int *whole = room(reals + integers + booleans, sizeof(int));
    require(fmi->GetReal(fmu, run->reals.references, reals, numbers), "fmi2GetReal", point);
    write_all(output, numbers, sizeof(double), reals);
    for (size_t i = 0; i < reals; i++) whole[i] = 1;
    require(fmi->GetRealOutputDerivatives(fmu, run->reals.references, reals, whole, numbers),
            "fmi2GetRealOutputDerivatives", point);
    write_all(output, numbers, sizeof(double), reals);
    require(fmi->GetInteger(fmu, run->integers.references, integers, whole), "fmi2GetInteger", point);
    write_all(output, whole, sizeof(int), integers);
    require(fmi->GetBoolean(fmu, run->booleans.references, booleans, whole), "fmi2GetBoolean", point);
    write_all(output, whole, sizeof(int), booleans);
    for (size_t i = 0; i < run->partials.count; i += 2) {
        const unsigned *pair = run->partials.references + i;
        const double seed = 1.0;
        double partial;
        require(fmi->GetDirectionalDerivative(fmu, pair, 1, pair + 1, 1, &seed, &partial),
                "fmi2GetDirectionalDerivative", point);
        write_all(output, &partial, sizeof(double), 1);
    }
    free(numbers);
    free(whole);
}

static void *initialized(const Functions *fmi, const Run *run) {
    void *fmu = fmi->Instantiate(run->name, FMI2_CO_SIMULATION, run->guid, run->resources, &callbacks, 0, 0);
    if (!fmu) fail("fmi2Instantiate returned nothing");
    require(fmi->SetupExperiment(fmu, 0, 0.0, 0.0, 0, 0.0), "fmi2SetupExperiment", 0);
    require(fmi->EnterInitializationMode(fmu), "fmi2EnterInitializationMode", 0);
    require(fmi->ExitInitializationMode(fmu), "fmi2ExitInitializationMode", 0);
    return fmu;
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

/* A step in which a storey collapses is discarded, and so are those after it: all further rows show the collapse. */
static void advance(const Functions *fmi, void *fmu, const Run *run, long point) {
    int status = fmi->DoStep(fmu, (double)point * run->step, run->step, 0);
    if (status != FMI2_DISCARD) require(status, "fmi2DoStep", point);
}

static void drive(const Run *run) {
    Functions fmi = loaded(run->library);
    void *fmu = initialized(&fmi, run);
    double *inputs = read_inputs(run);
    FILE *output = opened(run->output_file, "wb");
    if (run->start_state[0]) restore(&fmi, fmu, run);
    for (long point = run->start; point <= run->stop; point++) {
        set_inputs(&fmi, fmu, run, inputs, point);
        observe(&fmi, fmu, run, output, point);
        for (size_t i = 0; i < run->states; i++)
            if (run->state_points[i] == point) save(&fmi, fmu, run->state_files[i], point);
        if (point < run->stop) advance(&fmi, fmu, run, point);
    }
    if (fclose(output)) fail("cannot write %s", run->output_file);
    require(fmi.Terminate(fmu), "fmi2Terminate", run->stop);
    fmi.FreeInstance(fmu);
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
