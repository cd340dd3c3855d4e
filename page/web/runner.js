// From text to picture: what is changed is checked, what is right is looked at and run, what has gone wrong is said
// in words while the last good picture stays.

import { digits, plural, seconds } from "./format.js";
import { element, settled } from "./make.js";
import { runInWords, sentence } from "./words.js";

// ms
const TYPING = 250;
// s: a run that takes no longer follows every change; one that takes no longer than the second number waits, ms, for
// the last change.
const QUICK = 0.5;
const BEARABLE = 4;
const UNTIL_SETTLED = 700;
// s that the first run may take longer: in it the browser compiles the engine.
const WARMING_UP = 1.5;
const BAR_AFTER = 250;
// Rows that a picture needs, s between them that are too long for one, rows in each impact, and numbers of all
// columns together.
const ROWS = 4000;
const FEWEST_ROWS = 1000;
const LONGEST_STEP = 0.01;
const IN_IMPACTS = 16;
// s: of longer runs no impact is looked at from near. More impacts than so many are more than a page has room for.
const LONG_RUN = 600;
const MOST_IMPACTS = 200_000;
// ms without a word: rows in impacts want a run beforehand, which says nothing; a long one does without them at first.
const SILENCE = 1200;
const MOST_NUMBERS_KEPT = 4e6;
const MOST_CONTACTS_SHOWN = 40;
const MOST_LINKS_SHOWN = 40;

export class Runner {
  constructor(state, engine) {
    Object.assign(this, {
      state,
      engine,
      checking: null,
      isStale: false,
      isRight: false,
      running: null,
      again: false,
      took: 0,
    });
    this.checkSoon = settled(() => this.check(), TYPING);
    this.startSoon = settled(() => this.isRight && this.start(), UNTIL_SETTLED);
    state.on("scene", (kind) => (kind === "typing" ? this.checkSoon() : this.check()));
    state.on("records", () => {
      state.checked = null;
      if (state.scene) this.check();
    });
    element("run").addEventListener("click", () => this.start());
    element("stop").addEventListener("click", () => this.stop());
    element("alone").addEventListener("change", () => this.runAlone());
    document.addEventListener("keydown", (event) => this.#key(event));
  }

  // Only what the text names goes along: another record may be large.
  records(scene = this.state.scene) {
    const { records } = this.state;
    const named = Object.entries(records).filter(
      ([name]) => scene.includes(name) || scene.includes(JSON.stringify(name).slice(1, -1)),
    );
    return Object.fromEntries(named);
  }

  // One after the other: what changes meanwhile is checked next, and a slow check is left for that.
  check() {
    this.isStale = true;
    if (!this.checking) this.checking = this.#checkAll().finally(() => (this.checking = null));
    else if (performance.now() - this.checkBegan > 1e3 * QUICK) this.engine.stop("checks");
    return this.checking;
  }

  async #checkAll() {
    while (this.isStale) {
      this.isStale = false;
      this.checkBegan = performance.now();
      await this.#checkOnce(this.state.scene);
    }
  }

  // Whether the text as it stands is right, and the name of its scene; for what must not act on an earlier one.
  async verdict() {
    if (this.state.checked !== this.state.scene) await this.check();
    return this.isRight ? this.right.look.name : null;
  }

  async #checkOnce(scene) {
    const records = this.records();
    const waiting = setTimeout(() => say("The scene is being checked."), BAR_AFTER);
    const look = await this.engine.lookBeside(scene, records).catch(() => null);
    const findings = look?.warnings ?? (this.isStale ? [] : await this.#findings(scene, records));
    clearTimeout(waiting);
    if (!look && this.isStale) return;
    this.state.problems = findings.filter(({ kind }) => kind !== "warning");
    this.state.warnings = findings.filter(({ kind }) => kind === "warning");
    this.state.checked = scene;
    this.isRight = look !== null;
    if (look) Object.assign(this.state, { look });
    if (look) this.right = { scene, look };
    this.state.tell("findings");
    this.state.tell("look");
    this.#goOn();
  }

