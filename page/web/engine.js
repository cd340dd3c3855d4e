// What the page asks of the engine. What is short is asked on the spot; what takes long goes to workers, a lane for each
// purpose, so that one of them can be stopped while the others go on.

import { Asking, Refusal, bytesOf } from "./asking.js";
import { Lane } from "./lane.js";

const IMPACT = ["contact", "start_s", "end_s", "approach_velocity", "separation_velocity", "peak_force", "peak_time_s",
  "peak_penetration", "impulse", "dissipated_energy"];
const NO_LIBRARIES = "this page holds no libraries, without which an FMU cannot be run; the page of a release has them";

const OF_RUN = ["step", "stop", "outputs", "parameters", "records", "rowsPerImpact", "withoutContacts"];

const held = (id) => document.getElementById(id).textContent;

export class Engine {
  // By file name: { file, name, description, text }, and the scene that the page has been made for, if there is one.
  examples = JSON.parse(held("examples"));
  given = JSON.parse(held("given"));
  // Content of the records that these scenes name, by the path that is in the scene; complete when the engine is ready.
  records = Object.create(null);
  platforms = Object.keys(JSON.parse(held("libraries")));
  #asking = null;
  #lanes = new Map();
  // By platform, unpacked when they are first wanted.
  #libraries = null;
  // Fulfilled when the engine can be asked. Begins last: it fills what stands above.
  ready = this.#start();

  async #start() {
    const [program] = await Promise.all([unpacked(held("engine")), this.#unpackRecords()]);
    this.module = await WebAssembly.compile(program);
    this.#asking = new Asking(this.module);
  }

  async #unpackRecords() {
    const packed = Object.entries(JSON.parse(held("records")));
    await Promise.all(packed.map(async ([path, content]) => (this.records[path] = await unpacked(content))));
  }

  // What is wrong with a scene, and what looks like a slip in it, a text each.
  problems(scene, records = {}) {
    return this.#now(scene, records, { call: "problems" });
  }

  warnings(scene, records = {}) {
    return this.#now(scene, records, { call: "warnings" });
  }

  // The same for an editor: { kind: "problem" or "warning", text, path, line }, the line counted from 1, or null.
  findings(scene, records = {}) {
    return this.#now(scene, records, { call: "findings" });
  }

  // What can be drawn of a scene before it is run (page/src/look.rs). Refused where the scene has problems.
  look(scene, records = {}) {
    return this.#now(scene, records, { call: "look" });
  }

  // The laws of contact: name, force, restitution, known defect.
  get laws() {
    return this.#asked({ call: "laws" }).json;
  }

  // The text of a scene with values set by path (page/src/edit/mod.rs): edit(scene, { "contact[*].gap": 0.01 }),
  // "left.storeys": 4, "contact[1].law": "hertz"; null takes a key away.
  edit(scene, changes) {
    const { bytes } = this.#asked({ call: "edit", changes: Object.entries(changes) }, [scene], true);
    return new TextDecoder().decode(bytes);
  }

