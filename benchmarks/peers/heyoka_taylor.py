"""heyoka.py: Taylor series in double precision, compiled at run time, with terminal events.

One integrator per problem and tolerance, compiled once (setup time, not in the run time). The ground acceleration is
linear in time with two parameters, set anew at every sample of the record; the integration is asked for each sample in
turn. Each contact has parameters for its phase; entries, releases and changes of branch are events whose callbacks set
them. d^1.5 and d^(1/4) have no Taylor series at d = 0: with these laws a contact begins and ends at d = eps, small
enough not to be seen in the result. Storeys that yield have a plastic drift and a phase among the parameters, too.

Peak forces, impulses and energies are not computed.
"""

import time

import heyoka as hy
import numpy as np

from . import OUTPUT_STEP, Outcome

NAME = "heyoka"
WITHOUT = {"stereomechanical": "dying rebounds and sustained contact need a complementarity solver"}
PARAMETERS = {
    "none": [],
    "linear": ["closed"],
    "kelvin_voigt": ["closed", "damper"],
    "kelvin_voigt_no_tension": ["closed", "push"],
    "hertz": ["closed", "open"],
    "jankowski": ["closed", "open", "damper"],
    "hertz_damped": ["closed", "open", "relative", "push"],
}
EPS = dict.fromkeys(["hertz", "hertz_damped", "jankowski"], 1e-13)  # m


hy.set_logger_level_critical()


