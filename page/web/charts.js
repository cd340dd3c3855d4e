// Charts over time: one below the other, all over the same stretch, with the moment of the picture as a line.

import { digits, handyUnit, largestOf, seconds, withUnit } from "./format.js";
import { element, make, onceAFrame, settled } from "./make.js";
import { rowBefore } from "./motion.js";
import { chartedOf } from "./pair.js";
import { colour } from "./palette.js";
import { describePlot, makePlot, widthOf } from "./plots.js";
import { chartsOf, usualFloors } from "./series.js";

const HEIGHT = 132;
const CHOICE = 24;
const MOST_DOTS = 2000;

export class Charts {
  constructor(state, player) {
    Object.assign(this, { state, player, plots: [], buildings: [], floors: new Set(), known: "" });
    this.update = onceAFrame(() => this.#update());
    this.describe = settled(
      () => this.plots.forEach(({ plot, heading }) => describePlot(plot, heading.textContent)),
      500,
    );
    state.on(["run", "buildings"], () => this.#newRun());
    state.on("colours", () => this.draw());
    state.on("time", () => this.#moment());
    state.on("stretch", () => this.#stretch());
    new ResizeObserver(() => this.#resize()).observe(element("chart-list"));
    this.#buttons();
  }

  #newRun() {
    const { run } = this.state;
    const key = JSON.stringify([run.look.name, run.look.buildings.map(({ name, floors }) => [name, floors])]);
    const longer = this.stop !== run.stop;
    const buildings = chartedOf(this.state, run.look);
    const others = buildings.join() !== this.buildings.join();
    this.buildings = buildings;
    if (key !== this.known || others) this.#listFloors(run.look);
    if (key !== this.known || longer) this.state.show(0, run.stop);
    [this.known, this.stop] = [key, run.stop];
    this.draw();
  }

  // Same charts: new numbers only, which is what a slider in motion needs.
  draw() {
    const { run } = this.state;
    if (!run) return;
    const wanted = chartsOf(run, this);
    const names = JSON.stringify(wanted.map(({ id, lines }) => [id, lines.map(({ name }) => name)])) + colour("ink");
    if (names !== this.names) this.#build(wanted);
    this.names = names;
    this.wanted = wanted;
    this.update();
  }

  #update() {
    const { run } = this.state;
    this.wanted.forEach((chart, at) => {
      const { plot, heading, shown } = this.plots[at];
      const columns = chart.lines.map(({ name }) => run.columns[name]);
      const force = chart.impacts ? largestForce(run) : 0;
      const unit = handyUnit(
        columns.reduce((most, column) => Math.max(most, largestOf(column)), force),
        chart.unit,
      );
      heading.textContent = withUnit(chart.title, unit);
      const factor = unit.factor * (chart.factor ?? 1);
      Object.assign(shown, { chart, unit, force: force * unit.factor });
      plot.setData([run.time, ...columns.map((column) => column.map((value) => value * factor))], false);
      plot.setScale("x", { min: this.state.stretch[0], max: this.state.stretch[1] });
    });
    this.describe();
    queueMicrotask(() => this.#moment());
  }

  #build(wanted) {
    for (const { box, plot } of this.plots) {
      plot.destroy();
      box.remove();
    }
    this.plots = wanted.map((chart) => this.#buildOne(chart));
  }

  #buildOne(chart) {
    // What the plot shows now, for what is drawn over it.
    const shown = { force: 0 };
    const lines = chart.lines.map(({ label, look }) => ({ label, ...look() }));
    const { box, heading, plot } = makePlot(element("chart-list"), {
      title: chart.title,
      height: HEIGHT,
      lines,
      data: [[0], ...lines.map(() => [0])],
      attributes: { "data-chart": chart.id },
      x: { label: "t", text: (time) => `${seconds(time, 4)} s`, tick: (tick) => digits(tick, 9) },
      options: {
        cursor: { sync: { key: "run" }, drag: { x: true, y: false }, points: { size: 5 } },
        scales: {
          x: { time: false },
          y: {
            range: (one, low, high) =>
              rangeWith([low, high, ...atEdges(one, this.state.stretch), ...(chart.floats ? [] : [0, shown.force])]),
          },
        },
        hooks: {
          setScale: [(one, key) => key === "x" && this.#zoomed(one)],
          draw: [(one) => chart.impacts && this.#dots(one, shown), (one) => chart.zero && drawZero(one)],
        },
      },
    });
    const now = make(plot.over, "div", "", { class: "moment" });
    this.#clicks(plot);
    return { box, plot, heading, now, shown };
  }

  // A press that does not drag goes to its time.
  #clicks(plot) {
    let from = 0;
    plot.over.addEventListener("mousedown", (event) => (from = event.clientX));
    plot.over.addEventListener("mouseup", (event) => {
      if (event.button !== 0 || Math.abs(event.clientX - from) > 3) return;
      this.player.pause();
      this.state.seek(plot.posToVal(event.clientX - plot.over.getBoundingClientRect().left, "x"));
    });
  }

  // What one chart shows, all show.
  #zoomed(plot) {
    const { min, max } = plot.scales.x;
    const [from, to] = this.state.stretch;
    const stop = this.state.run?.stop;
    if (this.following || min === null || !stop || (min === from && max === to)) return;
    this.state.show(min, max);
  }

  #stretch() {
    const [min, max] = this.state.stretch;
    element("shown").textContent = `${seconds(min, 3)} s to ${seconds(max, 3)} s`;
    this.following = true;
    for (const { plot } of this.plots) plot.setScale("x", { min, max });
    queueMicrotask(() => {
      this.following = false;
      this.#moment();
    });
  }

  // A line where the picture is; the legends say the values there, as long as no cursor asks for others.
  #moment() {
    const { time, run } = this.state;
    if (!run) return;
    const row = rowBefore(run.time, time);
    for (const { plot, now } of this.plots) {
      const { min, max } = plot.scales.x;
      now.hidden = !(time >= min && time <= max);
      if (!now.hidden) now.style.transform = `translateX(${plot.valToPos(time, "x")}px)`;
      if (plot.cursor.left < 0 && plot.data[0].length === run.time.length) plot.setLegend({ idx: row }, false);
    }
  }

  // The largest force of each impact, which the rows may miss: a stem each, and as long as they can be told apart a
  // dot.
  #dots(plot, { unit, chart }) {
    const { run } = this.state;
    if (!run || !chart) return;
    const [min, max] = [plot.scales.x.min, plot.scales.x.max];
    const shown = run.impacts.filter(({ peak_time_s: time }) => time >= min && time <= max);
    plot.ctx.save();
    for (const { name, look } of chart.lines) {
      const contact = Number(name.match(/\d+/)[0]);
      const own = shown.filter((impact) => impact.contact === contact);
      drawStems(
        plot,
        own.map(({ peak_time_s: time, peak_force: force }) => [time, force * unit.factor]),
        look().stroke,
        shown.length < MOST_DOTS,
      );
    }
    plot.ctx.restore();
  }

