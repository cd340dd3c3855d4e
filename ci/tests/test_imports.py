"""Imports are found where there are some, and circles of them."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import imports


@contextlib.contextmanager
def workspace(**crates):
    """The folder of a workspace with these crates, whose files are given by their paths in `src`."""
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder).resolve()
        (root / "Cargo.toml").write_text(f"[workspace]\nmembers = {list(crates)}\n")
        for crate, files in crates.items():
            for name, text in {"../Cargo.toml": f'[package]\nname = "{crate}"\n', **files}.items():
                path = root / crate / "src" / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
        yield root


def imported(file, /, **files):
    """What this file of a crate imports; the other files are given by their names, with `__` for `/`."""
    with workspace(demo={f"{name.replace('__', '/')}.rs": text for name, text in files.items()}) as root:
        graph = imports.Workspace(root).imports()
        return sorted(to.removeprefix("demo/src/") for to in graph[f"demo/src/{file}"])


def run(root, *arguments):
    """The exit status of the program, and what it prints."""
    output = io.StringIO()
    with mock.patch("sys.argv", ["imports.py", "--root", str(root), *arguments]), contextlib.redirect_stdout(output):
        try:
            imports.main()
        except SystemExit as end:
            return end.code, output.getvalue()
    return 0, output.getvalue()


class Imports(unittest.TestCase):
    def test_a_declared_module_is_not_imported(self):
        self.assertEqual(imported("lib.rs", lib="mod a;", a="pub fn f() {}"), [])

    def test_a_tree_of_uses(self):
        lib = "mod a;\nmod b;\nmod c;\nmod d;\n"
        d = "use crate::{a::{self, F as G}, b::{inner::{X, Y}, Z}};\nuse super::c::V;\nfn f() -> a::H {}"
        files = {"lib": lib, "a": "", "b__mod": "pub mod inner;", "b__inner": "pub struct X;", "c": "", "d": d}
        self.assertEqual(imported("d.rs", **files), ["a.rs", "b/inner.rs", "b/mod.rs", "c.rs"])

    def test_paths_in_code(self):
        b = "fn f<'a>(x: &'a super::a::T) -> u8 { <u8 as crate::c::Trait>::g(x, '\\'', b'\"') }"
        self.assertEqual(imported("b.rs", lib="mod a; mod b; mod c;", a="", b=b, c=""), ["a.rs", "c.rs"])

    def test_paths_in_a_macro(self):
        b = "macro_rules! m { ($x:path) => {{ use $crate::a::T; $crate::c::f($x::new()) }} }"
        self.assertEqual(imported("b.rs", lib="mod a; mod b; mod c; mod x;", a="", b=b, c="", x=""), ["a.rs", "c.rs"])

    def test_a_module_counts_by_what_is_used_of_it(self):
        a = "pub mod child;\npub use child::T;\npub struct Own;"
        files = {"lib": "mod a; mod b;", "a__mod": a, "a__child": "pub struct T;"}
        self.assertEqual(imported("b.rs", **files, b="use crate::a;\nfn f(t: a::T) {}"), ["a/child.rs"])
        self.assertEqual(imported("b.rs", **files, b="use crate::a;\nfn f(t: a::Own) {}"), ["a/mod.rs"])
        self.assertEqual(imported("b.rs", **files, b="use crate::a as other;\nfn f(t: other::T) {}"), ["a/child.rs"])
        self.assertEqual(imported("b.rs", **files, b="pub use crate::a;"), ["a/mod.rs"])

    def test_a_face_is_looked_through(self):
        lib = "mod a; mod b; mod c;\npub use a::T;\npub struct Own;"
        a = "pub use crate::c::T;"
        files = {"lib": lib, "a": a, "c": "pub struct T;"}
        self.assertEqual(imported("b.rs", **files, b="use crate::T;"), ["c.rs"])
        self.assertEqual(imported("b.rs", **files, b="use crate::{Own, T};"), ["c.rs", "lib.rs"])
        self.assertEqual(imported("lib.rs", **files, b=""), ["c.rs"])

    def test_a_name_that_is_a_module_and_a_function(self):
        a = "pub mod f;\nmod g;\npub use g::f;\nfn h() { f::T; }"
        files = {"lib": "mod a; mod b;", "a__mod": a, "a__f": "pub struct T;", "a__g": "pub fn f() {}"}
        self.assertEqual(imported("b.rs", **files, b="use crate::a::f;"), ["a/g.rs"])
        self.assertEqual(imported("b.rs", **files, b="use crate::a::f::T;"), ["a/f.rs"])
        self.assertEqual(imported("a/mod.rs", **files, b=""), ["a/f.rs", "a/g.rs"])

    def test_all_names_of_a_module(self):
        files = {"lib": "mod a; mod b;", "a__mod": "mod child;\npub use child::*;", "a__child": "pub fn f() {}"}
        self.assertEqual(imported("a/mod.rs", **files, b=""), ["a/child.rs"])
        self.assertEqual(imported("b.rs", **files, b="use crate::a::f;"), ["a/child.rs"])
        self.assertEqual(imported("b.rs", **files, b="use crate::a::*;"), ["a/mod.rs"])

    def test_comments_texts_and_tests_do_not_count(self):
        b = """//! See [`crate::a`], crate::a::T.
            /* crate::a::T */
            const S: &str = "crate::a::T"; const R: &str = r#"" crate::a::T"#; // use crate::a::T;
            #[cfg(test)]
            use crate::{a::T};
            #[cfg(test)]
            #[allow(dead_code)]
            mod tests { use crate::a::{T, U}; fn f() { crate::a::T; } }
            #[cfg(all(test, unix))]
            mod more;
            use crate::c::T;"""
        files = {"lib": "mod a; mod b; mod c;", "a": "", "b__mod": b, "b__more": "use crate::a::T;", "c": ""}
        self.assertEqual(imported("b/mod.rs", **files), ["c.rs"])
        with self.assertRaises(KeyError):
            imported("b/more.rs", **files)

    def test_a_module_within_a_file(self):
        a = "mod inner { use super::T; fn f() { super::super::b::f(); } }\nuse super::c::T;\nfn g() { inner::f() }"
        self.assertEqual(imported("a.rs", lib="mod a; mod b; mod c;", a=a, b="", c=""), ["b.rs", "c.rs"])

    def test_files_of_a_macro(self):
        lib = "mod laws;"
        laws = "macro_rules! laws { ($($name:ident)*) => { $(pub mod $name; pub use $name::L;)* } }\nlaws! { one two }"
        found = imported("laws/mod.rs", lib=lib, laws__mod=laws, laws__one="", laws__two="")
        self.assertEqual(found, ["laws/one.rs", "laws/two.rs"])

    def test_a_program_beside_a_library_and_another_crate(self):
        main = "mod own;\nuse tool::A;\nuse own::B;"
        tool = {"lib.rs": "mod a;\npub use a::A;", "a.rs": "", "main.rs": main, "own.rs": "use crate::C;"}
        base, user = {"lib.rs": "pub mod z;", "z.rs": "pub struct Z;"}, {"lib.rs": "use base::z::Z;"}
        with workspace(base=base, tool=tool, user=user) as root:
            graph = {file: sorted(to) for file, to in imports.Workspace(root).imports().items() if to}
        self.assertEqual(graph["tool/src/main.rs"], ["tool/src/a.rs", "tool/src/own.rs"])
        self.assertEqual(graph["tool/src/own.rs"], ["tool/src/main.rs"])
        self.assertEqual(graph["user/src/lib.rs"], ["base/src/z.rs"])


class Circles(unittest.TestCase):
    TWO = {"lib.rs": "mod a;\nmod b;", "a.rs": "use crate::b::B;", "b.rs": "\nuse super::a::A;"}
    THREE = {"lib.rs": "mod face;", "face/mod.rs": "mod a;\nmod b;\npub use a::A;\npub struct Own;",
             "face/a.rs": "use super::b::B;", "face/b.rs": "fn f(own: crate::face::Own) {}"}

    def test_none(self):
        files = {"lib.rs": "mod a;\nmod b;\npub use b::B;", "a.rs": "", "b.rs": "use crate::a::A;"}
        with workspace(demo=files) as root:
            self.assertEqual(run(root), (0, ""))

    def test_two(self):
        with workspace(demo=self.TWO) as root:
            status, _ = run(root)
            self.assertEqual(run(root, "demo/src/a.rs"), (0, ""))
            self.assertEqual(run(root, "demo/src/a.rs", "demo/src/b.rs")[0], status)
        self.assertEqual(
            status,
            "2 files import each other: demo/src/a.rs, demo/src/b.rs\n"
            "  the shortest circle:\n"
            "  demo/src/a.rs:1 imports demo/src/b.rs (crate::b::B)\n"
            "  demo/src/b.rs:2 imports demo/src/a.rs (super::a::A)",
        )

    def test_three_through_a_face(self):
        with workspace(demo=self.THREE) as root:
            status, _ = run(root, "demo/src/face")
        self.assertEqual(
            status,
            "3 files import each other: demo/src/face/a.rs, demo/src/face/b.rs, demo/src/face/mod.rs\n"
            "  the shortest circle:\n"
            "  demo/src/face/a.rs:1 imports demo/src/face/b.rs (super::b::B)\n"
            "  demo/src/face/b.rs:1 imports demo/src/face/mod.rs (crate::face::Own)\n"
            "  demo/src/face/mod.rs:3 imports demo/src/face/a.rs (a::A)",
        )

    def test_the_shortest_is_shown(self):
        files = {**self.THREE, "face/a.rs": "use super::b::B;", "face/b.rs": "use super::{Own, a::A};"}
        with workspace(demo=files) as root:
            shown = run(root)[0].splitlines()
        self.assertIn("3 files", shown[0])
        self.assertEqual(
            shown[2:],
            [
                "  demo/src/face/a.rs:1 imports demo/src/face/b.rs (super::b::B)",
                "  demo/src/face/b.rs:1 imports demo/src/face/a.rs (super::a::A)",
            ],
        )

    def test_two_circles_of_two_crates(self):
        with workspace(one=self.TWO, two=self.THREE) as root:
            self.assertEqual(run(root)[0].count("import each other"), 2)
            self.assertEqual(run(root, "two/src/")[0].count("import each other"), 1)

    def test_a_path_without_files(self):
        with workspace(demo=self.TWO) as root:
            self.assertEqual(run(root, "demo/src", "demo/scr")[0], "no source files below demo/scr")

    def test_the_graph(self):
        with workspace(demo=self.THREE) as root:
            status, graph = run(root, "--dot")
        self.assertEqual(status, 0)
        self.assertIn('"cluster demo/src/face" { label="demo/src/face"; "demo/src/face/a.rs" [label="a.rs"];', graph)
        self.assertIn('"demo/src/face/a.rs" -> "demo/src/face/b.rs" [color=red];', graph)
