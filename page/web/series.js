// Which columns of a run are drawn together, and as what: one entry for each chart.

import { largestOf } from "./format.js";
import { lineLook } from "./palette.js";
import { SIDES } from "./motion.js";

const MOST_LINES = 6;

// Columns of a run by what they are of: side or contact, quantity, number.
function columnsOf(run, whole, part) {
  const pattern = new RegExp(`^${whole}\\.${part}\\[(\\d+)\\]$`);
  return Object.keys(run.columns)
    .map((name) => [name, Number(name.match(pattern)?.[1])])
    .filter(([, number]) => number > 0);
}

// Those of the contacts or links of a run.
function numbered(run, what, part) {
  const count = { contact: run.look.contacts, link: run.look.layout.links }[what].length;
  return Array.from({ length: count }, (_, at) => [`${what}[${at + 1}].${part}`, at + 1]).filter(
    ([name]) => run.columns[name],
  );
}

// Links with the largest of a quantity.
function linkLines(run, part) {
  const most = ([name]) => largestOf(run.columns[name]);
  const largest = numbered(run, "link", part)
    .sort((a, b) => most(b) - most(a))
    .slice(0, MOST_LINES);
  return others(
    largest.sort(([, a], [, b]) => a - b),
    (number) => `link ${number}`,
  );
}

// Contacts that are worth a line: of many those with the hardest impacts.
function telling(run, columns) {
  if (columns.length <= MOST_LINES) return columns;
  const most = new Map();
  for (const { contact, peak_force, impulse } of run.impacts)
    most.set(contact, Math.max(most.get(contact) ?? 0, peak_force || impulse));
  const hardest = [...most]
    .sort(([, a], [, b]) => b - a)
    .slice(0, MOST_LINES)
    .map(([contact]) => contact);
  return columns.filter(([, contact]) => hardest.includes(contact) || hardest.length === 0).slice(0, MOST_LINES);
}

const others = (columns, label) =>
  columns.map(([name, number], at) => ({ name, label: label(number), look: () => lineLook("others", at) }));

// Floors that are drawn when nobody has chosen: roofs.
export function usualFloors(look) {
  return SIDES.filter((side) => look[side]?.floors > 0).map((side) => `${side} ${look[side].floors}`);
}

function floorLines(run, part, chosen) {
  return SIDES.flatMap((side) => {
    const drawn = columnsOf(run, side, part)
      .filter(([, floor]) => chosen.has(`${side} ${floor}`))
      .reverse();
    return drawn.map(([name, floor], at) => ({ name, label: `${side} ${floor}`, look: () => lineLook(side, at) }));
  });
}

// Of the foundations that move so.
function foundationLines(run, part) {
  const known = SIDES.map((side) => [`${side}.foundation.${part}`, side]).filter(([name]) => run.columns[name]);
  return known.map(([name, side]) => ({ name, label: side, look: () => lineLook(side, 0) }));
}

const ENERGIES = [
  "input",
  "external",
  "kinetic",
  "strain",
  "correction",
  "viscous",
  "soil",
  "hysteretic",
  "impact",
  "gravity",
];

const FOUNDATION_CHARTS = [
  ["displacement", "Displacement of foundations", "m"],
  ["rotation", "Rotation of foundations", "rad"],
  ["force", "Force on the soil", "N"],
  ["moment", "Moment on the soil", "N.m"],
];

// All charts of a run; those without lines are left out.
export function chartsOf(run, floors) {
  const energies = ENERGIES.map((name) => [`energy.${name}`, name]).filter(
    ([name]) => largestOf(run.columns[name]) > 0,
  );
  const opening = others(telling(run, numbered(run, "contact", "penetration")), (number) => `contact ${number}`);
  const charts = [
    {
      id: "displacement",
      title: "Displacement of floors",
      unit: "m",
      floats: true,
      lines: floorLines(run, "displacement", floors),
    },
    { id: "opening", title: "Gap opening", unit: "m", factor: -1, zero: "closed", lines: opening },
    {
      id: "force",
      title: "Contact force",
      unit: "N",
      impacts: true,
      lines: others(telling(run, numbered(run, "contact", "force")), (number) => `contact ${number}`),
    },
    { id: "link-force", title: "Link force", unit: "N", lines: linkLines(run, "force") },
    { id: "link-displacement", title: "Link displacement", unit: "m", lines: linkLines(run, "displacement") },
    ...FOUNDATION_CHARTS.map(([part, title, unit]) => ({
      id: `foundation-${part}`,
      title,
      unit,
      lines: foundationLines(run, part),
    })),
    {
      id: "ground",
      title: "Ground acceleration",
      unit: "m/s2",
      lines: others(run.columns["ground.acceleration"] ? [["ground.acceleration", 0]] : [], () => "ground"),
    },
    {
      id: "acceleration",
      title: "Acceleration of floors",
      unit: "m/s2",
      lines: floorLines(run, "acceleration", floors),
    },
    { id: "energy", title: "Energy", unit: "J", lines: others(energies, (name) => name) },
  ];
  return charts.filter(({ lines }) => lines.length > 0);
}
