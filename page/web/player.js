// The clock of the picture: play, pause, any speed, the bar of time with a mark for each impact.

import { digits, seconds } from "./format.js";
import { element, make, onceAFrame } from "./make.js";
import { colours } from "./palette.js";
import { mostOf, strengthOf } from "./strength.js";

const SPEEDS = [0.05, 0.1, 0.2, 0.5, 1, 2, 4];
const PLAY = "M3 1.5 14 8 3 14.5z";
const PAUSE = "M3 2h4v12H3zM9 2h4v12H9z";
// Keys do not play where they write, choose or press.
const OWN_SPACE = "input:not([type=range]), textarea, select, button, summary, [contenteditable], [role=tab]";
const WRITES = "input:not([type=range]):not([type=checkbox]), textarea, select";

export class Player {
  playing = false;
  speed = 0.5;

  constructor(state) {
    this.state = state;
    this.drawMarks = onceAFrame(() => this.#marks());
    for (const speed of SPEEDS) make(element("speed"), "option", `${speed}\u00D7`, { value: speed });
    element("speed").value = this.speed;
    element("speed").addEventListener("change", () => (this.speed = Number(element("speed").value)));
    element("play").addEventListener("click", () => this.toggle());
    element("before").addEventListener("click", () => this.leap(-1));
    element("after").addEventListener("click", () => this.leap(1));
    element("time").addEventListener("input", () => this.#scrubbed());
    document.addEventListener("keydown", (event) => this.#key(event));
    state.on("time", () => this.#shown());
    state.on("run", () => this.#newRun());
    state.on("chosen", () => this.pause());
    state.on("colours", this.drawMarks);
    new ResizeObserver(this.drawMarks).observe(element("marks").parentElement);
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  play() {
    const { state } = this;
    if (!state.run) return;
    if (state.time >= state.run.stop) state.seek(0);
    this.playing = true;
    this.last = performance.now();
    this.#button();
    requestAnimationFrame((now) => this.#tick(now));
  }

  pause() {
    this.playing = false;
    this.#button();
  }

  // To the next impact after the moment, or the one before.
  leap(by) {
    const { run, time } = this.state;
    const times = (run?.impacts ?? []).map((impact) => impact.peak_time_s || impact.start_s);
    const other = times.filter((at) => (by > 0 ? at > time + 1e-9 : at < time - 1e-9));
    if (other.length === 0) return;
    this.pause();
    this.state.seek(other.reduce((nearest, at) => (by > 0 ? Math.min(nearest, at) : Math.max(nearest, at))));
  }

  #tick(now) {
    if (!this.playing) return;
    const { state } = this;
    const passed = Math.min(0.1, (now - this.last) / 1e3);
    this.last = now;
    state.seek(state.time + passed * this.speed);
    this.#follow();
    if (state.time >= state.run.stop) return this.pause();
    requestAnimationFrame((next) => this.#tick(next));
  }

  // Charts that show a part of the run go along.
  #follow() {
    const { state } = this;
    const [from, to] = state.stretch;
    if (state.time > to && to < state.run.stop) state.show(state.time, state.time + to - from);
  }

  #button() {
    element("play")
      .querySelector("path")
      .setAttribute("d", this.playing ? PAUSE : PLAY);
    element("play").setAttribute("aria-label", this.playing ? "Pause" : "Play");
  }

  #scrubbed() {
    this.pause();
    this.state.seek(Number(element("time").value));
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { target } = event;
    if (event.key === " " && !target.closest(OWN_SPACE)) this.toggle();
    else if (event.key === "n" && !target.closest(WRITES)) this.leap(1);
    else if (event.key === "p" && !target.closest(WRITES)) this.leap(-1);
    else return;
    event.preventDefault();
  }

  #shown() {
    const { time } = this.state;
    const bar = element("time");
    bar.value = time;
    bar.setAttribute("aria-valuetext", `${seconds(time, 2)} seconds`);
    element("now").textContent = `${seconds(time)} s`;
  }

  #newRun() {
    const { run, time } = this.state;
    element("time").max = run.stop;
    element("time").step = run.stop / 1000;
    this.state.seek(Math.min(time, run.stop));
    this.drawMarks();
  }

  // A line for each impact, as high as its force; all in one path.
  #marks() {
    const canvas = element("marks");
    const { width, height } = canvas.parentElement.getBoundingClientRect();
    const ratio = devicePixelRatio || 1;
    Object.assign(canvas, { width: Math.round(width * ratio), height: Math.round(height * ratio) });
    const { run } = this.state;
    if (!run) return;
    const context = canvas.getContext("2d");
    context.scale(ratio, ratio);
    const most = mostOf(run.impacts) || 1;
    context.strokeStyle = colours().quiet;
    context.beginPath();
    // The ends of the bar are half a handle away from its edges.
    const x = (time) => 8 + (time / run.stop) * (width - 16);
    for (const impact of run.impacts) {
      const at = x(impact.start_s);
      context.moveTo(at, height / 2 - 4);
      context.lineTo(at, height / 2 - 4 - (3 + (height / 2 - 8) * Math.sqrt(strengthOf(impact) / most)));
    }
    context.stroke();
    canvas.title = `${digits(run.impacts.length)} impacts`;
  }
}
