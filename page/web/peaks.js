// The largest values of a run, as long as the scene keeps them: of a row each building, of two buildings each floor and
// storey, the top first, of each foundation and of each link, with the times at which they were reached; a time goes there.

import { GRAVITY, digits, handyUnit, largestOf, plural, seconds, withUnit } from "./format.js";
import { element, make } from "./make.js";
import { kindOf, namesOf } from "./motion.js";
import { chartedOf } from "./pair.js";

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
    state.on(["run", "buildings"], () => this.draw());
  }

  draw() {
    const { run } = this.state;
    const panel = element("panel-peaks");
    panel.replaceChildren();
    const known = run.look.buildings.filter(({ name }) => run.columns[`${name}.peak_drift[1]`]);
    if (known.length === 0) make(panel, "p", this.#none(), { class: "hint" });
    else
      make(
        panel,
        "p",
        "Of either sign, in continuous time, and when it was reached. Displacements are relative to the ground.",
        { class: "hint" },
      );
    if (known.length > 2) this.#row(panel, known);
    const charted = chartedOf(this.state, run.look);
    for (const building of known.filter(({ name }) => charted.includes(name))) this.#building(panel, building);
    this.#foundations(panel);
    this.#links(panel);
    this.#yielding(panel);
  }

  #none() {
    if (this.state.look?.peaks) return "There are too many floors and contacts for the page to keep peaks; pounding-fmu has them.";
    return "The scene says outputs.peaks = false: no peaks are kept.";
  }

  // The largest of each building, from left to right.
  #row(panel, buildings) {
    const { columns, look } = this.state.run;
    const present = QUANTITIES.filter(({ part }) => buildings.some(({ name }) => columns[`${name}.${part}[1]`]));
    const most = ({ name, floors }, part) => {
      const own = Array.from({ length: floors }, (_, at) => columns[`${name}.${part}[${at + 1}]`]).filter(Boolean);
      return own.reduce((largest, column) => (largest?.at(-1) >= column.at(-1) ? largest : column), null);
    };
    const table = make(panel, "table", "", { class: "numbers" });
    make(table, "caption", "The row");
    const head = make(make(table, "thead"), "tr");
    make(head, "th", "building", { scope: "col" });
    const rows = buildings.map((building) => present.map(({ part }) => most(building, part)));
    const looks = present.map((quantity, at) => unitOf(rows.map((row) => row[at]), quantity));
    present.forEach(({ title }, at) => make(head, "th", withUnit(title, looks[at]), { scope: "col" }));
    const body = make(table, "tbody");
    buildings.forEach(({ name }, place) => {
      const row = make(body, "tr");
      make(row, "th", name, { scope: "row", class: classOf(look, name) });
      rows[place].forEach((column, at) => (column ? this.#cell(row, column, looks[at]) : make(row, "td")));
    });
  }

  #building(panel, { name: side, floors }) {
    const { run } = this.state;
    const present = QUANTITIES.filter(({ part }) => run.columns[`${side}.${part}[1]`]);
    const table = make(panel, "table", "", { class: "numbers" });
    make(table, "caption", `${side}, ${plural(floors, "storey", "storeys")}`, { class: classOf(run.look, side) });
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
    const standing = look.layout.buildings.filter(({ foundation }) => foundation);
    const sides = standing.map(({ name }) => name);
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
    for (const { name: side, foundation } of standing) {
      const row = make(body, "tr");
      make(row, "th", side, { scope: "row" });
      make(row, "td", digits(foundation.period_ratio));
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
  #unitOf(nameOf, count, quantity) {
    return unitOf(Array.from({ length: count }, (_, at) => this.state.run.columns[nameOf(at + 1)]), quantity);
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
    const storeys = run.look.buildings.flatMap(({ name, yields }) =>
      yields.map((can, at) => can && [name, at + 1]).filter(Boolean),
    );
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

const classOf = ({ layout }, name) => {
  const kind = kindOf(namesOf({ layout }), name);
  return kind.startsWith("row") ? `of-row of-${kind}` : `of-${kind}`;
};

function unitOf(columns, { unit, inG, percent }) {
  if (inG) return { name: "g", factor: 1 / GRAVITY };
  if (percent) return { name: "%", factor: 100 };
  return handyUnit(Math.max(0, ...columns.map((column) => largestOf(column?.subarray(-1)))), unit);
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
