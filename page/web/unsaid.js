// What the file of a record does not say and the user may: the fields below the list of records.

import { element } from "./make.js";

const NUMBERS = ["step", "skip_lines"];
const FIELDS = ["step", "unit", "column", "skip_lines"];

const field = (name) => element(`record-${name.replace("_", "-")}`);

export class Unsaid {
  // `take` gets what has been said, by the keys of a scene's ground.record.
  constructor(take) {
    for (const name of [...FIELDS, "remove_mean"]) field(name).addEventListener("change", () => take(this.said()));
  }

  // What is in the fields.
  said() {
    const filled = FIELDS.filter((name) => field(name).value.trim() !== "");
    const said = Object.fromEntries(filled.map((name) => [name, valueOf(name, field(name).value.trim())]));
    return field("remove_mean").checked ? { ...said, remove_mean: true } : said;
  }

  // What a scene says.
  show(said = {}) {
    for (const name of FIELDS) field(name).value = said[name] ?? "";
    field("remove_mean").checked = said.remove_mean ?? false;
  }

  open() {
    element("record-unsaid").open = true;
  }
}

const valueOf = (name, text) => (NUMBERS.includes(name) || (name === "column" && /^\d+$/.test(text)) ? Number(text) : text);

// Whether a record is refused for want of something that a user may know.
export const isMissing = (text) => /\b(step|unit|column|skip_lines|remove_mean)\b/.test(text);