  #findings(scene, records) {
    return this.engine.findingsBeside(scene, records).catch((error) => problemsOf(error));
  }

  #goOn() {
    const mistakes = plural(this.state.problems.length, "mistake");
    const seen = this.state.run ? "what you see is the last run that was right" : "nothing has run yet";
    if (!this.isRight) say(`${mistakes} in the scene; ${seen}.`);
    else if (this.took < QUICK) this.start();
    else if (this.took < BEARABLE) this.startSoon();
    else say("The scene has changed: Run computes it.");
  }

  // A run that goes on is finished first if it is quick, else left for the new one.
  async start() {
    if (this.running) {
      this.again = true;
      if (performance.now() - this.running > 1e3 * QUICK) this.engine.stop("runs");
      return;
    }
    if (!(await this.verdict())) return this.#refused();
    if (this.running) return void (this.again = true);
    this.running = performance.now();
    this.#busy(true);
    try {
      await this.#run();
    } catch (error) {
      if (error.name !== "Stopped") say(sentence(error));
      else if (!this.again) setTimeout(() => this.#stopped());
    }
    this.running = null;
    this.#busy(false);
    if (this.again) {
      this.again = false;
      this.start();
    }
  }

  stop() {
    this.again = false;
    if (document.activeElement === element("stop")) element("run").focus();
    element("stop").disabled = true;
    say("Stopped.");
    this.engine.stop("runs");
    this.engine.stop("alone");
  }

  async #run() {
    const { state } = this;
    const { scene, look } = this.right;
    const started = performance.now();
    const run = await this.#compute(scene, look);
    const passed = (performance.now() - started) / 1e3;
    this.took = state.run === null ? Math.max(0, passed - WARMING_UP) : passed;
    this.#take(run, scene, look, state.run === null ? null : passed);
    // What follows takes its time without a word: the line has just said what happened.
    clearTimeout(this.bar);
    await this.runAlone();
  }

  async #compute(scene, look) {
    const options = { ...wishes(look), records: this.records(scene) };
    this.soFar = null;
    let silent = true;
    const heard = (progress) => {
      silent = false;
      this.soFar = { ...progress, scene, look };
      this.#progress(progress);
    };
    let restarts = false;
    const watch = setTimeout(() => {
      restarts = silent && this.running !== null;
      if (restarts) this.engine.stop("runs");
    }, SILENCE);
    try {
      return await this.engine.simulate(scene, options, heard, "runs");
    } catch (error) {
      if (!restarts || error.name !== "Stopped") throw error;
      return await this.engine.simulate(scene, { ...options, rowsPerImpact: undefined }, heard, "runs");
    } finally {
      clearTimeout(watch);
    }
  }

  #take(run, scene, look, took) {
    const { state } = this;
    state.run = {
      ...run,
      look: { ...look, contacts: look.layout.contacts },
      scene,
      stop: run.time.at(-1) || run.stop,
      took,
    };
    state.chosen = null;
    state.alone = null;
    state.tell("run");
    say(runInWords(state.run));
  }

  // What there is of a run that has been stopped is worth a look.
  #stopped() {
    const { soFar } = this;
    if (!soFar || soFar.rows < 10) return say("Stopped. What you see is the run before.");
    this.#take(soFar.partial(), soFar.scene, soFar.look, null);
    const why = soFar.impacts > MOST_IMPACTS ? ` by ${soFar.impacts} impacts, more than the page has room for,` : "";
    say(`Stopped${why} at ${seconds(soFar.time, 2)} s of ${digits(soFar.look.stop)} s: what you see goes up to there.`);
  }

  // The same without contacts, for those who want to see both.
  async runAlone() {
    const { state, engine } = this;
    const { run } = state;
    if (run && element("alone").checked && !state.alone) {
      const options = {
        ...wishes(run.look),
        records: this.records(run.scene),
        withoutContacts: true,
        rowsPerImpact: undefined,
      };
      const alone = await engine.simulate(run.scene, options, undefined, "alone").catch(() => null);
      if (state.run === run) state.alone = alone && { ...alone, look: run.look };
    }
    state.tell("alone");
  }

  #busy(is) {
    element("stop").disabled = !is;
    document.body.classList.toggle("busy", is);
    clearTimeout(this.bar);
    element("progress").hidden = true;
    element("progress").value = 0;
    if (is) this.bar = setTimeout(() => this.#showBusy(), BAR_AFTER);
  }

  #showBusy() {
    element("progress").hidden = false;
    say(this.state.run ? "Computing; what you see is the run before." : "Computing.");
  }

  #progress({ share, time, impacts }) {
    element("progress").value = share;
    if (impacts > MOST_IMPACTS) return this.engine.stop("runs");
    if (performance.now() - this.running > 1e3 * QUICK)
      say(`${seconds(time, 2)} s of ${digits(this.state.look.stop)} s, ${plural(impacts, "impact")} so far`);
  }

  #refused() {
    say("The scene has mistakes: the list under it says which.");
    element("problems").querySelector("button")?.focus();
  }

  #key(event) {
    if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) this.start();
    else if (event.key === "Escape" && this.running) this.stop();
    else return;
    event.preventDefault();
  }
}

function say(text) {
  if (element("happened").textContent !== text) element("happened").textContent = text;
}

const problemsOf = (error) =>
  (error.problems ?? [error.message]).map((text) => ({ kind: "problem", text, line: null }));

// Rows and columns that a picture needs: all outputs, of tall buildings fewer rows, of the tallest what is drawn.
export function wishes(look) {
  const floors = look.buildings.reduce((sum, building) => sum + building.floors, 0);
  const contacts = look.layout.contacts.length;
  const links = look.layout.links.length;
  const columns = 11 * floors + 10 * contacts + 9 * links + 34;
  const most = MOST_NUMBERS_KEPT / columns;
  const isTall = most < FEWEST_ROWS;
  const step = Math.max(look.stop / Math.max(most, FEWEST_ROWS), Math.min(look.stop / ROWS, LONGEST_STEP));
  return {
    step,
    rowsPerImpact: look.stop > LONG_RUN ? undefined : IN_IMPACTS,
    outputs: isTall ? drawn(look, contacts, links) : undefined,
  };
}

function drawn(look, contacts, links) {
  const names = look.ground ? ["ground.acceleration"] : [];
  for (const { name, floors, foundation: soil } of look.layout.buildings) {
    for (let floor = 1; floor <= floors; floor++) names.push(`${name}.displacement[${floor}]`);
    if (soil?.sway.length) names.push(`${name}.foundation.displacement`);
    if (soil?.rocking.length) names.push(`${name}.foundation.rotation`);
  }
  for (let contact = 1; contact <= Math.min(contacts, MOST_CONTACTS_SHOWN); contact++)
    names.push(`contact[${contact}].force`, `contact[${contact}].penetration`);
  for (let link = 1; link <= Math.min(links, MOST_LINKS_SHOWN); link++)
    names.push(`link[${link}].force`, `link[${link}].displacement`);
  return names;
}
