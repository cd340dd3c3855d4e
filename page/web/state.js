// What the page knows: the text of the scene, the records that it may name, and what the engine has said about them.
// Everything else is worked out from these; what changes is told to those who listen.

import { endOf } from "./strength.js";

export class State {
  #listeners = new Map();

  // The text is the scene: handles write it, the engine reads it.
  scene = "";
  // Content of each record by the path that a scene writes for it; bytes or text.
  records = Object.create(null);
  // What the engine says of the last scene that was right, and of the text as it is now.
  look = null;
  checked = "";
  problems = [];
  warnings = [];
  // The last run that went well, with the look of its scene; the same run without contacts; each null before.
  run = null;
  alone = null;
  // s, what the picture shows; the stretch that the charts show; the impact that was chosen.
  time = 0;
  stretch = [0, 1];
  chosen = null;
  // Names of those whose floors and storeys the charts of a row show; without any those of the hardest impact.
  chosenBuildings = [];

  on(events, act) {
    for (const event of [events].flat()) this.#listeners.set(event, [...(this.#listeners.get(event) ?? []), act]);
  }

  tell(event, ...values) {
    for (const act of this.#listeners.get(event) ?? []) act(...values);
  }

  seek(time) {
    this.time = Math.min(Math.max(0, time), this.run?.stop ?? 0);
    this.tell("time");
  }

  show(from, to) {
    const stop = this.run?.stop ?? 1;
    const width = Math.min(stop, Math.max(to - from, 1e-5));
    const start = Math.min(Math.max(0, from), stop - width);
    this.stretch = [start, start + width];
    this.tell("stretch");
  }

  // Goes to an impact: the moment of its largest force, and the charts to just around it.
  choose(impact) {
    const end = endOf(impact, this.run);
    const around = Math.max(1.5 * (end - impact.start_s), 2e-3);
    this.chosen = impact;
    this.seek(impact.peak_time_s || impact.start_s);
    this.show(impact.start_s - around, end + around);
    this.tell("chosen");
  }
}
