"""Runs of cases on a host: what it is told, and whether what comes out has the bytes that are expected."""

from dataclasses import dataclass

from releasing.cases import STEP, STEPS, Case
from releasing.hosts import FOLDER, Host


@dataclass(frozen=True)
class Run:
    """A case on a host: from its start, or from a state that some platform has saved."""

    case: Case
    host: Host
    name: str  # of the files that it writes
    start: int = 0
    start_state: str = ""  # a file; as all names here relative to the folder of the hosts
    saves: tuple = ()  # points at which a state is saved
    fmi: int = 2  # version of the standard
    stops: bool = False  # at events, of FMI 3.0
    is_held: bool = False  # inputs do not change within a step

    def file(self, ending):
        return f"{self.host.platform.name}/{self.case.name}.{self.name}.{ending}"

    def state(self, point):
        return self.file(f"{point}.state")

    def outputs(self):
        return (FOLDER / self.file("outputs")).read_bytes()

    def expected(self):
        """The outputs that all others must have, kept beside the case."""
        return (self.case.folder / ("held.outputs" if self.is_held else "expected.outputs")).read_bytes()

    def kept_states(self):
        """The files beside the case with the states of its saves on the first platform."""
        version = "fmi3-" if self.fmi == 3 else ""
        return [self.case.folder / f"{version}{kind}.state" for kind in ("middle", "end")]

    def order(self):
        """Writes the file that the host reads and returns its name."""
        case = self.case
        if case.inputs:
            (FOLDER / self.file("inputs")).write_bytes(case.input_rows(self.is_held))
        if self.fmi == 3:
            folder, description, token = case.folder / "fmi3", case.fmi3, "instantiationToken"
        else:
            folder, description, token = case.folder, case.description, "guid"
        # A location in FMI 2.0 is a URI, in FMI 3.0 a path with a separator at its end.
        resources = self.host.path(folder / "resources") + "/" if self.fmi == 3 else self.host.uri(folder / "resources")
        states = [f"{point} {self.state(point)}" for point in self.saves]
        lines = [
            f"library {self.host.platform.name}/{self.host.platform.library}",
            f"fmi {self.fmi}",
            f"stops {int(self.stops)}",
            f"resources {resources}",
            f"name {description.get('modelName')}",
            f"guid {description.get(token)}",
            f"step {STEP!r}",
            f"start {self.start}",
            f"stop {STEPS}",
            f"inputs_file {self.file('inputs')}",
            f"output_file {self.file('outputs')}",
            self.references("reals", case.of("output", "Real")),
            self.references("integers", case.of("output", "Integer")),
            self.references("booleans", case.of("output", "Boolean")),
            self.references("inputs", case.inputs),
            self.references("partials", [variable for pair in case.partials for variable in pair]),
            f"states {len(states)} " + " ".join(states),
        ]
        if self.start_state:
            lines.append(f"start_state {self.start_state}")
        (FOLDER / self.file("run")).write_text("\n".join(lines) + "\n")
        return self.file("run")

    def references(self, key, variables):
        """Value references, those of FMI 3.0 by the names of the variables."""
        of = self.case.references_of_fmi3 if self.fmi == 3 else None
        found = [of[variable.get("name")] if of else variable.get("valueReference") for variable in variables]
        return " ".join([key, str(len(found)), *found])

    def differences(self, expected):
        """Against all rows of the run from the start; one line about the first difference."""
        found, expected = self.outputs(), expected[self.start * self.case.row_size :]
        where = f"{self.case.name} on {self.host.platform.name}"
        where += f" from {self.start_state}" if self.start_state else ""
        where += f" in FMI 3.0{' with stops' if self.stops else ''}" if self.fmi == 3 else ""
        return [f"{where}: {line}" for line in first_difference(self.case, found, expected, self.start)]


def first_difference(case, found, expected, start=0):
    if found == expected:
        return []
    if len(found) != len(expected):
        return [f"{len(found)} bytes of outputs, expected {len(expected)}"]
    position = next(index for index, pair in enumerate(zip(found, expected)) if pair[0] != pair[1])
    row, offset = divmod(position, case.row_size)
    for name, size in case.columns:
        if offset < size:
            begin = position - offset
            return [
                f"{name} at point {start + row} is {found[begin : begin + size].hex()}, "
                f"expected {expected[begin : begin + size].hex()}"
            ]
        offset -= size
    return []


def carry_out(host, runs):
    """All runs of a host in one process; returns what went wrong."""
    code, said = host.start(host.program, [run.order() for run in runs])
    return [f"{host.platform.name}: the host ended with code {code}: {said}"] if code else []
