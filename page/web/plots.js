// Charts as all of the page look: a heading with the legend beside it, a line each as it is drawn, thin axes.

import { digits } from "./format.js";
import { make } from "./make.js";
import { colour } from "./palette.js";

const NARROWEST = 200;

export const widthOf = (list) => Math.max(NARROWEST, list.clientWidth);

// A chart at the end of a list. `lines` have a label, a colour and a dash; `x` says the name of the first row of the
// legend, how a place along it is written there, and at the ticks; `options` are those of uPlot, put over what all
// charts have.
export function makePlot(list, { title, height, lines, data, x, options = {}, attributes = {} }) {
  const box = make(list, "div", "", { class: "chart", ...attributes });
  const head = make(box, "div", "", { class: "chart-head" });
  const heading = make(head, "h3", title);
  const axis = {
    stroke: colour("quiet"),
    grid: { stroke: colour("grid"), width: 1 },
    ticks: { show: false },
    font: "11px system-ui, sans-serif",
  };
  const series = lines.map(({ label, stroke, dash }) => ({
    label,
    stroke,
    dash,
    width: 1.4,
    pxAlign: 0,
    points: { show: false },
    value: (_, value) => digits(value),
  }));
  const all = {
    width: widthOf(list),
    height,
    padding: [8, 12, 0, 0],
    axes: [
      { ...axis, size: 24, values: (_, ticks) => ticks.map(x.tick) },
      { ...axis, size: 56, space: 26, values: (_, ticks) => ticks.map((tick) => digits(tick)) },
    ],
    series: [{ label: x.label, value: (_, at) => (at === null ? "" : x.text(at)) }, ...series],
    ...options,
  };
  const plot = new uPlot(all, data, box);
  const legend = plot.root.querySelector(".u-legend");
  head.append(legend);
  drawKeys(legend, series);
  plot.root.querySelector(".u-wrap").setAttribute("role", "img");
  if (data[0].length > 1) describePlot(plot, title);
  return { box, heading, plot };
}

// What a chart shows, for those who do not see it: each line with its least and its largest value.
export function describePlot(plot, title) {
  const said = plot.series
    .slice(1)
    .map(
      ({ label }, at) =>
        `${label} from ${digits(extremeOf(plot.data[at + 1], -1), 3)} to ${digits(extremeOf(plot.data[at + 1], 1), 3)}`,
    );
  plot.root.querySelector(".u-wrap").setAttribute("aria-label", `${title}: ${said.join("; ")}`);
}

// The least (-1) or the largest (1) of some numbers.
function extremeOf(values, sign) {
  let found = -Infinity;
  for (const value of values) if (sign * value > found) found = sign * value;
  return sign * found;
}

// A line from the bottom of a chart to its top.
export function drawUpright(plot, at, stroke, dash) {
  const { ctx: context, bbox } = plot;
  const ratio = devicePixelRatio || 1;
  const x = plot.valToPos(at, "x", true);
  context.strokeStyle = stroke;
  context.lineWidth = 1.6 * ratio;
  context.setLineDash(dash.map((length) => length * ratio));
  context.beginPath();
  context.moveTo(x, bbox.top);
  context.lineTo(x, bbox.top + bbox.height);
  context.stroke();
  return x;
}

// In the legend each line as it is drawn, where the library has a square.
function drawKeys(legend, series) {
  const marks = [...legend.querySelectorAll(".u-marker")].slice(-series.length);
  marks.forEach((mark, at) => {
    const key = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    const line = document.createElementNS("http://www.w3.org/2000/svg", "line");
    const look = {
      x1: 0,
      x2: 26,
      y1: 5,
      y2: 5,
      stroke: series[at].stroke,
      "stroke-width": 2,
      "stroke-dasharray": series[at].dash.join(" ") || "none",
    };
    Object.entries({ class: "line-key", width: 26, height: 10 }).forEach(([name, value]) =>
      key.setAttribute(name, value),
    );
    Object.entries(look).forEach(([name, value]) => line.setAttribute(name, value));
    key.append(line);
    mark.replaceWith(key);
  });
}
