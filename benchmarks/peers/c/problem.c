#include "problem.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

void fail(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputc('\n', stderr);
    exit(1);
}

void *allocate(long count, long size)
{
    void *memory = calloc(count > 0 ? count : 1, size);
    if (!memory)
        fail("out of memory");
    return memory;
}

double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec + 1e-9 * now.tv_nsec;
}

static double number(FILE *file)
{
    double value;
    if (fscanf(file, "%lf", &value) != 1)
        fail("the problem file ends early or has something that is no number");
    return value;
}

static double *numbers(FILE *file, long count)
{
    double *values = allocate(count, sizeof *values);
    for (long i = 0; i < count; i++)
        values[i] = number(file);
    return values;
}

static int bandwidth(const Problem *p)
{
    int band = 0;
    for (int i = 0; i < p->floors; i++)
        for (int j = 0; j < p->floors; j++)
            if ((p->K[i * p->floors + j] != 0 || p->C[i * p->floors + j] != 0) && abs(i - j) > band)
                band = abs(i - j);
    return band;
}

Problem read_problem(const char *path)
{
    FILE *file = fopen(path, "r");
    if (!file)
        fail("cannot read %s", path);
    Problem p = {0};
    p.floors = number(file);
    p.contacts = number(file);
    p.samples = number(file);
    p.stop = number(file);
    p.output_step = number(file);
    p.mass = numbers(file, p.floors);
    p.K = numbers(file, (long)p.floors * p.floors);
    p.C = numbers(file, (long)p.floors * p.floors);
    p.contact = allocate(p.contacts, sizeof *p.contact);
    for (Contact *c = p.contact; c < p.contact + p.contacts; c++) {
        c->left = number(file);
        c->right = number(file);
        c->gap = number(file);
        c->k = number(file);
        c->n = number(file);
        c->c = number(file);
        c->m = number(file);
        c->a = number(file);
        c->tension = number(file) != 0;
        c->only_approaching = number(file) != 0;
        c->yield_drift = number(file);
    }
    p.time = numbers(file, p.samples);
    p.ground = numbers(file, p.samples);
    p.band = bandwidth(&p);
    fclose(file);
    return p;
}

double ground_acceleration(const Problem *p, double t)
{
    double step = (p->time[p->samples - 1] - p->time[0]) / (p->samples - 1);
    long i = (long)((t - p->time[0]) / step);
    if (i < 0 || t > p->time[p->samples - 1])
        return 0.0;
    if (i > p->samples - 2)
        i = p->samples - 2;
    return p->ground[i] + (p->ground[i + 1] - p->ground[i]) * (t - p->time[i]) / (p->time[i + 1] - p->time[i]);
}

static double power(double d, double n)
{
    if (n == 0.0)
        return 1.0;
    if (n == 1.0)
        return d;
    if (n == 1.5)
        return d * sqrt(d);
    if (n == 0.25)
        return sqrt(sqrt(d));
    return pow(d, n);
}

double contact_force(const Contact *c, double d, double v, double V)
{
    double force = c->k * power(d, c->n);
    if (c->a != 0.0)
        force *= 1.0 + c->a * v / V;
    if (c->c != 0.0 && !(c->only_approaching && v <= 0.0))
        force += c->c * power(d, c->m) * v;
    return force < 0.0 && !c->tension ? 0.0 : force;
}

void contact_tangent(const Contact *c, double d, double v, double V, double *by_d, double *by_v)
{
    double elastic = c->k * power(d, c->n), damper = 0.0;
    *by_d = c->n * elastic / d;
    *by_v = 0.0;
    if (c->a != 0.0) {
        *by_d *= 1.0 + c->a * v / V;
        *by_v = elastic * c->a / V;
    }
    if (c->c != 0.0 && !(c->only_approaching && v <= 0.0)) {
        damper = c->c * power(d, c->m);
        *by_d += c->m * damper * v / d;
        *by_v += damper;
    }
    if (!c->tension && contact_force(c, d, v, V) == 0.0)
        *by_d = *by_v = 0.0;
}

double penetration(const Contact *c, const double *u)
{
    return rate(c, u) - c->gap;
}

double rate(const Contact *c, const double *v)
{
    return v[c->left] - (c->right < 0 ? 0.0 : v[c->right]);
}

void acceleration(const Problem *p, const double *u, const double *v, double ground, const double *F, double *out)
{
    int n = p->floors;
    for (int i = 0; i < n; i++) {
        int from = i > p->band ? i - p->band : 0, to = i + p->band < n - 1 ? i + p->band : n - 1;
        const double *K = p->K + (long)i * n, *C = p->C + (long)i * n;
        double force = 0.0;
        for (int j = from; j <= to; j++)
            force += K[j] * u[j] + C[j] * v[j];
        out[i] = force;
    }
    for (int i = 0; i < p->contacts; i++) {
        out[p->contact[i].left] += F[i];
        if (p->contact[i].right >= 0)
            out[p->contact[i].right] -= F[i];
    }
    for (int i = 0; i < n; i++)
        out[i] = -out[i] / p->mass[i] - ground;
}

int run_program(int count, char **word, Solver *solve)
{
    if (count != 6)
        fail("usage: %s PROBLEM METHOD SETTING REPEATS OUTPUT", word[0]);
    Problem p = read_problem(word[1]);
    double setting = atof(word[3]);
    long values = (lround(p.stop / p.output_step) + 1) * p.floors;
    double *u = allocate(values, sizeof *u);
    int impacts = 0;
    for (int repeat = 0; repeat < atoi(word[4]); repeat++) {
        memset(u, 0, values * sizeof *u);
        double start = seconds();
        impacts = solve(&p, word[2], setting, u);
        printf("%.9g ", seconds() - start);
    }
    printf("\n%d\n", impacts);
    FILE *file = fopen(word[5], "wb");
    if (!file || fwrite(u, sizeof *u, values, file) != (size_t)values || fclose(file) != 0)
        fail("cannot write %s", word[5]);
    return 0;
}
