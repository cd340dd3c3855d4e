// Loops: force over penetration of an impact, storey shear over drift of storeys that can yield, force over displacement
// of links. What one encloses is lost.

import { digits, handyUnit, largestOf, quantity, seconds, withUnit } from "./format.js";
import { element, make, onceAFrame } from "./make.js";
import { kindOf, namesOf, rowBefore } from "./motion.js";
import { chartedOf } from "./pair.js";
import { colour } from "./palette.js";
import { endOf, hardestOf } from "./strength.js";
import { drawAxes } from "./xy.js";

const MOST_STOREYS = 12;
const MOST_LINKS = 12;

export class Loops {
  constructor(state) {
    Object.assign(this, { state, figures: [] });
    this.redraw = onceAFrame(() => this.#redraw());
    state.on(["run", "chosen", "buildings"], () => this.draw());
    state.on(["time", "colours"], this.redraw);
    new ResizeObserver(this.redraw).observe(element("panel-loops"));
  }

  draw() {
    const { run } = this.state;
    const panel = element("panel-loops");
    panel.replaceChildren();
    this.figures = [this.#impact(), ...this.#links(), ...this.#storeys()].filter(Boolean);
    if (this.figures.length === 0)
      make(panel, "p", "No impact that presses with a force over a penetration, no link, and no storey that can yield.", {
        class: "hint",
      });
    for (const figure of this.figures) {
      const box = make(panel, "figure");
      make(box, "figcaption", figure.caption);
      figure.canvas = make(box, "canvas", "", { role: "img", "aria-label": figure.caption });
    }
    this.redraw();
  }

  // That which was chosen, else the hardest.
  #impact() {
    const { run, chosen } = this.state;
    const impact = run.impacts.includes(chosen) ? chosen : hardestOf(run.impacts);
    const [force, depth] = impact
      ? ["force", "penetration"].map((part) => run.columns[`contact[${impact.contact}].${part}`])
      : [];
    if (!force || !depth || !impact.peak_force) return null;
    const end = endOf(impact, run);
    const [from, to] = [rowBefore(run.time, impact.start_s), rowBefore(run.time, end) + 2];
    const inside = Array.from(run.time.subarray(from, to), (time, at) => [time, from + at]).filter(
      ([time]) => time >= impact.start_s && time <= end,
    );
    const rows = inside.map(([, row]) => row);
    const [largest, lost] = [quantity(impact.peak_force, "N"), quantity(impact.dissipated_energy, "J", 3)];
    const which = impact === chosen ? "Impact" : "Hardest impact";
    return {
      caption: `${which}, contact ${impact.contact} at ${seconds(impact.start_s)} s: ${largest}, ${lost} lost`,
      x: rows.map((row) => depth[row]),
      y: rows.map((row) => force[row]),
      times: rows.map((row) => run.time[row]),
      titles: ["penetration", "force"],
      units: ["m", "N"],
      ink: "ink",
    };
  }

  // Of many those with the largest force.
  #links() {
    const { columns, look, time } = this.state.run;
    const of = (link, part) => columns[`link[${link}].${part}`];
    const known = look.layout.links.map((device, at) => ({ ...device, link: at + 1 }));
    const figures = known.flatMap(({ link, meeting, parts }) => {
      const [force, displacement] = ["force", "displacement"].map((part) => of(link, part));
      if (!force || !displacement) return [];
      const largest = largestOf(force);
      const figure = {
        caption: `Link ${link} ${meeting}, ${parts.join(" and ")}: ${quantity(largest, "N", 3)}`,
        x: displacement,
        y: force,
        times: time,
        titles: ["displacement", "force"],
        units: ["m", "N"],
        ink: "ink",
      };
      return [{ largest, figure }];
    });
    figures.sort((a, b) => b.largest - a.largest);
    return figures.slice(0, MOST_LINKS).map(({ figure }) => figure);
  }

  // Of many those with the largest ductility.
  #storeys() {
    const { run } = this.state;
    const charted = chartedOf(this.state, run.look);
    const buildings = run.look.buildings.filter(({ name }) => charted.includes(name));
    const storeys = buildings.flatMap(({ name, yields, heights }) =>
      yields.map((can, at) => can && { building: name, height: heights?.[at], storey: at + 1 }).filter(Boolean),
    );
    for (const one of storeys) one.ductility = run.columns[`${one.building}.ductility[${one.storey}]`]?.at(-1) ?? 0;
    storeys.sort((a, b) => b.ductility - a.ductility);
    return storeys.slice(0, MOST_STOREYS).map((one) => this.#storey(one));
  }

  #storey({ building, height, storey, ductility }) {
    const { columns, look, time } = this.state.run;
    const shear = columns[`${building}.storey_shear[${storey}]`];
    const drift = driftOf(columns, { building, height, storey });
    if (!shear || !drift) return null;
    return {
      caption: `${building} storey ${storey}: ductility ${digits(ductility, 3)}`,
      x: drift,
      y: shear,
      times: time,
      titles: ["drift", "shear"],
      units: ["m", "N"],
      ink: kindOf(namesOf(look), building),
    };
  }

  #redraw() {
    if (element("panel-loops").hidden) return;
    for (const figure of this.figures) this.#drawOne(figure);
  }

  // A dot where the run is.
  #drawOne({ canvas, x, y, times, titles, units, ink }) {
    const [across, up] = [handyUnit(largestOf(x), units[0]), handyUnit(largestOf(y), units[1])];
    const at = (row) => [x[row] * across.factor, y[row] * up.factor];
    const { context, place } = drawAxes(canvas, {
      x: extent(x, across.factor),
      y: extent(y, up.factor),
      xTitle: withUnit(titles[0], across),
      yTitle: withUnit(titles[1], up),
    });
    context.strokeStyle = colour(ink);
    context.lineWidth = 1.3;
    context.beginPath();
    for (let row = 0; row < x.length; row++) context.lineTo(...place(...at(row)));
    context.stroke();
    const { time } = this.state;
    if (time < times[0] || time > times[times.length - 1]) return;
    context.fillStyle = colour("ink");
    context.beginPath();
    context.arc(...place(...at(rowBefore(times, time))), 4, 0, 2 * Math.PI);
    context.fill();
  }
}

// What strains the columns of a storey: without the part that leans with the foundation.
function driftOf(columns, { building, height, storey }) {
  const above = columns[`${building}.displacement[${storey}]`];
  const below = columns[storey > 1 ? `${building}.displacement[${storey - 1}]` : `${building}.foundation.displacement`];
  const rotation = columns[`${building}.foundation.rotation`];
  return above?.map((value, row) => value - (below?.[row] ?? 0) - (rotation ? height * rotation[row] : 0));
}

function extent(values, factor) {
  let [low, high] = [0, 0];
  for (const value of values) {
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  return [low * factor, high * factor];
}
