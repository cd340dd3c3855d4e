// Links as engineers draw them, on a canvas: springs as zigzags, dashpots as pistons in cups, friction as a block
// between two plates behind its spring; side by side what is parallel, hung below the slabs that they join. Soil under
// foundations is drawn of the same parts.

const TEETH = 4;
const DEVICE_LINE = 1.6;
// Pixels: half the height of a part, the room between two of them, how far below a slab the first one hangs.
const HALF = 6;
const BETWEEN = 5;
const BELOW = 9;
// Storeys that are lower than this, in pixels, have room for lines only.
const LOWEST_STOREY = 26;
// Pixels of a cup and of a block.
const CUP = 20;
const BLOCK = 12;
// Pixels that a part has to be drawn in; a line where there are fewer.
const NARROWEST_PART = 30;

export class Devices {
  // `storey` is the height of a storey in pixels.
  constructor(context, colours, storey) {
    Object.assign(this, { context, colours, isSmall: storey < LOWEST_STOREY });
    this.hung = new Map();
  }

  // A link between two points of slabs, `rest` pixels long at rest; `keys` say which slabs, so that the next one there
  // hangs lower. `grounded`: the side of an end that the ground holds; `slips`: its block does at this moment.
  draw({ parts, from, to, rest, keys, slab, grounded, slips }) {
    const { context, colours } = this;
    context.strokeStyle = colours.ink;
    context.lineWidth = DEVICE_LINE;
    context.setLineDash([]);
    const first = Math.max(...keys.map((key) => this.hung.get(key) ?? 0));
    for (const key of keys) this.hung.set(key, first + parts.length);
    const depth = (row) => slab / 2 + BELOW + (this.isSmall ? 0 : row * (2 * HALF + BETWEEN));
    const lowest = depth(first + parts.length - 1);
    for (const end of [from, to]) this.#line([end.x, end.y], [end.x, end.y + lowest]);
    if (grounded) this.#support(grounded === "left" ? from : to, grounded, lowest);
    parts.forEach((part, row) => {
      const below = depth(first + row);
      this.#part(part, { x: from.x, y: from.y + below }, { x: to.x, y: to.y + below }, rest, slips);
    });
  }

  // A part from one point to another.
  upright(part, from, to, rest) {
    Object.assign(this.context, { strokeStyle: this.colours.ink, lineWidth: DEVICE_LINE });
    this.context.setLineDash([]);
    this.#part(part, from, to, rest, false);
  }

  // What a link on the ground ends at.
  #support({ x, y }, side, lowest) {
    const { context } = this;
    const away = side === "left" ? -1 : 1;
    context.lineWidth = 1;
    for (let at = y; at <= y + lowest; at += 7) this.#line([x, at], [x + 6 * away, at + 6]);
    context.lineWidth = DEVICE_LINE;
  }

  #part(part, from, to, rest, slips) {
    const { context } = this;
    const length = Math.hypot(to.x - from.x, to.y - from.y);
    context.save();
    context.translate(from.x, from.y);
    context.rotate(Math.atan2(to.y - from.y, to.x - from.x));
    if (this.isSmall || length < NARROWEST_PART) this.#line([0, 0], [length, 0]);
    else if (part === "spring") this.#spring(length);
    else if (part === "dashpot") this.#dashpot(length, rest);
    else this.#friction(length, slips);
    context.restore();
  }

  #line(...points) {
    const { context } = this;
    context.beginPath();
    for (const [x, y] of points) context.lineTo(x, y);
    context.stroke();
  }

  #spring(length) {
    const lead = 0.15 * length;
    const step = (length - 2 * lead) / (2 * TEETH);
    const bends = Array.from({ length: 2 * TEETH }, (_, at) => [lead + (at + 0.5) * step, at % 2 ? HALF : -HALF]);
    this.#line([0, 0], [lead, 0], ...bends, [length - lead, 0], [length, 0]);
  }

  // Its rod and what holds its cup are as long as at rest: the piston moves in the cup, at most from end to end.
  #dashpot(length, rest) {
    const bottom = Math.max(CUP, length - 0.32 * rest);
    const open = bottom - CUP;
    const piston = Math.min(bottom - 3, Math.max(open + 3, 0.68 * rest - CUP / 2));
    this.#line([0, 0], [piston, 0]);
    this.#line([piston, 1 - HALF], [piston, HALF - 1]);
    this.#line([open, -HALF], [bottom, -HALF], [bottom, HALF], [open, HALF]);
    this.#line([bottom, 0], [length, 0]);
  }

  #friction(length, slips) {
    const { context, colours } = this;
    const block = length - 0.12 * length - BLOCK;
    this.#spring(block);
    context.fillStyle = slips ? colours.flash : colours.card;
    context.fillRect(block, 3 - HALF, BLOCK, 2 * HALF - 6);
    context.strokeRect(block, 3 - HALF, BLOCK, 2 * HALF - 6);
    for (const plate of [-HALF, HALF]) this.#line([block - 3, plate], [block + BLOCK + 3, plate]);
    this.#line([block + BLOCK, 0], [length, 0]);
  }
}
