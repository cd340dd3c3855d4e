/* Marching: step lengths, steps that end at an event, and everything that an accepted step brings about. */
#include "reference.h"

#include <math.h>

static real smaller(real a, real b) { return a < b ? a : b; }

/* ---- accepted steps ---- */

void update_scales(Run *run)
{
    real u[MAX_UNKNOWNS], v[MAX_UNKNOWNS];
    absolute(run->scene, run->now.u, u);
    absolute(run->scene, run->now.v, v);
    for (int i = 0; i < run->scene->unknowns; i++) {
        run->solver.u_scale = fmaxq(run->solver.u_scale, fmaxq(fabsq(run->now.u[i]), fabsq(u[i])));
        run->solver.v_scale = fmaxq(run->solver.v_scale, fmaxq(fabsq(run->now.v[i]), fabsq(v[i])));
    }
}

static void add_energy(Run *run, const Step *step)
{
    const Scene *scene = run->scene;
    for (int j = 0; j < run->solver.gauss.stages; j++) {
        const Point *p = &step->point[j + 1];
        real weight = run->solver.gauss.weight[j] * step->dt_dx[j], input = 0, viscous = 0, contacts = 0;
        real soil = 0, speed[MAX_UNKNOWNS];
        absolute(scene, p->v, speed);
        for (int i = 0; i < scene->unknowns; i++) {
            real damping = 0;
            for (int e = 0; e < run->solver.entries[i]; e++)
                damping += scene->C[i][run->solver.column[i][e]] * p->v[run->solver.column[i][e]];
            input -= scene->pulled[i] * p->ground * speed[i];
            viscous += p->v[i] * damping;
            soil += scene->soil[i] * p->v[i] * p->v[i];
        }
        for (int c = 0; c < scene->contacts; c++)
            contacts += p->force[c] * p->rate[c];
        run->energy.input += weight * input;
        run->energy.viscous += weight * viscous;
        run->energy.soil += weight * soil;
        run->energy.impact += weight * contacts;
    }
}

static void accept(Run *run)
{
    Solver *solver = &run->solver;
    record_step(solver, &run->solution->episodes, &run->step, &run->scratch);
    record_storeys(run, &run->step);
    add_energy(run, &run->step);
    run->now = *step_end(solver, &run->step);
    for (int c = 0; c < run->scene->contacts; c++) {
        if (run->fresh[c])
            run->H_entry[c] = run->step.H;
        run->fresh[c] = false;
        if (solver->phases.mode[c] == STUCK)
            run->now.d[c] = 0;
    }
    hold_together(run); /* no drift from rounding */
    complete_point(solver, &run->now);
    update_scales(run);
    run->events_now = 0;
    solver->steps++;
}

/* ---- step length ---- */

static Clock entry_clock(const Run *run, bool *exact)
{
    int q = 1;
    *exact = true;
    for (int c = 0; c < run->scene->contacts; c++)
        if (run->fresh[c]) {
            int other = run->scene->contact[c].law.clock, multiple = q;
            while (multiple % other)
                multiple += q;
            q = multiple;
            *exact = *exact && run->scene->contact[c].law.exact_clock;
        }
    return (Clock){q > 1 ? FROM_ENTRY : PLAIN, q};
}

/* Where the integrand is not a power series in the clock, the order of the quadrature does not help. */
static real tail_limit(const Run *run, bool exact)
{
    real limit = exact ? run->tolerance : fmaxq(run->tolerance * run->tolerance, 1e-31Q);
    return limit * run->solver.v_scale;
}

static bool any_closed(const Run *run)
{
    for (int c = 0; c < run->scene->contacts; c++)
        if (run->solver.phases.mode[c] != OPEN)
            return true;
    return false;
}

static real *proposal(Run *run) { return any_closed(run) ? &run->H_closed : &run->H_open; }

/* Two floors that touch and have hardly any speed against the force between them meet again soon. */
static real rebound_limit(const Run *run, real H)
{
    for (int c = 0; c < run->scene->contacts; c++) {
        real v = run->now.rate[c], a = run->now.rate_change[c];
        bool open = run->solver.phases.mode[c] == OPEN;
        if (run->now.d[c] == 0 && fabsq(v) > 1e-29Q * run->solver.v_scale && (open ? v < 0 && a > 0 : v > 0 && a < 0))
            H = smaller(H, 3 * fabsq(v / a));
    }
    return H;
}

static real choose_length(Run *run, real remaining)
{
    real H = rebound_limit(run, *proposal(run));
    if (H >= remaining)
        return remaining;
    return H > remaining / 2 ? remaining / 2 : H;
}

