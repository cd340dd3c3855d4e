// Which columns of a run are drawn together, and as what: one entry for each chart.

import { largestOf } from "./format.js";
import { lineLook } from "./palette.js";
import { kindOf, namesOf } from "./motion.js";

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
export function usualFloors(look, buildings) {
  return look.buildings.filter(({ name }) => buildings.includes(name)).map(({ name, floors }) => `${name} ${floors}`);
}

function floorLines(run, part, { buildings, floors }) {
  const names = namesOf(run.look);
  return buildings.flatMap((building, which) => {
    const drawn = columnsOf(run, building, part)
      .filter(([, floor]) => floors.has(`${building} ${floor}`))
      .reverse();
    const kind = kindOf(names, building);
    return drawn.map(([name, floor], at) => {
      return { name, label: `${building} ${floor}`, look: () => lineLook(kind, at, which) };
    });
  });
}

// Of the foundations that move so.
function foundationLines(run, part, { buildings }) {
  const names = namesOf(run.look);
  const known = buildings.map((building) => [`${building}.foundation.${part}`, building]);
  return known
    .filter(([name]) => run.columns[name])
    .map(([name, building], which) => {
      return { name, label: building, look: () => lineLook(kindOf(names, building), 0, which) };
    });
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

// All charts of a run, of floors those that are chosen: { buildings, floors }; charts without lines are left out.
export function chartsOf(run, chosen) {
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
      lines: floorLines(run, "displacement", chosen),
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
      lines: foundationLines(run, part, chosen),
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
      lines: floorLines(run, "acceleration", chosen),
    },
    { id: "energy", title: "Energy", unit: "J", lines: others(energies, (name) => name) },
  ];
  return charts.filter(({ lines }) => lines.length > 0);
}
