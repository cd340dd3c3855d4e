"""The page: the engine as WebAssembly, and everything of page/web in one HTML file without libraries, the template."""

import html
import importlib.util
import re
import tomllib
from types import SimpleNamespace

from releasing import gates, remapping
from releasing.cargo import flag_arguments
from releasing.commands import Failure, run, stop_at
from releasing.places import ROOT

TRIPLE = "wasm32-unknown-unknown"
# What standard_library.toolchain asks of a platform.
PLATFORM = SimpleNamespace(name="page", triple=TRIPLE)
WEB = ROOT / "page/web"
EXAMPLES = ROOT / "examples/scenes"
DATA = "<!--data-->"


def compile_engine(toolchain):
    """Compiles the module and returns where it is."""
    run("cargo", "fetch", "--locked", variables=toolchain.variables, aloud=True)
    run(
        *"cargo rustc --locked --release --lib --crate-type cdylib --package pounding-page --target".split(),
        TRIPLE,
        *flag_arguments(remapping.flags(toolchain.compiler)),
        variables=toolchain.variables,
        aloud=True,
    )
    module = toolchain.target / TRIPLE / "release/pounding_page.wasm"
    stop_at([f"{module.name}: {problem}" for problem in check(module.read_bytes())])
    return module


def check(module):
    """The module needs nothing of a browser, and no path of this machine is in it."""
    found = gates.private_paths(module, remapping.private_paths())
    return found + [f"imports {name}, expected no imports" for name in imports(module)]


def imports(module):
    """What a WebAssembly module wants from outside, by module and name."""
    if module[:8] != b"\0asm\1\0\0\0":
        raise Failure("this is no WebAssembly module")
    at, found = 8, []
    while at < len(module):
        kind, (length, start) = module[at], number(module, at + 1)
        if kind == 2:
            found = names(module, start)
        at = start + length
    return found


def names(module, at):
    """Those of an import section, which begins there. Kinds of imports that no module of ours could have end the list."""
    count, at = number(module, at)
    found = []
    for _ in range(count):
        parts = []
        for _ in "12":
            length, at = number(module, at)
            parts.append(module[at : at + length].decode())
            at += length
        found.append(".".join(parts))
        if module[at] != 0:
            return [*found, "..."] if count > len(found) else found
        _, at = number(module, at + 1)
    return found


def number(module, at):
    """A number of seven bits a byte, and where it ends."""
    value = shift = 0
    while True:
        byte = module[at]
        value |= (byte & 0x7F) << shift
        at, shift = at + 1, shift + 7
        if byte < 0x80:
            return value, at


def template(module):
    """The page: page/web/index.html with all that it names in it, the engine and the examples."""
    page = (WEB / "index.html").read_text()
    page = re.sub(r'<link rel="stylesheet" href="([^"]+)">', lambda found: sheet(WEB / found[1]), page)
    page = re.sub(r'<script src="([^"]+)"></script>', lambda found: script(WEB / found[1]), page)
    page = re.sub(
        r'<script type="module" src="([^"]+)"></script>',
        lambda found: f'<script type="module">\n{closed(modules(WEB / found[1]))}</script>',
        page,
    )
    if page.count(DATA) != 1:
        raise Failure(f"page/web/index.html: expected {DATA} once")
    return page.replace(DATA, data(module))


def sheet(file):
    return f"<style>\n{file.read_text().strip()}\n</style>"


def script(file):
    """A library that is no module, with its licence."""
    licence = file.parent / "LICENSE"
    head = f"/*\n{licence.read_text().strip()}\n*/\n" if licence.exists() else ""
    return f"<script>\n{head}{closed(file.read_text())}\n</script>"


def closed(text):
    """JavaScript as it may stand in a script element: nothing in it ends that."""
    return re.sub(r"</(script)", r"<\\/\1", text, flags=re.IGNORECASE).replace("<!--", "<\\!--")


def modules(first):
    """All modules that one needs, in one text: each after those that it imports, without imports and exports."""
    texts, names = {}, {}
    gather(first, texts, ())
    for file, text in texts.items():
        for name in re.findall(r"^(?:async )?(?:function\*?|class|const|let) (\w+)", text, re.MULTILINE):
            if name in names:
                raise Failure(f"page/web: {name} is in {names[name].name} and in {file.name}; expected another name")
            names[name] = file
    return "".join(f"// {file.name}\n{text}" for file, text in texts.items())


def gather(file, texts, above):
    """Adds a module behind those that it imports."""
    if file in above:
        circle = " -> ".join(one.name for one in (*above[above.index(file) :], file))
        raise Failure(f"page/web: modules import each other in a circle: {circle}")
    if file in texts:
        return
    text = file.read_text()
    for other in re.findall(r'^import \{[^}]*\} from "\./([^"]+)";$', text, re.MULTILINE):
        gather(file.parent / other, texts, (*above, file))
    text = re.sub(r'^import \{[^}]*\} from "[^"]+";\n', "", text, flags=re.MULTILINE)
    text = re.sub(r"^export (?=(async )?(function|class|const) ?)", "", text, flags=re.MULTILINE)
    wrong = re.search(r"^(import|export)\b.*", text, re.MULTILINE)
    if wrong:
        raise Failure(f"page/web/{file.name}: {wrong[0]}\nexpected imports of names and exports of what is declared")
    texts[file] = text


def data(module):
    """What the page holds beside its program, an element each; libraries, a scene and its records are put in later."""
    examples, records = [], {}
    for file in sorted(EXAMPLES.glob("*.toml")):
        text = file.read_text()
        scene = tomllib.loads(text)
        examples.append({key: scene.get(key, "") for key in ("name", "description")} | {"file": file.name, "text": text})
        if record := scene.get("ground", {}).get("record"):
            records[record] = assembly.packed((file.parent / record).read_bytes())
    elements = [
        ("engine", "text/plain", assembly.packed(module.read_bytes())),
        ("worker", "text/plain", closed(modules(WEB / "worker.js"))),
        *(
            (name, "application/json", assembly.spoken(value))
            for name, value in [("examples", examples), ("records", records), ("libraries", {}), ("given", None)]
        ),
    ]
    return "\n".join(f'<script type="{kind}" id="{html.escape(name)}">{text}</script>' for name, kind, text in elements)


def write(place, template, folder):
    """Writes the page with the libraries in a folder, and returns for which platforms these are."""
    libraries = assembly.libraries_in(folder)
    place.write_text(assembly.assembled(template, libraries))
    return list(libraries)


def load(file):
    """A module of the Python package, without the package, which is compiled."""
    spec = importlib.util.spec_from_file_location(file.stem, file)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


assembly = load(ROOT / "python/pounding_fmu/_page.py")
