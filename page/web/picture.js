// The buildings, and below them all charts with their legends, as they are now: one picture.

import { colour } from "./palette.js";

const MARGIN = 16;
const KEY = 26;

// `parts` have a canvas, a title, and the lines of the legend: label, colour and dash; `words` stand below all.
export function drawPicture(parts, words) {
  const ratio = devicePixelRatio || 1;
  const line = 20 * ratio;
  const whole = document.createElement("canvas");
  const width = Math.max(...parts.map(({ canvas }) => canvas.width));
  whole.width = width + 2 * MARGIN;
  whole.height = parts.reduce((sum, { canvas }) => sum + canvas.height + line, 2 * MARGIN + 2 * line);
  const pen = whole.getContext("2d");
  pen.fillStyle = colour("card");
  pen.fillRect(0, 0, whole.width, whole.height);
  let y = MARGIN;
  for (const { canvas, title, lines } of parts) {
    drawHead(pen, { title, lines, y: y + 14 * ratio, ratio });
    // What is narrower stands in the middle.
    pen.drawImage(canvas, MARGIN + (width - canvas.width) / 2, y + line);
    y += canvas.height + line;
  }
  pen.font = `${12 * ratio}px system-ui, sans-serif`;
  pen.fillStyle = colour("ink");
  pen.fillText(words, MARGIN, y + line, whole.width - 2 * MARGIN);
  return new Promise((done) => whole.toBlob(done, "image/png"));
}

function drawHead(pen, { title, lines, y, ratio }) {
  pen.fillStyle = colour("ink");
  pen.font = `600 ${13 * ratio}px system-ui, sans-serif`;
  pen.fillText(title, MARGIN, y);
  let x = MARGIN + pen.measureText(title).width + 24 * ratio;
  pen.font = `${12 * ratio}px system-ui, sans-serif`;
  for (const { label, stroke, dash } of lines) {
    pen.strokeStyle = stroke;
    pen.lineWidth = 2 * ratio;
    pen.setLineDash(dash.map((length) => length * ratio));
    pen.beginPath();
    pen.moveTo(x, y - 4 * ratio);
    pen.lineTo(x + KEY * ratio, y - 4 * ratio);
    pen.stroke();
    pen.setLineDash([]);
    pen.fillText(label, x + (KEY + 6) * ratio, y);
    x += (KEY + 24) * ratio + pen.measureText(label).width;
  }
}
