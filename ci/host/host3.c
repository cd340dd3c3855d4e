/* FMI 3.0 as the host drives it: with steps that go through, or with steps that stop at every event. */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi3.h"

/* What stands beside each Boolean of one byte, and must stay. */
enum { GUARD = 0xA5 };

static Functions fmi;

static void log_message(void *environment, int status, const char *category, const char *message) {
    (void)environment, (void)category;
    if (status > DISCARD) fprintf(stderr, "%s\n", message);
}

static Common load(const char *path) {
    void *library = loaded(path);
#define FIND(type, name) *(void **)&fmi.name = found(library, "fmi3" #name);
    FOR_EACH_FUNCTION(FIND)
#undef FIND
    Common common;
    *(void **)&common.get = found(library, "fmi3GetFMUState");
    *(void **)&common.release = found(library, "fmi3FreeFMUState");
    *(void **)&common.set = found(library, "fmi3SetFMUState");
    *(void **)&common.size = found(library, "fmi3SerializedFMUStateSize");
    *(void **)&common.serialize = found(library, "fmi3SerializeFMUState");
    *(void **)&common.deserialize = found(library, "fmi3DeserializeFMUState");
    *(void **)&common.terminate = found(library, "fmi3Terminate");
    *(void **)&common.free_instance = found(library, "fmi3FreeInstance");
    return common;
}

/* Places for Booleans, every other byte, with a guard after each. */
static bool *place(unsigned char *bytes, size_t index) {
    return (bool *)(bytes + 2 * index);
}

/* What is in the places: each is 0 or 1, and no byte beside them has been written. */
static void look(const unsigned char *bytes, size_t count, const char *function, long point) {
    for (size_t i = 0; i < count; i++) {
        if (bytes[2 * i] > 1) fail("%s at point %ld: Boolean %lu is %d", function, point, (unsigned long)i, bytes[2 * i]);
        if (bytes[2 * i + 1] != GUARD)
            fail("%s at point %ld wrote beyond Boolean %lu", function, point, (unsigned long)i);
    }
}

/* Through Event Mode to Step Mode. That a run has ended is told by the next step. */
static void through_events(void *fmu, long point) {
    unsigned char flags[2 * 5];
    double next;
    do {
        memset(flags, GUARD, sizeof flags);
        require(fmi.UpdateDiscreteStates(fmu, place(flags, 0), place(flags, 1), place(flags, 2), place(flags, 3),
                                         place(flags, 4), &next),
                "fmi3UpdateDiscreteStates", point);
        look(flags, 5, "fmi3UpdateDiscreteStates", point);
    } while (flags[0]);
    require(fmi.EnterStepMode(fmu), "fmi3EnterStepMode", point);
}

static void *initialized(const Run *run) {
    bool stops = run->stops != 0;
    void *fmu = fmi.InstantiateCoSimulation(run->name, run->guid, run->resources, false, false, stops, stops, NULL, 0,
                                            NULL, log_message, NULL);
    if (!fmu) fail("fmi3InstantiateCoSimulation returned nothing");
    require(fmi.EnterInitializationMode(fmu, false, 0.0, 0.0, false, 0.0), "fmi3EnterInitializationMode", 0);
    require(fmi.ExitInitializationMode(fmu), "fmi3ExitInitializationMode", 0);
    if (stops) through_events(fmu, 0);
    return fmu;
}

/* FMI 3.0 holds inputs: whoever wants the same of FMI 2.0 gives slopes of 0. */
static void set_inputs(void *fmu, const Run *run, const double *values, const double *slopes, long point) {
    size_t count = run->inputs.count;
    for (size_t i = 0; i < count; i++)
        if (slopes[i] != 0.0) fail("FMI 3.0 has no slopes of inputs");
    require(fmi.SetFloat64(fmu, run->inputs.references, count, values, count), "fmi3SetFloat64", point);
}

static void reals(void *fmu, const Variables *variables, double *values, long point) {
    size_t count = variables->count;
    require(fmi.GetFloat64(fmu, variables->references, count, values, count), "fmi3GetFloat64", point);
}

static void rates(void *fmu, const Variables *variables, double *values, long point) {
    size_t count = variables->count;
    int32_t *orders = room(count, sizeof(int32_t));
    for (size_t i = 0; i < count; i++) orders[i] = 1;
    require(fmi.GetOutputDerivatives(fmu, variables->references, count, orders, values, count),
            "fmi3GetOutputDerivatives", point);
    free(orders);
}

static void integers(void *fmu, const Variables *variables, int32_t *values, long point) {
    size_t count = variables->count;
    require(fmi.GetInt32(fmu, variables->references, count, values, count), "fmi3GetInt32", point);
}

/* All at once with a guard behind the last, then each by itself between two guards. */
static void booleans(void *fmu, const Variables *variables, int32_t *values, long point) {
    size_t count = variables->count;
    unsigned char *bytes = room(count + 1, 1);
    memset(bytes, GUARD, count + 1);
    require(fmi.GetBoolean(fmu, variables->references, count, (bool *)bytes, count), "fmi3GetBoolean", point);
    if (bytes[count] != GUARD) fail("fmi3GetBoolean at point %ld wrote beyond %lu bytes", point, (unsigned long)count);
    for (size_t i = 0; i < count; i++) {
        unsigned char alone[4] = {GUARD, GUARD, GUARD, GUARD};
        require(fmi.GetBoolean(fmu, variables->references + i, 1, (bool *)(alone + 1), 1), "fmi3GetBoolean", point);
        if (alone[0] != GUARD) fail("fmi3GetBoolean at point %ld wrote before Boolean %lu", point, (unsigned long)i);
        look(alone + 1, 1, "fmi3GetBoolean", point);
        if (alone[1] != bytes[i]) fail("Boolean %lu at point %ld differs by itself", (unsigned long)i, point);
        values[i] = bytes[i];
    }
    free(bytes);
}

static double partial(void *fmu, const unsigned *pair, long point) {
    const double seed = 1.0;
    double value;
    require(fmi.GetDirectionalDerivative(fmu, pair, 1, pair + 1, 1, &seed, 1, &value, 1),
            "fmi3GetDirectionalDerivative", point);
    return value;
}

/* The step that leads from one time to another, to the last bit. */
static double step_to(double now, double end) {
    double step = end - now;
    while (now + step < end) step = nextafter(step, INFINITY);
    while (now + step > end) step = nextafter(step, 0.0);
    return step;
}

/* To the next point, with a stop at every event on the way. At a collapse all further steps are discarded: all further
 * rows show it. */
static void advance(void *fmu, const Run *run, long point) {
    double now = (double)point * run->step;
    const double end = now + run->step;
    unsigned char flags[2 * 3]; /* event, end of the run, early return */
    do {
        double last = now;
        memset(flags, GUARD, sizeof flags);
        int status = fmi.DoStep(fmu, now, step_to(now, end), false, place(flags, 0), place(flags, 1), place(flags, 2),
                                &last);
        look(flags, 3, "fmi3DoStep", point);
        if (status == DISCARD) return;
        require(status, "fmi3DoStep", point);
        if (!run->stops && (flags[0] || (flags[4] && !flags[2])))
            fail("fmi3DoStep at point %ld stopped without being allowed", point);
        now = last;
        if (flags[0]) {
            require(fmi.EnterEventMode(fmu), "fmi3EnterEventMode", point);
            through_events(fmu, point);
        }
    } while (flags[4] && !flags[2]);
}

const Version version3 = {load, initialized, set_inputs, reals, rates, integers, booleans, partial, advance};
