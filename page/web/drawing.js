// One picture of the buildings on a canvas: ground, foundations, slabs, columns, walls, contacts, links, and the impacts
// that have just been. The report of a run has it as well, at rest (simulate/src/report.rs).

import { Devices } from "./devices.js";
import { bent } from "./geometry.js";
import { SIDES } from "./motion.js";

const COLUMN_POINTS = 12;
const MOST_NUMBERS = 12;
// Pixels, the radius of a number's circle.
const NUMBER = 8;
// Pixels: how far from the edge of a slab a link begins, and how far from the edge the ground holds a link, beyond the
// farthest that a floor goes.
const INSET = 24;
const TO_GROUND = 30;
// Pixels of a foundation: its thickness, how far it stands out, from its ends to what it rocks on, from one part of that
// to the next, and from the level of the ground floor to the bottom of the pit.
const THICK = 12;
const OUT = 6;
const POST = 14;
const BESIDE = 20;
const PIT = 54;
// Pixels below the ground, of a letter of a name, of the longest name that stands upright, from one upright name to the next.
const FOOT = 36;
const LETTER = 7;
const LONGEST_NAME = 84;
const NAME_LINE = 13;
// Pixels of a building in a row whose soil there is room for: below narrower ones stands one part on each side.
const ROOMY = 120;
// Pixels of a wall beside the row, and between two buildings.
const WALL = 46;
const THIN_WALL = 8;

// How a picture is laid out in a rectangle of the canvas: pixels per m across and per level upwards. Buildings are equally wide.
export function layOut(geometry, box, reach, size) {
  const count = geometry.buildings.length;
  const most = Math.max(2, count);
  const pit = geometry.hasSoil ? PIT : 0;
  const longest = LETTER * Math.max(...geometry.names.map(({ length }) => length));
  const isUpright = count > 2 && longest > (0.75 * box.width) / count - LETTER;
  const foot = FOOT + (isUpright ? Math.min(longest, LONGEST_NAME) : 0);
  const height = box.height - 38 - foot - pit;
  const up = height / (geometry.top - geometry.bottom);
  const width = Math.min((0.6 * box.width) / most, 0.62 * height, 210);
  const unit = Math.max(reach, geometry.gap, 1e-6);
  const rooms = Math.max(2.6, geometry.span / unit + 1.6);
  const room = Math.min(0.15 * box.width, (0.92 * box.width - count * width) / rooms);
  const across = (room / unit) * 2 ** size;
  // Of a place in m behind so many buildings.
  const x = (metres, passed) =>
    box.x + box.width / 2 + (metres - geometry.span / 2) * across + (passed - count / 2) * width;
  const y = (level) => box.y + box.height - foot - pit - (level - geometry.bottom) * up;
  return { box, up, across, x, y, width, isUpright, base: box.y + box.height - foot, farthest: reach * across };
}

export class Drawing {
  constructor(context, geometry, place, colours) {
    Object.assign(this, { context, geometry, place, colours });
    const storeys = Math.max(1, ...geometry.buildings.map(({ levels }) => levels.length - 1));
    const storey = ((geometry.top - geometry.bottom) * place.up) / storeys;
    this.storey = storey;
    this.largestFlash = Math.max(14, 0.5 * storey + 4);
    this.slab = Math.max(1, Math.min(11, 0.16 * storey));
    this.isCrowded = geometry.buildings.length > 2 && place.width < ROOMY;
    this.out = geometry.buildings.length > 2 ? 0 : OUT;
    this.column = Math.max(1.5, Math.min(6, 0.035 * place.width));
    this.hatch = makeHatch(context, colours);
  }

