"use strict";
// Reads the data of the run and draws the page. Texts of the scene are only ever set as textContent.

const run = JSON.parse(document.getElementById("data").textContent);
const element = (id) => document.getElementById(id);

function make(parent, tag, text = "", attributes = {}) {
  const made = document.createElement(tag);
  made.textContent = text;
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  parent.append(made);
  return made;
}

// Five digits, as a person writes them.
function digits(value) {
  if (value === null || value === undefined || Number.isNaN(value)) return "";
  if (value === 0 || Number.isInteger(value)) return String(value);
  const size = Math.abs(value);
  return size < 1e-3 || size >= 1e6 ? value.toExponential(3) : String(Number(value.toPrecision(5)));
}

// ---- Columns: what quantity they are, the unit they are shown in, their line.

// Okabe and Ito's colours; the left building blue, the right one orange, as in the other pictures.
const HUES = { left: [201, 100], right: [26, 100] };
const CYCLE = ["#000000", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#0072B2", "#D55E00"];
const DASHES = [[], [8, 4], [2, 3], [8, 3, 2, 3]];
const USUAL = ["displacement", "force", "acceleration"];

for (const column of run.columns) {
  const [, whole, index, part, storey] = column.name.match(/^(\w+)(?:\[(\d+)\])?(?:\.(\w+)(?:\[(\d+)\])?)?$/);
  column.of = whole;
  column.index = Number(storey || index || 0);
  column.quantity = whole === "ground" ? "ground acceleration" : whole === "energy" ? "energy" : part || whole;
  if (column.name === "energy.residual") column.quantity = "energy residual";
  if (whole === "contact") column.quantity = { force: "contact force" }[part] || part.replaceAll("_", " ");
  else if (part && whole !== "ground" && whole !== "energy") column.quantity = part.replaceAll("_", " ");
  column.rows = column.steps && rowsOf(column.steps);
  column.largest = column.values.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
}
const groups = Map.groupBy ? Map.groupBy(run.columns, (c) => c.quantity) : groupBy(run.columns);

function groupBy(columns) {
  const groups = new Map();
  for (const column of columns) groups.set(column.quantity, [...(groups.get(column.quantity) || []), column]);
  return groups;
}

function rowsOf(steps) {
  let row = 0;
  return steps.map((step) => (row += step));
}

// Of a column's two units the one with the handier numbers.
function unitOf(columns) {
  const { unit, display } = columns[0];
  const largest = Math.max(...columns.map((column) => column.largest));
  if (!display || largest === 0) return [unit || "", 1];
  const awkward = (factor) => Math.abs(Math.log10(largest * factor) - 1.5);
  return awkward(display[1]) < awkward(1) ? display : [unit, 1];
}

function lineOf(column, columns) {
  const same = columns.filter((other) => other.of === column.of);
  const place = same.indexOf(column);
  if (!(column.of in HUES)) {
    const at = columns.indexOf(column);
    return { stroke: CYCLE[at % CYCLE.length], dash: DASHES[Math.floor(at / CYCLE.length) % DASHES.length] };
  }
  // The top floor is the darkest.
  const [hue, saturation] = HUES[column.of];
  const lightness = same.length === 1 ? 38 : 68 - (36 * place) / (same.length - 1);
  const dash = column.of === "right" ? DASHES[1] : DASHES[0];
  return { stroke: `hsl(${hue} ${saturation}% ${lightness}%)`, dash };
}

// ---- Charts: one for each quantity of which variables are chosen, all over the same stretch of time.

const chosen = new Set();
const charts = new Map();
let stretch = [0, run.stop];

function aligned(columns, factor) {
  const all = columns.every((column) => !column.rows);
  if (all) return [run.times, ...columns.map((column) => column.values.map((value) => value * factor))];
  const rows = [...new Set(columns.flatMap((column) => column.rows))].sort((a, b) => a - b);
  const place = new Map(rows.map((row, at) => [row, at]));
  const data = columns.map((column) => {
    // undefined: the line goes on, null would break it.
    const values = new Array(rows.length).fill(undefined);
    column.rows.forEach((row, at) => (values[place.get(row)] = column.values[at] * factor));
    return values;
  });
  return [rows.map((row) => run.times[row]), ...data];
}

// The nearest row that the column has, for the value under the cursor.
function nearest(chart, series, index) {
  const values = chart.data[series];
  for (let away = 0; away < values.length; away++) {
    if (values[index - away] !== undefined) return index - away;
    if (values[index + away] !== undefined) return index + away;
  }
  return index;
}

function drawChart(quantity) {
  charts.get(quantity)?.box.remove();
  charts.get(quantity)?.plot.destroy();
  charts.delete(quantity);
  const columns = groups.get(quantity).filter((column) => chosen.has(column));
  if (columns.length === 0) return;
  const [unit, factor] = unitOf(columns);
  const box = document.createElement("div");
  box.className = "chart";
  make(box, "h3", unit && unit !== "1" ? `${quantity} [${unit}]` : quantity);
  // Charts keep the order of the list, whatever order they are chosen in.
  const order = [...groups.keys()];
  const next = [...charts.keys()].filter((other) => order.indexOf(other) > order.indexOf(quantity));
  next.sort((a, b) => order.indexOf(a) - order.indexOf(b));
  element("charts").insertBefore(box, next.length ? charts.get(next[0]).box : null);
  const series = columns.map((column) => ({
    label: column.name,
    width: 1.4,
    points: { show: false },
    // Where a line is, not the pixel beside it: smooth under a magnifying glass.
    pxAlign: 0,
    value: (_, value) => digits(value),
    paths: column.unit === "" ? uPlot.paths.stepped({ align: 1 }) : undefined,
    ...lineOf(column, groups.get(quantity)),
  }));
  const options = {
    width: element("charts").clientWidth,
    height: 230,
    cursor: { sync: { key: "run" }, dataIdx: nearest, drag: { x: true, y: false } },
    scales: { x: { time: false, min: stretch[0], max: stretch[1] } },
    axes: [{}, { size: 70, values: (_, ticks) => ticks.map(digits) }],
    series: [{ label: "time [s]", value: (_, time) => (time === null ? "" : time.toFixed(5)) }, ...series],
    hooks: { setScale: [(plot, key) => key === "x" && follow(plot.scales.x.min, plot.scales.x.max)] },
    legend: { live: true },
  };
  const plot = new uPlot(options, aligned(columns, factor), box);
  charts.set(quantity, { box, plot });
  plot.setScale("x", { min: stretch[0], max: stretch[1] });
  plot.over.title = columns.length === 1 ? columns[0].about : "";
}

// What one chart shows, all show.
let following = false;
function follow(from, to) {
  if (following || from === null || (from === stretch[0] && to === stretch[1])) return;
  show(from, to);
}

function show(from, to) {
  stretch = [Math.max(0, from), Math.min(run.stop, to)];
  following = true;
  // Their hooks run in microtasks that setScale queues, before the one below.
  for (const { plot } of charts.values()) plot.setScale("x", { min: stretch[0], max: stretch[1] });
  queueMicrotask(() => (following = false));
  element("shown").textContent = `${stretch[0].toFixed(4)} s to ${stretch[1].toFixed(4)} s`;
}

function move(share) {
  const width = stretch[1] - stretch[0];
  const from = Math.min(Math.max(0, stretch[0] + share * width), run.stop - width);
  show(from, from + width);
}

// ---- The list of variables.

const boxes = new Map();

function choose(columns, wanted) {
  const changed = new Set();
  for (const column of columns) {
    if (chosen.has(column) === wanted) continue;
    wanted ? chosen.add(column) : chosen.delete(column);
    boxes.get(column).checked = wanted;
    changed.add(column.quantity);
  }
  changed.forEach(drawChart);
}

function usual() {
  choose(run.columns, false);
  const tops = ["left", "right"].map((side) => run.columns.filter((c) => c.of === side).map((c) => c.index));
  const top = { left: Math.max(...tops[0]), right: Math.max(...tops[1]) };
  // Top floors, and those that can hit: of many, as many as lines can be told apart.
  const facing = run.contacts.length <= 3 ? run.contacts : [run.contacts.at(-1)];
  const forces = groups.get("contact force") ?? [];
  const hardest = [...forces].sort((a, b) => b.largest - a.largest).slice(0, CYCLE.length);
  const isShown = (c) =>
    c.of in top
      ? ["displacement", "acceleration"].includes(c.quantity) &&
        (c.index === top[c.of] || facing.some((pair) => pair[`${c.of}_floor`] === c.index))
      : hardest.includes(c);
  choose(run.columns.filter(isShown), true);
}

function listVariables() {
  for (const [quantity, columns] of groups) {
    const heading = make(element("variables"), "li", "", { class: "group" });
    const all = make(make(heading, "label"), "input", "", { type: "checkbox", "aria-label": `all: ${quantity}` });
    all.parentElement.append(` ${quantity}`);
    all.addEventListener("change", () => choose(columns.filter((column) => !boxes.get(column).closest("li").hidden), all.checked));
    for (const column of columns) {
      const item = make(element("variables"), "li", "", { title: column.about });
      const label = make(item, "label");
      const box = make(label, "input", "", { type: "checkbox", "data-name": column.name });
      label.append(` ${column.name}`);
      box.addEventListener("change", () => choose([column], box.checked));
      boxes.set(column, box);
    }
  }
  element("filter").addEventListener("input", () => {
    const words = element("filter").value.toLowerCase().split(/\s+/);
    for (const [column, box] of boxes) {
      box.closest("li").hidden = !words.every((word) => column.name.toLowerCase().includes(word));
    }
    for (const heading of element("variables").querySelectorAll(".group")) {
      let item = heading.nextElementSibling;
      while (item && !item.classList.contains("group") && item.hidden) item = item.nextElementSibling;
      heading.hidden = !item || item.classList.contains("group");
    }
  });
}

// ---- Tables.

const IMPACTS = [
  ["contact", ""], ["start", "s"], ["end", "s"], ["approach velocity", "m/s"], ["separation velocity", "m/s"],
  ["peak force", "N"], ["time of it", "s"], ["peak penetration", "m"], ["impulse", "N s"], ["dissipated", "J"],
];
const [CONTACT, START, END, APPROACH, , FORCE, , PENETRATION, IMPULSE, DISSIPATED] = IMPACTS.keys();
const FIRST_ROWS = 300;
let sorting = { by: START, down: false };
let allRows = false;

const largestOf = (impacts, by) => impacts.reduce((most, impact) => Math.max(most, impact[by]), 0);
const sumOf = (impacts, by) => impacts.reduce((sum, impact) => sum + impact[by], 0);

function tableOf(table, headings, rows) {
  const head = make(make(table, "thead"), "tr");
  headings.forEach((heading) => make(head, "th", heading));
  const body = make(table, "tbody");
  for (const row of rows) {
    const line = make(body, "tr");
    row.forEach((cell) => make(line, "td", typeof cell === "string" ? cell : digits(cell)));
  }
}

function contactTable() {
  const headings = ["contact", "floors left, right", "gap [m]", "law", "impacts", "approach up to [m/s]"];
  headings.push("force up to [N]", "penetration up to [m]", "impulse [N s]", "dissipated [J]");
  const rows = run.contacts.map((pair, at) => {
    const own = run.impacts.filter((impact) => impact[CONTACT] === at + 1);
    const most = [APPROACH, FORCE, PENETRATION].map((by) => largestOf(own, by));
    const sums = [IMPULSE, DISSIPATED].map((by) => sumOf(own, by));
    return [at + 1, `${pair.left_floor}, ${pair.right_floor}`, pair.gap, pair.law, own.length, ...most, ...sums];
  });
  tableOf(element("contact-table"), headings, rows);
}

function driftTable() {
  const drifts = run.columns.filter((column) => column.quantity === "peak drift");
  const storeys = Math.max(...drifts.map((column) => column.index));
  const of = (side, storey) => drifts.find((c) => c.of === side && c.index === storey)?.values.at(-1) ?? "";
  const rows = Array.from({ length: storeys }, (_, i) => storeys - i);
  const cells = rows.map((storey) => [storey, of("left", storey), of("right", storey)]);
  tableOf(element("drift-table"), ["storey", "left [m]", "right [m]"], cells);
}

function sorted() {
  const { by, down } = sorting;
  const value = (impact) => impact[by] ?? Infinity;
  return [...run.impacts].sort((a, b) => (down ? value(b) - value(a) : value(a) - value(b)) || a[START] - b[START]);
}

function impactTable() {
  const table = element("impact-table");
  table.replaceChildren();
  const head = make(make(table, "thead"), "tr");
  IMPACTS.forEach(([name, unit], by) => {
    const cell = make(head, "th");
    const arrow = by === sorting.by ? (sorting.down ? " \u25BE" : " \u25B4") : "";
    const button = make(cell, "button", `${name}${unit && ` [${unit}]`}${arrow}`);
    if (by === sorting.by) cell.setAttribute("aria-sort", sorting.down ? "descending" : "ascending");
    // The largest first, but times as they pass.
    const first = ![CONTACT, START, END, 6].includes(by);
    button.addEventListener("click", () => {
      sorting = { by, down: by === sorting.by ? !sorting.down : first };
      impactTable();
    });
  });
  const body = make(table, "tbody");
  const rows = sorted();
  for (const impact of allRows ? rows : rows.slice(0, FIRST_ROWS)) {
    const line = make(body, "tr");
    impact.forEach((value, by) => make(line, "td", [START, END, 6].includes(by) ? (value?.toFixed(5) ?? "open") : digits(value)));
    line.addEventListener("click", () => {
      body.querySelector(".chosen")?.classList.remove("chosen");
      line.classList.add("chosen");
      const [from, to] = [impact[START], impact[END] ?? run.stop];
      const around = Math.max(1.5 * (to - from), 1e-3);
      show(from - around, to + around);
      element("histories").scrollIntoView();
    });
  }
  element("more").hidden = allRows || rows.length <= FIRST_ROWS;
  element("more").textContent = `show all ${rows.length}`;
}

// ---- The page.

function happened() {
  const count = run.impacts.length;
  // Rigid contacts have no force of an impact: there the impulse tells which was the hardest.
  const [by, unit] = run.contacts.some((pair) => pair.law === "stereomechanical") ? [IMPULSE, "N s"] : [FORCE, "N"];
  const hardest = run.impacts.reduce((most, impact) => (most && most[by] >= impact[by] ? most : impact), null);
  const text = `0 s to ${digits(run.stop)} s: ${count} impact${count === 1 ? "" : "s"}`;
  if (!hardest) return `${text}.`;
  const { left_floor, right_floor } = run.contacts[hardest[CONTACT] - 1];
  const where = `left floor ${left_floor} and right floor ${right_floor}`;
  return `${text}, the hardest between ${where} at ${hardest[START].toFixed(3)} s with ${digits(hardest[by])} ${unit}.`;
}

document.title = run.name;
element("name").textContent = run.name;
element("description").textContent = run.description;
element("happened").textContent = happened();
element("scene-text").textContent = run.scene;
listVariables();
contactTable();
driftTable();
impactTable();
usual();
show(0, run.stop);
element("usual").addEventListener("click", usual);
element("none").addEventListener("click", () => choose(run.columns, false));
element("whole").addEventListener("click", () => show(0, run.stop));
element("earlier").addEventListener("click", () => move(-0.5));
element("later").addEventListener("click", () => move(0.5));
element("more").addEventListener("click", () => { allRows = true; impactTable(); });
addEventListener("resize", () => {
  for (const { plot } of charts.values()) plot.setSize({ width: element("charts").clientWidth, height: 230 });
});
