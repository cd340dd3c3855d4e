"""One byte that differs is found and named, in outputs and in saved states."""

import struct
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from releasing import comparison, runs
from releasing.cases import STEPS, Case
from releasing.platforms import ARM

DESCRIPTION = """<fmiModelDescription modelName="Two" guid="{1}"><ModelVariables>
<ScalarVariable name="left.force[1]" valueReference="0" causality="input"><Real max="2e6"/></ScalarVariable>
<ScalarVariable name="left.acceleration[1]" valueReference="1" causality="output"><Real/></ScalarVariable>
<ScalarVariable name="contact[1].active" valueReference="2" causality="output"><Boolean/></ScalarVariable>
<ScalarVariable name="impacts" valueReference="3" causality="output"><Integer/></ScalarVariable>
</ModelVariables><ModelStructure><Outputs>
<Unknown index="2" dependencies="1"/><Unknown index="3" dependencies=""/><Unknown index="4" dependencies=""/>
</Outputs></ModelStructure></fmiModelDescription>"""

DESCRIPTION_3 = """<fmiModelDescription modelName="Two" instantiationToken="{3}"><ModelVariables>
<Float64 name="left.force[1]" valueReference="10"/><Float64 name="left.acceleration[1]" valueReference="11"/>
<Boolean name="contact[1].active" valueReference="12"/><Int32 name="impacts" valueReference="13"/>
</ModelVariables></fmiModelDescription>"""


class PretendedHost:
    """Writes what it is given instead of running an FMU."""

    platform = ARM
    program = "host"

    def __init__(self, outputs, state):
        self.written_outputs, self.written_state = outputs, state

    def uri(self, folder):
        return folder.as_uri()

    def path(self, folder):
        return folder.as_posix()

    def start(self, program, orders):
        for order in orders:
            for line in (runs.FOLDER / order).read_text().splitlines():
                key, *values = line.split(" ")
                if key == "output_file":
                    (runs.FOLDER / values[0]).write_bytes(self.written_outputs)
                if key == "states":
                    for name in values[2::2]:
                        (runs.FOLDER / name).write_bytes(self.written_state)
        return 0, ""


