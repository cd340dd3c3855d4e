// Axes on a canvas for a curve that is not over time: round numbers along both, a name for each.

import { digits } from "./format.js";
import { colour } from "./palette.js";

const LEFT = 52;
const BOTTOM = 34;
const EDGE = 10;

// Draws them, and returns where a point is.
export function drawAxes(canvas, { x, y, xTitle, yTitle }) {
  const { clientWidth: width, clientHeight: height } = canvas;
  const ratio = devicePixelRatio || 1;
  Object.assign(canvas, { width: Math.round(width * ratio), height: Math.round(height * ratio) });
  const context = canvas.getContext("2d");
  context.scale(ratio, ratio);
  const [across, up] = [roomy(x), roomy(y)];
  const place = (a, b) => [
    LEFT + ((a - across[0]) / (across[1] - across[0])) * (width - LEFT - EDGE),
    height - BOTTOM - ((b - up[0]) / (up[1] - up[0])) * (height - BOTTOM - EDGE),
  ];
  context.font = "11px system-ui, sans-serif";
  context.fillStyle = colour("quiet");
  for (const tick of ticks(across, width / 90)) line(context, tick, [place(tick, up[0]), place(tick, up[1])], "x");
  for (const tick of ticks(up, height / 45)) line(context, tick, [place(across[0], tick), place(across[1], tick)], "y");
  context.textAlign = "center";
  context.fillText(xTitle, (LEFT + width - EDGE) / 2, height - 4);
  context.save();
  context.translate(11, (height - BOTTOM + EDGE) / 2);
  context.rotate(-Math.PI / 2);
  context.fillText(yTitle, 0, 0);
  context.restore();
  context.lineJoin = "round";
  return { context, place };
}

function line(context, tick, [from, to], axis) {
  context.strokeStyle = colour(tick === 0 ? "quiet" : "grid");
  context.lineWidth = 1;
  context.beginPath();
  context.moveTo(...from);
  context.lineTo(...to);
  context.stroke();
  context.textAlign = axis === "x" ? "center" : "right";
  if (axis === "x") context.fillText(digits(tick), from[0], from[1] + 14);
  else context.fillText(digits(tick), from[0] - 5, from[1] + 4);
}

function roomy([low, high]) {
  const room = 0.06 * (high - low || 1);
  return [low - (low < 0 ? room : 0), high + room];
}

// Multiples of 1, 2 or 5 times a power of ten, about as many as asked for.
function ticks([low, high], count) {
  const rough = (high - low) / Math.max(2, count);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].find((digit) => digit * power >= rough) * power;
  const found = [];
  for (let at = Math.ceil(low / step); at * step <= high; at++) found.push(Number((at * step).toPrecision(12)));
  return found;
}
