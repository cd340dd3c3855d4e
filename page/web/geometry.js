// Where buildings, foundations, contacts and walls stand at rest, upwards by the levels of the scene, or, without them, with all
// storeys equally high; across in m from the left edge of the first building, as if buildings had no width: whoever draws
// adds one width for each building that is passed.

import { SIDES, kindOf, namesOf } from "./motion.js";

// m between buildings of which no contact says how far apart they are.
const USUAL_GAP = 0.05;

export class Geometry {
  constructor({ layout }) {
    this.names = namesOf({ layout });
    this.hasLevels = layout.buildings.every(({ levels }) => levels);
    this.buildings = layout.buildings.map((building) => this.#buildingOf(building));
    const all = this.buildings.flatMap(({ levels }) => levels);
    [this.bottom, this.top] = [Math.min(0, ...ends(all)), Math.max(...ends(all), 1e-9)];
    this.hasSoil = this.buildings.some(({ soil }) => soil);
    this.contacts = layout.contacts.map((contact) => this.#contactOf(contact));
    for (const { columns } of this.contacts) if (columns !== null) this.buildings[columns].isHit = true;
    this.gap = this.contacts.reduce((most, { gap }) => Math.max(most, Math.abs(gap)), 0);
    this.walls = this.contacts.filter((contact) => contact.wall);
    this.links = layout.links.map(({ left, right, parts }) => ({ ...this.#meetingOf({ left, right }), parts }));
    this.#placeAll();
    // m, all gaps together.
    this.span = Math.max(0, ...this.buildings.at(-1).edges);
  }

  #buildingOf({ name, floors, levels, foundation }) {
    const equal = Array.from({ length: floors + 1 }, (_, floor) => floor);
    // `heights`: m, from floor to floor, where the scene says it. `soil`: what is under its foundation.
    return {
      name,
      kind: kindOf(this.names, name),
      levels: this.hasLevels ? levels : equal,
      heights: (levels ?? []).slice(1).map((level, at) => level - levels[at]),
      soil: foundation,
      isHit: false,
    };
  }

  // Both sides of a contact or a link, buildings by their place; and how many buildings stand on its left.
  #meetingOf(sides) {
    const of = ({ side, ...surface }) => ({ ...surface, building: this.names.indexOf(side) });
    const surfaces = Object.fromEntries(SIDES.map((side) => [side, of(sides[side])]));
    const passed = surfaces.right.kind === "wall" ? surfaces.left.building + 1 : surfaces.right.building;
    return { surfaces, passed };
  }

  // What the picture needs of a contact: its gap, its height, and what is on each side of it.
  #contactOf({ left, right, gap, meeting, law }) {
    const { surfaces, passed } = this.#meetingOf({ left, right });
    const heights = Object.values(surfaces)
      .map((surface) => this.#heightOf(surface))
      .filter((height) => height !== null);
    const height = heights.reduce((sum, one) => sum + one, 0) / heights.length;
    const columns = Object.values(surfaces).find((surface) => surface.kind === "columns")?.building ?? null;
    const wall = SIDES.find((side) => surfaces[side].kind === "wall") ?? null;
    return { surfaces, passed, gap, meeting, law, height, columns, wall };
  }

  #heightOf({ kind, building, floor, storey, position }) {
    if (kind === "wall") return null;
    const { levels } = this.buildings[building];
    if (kind === "floor") return levels[floor];
    return levels[storey - 1] + position * (levels[storey] - levels[storey - 1]);
  }

  // Each building beside the one before: between contacts the gap goes on as a line, beyond them as it is.
  #placeAll() {
    let before = [[0, 0]];
    this.buildings.forEach((building, at) => {
      const between = this.contacts.filter(({ passed, wall }) => passed === at && !wall);
      const known = between.map(({ height, gap }) => [height, gap]).sort(([a], [b]) => a - b);
      if (known.length === 0) known.push([0, at === 0 ? 0 : USUAL_GAP]);
      building.edges = building.levels.map((level) => interpolate(before, level) + interpolate(known, level));
      before = building.levels.map((level, floor) => [level, building.edges[floor]]);
    });
  }

  // Displacements of floors and rotations of foundations that have not moved.
  atRest() {
    return { floors: this.buildings.map(({ levels }) => levels.map(() => 0)), turned: this.buildings.map(() => 0) };
  }

  // m by which a storey leans with its foundation.
  leanOf(at, storey, moved) {
    return moved.turned[at] ? this.buildings[at].heights[storey - 1] * moved.turned[at] : 0;
  }

  // Left and right side of the gap of a contact, m across, for floors that are displaced.
  faces({ surfaces, gap }, moved) {
    const [left, right] = SIDES.map((side) => this.#face(surfaces[side], moved));
    const still = (side) => this.#face(surfaces[side], this.atRest());
    return [left ?? still("right") - gap, right ?? still("left") + gap];
  }

  // Level and place of the faces that a link joins; null for the ground.
  ends({ surfaces }, moved) {
    return SIDES.map((side) => {
      const x = this.#face(surfaces[side], moved);
      return x === null ? null : { x, level: this.#heightOf(surfaces[side]) };
    });
  }

  // Null for a wall.
  #face({ kind, building, floor, storey, position }, moved) {
    if (kind === "wall") return null;
    const edge = (at) => this.buildings[building].edges[at] + moved.floors[building][at];
    if (kind === "floor") return edge(floor);
    return bent(edge(storey - 1), edge(storey), this.leanOf(building, storey, moved), position);
  }
}

// Shape of a column between its floors, clamped at both ends.
const bend = (s) => s * s * (3 - 2 * s);

// Where columns are at a share of their height: their ends lean as the foundation does.
export const bent = (low, high, lean, share) => low + (high - low - lean) * bend(share) + lean * share;

const ends = (values) => values.reduce(([low, high], value) => [Math.min(low, value), Math.max(high, value)], [0, 0]);

function interpolate(points, at) {
  const next = points.findIndex(([x]) => x >= at);
  if (next <= 0) return next === 0 ? points[0][1] : points.at(-1)[1];
  const [[x0, y0], [x1, y1]] = [points[next - 1], points[next]];
  return x1 > x0 ? y0 + ((at - x0) / (x1 - x0)) * (y1 - y0) : y1;
}
