"""The same bits everywhere: outputs of all cases and saved states, on all platforms that run here.

Each function returns what is wrong, a line each.
"""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from itertools import chain

from releasing.cases import STEPS
from releasing.hosts import FOLDER
from releasing.runs import Run, carry_out


def expect(cases, host):
    """The outputs that all others must have: this host's, kept beside each case, with the states of two points."""
    runs = [Run(case, host, "expected") for case in cases]
    problems = carry_out(host, runs)
    if problems:
        return problems
    for run in runs:
        (run.case.folder / "expected.outputs").write_bytes(run.outputs())
    held = [Run(case, host, "held", is_held=True) for case in in_both_versions(cases)]
    problems = carry_out(host, held)
    if problems:
        return problems
    for run in held:
        (run.case.folder / "held.outputs").write_bytes(run.outputs())
    saving = started(cases, host)
    problems = carry_out(host, saving) or [line for run in saving for line in run.differences(run.expected())]
    for run in saving:
        for kept, point in zip(run.kept_states(), run.saves):
            kept.write_bytes((FOLDER / run.state(point)).read_bytes())
    return problems


def started(cases, host):
    """Runs from the start that save a state on the way and at the end: of FMI 2.0, and of FMI 3.0 with stops at events."""
    runs = [Run(case, host, "start") for case in cases]
    runs += [Run(case, host, "fmi3-start", fmi=3, stops=True, is_held=True) for case in in_both_versions(cases)]
    return [replace(run, saves=(run.case.middle(run.expected()), STEPS)) for run in runs]


def in_both_versions(cases):
    return [case for case in cases if case.fmi3 is not None]


def versions(cases, hosts):
    """FMI 3.0 on every host, with steps that go through and with stops at events, has the outputs of FMI 2.0."""
    return together(hosts, lambda host: check_versions(in_both_versions(cases), host))


def check_versions(cases, host):
    runs = [
        Run(case, host, f"fmi3-{name}", fmi=3, stops=stops, is_held=True)
        for case in cases
        for name, stops in (("plain", False), ("stops", True))
    ]
    problems = carry_out(host, runs)
    return problems or [line for run in runs for line in run.differences(run.expected())]


def same_outputs(cases, hosts):
    """Outputs and states of every host have the bytes of what is kept beside the cases."""
    return together(hosts, lambda host: check(host, started(cases, host)))


def crosswise(cases, hosts):
    """What any host has saved, every host goes on from: to the same outputs, to the same bytes when saved again."""
    return together(
        hosts, lambda host: check(host, [continued(run, host) for saver in hosts for run in started(cases, saver)])
    )


def continued(run, host):
    """From the state that this run has saved on its way."""
    return gone_on(run, host, run.host.platform.name, run.state(run.saves[0]))


def gone_on(run, host, source, state):
    name = run.name.replace("start", f"from-{source}")
    return replace(run, host=host, name=name, start=run.saves[0], start_state=state)


def from_kept_states(cases, host):
    """Goes on from the states that are kept beside the cases, on a machine that has no other platform."""
    kept = [(run, f"cases/{run.case.name}/{run.kept_states()[0].name}") for run in started(cases, host)]
    return check(host, [gone_on(run, host, "kept", state) for run, state in kept])


def check(host, runs):
    problems = carry_out(host, runs)
    if problems:
        return problems
    return [line for run in runs for line in (*run.differences(run.expected()), *state_differences(run))]


def state_differences(run):
    problems = []
    for kept, point in zip(run.kept_states(), run.saves):
        if (FOLDER / run.state(point)).read_bytes() != kept.read_bytes():
            problems.append(f"{run.state(point)}: the saved state has other bytes than on the first platform")
    return problems


def together(hosts, work):
    with ThreadPoolExecutor(len(hosts)) as pool:
        return list(chain.from_iterable(pool.map(work, hosts)))
