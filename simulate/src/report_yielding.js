// ---- Storeys that can yield: how far they have gone, and their storey shear against their drift.

const AT_THE_END = ["ductility", "residual drift", "hysteretic energy", "cumulative plastic drift"];
const LOOP = { width: 320, height: 230, left: 56, right: 10, top: 10, bottom: 34 };

// The top storey first, as in the other tables.
const yieldingStoreys = [...(groups.get("storey shear") ?? [])];
yieldingStoreys.sort((a, b) => a.of.localeCompare(b.of) || b.index - a.index);

function columnOf(quantity, side, index) {
  return (groups.get(quantity) ?? []).find((column) => column.of === side && column.index === index);
}

function yieldingTable() {
  const known = AT_THE_END.filter((quantity) => groups.has(quantity));
  const named = (quantity) => quantity.replace("hysteretic energy", "dissipated");
  const headings = known.map((quantity) => withUnit(named(quantity), groups.get(quantity)[0].unit));
  const rows = yieldingStoreys.map(({ of, index }) => {
    const ends = known.map((quantity) => columnOf(quantity, of, index));
    return [`${of} ${index}`, ...ends.map((column) => scaled(column.values.at(-1), column.unit))];
  });
  tableOf(element("yielding-table"), ["storey", ...headings], rows);
}

// Values of a column at the times of another one; of a long run each has kept rows of its own.
function valuesAt(times, column) {
  const own = column.rows?.map((row) => run.times[row]) ?? run.times;
  let at = 0;
  return times.map((time) => {
    while (at + 2 < own.length && own[at + 1] < time) at++;
    const share = (time - own[at]) / (own[at + 1] - own[at]);
    return column.values[at] + share * (column.values[at + 1] - column.values[at]);
  });
}

function pointsOf(shear) {
  const times = shear.rows?.map((row) => run.times[row]) ?? run.times;
  const floors = [shear.index, shear.index - 1].map((floor) => columnOf("displacement", shear.of, floor));
  const [above, below] = floors.map((column) => (column ? valuesAt(times, column) : times.map(() => 0)));
  const drifts = above.map((value, at) => scaled(value - below[at], "m"));
  return drifts.map((drift, at) => [drift, scaled(shear.values[at], shear.unit)]);
}

function drawn(parent, tag, attributes, text = "") {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  Object.entries(attributes).forEach(([name, value]) => made.setAttribute(name, value));
  made.textContent = text;
  parent.append(made);
  return made;
}

function drawLoops(shear) {
  const box = make(element("loops"), "figure");
  const ductility = columnOf("ductility", shear.of, shear.index)?.values.at(-1);
  make(box, "figcaption", `${shear.of} storey ${shear.index}: ductility ${digits(Number(ductility?.toPrecision(3)))}`);
  const points = pointsOf(shear);
  const largest = [0, 1].map((axis) => points.reduce((most, point) => Math.max(most, Math.abs(point[axis])), 0) || 1);
  const { width, height, left, right, top, bottom } = LOOP;
  const x = (value) => left + (0.5 + value / largest[0] / 2) * (width - left - right);
  const y = (value) => top + (0.5 - value / largest[1] / 2) * (height - top - bottom);
  const svg = drawn(box, "svg", { viewBox: `0 0 ${width} ${height}`, role: "img" });
  const [wide, high] = largest;
  drawn(svg, "path", { class: "axes", d: `M${x(-wide)} ${y(0)}H${x(wide)}M${x(0)} ${y(high)}V${y(-high)}` });
  const line = points.map(([drift, force]) => `${x(drift).toFixed(1)},${y(force).toFixed(1)}`).join(" ");
  drawn(svg, "polyline", { points: line, stroke: COLOURS[shear.of][0] });
  for (const end of [-1, 1]) {
    const short = (value) => digits(Number((end * value).toPrecision(3)));
    drawn(svg, "text", { x: x(end * wide), y: height - 18, "text-anchor": end < 0 ? "start" : "end" }, short(wide));
    drawn(svg, "text", { x: left - 4, y: y(end * high) + 4, "text-anchor": "end" }, short(high));
  }
  drawn(svg, "text", { x: x(0), y: height - 4, "text-anchor": "middle" }, withUnit("drift", "m"));
  const upright = { x: 12, y: y(0), "text-anchor": "middle", transform: `rotate(-90 12 ${y(0)})` };
  drawn(svg, "text", upright, withUnit("shear", shear.unit));
}

element("yielding").hidden = yieldingStoreys.length === 0;
document.querySelector('nav a[href="#yielding"]').hidden = yieldingStoreys.length === 0;
yieldingTable();
yieldingStoreys.forEach(drawLoops);
