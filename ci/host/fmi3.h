/* The part of the C interface of FMI 3.0 [FMI2024] that the host calls. */

#ifndef FMI3_H
#define FMI3_H

#include <stdbool.h>

#include "host.h"

typedef void LogMessage(void *environment, int status, const char *category, const char *message);
typedef void IntermediateUpdate(void *environment, double time, bool set_requested, bool get_allowed,
                                bool step_finished, bool can_return_early, bool *early_return, double *early_time);

typedef void *InstantiateCoSimulation(const char *name, const char *token, const char *resources, bool visible,
                                      bool logging, bool event_mode_used, bool early_return_allowed,
                                      const uint32_t *required, size_t required_count, void *environment,
                                      LogMessage *logger, IntermediateUpdate *update);
typedef int EnterInitializationMode(void *fmu, bool has_tolerance, double tolerance, double start, bool has_stop,
                                    double stop);
typedef int GetFloat64(void *fmu, const uint32_t *references, size_t count, double *values, size_t value_count);
typedef int SetFloat64(void *fmu, const uint32_t *references, size_t count, const double *values, size_t value_count);
typedef int GetInt32(void *fmu, const uint32_t *references, size_t count, int32_t *values, size_t value_count);
typedef int GetBoolean(void *fmu, const uint32_t *references, size_t count, bool *values, size_t value_count);
typedef int GetOutputDerivatives(void *fmu, const uint32_t *references, size_t count, const int32_t *orders,
                                 double *values, size_t value_count);
typedef int GetDirectionalDerivative(void *fmu, const uint32_t *unknowns, size_t unknown_count, const uint32_t *knowns,
                                     size_t known_count, const double *seed, size_t seed_count, double *values,
                                     size_t value_count);
typedef int UpdateDiscreteStates(void *fmu, bool *need_update, bool *terminate, bool *nominals_changed,
                                 bool *values_changed, bool *next_defined, double *next);
typedef int DoStep(void *fmu, double time, double step, bool no_return, bool *event, bool *terminate, bool *early,
                   double *last);

/* Type and name, without its fmi3, of each. */
#define FOR_EACH_FUNCTION(X)                              \
    X(InstantiateCoSimulation, InstantiateCoSimulation)   \
    X(EnterInitializationMode, EnterInitializationMode)   \
    X(Plain, ExitInitializationMode)                      \
    X(Plain, EnterEventMode)                              \
    X(Plain, EnterStepMode)                               \
    X(GetFloat64, GetFloat64)                             \
    X(SetFloat64, SetFloat64)                             \
    X(GetInt32, GetInt32)                                 \
    X(GetBoolean, GetBoolean)                             \
    X(GetOutputDerivatives, GetOutputDerivatives)         \
    X(GetDirectionalDerivative, GetDirectionalDerivative) \
    X(UpdateDiscreteStates, UpdateDiscreteStates)         \
    X(DoStep, DoStep)

typedef struct {
#define FIELD(type, name) type *name;
    FOR_EACH_FUNCTION(FIELD)
#undef FIELD
} Functions;

#endif
