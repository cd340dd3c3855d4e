// A line of TOML in parts, each with the name of its look.

// Strings, comments, headings of tables, keys, numbers: in this order, as their looks.
const PARTS = new RegExp(
  [
    String.raw`("(?:\\.|[^"\\])*"?|'[^']*'?)`,
    String.raw`(#.*)`,
    String.raw`(^\s*\[\[?[^\]#]*\]?\]?)`,
    String.raw`([A-Za-z0-9_.-]+(?=\s*=))`,
    String.raw`([+-]?(?:\d[\d_.eE+-]*|inf\b|nan\b)|\b(?:true|false)\b)`,
  ].join("|"),
  "g",
);
const LOOKS = ["string", "comment", "table", "key", "number"];

export function partsOf(line) {
  const parts = [];
  let at = 0;
  for (const match of line.matchAll(PARTS)) {
    if (match.index > at) parts.push(["", line.slice(at, match.index)]);
    parts.push([LOOKS[match.slice(1).findIndex((part) => part !== undefined)], match[0]]);
    at = match.index + match[0].length;
  }
  if (at < line.length) parts.push(["", line.slice(at)]);
  return parts;
}
