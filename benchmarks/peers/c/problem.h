/* The equations that every compiled peer solves: M u'' + C u' + K u = -M 1 a(t) - B F, d = B^T u - gap. SI units. */
#ifndef PROBLEM_H
#define PROBLEM_H

#include <stdbool.h>

/*
 * F = k d^n (1 + a v / V) + c d^m v; of these terms a law has those that are not 0.
 *
 * A storey that yields stands among the contacts: `left` is its upper floor and `right` its lower one, d is its drift,
 * and F = -k (plastic drift) is what it carries less than the elastic storey that K has; k is (1 - r) of its stiffness.
 */
typedef struct {
    int left, right;                 /* indices of the floors; -1: the ground */
    double gap, k, n, c, m, a;
    bool tension;                    /* the force may pull, as long as d > 0 */
    bool only_approaching;           /* c counts while v > 0 only */
    double yield_drift;              /* of a storey that yields; of a contact 0 */
} Contact;

typedef struct {
    int floors, contacts, samples, band; /* K and C are 0 beyond `band` from the diagonal */
    double stop, output_step;
    double *mass, *K, *C;            /* K and C in rows */
    Contact *contact;
    double *time, *ground;           /* the record; linear between samples */
} Problem;

Problem read_problem(const char *path);

double ground_acceleration(const Problem *p, double t);

/* Force of a closed contact, N, d > 0; V is the approach velocity. */
double contact_force(const Contact *c, double d, double v, double V);
/* Its derivatives by d and by v. */
void contact_tangent(const Contact *c, double d, double v, double V, double *by_d, double *by_v);

double penetration(const Contact *c, const double *u);
double rate(const Contact *c, const double *v);

/* out = -M^-1 (K u + C v + B F) - ground, F one per contact. */
void acceleration(const Problem *p, const double *u, const double *v, double ground, const double *F, double *out);

void *allocate(long count, long size);
void fail(const char *format, ...);
double seconds(void);

/* Solves the problem once, and writes the displacements at k output_step to `u` in rows. Returns the impacts. */
typedef int Solver(const Problem *p, const char *method, double setting, double *u);

/* PROGRAM PROBLEM METHOD SETTING REPEATS OUTPUT: prints the wall seconds of each repeat and the impacts. */
int run_program(int count, char **word, Solver *solve);

#endif
