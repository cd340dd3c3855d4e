// Numbers as a person writes them, and the units that they are shown in.

const NOTHING = "\u2013";

export function digits(value, count = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return NOTHING;
  if (!Number.isFinite(value)) return value > 0 ? "\u221E" : "-\u221E";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) return value.toExponential(count - 1).replace(/\.?0*e\+?/, "e");
  return String(Number(value.toPrecision(count)));
}

// Seconds, to the tenth of a millisecond where that tells.
export const seconds = (value, places = 3) => (Number.isFinite(value) ? value.toFixed(places) : NOTHING);

// What a unit may be shown as: name, factor, and the largest number that it is good for.
const SHOWN = {
  m: [
    ["mm", 1e3, 1e4],
    ["m", 1, Infinity],
  ],
  N: [
    ["N", 1, 1e4],
    ["kN", 1e-3, 1e5],
    ["MN", 1e-6, Infinity],
  ],
  "N.m": [
    ["N m", 1, 1e4],
    ["kN m", 1e-3, 1e5],
    ["MN m", 1e-6, Infinity],
  ],
  rad: [
    ["mrad", 1e3, 1e4],
    ["rad", 1, Infinity],
  ],
  "N.s": [
    ["N s", 1, 1e4],
    ["kN s", 1e-3, 1e5],
    ["MN s", 1e-6, Infinity],
  ],
  J: [
    ["J", 1, 1e4],
    ["kJ", 1e-3, 1e5],
    ["MJ", 1e-6, Infinity],
  ],
  "m/s": [["m/s", 1, Infinity]],
  "m/s2": [["m/s\u00B2", 1, Infinity]],
  s: [["s", 1, Infinity]],
};
const PLAIN = [["", 1, Infinity]];

// The unit in which numbers up to a size are handy.
export function handyUnit(largest, unit) {
  const choices = SHOWN[unit] ?? PLAIN;
  const [name, factor] = choices.find(([, by, most]) => Math.abs(largest) * by < most) ?? choices.at(-1);
  return { name, factor };
}

export function quantity(value, unit, count = 4) {
  const { name, factor } = handyUnit(value, unit);
  return `${digits(value * factor, count)}\u00A0${name}`.trimEnd();
}

export const withUnit = (name, { name: unit }) => (unit ? `${name} [${unit}]` : name);

export const plural = (count, one, many = `${one}s`) => `${count} ${count === 1 ? one : many}`;

// The largest size among numbers, without spreading them over a call.
export function largestOf(values) {
  let largest = 0;
  for (const value of values ?? []) {
    const size = Math.abs(value);
    if (size > largest) largest = size;
  }
  return largest;
}

export const GRAVITY = 9.80665;

// Along a logarithmic axis 1, 2 and 5 times powers of ten have room for their names.
export const isRound = (value) =>
  [1, 2, 5].includes(Number((value / 10 ** Math.floor(Math.log10(value) + 1e-9)).toPrecision(6)));
