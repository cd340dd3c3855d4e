// What has happened in a run, and what has gone wrong, in few words.

import { digits, plural, quantity, seconds } from "./format.js";
import { SIDES, namesOf } from "./motion.js";
import { hardestOf } from "./strength.js";

const FEW = 2;
const LONG = 400;
// s between rows that are too long for a picture of all motion.
const COARSE = 0.05;

export function runInWords(run) {
  const hardest = hardestOf(run.impacts);
  const first = `${plural(run.impacts.length, "impact")} in ${digits(run.stop)} s.`;
  return [first, hardest && hardestInWords(run, hardest), ...collapses(run), coarse(run), took(run)]
    .filter(Boolean)
    .join(" ");
}

function hardestInWords(run, hardest) {
  const { peak_force: force, impulse, peak_time_s: time, start_s: start, contact } = hardest;
  const meeting = run.look.contacts[contact - 1]?.meeting ?? `contact ${contact}`;
  const strength = force ? quantity(force, "N") : quantity(impulse, "N.s");
  return `The hardest: ${strength} at ${seconds(time || start)} s, ${meeting}.`;
}

function collapses({ columns, look }) {
  const fallen = namesOf(look).filter((name) => columns[`${name}.collapsed`]?.at(-1));
  const called = (name) => (SIDES.includes(name) ? `The ${name} building` : `Building ${name}`);
  return fallen.map((name) => `${called(name)} has collapsed at ${seconds(columns[`${name}.collapse_time`].at(-1))} s.`);
}

function coarse({ step }) {
  if (step <= COARSE) return "";
  return `Of so long a run the picture has a row every ${digits(step, 2)} s only; impacts and peaks are complete.`;
}

function took({ took: time }) {
  if (time === null) return "";
  return `Computed in ${time < 1 ? `${digits(1e3 * time, 2)} ms` : `${digits(time, 3)} s`}.`;
}

// What has gone wrong, short even where much has.
export function sentence(error) {
  const problems = error.problems ?? [error.message];
  const short = problems.slice(0, FEW).map((text) => (text.length > LONG ? `${text.slice(0, LONG)}...` : text));
  return `${short.join(" ")}${problems.length > FEW ? ` And ${problems.length - FEW} more.` : ""}`;
}
