/* What the parts of the host share: a run as its file says it, and the FMU as the host drives it. */

#ifndef HOST_H
#define HOST_H

#include <stddef.h>
#include <stdint.h>

enum { WARNING = 1, DISCARD = 2, NAME = 4096, MOST_STATES = 4 };

typedef struct {
    size_t count;
    unsigned *references;
} Variables;

typedef struct {
    long fmi;   /* version of the standard: 2 or 3 */
    long stops; /* whether steps of FMI 3.0 stop at events */
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

/* States have functions of the same types in both versions, under names of their own. */
typedef int Plain(void *fmu);
typedef int OfStatePlace(void *fmu, void **state);
typedef int SetState(void *fmu, void *state);
typedef int StateSize(void *fmu, void *state, size_t *size);
typedef int SerializeState(void *fmu, void *state, unsigned char *bytes, size_t size);
typedef int DeserializeState(void *fmu, const unsigned char *bytes, size_t size, void **state);
typedef void FreeInstance(void *fmu);

typedef struct {
    OfStatePlace *get, *release;
    SetState *set;
    StateSize *size;
    SerializeState *serialize;
    DeserializeState *deserialize;
    Plain *terminate;
    FreeInstance *free_instance;
} Common;

/* One version of the standard. Values arrive in arrays of the same types in both; Booleans as 0 or 1. */
typedef struct {
    Common (*load)(const char *library);
    void *(*initialized)(const Run *run);
    void (*set_inputs)(void *fmu, const Run *run, const double *values, const double *slopes, long point);
    void (*reals)(void *fmu, const Variables *variables, double *values, long point);
    void (*rates)(void *fmu, const Variables *variables, double *values, long point);
    void (*integers)(void *fmu, const Variables *variables, int32_t *values, long point);
    void (*booleans)(void *fmu, const Variables *variables, int32_t *values, long point);
    double (*partial)(void *fmu, const unsigned *unknown_and_known, long point);
    void (*advance)(void *fmu, const Run *run, long point);
} Version;

extern const Version version2, version3;

void fail(const char *format, ...);
void require(int status, const char *function, long point);
void *room(size_t count, size_t size);
void *loaded(const char *path);
void *found(void *library, const char *name);

#endif
