/* Types that all parts of the reference solver share. SI units; d > 0 is penetration, a force > 0 is compression. */
#ifndef REFERENCE_H
#define REFERENCE_H

#include <quadmath.h>
#include <stdbool.h>

typedef __float128 real;

enum { MAX_BUILDINGS = 32, MAX_NAME = 64, MAX_UNKNOWNS = 128, MAX_CONTACTS = 64, MAX_STAGES = 32, MAX_WEIGHTS = 8 };

/* ---- scene.c: what is to be solved ---- */

typedef enum {
    LINEAR, KELVIN_VOIGT, KELVIN_VOIGT_NO_TENSION, HERTZ, JANKOWSKI, HERTZ_DAMPED, STEREOMECHANICAL
} LawKind;

typedef struct {
    LawKind kind;
    real k;           /* N/m^n */
    real n;           /* exponent of d */
    real e;           /* restitution */
    real damping;     /* kelvin_voigt*: c, N s/m; jankowski: 2 xi sqrt(k m); hertz_damped: a */
    int clock;        /* q: in s = t^(1/q) the force is smooth where d passes 0; 1: it is smooth in t */
    bool exact_clock; /* false: no such q up to 10 exists, s only tames the singularity */
} Law;

/* A distance that forces can act along: a sum of weights times a few unknowns. */
typedef struct {
    int weights, of[MAX_WEIGHTS]; /* the unknowns */
    real weight[MAX_WEIGHTS];
    int pushes, pushed[MAX_UNKNOWNS]; /* the unknowns that a unit force along it accelerates, */
    real push[MAX_UNKNOWNS];          /* and how: mass matrix^-1 times the weights */
} Form;

/* d = its form minus the gap. A force F is compression: its form times -F. */
typedef struct {
    Form form;
    real gap;
    real mass; /* 1 / (weights times pushes of its form) */
    Law law;
} Contact;

enum { LINK = -1 };

/* A storey that can yield, bilinear with kinematic hardening: its shear is ratio k drift + (1 - ratio) k z, z being the
   drift without the plastic drift, and |z| <= limit. The spring of a link that slips is one as well. */
typedef struct {
    int building; /* LINK: of a link */
    int number;   /* from 1, of the storey of its building, or of the link */
    Form form; /* its drift; of a link: how much nearer its ends have come */
    real k, ratio, force, limit; /* limit = force / k */
    real collapse; /* |drift| at which it has collapsed, which ends the run; 0: never */
} Storey;

typedef struct {
    int count;
    real *time, *acceleration; /* scaled */
} Record;

/* The unknowns of a building are the displacements of its floors relative to its foundation, which may sway and rock: a
   floor moves by its own unknown + that of swaying + its level times that of rocking. */
typedef struct {
    char name[MAX_NAME];
    int first, floors;       /* the lowest floor in the vector of all unknowns; their number */
    int sway, rocking;       /* unknowns of the foundation, m and rad (positive: leans to the right); -1: it does not move so */
    real level[MAX_UNKNOWNS]; /* m, of its floors above the foundation; 0 where that does not rock */
} Building;

/* Gravity on a storey that leans. */
typedef struct {
    Form form;      /* the lean: drift, and height times the rotation of the foundation */
    real stiffness; /* weight over height, N/m */
} Lean;

