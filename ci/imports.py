"""Which source file imports which. Fails where files import each other in a circle.

    python3 ci/imports.py                          # all crates of the workspace
    python3 ci/imports.py src/slave fmu-build/src  # circles among the files below these paths only
    python3 ci/imports.py --dot src/slave          # the imports as a graph for Graphviz, a box for each folder

Imports are the `use` declarations and the paths in code, each traced to the file that defines the name: what a face
(`mod.rs`, `lib.rs`) only re-exports is no import of the face, while the face imports what it re-exports. `mod name;`
alone is no import. A `use` of a whole module is none either: the paths that start with its name are. A file that no
`mod` names is declared by a macro, and the file of the macro imports it. Tests (`#[cfg(test)]`) do not count.
"""

import argparse
import re
import sys
import tomllib
from collections import deque
from pathlib import Path

TOKEN = re.compile(
    r"""(?P<comment>//[^\n]*|/\*.*?\*/)
    |(?P<literal>\bb?r(?P<hashes>\#*)".*?"(?P=hashes)|b?"(?:\\.|[^"\\])*"|b?'(?:\\[^']+|[^'\\])'|'\w+)
    |(?:r\#)?(?P<word>[A-Za-z_]\w*)|::|[^\s\w]""",
    re.DOTALL | re.VERBOSE,
)
ITEMS = {"fn", "struct", "enum", "union", "trait", "type", "const", "static", "mod", "macro_rules"}


def tokens_of(text):
    """The words and signs of Rust code and the line of each; without comments, literals and lifetimes."""
    found = [match for match in TOKEN.finditer(text) if match["comment"] is None and match["literal"] is None]
    return [match["word"] or match[0] for match in found], [text.count("\n", 0, match.start()) + 1 for match in found]


def end_of_item(tokens, start):
    """The index after the item that starts here, with its attributes."""
    depth = 0
    for index in range(start, len(tokens)):
        depth += (tokens[index] in "([{") - (tokens[index] in ")]}")
        if depth == 0 and (tokens[index] == ";" or tokens[index] == "}" and tokens[index + 1 : index + 2] != [";"]):
            return index + 1
    return len(tokens)


def leaves(tokens):
    """What the tokens between `use` and `;` bind: pairs (name, path), the name `*` for all names of a module."""
    path, prefixes = [], [0]
    for token in [*tokens, ","]:
        if token == "{":
            prefixes.append(len(path))
        elif token not in (",", "}"):
            path += [token] if token != "::" else []
        else:
            if len(path) > prefixes[-1]:
                name = path[-1]
                whole = path[:-2] if path[-2:-1] == ["as"] else path
                whole = whole[:-1] if name == "*" or whole[1:] and whole[-1] == "self" else whole
                yield whole[-1] if name == "self" else name, whole
            prefixes = prefixes[:-1] if token == "}" else prefixes
            path = path[: prefixes[-1]]


class File:
    """What one file declares and names."""

    def __init__(self, path, module):
        self.path, self.module, self.children = path, module, {}
        # Modules declared by `mod name;`, those only for tests, and the names of items.
        self.declared, self.tests, self.defined = set(), set(), set()
        # What `use` binds each name to, the modules of `use ...::*`, all paths: (path, line, is of a private `use`).
        self.bindings, self.globs, self.paths = {}, [], []
        self.read(*tokens_of(path.read_text(encoding="utf-8")))

    def read(self, tokens, lines):
        """Goes through the file once. `inner` are the depths in braces of the modules within it that are open."""
        index, depth, inner = 0, 0, []
        tokens = [*tokens, ";", ";"]
        while index < len(tokens) - 2:
            before, token, after, next_but_one = (tokens[max(index - 1, 0)], *tokens[index : index + 3])
            start, index = index, index + 1
            depth += (token == "{") - (token == "}")
            inner = inner[:-1] if token == "}" and inner and inner[-1] > depth else inner
            if token == "#" and re.match(r"#\[cfg\((all\()?test\b", "".join(tokens[start : start + 7])):
                index = end_of_item(tokens, start)
                self.tests |= {tokens[index - 2]} if tokens[index - 3] == "mod" else set()
            elif token == "use" and after != "<":
                index = tokens.index(";", start)
                for name, path in leaves(token for token in tokens[start + 1 : index] if token != "$"):
                    path = self.note(path, lines[start], inner, before not in ("pub", ")") and name != "*")
                    self.bindings[name] = path
                    self.globs += [path] if name == "*" else []
            elif token == "mod" and next_but_one == ";":
                self.declared.add(after)
            elif token in ITEMS and depth == len(inner):
                self.defined.add(next_but_one if token == "macro_rules" else after)
                inner += [depth + 1] if token == "mod" and next_but_one == "{" else []
            elif after == "::" and before not in ("::", "in") and (before != "$" or token == "crate"):
                path = [token]
                while tokens[index] == "::" and tokens[index + 1].isidentifier():
                    path.append(tokens[index + 1])
                    index += 2
                self.note(path, lines[start], inner, False)

    def note(self, path, line, inner, is_private):
        """Notes a path and returns it, as it reads outside of the modules within the file."""
        for _ in inner:
            path = (path[1:] or ["self"]) if path[0] == "super" else path
        self.paths.append((path, line, is_private))
        return path


