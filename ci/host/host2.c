/* FMI 2.0 as the host drives it. */

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "fmi2.h"

static Functions fmi;

static void log_message(void *environment, const char *name, int status, const char *category, const char *message,
                        ...) {
    (void)environment, (void)name, (void)category;
    if (status <= DISCARD) return;
    va_list arguments;
    va_start(arguments, message);
    vfprintf(stderr, message, arguments);
    fputc('\n', stderr);
    va_end(arguments);
}

static const Callbacks callbacks = {log_message, calloc, free, NULL, NULL};

static Common load(const char *path) {
    void *library = loaded(path);
#define FIND(type, name) *(void **)&fmi.name = found(library, "fmi2" #name);
    FOR_EACH_FUNCTION(FIND)
#undef FIND
    Common common;
    *(void **)&common.get = found(library, "fmi2GetFMUstate");
    *(void **)&common.release = found(library, "fmi2FreeFMUstate");
    *(void **)&common.set = found(library, "fmi2SetFMUstate");
    *(void **)&common.size = found(library, "fmi2SerializedFMUstateSize");
    *(void **)&common.serialize = found(library, "fmi2SerializeFMUstate");
    *(void **)&common.deserialize = found(library, "fmi2DeSerializeFMUstate");
    *(void **)&common.terminate = found(library, "fmi2Terminate");
    *(void **)&common.free_instance = found(library, "fmi2FreeInstance");
    return common;
}

static void *initialized(const Run *run) {
    void *fmu = fmi.Instantiate(run->name, FMI2_CO_SIMULATION, run->guid, run->resources, &callbacks, 0, 0);
    if (!fmu) fail("fmi2Instantiate returned nothing");
    require(fmi.SetupExperiment(fmu, 0, 0.0, 0.0, 0, 0.0), "fmi2SetupExperiment", 0);
    require(fmi.EnterInitializationMode(fmu), "fmi2EnterInitializationMode", 0);
    require(fmi.ExitInitializationMode(fmu), "fmi2ExitInitializationMode", 0);
    return fmu;
}

/* As many orders of derivatives, all of them the first. */
static int *first_orders(size_t count) {
    int *orders = room(count, sizeof(int));
    for (size_t i = 0; i < count; i++) orders[i] = 1;
    return orders;
}

static void set_inputs(void *fmu, const Run *run, const double *values, const double *slopes, long point) {
    size_t count = run->inputs.count;
    int *orders = first_orders(count);
    require(fmi.SetReal(fmu, run->inputs.references, count, values), "fmi2SetReal", point);
    require(fmi.SetRealInputDerivatives(fmu, run->inputs.references, count, orders, slopes),
            "fmi2SetRealInputDerivatives", point);
    free(orders);
}

static void reals(void *fmu, const Variables *variables, double *values, long point) {
    require(fmi.GetReal(fmu, variables->references, variables->count, values), "fmi2GetReal", point);
}

static void rates(void *fmu, const Variables *variables, double *values, long point) {
    int *orders = first_orders(variables->count);
    require(fmi.GetRealOutputDerivatives(fmu, variables->references, variables->count, orders, values),
            "fmi2GetRealOutputDerivatives", point);
    free(orders);
}

static void integers(void *fmu, const Variables *variables, int32_t *values, long point) {
    require(fmi.GetInteger(fmu, variables->references, variables->count, values), "fmi2GetInteger", point);
}

static void booleans(void *fmu, const Variables *variables, int32_t *values, long point) {
    require(fmi.GetBoolean(fmu, variables->references, variables->count, values), "fmi2GetBoolean", point);
}

static double partial(void *fmu, const unsigned *pair, long point) {
    const double seed = 1.0;
    double value;
    require(fmi.GetDirectionalDerivative(fmu, pair, 1, pair + 1, 1, &seed, &value), "fmi2GetDirectionalDerivative",
            point);
    return value;
}

/* A step in which a storey collapses is discarded, and so are those after it: all further rows show the collapse. */
static void advance(void *fmu, const Run *run, long point) {
    int status = fmi.DoStep(fmu, (double)point * run->step, run->step, 0);
    if (status != DISCARD) require(status, "fmi2DoStep", point);
}

const Version version2 = {load, initialized, set_inputs, reals, rates, integers, booleans, partial, advance};
