// The buildings in motion: the picture of the moment, alone or beside that without contact, and in words how it is
// drawn.

import { Drawing, layOut } from "./drawing.js";
import { GRAVITY, digits, largestOf, seconds } from "./format.js";
import { Geometry } from "./geometry.js";
import { element, onceAFrame } from "./make.js";
import { Motion } from "./motion.js";
import { chartedOf } from "./pair.js";
import { colours } from "./palette.js";
import { endOf, mostOf, strengthOf } from "./strength.js";

// s on the clock of the reader that an impact is seen.
const AFTERGLOW = 0.35;
// While a run follows another, motion keeps its scale as long as it fills this much of the room.
const ENOUGH = 0.45;

export class Stage {
  constructor(state, player) {
    Object.assign(this, { state, player, canvas: element("buildings"), reach: 0, shown: null, other: null });
    this.draw = onceAFrame(() => this.drawNow());
    state.on(["time", "colours", "alone-shown"], this.draw);
    state.on(["run", "alone"], () => this.take());
    element("size").addEventListener("input", this.draw);
    new ResizeObserver(this.draw).observe(element("view"));
  }

  take() {
    const { run, alone } = this.state;
    this.shown = run && { motion: new Motion(run), geometry: new Geometry(run.look), impacts: run.impacts };
    this.other = alone && { motion: new Motion(alone), geometry: new Geometry(run.look), impacts: null };
    const reach = Math.max(reachOf(run), element("alone").checked ? reachOf(alone) : 0);
    if (this.named !== run?.look.name || reach > this.reach || reach < ENOUGH * this.reach) this.reach = reach;
    this.named = run?.look.name;
    this.strongest = mostOf(run?.impacts ?? []);
    this.groundPeak = largestOf(run?.columns["ground.acceleration"]);
    this.draw();
  }

  // Sharp on any screen; returns the size in pixels of the style sheet.
  fit() {
    const { canvas } = this;
    const { width, height } = canvas.parentElement.getBoundingClientRect();
    const ratio = devicePixelRatio || 1;
    const [wide, high] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (canvas.width !== wide || canvas.height !== high) Object.assign(canvas, { width: wide, height: high });
    canvas.style.width = `${width}px`;
    canvas.style.height = `${height}px`;
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    return { context, width, height };
  }

  drawNow() {
    const { context, width, height } = this.fit();
    if (!this.shown || width < 50) return;
    const both = element("alone").checked && this.other;
    const half = both ? width / 2 : width;
    const box = { x: 0, y: 0, width: half, height };
    this.#picture(context, this.shown, box, both ? "with contact" : "");
    if (both) {
      this.#picture(context, this.other, { ...box, x: half }, "without contact");
      context.fillStyle = colours().line;
      context.fillRect(half, 8, 1, height - 16);
    }
    this.#say(layOut(this.shown.geometry, box, this.reach, this.#size()));
  }

  #size() {
    return Number(element("size").value);
  }

  #picture(context, { motion, geometry, impacts }, box, caption) {
    const { time } = this.state;
    const place = layOut(geometry, box, this.reach, this.#size());
    const share = this.groundPeak > 0 ? motion.value("ground.acceleration", time) / this.groundPeak : 0;
    new Drawing(context, geometry, place, colours()).draw({
      moved: motion.at(time),
      yielding: this.#yielding(motion, geometry),
      slipping: geometry.links.map((_, at) => Math.abs(motion.value(`link[${at + 1}].slipping`, time)) > 0.5),
      flashes: this.#flashes(impacts),
      ground: this.groundPeak > 0 ? { share } : null,
      caption,
      numbered: impacts !== null,
    });
  }

  #yielding(motion, geometry) {
    const yields = (name, storey) => Math.abs(motion.value(`${name}.yielding[${storey}]`, this.state.time)) > 0.5;
    return geometry.buildings.map(({ name, levels }) => levels.map((_, storey) => yields(name, storey)));
  }

  // Impacts are seen a little longer than they last.
  #flashes(impacts) {
    const { time, run } = this.state;
    const glow = AFTERGLOW * this.player.speed;
    const recent = (impacts ?? []).filter(
      (impact) => impact.start_s <= time && time <= Math.max(endOf(impact, run), impact.start_s + glow),
    );
    return recent.map((impact) => {
      const past = Math.max(0, time - endOf(impact, run));
      const size = this.strongest > 0 ? Math.sqrt(strengthOf(impact) / this.strongest) : 0;
      return { contact: impact.contact, size, age: Math.min(1, past / glow) };
    });
  }

  // How much larger motion is drawn than heights, and how long a bar of the picture is.
  #say({ across, up }) {
    const bar = niceBelow(90 / across);
    const scale = element("scale");
    scale.style.setProperty("--bar", `${bar * across}px`);
    const factor = across / up;
    const drawn = !this.shown.geometry.hasLevels
      ? "storeys drawn equally high: the scene has no heights"
      : `motion and gaps drawn ${digits(factor, 2)} times as large as heights`;
    const yields = this.state.run.look.buildings.some(({ yields }) => yields.some(Boolean))
      ? "; dashed: yields at this moment"
      : "";
    const slips = this.shown.geometry.links.some(({ parts }) => parts.includes("friction"))
      ? "; a filled block: the link slips at this moment"
      : "";
    const text = `${bar < 1 ? `${digits(1e3 * bar)} mm` : `${digits(bar)} m`}; ${drawn}${yields}${slips}`;
    if (scale.textContent !== text) scale.textContent = text;
    element("size").setAttribute("aria-valuetext", drawn);
    this.canvas.setAttribute("aria-label", this.#inWords());
  }

  #inWords() {
    const { run, time } = this.state;
    const moved = this.shown.motion.at(time);
    const { names } = this.shown.geometry;
    const roofs = chartedOf(this.state, run.look).map(
      (name) => `${name} roof ${digits(1e3 * moved.floors[names.indexOf(name)].at(-1), 3)} mm`,
    );
    const touching = this.#flashes(run.impacts).length > 0 ? "; they hit each other" : "";
    const ground =
      this.groundPeak > 0
        ? `, ground ${digits(this.shown.motion.value("ground.acceleration", time) / GRAVITY, 2)} g`
        : "";
    return `The buildings at ${seconds(time)} s: ${roofs.join(", ")}${ground}${touching}`;
  }
}

// m, the farthest that a floor goes.
function reachOf(run) {
  if (!run) return 0;
  const names = Object.keys(run.columns).filter((name) => /^\w+\.displacement\[/.test(name));
  return names.reduce((most, name) => Math.max(most, largestOf(run.columns[name])), 0);
}

// 1, 2 or 5 times a power of ten.
function niceBelow(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [5, 2, 1].find((digit) => digit * power <= value) * power;
}
