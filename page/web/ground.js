// Records of ground motions: dropped or chosen, kept by name, looked at beside the periods of the buildings.

import { GRAVITY, digits, isRound, plural, seconds } from "./format.js";
import { element, make } from "./make.js";
import { kindOf, namesOf } from "./motion.js";
import { chartedOf } from "./pair.js";
import { colour, lineLook } from "./palette.js";
import { MOST_KEPT } from "./keep.js";
import { said } from "./notice.js";
import { drawUpright, makePlot, widthOf } from "./plots.js";
import { Unsaid, isMissing } from "./unsaid.js";
import { sentence } from "./words.js";

const MOST_BYTES_READ = 6e7;
const POINTS = 90;
const [SHORTEST, LONGEST] = [0.04, 5];
const RECORD_HEIGHT = 150;
const NO_RECORD = "no record: the ground is at rest";

export class Ground {
  // `setRecord` writes a record into the scene, and says whether it could: a name, or a table as the scene has it.
  constructor(state, engine, setRecord) {
    Object.assign(this, { state, engine, setRecord, known: new Map(), plots: [], latest: null, waiting: null });
    this.unsaid = new Unsaid((said) => this.#sayMore(said));
    element("record").addEventListener("change", () => this.take([...element("record").files]));
    element("ground-record").addEventListener("change", () => this.#set(element("ground-record").value));
    state.on("look", () => this.show());
    state.on("records", () => this.#list());
    state.on(["colours", "buildings"], () => this.draw());
    new ResizeObserver(() => this.#resize()).observe(element("record-charts"));
  }

  // Files that may be records: the last that is one becomes the ground motion.
  async take(files) {
    let name = null;
    for (const file of files) name = (await this.#read(file)) ?? name;
    element("record").value = "";
    if (name === null) return;
    this.#list();
    if (!this.#set(name)) this.#say(`${name} is kept; the scene has to be corrected before it can name it.`);
  }

  // The record of the scene from here on, with what is said about it.
  #set(name, said = {}) {
    this.latest = name;
    this.waiting = null;
    this.unsaid.show(said);
    return this.setRecord(Object.keys(said).length === 0 ? name : { file: name, ...said });
  }

  // More about the file that waits for it, else about the record of the scene.
  async #sayMore(said) {
    const { waiting } = this;
    if (!waiting) return void (this.latest && this.#set(this.latest, said));
    const about = await this.engine.record(waiting.bytes, waiting.name, said).catch((error) => this.#say(sentence(error)));
    if (about) this.#set(this.#keep(waiting, about), said);
  }

  async #read(file) {
    if (file.size > MOST_BYTES_READ)
      return void this.#say(
        `${file.name} has ${digits(file.size / 1e6, 3)} MB: expected a record of at most ${MOST_BYTES_READ / 1e6} MB.`,
      );
    this.#say(`${file.name} is being read.`);
    // A name that a scene can write as it is.
    const name = file.name.replace(/[\\\u0000-\u001f]/g, "_");
    const found = { name, bytes: new Uint8Array(await file.arrayBuffer()) };
    try {
      return this.#keep(found, await this.engine.record(found.bytes, name));
    } catch (error) {
      this.#say(sentence(error));
      if (!isMissing(sentence(error))) return;
      this.waiting = found;
      this.unsaid.show();
      this.unsaid.open();
    }
  }

  #keep({ name, bytes }, about) {
    this.state.records[name] = bytes;
    this.known.set(name, about);
    this.state.tell("records");
    const isKept = bytes.length <= MOST_KEPT;
    said(`${name} is read.${isKept ? "" : " It is too large for the browser to keep: drop it again after a reload."}`);
    return name;
  }

  #list() {
    const list = element("ground-record");
    const named = this.state.look?.ground?.record ?? "";
    list.replaceChildren();
    if (!named) make(list, "option", NO_RECORD, { value: "" });
    const names = Object.keys(this.state.records).flatMap((name) => this.#channelsOf(name));
    if (named && !names.some(({ value }) => value === named)) names.unshift({ value: named, text: named });
    for (const { value, text } of names) make(list, "option", text.split("/").at(-1), { value, title: value });
    list.value = named;
  }

  // A file may have several, of which a scene names one behind the name of the file: by the number that it has in the
  // file, if any.
  #channelsOf(name) {
    const channels = this.known.get(name)?.channels ?? [];
    if (channels.length < 2) return [{ value: name, text: name }];
    return channels.map((channel, at) => {
      const number = channel.match(/\d+/)?.[0] ?? at + 1;
      return { value: `${name}#${number}`, text: `${name} #${number}${channel && `, ${channel}`}` };
    });
  }

  // What the scene names now.
  async show() {
    this.#list();
    const missing = this.state.problems.find(({ text }) => /^ground\.record = .*has not been given/s.test(text));
    if (missing)
      return this.#say(
        `${missing.text.split(": expected")[0]}: this file is not in the browser (any more). Drop it here.`,
      );
    if (this.state.problems.some(({ text }) => /^ground\.(pga|record)\b/.test(text) && isMissing(text))) this.unsaid.open();
    const { ground } = this.state.look ?? {};
    if (!ground) {
      this.name = null;
      this.#say("The scene names no record. Drop one anywhere.");
      return this.draw();
    }
    const wanted = JSON.stringify(ground.said);
    const isOther =
      ground.record !== this.name || wanted !== this.wanted || this.content !== this.state.records[ground.record];
    [this.name, this.content, this.wanted] = [ground.record, this.state.records[ground.record], wanted];
    if (!this.waiting && this.state.problems.length === 0) {
      this.latest = ground.record;
      this.unsaid.show(ground.said);
    }
    if (isOther) await this.#about();
    this.#facts(ground);
    if (isOther) this.draw();
    else for (const plot of this.plots) plot.redraw(false);
  }

  async #about() {
    const content = this.#content();
    this.about = content === undefined ? null : await this.engine.record(content, this.name, this.#said()).catch(() => null);
    if (this.about) this.known.set(this.name.replace(/#[^#]*$/, ""), this.about);
    this.#list();
    if (this.spectrum?.isUnderWay) this.engine.stop("spectra");
    this.spectrum = null;
  }

  // Begins when it is looked at first.
  async #findSpectrum() {
    const periods = Array.from({ length: POINTS }, (_, at) => SHORTEST * (LONGEST / SHORTEST) ** (at / (POINTS - 1)));
    const spectrum = (this.spectrum = { periods, isUnderWay: true });
    const values = await this.engine.spectrum(this.#content(), this.name, periods, undefined, this.#said()).catch(() => null);
    Object.assign(spectrum, { values, isUnderWay: false });
    if (this.spectrum === spectrum) this.draw();
  }

  // What the scene says about its record.
  #said() {
    const { said = {} } = this.state.look?.ground ?? {};
    return Object.fromEntries(Object.entries(said).filter(([, value]) => value !== null));
  }

  // A name may have the channel behind it.
  #content() {
    return this.content ?? this.state.records[this.name.replace(/#[^#]*$/, "")];
  }

  #facts({ samples, duration, recordPeak, factor, peakInG }) {
    const peak = `peak ${digits(recordPeak / GRAVITY, 3)} g (${digits(recordPeak, 3)} m/s\u00B2)`;
    const own = `${samples} samples, ${digits(duration)} s, ${peak}`;
    this.#say(
      Math.abs(factor - 1) < 1e-9 ? own : `${own}; in this run times ${digits(factor, 3)}: ${digits(peakInG, 3)} g`,
    );
  }

  draw() {
    if (element("panel-spectrum").hidden) return;
    for (const plot of this.plots) plot.destroy();
    this.plots = [];
    element("record-charts").replaceChildren();
    const facts = element("record-facts");
    if (!this.name || !this.about) return void (facts.textContent = "No record to look at: drop one anywhere.");
    const { format, unit, component, samples, duration, peakInG, peakTime, ariasIntensity, mean } = this.about;
    facts.textContent = [
      `${this.name.split("/").at(-1)}: ${format}, in ${unit}${component && `, ${component}`}.`,
      `${plural(samples, "sample")} in ${digits(duration)} s;`,
      `as recorded peak ${digits(peakInG, 3)} g at ${seconds(peakTime, 2)} s,`,
      `mean ${digits(mean / GRAVITY, 2)} g, Arias intensity ${digits(ariasIntensity, 3)} m/s.`,
    ].join(" ");
    this.#acceleration();
    this.#response();
  }

  #acceleration() {
    const { times, accelerations } = this.about;
    const factor = (this.state.look?.ground?.factor ?? 1) / GRAVITY;
    const x = { label: "t", text: (time) => `${seconds(time)} s`, tick: (tick) => `${digits(tick, 9)} s` };
    this.#plot("acceleration [g]", [times, accelerations.map((value) => value * factor)], { label: "ground" }, x, {
      scales: { x: { time: false } },
    });
  }

  #response() {
    if (!this.spectrum) this.#findSpectrum();
    if (this.spectrum.isUnderWay)
      make(element("record-charts"), "p", "The response spectrum is being computed.", { class: "hint" });
    if (!this.spectrum.values) return;
    const factor = Math.abs(this.state.look?.ground?.factor ?? 1) / GRAVITY;
    const values = Array.from(this.spectrum.values, (value) => value * factor);
    const x = {
      label: "period",
      text: (period) => `${digits(period, 3)} s`,
      tick: (tick) => (tick === null || !isRound(tick) ? "" : `${digits(tick)} s`),
    };
    this.#plot("response spectrum, 5 % [g]", [this.spectrum.periods, values], { label: "Sa" }, x, {
      cursor: { drag: { x: false, y: false } },
      scales: { x: { time: false, distr: 3, range: () => [SHORTEST, LONGEST] } },
      hooks: { draw: [(plot) => this.#periods(plot)] },
    });
    for (const { name, kind, period, onSoil } of this.#known())
      make(element("record-charts"), "p", `first period, ${name}: ${digits(period, 3)} s${onSoil}`, {
        class: `hint of-${kind} ${kind.startsWith("row") ? "of-row" : ""}`,
      });
  }

  #plot(title, data, line, x, options) {
    const { plot } = makePlot(element("record-charts"), {
      title,
      height: RECORD_HEIGHT,
      data,
      lines: [{ ...line, ...lineLook("others", 0) }],
      x,
      options,
    });
    this.plots.push(plot);
  }

  // Where the first periods of the buildings are in the spectrum; names stand away from the other one.
  #periods(plot) {
    const { min, max } = plot.scales.x;
    const known = this.#known().filter(({ period }) => period >= min && period <= max);
    const shortest = Math.min(...known.map(({ period }) => period));
    known.forEach((one, which) => markPeriod(plot, { ...one, which }, known.length > 1 && one.period === shortest));
  }

  // First periods of those buildings that the charts show, on a fixed base, and what soil makes of them.
  #known() {
    const { look } = this.state;
    if (!look) return [];
    const names = namesOf(look);
    const charted = chartedOf(this.state, look);
    return look.buildings.flatMap(({ name, periods }, at) => {
      const period = periods?.[0];
      const ratio = look.layout.buildings[at].foundation?.period_ratio;
      const onSoil = ratio ? `, ${digits(ratio * period, 3)} s on its soil` : "";
      return period && charted.includes(name) ? [{ name, kind: kindOf(names, name), period, onSoil }] : [];
    });
  }

  #resize() {
    const width = widthOf(element("record-charts"));
    for (const plot of this.plots) plot.setSize({ width, height: RECORD_HEIGHT });
    if (this.plots.length === 0) this.draw();
  }

  #say(text) {
    element("record-says").textContent = text;
  }
}

function markPeriod(plot, { name, kind, period, which }, isLeftmost) {
  const { ctx: context, bbox } = plot;
  const ratio = devicePixelRatio || 1;
  const { stroke, dash } = lineLook(kind, 0, which);
  context.save();
  const x = drawUpright(plot, period, stroke, dash.slice(0, 2));
  context.fillStyle = stroke;
  context.font = `${11 * ratio}px system-ui, sans-serif`;
  context.textAlign = isLeftmost ? "right" : "left";
  context.fillText(` ${name} T1 `, x, bbox.top + 10 * ratio);
  context.restore();
}
