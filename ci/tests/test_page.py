"""The page: what its module may not have, and one text of many modules."""

import json
import re
import tempfile
import unittest
from pathlib import Path

from releasing import page
from releasing.commands import Failure

HEADER = b"\0asm\1\0\0\0"
# A type, () -> (), in its section.
TYPES = b"\x01\x04\x01\x60\x00\x00"


def imports(*names):
    """A section that imports functions of the type 0."""
    entries = b"".join(
        b"".join(bytes([len(part)]) + part.encode() for part in name.split(".")) + b"\x00\x00" for name in names
    )
    content = bytes([len(names)]) + entries
    return b"\x02" + bytes([len(content)]) + content


class Imports(unittest.TestCase):
    def test_none(self):
        self.assertEqual(page.check(HEADER + TYPES), [])

    def test_some(self):
        module = HEADER + TYPES + imports("env.now", "wbg.random")
        self.assertEqual(page.imports(module), ["env.now", "wbg.random"])
        self.assertEqual(page.check(module)[1], "imports wbg.random, expected no imports")

    def test_a_path_of_this_machine(self):
        path = f"{page.ROOT}/src/lib.rs".encode()
        custom = b"\x00" + bytes([len(path) + 2]) + b"\x01x" + path
        self.assertIn("contains the path", page.check(HEADER + custom)[0])

    def test_no_module(self):
        with self.assertRaisesRegex(Failure, "no WebAssembly module"):
            page.check(b"\x7fELF")


class Modules(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def joined(self, **modules):
        for name, text in modules.items():
            (self.folder / f"{name}.js").write_text(text)
        return page.modules(self.folder / "main.js")

    def test_each_after_what_it_imports(self):
        text = self.joined(
            main='import { one } from "./a.js";\nimport {\n  two,\n} from "./b.js";\none(two);\n',
            a='import { two } from "./b.js";\nexport const one = (n) => n + two;\n',
            b="export const two = 2;\n",
        )
        self.assertEqual(
            text, "// b.js\nconst two = 2;\n// a.js\nconst one = (n) => n + two;\n// main.js\none(two);\n"
        )

    def test_a_name_in_two(self):
        with self.assertRaisesRegex(Failure, "one is in a.js and in main.js"):
            self.joined(main='import { two } from "./a.js";\nconst one = two;\n', a="const one = 1;\nexport const two = one;\n")

    def test_a_circle(self):
        with self.assertRaisesRegex(Failure, "main.js -> a.js -> main.js"):
            self.joined(main='import { one } from "./a.js";\n', a='import { two } from "./main.js";\n')

    def test_what_cannot_be_joined(self):
        for text in ('import * as a from "./a.js";\n', "export default 3;\n", 'export { one } from "./a.js";\n'):
            with self.assertRaisesRegex(Failure, "expected imports of names"):
                self.joined(main=text, a="")


class Template(unittest.TestCase):
    def test_no_text_ends_an_element(self):
        self.assertEqual(page.closed('"</script>" + "<!--"'), '"<\\/script>" + "<\\!--"')

    def test_what_is_put_in_comes_out_again(self):
        whole = "".join(f'<script type="application/json" id="{name}">{{}}</script>' for name in ("libraries", "records", "given"))
        scene = {"file": "a.toml", "text": "name = '</script><b>'"}
        made = page.assembly.assembled(whole, {"linux64": b"\x7fELF"}, scene, {"r.csv": b"1"})
        held = dict(re.findall(r'id="(\w+)">(.*?)</script>', made))
        self.assertEqual(json.loads(held["given"]), scene)
        self.assertEqual(list(json.loads(held["records"])), ["r.csv"])
        self.assertEqual(made, page.assembly.assembled(whole, {"linux64": b"\x7fELF"}, scene, {"r.csv": b"1"}))


if __name__ == "__main__":
    unittest.main()
