// Which gap? The run repeated with many gaps: how hard the hardest impact is and how far storeys drift, over the gap.
// A click on the curve sets the gap of the scene.

import { digits, handyUnit, isRound, largestOf, quantity, withUnit } from "./format.js";
import { element, make } from "./make.js";
import { kindOf, namesOf } from "./motion.js";
import { colour, lineLook } from "./palette.js";
import { drawUpright, makePlot, widthOf } from "./plots.js";
import { wishes } from "./runner.js";
import { sentence } from "./words.js";

const GAPS = 100;
const CHART_HEIGHT = 118;
// As many as have colours of their own.
const MOST_BUILDINGS = 8;

export class Study {
  // `setGap` writes a gap, m, into the scene; `gapNow` is that of its handle.
  constructor(state, engine, runner, { setGap, gapNow }) {
    Object.assign(this, { state, engine, runner, setGap, gapNow, plots: [], result: null });
    element("study").addEventListener("click", () => this.start());
    element("stop-study").addEventListener("click", () => this.engine.stop("study"));
    state.on("look", () => this.#moved());
    state.on("scene", (kind) => kind !== "gap" && this.#leave());
    state.on("colours", () => this.draw());
    new ResizeObserver(() => this.#resize()).observe(element("study-charts"));
  }

  async start() {
    const { state, engine } = this;
    if (!(await this.runner.verdict())) return this.#say("The scene has mistakes: correct them first.");
    this.#busy(true);
    this.#say("The gap at which the buildings just do not touch is looked for.");
    const [scene, records, look] = [state.scene, this.runner.records(), state.look];
    try {
      const needed = await this.#needed(scene, records, look);
      if (!(needed > 0)) throw new Error("The buildings never come closer than at rest: any gap will do.");
      const gaps = spaced(needed / 100, 1.3 * needed, GAPS);
      const started = performance.now();
      const result = await engine.study(scene, { gaps, records }, ({ share, partial }) =>
        this.#progress(share, partial, needed),
      );
      this.#take(result, needed);
      this.#sayResult((performance.now() - started) / 1e3);
    } catch (error) {
      this.#say(error.name === "Stopped" ? "Stopped." : sentence(error));
    }
    this.#busy(false);
  }

  // m: how far both sides of a contact would overlap if they could, which is the gap that keeps them apart.
  async #needed(scene, records, look) {
    const of = look.layout.contacts.flatMap(({ row }) => row.map(([side, name]) => `${side}.${name}`));
    const outputs = [...new Set(of)];
    const options = { records, outputs, step: wishes(look).step, withoutContacts: true };
    const free = await this.engine.simulate(scene, options, undefined, "study");
    let most = 0;
    for (const { row } of look.layout.contacts) {
      for (let at = 0; at < free.time.length; at++) {
        const depth = row.reduce((sum, [side, name, weight]) => sum + weight * free.columns[`${side}.${name}`][at], 0);
        most = Math.max(most, depth);
      }
    }
    return most;
  }

  #progress(share, partial, needed) {
    element("study-progress").value = share;
    this.#say(`${Math.round(100 * share)} % of the gaps`);
    if (performance.now() - (this.drawnAt ?? 0) < 300) return;
    this.drawnAt = performance.now();
    this.#take(partial(), needed);
  }

  #take(result, needed) {
    if (!result.gaps?.length) return;
    const most = (names) =>
      Array.from(result.gaps, (_, at) =>
        names.reduce((largest, name) => Math.max(largest, result.columns[name][at]), 0),
      );
    const named = (pattern) => Object.keys(result.columns).filter((name) => pattern.test(name));
    const force = most(named(/^contact\[\d+\]\.peak_force$/));
    const drifts = namesOf(this.state.look).flatMap((name) => {
      const own = named(new RegExp(`^${name}\\.peak_drift\\[`));
      return own.length > 0 ? [{ name, values: most(own) }] : [];
    });
    this.result = {
      gaps: result.gaps,
      force,
      laws: this.state.look.layout.contacts.map(({ law }) => law),
      drifts,
      impacts: Array.from(result.columns.impacts ?? []),
      needed,
      failures: result.failures,
    };
    this.draw();
  }

