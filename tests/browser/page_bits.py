"""The engine in the page computes the bits that it computes natively, and makes the bytes of the commands' files.

    "$(ci/environment tests/browser)" tests/browser/page_bits.py [PAGE.html]

All scenes of the release's comparison (ci/releasing/cases.py) run through `window.pounding` of target/page/pounding.html in
a Chromium without network; every output of every row, every impact, tables and reports are compared with those of
`simulate`, and FMUs of FEUP with those of `cargo fmu`, where the page holds libraries. Also records, spectra against a
closed form, studies against runs, and what the engine says of hostile input.
"""

import base64
import csv
import io
import json
import math
import os
import re
import shlex
import shutil
import struct
import subprocess
import sys
import time
import tomllib
from pathlib import Path

from browser import listen, started

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "ci"))
from releasing import cases, page as making  # noqa: E402

FOLDER = ROOT / "target/browser/bits"
SIMULATE = shlex.split(os.environ.get("SIMULATE", "cargo run --release --quiet --example simulate --"))
FEUP = ROOT / "examples/scenes/feup.toml"
EL_CENTRO = ROOT / "examples/records/el_centro_1940_ns.csv"
PREPARE = """() => {
    window.inBase64 = (bytes) => {
        let text = "";
        for (let at = 0; at < bytes.length; at += 32768) text += String.fromCharCode(...bytes.subarray(at, at + 32768));
        return btoa(text);
    };
    window.bitsOf = (numbers) => inBase64(new Uint8Array(Float64Array.from(numbers).buffer));
    return pounding.ready;
}"""
RUN = """async ([scene, records]) => {
    const { time, columns, impacts } = await pounding.simulate(scene, { records });
    const names = Object.keys(columns);
    return { names, columns: bitsOf([time, ...Object.values(columns)].flatMap((column) => [...column])),
        impacts: bitsOf(impacts.flatMap((impact) => Object.values(impact))), keys: Object.keys(impacts[0] ?? {}) };
}"""


def main():
    html = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else ROOT / "target/page/pounding.html"
    FOLDER.mkdir(parents=True, exist_ok=True)
    with started() as context:
        page = context.new_page()
        troubles = listen(page, "blob:", "data:")
        page.goto(html.as_uri())
        page.evaluate(PREPARE)
        for look in [same_bits, same_files, same_fmus, studies, shakes, refuses, survives]:
            start = time.monotonic()
            print(f"{look.__name__.replace('_', ' ')}: {look(page)} ({time.monotonic() - start:.1f} s)", flush=True)
        assert not troubles, troubles


def records_of(text, folder):
    """The record that a scene names, by that name."""
    name = tomllib.loads(text).get("ground", {}).get("record")
    return {name: (folder / name).read_text(encoding="latin-1")} if name else {}


