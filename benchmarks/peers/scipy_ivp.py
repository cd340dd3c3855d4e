"""SciPy's solve_ivp as a user would write it, with NumPy: with events (the integration stops and starts anew at each
entry, release and turn) or plain (the right-hand side asks whether d > 0).

DOP853 goes from sample to sample of the record, for its order is lost where the ground acceleration has a kink; LSODA,
whose start is costly, from output to output.
"""

import time

import numpy as np
from scipy.integrate import solve_ivp

from . import OUTPUT_STEP, Outcome


class Solver:
    def __init__(self, problem, ground, method, tolerance, events):
        self.problem, self.ground, self.method, self.tolerance, self.events = problem, ground, method, tolerance, events
        mass, K, C = problem.matrices
        n = len(mass)
        self.n = n
        self.matrix = np.hstack([-K / mass[:, None], -C / mass[:, None]])
        contacts = problem.contacts
        self.incidence = np.zeros((len(contacts), n))
        for row, contact in zip(self.incidence, contacts):
            row[contact.floor], row[contact.floor + problem.floors[0]] = 1.0, -1.0
        self.pull = -(self.incidence / mass).T
        self.gap = np.array([contact.gap for contact in contacts])
        self.law, first = problem.law, contacts[0]
        self.k, self.exponent, self.a = first.stiffness, first.exponent, first.relative_damping
        self.c = np.array([contact.damping for contact in contacts])
        self.setup = 0.0

    def forces(self, d, v):
        """Of closed contacts, on the branch that each is on."""
        d = np.maximum(d, 0.0)
        elastic = self.k * d**self.exponent
        if self.law == "hertz_damped":
            return elastic * (1.0 + self.a * v / self.V)
        if self.law == "jankowski":
            return elastic + self.damper * self.c * d**0.25 * v
        return elastic + self.c * v

    def slope(self, t, y):
        u, v = y[: self.n], y[self.n :]
        d, w = self.incidence @ u - self.gap, self.incidence @ v
        closed = self.closed
        if not self.events:
            closed, self.damper = d > 0.0, w > 0.0
        acceleration = self.matrix @ y - np.interp(t, *self.ground)
        if closed.any():
            force = np.where(closed, self.forces(d, w), 0.0)
            if self.law in ("kelvin_voigt_no_tension", "hertz_damped"):
                force = np.maximum(force, 0.0)
            acceleration = acceleration + self.pull @ force
        return np.concatenate([v, acceleration])

    def event_functions(self):
        functions = []
        for index, row in enumerate(self.incidence):
            functions.append(lambda t, y, row=row, gap=self.gap[index]: row @ y[: self.n] - gap)
            functions[-1].direction = -1.0 if self.closed[index] else 1.0
            if self.law == "jankowski":
                moving = self.closed[index]
                functions.append(lambda t, y, row=row, moving=moving: row @ y[self.n :] if moving else 1.0)
                functions[-1].direction = -1.0 if self.damper[index] else 1.0
        for function in functions:
            function.terminal = True
        return functions

    def enter_or_leave(self, found, y):
        """Acts on the events that stopped the integration; returns how many contacts were entered."""
        entered, per_contact = 0, 2 if self.law == "jankowski" else 1
        for position, times in enumerate(found):
            if len(times) == 0:
                continue
            index = position // per_contact
            if position % per_contact == 1:
                self.damper[index] = not self.damper[index]
            elif self.closed[index]:
                self.closed[index] = False
            else:
                self.closed[index] = self.damper[index] = True
                self.V[index] = max(self.incidence[index] @ y[self.n :], 1e-4)
                entered += 1
        return entered

    def run(self, warm_up=False):
        count = len(self.gap)
        self.closed, self.damper, self.V = np.zeros(count, bool), np.zeros(count, bool), np.ones(count)
        every = round(OUTPUT_STEP / (self.ground[0][1] - self.ground[0][0]))
        knots = self.ground[0][:: 1 if self.method == "DOP853" else every]
        rows = round(self.problem.stop / OUTPUT_STEP)
        stride = (len(knots) - 1) // rows
        options = {"method": self.method, "rtol": self.tolerance, "atol": 0.01 * self.tolerance}
        displacements = np.zeros((rows + 1, self.n))
        y, impacts = np.zeros(2 * self.n), 0
        start = time.perf_counter()
        for index in range(1, len(knots)):
            y, entered = self.integrate(knots[index - 1], knots[index], y, options)
            impacts += entered
            if index % stride == 0:
                displacements[index // stride] = y[: self.n]
        seconds = time.perf_counter() - start
        return Outcome(seconds, displacements, impacts if self.events else None)

    def integrate(self, t, end, y, options):
        """To the next output; returns the state and how many contacts were entered."""
        entered = 0
        while True:
            events = self.event_functions() if self.events else None
            solution = solve_ivp(self.slope, (t, end), y, events=events, **options)
            if solution.status < 0:
                raise RuntimeError(solution.message)
            if solution.status == 0:
                return solution.y[:, -1], entered
            stopped = next(index for index, times in enumerate(solution.t_events) if len(times))
            t, y = solution.t_events[stopped][0], solution.y_events[stopped][0]
            entered += self.enter_or_leave(solution.t_events, y)