class Solver:
    """A compiled integrator."""

    def __init__(self, problem, ground, tolerance, eps=None):
        self.problem, self.eps = problem, eps if eps is not None else EPS.get(problem.law, 0.0)
        self.times, self.accelerations = ground
        self.impacts = 0
        start = time.perf_counter()
        self.integrator = self.compile(tolerance)
        self.setup = time.perf_counter() - start

    def compile(self, tolerance):
        mass, K, C = self.problem.matrices
        n = len(mass)
        u = [hy.expression(f"u{i}") for i in range(n)]
        v = [hy.expression(f"v{i}") for i in range(n)]
        forces = [[] for _ in range(n)]
        events = []
        for index, contact in enumerate(self.problem.contacts):
            left, right = contact.floor, contact.floor + self.problem.floors[0]
            force = self.force(contact, index, u[left] - u[right] - contact.gap, v[left] - v[right])
            forces[left].append(-1.0 * force)
            forces[right].append(force)
            events += self.events(contact, index, u[left] - u[right] - contact.gap, v[left] - v[right])
        for index, storey in enumerate(self.problem.yielding_storeys):
            lost, of_storey = self.yielding(storey, index, u, v)
            forces[storey.upper].append(lost)
            if storey.lower is not None:
                forces[storey.lower].append(-1.0 * lost)
            events += of_storey
        ground = hy.par[0] + hy.par[1] * (hy.time - hy.par[2])
        system = [(u[i], v[i]) for i in range(n)]
        for i in range(n):
            terms = [-K[i, j] / mass[i] * u[j] for j in range(n) if K[i, j] != 0.0]
            terms += [-C[i, j] / mass[i] * v[j] for j in range(n) if C[i, j] != 0.0]
            terms += [force * (1.0 / mass[i]) for force in forces[i]]
            system.append((v[i], hy.sum([*terms, -1.0 * ground])))
        return hy.taylor_adaptive(system, [0.0] * (2 * n), tol=tolerance, t_events=events, compact_mode=n > 10)

    def parameters(self, index):
        """Positions of the parameters of a contact: those that its law has."""
        names = PARAMETERS[self.problem.law]
        return {name: 3 + len(names) * index + i for i, name in enumerate(names)}

    def force(self, contact, index, d, v):
        par = {name: hy.par[position] for name, position in self.parameters(index).items()}
        if contact.law == "kelvin_voigt_no_tension":
            return par["push"] * (contact.stiffness * d + contact.damping * v)
        if contact.exponent == 1.0:
            spring = par["closed"] * (contact.stiffness * d)
            return spring + par["damper"] * (contact.damping * v) if "damper" in par else spring
        # While open, a constant stands in for d, whose powers would be no numbers.
        depth = par["closed"] * d + par["open"]
        root = hy.sqrt(depth)
        elastic = contact.stiffness * depth * root
        if contact.law == "hertz_damped":
            return par["push"] * elastic * (1.0 + par["relative"] * v)
        elastic = par["closed"] * elastic
        if contact.law == "jankowski":
            return elastic + par["damper"] * (contact.damping * hy.sqrt(root) * v)
        return elastic

    def events(self, contact, index, d, v):
        """Entry and release, and where the law changes its branch."""
        eps = self.eps
        at = self.parameters(index)
        n = len(self.problem.matrices[0])
        left, right = n + contact.floor, n + contact.floor + self.problem.floors[0]
        closed = [False]

        def set_phase(pars, **values):
            for name, value in values.items():
                if name in at:
                    pars[at[name]] = value

        def enter(integrator, _sign):
            if not closed[0]:
                closed[0] = True
                approach = max(integrator.state[left] - integrator.state[right], 1e-4)
                relative = contact.relative_damping / approach
                set_phase(integrator.pars, closed=1.0, damper=1.0, push=1.0, open=0.0, relative=relative)
                self.impacts += 1
            return True

        def release(integrator, _sign):
            closed[0] = False
            set_phase(integrator.pars, closed=0.0, damper=0.0, push=0.0, open=1.0)
            return True

        def turn(integrator, sign):
            """Jankowski's damper acts while the floors approach."""
            if closed[0]:
                set_phase(integrator.pars, damper=1.0 if sign > 0 else 0.0)
            return True

        def pull(integrator, sign):
            """A law that does not pull: without force until the floors part, or press again."""
            if closed[0]:
                set_phase(integrator.pars, push=1.0 if sign > 0 else 0.0)
            return True

        events = [
            hy.t_event(d - eps, direction=hy.event_direction.positive, callback=enter),
            hy.t_event(d - eps, direction=hy.event_direction.negative, callback=release),
        ]
        # A switch counts in contact only: at rest, say, v is 0 all the time and would stop the integrator for ever.
        while_closed = lambda value: hy.par[at["closed"]] * value + (1.0 - hy.par[at["closed"]])
        if contact.law == "jankowski":
            events.append(hy.t_event(while_closed(v), callback=turn))
        if contact.law == "kelvin_voigt_no_tension":
            events.append(hy.t_event(while_closed(contact.stiffness * d + contact.damping * v), callback=pull))
        if contact.law == "hertz_damped":
            events.append(hy.t_event(while_closed(1.0 + hy.par[at["relative"]] * v), callback=pull))
        return events

    def yielding(self, storey, index, u, v):
        """What a storey carries less than an elastic one, (1 - r) k (plastic drift), and where it yields and unloads.

        The plastic drift is `shift` while the storey is elastic, and `shift + drift` while it yields: `flow` is 1 then.
        """
        limit = storey.yield_force / storey.stiffness
        shift = 3 + len(PARAMETERS[self.problem.law]) * len(self.problem.contacts) + 2 * index
        flow = shift + 1
        between = lambda floors: floors[storey.upper] - (0.0 if storey.lower is None else floors[storey.lower])
        drift = between(u)

        def yields(integrator, _sign):
            elastic = between(integrator.state) - integrator.pars[shift]
            integrator.pars[shift] = -np.copysign(limit, elastic)
            integrator.pars[flow] = 1.0
            return True

        def unloads(integrator, _sign):
            # Just inside the limit: on it, where the rate is 0, rounding would be a yield.
            integrator.pars[shift] = between(integrator.state) + (1.0 - 1e-14) * integrator.pars[shift]
            integrator.pars[flow] = 0.0
            return True

        elastic = (drift - hy.par[shift]) * (1.0 / limit)
        rises = (1.0 - hy.par[flow]) * (elastic * elastic - 1.0) - hy.par[flow]
        turns = hy.par[flow] * between(v) + (1.0 - hy.par[flow])
        events = [
            hy.t_event(rises, direction=hy.event_direction.positive, callback=yields),
            hy.t_event(turns, callback=unloads),
        ]
        lost = (1.0 - storey.post_yield_ratio) * storey.stiffness
        return lost * (hy.par[shift] + hy.par[flow] * drift), events

    def reset(self):
        integrator = self.integrator
        integrator.time = 0.0
        integrator.state[:] = 0.0
        integrator.pars[:] = 0.0
        for index in range(len(self.problem.contacts)):
            for name, position in self.parameters(index).items():
                integrator.pars[position] = 1.0 if name == "open" else 0.0
        integrator.reset_cooldowns()
        self.impacts = 0

    def run(self, warm_up=False):
        if warm_up:
            self.run()
        self.reset()
        every = round(OUTPUT_STEP / (self.times[1] - self.times[0]))
        seconds, displacements = drive(self.integrator, self.times, self.accelerations, every, sum(self.problem.floors))
        return Outcome(seconds, displacements, self.impacts)


def drive(integrator, times, accelerations, every, n):
    """From sample to sample; returns the wall time and the first n states at every `every`-th sample."""
    slopes = np.diff(accelerations) / np.diff(times)
    ends, segments = times[1:].tolist(), list(zip(accelerations.tolist(), slopes.tolist(), times.tolist()))
    displacements = np.zeros((len(ends) // every + 1, n))
    pars, state, propagate = integrator.pars, integrator.state, integrator.propagate_until
    start = time.perf_counter()
    for index, (end, (pars[0], pars[1], pars[2])) in enumerate(zip(ends, segments), 1):
        propagate(end)
        if index % every == 0:
            displacements[index // every] = state[:n]
    return time.perf_counter() - start, displacements


def empty_loop(times, accelerations):
    """s, the same drive through the record of an equation that costs nothing: what Python's loop takes."""
    x = hy.make_vars("x")
    integrator = hy.taylor_adaptive([(x, hy.par[0] + hy.par[1] + hy.par[2])], [0.0])
    every = round(OUTPUT_STEP / (times[1] - times[0]))

    def once():
        integrator.time = 0.0
        return drive(integrator, times, accelerations, every, 1)[0]

    return min(once() for _ in range(30))