def native(file, *options):
    subprocess.run([*SIMULATE, file, *options], cwd=ROOT, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def bits(numbers):
    return struct.pack(f"<{len(numbers)}d", *numbers)


def table(file):
    """The names of the columns of a table, and the columns; NaN where a cell is empty."""
    names, *rows = csv.reader(io.StringIO(file.read_text()))
    return names, [[float(cell or "nan") for cell in column] for column in zip(*rows)]


def same_bits(page):
    scenes, rows, impacts = cases.scenes(), 0, 0
    for name, file in scenes.items():
        native(file, "--csv", FOLDER / "motion.csv", "--impacts", FOLDER / "impacts.csv")
        (_, *names), columns = table(FOLDER / "motion.csv")
        run = page.evaluate(RUN, [file.read_text(), records_of(file.read_text(), file.parent)])
        assert run["names"] == names, (name, run["names"], names)
        found = base64.b64decode(run["columns"])
        size = 8 * len(columns[0])
        for place, (column, expected) in enumerate(zip(["time", *names], columns)):
            assert found[place * size : (place + 1) * size] == bits(expected), f"{name}: {column} differs"
        assert len(found) == size * len(columns)
        keys, columns_of_impacts = table(FOLDER / "impacts.csv")
        expected = [value for row in zip(*columns_of_impacts) for value in row]
        assert run["keys"] in (keys, []) and base64.b64decode(run["impacts"]) == bits(expected), f"{name}: impacts differ"
        rows, impacts = rows + len(columns[0]), impacts + len(expected) // len(keys)
    assert len(scenes) > 40 and rows > 40_000 and impacts > 1000
    return f"{len(scenes)} scenes, {rows} rows, {impacts} impacts"


def same_files(page):
    """Tables and report, byte for byte."""
    made = {kind: FOLDER / f"made.{kind}" for kind in ("csv", "impacts", "html")}
    native(FEUP, *(word for kind, file in made.items() for word in (f"--{kind}", file)))
    ask = """async ([scene, records, call]) => inBase64(await engine[call](scene, { records }))"""
    question = [FEUP.read_text(), records_of(FEUP.read_text(), FEUP.parent)]
    for call, kind in (("csv", "csv"), ("impactsCsv", "impacts"), ("report", "html")):
        found = base64.b64decode(page.evaluate(ask.replace("engine", "pounding.engine"), [*question, call]))
        assert found == made[kind].read_bytes(), f"{call}: other bytes"
    return ", ".join(made)


def same_fmus(page):
    held = making.assembly.element(page.content(), "libraries")[1]
    libraries = json.loads(held)
    ask = """async ([scene, records, fmi]) => inBase64(await pounding.buildFmu(scene, { records, fmi }))"""
    question = [FEUP.read_text(), records_of(FEUP.read_text(), FEUP.parent)]
    if not libraries:
        said = refusal(page, "pounding.buildFmu(scene, { records })", *question)
        assert "no libraries" in said, said
        return "without libraries there are none"
    shutil.rmtree(FOLDER / "libraries", ignore_errors=True)
    for platform, content in libraries.items():
        place = FOLDER / "libraries" / platform / f"pounding.{'dll' if platform.startswith('win') else 'so'}"
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(making.assembly.unpacked(content))
    for fmi in (2, 3):
        made = FOLDER / f"feup.{fmi}.fmu"
        options = ["--libraries", FOLDER / "libraries", "--fmi", str(fmi), "-o", made]
        subprocess.run(["cargo", "fmu", FEUP, *options], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
        assert base64.b64decode(page.evaluate(ask, [*question, fmi])) == made.read_bytes(), f"FMI {fmi}: other bytes"
    return f"FMI 2.0 and 3.0 for {', '.join(libraries)}"


def studies(page):
    """Each gap of a study is a run with that gap."""
    ask = """async ([scene, records]) => {
        const gaps = [0.001, 0.005, 0.03];
        const { columns } = await pounding.engine.study(scene, { gaps, records });
        const ends = [];
        for (const gap of gaps) {
            const parameters = { "contact[1].gap": gap, "contact[2].gap": gap };
            const outputs = Object.keys(columns);
            const run = await pounding.simulate(scene, { records, parameters, outputs });
            ends.push(outputs.map((name) => run.columns[name].at(-1)));
        }
        return [gaps.map((_, place) => Object.values(columns).map((column) => column[place])), ends];
    }"""
    found, expected = page.evaluate(ask, [FEUP.read_text(), records_of(FEUP.read_text(), FEUP.parent)])
    assert found == expected and len(set(map(str, found))) == 3, (found, expected)
    return f"{len(found)} gaps, {len(found[0])} columns"


def shakes(page):
    """What is in a record, and its spectrum: a sudden constant acceleration a lets a mast overshoot to a (1 + e^(-zeta pi /
    sqrt(1 - zeta^2))) [Chopra2001, section 4.3]."""
    about = page.evaluate("async (text) => { const { times, accelerations, ...rest } = await pounding.engine.record(text, 'x');"
                          " return [rest, times.length, accelerations.at(-1)]; }", EL_CENTRO.read_text())  # fmt: skip
    samples = [line.split(",") for line in EL_CENTRO.read_text().splitlines() if re.match(r"[\d.]", line)]
    assert (about[0]["samples"], about[1], about[2]) == (len(samples), len(samples), float(samples[-1][1]))
    assert about[0]["peak"] == max(abs(float(value)) for _, value in samples)
    step = "time_s,accel_m_s2\n0,2\n1000,2\n"
    periods = [0.1, 0.7, 3.0]
    ask = "async ([text, periods]) => [...await pounding.engine.spectrum(text, 'step', periods)]"
    zeta = 0.05
    expected = 2 * (1 + math.exp(-zeta * math.pi / math.sqrt(1 - zeta**2)))
    for value in page.evaluate(ask, [step, periods]):
        assert abs(value / expected - 1) < 1e-9, (value, expected)
    return f"{len(samples)} samples, {len(periods)} periods"


def refusal(page, call, scene, records=None):
    ask = f"async ([scene, records]) => {{ try {{ await {call}; return null }} catch (error) {{ return error.message }} }}"
    return page.evaluate(ask, [scene, records or {}])


def refuses(page):
    """Mistakes are sentences, and the engine goes on."""
    scene, records = FEUP.read_text(), records_of(FEUP.read_text(), FEUP.parent)
    wrong = scene.replace("mass = [3.65, 3.65]", "mass = [-3.65, nan]", 1)
    assert page.evaluate("scene => pounding.problems(scene)", wrong) == [
        "left.mass[1] = -3.65: expected a finite mass > 0 kg",
        "left.mass[2] = nan: expected a finite mass > 0 kg",
    ]
    options = {
        "step: 0": "step = 0.0: expected a number of seconds > 0",
        "stop: -Infinity": "stop = -inf: expected a number of seconds > 0",
        "outputs: ['left.displacement[7]']": "left.displacement[7]: the scene has no such variable",
        "parameters: { 'contact[1].gap': NaN }": "contact[1].gap = nan: expected a finite distance in m",
        "parameters: { 'contact[1].gap': '5' }": "contact[1].gap = '5': expected a number",
        "parameters: { 'contact[1].gapp': 1 }": "contact[1].gapp: the scene has no such variable; did you mean contact[1].gap?",
        "speed: 1": "speed: no such option; expected step, stop,",
        "parameters: { impacts: 1 }": "impacts is computed and cannot be set: expected names of parameters",
        "step: 1e-12": "2.0e13 rows of 60 columns: expected fewer, by a larger step",
    }
    for option, expected in options.items():
        said = refusal(page, f"pounding.simulate(scene, {{ records, {option} }})", scene, records)
        assert said and said.startswith(expected), (option, said)
    for value in ("null", "7", "undefined", "{}"):
        assert "scene: expected the text of a scene" in refusal(page, f"pounding.simulate({value})", ""), value
    # A record by a name that every object has, as bytes, told in either way.
    own = re.sub(r'record = ".*"', 'record = "__proto__"', scene)
    given = "{ ['__proto__']: new TextEncoder().encode(Object.values(records)[0]).buffer }"
    for form in (given, f"{{ records: {given} }}"):
        assert page.evaluate(f"([scene, records]) => pounding.problems(scene, {form})", [own, records]) == [], form
    assert refusal(page, f"pounding.simulate(scene, {{ records: {given}, stop: 1 }})", own, records) is None
    assert refusal(page, "pounding.simulate(scene, null)", re.sub(r"record = .*", "", scene)) is None
    assert refusal(page, "pounding.simulate(scene, { records: { a: 7 } })", scene) == (
        'records["a"]: expected the text or the bytes of a record, not number'
    )
    said = refusal(page, "pounding.simulate(scene, { records, outputs: 'impacts' })", scene, records)
    assert said == "outputs: expected a list of names, not string"
    assert "has not been given" in refusal(page, "pounding.simulate(scene)", scene.replace("el_centro", "nowhere"))
    assert "UTF-8" in page.evaluate("() => pounding.engine.problems(new Uint8Array([110, 255, 10]))")[0]
    return f"{len(options)} options"


def survives(page):
    """Input of any bytes and of 50 MB, and a stop: sentences, and the engine goes on."""
    large = "new Uint8Array(5e7).fill(%d)"
    for content in (large % 0, large % 65, large % 91, large % 255, "crypto.getRandomValues(new Uint8Array(65536))"):
        for call in (f"pounding.engine.findingsBeside({content})", f"pounding.engine.record({content}, 'x')"):
            found = page.evaluate(f"async () => {{ try {{ return await {call} }} catch (error) {{ return [error] }} }}")
            assert len(found) > 0, (call, found)
    long_run = """async ([scene, records]) => {
        const run = pounding.engine.simulate(scene, { records, step: 1e-5, outputs: ["impacts"] });
        await new Promise((go) => setTimeout(go, 200));
        const start = performance.now();
        pounding.engine.stop();
        try { await run; return ["went on", 0] } catch (error) { return [error.name, performance.now() - start] }
    }"""
    name, took = page.evaluate(long_run, [FEUP.read_text(), records_of(FEUP.read_text(), FEUP.parent)])
    assert name == "Stopped" and took < 200, (name, took)
    assert page.evaluate("() => pounding.engine.laws.length") > 5
    return f"stopped in {took:.1f} ms"


if __name__ == "__main__":
    main()