typedef struct {
    int unknowns;  /* building by building from left to right in every vector, floors before foundation */
    int buildings; /* each is a neighbour of the next one */
    Building building[MAX_BUILDINGS];
    real mass[MAX_UNKNOWNS]; /* of floors and foundations; where a foundation rocks, its moment of inertia and theirs */
    real carried[MAX_UNKNOWNS]; /* how fast the unknowns change where everything on the ground moves with 1 m/s */
    real pulled[MAX_UNKNOWNS];  /* masses on which the ground acts: those in `mass`, but no inertia */
    real soil[MAX_UNKNOWNS]; /* dashpots under the foundations, which are in C as well */
    bool has_foundation;
    bool complete; /* the buildings are: masses, leans and foundations are known */
    real factor[MAX_UNKNOWNS][MAX_UNKNOWNS]; /* of the mass matrix: L below the diagonal, D on it, of L D L' */
    real u0[MAX_UNKNOWNS], v0[MAX_UNKNOWNS];
    real K[MAX_UNKNOWNS][MAX_UNKNOWNS], C[MAX_UNKNOWNS][MAX_UNKNOWNS]; /* K of the columns, without gravity */
    real gravity[MAX_UNKNOWNS]; /* weight over height of the storey below each floor, N/m; 0: none acts on its lean */
    int leans;
    Lean lean[MAX_UNKNOWNS];
    int contacts;
    Contact contact[MAX_CONTACTS];
    int storeys; /* only those that can yield; links that slip are the last */
    int links;
    Storey storey[MAX_UNKNOWNS];
    Record record;
    real min_approach_velocity;
    double output_step, stop;
} Scene;

/* Reads an input file ("-": standard input); ends the program with a message where it is wrong. */
void read_scene(const char *path, Scene *scene);

