/* The part of the C interface of FMI 2.0 [FMI2022] that the host calls. */

#ifndef FMI2_H
#define FMI2_H

#include "host.h"

enum { FMI2_CO_SIMULATION = 1 };

typedef struct {
    void (*logger)(void *environment, const char *name, int status, const char *category, const char *message, ...);
    void *(*allocate)(size_t count, size_t size);
    void (*release)(void *memory);
    void (*step_finished)(void *environment, int status);
    void *environment;
} Callbacks;

typedef void *Instantiate(const char *name, int type, const char *guid, const char *resources,
                          const Callbacks *callbacks, int visible, int logging);
typedef int SetupExperiment(void *fmu, int has_tolerance, double tolerance, double start, int has_stop, double stop);
typedef int GetReal(void *fmu, const unsigned *references, size_t count, double *values);
typedef int SetReal(void *fmu, const unsigned *references, size_t count, const double *values);
typedef int GetInteger(void *fmu, const unsigned *references, size_t count, int *values);
typedef int SetRealInputDerivatives(void *fmu, const unsigned *references, size_t count, const int *orders,
                                    const double *values);
typedef int GetRealOutputDerivatives(void *fmu, const unsigned *references, size_t count, const int *orders,
                                     double *values);
typedef int GetDirectionalDerivative(void *fmu, const unsigned *unknowns, size_t unknown_count, const unsigned *knowns,
                                     size_t known_count, const double *seed, double *values);
typedef int DoStep(void *fmu, double time, double step, int no_return);

/* Type and name, without its fmi2, of each. */
#define FOR_EACH_FUNCTION(X)                              \
    X(Instantiate, Instantiate)                           \
    X(SetupExperiment, SetupExperiment)                   \
    X(Plain, EnterInitializationMode)                     \
    X(Plain, ExitInitializationMode)                      \
    X(GetReal, GetReal)                                   \
    X(SetReal, SetReal)                                   \
    X(GetInteger, GetInteger)                             \
    X(GetInteger, GetBoolean)                             \
    X(SetRealInputDerivatives, SetRealInputDerivatives)   \
    X(GetRealOutputDerivatives, GetRealOutputDerivatives) \
    X(GetDirectionalDerivative, GetDirectionalDerivative) \
    X(DoStep, DoStep)

typedef struct {
#define FIELD(type, name) type *name;
    FOR_EACH_FUNCTION(FIELD)
#undef FIELD
} Functions;

#endif