  #resize() {
    for (const { plot } of this.plots) plot.setSize({ width: widthOf(element("chart-list")), height: HEIGHT });
    this.#moment();
  }

  #buttons() {
    const { state } = this;
    const scale = (factor) => {
      const [from, to] = state.stretch;
      const middle = state.time > from && state.time < to ? state.time : (from + to) / 2;
      state.show(middle - factor * (middle - from), middle + factor * (to - middle));
    };
    const move = (share) => {
      const [from, to] = state.stretch;
      state.show(from + share * (to - from), to + share * (to - from));
    };
    const buttons = {
      earlier: () => move(-0.5),
      later: () => move(0.5),
      nearer: () => scale(0.5),
      farther: () => scale(2),
      whole: () => state.show(0, state.run?.stop ?? 1),
    };
    for (const [id, act] of Object.entries(buttons)) element(id).addEventListener("click", act);
  }

  #listFloors(look) {
    this.floors = new Set(usualFloors(look, this.buildings));
    const list = element("floor-choice");
    list.replaceChildren();
    for (const { name, floors } of look.buildings.filter(({ name }) => this.buildings.includes(name))) {
      const every = Math.ceil(floors / CHOICE) || 1;
      for (let floor = floors; floor > 0; floor -= every) this.#floorBox(list, `${name} ${floor}`);
    }
  }

  #floorBox(list, name) {
    const label = make(list, "label", "", { class: "check" });
    const box = make(label, "input", "", { type: "checkbox" });
    label.append(` ${name}`);
    box.checked = this.floors.has(name);
    box.addEventListener("change", () => {
      if (box.checked) this.floors.add(name);
      else this.floors.delete(name);
      this.draw();
    });
  }
}

function drawStems(plot, points, stroke, withDots) {
  const { ctx: context } = plot;
  const ratio = devicePixelRatio || 1;
  const zero = plot.valToPos(0, "y", true);
  context.strokeStyle = context.fillStyle = stroke;
  context.lineWidth = ratio;
  context.beginPath();
  const places = points.map(([time, force]) => [plot.valToPos(time, "x", true), plot.valToPos(force, "y", true)]);
  for (const [x, y] of places) {
    context.moveTo(x, zero);
    context.lineTo(x, y);
  }
  context.stroke();
  if (!withDots) return;
  context.beginPath();
  for (const [x, y] of places) {
    context.moveTo(x, y);
    context.arc(x, y, 2.2 * ratio, 0, 2 * Math.PI);
  }
  context.fill();
}

const largestForce = (run) => run.impacts.reduce((most, impact) => Math.max(most, impact.peak_force || 0), 0);

// Values where lines come in and go out: between two rows, of which one is out of sight.
function atEdges(plot, stretch) {
  const [times, ...columns] = plot.data;
  return stretch.flatMap((time) => {
    if (!(time > times[0] && time < times.at(-1))) return [];
    const row = rowBefore(times, time);
    const share = (time - times[row]) / (times[row + 1] - times[row] || 1);
    return columns.map((column) => column[row] + share * (column[row + 1] - column[row]));
  });
}

// From the lowest to the highest of what has to be in sight, with a little room; nothing is at null.
function rangeWith(seen) {
  const known = seen.filter((value) => value !== null);
  const [from, to] = [Math.min(...known), Math.max(...known)];
  const room = 0.06 * (to - from || Math.abs(to) || 1);
  return [from === 0 ? 0 : from - room, to === 0 ? 0 : to + room];
}

// Where a gap is closed.
function drawZero(plot) {
  const { ctx: context, bbox } = plot;
  const y = plot.valToPos(0, "y", true);
  if (!Number.isFinite(y)) return;
  context.save();
  context.strokeStyle = colour("quiet");
  context.lineWidth = devicePixelRatio || 1;
  context.beginPath();
  context.moveTo(bbox.left, y);
  context.lineTo(bbox.left + bbox.width, y);
  context.stroke();
  context.restore();
}
