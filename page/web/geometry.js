// Where buildings, foundations, contacts and walls stand at rest: across in m from the left building's edge at the gap, upwards by
// the levels of the scene, or, without them, with all storeys equally high.

import { SIDES } from "./motion.js";

// m between buildings of which no contact says how far apart they are.
const USUAL_GAP = 0.05;

export class Geometry {
  constructor({ layout }) {
    this.sides = SIDES.filter((side) => layout[side]?.floors > 0);
    this.hasLevels = this.sides.every((side) => layout[side].levels);
    this.floors = Object.fromEntries(SIDES.map((side) => [side, layout[side]?.floors ?? 0]));
    this.levels = Object.fromEntries(SIDES.map((side) => [side, this.#levelsOf(layout[side])]));
    // m, from floor to floor, where the scene says it.
    const told = (side) => layout[side]?.levels ?? [];
    this.heights = Object.fromEntries(SIDES.map((side) => [side, told(side).slice(1).map((l, at) => l - told(side)[at])]));
    // What the soil under each foundation is made of.
    this.soil = Object.fromEntries(this.sides.map((side) => [side, layout[side].foundation]).filter(([, soil]) => soil));
    const all = SIDES.flatMap((side) => this.levels[side]);
    [this.bottom, this.top] = [Math.min(0, ...ends(all)), Math.max(...ends(all), 1e-9)];
    this.contacts = layout.contacts.map((contact) => this.#contactOf(contact));
    this.inner = { left: this.levels.left.map(() => 0), right: this.#innerRight() };
    this.hit = Object.fromEntries(
      SIDES.map((side) => [side, this.contacts.some((contact) => contact.columns === side)]),
    );
    this.gap = this.contacts.reduce((most, { gap }) => Math.max(most, Math.abs(gap)), 0);
    this.walls = this.contacts.filter((contact) => contact.wall);
    this.links = layout.links.map(({ left, right, parts }) => ({ surfaces: { left, right }, parts }));
  }

  #levelsOf(building) {
    if (!building?.floors) return [];
    return this.hasLevels ? building.levels : Array.from({ length: building.floors + 1 }, (_, floor) => floor);
  }

  // What the picture needs of a contact: its gap, its height, and what is on each side of it.
  #contactOf({ left, right, gap, meeting, law }) {
    const surfaces = { left, right };
    const heights = Object.values(surfaces)
      .map((surface) => this.#heightOf(surface))
      .filter((height) => height !== null);
    const height = heights.reduce((sum, one) => sum + one, 0) / heights.length;
    const columns = Object.values(surfaces).find((surface) => surface.kind === "columns")?.side ?? null;
    const wall = SIDES.find((side) => surfaces[side].kind === "wall") ?? null;
    return { surfaces, gap, meeting, law, height, columns, wall };
  }

  #heightOf({ kind, side, floor, storey, position }) {
    if (kind === "floor") return this.levels[side][floor];
    if (kind === "wall") return null;
    const [below, above] = [this.levels[side][storey - 1], this.levels[side][storey]];
    return below + position * (above - below);
  }

  // Between contacts the gap goes on as a line, beyond them as it is.
  #innerRight() {
    const between = this.contacts.filter(({ wall }) => !wall);
    const known = between.map(({ height, gap }) => [height, gap]).sort(([a], [b]) => a - b);
    if (known.length === 0) known.push([0, USUAL_GAP]);
    return this.levels.right.map((level) => interpolate(known, level));
  }

  // Displacements of floors and rotations of foundations that have not moved.
  atRest() {
    const still = Object.fromEntries(SIDES.map((side) => [side, this.levels[side].map(() => 0)]));
    return { ...still, turned: { left: 0, right: 0 } };
  }

  // m by which a storey leans with its foundation.
  leanOf(side, storey, moved) {
    return moved.turned[side] ? this.heights[side][storey - 1] * moved.turned[side] : 0;
  }

  // Left and right side of the gap of a contact, m across, for floors that are displaced; `width` is that of a
  // building.
  faces({ surfaces, gap }, moved, width) {
    const [left, right] = SIDES.map((on) => this.#face(surfaces[on], on, moved, width));
    const still = (on) => this.#face(surfaces[on], on, this.atRest(), width);
    return [left ?? still("right") - gap, right ?? still("left") + gap];
  }

  // Level and place of the faces that a link joins; null for the ground.
  ends({ surfaces }, moved, width) {
    return SIDES.map((on) => {
      const x = this.#face(surfaces[on], on, moved, width);
      return x === null ? null : { x, level: this.#heightOf(surfaces[on]) };
    });
  }

  // That of a building which is on the given side of the gap; null for a wall.
  #face(surface, on, moved, width) {
    if (surface.kind === "wall") return null;
    const { side } = surface;
    const edge = (floor) => this.inner[side][floor] + moved[side][floor];
    const x = surface.kind === "floor" ? edge(surface.floor) : this.#bent(surface, edge, this.leanOf(side, surface.storey, moved));
    return side === on ? x : x + (side === "left" ? -width : width);
  }

  #bent({ storey, position }, edge, lean) {
    return bent(edge(storey - 1), edge(storey), lean, position);
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
