/* An importer as small as can be: loads a library of FMI 2.0, makes steps of one length, reads some Real variables at each and
 * others at the end, and prints a hash of the bits that it has read.
 *
 *     drive LIBRARY GUID RESOURCES STEPS STEP [REFERENCE ...] [-- REFERENCE ...]
 *     drive LIBRARY GUID RESOURCES CASES STOP [REFERENCE ...] -- [REFERENCE ...] -- PARAMETER ...
 *
 * The second makes a study: the parameters are gaps, which get values from 1 mm to 100 mm, and each case is one step.
 * benchmarks/instructions.py counts what it executes. */
#include <dlfcn.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    void *logger, *allocate, *free, *finished, *environment;
} Callbacks;

typedef struct {
    void *fmu;
    int (*set_up)(void *, int, double, double, int, double), (*enter)(void *), (*leave)(void *), (*reset)(void *);
    int (*step)(void *, double, double, int);
    int (*get)(void *, const unsigned *, size_t, double *), (*set)(void *, const unsigned *, size_t, const double *);
} Importer;

enum { MOST = 65536 };

/* Value references that are read at each step, read at the end, and set for each case. */
typedef struct {
    unsigned references[MOST];
    size_t count;
} List;

static List lists[3];
static double values[MOST];
static uint64_t hash = 14695981039346656037u;

static int read_all(Importer *of, const List *list) {
    if (of->get(of->fmu, list->references, list->count, values)) return 1;
    for (size_t i = 0; i < list->count; i++) {
        uint64_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        hash = (hash ^ bits) * 1099511628211u;
    }
    return 0;
}

static int start(Importer *of) {
    return of->set_up(of->fmu, 0, 0.0, 0.0, 0, 0.0) || of->enter(of->fmu) || of->leave(of->fmu);
}

static int run(Importer *of, long steps, double length) {
    if (start(of)) return 1;
    for (long k = 0; k < steps; k++)
        if (of->step(of->fmu, (double)k * length, length, 1) > 1 || read_all(of, &lists[0])) return 1;
    return read_all(of, &lists[1]);
}

static int study(Importer *of, long cases, double stop) {
    for (long k = 0; k < cases; k++) {
        double gap = 1e-3 * pow(100.0, (double)k / 99.0);
        for (size_t i = 0; i < lists[2].count; i++) values[i] = gap;
        if (k && of->reset(of->fmu)) return 1;
        if (of->set(of->fmu, lists[2].references, lists[2].count, values) || start(of)) return 1;
        if (of->step(of->fmu, 0.0, stop, 1) > 1 || read_all(of, &lists[1])) return 1;
    }
    return 0;
}

int main(int count, char **arguments) {
    if (count < 6) return fputs("drive LIBRARY GUID RESOURCES STEPS STEP [REFERENCE ...] [-- REFERENCE ...]\n", stderr), 2;
    int list = 0;
    for (int i = 6; i < count; i++) {
        if (strcmp(arguments[i], "--") == 0) list += list < 2;
        else if (lists[list].count < MOST) lists[list].references[lists[list].count++] = (unsigned)atol(arguments[i]);
    }
    void *library = dlopen(arguments[1], RTLD_NOW | RTLD_LOCAL);
    if (!library) return fprintf(stderr, "%s\n", dlerror()), 1;
    void *(*instantiate)(const char *, int, const char *, const char *, Callbacks *, int, int) =
        dlsym(library, "fmi2Instantiate");
    void (*release)(void *) = dlsym(library, "fmi2FreeInstance");
    Callbacks none = {0};
    Importer importer = {
        .fmu = instantiate("drive", 1, arguments[2], arguments[3], &none, 0, 0),
        .set_up = dlsym(library, "fmi2SetupExperiment"),
        .enter = dlsym(library, "fmi2EnterInitializationMode"),
        .leave = dlsym(library, "fmi2ExitInitializationMode"),
        .reset = dlsym(library, "fmi2Reset"),
        .step = dlsym(library, "fmi2DoStep"),
        .get = dlsym(library, "fmi2GetReal"),
        .set = dlsym(library, "fmi2SetReal"),
    };
    if (!importer.fmu) return fputs("it does not start\n", stderr), 1;
    long steps = atol(arguments[4]);
    double length = atof(arguments[5]);
    if (lists[2].count ? study(&importer, steps, length) : run(&importer, steps, length)) return fputs("it fails\n", stderr), 1;
    release(importer.fmu);
    printf("%016llx\n", (unsigned long long)hash);
    return 0;
}
