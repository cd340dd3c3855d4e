// ---- More than two buildings at rest, where the drawing of the page has no more than two: levels to scale, all equally wide, the
// widest gap as wide as there is room for.

const MOST_NUMBERED = 12;
const USUAL_GAP = 0.05; // m, where no contact says how far apart buildings are
const NAMES = "12px system-ui, sans-serif";
const ROW = { foot: 46, top: 26, slab: 0.14, column: 0.05, share: 0.82 };

const haveLevels = () => run.buildings.every(({ levels }) => levels);
const levelsOf = ({ floors, levels }) => (haveLevels() ? levels : Array.from({ length: floors + 1 }, (_, floor) => floor));
const levelOf = ({ kind, side, floor, storey, position }) => {
  const levels = levelsOf(byName.get(side));
  if (kind === "floor") return levels[floor];
  return levels[storey - 1] + position * (levels[storey] - levels[storey - 1]);
};

// The value of a line through points, as it is before the first and after the last of them.
function lineThrough(points, at) {
  const next = points.findIndex(([x]) => x >= at);
  if (next <= 0) return next === 0 ? points[0][1] : points.at(-1)[1];
  const [[x0, y0], [x1, y1]] = [points[next - 1], points[next]];
  return x1 > x0 ? y0 + ((at - x0) / (x1 - x0)) * (y1 - y0) : y1;
}

// Left edges of all floors of each building in pixels, the first one's at 0, for gaps of so many pixels a metre.
function edgesOf(wide, across) {
  const edges = [];
  run.buildings.forEach((building, at) => {
    const before = run.buildings[at - 1];
    const between = run.contacts.filter(({ left, right }) => left.side === before?.name && right.side === building.name);
    const gaps = between.map(({ gap, right }) => [levelOf(right), gap]).sort(([a], [b]) => a - b);
    const beside = before && levelsOf(before).map((level, floor) => [level, edges[at - 1][floor]]);
    const gapAt = (level) => (gaps.length > 0 ? lineThrough(gaps, level) : USUAL_GAP);
    const edge = (level) => (before ? lineThrough(beside, level) + wide + across * gapAt(level) : 0);
    edges.push(levelsOf(building).map(edge));
  });
  return edges;
}

function drawRow(context, width, height) {
  const all = run.buildings.flatMap(levelsOf);
  const [bottom, top] = [Math.min(...all), Math.max(...all)];
  const wide = (ROW.share * width) / (run.buildings.length + 1);
  const widest = Math.max(1e-6, ...run.contacts.map(({ gap }) => Math.abs(gap)));
  const edges = edgesOf(wide, (((1 - ROW.share) * width) / (run.buildings.length + 1)) / widest);
  const middle = (Math.min(...edges.flat()) + Math.max(...edges.flat()) + wide) / 2;
  context.font = NAMES;
  const longest = Math.max(...names.map((name) => context.measureText(name).width));
  const foot = longest > wide ? Math.min(0.45 * height, longest + 24) : ROW.foot;
  const up = (height - foot - ROW.top) / (top - bottom);
  const y = (level) => height - foot - (level - bottom) * up;
  const faces = new Map(run.buildings.map((building, at) => [building.name, { building, edges: edges[at] }]));
  // Where a building's side is that faces right or left.
  const faceOf = (surface, facesRight) => {
    const { building, edges: own } = faces.get(surface.side);
    const edge = lineThrough(levelsOf(building).map((level, floor) => [level, own[floor]]), levelOf(surface));
    return width / 2 - middle + edge + (facesRight ? wide : 0);
  };
  run.buildings.forEach(({ name, foundation }, at) => {
    const levels = levelsOf(run.buildings[at]).map(y);
    const xs = edges[at].map((edge) => width / 2 - middle + edge);
    const storey = (levels[0] - levels.at(-1)) / (levels.length - 1);
    const [thick, column] = [Math.max(1.5, Math.min(9, ROW.slab * storey)), Math.max(1, Math.min(6, ROW.column * wide))];
    context.fillStyle = lineColour(name);
    for (let floor = 1; floor < levels.length; floor++) {
      context.fillRect(xs[floor], levels[floor] - thick / 2, wide, thick);
      for (const inside of [0.08 * wide, 0.92 * wide - column]) {
        context.fillRect(xs[floor] + inside, levels[floor], column, levels[floor - 1] - levels[floor]);
      }
    }
    if (foundation) context.fillRect(xs[0] - 2, levels[0], wide + 4, 8);
    drawName(context, name, { x: xs[0] + wide / 2, y: levels[0] + (foundation ? 14 : 8) }, longest > wide);
    context.fillStyle = "#888";
    context.fillRect(xs[0] - 0.06 * wide, levels[0] + (foundation ? 8 : 0), 1.12 * wide, 3);
  });
  run.links.forEach(({ left, right }) => drawLink(context, left, right, { faceOf, y, wide }));
  run.contacts.forEach((contact, at) => drawMeeting(context, contact, at + 1, { faceOf, y, wide, floor: y(bottom) }));
}

// Downwards where one of them is longer than its building is wide.
function drawName(context, name, { x, y }, isUpright) {
  context.font = NAMES;
  context.save();
  context.translate(x, y);
  if (isUpright) context.rotate(Math.PI / 2);
  [context.textAlign, context.textBaseline] = isUpright ? ["left", "middle"] : ["center", "top"];
  context.fillText(name, 0, 0);
  context.restore();
}

// A line from slab to slab, or to the ground beside one.
function drawLink(context, left, right, { faceOf, y, wide }) {
  const ends = [left, right].map((end, at) => (end.kind === "wall" ? null : { x: faceOf(end, at === 0), y: y(levelOf(end)) }));
  const [from, to] = ends.map((end, at) => end ?? { x: ends[1 - at].x + (at === 0 ? -0.12 : 0.12) * wide, y: ends[1 - at].y });
  [context.strokeStyle, context.lineWidth] = ["#111", 1.6];
  context.setLineDash([4, 3]);
  context.beginPath();
  context.moveTo(from.x - 0.15 * wide, from.y + 5);
  context.lineTo(to.x + 0.15 * wide, to.y + 5);
  context.stroke();
  context.setLineDash([]);
}

// A wall where there is one, and the number of the contact, as in the table.
function drawMeeting(context, { left, right }, number, { faceOf, y, wide, floor }) {
  const [own, facesRight] = left.kind === "wall" ? [right, false] : [left, true];
  const [face, level] = [faceOf(own, facesRight), y(levelOf(own))];
  const away = facesRight ? 1 : -1;
  const isWall = left.kind === "wall" || right.kind === "wall";
  // Between two buildings there is less room for it.
  const room = names[names.indexOf(own.side) + away] ? 0.04 * wide : 0.1 * wide;
  const other = isWall ? face + away * room : faceOf(right, false);
  if (isWall) {
    context.fillStyle = "#999";
    context.fillRect(Math.min(other, other + (away * room) / 2), level - 8, room / 2, floor - level + 8);
  }
  if (run.buildings.length > MOST_NUMBERED) return;
  const [x, above] = [(face + other) / 2, level - 14];
  context.beginPath();
  context.arc(x, above, 8, 0, 2 * Math.PI);
  [context.fillStyle, context.strokeStyle, context.lineWidth] = ["#fff", "#555", 1];
  context.fill();
  context.stroke();
  [context.fillStyle, context.font, context.textAlign, context.textBaseline] = ["#111", "11px system-ui, sans-serif", "center", "middle"];
  context.fillText(String(number), x, above);
}
