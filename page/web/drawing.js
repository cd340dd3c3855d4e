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

// How a picture is laid out in a rectangle of the canvas: pixels per m across and per level upwards.
export function layOut(geometry, box, reach, size) {
  const two = geometry.sides.length === 2;
  const pit = Object.keys(geometry.soil).length > 0 ? PIT : 0;
  const height = box.height - 74 - pit;
  const up = height / (geometry.top - geometry.bottom);
  const width = Math.max(44, Math.min(0.3 * box.width, 0.62 * height, 210));
  const room = Math.max(16, Math.min(0.15 * box.width, (0.92 * box.width - (two ? 2 : 1) * width) / 2.6));
  const across = (room / Math.max(reach, geometry.gap, 1e-6)) * 2 ** size;
  const middle = geometry.sides.includes("left") ? (two ? geometry.gap / 2 : -width / across / 2) : width / across / 2;
  const x = (metres) => box.x + box.width / 2 + (metres - middle) * across;
  const y = (level) => box.y + box.height - 36 - pit - (level - geometry.bottom) * up;
  return { box, up, across, x, y, width, farthest: reach * across };
}

export class Drawing {
  constructor(context, geometry, place, colours) {
    Object.assign(this, { context, geometry, place, colours });
    const storeys = Math.max(geometry.floors.left, geometry.floors.right);
    const storey = ((geometry.top - geometry.bottom) * place.up) / Math.max(1, storeys);
    this.storey = storey;
    this.largestFlash = Math.max(14, 0.5 * storey + 4);
    this.slab = Math.max(1, Math.min(11, 0.16 * storey));
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
    for (const side of Object.keys(this.geometry.soil)) this.#foundation(side, moved);
    for (const side of this.geometry.sides) this.#building(side, moved, yielding);
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
    const { x, width } = place.box;
    context.fillStyle = colours.line;
    const levels = geometry.sides.map((side) => this.#groundOf(side));
    const middle = place.x(geometry.gap / 2);
    levels.forEach((level, at) => {
      const [from, to] = levels.length === 1 ? [x, x + width] : at === 0 ? [x, middle] : [middle, x + width];
      context.fillRect(from, level, to - from, 5);
    });
    const bottom = place.box.y + place.box.height;
    for (const side of geometry.sides)
      this.#text(side, this.#centre(side), bottom - 12, side === "right" ? "right-text" : side, "center");
    if (ground) this.#arrow(place.x(geometry.gap / 2), bottom - 22, ground);
  }

  // What a building stands on, in pixels.
  #groundOf(side) {
    return this.place.y(this.geometry.levels[side][0]) + (this.geometry.soil[side] ? PIT : 0);
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

  #centre(side) {
    const { place, geometry } = this;
    return place.x(geometry.inner[side][0]) + (side === "left" ? -place.width / 2 : place.width / 2);
  }

  #wall(contact) {
    const { context, place, geometry, colours } = this;
    const faces = geometry.faces(contact, geometry.atRest(), place.width / place.across);
    const onLeft = contact.wall === "left";
    const face = place.x(faces[onLeft ? 0 : 1]);
    const top = place.y(contact.height) - 14;
    context.fillStyle = this.hatch.quiet;
    context.strokeStyle = colours.quiet;
    context.lineWidth = 1.5;
    const far = onLeft ? Math.max(place.box.x, face - 46) : Math.min(place.box.x + place.box.width, face + 46);
    const [from, to] = onLeft ? [far, face] : [face, far];
    const bottom = Math.max(...geometry.sides.map((side) => this.#groundOf(side)), place.y(geometry.bottom)) + 5;
    context.fillRect(from, top, to - from, bottom - top);
    context.strokeRect(from, top, to - from, bottom - top);
  }

  // Left ends of the foundation and of all slabs.
  #edges(side, moved) {
    const { place, geometry } = this;
    return moved[side].map(
      (u, floor) => place.x(geometry.inner[side][floor] + u) + (side === "left" ? -place.width : 0),
    );
  }