  // The moment: displacements, which storeys yield, which links slip, and the flashes.
  draw({ moved, yielding, slipping, flashes, ground, caption, numbered }) {
    const { context, place } = this;
    context.save();
    context.beginPath();
    context.rect(place.box.x, place.box.y, place.box.width, place.box.height);
    context.clip();
    this.#ground(ground);
    for (const wall of this.geometry.walls) this.#wall(wall);
    this.geometry.buildings.forEach(({ soil }, at) => soil && this.#foundation(at, moved));
    this.geometry.buildings.forEach((_, at) => this.#building(at, moved, yielding));
    this.#links(moved, slipping);
    for (const flash of flashes) this.#flash(flash, moved);
    if (numbered) this.#numbers(moved);
    if (caption) this.#text(caption, place.box.x + place.box.width / 2, place.box.y + 14, "quiet", "center");
    context.restore();
  }

  #text(text, x, y, name, align = "left", size = 12) {
    const { context, colours } = this;
    context.font = `${size}px system-ui, sans-serif`;
    context.textAlign = align;
    context.fillStyle = colours[name];
    context.fillText(text, x, y);
  }

  #ground(ground) {
    const { context, place, colours, geometry } = this;
    const { buildings } = geometry;
    context.fillStyle = colours.line;
    buildings.forEach((_, at) => {
      const [from, to] = [this.#border(at), this.#border(at + 1)];
      context.fillRect(from, this.#groundOf(at), to - from, 5);
    });
    buildings.forEach((_, at) => this.#name(at));
    if (ground) this.#arrow(this.#amidGap(Math.ceil(buildings.length / 2)), place.base + 14, ground);
  }

  // Where the ground of one building ends and that of the next one begins, in pixels.
  #border(passed) {
    const { box } = this.place;
    if (passed === 0) return box.x;
    return passed === this.geometry.buildings.length ? box.x + box.width : this.#amidGap(passed);
  }

  // Between two buildings, or at the edge of the last one.
  #amidGap(passed) {
    const { edges } = this.geometry.buildings[passed - 1];
    const next = this.geometry.buildings[passed]?.edges ?? edges;
    return this.place.x((edges[0] + next[0]) / 2, passed);
  }

  // Below its building; upright where there is no room, and not of every building where there is none for that either.
  #name(at) {
    const { context, place, geometry } = this;
    const { name, kind, edges } = geometry.buildings[at];
    const x = place.x(edges[0], at) + place.width / 2;
    const colour = { left: "left", right: "right-text" }[kind] ?? "ink";
    if (!place.isUpright) return this.#text(name, x, place.base + 24, colour, "center");
    const every = Math.ceil(NAME_LINE / (place.box.width / geometry.buildings.length));
    if (at % every !== 0) return;
    context.save();
    context.translate(x + 4, place.base + 26);
    context.rotate(Math.PI / 2);
    this.#text(shortened(name), 0, 4, colour, "left", 11);
    context.restore();
  }