class Bytes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / ARM.name).mkdir()
        for module in (runs, comparison):
            patch = mock.patch.object(module, "FOLDER", self.folder)
            patch.start()
            self.addCleanup(patch.stop)
        self.case = Case(self.folder / "cases/two")
        self.case.folder.mkdir(parents=True)
        (self.case.folder / "modelDescription.xml").write_text(DESCRIPTION)
        self.outputs = b"".join(
            struct.pack("<ddiid", point, 0.5, point % 3, point == 900, 2.0) for point in range(STEPS + 1)
        )
        (self.case.folder / "expected.outputs").write_bytes(self.outputs)
        for name in ("middle.state", "end.state"):
            (self.case.folder / name).write_bytes(b"a state")

    def problems(self, outputs, state=b"a state"):
        return comparison.same_outputs([self.case], [PretendedHost(outputs, state)])

    def test_the_row_is_read_from_the_description(self):
        names = [name for name, _ in self.case.columns]
        self.assertEqual(
            names,
            [
                "left.acceleration[1]",
                "der(left.acceleration[1])",
                "impacts",
                "contact[1].active",
                "d left.acceleration[1] / d left.force[1]",
            ],
        )
        self.assertEqual(self.case.row_size, 32)
        self.assertEqual(self.case.middle(self.outputs), 900)
        self.assertEqual(len(self.case.input_rows()), 16 * (STEPS + 1))

    def test_the_same_bytes(self):
        self.assertEqual(self.problems(self.outputs), [])

    def test_one_byte_of_the_outputs(self):
        for position, name in (
            (32 * 70 + 7, "left.acceleration[1]"),
            (32 * 70 + 8, "der(left.acceleration[1])"),
            (32 * 70 + 16, "impacts"),
            (32 * 70 + 20, "contact[1].active"),
            (32 * 70 + 31, "d left.acceleration[1] / d left.force[1]"),
        ):
            changed = bytearray(self.outputs)
            changed[position] ^= 1
            problems = self.problems(bytes(changed))
            self.assertEqual(len(problems), 1)
            self.assertIn(f"two on aarch64-linux: {name} at point 70 is ", problems[0])

    def test_a_row_less(self):
        self.assertIn("bytes of outputs, expected", self.problems(self.outputs[:-32])[0])

    def test_one_byte_of_a_state(self):
        problems = self.problems(self.outputs, b"a stale")
        self.assertEqual(len(problems), 2)
        self.assertIn("aarch64-linux/two.start.900.state: the saved state has other bytes", problems[0])

    def test_going_on_from_a_state(self):
        host = PretendedHost(self.outputs[900 * 32 :], b"a state")
        self.assertEqual(comparison.from_kept_states([self.case], host), [])
        order = (self.folder / "aarch64-linux/two.from-kept.run").read_text()
        self.assertIn("start_state cases/two/middle.state", order)
        changed = bytearray(self.outputs[900 * 32 :])
        changed[40] ^= 128
        host = PretendedHost(bytes(changed), b"a state")
        self.assertIn("der(left.acceleration[1]) at point 901", comparison.from_kept_states([self.case], host)[0])

    def test_crosswise_takes_every_direction(self):
        host = PretendedHost(self.outputs[900 * 32 :], b"a state")
        seen = []
        start = host.start
        host.start = lambda program, orders: seen.extend(orders) or start(program, orders)
        self.assertEqual(comparison.crosswise([self.case], [host]), [])
        self.assertEqual(seen, ["aarch64-linux/two.from-aarch64-linux.run"])
        order = (self.folder / seen[0]).read_text()
        self.assertIn("start_state aarch64-linux/two.start.900.state", order)

    def in_both_versions(self):
        (self.case.folder / "fmi3").mkdir()
        (self.case.folder / "fmi3/modelDescription.xml").write_text(DESCRIPTION_3)
        (self.case.folder / "held.outputs").write_bytes(self.outputs)
        return Case(self.case.folder)

    def test_states_of_both_versions_where_there_are_two(self):
        case = self.in_both_versions()
        for name in ("fmi3-middle.state", "fmi3-end.state"):
            (case.folder / name).write_bytes(b"a state")
        host = PretendedHost(self.outputs, b"a state")
        self.assertEqual(comparison.same_outputs([case], [host]), [])
        host = PretendedHost(self.outputs[900 * 32 :], b"a state")
        self.assertEqual(comparison.crosswise([case], [host]), [])
        self.assertEqual(comparison.from_kept_states([case], host), [])
        for name, state in (
            ("from-aarch64-linux", "aarch64-linux/two.fmi3-start.900.state"),
            ("from-kept", "cases/two/fmi3-middle.state"),
        ):
            order = (self.folder / f"aarch64-linux/two.fmi3-{name}.run").read_text()
            for line in ("fmi 3", "stops 1", "start 900", f"start_state {state}"):
                self.assertIn(f"\n{line}\n", order)
        (case.folder / "fmi3-end.state").write_bytes(b"a stale")
        problems = comparison.from_kept_states([case], host)
        self.assertEqual(len(problems), 1)
        self.assertIn("two.fmi3-from-kept.2000.state: the saved state has other bytes", problems[0])
        changed = bytearray(self.outputs)
        changed[32 * 950 + 16] ^= 1
        (case.folder / "held.outputs").write_bytes(changed)
        problems = comparison.crosswise([case], [host])
        self.assertIn("in FMI 3.0 with stops: impacts at point 950", problems[0])

    def test_versions_are_compared_where_there_are_two(self):
        host = PretendedHost(self.outputs, b"a state")
        self.assertEqual(comparison.in_both_versions([self.case]), [])
        case = self.in_both_versions()
        self.assertEqual(comparison.versions([case], [host]), [])
        order = (self.folder / "aarch64-linux/two.fmi3-stops.run").read_text()
        for line in ("fmi 3", "stops 1", "guid {3}", "reals 1 11", "booleans 1 12", "partials 2 11 10"):
            self.assertIn(f"\n{line}\n", order)
        self.assertIn("\nstops 0\n", (self.folder / "aarch64-linux/two.fmi3-plain.run").read_text())
        changed = bytearray(self.outputs)
        changed[32 * 70 + 20] ^= 1
        problems = comparison.versions([case], [PretendedHost(bytes(changed), b"a state")])
        self.assertEqual(len(problems), 2)
        self.assertIn("in FMI 3.0: contact[1].active at point 70 is ", problems[0])
        self.assertIn("in FMI 3.0 with stops: contact[1].active at point 70 is ", problems[1])

    def test_a_host_that_fails(self):
        host = PretendedHost(self.outputs, b"a state")
        host.start = lambda program, orders: (1, "fmi2DoStep at point 3 returned status 3")
        self.assertEqual(
            comparison.same_outputs([self.case], [host]),
            ["aarch64-linux: the host ended with code 1: fmi2DoStep at point 3 returned status 3"],
        )