class Workspace:
    """All files of a workspace's crates, by module."""

    def __init__(self, root):
        self.root, self.files = root, {}
        workspace = tomllib.loads((root / "Cargo.toml").read_text(encoding="utf-8"))["workspace"]
        for folder in [root, *(root / member for member in workspace.get("members", []))]:
            crate = tomllib.loads((folder / "Cargo.toml").read_text(encoding="utf-8"))
            if "package" in crate:
                name = crate.get("lib", {}).get("name", crate["package"]["name"].replace("-", "_"))
                self.add_crate(folder / "src", name)
        tests = [(*file.module, name) for file in self.files.values() for name in file.tests]
        self.files = {module: file for module, file in self.files.items()
                      if not any(module[: len(test)] == test for test in tests)}
        for module, file in self.files.items():
            if module[1:]:
                self.files[module[:-1]].children[module[-1]] = file

    def add_crate(self, source, library):
        """Adds a library's files, and those that `main.rs` declares as of a crate beside it."""
        program = f"main.rs of {library}"
        main = source / "main.rs"
        of_program = File(main, ()).declared if main.exists() else ()
        for path in sorted(source.rglob("*.rs")):
            *folders, name = path.relative_to(source).with_suffix("").parts
            module = (*folders, *([] if name in ("lib", "main", "mod") else [name]))
            is_of_program = path == main or module and module[0] in of_program
            module = (program if is_of_program else library, *module)
            self.files[module] = File(path, module)

    def resolve(self, file, path, seen=()):
        """The file in which what a path names in this file is defined, and whether the path names the file's module.
        None for what is not of the workspace or is defined here."""
        head, rest = path[0], path[1:]
        binding = file.bindings.get(head, path[:1])
        if head == "crate":
            return self.descend(self.files[file.module[:1]], rest, seen)
        if head == "super":
            return self.descend(self.files[file.module[:-1]], rest, seen)
        if head == "self":
            return self.descend(file, rest, seen)
        if binding != path[:1] and (file, head) not in seen and not (rest and head in file.children):
            return self.resolve(file, binding + rest, (*seen, (file, head)))
        if head in file.children:
            return self.descend(file.children[head], rest, seen)
        return self.descend(self.files[head,], rest, seen) if (head,) in self.files else None

    def descend(self, file, path, seen):
        """As `resolve`, for a path that starts in the module of this file."""
        if not path:
            return file, True
        head, rest = path[0], path[1:]
        if head == "super" or head in file.children:
            return self.resolve(file, path, seen)
        if head in file.bindings and head not in file.defined:
            return self.resolve(file, path, seen) or (file, False)
        for glob in file.globs if head not in file.defined else ():
            found = self.resolve(file, glob, seen)
            if found and head in found[0].defined:
                return found[0], False
        return file, False

    def imports(self):
        """By file the files that it imports, each with the line and the path of the first import."""
        graph = {}
        for file in self.files.values():
            macros = (name for name in file.children if name not in file.declared)
            found = {self.name(file.children[name]): (1, f"{name}, by a macro") for name in macros}
            for path, line, is_private in file.paths:
                target, is_module = self.resolve(file, path) or (file, True)
                if target is not file and not (is_module and is_private):
                    found.setdefault(self.name(target), (line, "::".join(path)))
            graph[self.name(file)] = found
        return graph

    def name(self, file):
        return file.path.relative_to(self.root).as_posix()


def below(graph, paths):
    """The part of a graph below these paths."""
    kept = {file for file in graph if any(f"{file}/".startswith(f"{path}/") for path in paths)}
    return {file: {to: why for to, why in graph[file].items() if to in kept} for file in graph if file in kept}


def ways(graph, start):
    """By each file that this one imports, directly or through others, the shortest way there."""
    found, queue = {}, deque([[start]])
    while queue:
        way = queue.popleft()
        for to in sorted(graph[way[-1]]):
            if to not in found:
                found[to] = [*way, to]
                queue.append(found[to])
    return found


def circles(graph):
    """The sets of files that import each other, directly or through others: (members, shortest circle) of each."""
    reached = {file: ways(graph, file) for file in graph}
    within = [file for file in graph if file in reached[file]]
    sets = {tuple(sorted(to for to in reached[file] if file in reached[to])) for file in within}
    return [(members, min((reached[file][file] for file in members), key=len)) for members in sorted(sets)]


def description(graph, members, circle):
    lines = [f"{len(members)} files import each other: {', '.join(members)}", "  the shortest circle:"]
    for file, to in zip(circle, circle[1:]):
        line, path = graph[file][to]
        lines.append(f"  {file}:{line} imports {to} ({path})")
    return "\n".join(lines)


def dot(graph):
    """The graph for Graphviz: a box for each folder; what is part of a circle is red."""
    sets = [set(members) for members, _ in circles(graph)]
    lines = ["digraph imports {", "  rankdir=LR; node [shape=box, fontname=sans]; graph [fontname=sans];"]
    for folder in sorted({Path(file).parent.as_posix() for file in graph}):
        names = [f'"{file}" [label="{Path(file).name}"];' for file in graph if Path(file).parent.as_posix() == folder]
        lines.append(f'  subgraph "cluster {folder}" {{ label="{folder}"; {" ".join(names)} }}')
    for file, imported in graph.items():
        for to in imported:
            colour = " [color=red]" if any({file, to} <= members for members in sets) else ""
            lines.append(f'  "{file}" -> "{to}"{colour};')
    return "\n".join([*lines, "}"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("paths", nargs="*", help="judge only the files below these, or these")
    parser.add_argument("--dot", action="store_true", help="print the graph for Graphviz")
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parents[1], help="of the workspace")
    arguments = parser.parse_args()
    graph = Workspace(arguments.root.resolve()).imports()
    if arguments.paths:
        paths = [path.rstrip("/") for path in arguments.paths]
        missing = [path for path in paths if not below(graph, [path])]
        if missing:
            sys.exit(f"no source files below {', '.join(missing)}")
        graph = below(graph, paths)
    if arguments.dot:
        print(dot(graph))
    elif found := circles(graph):
        sys.exit("\n".join(description(graph, *circle) for circle in found))


if __name__ == "__main__":
    main()