  draw() {
    if (!this.result || element("panel-study").hidden) return;
    const { gaps, force, drifts, impacts } = this.result;
    const names = drifts.map(({ name }) => name);
    for (const plot of this.plots) plot.destroy();
    element("study-charts").replaceChildren();
    const x = Array.from(gaps, (gap) => 1e3 * gap);
    const forces = handyUnit(largestOf(force), "N");
    const drift = handyUnit(Math.max(0, ...drifts.map(({ values }) => largestOf(values))), "m");
    const of = (values, { factor }) => values.map((value) => value * factor);
    // Rigid floors exchange impulses; a force is there only while they are held together.
    const isRigid = this.result.laws.every((law) => law === "stereomechanical");
    this.plots = [
      this.#plot(isRigid ? "pressing while held together" : "hardest impact", forces, x, [
        { label: "peak force", values: of(force, forces), ...lineLook("others", 0) },
      ]),
      this.#plot(
        "largest drift",
        drift,
        x,
        mostDrifting(drifts).map(({ name, values }, which) => ({
          label: name,
          values: of(values, drift),
          ...lineLook(kindOf(names, name), 0, which),
        })),
      ),
      this.#plot("impacts", { name: "" }, x, [{ label: "count", values: impacts, ...lineLook("others", 0) }]),
    ];
  }

  #plot(title, unit, gaps, lines) {
    const { plot } = makePlot(element("study-charts"), {
      title: withUnit(title, unit),
      height: CHART_HEIGHT,
      lines,
      data: [gaps, ...lines.map(({ values }) => values)],
      x: {
        label: "gap",
        text: (gap) => `${digits(gap, 3)} mm`,
        tick: (tick) => (tick === null || !isRound(tick) ? "" : `${digits(tick)} mm`),
      },
      options: {
        cursor: { sync: { key: "study" }, drag: { x: false, y: false } },
        scales: {
          x: { time: false, distr: 3, range: () => [gaps[0], gaps.at(-1)] },
          y: { range: (_, low, high) => [0, 1.08 * (high || 1)] },
        },
        hooks: { draw: [(one) => this.#present(one)] },
      },
    });
    plot.over.addEventListener("click", (event) => this.#clicked(plot, event));
    return plot;
  }

  #clicked(plot, event) {
    const gap = plot.posToVal(event.clientX - plot.over.getBoundingClientRect().left, "x") / 1e3;
    this.setGap(Number(gap.toPrecision(3)));
  }

  // The gap of the scene as it is now.
  #present(plot) {
    const gap = 1e3 * this.gapNow();
    const { min, max } = plot.scales.x;
    if (!(gap >= min && gap <= max)) return;
    plot.ctx.save();
    drawUpright(plot, gap, colour("ink"), [6, 4]);
    plot.ctx.restore();
  }

  // What was found for another scene says nothing of this one.
  #leave() {
    this.engine.stop("study");
    this.result = null;
    for (const plot of this.plots) plot.destroy();
    this.plots = [];
    element("study-charts").replaceChildren();
    this.#say("");
  }

  #moved() {
    const contacts = this.state.look?.layout.contacts ?? [];
    element("study").disabled = contacts.length === 0 || !element("stop-study").hidden;
    for (const plot of this.plots) plot.redraw();
  }

  #resize() {
    const width = widthOf(element("study-charts"));
    for (const plot of this.plots) plot.setSize({ width, height: CHART_HEIGHT });
    if (this.plots.length === 0) this.draw();
  }

  #sayResult(took) {
    const { gaps, force, laws, needed, failures } = this.result;
    const worst = force.indexOf(Math.max(...force));
    const apart = `From ${quantity(needed, "m", 3)} on they never touch (the dashed line is the gap of the scene)`;
    const hardest =
      force[worst] > 0 && !laws.includes("stereomechanical")
        ? `; hardest at ${quantity(gaps[worst], "m", 3)} with ${quantity(force[worst], "N", 3)}`
        : "";
    const failed = failures.length > 0 ? ` ${failures.length} gaps could not be run: ${failures[0]}` : "";
    this.#say(
      `${apart}${hardest}. ${gaps.length} runs in ${digits(took, 2)} s. A click on a curve sets the gap.${failed}`,
    );
  }

  #busy(is) {
    element("study").disabled = is;
    element("stop-study").hidden = !is;
    element("study-progress").hidden = !is;
    element("study-progress").value = 0;
  }

  #say(text) {
    element("study-says").textContent = text;
  }
}

// Of a long row the buildings with the largest drifts, from left to right.
function mostDrifting(drifts) {
  const largest = drifts.map(({ values }) => largestOf(values)).sort((a, b) => b - a);
  const least = largest[MOST_BUILDINGS - 1] ?? 0;
  return drifts.filter(({ values }) => largestOf(values) >= least).slice(0, MOST_BUILDINGS);
}

const spaced = (from, to, count) => Array.from({ length: count }, (_, at) => from * (to / from) ** (at / (count - 1)));
