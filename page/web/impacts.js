// The table of impacts: a heading sorts, a row goes to its time. Of many the first are there at once, the others
// follow while nothing else is to do.

import { digits, handyUnit, seconds, withUnit } from "./format.js";
import { element, make } from "./make.js";
import { namesOf } from "./motion.js";

const COLUMNS = [
  { key: "contact", title: "contact" },
  { key: "between", title: "between" },
  { key: "start_s", title: "start", unit: "s", time: true },
  { key: "peak_force", title: "peak force", unit: "N" },
  { key: "approach_velocity", title: "approach", unit: "m/s" },
  { key: "peak_penetration", title: "penetration", unit: "m" },
  { key: "impulse", title: "impulse", unit: "N.s" },
  { key: "dissipated_energy", title: "dissipated", unit: "J" },
  { key: "separation_velocity", title: "separation", unit: "m/s" },
  { key: "peak_time_s", title: "time of peak", unit: "s", time: true },
  { key: "end_s", title: "end", unit: "s", time: true },
];
const AT_ONCE = 60;
const BATCH = 300;
const MOST_ROWS = 3000;
// A busy machine may leave no idle time at all.
const LATEST = { timeout: 200 };
const idle = (act) => globalThis.requestIdleCallback?.(act, LATEST) ?? setTimeout(act, 30);

export class Impacts {
  constructor(state) {
    Object.assign(this, { state, table: element("impacts"), by: "start_s", down: false, drawn: 0 });
    this.body = this.table.querySelector("tbody");
    state.on("run", () => this.draw());
    state.on("chosen", () => this.#mark());
    this.body.addEventListener("click", (event) => this.#choose(event.target.closest("tr")));
    this.body.addEventListener("keydown", (event) => this.#key(event));
  }

  draw() {
    const { run } = this.state;
    // Of two buildings everybody knows between whom.
    const [isRow, { contacts }] = [namesOf(run.look).length > 2, run.look.layout];
    this.columns = COLUMNS.filter(({ key }) => isRow || key !== "between");
    this.between = contacts.map(({ left, right }) => [left, right].map(({ side }) => side ?? "wall").join(", "));
    this.units = Object.fromEntries(
      COLUMNS.map(({ key, unit }) => [key, handyUnit(largestBy(run.impacts, key), unit)]),
    );
    const sorted = this.#sorted();
    this.rows = sorted.slice(0, MOST_ROWS);
    this.#head();
    this.body.replaceChildren();
    this.table.setAttribute("aria-rowcount", this.rows.length + 1);
    this.#say(sorted.length);
    this.table.hidden = this.rows.length === 0;
    this.#append(AT_ONCE);
    const generation = (this.generation = {});
    const more = () => {
      if (generation !== this.generation || this.body.childElementCount >= this.rows.length) return;
      this.#append(BATCH);
      idle(more);
    };
    idle(more);
  }

  #say(count) {
    const line = element("no-impacts");
    line.hidden = count > 0 && count <= MOST_ROWS;
    const none = this.state.run.look.contacts.length
      ? "The buildings do not touch in this run."
      : "The scene has no contacts.";
    line.textContent =
      count > 0 ? `The first ${MOST_ROWS} of ${count} in this order; another heading brings others.` : none;
  }

  #head() {
    const head = this.table.querySelector("thead");
    const focused = head.contains(document.activeElement) ? document.activeElement.dataset.key : null;
    head.replaceChildren();
    const row = make(head, "tr");
    for (const { key, title } of this.columns) {
      const cell = make(row, "th", "", { scope: "col" });
      const arrow = key === this.by ? (this.down ? " \u25BE" : " \u25B4") : "";
      if (arrow) cell.setAttribute("aria-sort", this.down ? "descending" : "ascending");
      const button = make(cell, "button", `${withUnit(title, this.units[key])}${arrow}`, { "data-key": key });
      button.addEventListener("click", () => this.#sortBy(key));
      if (key === focused) button.focus();
    }
  }

  // The largest first, but times as they pass.
  #sortBy(key) {
    const passing = key === "contact" || key === "between" || COLUMNS.find((column) => column.key === key).time;
    this.down = key === this.by ? !this.down : !passing;
    this.by = key;
    this.draw();
  }

  #sorted() {
    // Contacts go gap by gap.
    const by = this.by === "between" ? "contact" : this.by;
    const value = (impact) => (Number.isFinite(impact[by]) ? impact[by] : Infinity);
    const sign = this.down ? -1 : 1;
    return [...this.state.run.impacts].sort((a, b) => sign * (value(a) - value(b)) || a.start_s - b.start_s);
  }

  #append(count) {
    const from = this.body.childElementCount;
    const rows = document.createDocumentFragment();
    this.rows.slice(from, from + count).forEach((impact, at) => {
      const row = make(rows, "tr", "", {
        tabindex: from + at === 0 ? 0 : -1,
        "data-row": from + at,
        "aria-rowindex": from + at + 2,
      });
      for (const { key, time } of this.columns) make(row, "td", this.#cell(impact, key, time));
      if (impact === this.state.chosen) row.className = "chosen";
    });
    this.body.append(rows);
  }

  #cell(impact, key, time) {
    if (key === "between") return this.between[impact.contact - 1] ?? "";
    if (key === "contact") return String(impact.contact);
    if (key === "end_s" && !Number.isFinite(impact.end_s)) return "open";
    return time ? seconds(impact[key], 4) : digits(impact[key] * this.units[key].factor);
  }

  #choose(row) {
    if (row) this.state.choose(this.rows[row.dataset.row]);
  }

  #mark() {
    this.body.querySelector(".chosen")?.classList.remove("chosen");
    const at = this.rows.indexOf(this.state.chosen);
    if (at >= 0) this.body.children[at]?.classList.add("chosen");
  }

  #key(event) {
    const row = event.target.closest("tr");
    if (event.key === "Enter" || event.key === " ") this.#choose(row);
    else if (event.key === "ArrowDown") focusRow(row, row.nextElementSibling);
    else if (event.key === "ArrowUp") focusRow(row, row.previousElementSibling);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }
}

// One row is in the order of the tabulator key; arrows go on from there.
function focusRow(row, other) {
  if (!other) return;
  row.tabIndex = -1;
  other.tabIndex = 0;
  other.focus();
}

const largestBy = (impacts, key) => impacts.reduce((most, impact) => Math.max(most, Math.abs(impact[key]) || 0), 0);