  // A block, what it rocks on below it, and beside it what holds its sway on the ground, away from the gap.
  #foundation(side, moved) {
    const { context, place, geometry, colours } = this;
    const { sway, rocking } = geometry.soil[side];
    const [top, ground] = [place.y(geometry.levels[side][0]), this.#groundOf(side)];
    const [rest, x] = [geometry.atRest(), moved].map((at) => this.#edges(side, at)[0] - OUT);
    const [wide, slope] = [place.width + 2 * OUT, this.#slope(side, 1, moved)];
    const soil = new Devices(context, colours, Infinity);
    for (const sign of [-1, 1]) {
      rocking.forEach((part, at) => {
        const aside = sign * (wide / 2 - POST - at * BESIDE);
        const from = { x: rest + wide / 2 + aside, y: ground };
        const to = { x: x + wide / 2 + aside, y: top + THICK + slope * aside };
        soil.upright(part, from, to, ground - top - THICK);
      });
    }
    if (sway.length > 0) this.#sway(soil, side, sway, { top, rest, x, wide });
    this.#tilted(side, { x, y: top + THICK / 2, wide, high: THICK, slope });
  }

  #sway(soil, side, parts, { top, rest, x, wide }) {
    const away = TO_GROUND + this.place.farthest;
    const [ground, block] = side === "left" ? [rest - away, x] : [rest + wide + away, x + wide];
    const ends = [ground, block].map((at) => ({ x: at, y: top }));
    const [from, to] = side === "left" ? ends : ends.reverse();
    soil.draw({ parts, from, to, rest: away, keys: [side], slab: 0, grounded: side, slips: false });
  }

  // Pixels down for each pixel to the right: slabs are at a right angle to what leans with the foundation.
  #slope(side, storey, moved) {
    const { place, geometry } = this;
    const high = geometry.levels[side][storey] - geometry.levels[side][storey - 1];
    return (geometry.leanOf(side, storey, moved) * place.across) / (high * place.up);
  }

  #building(side, moved, yielding) {
    const { context, place, geometry, colours } = this;
    const edges = this.#edges(side, moved);
    const levels = geometry.levels[side].map(place.y);
    const inset = geometry.hit[side] ? 0 : Math.min(10, 0.07 * place.width);
    const offsets = [inset + this.column / 2, place.width - inset - this.column / 2];
    for (let storey = 1; storey < edges.length; storey++) {
      const yields = yielding?.[side]?.[storey];
      context.strokeStyle = colours[side];
      context.lineWidth = yields ? this.column + 2 : this.column;
      context.setLineDash(yields ? [5, 3] : []);
      const lean = geometry.leanOf(side, storey, moved) * place.across;
      const slope = this.#slope(side, storey, moved);
      for (const offset of offsets) {
        const down = slope * (offset - place.width / 2);
        this.#columnLine(edges, levels, { storey, offset, lean, down });
      }
    }
    context.setLineDash([]);
    for (let floor = 1; floor < edges.length; floor++) {
      const slope = this.#slope(side, floor, moved);
      this.#tilted(side, { x: edges[floor], y: levels[floor], wide: place.width, high: this.slab, slope });
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
  #tilted(side, { x, y, wide, high, slope }) {
    const { context, colours } = this;
    context.save();
    context.transform(1, slope, 0, 1, 0, -slope * (x + wide / 2));
    context.fillStyle = colours[side];
    context.fillRect(x, y - high / 2, wide, high);
    if (side === "right" && high >= 4) {
      context.fillStyle = this.hatch.right;
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
      const keys = SIDES.map((side) => `${side} ${link.surfaces[side].floor ?? link.surfaces[other(side)].floor}`);
      const length = Math.hypot(rest[1].x - rest[0].x, rest[1].y - rest[0].y);
      const grounded = SIDES.find((side) => link.surfaces[side].kind === "wall");
      devices.draw({ parts: link.parts, from, to, rest: length, keys, slab, grounded, slips: slipping[at] });
    });
  }

  // Where a link begins and ends, in pixels; what is on the ground stays where it is at rest.
  #linkAt(link, moved, rest) {
    const { place, geometry } = this;
    const inset = Math.min(INSET, 0.3 * place.width);
    const points = geometry.ends(link, moved, place.width / place.across).map((end, at) => {
      return end && { x: place.x(end.x) + (at === 0 ? -inset : inset), y: place.y(end.level) };
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
      const [left, right] = geometry.faces(contact, moved, place.width / place.across);
      const number = {
        x: place.x((left + right) / 2),
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
    const [left, right] = geometry.faces(pair, moved, place.width / place.across);
    const [x, y] = [
      place.x(pair.wall === "right" ? right : pair.wall === "left" ? left : (left + right) / 2),
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

// Stripes, for slabs of the right building and for walls.
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
  return { right: stripes(colours.card, 0.6), quiet: stripes(colours.quiet) };
}

const other = (side) => SIDES.find((one) => one !== side);