static void adapt_length(Run *run, real H, real limit)
{
    double ratio = run->step.tail > 0 ? (double)(limit / run->step.tail) : 1e30;
    double factor = 0.9 * pow(ratio, 1.0 / run->solver.gauss.stages);
    *proposal(run) = H * fmin(3, fmax(0.2, factor));
}

static void shorten(Run *run, real H)
{
    *proposal(run) = H;
    run->solver.rejected++;
    if (H < 1e-30Q)
        fail("the step length collapses at t = %.17g", (double)run->now.t);
}

/* ---- events ---- */

/* The clock for the step that ends with a release: the root of the law is at its end. */
static Clock release_clock(const Run *run, Guard guard)
{
    if (guard.quantity != PENETRATION)
        return (Clock){PLAIN, 1};
    Mode mode = run->solver.phases.mode[guard.of];
    int q = run->scene->contact[guard.of].law.clock;
    if (mode == OPEN || mode == CLIPPED || q == 1)
        return (Clock){PLAIN, 1};
    return (Clock){TO_RELEASE, mode == RESTORING ? 2 : q};
}

static bool find_event(const Run *run, real limit, Event *event)
{
    return first_event(&run->solver, &run->step, smaller(run->step.tail, limit) / run->solver.v_scale, event);
}

/* Tries one step up to the release; false where it is still too far for that. */
static bool step_to_release(Run *run, Guard guard, real H)
{
    Event event;
    bool fresh;
    real limit = tail_limit(run, run->scene->contact[guard.of].law.exact_clock);
    if (entry_clock(run, &fresh).q > 1 || !locate(&run->solver, &run->step, release_clock(run, guard), H, guard))
        return false;
    if (run->step.tail > limit || (find_event(run, limit, &event) && event.x < 1 - 1e-10Q))
        return false;
    accept(run);
    fire(run, guard);
    return true;
}

static void end_step_at(Run *run, Guard guard, real H)
{
    if (!locate(&run->solver, &run->step, run->step.clock, H, guard))
        fail("event of %s %d not found at t = %.17g", guard.quantity < YIELD ? "contact" : "yielding storey",
             guard.of + 1, (double)run->now.t);
}

/* The step ends where the drift of an elastic storey turns, close to its limit. Where that is beyond the limit by more
   than rounding, the storey has yielded before: the step ends there instead. */
static Guard check_limit(Run *run, Guard turn)
{
    Guard yields = {turn.of, YIELD, -turn.sign};
    const Point *end = step_end(&run->solver, &run->step);
    real beyond = guard_value(&run->solver, yields, end), slows = fabsq(end->drift_change[turn.of]);
    if (beyond <= 1e-31Q * run->solver.u_scale)
        return turn;
    end_step_at(run, yields, run->step.H - sqrtq(2 * beyond / slows));
    return yields;
}

static void step_to_event(Run *run, Event event)
{
    Guard guard = event.guard;
    end_step_at(run, guard, clock_time(run->step.clock, run->step.H, event.near));
    if (guard.quantity == TURN && !run->solver.phases.yielding[guard.of])
        guard = check_limit(run, guard);
    accept(run);
    fire(run, guard);
}

/* ---- marching ---- */

/* One trial: a step, an event, or a shorter proposal. */
static void try_step(Run *run, real t_end)
{
    bool exact;
    Clock clock = entry_clock(run, &exact);
    real H = choose_length(run, t_end - run->now.t), limit = tail_limit(run, exact);
    run->step.point[0] = run->now;
    run->step.solved = false;
    if (!solve_step(&run->solver, &run->step, clock, H)) {
        shorten(run, H / 4);
        return;
    }
    Event event;
    bool found = find_event(run, limit, &event);
    real H_event = found ? clock_time(clock, H, event.x) : H;
    if (found && event.x == 0) {
        if (++run->events_now > 1000)
            fail("events without end at t = %.17g", (double)run->now.t);
        fire(run, event.guard);
    } else if (found && release_clock(run, event.guard).q > 1) {
        if (!step_to_release(run, event.guard, H_event))
            shorten(run, smaller(H_event, H) / 2);
    } else if (run->step.tail > limit) {
        adapt_length(run, H, limit);
        shorten(run, smaller(*proposal(run), H * 0.8Q));
    } else if (found) {
        step_to_event(run, event);
    } else {
        if (H >= *proposal(run) || run->step.tail > limit / 1000)
            adapt_length(run, H, limit);
        accept(run);
    }
}

void advance(Run *run, real t_end)
{
    while (!run->solver.phases.collapsed && t_end - run->now.t > 1e-31Q)
        try_step(run, t_end);
    if (!run->solver.phases.collapsed)
        run->now.t = t_end;
}
