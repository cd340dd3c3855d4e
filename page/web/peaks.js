// The largest values of a run, as long as the scene keeps them: of each floor and storey, the top first, of each
// foundation and of each link, with the times at which they were reached; a time goes there.

import { GRAVITY, digits, handyUnit, largestOf, plural, seconds, withUnit } from "./format.js";
import { element, make } from "./make.js";
import { SIDES } from "./motion.js";

const QUANTITIES = [
  { part: "peak_drift", title: "drift", unit: "m" },
  { part: "peak_displacement", title: "displacement", unit: "m" },
  { part: "peak_acceleration", title: "acceleration", unit: "m/s2", inG: true },
  { part: "peak_drift_ratio", title: "drift / height", unit: "1", percent: true },
];

const OF_LINKS = [
  { part: "peak_force", title: "force", unit: "N" },
  { part: "peak_displacement", title: "displacement", unit: "m" },
];

const OF_FOUNDATIONS = [
  { part: "peak_displacement", title: "displacement", unit: "m" },
  { part: "peak_rotation", title: "rotation", unit: "rad" },
  { part: "peak_force", title: "force on the soil", unit: "N" },
  { part: "peak_moment", title: "moment on the soil", unit: "N.m" },
];

export class Peaks {
  constructor(state) {
    this.state = state;
    state.on("run", () => this.draw());
  }

  draw() {
    const { run } = this.state;
    const panel = element("panel-peaks");
    panel.replaceChildren();
    const sides = SIDES.filter((side) => run.columns[`${side}.peak_drift[1]`]);
    if (sides.length === 0)
      make(panel, "p", "The scene says outputs.peaks = false: no peaks are kept.", { class: "hint" });
    else
      make(
        panel,
        "p",
        "Of either sign, in continuous time, and when it was reached. Displacements are relative to the ground.",
        { class: "hint" },
      );
    for (const side of sides) this.#building(panel, side);
    this.#foundations(panel);
    this.#links(panel);
    this.#yielding(panel);
  }

  #building(panel, side) {
    const { run } = this.state;
    const present = QUANTITIES.filter(({ part }) => run.columns[`${side}.${part}[1]`]);
    const floors = run.look.left && side === "left" ? run.look.left.floors : run.look.right.floors;
    const table = make(panel, "table", "", { class: "numbers" });
    make(table, "caption", `${side}, ${plural(floors, "storey", "storeys")}`, { class: `of-${side}` });
    const head = make(make(table, "thead"), "tr");
    make(head, "th", "floor", { scope: "col" });
    const looks = present.map((quantity) =>
      this.#unitOf((floor) => `${side}.${quantity.part}[${floor}]`, floors, quantity),
    );
    present.forEach(({ title }, at) => make(head, "th", withUnit(title, looks[at]), { scope: "col" }));
    const body = make(table, "tbody");
    for (let floor = floors; floor > 0; floor--) {
      const row = make(body, "tr");
      make(row, "th", String(floor), { scope: "row" });
      present.forEach(({ part }, at) => this.#cell(row, run.columns[`${side}.${part}[${floor}]`], looks[at]));
    }
    const shear = run.columns[`${side}.peak_base_shear`];
    if (shear) this.#shear(panel, shear);
  }

  // A row for each foundation; a way in which none moves has no column.
  #foundations(panel) {
    const { columns, look } = this.state.run;
    const sides = SIDES.filter((side) => look.layout[side].foundation);
    if (sides.length === 0) return;
    const name = (part, side) => `${side}.foundation.${part}`;
    const known = OF_FOUNDATIONS.filter(({ part }) => sides.some((side) => columns[name(part, side)]));
    const looks = known.map((of) => this.#unitOf((at) => name(of.part, sides[at - 1]), sides.length, of));
    const table = make(panel, "table", "", { class: "numbers" });
    make(table, "caption", "Foundations");
    const head = make(make(table, "thead"), "tr");
    for (const title of ["building", "first period / on a fixed base"]) make(head, "th", title, { scope: "col" });
    known.forEach(({ title }, at) => make(head, "th", withUnit(title, looks[at]), { scope: "col" }));
    const body = make(table, "tbody");
    for (const side of sides) {
      const row = make(body, "tr");
      make(row, "th", side, { scope: "row" });
      make(row, "td", digits(look.layout[side].foundation.period_ratio));
      known.forEach(({ part }, at) => {
        const column = columns[name(part, side)];
        if (column) this.#cell(row, column, looks[at]);
        else make(row, "td");
      });
    }
  }

