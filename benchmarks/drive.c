/* An importer as small as can be: loads a library of FMI 2.0, makes steps of one length, reads some Real variables at each, and
 * prints a hash of the bits that it has read.
 *
 *     drive LIBRARY GUID RESOURCES STEPS STEP [VALUE_REFERENCE ...]
 *
 * benchmarks/instructions.py counts what it executes. */
#include <dlfcn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    void *logger, *allocate, *free, *finished, *environment;
} Callbacks;

enum { MOST = 4096 };

int main(int count, char **arguments) {
    if (count < 6 || count - 6 > MOST) return fputs("drive LIBRARY GUID RESOURCES STEPS STEP [REFERENCE ...]\n", stderr), 2;
    void *library = dlopen(arguments[1], RTLD_NOW | RTLD_LOCAL);
    if (!library) return fprintf(stderr, "%s\n", dlerror()), 1;
    void *(*instantiate)(const char *, int, const char *, const char *, Callbacks *, int, int) =
        dlsym(library, "fmi2Instantiate");
    int (*set_up)(void *, int, double, double, int, double) = dlsym(library, "fmi2SetupExperiment");
    int (*enter)(void *) = dlsym(library, "fmi2EnterInitializationMode");
    int (*leave)(void *) = dlsym(library, "fmi2ExitInitializationMode");
    int (*step)(void *, double, double, int) = dlsym(library, "fmi2DoStep");
    int (*get)(void *, const unsigned *, size_t, double *) = dlsym(library, "fmi2GetReal");
    void (*release)(void *) = dlsym(library, "fmi2FreeInstance");

    Callbacks none = {0};
    void *fmu = instantiate("drive", 1, arguments[2], arguments[3], &none, 0, 0);
    if (!fmu || set_up(fmu, 0, 0.0, 0.0, 0, 0.0) || enter(fmu) || leave(fmu)) return fputs("it does not start\n", stderr), 1;
    long steps = atol(arguments[4]);
    double length = atof(arguments[5]);
    unsigned references[MOST];
    double values[MOST];
    size_t read = (size_t)count - 6;
    for (size_t i = 0; i < read; i++) references[i] = (unsigned)atol(arguments[6 + i]);
    uint64_t hash = 14695981039346656037u;
    for (long k = 0; k < steps; k++) {
        if (step(fmu, (double)k * length, length, 1) > 1 || get(fmu, references, read, values))
            return fprintf(stderr, "step %ld fails\n", k), 1;
        for (size_t i = 0; i < read; i++) {
            uint64_t bits;
            memcpy(&bits, &values[i], sizeof bits);
            hash = (hash ^ bits) * 1099511628211u;
        }
    }
    release(fmu);
    printf("%016llx\n", (unsigned long long)hash);
    return 0;
}