  // Findings and look, beside the page: for scenes and records that are large.
  async findingsBeside(scene, records = {}) {
    return (await this.#lane("checks").ask(question(scene, records, { call: "findings" }))).json;
  }

  async lookBeside(scene, records = {}) {
    return (await this.#lane("checks").ask(question(scene, records, { call: "look" }))).json;
  }

  // A run, with the rows and the bits of pounding_fmu.simulate. `onProgress` gets { share, time, rows, impacts, partial }:
  // the share that is done, s, how many rows and impacts there are, and a function that makes a run of them.
  async simulate(scene, options = {}, onProgress = () => {}, lane = "runs") {
    const { step, stop, outputs, parameters, records = {}, rowsPerImpact, withoutContacts } = checked(options, OF_RUN);
    if (outputs != null && !Array.isArray(outputs)) throw wrongType("outputs", "a list of names", outputs);
    const header = { call: "run", step: spoken(step), stop: spoken(stop), outputs: outputs ?? undefined,
      parameters: Object.entries(parameters ?? {}).map(([name, value]) => [name, spoken(value)]), rowsPerImpact, withoutContacts };
    let run = null;
    const take = (answer) => {
      if (!run) return void (run = new Run(answer.json));
      run.add(answer);
      onProgress({ share: run.share, time: run.at, rows: run.rows, impacts: run.impacts.length, partial: () => run.result() });
    };
    take(await this.#lane(lane).ask({ ...question(scene, records, header), isJob: true }, take));
    return run.result();
  }

  // Runs with many gaps, m, of all contacts at once: { gaps, columns: { name: one value a gap }, failures }.
  async study(scene, { gaps, records = {} }, onProgress = () => {}, lane = "study") {
    const names = [];
    const rows = [];
    const failures = [];
    const take = ({ json, numbers }) => {
      if (json.columns) return void names.push("gap", ...json.columns);
      for (let at = 0; at < numbers.length; at += names.length) rows.push(numbers.subarray(at, at + names.length));
      failures.push(...json.failures);
      onProgress({ share: rows.length / (rows.length + json.left), partial: made });
    };
    const made = () => {
      const columns = names.map((name, place) => [name, Float64Array.from(rows, (row) => row[place])]);
      const { gap, ...others } = Object.fromEntries(columns);
      return { gaps: gap, columns: others, failures: [...failures] };
    };
    const header = { call: "study", gaps: [...gaps] };
    take(await this.#lane(lane).ask({ ...question(scene, records, header), isJob: true }, take));
    return made();
  }

  // What is in a record of any format, with what is `said` about it by the keys of a scene's ground.record: samples, duration, peak, ..., and `times` (s) and `accelerations` (m/s2).
  async record(content, name, said = {}) {
    const { json, numbers } = await this.#lane("records").ask(ofRecord(content, { call: "record", name, said }));
    const half = numbers.length / 2;
    return { ...json, times: numbers.subarray(0, half), accelerations: numbers.subarray(half) };
  }

  // Pseudo-spectral acceleration, m/s2, at periods, s, for 5 % damping.
  async spectrum(content, name, periods, onProgress = () => {}, said = {}) {
    const values = [];
    const take = ({ json, numbers }) => {
      values.push(...numbers);
      if ("left" in json) onProgress({ share: values.length / periods.length });
    };
    const header = { call: "spectrum", name, said, periods: [...periods] };
    take(await this.#lane("spectra").ask({ ...ofRecord(content, header), isJob: true }, take));
    return Float64Array.from(values);
  }

  // The FMU for FMI 2 or 3, with the libraries of all platforms that the page holds.
  async buildFmu(scene, { records = {}, fmi = 2 } = {}, lane = "files") {
    if (this.platforms.length === 0) throw new Refusal({ kind: "ValueError", problems: [NO_LIBRARIES] });
    this.#libraries ??= Promise.all(Object.entries(JSON.parse(held("libraries"))).map(
      async ([platform, content]) => [platform, await unpacked(content)]));
    const libraries = await this.#libraries;
    const { header, parts } = question(scene, records, { call: "fmu", fmi, libraries: libraries.map(([platform]) => platform) });
    return this.#file(header, [...parts, ...libraries.map(([, content]) => content)], lane);
  }

  // Files as the commands write them: the tables of simulate --csv and --impacts, the page of simulate --html.
  csv(scene, { records = {}, step, stop } = {}, lane = "files") {
    const { header, parts } = question(scene, records, { call: "csv", step: spoken(step), stop: spoken(stop) });
    return this.#file(header, parts, lane);
  }

  impactsCsv(scene, { records = {}, stop } = {}, lane = "files") {
    const { header, parts } = question(scene, records, { call: "impactsCsv", stop: spoken(stop) });
    return this.#file(header, parts, lane);
  }

  report(scene, { records = {}, stop } = {}, lane = "files") {
    const { header, parts } = question(scene, records, { call: "report", stop: spoken(stop) });
    return this.#file(header, parts, lane);
  }

  async #file(header, parts, lane) {
    return (await this.#lane(lane).ask({ header, parts, isFile: true })).bytes;
  }

  // A record as CSV, whose numbers read back as the same ones.
  toCsv({ times, accelerations }, name) {
    const rows = Array.from(times, (time, place) => `${time},${accelerations[place]}`);
    return [`# ${name.split(/\s+/).join(" ")}`, "time_s,accel_m_s2", ...rows, ""].join("\n");
  }

  // Stops what goes on in a lane: "runs" (simulate), "study", "spectra", "files".
  stop(lane = "runs") {
    this.#lane(lane).stop();
  }

  #lane(name) {
    if (!this.module) throw new Refusal({ kind: "RuntimeError", problems: ["the engine is not ready yet"] });
    if (!this.#lanes.has(name)) this.#lanes.set(name, new Lane(this.module, held("worker")));
    return this.#lanes.get(name);
  }

  #now(scene, records, header) {
    const { header: whole, parts } = question(scene, records, header);
    return this.#asked(whole, parts).json;
  }

  #asked(header, parts = [], isFile = false) {
    if (!this.#asking) throw new Refusal({ kind: "RuntimeError", problems: ["the engine is not ready yet"] });
    return this.#asking.ask(header, parts, isFile);
  }
}

// A run as it grows.
class Run {
  #columns;
  #last = null;

  constructor(begun) {
    Object.assign(this, { begun, rows: 0, impacts: [], at: 0 });
    this.#columns = [{ name: "time" }, ...begun.columns].map(({ name }) => [name, this.#room(begun)]);
  }

  #room({ rows, columns }) {
    try {
      return new Float64Array(rows);
    } catch {
      const problem = `${rows} rows of ${columns.length + 1} columns: expected fewer, by a larger step`;
      throw new Refusal({ kind: "MemoryError", problems: [problem] });
    }
  }

  get share() {
    return this.#last?.done ? 1 : this.at / this.begun.stop;
  }

  add({ json, numbers }) {
    for (const [place, [, column]] of this.#columns.entries()) {
      column.set(numbers.subarray(place * json.rows, (place + 1) * json.rows), this.rows);
    }
    const impacts = impactsOf(numbers.subarray(this.#columns.length * json.rows));
    // The last answer has them all, in their order and with those that are not over.
    if (json.done) this.impacts = impacts;
    else this.impacts.push(...impacts);
    this.rows += json.rows;
    this.at = json.time ?? this.at;
    this.#last = json;
  }

  // Columns by name, the time beside them; `variables` says unit, meaning and kind of each.
  result() {
    const cut = (column) => (column.length === this.rows ? column : column.slice(0, this.rows));
    const [[, time], ...columns] = this.#columns.map(([name, column]) => [name, cut(column)]);
    const { name, step, stop } = this.begun;
    const variables = Object.fromEntries(this.begun.columns.map(({ name, ...rest }) => [name, rest]));
    return { time, columns: Object.fromEntries(columns), impacts: [...this.impacts], name, step, stop, variables };
  }
}

function impactsOf(numbers) {
  const count = numbers.length / IMPACT.length;
  const impact = (at) => Object.fromEntries(IMPACT.map((name, place) => [name, numbers[at * IMPACT.length + place]]));
  return Array.from({ length: count }, (_, at) => impact(at));
}

const isContent = (value) => typeof value === "string" || value instanceof Uint8Array || value instanceof ArrayBuffer;

// Options by name; unknown ones are slips.
function checked(options, known) {
  if (options !== null && typeof options !== "object") throw wrongType("options", `an object of ${known.join(", ")}`, options);
  const unknown = Object.keys(options ?? {}).find((name) => !known.includes(name));
  if (unknown === undefined) return options ?? {};
  throw new Refusal({ kind: "TypeError", problems: [`${unknown}: no such option; expected ${known.join(", ")}`] });
}

function wrongType(name, expected, value) {
  return new Refusal({ kind: "TypeError", problems: [`${name}: expected ${expected}, not ${value === null ? "null" : typeof value}`] });
}

function question(scene, records, header) {
  if (!isContent(scene)) throw wrongType("scene", "the text of a scene", scene);
  const all = Object.entries(records ?? {});
  for (const [name, content] of all) {
    if (!isContent(content)) throw wrongType(`records[${JSON.stringify(name)}]`, "the text or the bytes of a record", content);
  }
  return { header: { ...header, records: all.map(([name]) => name) }, parts: [scene, ...all.map(([, content]) => content)].map(bytesOf) };
}

function ofRecord(content, header) {
  return { header, parts: [bytesOf(content)] };
}

// A value as JSON can say it.
function spoken(value) {
  const isSpecial = typeof value === "number" && !Number.isFinite(value);
  return isSpecial ? { number: String(value) } : value ?? undefined;
}

// Bytes from the base64 of their gzip.
export async function unpacked(text) {
  const packed = Uint8Array.fromBase64?.(text) ?? Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// What a script may use, `window.pounding`: records that it does not give are those that the page has.
export function forScripts(engine, recordsOfPage = () => engine.records) {
  // A record's name may be one that objects have by themselves.
  const all = (records) => Object.assign(Object.create(null), recordsOfPage(), records);
  // Both problems(scene, records) and, as simulate has it, problems(scene, { records }).
  const isMap = (value) => value !== null && typeof value === "object" && !isContent(value);
  const either = (records) => all(isMap(records?.records) ? records.records : records);
  return {
    engine,
    ready: engine.ready,
    problems: (scene, records) => engine.problems(scene, either(records)),
    warnings: (scene, records) => engine.warnings(scene, either(records)),
    simulate: async (scene, options = {}) => {
      const wishes = checked(options, OF_RUN);
      return engine.simulate(scene, { ...wishes, records: all(wishes.records) }, undefined, "scripts");
    },
    buildFmu: async (scene, options = {}) => {
      const { records, fmi } = checked(options, ["records", "fmi"]);
      return engine.buildFmu(scene, { records: all(records), fmi });
    },
  };
}