  // What a building stands on, in pixels.
  #groundOf(at) {
    const { levels, soil } = this.geometry.buildings[at];
    return this.place.y(levels[0]) + (soil ? PIT : 0);
  }

  // The acceleration of the ground, as long as its share of the peak.
  #arrow(x, y, { share }) {
    const { context, colours } = this;
    const length = 40 * share;
    if (Math.abs(length) < 3) return;
    context.strokeStyle = context.fillStyle = colours.ink;
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(x + length, y);
    context.stroke();
    const head = Math.sign(length) * 6;
    context.beginPath();
    context.moveTo(x + length + head, y);
    context.lineTo(x + length, y - 4);
    context.lineTo(x + length, y + 4);
    context.fill();
  }

  // One between two buildings is thin, so that its neighbour is seen.
  #wall(contact) {
    const { context, place, geometry, colours } = this;
    const faces = geometry.faces(contact, geometry.atRest());
    const onLeft = contact.wall === "left";
    const face = place.x(faces[onLeft ? 0 : 1], contact.passed);
    const top = place.y(contact.height) - 14;
    context.fillStyle = this.hatch.quiet;
    context.strokeStyle = colours.quiet;
    context.lineWidth = 1.5;
    const isOuter = contact.passed === (onLeft ? 0 : geometry.buildings.length);
    const thick = isOuter ? WALL : THIN_WALL;
    const far = onLeft ? Math.max(place.box.x, face - thick) : Math.min(place.box.x + place.box.width, face + thick);
    const [from, to] = onLeft ? [far, face] : [face, far];
    const bottom = Math.max(...geometry.buildings.map((_, at) => this.#groundOf(at)), place.y(geometry.bottom)) + 5;
    context.fillRect(from, top, to - from, bottom - top);
    context.strokeRect(from, top, to - from, bottom - top);
  }

  // Left ends of the foundation and of all slabs.
  #edges(at, moved) {
    const { edges } = this.geometry.buildings[at];
    return moved.floors[at].map((u, floor) => this.place.x(edges[floor] + u, at));
  }

  // A block, what it rocks on below it, and what holds its sway on the ground.
  #foundation(at, moved) {
    const { context, place, geometry, colours } = this;
    const { levels, soil } = geometry.buildings[at];
    const { sway } = soil;
    const rocking = this.isCrowded ? soil.rocking.slice(0, 1) : soil.rocking;
    const [top, ground] = [place.y(levels[0]), this.#groundOf(at)];
    const [rest, x] = [geometry.atRest(), moved].map((one) => this.#edges(at, one)[0] - this.out);
    const [wide, slope] = [place.width + 2 * this.out, this.#slope(at, 1, moved)];
    const devices = new Devices(context, colours, Infinity);
    for (const sign of [-1, 1]) {
      rocking.forEach((part, row) => {
        const aside = sign * (wide / 2 - Math.min(POST, wide / 4) - row * BESIDE);
        const from = { x: rest + wide / 2 + aside, y: ground };
        const to = { x: x + wide / 2 + aside, y: top + THICK + slope * aside };
        devices.upright(part, from, to, ground - top - THICK);
      });
    }
    if (sway.length > 0) this.#sway(devices, at, sway, { top, rest, x, wide, rocks: rocking.length > 0 });
    this.#tilted(at, { x, y: top + THICK / 2, wide, high: THICK, slope });
  }

  // Beside the first and the last building of a row, away from the others; below one that has neighbours on both
  // sides, where there is room.
  #sway(devices, at, parts, { top, rest, x, wide, rocks }) {
    const isLast = at > 0 && at === this.geometry.buildings.length - 1;
    const grounded = isLast ? "right" : "left";
    if (at > 0 && !isLast) {
      if (this.isCrowded && rocks) return;
      const [from, to] = [rest + wide / 4, x + (3 * wide) / 4].map((place) => ({ x: place, y: top + THICK }));
      return devices.draw({ parts, from, to, rest: wide / 2, keys: [at], slab: 0, grounded, slips: false });
    }
    const away = TO_GROUND + this.place.farthest;
    const [ground, block] = isLast ? [rest + wide + away, x + wide] : [rest - away, x];
    const ends = [ground, block].map((place) => ({ x: place, y: top }));
    const [from, to] = isLast ? ends.reverse() : ends;
    devices.draw({ parts, from, to, rest: away, keys: [at], slab: 0, grounded, slips: false });
  }

  // Pixels down for each pixel to the right: slabs are at a right angle to what leans with the foundation.
  #slope(at, storey, moved) {
    const { place, geometry } = this;
    const { levels } = geometry.buildings[at];
    const high = levels[storey] - levels[storey - 1];
    return (geometry.leanOf(at, storey, moved) * place.across) / (high * place.up);
  }

  #building(at, moved, yielding) {
    const { context, place, geometry, colours } = this;
    const { kind, isHit } = geometry.buildings[at];
    const edges = this.#edges(at, moved);
    const levels = geometry.buildings[at].levels.map(place.y);
    const inset = isHit ? 0 : Math.min(10, 0.07 * place.width);
    const offsets = [inset + this.column / 2, place.width - inset - this.column / 2];
    for (let storey = 1; storey < edges.length; storey++) {
      const yields = yielding?.[at]?.[storey];
      context.strokeStyle = colours[kind];
      context.lineWidth = yields ? this.column + 2 : this.column;
      context.setLineDash(yields ? [5, 3] : []);
      const lean = geometry.leanOf(at, storey, moved) * place.across;
      const slope = this.#slope(at, storey, moved);
      for (const offset of offsets) {
        const down = slope * (offset - place.width / 2);
        this.#columnLine(edges, levels, { storey, offset, lean, down });
      }
    }
    context.setLineDash([]);
    for (let floor = 1; floor < edges.length; floor++) {
      const slope = this.#slope(at, floor, moved);
      this.#tilted(at, { x: edges[floor], y: levels[floor], wide: place.width, high: this.slab, slope });
    }
  }

  #columnLine(edges, levels, { storey, offset, lean, down }) {
    const { context } = this;
    const [low, high] = [edges[storey - 1] + offset, edges[storey] + offset];
    context.beginPath();
    for (let point = 0; point <= COLUMN_POINTS; point++) {
      const s = point / COLUMN_POINTS;
      const y = levels[storey - 1] + (levels[storey] - levels[storey - 1]) * s;
      context.lineTo(bent(low, high, lean, s), y + down);
    }
    context.stroke();
  }

  // A slab or a block about its middle.
  #tilted(at, { x, y, wide, high, slope }) {
    const { context, colours } = this;
    const { kind } = this.geometry.buildings[at];
    context.save();
    context.transform(1, slope, 0, 1, 0, -slope * (x + wide / 2));
    context.fillStyle = colours[kind];
    context.fillRect(x, y - high / 2, wide, high);
    if (at % 2 === 1 && high >= 4) {
      context.fillStyle = this.hatch.second;
      context.fillRect(x, y - high / 2, wide, high);
    }
    context.restore();
  }

  #links(moved, slipping) {
    const { geometry, slab } = this;
    const devices = new Devices(this.context, this.colours, this.storey);
    geometry.links.forEach((link, at) => {
      const rest = this.#linkAt(link, geometry.atRest());
      const [from, to] = this.#linkAt(link, moved, rest);
      const floorOf = (on) => link.surfaces[SIDES[on]].floor ?? link.surfaces[SIDES[1 - on]].floor;
      const keys = SIDES.map((side, on) => `${link.passed} ${side} ${floorOf(on)}`);
      const length = Math.hypot(rest[1].x - rest[0].x, rest[1].y - rest[0].y);
      const grounded = SIDES.find((side) => link.surfaces[side].kind === "wall");
      devices.draw({ parts: link.parts, from, to, rest: length, keys, slab, grounded, slips: slipping[at] });
    });
  }

  // Where a link begins and ends, in pixels; what is on the ground stays where it is at rest.
  #linkAt(link, moved, rest) {
    const { place, geometry } = this;
    const inset = Math.min(INSET, 0.3 * place.width);
    const points = geometry.ends(link, moved).map((end, at) => {
      return end && { x: place.x(end.x, link.passed) + (at === 0 ? -inset : inset), y: place.y(end.level) };
    });
    return points.map((point, at) => {
      const away = (at === 0 ? -1 : 1) * (inset + TO_GROUND + place.farthest);
      return point ?? rest?.[at] ?? { x: points[1 - at].x + away, y: points[1 - at].y };
    });
  }

  // The numbers of the contacts, as in the table, above what meets there; those that would cover others stand beside
  // them.
  #numbers(moved) {
    const { place, geometry } = this;
    if (geometry.contacts.length > MOST_NUMBERS) return;
    const placed = [];
    geometry.contacts.forEach((contact, at) => {
      const [left, right] = geometry.faces(contact, moved);
      const number = {
        x: place.x((left + right) / 2, contact.passed),
        y: place.y(contact.height) - this.slab / 2 - 13,
        text: String(at + 1),
      };
      while (placed.some((other) => Math.hypot(number.x - other.x, number.y - other.y) < 2 * NUMBER))
        number.x += 2 * NUMBER + 1;
      placed.push(number);
    });
    placed.forEach((number) => this.#number(number));
  }

  #number({ x, y, text }) {
    const { context, colours } = this;
    context.beginPath();
    context.arc(x, y, NUMBER, 0, 2 * Math.PI);
    context.fillStyle = colours.card;
    context.fill();
    context.strokeStyle = colours.quiet;
    context.lineWidth = 1;
    context.stroke();
    this.#text(text, x, y + 4, "ink", "center", 11);
  }

  // A star where two faces have met: as large as its force, fading.
  #flash({ contact, size, age }, moved) {
    const { context, place, geometry, colours } = this;
    const pair = geometry.contacts[contact - 1];
    if (!pair) return;
    const [left, right] = geometry.faces(pair, moved);
    const [x, y] = [
      place.x(pair.wall === "right" ? right : pair.wall === "left" ? left : (left + right) / 2, pair.passed),
      place.y(pair.height),
    ];
    const radius = Math.min(7 + 24 * size, this.largestFlash) * (1 - 0.35 * age);
    context.globalAlpha = 1 - age * age;
    context.beginPath();
    for (let point = 0; point < 20; point++) {
      const [far, angle] = [point % 2 ? 0.48 * radius : radius, (Math.PI * point) / 10];
      context.lineTo(x + far * Math.sin(angle), y - far * Math.cos(angle));
    }
    context.closePath();
    context.fillStyle = colours.flash;
    context.fill();
    context.strokeStyle = colours["flash-edge"];
    context.lineWidth = 1.5;
    context.stroke();
    context.globalAlpha = 1;
  }
}

// Stripes, for slabs of every second building and for walls.
function makeHatch(context, colours) {
  const stripes = (stroke, opacity = 1) => {
    const tile = document.createElement("canvas");
    tile.width = tile.height = 8;
    const pen = tile.getContext("2d");
    pen.strokeStyle = stroke;
    pen.globalAlpha = opacity;
    pen.lineWidth = 1.3;
    for (const from of [-8, 0, 8]) {
      pen.moveTo(from, 8);
      pen.lineTo(from + 8, 0);
    }
    pen.stroke();
    return context.createPattern(tile, "repeat");
  };
  return { second: stripes(colours.card, 0.6), quiet: stripes(colours.quiet) };
}

const shortened = (name) => (LETTER * name.length > LONGEST_NAME ? `${name.slice(0, LONGEST_NAME / LETTER - 1)}\u2026` : name);