/* Ends the program with a message. */
_Noreturn void fail(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* ---- form.c: distances that forces act along ---- */

void add_weight(Form *form, int unknown, real weight);
/* Works out what a force along a form does; weights and masses are complete. */
void find_pushes(const Scene *scene, Form *form);
/* A form times a vector of all unknowns. */
real along(const Form *form, const real *unknowns);
/* What a force along a form does to the accelerations (an impulse: velocities) of all unknowns. */
void push(const Form *form, real force, real *unknowns);
/* What a unit force along b does to the acceleration of a. */
real coupling(const Form *a, const Form *b);
/* Solves a x = b for a symmetric positive definite a of order n, which is overwritten; x replaces b. */
void solve_linear(int n, real a[MAX_CONTACTS][MAX_CONTACTS], real *b);

/* ---- foundation.c: floors on foundations that move ---- */

/* Adds weight times the displacement of something that moves with a foundation, at a level above it. */
void add_rigid(const Scene *scene, Form *form, int building, real level, real weight);
/* Adds weight times the displacement of a floor, from 1; 0: the foundation. */
void add_floor(const Scene *scene, Form *form, int building, int floor, real weight);
/* Factors the mass matrix of the unknowns. */
void factor_masses(Scene *scene);
/* Replaces a vector by the mass matrix^-1 times it. */
void divide_by_masses(const Scene *scene, real *unknowns);
/* Displacements relative to the ground of everything in `mass`, from the unknowns; velocities alike. */
void absolute(const Scene *scene, const real *unknowns, real *out);

/* ---- gravity.c: weights on storeys that lean ---- */

/* The storeys on which gravity acts, when the buildings are complete. */
void find_leans(Scene *scene);
/* What gravity does to the accelerations of all unknowns, from displacements; to their rates, from velocities. */
void push_on(const Scene *scene, const real *lean, real *unknowns);
/* What weights have given: minus the work of gravity from the upright position on. */
real gravity_energy(const Scene *scene, const real *displacements);
/* An entry of the stiffness matrix of the elastic buildings under gravity, each on a base that does not move. */
real stiffness_under_gravity(const Scene *scene, int i, int j);

/* ---- structure.c: damping matrices from ratios, which are those of the buildings under gravity ---- */

/* Writes the damping matrix of one building (floors first .. first+n-1) into scene->C. */
void damping_from_ratios(Scene *scene, int first, int n, const real *ratios);
void damping_rayleigh(Scene *scene, int first, int n, real ratio, int mode_1, int mode_2);

/* ---- law.c: impact laws ---- */

/* What a contact is doing. Closed contacts are in every mode but OPEN. */
typedef enum {
    OPEN,
    PUSHING,   /* the law with its damping */
    RESTORING, /* jankowski while v <= 0: spring only */
    CLIPPED,   /* the law would pull: no force */
    STUCK      /* stereomechanical: held together by the reaction */
} Mode;

/* Completes a law from its constants; m is the effective mass, formula the name of the damping formula or NULL. */
void prepare_law(Law *law, real m, const char *formula);
/* Force and its time derivative for penetration d, rate v and its derivative a; V: approach velocity, 0 for none. */
real law_force(const Law *law, Mode mode, real V, real d, real v);
real law_force_rate(const Law *law, Mode mode, real V, real d, real v, real a);
/* A quantity that is negative where the law would pull (laws that are clipped), and its time derivative. */
real law_push(const Law *law, real V, real d, real v);
real law_push_rate(const Law *law, real V, real v, real a);
bool law_is_clipped(const Law *law, real V);

/* ---- gauss.c: Gauss-Legendre collocation on [0, 1] ---- */

typedef struct {
    int stages;
    real node[MAX_STAGES], weight[MAX_STAGES];
    real integral[MAX_STAGES][MAX_STAGES]; /* [i][j]: integral from 0 to node i of the Lagrange polynomial j */
    real tail[2][MAX_STAGES];              /* rows giving the last two Legendre coefficients of stage values */
} Gauss;

void prepare_gauss(Gauss *gauss, int stages);
/* row[j]: integral from 0 to x of the Lagrange polynomial j. */
void integral_row(const Gauss *gauss, real x, real *row);

/* ---- step.c: one step ---- */

/* Everything known at one time. */
typedef struct {
    real t, ground;
    real u[MAX_UNKNOWNS], v[MAX_UNKNOWNS], a[MAX_UNKNOWNS]; /* the unknowns */
    real d[MAX_CONTACTS], rate[MAX_CONTACTS], rate_change[MAX_CONTACTS], force[MAX_CONTACTS];
    real z[MAX_UNKNOWNS], plastic[MAX_UNKNOWNS]; /* of the storeys that can yield: elastic and plastic part of the drift */
    real drift_rate[MAX_UNKNOWNS], drift_change[MAX_UNKNOWNS]; /* its first and second derivative */
} Point;

/* How time runs with x in [0, 1]: t = t0 + H x, H x^q, or H (1 - (1-x)^q). */
typedef enum { PLAIN, FROM_ENTRY, TO_RELEASE } ClockKind;
typedef struct {
    ClockKind kind;
    int q;
} Clock;

/* State of the contacts and of the storeys that can yield during one step. */
typedef struct {
    Mode mode[MAX_CONTACTS]; /* changed by set_mode */
    real V[MAX_CONTACTS]; /* divisor of the law: approach velocity, not below the floor; 0: no damping */
    int held, held_contact[MAX_CONTACTS]; /* those that are STUCK */
    real held_inverse[MAX_CONTACTS][MAX_CONTACTS]; /* of their couplings: reactions from relative accelerations */
    int yielding[MAX_UNKNOWNS]; /* of each storey: the direction of its drift (+1, -1) while it yields, 0 while elastic */
    bool collapsed; /* a storey has: the run ends */
} Phases;

typedef struct {
    Clock clock;
    real H;
    Point point[MAX_STAGES + 2];      /* start, stages, end */
    real x[MAX_STAGES + 2];
    real dt_dx[MAX_STAGES];           /* at the stages */
    real tail;                        /* of the Legendre series of the velocities' derivative, m/s */
    int iterations;
    bool solved; /* the stage values belong to this start, clock and about this H; set false with another start */
} Step;

/* What the steps of one run share. */
typedef struct {
    const Scene *scene;
    Gauss gauss;
    int entries[MAX_UNKNOWNS], column[MAX_UNKNOWNS][MAX_UNKNOWNS]; /* of the matrices below, C and all forms */
    real k_over_m[MAX_UNKNOWNS][MAX_UNKNOWNS], c_over_m[MAX_UNKNOWNS][MAX_UNKNOWNS];
    real segment_time, segment_ground, segment_slope; /* ground acceleration of the present piece */
    Phases phases;
    real u_scale, v_scale; /* largest values so far */
    long steps, rejected, iterations;
} Solver;

void prepare_solver(Solver *solver, const Scene *scene, int stages);
void set_mode(Solver *solver, int contact, Mode mode);
/* The forces that take the rates of change `rate` (of the STUCK contacts, in their order) away. */
void held_forces(const Phases *phases, const real *rate, real *force);
/* Fills rates, forces and accelerations of a point from its t, u, v, d. */
void complete_point(const Solver *solver, Point *p);
/* Time derivative of the force of a stuck contact. */
real reaction_rate(const Solver *solver, int contact, const Point *p);
/* Solves the collocation equations from step->point[0] over H; false where the iteration does not converge. */
bool solve_step(Solver *solver, Step *step, Clock clock, real H);
/* The collocation polynomial at x. */
void dense_point(const Solver *solver, const Step *step, real x, Point *p);
/* Time from the start of the step at x. */
real clock_time(Clock clock, real H, real x);
static inline Point *step_end(const Solver *solver, Step *step) { return &step->point[solver->gauss.stages + 1]; }

/* ---- correct.c ---- */

/* Turns the residuals of the stages' accelerations into their Newton corrections; false where that fails. */
bool correct_stages(const Solver *solver, const Step *step, real residual[MAX_STAGES][MAX_UNKNOWNS]);

/* ---- event.c: where a contact changes its mode, a storey its phase ---- */

/* The last three are of a storey: sign z - limit, its drift rate, sign drift - that of its collapse. */
typedef enum { PENETRATION, RATE, PUSH, REACTION, YIELD, TURN, COLLAPSE } Quantity;

/* Something changes when `sign` times the quantity becomes positive. */
typedef struct {
    int of; /* contact or storey */
    Quantity quantity;
    int sign;
} Guard;

enum { MAX_GUARDS = 2 * (MAX_CONTACTS + MAX_UNKNOWNS) };

typedef struct {
    Guard guard;
    real x, near; /* in the step in which it was found: when it happens, and a first guess of the guard's root */
} Event;

/* The guards in the present modes and phases; returns their number. */
int present_guards(const Solver *solver, Guard guards[MAX_GUARDS]);
real guard_value(const Solver *solver, Guard guard, const Point *p); /* times sign */
real guard_rate(const Solver *solver, Guard guard, const Point *p);  /* times sign */
/* Size of the rounding errors of a guard is about 1e-34 times this. */
real guard_scale(const Solver *solver, Guard guard);
/* A drift rate is 0 but for rounding where a storey turns. */
static inline real resting_rate(const Solver *solver) { return 1e-28Q * solver->v_scale; }
/* The first event within a solved step, on its polynomial, which is good to the given part of the largest values. */
bool first_event(const Solver *solver, const Step *step, real error, Event *event);
/* The first x between points from and to at which f(p) turns from negative to positive, on the polynomial. */
typedef real PointFunction(const Solver *solver, const void *context, const Point *p);
real dense_root(const Solver *solver, const Step *step, real lo, real hi, PointFunction *f, const void *context);
/* Changes the length of a step until the guard is 0 at its end, starting from H; false where that fails. */
bool locate(Solver *solver, Step *step, Clock clock, real H, Guard guard);

/* ---- episode.c: what is recorded of each contact ---- */

typedef struct {
    int contact;
    bool open;
    real start, end, approach_velocity, separation_velocity;
    real peak_force, peak_time, peak_penetration, impulse, dissipated;
} Episode;

typedef struct {
    int count, capacity;
    Episode *list;
    int current[MAX_CONTACTS]; /* open episode of each contact, -1 */
} Episodes;

Episode *begin_episode(Episodes *episodes, int contact, const Point *p, real V);
void end_episode(Episodes *episodes, int contact, const Point *p);
/* Adds impulse and work of an accepted step and looks for peaks in it. `scratch` is used for shorter steps. */
void record_step(Solver *solver, Episodes *episodes, const Step *step, Step *scratch);

/* ---- solve.c: one solution ---- */

typedef struct {
    real input, kinetic, strain, viscous, impact, hysteretic, gravity;
    real soil; /* part of viscous */
} Energy;

/* What is written about a storey that can yield. */
typedef struct {
    real shear, plastic, cumulative, peak; /* N, without damping; m; m; m: largest |drift| so far */
    int yielding;
} StoreyRow;

typedef struct {
    real time, u[MAX_UNKNOWNS], v[MAX_UNKNOWNS]; /* absolute displacements, relative to the ground, and velocities */
    Energy energy;
    StoreyRow storey[MAX_UNKNOWNS];
} Row;

/* A storey begins to yield (direction +1, -1), is elastic again (0) or has collapsed (+2, -2). */
typedef struct {
    int storey, direction;
    real time, drift, plastic, rate;
} Switch;

typedef struct {
    int stages;
    real tolerance;
    int rows;
    Row *row;
    Episodes episodes;
    int switches, switch_capacity;
    Switch *switched;
    long steps, rejected, iterations;
    double seconds, energy_residual;
} Solution;

void solve(const Scene *scene, int stages, real tolerance, Solution *solution);

/* Everything that changes while a scene is solved. */
typedef struct {
    const Scene *scene;
    Solver solver;
    Solution *solution;
    real tolerance;
    Point now;
    Step step, scratch;
    bool fresh[MAX_CONTACTS];   /* just entered: its law has a root where the next step starts */
    real H_open, H_closed;      /* proposed step */
    real H_entry[MAX_CONTACTS]; /* first step of the last episode */
    int events_now;             /* since the last step */
    Energy energy;
    real initial_energy;
    real cumulative[MAX_UNKNOWNS], peak[MAX_UNKNOWNS]; /* of the storeys: sum of plastic steps, largest |drift| so far */
} Run;

/* ---- mode.c: what happens at an event ---- */

/* Contacts with d > 0 at the start are closed, without approach velocity. */
void close_at_start(Run *run);
/* Changes the mode (phase) of the guard's contact (storey), and of others whose guards are 0 at the same time. */
void fire(Run *run, Guard guard);

/* ---- rigid.c: stereomechanical contacts, which share floors or not ---- */

/* Takes the relative velocities of the floors of STUCK contacts away. */
void hold_together(Run *run);
/* The coefficient of restitution at an approach velocity; 0 where the rebound would be too slow to matter. */
real returned_share(const Run *run, int contact, real rate);
/* The impulses of contact `first` and of those that touch with it. */
void exchange_momentum(Run *run, int first);

/* ---- yielding.c: storeys that yield ---- */

/* The guards of a storey in its present phase; returns their number (at most 2). */
int storey_guards(const Solver *solver, int storey, Guard guards[2]);
/* Drifts beyond the limits at the start are plastic, as if the storey had been pushed there slowly. */
void start_storeys(Run *run);
/* What follows where a guard of a storey has become positive. */
void switch_storey(Run *run, Guard guard);
/* After an impulse: a storey that yields and now moves back is elastic. */
void renew_storeys(Run *run);
/* Plastic steps and largest drifts in an accepted step. */
void record_storeys(Run *run, const Step *step);
StoreyRow storey_row(const Run *run, int storey);
/* Recoverable energy less that of storeys which are all elastic; energy lost by yielding so far. */
real recoverable_change(const Run *run);
real hysteretic_energy(const Run *run);

/* ---- march.c ---- */

/* Integrates to t_end, over which the ground acceleration is one linear piece. */
void advance(Run *run, real t_end);
void update_scales(Run *run);

/* ---- proof.c: how far the solution can be trusted ---- */

typedef struct {
    Solution second;
    double u, v, time; /* largest differences; u and v relative to the largest value, time in s */
    bool same_impacts;
    double plastic, yield_time; /* largest differences of plastic drifts, relative, and of yields and turns, s */
    bool same_yields;
    double *sensitivity; /* per row */
} Proof;

/* Solves the scene again in another way, and another one that differs in the 18th digit. */
void prove(const Scene *scene, const Solution *best, Proof *proof);

/* ---- output.c ---- */

void print_run(const Solution *solution);
/* Writes OUTPUT.displacements.csv, OUTPUT.impacts.csv and, where storeys can yield, OUTPUT.storeys.csv and
   OUTPUT.yields.csv; proof: NULL without one. */
void write_files(const char *output, const char *made_by, const Scene *scene, const Solution *best, const Proof *proof);

#endif
