// ---- Storeys that can yield and links: how far they have gone, and their force against their displacement.

const AT_THE_END = ["ductility", "residual drift", "hysteretic energy", "cumulative plastic drift"];
const OF_LINKS = ["link peak force", "link peak displacement", "link slip travel", "link dissipated energy"];
const LOOP = { width: 320, height: 230, left: 56, right: 10, top: 10, bottom: 34 };

// The top storey first, as in the other tables.
const yieldingStoreys = [...(groups.get("storey shear") ?? [])];
yieldingStoreys.sort((a, b) => names.indexOf(a.of) - names.indexOf(b.of) || b.index - a.index);

function columnOf(quantity, side, index) {
  return (groups.get(quantity) ?? []).find((column) => column.of === side && column.index === index);
}

// Values at the end of the run: a row for each of `items`, which begins with its `cells` and goes on with the quantities
// that any of them has.
function tableAtTheEnd(table, first, quantities, items) {
  const known = quantities.filter((quantity) => groups.has(quantity));
  const named = (quantity) => quantity.replace(/^link /, "").replace(/(hysteretic|dissipated) energy/, "dissipated");
  const headings = known.map((quantity) => withUnit(named(quantity), groups.get(quantity)[0].unit));
  const rows = items.map(({ of, index, cells }) => {
    const ends = known.map((quantity) => columnOf(quantity, of, index));
    return [...cells, ...ends.map((column) => (column ? scaled(column.values.at(-1), column.unit) : ""))];
  });
  tableOf(element(table), [...first, ...headings], rows);
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

const timesOf = (column) => column.rows?.map((row) => run.times[row]) ?? run.times;

// What strains the columns of a storey: without the part that leans with the foundation.
function driftOf(shear) {
  const { of, index } = shear;
  const times = timesOf(shear);
  const below = index > 1 ? columnOf("displacement", of, index - 1) : columnOf("foundation displacement", of, 0);
  const columns = [columnOf("displacement", of, index), below, columnOf("foundation rotation", of, 0)];
  const [above, under, rotation] = columns.map((column) => (column ? valuesAt(times, column) : times.map(() => 0)));
  const height = columns[2] ? byName.get(of).levels[index] - byName.get(of).levels[index - 1] : 0;
  return above.map((value, at) => value - under[at] - height * rotation[at]);
}

function drawn(parent, tag, attributes, text = "") {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  Object.entries(attributes).forEach(([name, value]) => made.setAttribute(name, value));
  made.textContent = text;
  parent.append(made);
  return made;
}

// A force, which is a column, over displacements at its times, m; `titles` name the axes.
function drawLoops(place, caption, displacements, force, titles, stroke) {
  const box = make(element(place), "figure");
  make(box, "figcaption", caption);
  const points = displacements.map((value, at) => [scaled(value, "m"), scaled(force.values[at], force.unit)]);
  const largest = [0, 1].map((axis) => points.reduce((most, point) => Math.max(most, Math.abs(point[axis])), 0) || 1);
  const { width, height, left, right, top, bottom } = LOOP;
  const x = (value) => left + (0.5 + value / largest[0] / 2) * (width - left - right);
  const y = (value) => top + (0.5 - value / largest[1] / 2) * (height - top - bottom);
  const svg = drawn(box, "svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": caption });
  const [wide, high] = largest;
  drawn(svg, "path", { class: "axes", d: `M${x(-wide)} ${y(0)}H${x(wide)}M${x(0)} ${y(high)}V${y(-high)}` });
  const line = points.map(([across, up]) => `${x(across).toFixed(1)},${y(up).toFixed(1)}`).join(" ");
  drawn(svg, "polyline", { points: line, stroke });
  for (const end of [-1, 1]) {
    const short = (value) => digits(Number((end * value).toPrecision(3)));
    drawn(svg, "text", { x: x(end * wide), y: height - 18, "text-anchor": end < 0 ? "start" : "end" }, short(wide));
    drawn(svg, "text", { x: left - 4, y: y(end * high) + 4, "text-anchor": "end" }, short(high));
  }
  drawn(svg, "text", { x: x(0), y: height - 4, "text-anchor": "middle" }, withUnit(titles[0], "m"));
  const upright = { x: 12, y: y(0), "text-anchor": "middle", transform: `rotate(-90 12 ${y(0)})` };
  drawn(svg, "text", upright, withUnit(titles[1], force.unit));
}

function loopsOfStorey(shear) {
  const ductility = columnOf("ductility", shear.of, shear.index)?.values.at(-1);
  const caption = `${shear.of} storey ${shear.index}: ductility ${digits(Number(ductility?.toPrecision(3)))}`;
  drawLoops("loops", caption, driftOf(shear), shear, ["drift", "shear"], lineColour(shear.of));
}

function loopsOfLink({ meeting, parts }, at) {
  const [force, displacement] = ["force", "displacement"].map((part) => columnOf(`link ${part}`, "link", at + 1));
  const caption = `link ${at + 1} ${meeting}: ${parts.join(" and ")}`;
  const displacements = valuesAt(timesOf(force), displacement);
  drawLoops("link-loops", caption, displacements, force, ["displacement", "force"], COLOURS.others[0]);
}

// A section with its place in the list of sections, where there is something in it.
function offer(section, isThere) {
  element(section).hidden = !isThere;
  document.querySelector(`nav a[href="#${section}"]`).hidden = !isThere;
}

offer("yielding", yieldingStoreys.length > 0);
const storeyRows = yieldingStoreys.map(({ of, index }) => ({ of, index, cells: [`${of} ${index}`] }));
tableAtTheEnd("yielding-table", ["storey"], AT_THE_END, storeyRows);
yieldingStoreys.filter(({ of }) => charted.includes(of)).forEach(loopsOfStorey);

offer("links", run.links.length > 0);
const linkRows = run.links.map(({ meeting, parts }, at) => {
  return { of: "link", index: at + 1, cells: [at + 1, meeting.replace("between ", ""), parts.join(", ")] };
});
tableAtTheEnd("link-table", ["link", "what it joins", "made of"], OF_LINKS, linkRows);
run.links.forEach(loopsOfLink);
