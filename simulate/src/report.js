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

// The buildings from left to right.
const byName = new Map(run.buildings.map((building) => [building.name, building]));
const names = [...byName.keys()];
const isPair = names.length <= 2;

// Okabe and Ito's colours and some of Tol's: of two the left building in cold ones and solid lines, the right one in warm ones
// and dashed lines, the top floor in those of the other pictures; of more each in one, which after eight begin anew.
const ROW_COLOURS = ["#0072B2", "#D55E00", "#332288", "#E69F00", "#882255", "#999933", "#661100", "#CC79A7"];
const COLOURS = {
  left: ["#0072B2", "#56B4E9", "#009E73", "#332288"],
  right: ["#D55E00", "#E69F00", "#CC79A7", "#882255"],
  others: ["#000000", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#0072B2", "#D55E00"],
};
const DASHES = {
  left: [[], [2, 3], [12, 3, 2, 3]],
  right: [[8, 4], [4, 3], [8, 3, 2, 3]],
  others: [[], [8, 4], [2, 3], [8, 3, 2, 3]],
  row: [[], [8, 4], [2, 3], [8, 3, 2, 3], [12, 3, 2, 3, 2, 3]],
};
function paletteOf(of) {
  const at = names.indexOf(of);
  if (at < 0) return [COLOURS.others, DASHES.others];
  if (!isPair) return [[ROW_COLOURS[at % ROW_COLOURS.length]], DASHES.row];
  const side = ["left", "right"][at];
  return [COLOURS[side], DASHES[side]];
}
const lineColour = (of) => paletteOf(of)[0][0];

for (const column of run.columns) {
  const known = /^(\w+)(?:\[(\d+)\])?(?:\.(foundation\.)?(\w+)(?:\[(\d+)\])?)?$/;
  const [, whole, index, foundation, part, storey] = column.name.match(known);
  column.of = whole;
  column.index = Number(storey || index || 0);
  column.quantity = whole === "ground" ? "ground acceleration" : whole === "energy" ? "energy" : part || whole;
  if (column.name === "energy.residual") column.quantity = "energy residual";
  if (whole === "contact") column.quantity = { force: "contact force" }[part] || part.replaceAll("_", " ");
  else if (foundation) column.quantity = `foundation ${part.replaceAll("_", " ")}`;
  else if (whole === "link") column.quantity = `link ${part.replaceAll("_", " ")}`;
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

// Each unit is shown as itself or as its display unit, whichever has the handier numbers, and the same on the whole page.
// Ways that add up over the run have no say in that of lengths.
const SUMS = ["link slip travel", "cumulative plastic drift"];
const units = new Map();
for (const { unit, display, largest, quantity } of run.columns) {
  if (!unit || unit === "1" || !display || SUMS.includes(quantity)) continue;
  const known = units.get(unit) ?? { display, largest: 0 };
  units.set(unit, { ...known, largest: Math.max(known.largest, largest) });
}
for (const [unit, { display, largest }] of units) {
  const awkward = (factor) => Math.abs(Math.log10(largest * factor) - 1.5);
  units.set(unit, largest > 0 && awkward(display[1]) < awkward(1) ? display : [unit, 1]);
}
// Impulses go with forces.
if (units.has("N.s") && units.has("N")) {
  const [name, factor] = units.get("N");
  units.set("N.s", [`${name}.s`, factor]);
}

// Name and factor of what a unit is shown in.
const shownIn = (unit) => units.get(unit) ?? [unit === "1" ? "" : unit, 1];
const unitText = (unit) => shownIn(unit)[0].replace(".", "\u00a0");
const withUnit = (name, unit) => (unitText(unit) ? `${name} [${unitText(unit)}]` : name);
const scaled = (value, unit) => (value === null ? null : value * shownIn(unit)[1]);

// Colour and dash of a column among those that are drawn with it.
function lineOf(column, drawn) {
  // From the top floor down.
  const same = byName.has(column.of) ? drawn.filter((other) => other.of === column.of).reverse() : drawn;
  const place = same.indexOf(column);
  const [colours, dashes] = paletteOf(column.of);
  const dash = dashes[Math.floor(place / colours.length) % dashes.length];
  return { stroke: colours[place % colours.length], dash };
}

// ---- Charts: one for each quantity of which variables are chosen, all over the same stretch of time.

// Three charts fill a window.
const height = () => Math.max(190, Math.min(400, (innerHeight - 50) / 3 - 42));
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

// Its quantity stands above the chart.
function shortName(column) {
  return byName.has(column.of) || ["contact", "link"].includes(column.of) ? `${column.of} ${column.index || ""}`.trim() : column.name;
}

function drawChart(quantity) {
  charts.get(quantity)?.box.remove();
  charts.get(quantity)?.plot.destroy();
  charts.delete(quantity);
  const columns = groups.get(quantity).filter((column) => chosen.has(column));
  if (columns.length === 0) return;
  const { unit } = columns[0];
  const box = document.createElement("div");
  box.className = "chart";
  const head = make(box, "div", "", { class: "head" });
  make(head, "h3", withUnit(quantity, unit));
  // Charts keep the order of the list, whatever order they are chosen in.
  const order = [...groups.keys()];
  const next = [...charts.keys()].filter((other) => order.indexOf(other) > order.indexOf(quantity));
  next.sort((a, b) => order.indexOf(a) - order.indexOf(b));
  element("charts").insertBefore(box, next.length ? charts.get(next[0]).box : null);
  const series = columns.map((column) => ({
    label: shortName(column),
    width: 1.4,
    points: { show: false },
    // Where a line is, not the pixel beside it: smooth under a magnifying glass.
    pxAlign: 0,
    value: (_, value) => digits(value),
    paths: column.unit === "" ? uPlot.paths.stepped({ align: 1 }) : undefined,
    ...lineOf(column, columns),
  }));
  const options = {
    width: element("charts").clientWidth,
    height: height(),
    padding: [6, 8, 0, 0],
    cursor: { sync: { key: "run" }, dataIdx: nearest, drag: { x: true, y: false } },
    scales: { x: { time: false, min: stretch[0], max: stretch[1] } },
    axes: [{ size: 28 }, { size: 62, values: (_, ticks) => ticks.map(digits) }],
    series: [{ label: "time [s]", value: (_, time) => (time === null ? "" : time.toFixed(5)) }, ...series],
    hooks: { setScale: [(plot, key) => key === "x" && follow(plot.scales.x.min, plot.scales.x.max)] },
    legend: { live: true },
  };
  const plot = new uPlot(options, aligned(columns, shownIn(unit)[1]), box);
  head.append(plot.root.querySelector(".u-legend"));
  drawKeys(head, series);
  charts.set(quantity, { box, plot });
  plot.setScale("x", { min: stretch[0], max: stretch[1] });
  plot.over.title = columns.length === 1 ? columns[0].about : "";
}

// In the legend each line as it is drawn, where the library has a square.
function drawKeys(head, series) {
  const marks = [...head.querySelectorAll(".u-marker")].slice(-series.length);
  marks.forEach((mark, at) => {
    const key = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    const line = document.createElementNS("http://www.w3.org/2000/svg", "line");
    const { stroke, dash } = series[at];
    const look = { x1: 0, x2: 30, y1: 5, y2: 5, stroke, "stroke-width": 2, "stroke-dasharray": dash.join(" ") || "none" };
    Object.entries({ class: "key", width: 30, height: 10 }).forEach(([name, value]) => key.setAttribute(name, value));
    Object.entries(look).forEach(([name, value]) => line.setAttribute(name, value));
    key.append(line);
    mark.replaceWith(key);
  });
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
const groupBoxes = new Map();

function choose(columns, wanted) {
  const changed = new Set();
  for (const column of columns) {
    if (chosen.has(column) === wanted) continue;
    wanted ? chosen.add(column) : chosen.delete(column);
    boxes.get(column).checked = wanted;
    changed.add(column.quantity);
  }
  for (const quantity of changed) {
    groupBoxes.get(quantity).checked = groups.get(quantity).every((column) => chosen.has(column));
    drawChart(quantity);
  }
}

function usual() {
  choose(run.columns, false);
  const top = new Map(charted.map((name) => [name, byName.get(name).floors]));
  // Top floors, and those that can hit: of many, as many as lines can be told apart.
  const between = run.contacts.filter((contact) => buildingsOf(contact).every((name) => top.has(name)));
  const facing = between.length <= 3 ? between : [between.at(-1)];
  const largest = (quantity) =>
    [...(groups.get(quantity) ?? [])].sort((a, b) => b.largest - a.largest).slice(0, COLOURS.others.length);
  const ofOthers = ["contact force", "foundation displacement", "foundation rotation", "link force", "link displacement"];
  const others = ofOthers.flatMap(largest);
  const isShown = (c) =>
    byName.has(c.of) && !c.quantity.startsWith("foundation")
      ? ["displacement", "acceleration"].includes(c.quantity) &&
        top.has(c.of) &&
        (c.index === top.get(c.of) || facing.some(({ row }) => row.some(([side, name]) => side === c.of && name === `displacement[${c.index}]`)))
      : others.includes(c);
  choose(run.columns.filter(isShown), true);
}

function listVariables() {
  for (const [quantity, columns] of groups) {
    const heading = make(element("variables"), "li", "", { class: "group" });
    const all = make(make(heading, "label"), "input", "", { type: "checkbox", "aria-label": `all: ${quantity}` });
    all.parentElement.append(` ${quantity}`);
    groupBoxes.set(quantity, all);
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
  ["peak force", "N"], ["time of it", "s"], ["peak penetration", "m"], ["impulse", "N.s"], ["dissipated", "J"],
];
const [CONTACT, START, END, APPROACH, , FORCE, , PENETRATION, IMPULSE, DISSIPATED] = IMPACTS.keys();
const FIRST_ROWS = 300;
let sorting = { by: START, down: false };
let allRows = false;

// Of more than two buildings those that were asked for, or those of the hardest impact; without any of the first contact.
const buildingsOf = ({ left, right }) => [left.side, right.side].filter(Boolean);
const charted = run.charted ?? (isPair ? names : buildingsOf(run.contacts[hardestOf(run.impacts)?.[0] - 1] ?? firstTwo()));

function firstTwo() {
  return run.contacts[0] ?? { left: { side: names[0] }, right: { side: names[1] } };
}

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
  const most = [["approach up to", APPROACH], ["force up to", FORCE], ["penetration up to", PENETRATION]];
  const sums = [["impulse", IMPULSE], ["dissipated", DISSIPATED]];
  const headings = ["contact", "what meets", withUnit("gap", "m"), "law", "impacts"];
  for (const [name, by] of [...most, ...sums]) headings.push(withUnit(name, IMPACTS[by][1]));
  const rows = run.contacts.map((pair, at) => {
    const own = run.impacts.filter((impact) => impact[CONTACT] === at + 1);
    const numbers = [...most.map(([, by]) => [by, largestOf(own, by)]), ...sums.map(([, by]) => [by, sumOf(own, by)])];
    const cells = numbers.map(([by, value]) => scaled(value, IMPACTS[by][1]));
    return [at + 1, pair.meeting.replace(/^(between|of) /, ""), scaled(pair.gap, "m"), pair.law, own.length, ...cells];
  });
  tableOf(element("contact-table"), headings, rows);
}

// The buildings at rest, as the page draws them: its colours in the light. Gaps are as wide as the floors move, or wider.
function drawBuildings() {
  const canvas = element("buildings");
  if (!isPair) canvas.style.maxWidth = "none";
  const [width, height, dense] = [canvas.clientWidth, canvas.clientHeight, devicePixelRatio];
  [canvas.width, canvas.height] = [width * dense, height * dense];
  const context = canvas.getContext("2d");
  context.scale(dense, dense);
  const geometry = new Geometry({ layout: run });
  const moves = run.columns.filter((column) => column.quantity === "displacement").map((column) => column.largest);
  const colours = { ink: "#111", quiet: "#555", line: "#ddd", card: "#fff", "right-text": COLOURS.right[0] };
  [colours.left, colours.right] = [COLOURS.left[0], COLOURS.right[0]];
  ROW_COLOURS.forEach((colour, at) => (colours[`row-${at + 1}`] = colour));
  const place = layOut(geometry, { x: 0, y: 0, width, height }, Math.max(0, ...moves), 0);
  new Drawing(context, geometry, place, colours).draw({
    moved: geometry.atRest(),
    slipping: [],
    flashes: [],
    numbered: true,
  });
}

// The largest of each storey and floor, the top first, and of the base; as far as the scene asks for them. Where it has
// heights each building has the levels of its floors beside them.
function peakTable() {
  const ofStoreys = ["peak drift", "peak drift ratio", "peak storey shear", "peak column force"];
  const quantities = [...ofStoreys, "peak displacement", "peak acceleration"];
  const last = (column) => (column ? scaled(column.values.at(-1), column.unit) : "");
  const columns = charted.flatMap((side) => {
    const of = (quantity) => (groups.get(quantity) ?? []).filter((column) => column.of === side);
    const known = quantities.map(of).filter((peaks) => peaks.length > 0);
    const cells = known.map((peaks) => ({
      heading: withUnit(peaks[0].quantity.replace("peak", side), peaks[0].unit),
      cell: (index) => last(peaks.find((column) => column.index === index)),
    }));
    const { floors, levels } = byName.get(side);
    const level = { heading: `${side} level`, cell: (index) => (index <= floors ? `${digits(levels[index])} m` : "") };
    return levels && known.length > 0 ? [level, ...cells] : cells;
  });
  element("peaks").hidden = columns.length === 0;
  const storeys = columns.length > 0 ? Math.max(...charted.map((side) => byName.get(side).floors)) : 0;
  const rows = Array.from({ length: storeys }, (_, i) => storeys - i);
  const cells = rows.map((index) => [index, ...columns.map(({ cell }) => cell(index))]);
  tableOf(element("peak-table"), ["storey, floor", ...columns.map(({ heading }) => heading)], cells);
  const shears = (groups.get("peak base shear") ?? []).map((c) => `${digits(last(c))} ${unitText(c.unit)} (${c.of})`);
  element("peak-shears").textContent = shears.length > 0 ? `base shear: ${shears.join(", ")}` : "";
}

// The largest of each foundation, and by how much the soil slows its building.
function foundationTable() {
  const sides = names.filter((side) => byName.get(side).foundation);
  const quantities = ["displacement", "rotation", "force", "moment"].map((what) => `foundation peak ${what}`);
  const known = quantities.map((quantity) => groups.get(quantity)).filter(Boolean);
  const headings = known.map(([{ quantity, unit }]) => withUnit(quantity.replace("foundation ", ""), unit));
  const rows = sides.map((side) => {
    const own = known.map((columns) => columns.find((column) => column.of === side));
    const cells = own.map((column) => (column ? scaled(column.values.at(-1), column.unit) : ""));
    return [side, byName.get(side).foundation.period_ratio, ...cells];
  });
  element("foundations").hidden = sides.length === 0;
  tableOf(element("foundation-table"), ["foundation", "first period / on a fixed base", ...headings], rows);
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
    const button = make(cell, "button", `${withUnit(name, unit)}${arrow}`);
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
    impact.forEach((value, by) => make(line, "td", [START, END, 6].includes(by) ? (value?.toFixed(5) ?? "open") : digits(scaled(value, IMPACTS[by][1]))));
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

// Rigid contacts have no force of an impact: there the impulse tells which was the hardest.
function hardness() {
  return run.contacts.some((pair) => pair.law === "stereomechanical") ? [IMPULSE, "N.s"] : [FORCE, "N"];
}

function hardestOf(impacts) {
  const [by] = hardness();
  return impacts.reduce((most, impact) => (most && most[by] >= impact[by] ? most : impact), null);
}

function happened() {
  const count = run.impacts.length;
  const [by, unit] = hardness();
  const hardest = hardestOf(run.impacts);
  const end = run.collapse ? `; at ${digits(run.stop)} s ${run.collapse}` : "";
  const text = `0 s to ${digits(run.stop)} s: ${count} impact${count === 1 ? "" : "s"}`;
  if (!hardest) return `${text}${end}.`;
  const { meeting } = run.contacts[hardest[CONTACT] - 1];
  return `${text}, the hardest ${meeting} at ${hardest[START].toFixed(3)} s with ${digits(scaled(hardest[by], unit))} ${unitText(unit)}${end}.`;
}

document.title = run.name;
element("name").textContent = run.name;
element("description").textContent = run.description;
element("happened").textContent = happened();
element("scene-text").textContent = run.scene;
listVariables();
drawBuildings();
contactTable();
peakTable();
foundationTable();
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
  drawBuildings();
  for (const { plot } of charts.values()) plot.setSize({ width: element("charts").clientWidth, height: height() });
});
