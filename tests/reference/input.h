/* Lines of the input file, for those parts that read them. */
#ifndef INPUT_H
#define INPUT_H

#include "reference.h"

enum { MAX_WORDS = 256, MAX_LINE = 8192 };

typedef struct {
    int number, count;
    char text[MAX_LINE], *word[MAX_WORDS];
} Line;

/* Word i of a line, and the number that it is; they end the program with a message where there is none. */
const char *word(const Line *line, int i);
double value(const Line *line, int i);
/* The words of a line from one on, which are n numbers. */
void values(const Line *line, int from, int n, real *out);

/* ---- building.c ---- */

typedef struct {
    Scene *scene;
    int building;      /* that is being read */
    int first, floors; /* of that building; 0 floors: none has begun */
    int stiffness_rows, damping_rows;
    real stiffness[MAX_UNKNOWNS]; /* of its storeys, in a shear building */
    real storey[MAX_UNKNOWNS];    /* m, heights of its storeys; 0: not read */
    real height[MAX_UNKNOWNS];    /* of its storeys that gravity pushes on; infinite: not this one */
    bool leans;                   /* whether these have been read */
    real load[MAX_UNKNOWNS];      /* N, weights of its floors; below 0: those of their masses */
    int storeys;                  /* of all buildings that can yield, those of this one left out */
} Reader;

void begin_building(Reader *reader, const Line *line);
/* true where the line is one of a building. */
bool read_building_line(Reader *reader, const Line *line);
/* What follows from all buildings: inertia, and what forces in their storeys do. */
void complete_buildings(Scene *scene);

#endif