  // A row for each link that keeps its peaks.
  #links(panel) {
    const { columns, look } = this.state.run;
    const { links } = look.layout;
    if (!columns["link[1].peak_force"]) return;
    const table = make(panel, "table", "", { class: "numbers" });
    make(table, "caption", "Links");
    const head = make(make(table, "thead"), "tr");
    for (const title of ["link", "what it joins"]) make(head, "th", title, { scope: "col" });
    const name = (part, link) => `link[${link}].${part}`;
    const looks = OF_LINKS.map((quantity) => this.#unitOf((link) => name(quantity.part, link), links.length, quantity));
    OF_LINKS.forEach(({ title }, at) => make(head, "th", withUnit(title, looks[at]), { scope: "col" }));
    const body = make(table, "tbody");
    links.forEach(({ meeting }, at) => {
      const row = make(body, "tr");
      make(row, "th", String(at + 1), { scope: "row" });
      make(row, "td", meeting.replace("between ", ""));
      OF_LINKS.forEach(({ part }, place) => this.#cell(row, columns[name(part, at + 1)], looks[place]));
    });
  }

  // What shows the largest of so many columns in handy numbers.
  #unitOf(nameOf, count, { unit, inG, percent }) {
    if (inG) return { name: "g", factor: 1 / GRAVITY };
    if (percent) return { name: "%", factor: 100 };
    let most = 0;
    for (let number = 1; number <= count; number++)
      most = Math.max(most, largestOf(this.state.run.columns[nameOf(number)]?.subarray(-1)));
    return handyUnit(most, unit);
  }

  #cell(row, column, { factor }) {
    const cell = make(row, "td");
    make(cell, "span", digits(column.at(-1) * factor));
    this.#time(cell, column);
  }

  #time(cell, column) {
    const time = this.state.run.time[firstAtEnd(column)];
    cell.append(" ");
    make(cell, "button", `${seconds(time, 2)} s`, {
      class: "goes",
      "aria-label": `go to ${seconds(time, 2)} s`,
    }).addEventListener("click", () => this.state.seek(time));
  }

  #shear(panel, column) {
    const line = make(panel, "p", "base shear ", { class: "line" });
    const { name, factor } = handyUnit(column.at(-1), "N");
    make(line, "span", `${digits(column.at(-1) * factor)} ${name} `);
    this.#time(line, column);
  }

  // Storeys that can yield, at the end of the run.
  #yielding(panel) {
    const { run } = this.state;
    const storeys = SIDES.flatMap((side) =>
      (run.look[side]?.yields ?? []).map((yields, at) => yields && [side, at + 1]),
    ).filter(Boolean);
    if (storeys.length === 0) return;
    const table = make(panel, "table", "", { class: "numbers" });
    make(table, "caption", "Storeys that can yield, at the end");
    const head = make(make(table, "thead"), "tr");
    for (const title of ["storey", "ductility", "residual drift [mm]", "dissipated"])
      make(head, "th", title, { scope: "col" });
    const body = make(table, "tbody");
    for (const [side, storey] of storeys.reverse()) {
      const last = (part) => run.columns[`${side}.${part}[${storey}]`]?.at(-1);
      const row = make(body, "tr");
      make(row, "th", `${side} ${storey}`, { scope: "row" });
      const energy = handyUnit(last("hysteretic_energy") ?? 0, "J");
      const cells = [
        digits(last("ductility"), 3),
        digits(1e3 * last("residual_drift"), 3),
        `${digits(last("hysteretic_energy") * energy.factor, 3)} ${energy.name}`,
      ];
      cells.forEach((text) => make(row, "td", text));
    }
  }
}

// Peaks only grow: the first row that has the last value.
function firstAtEnd(column) {
  const last = column.at(-1);
  let [low, high] = [0, column.length - 1];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (column[middle] >= last) high = middle;
    else low = middle + 1;
  }
  return low;
}
