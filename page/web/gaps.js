// For which gaps the handle can be: all, one, or in a row those between two neighbours or before one wall. Each choice has what
// changes in the text for a gap, m, the paths of the laws there, and a contact that shows how it is now.

import { namesOf } from "./motion.js";

const entries = (paths, value) => Object.fromEntries(paths.map((path) => [path, value]));

export function gapChoices({ layout, facing }) {
  const { contacts } = layout;
  if (contacts.length === 0) return [];
  // Those of the file, which counts them without what [facing] makes.
  const written = contacts.slice(facing?.contacts ?? 0).map((contact, at) => ({ contact, path: `contact[${at + 1}]` }));
  const single = ({ contact, path }) => {
    const number = contacts.indexOf(contact) + 1;
    const changes = (gap) => ({ [`${path}.gap`]: gap });
    return { value: `${number}`, label: `contact ${number}`, contact, laws: [`${path}.law`], changes };
  };
  const singles = written.map(single);
  const all = allOf(contacts, written, facing);
  if (namesOf({ layout }).length <= 2 && !(facing && written.length > 0))
    return facing || singles.length < 2 ? [all] : [all, ...singles];
  const walls = singles.filter(({ contact }) => neighboursOf(contact).length < 2);
  return [all, ...pairs(layout, written, facing), ...walls];
}

function allOf(contacts, written, facing) {
  const tables = [...(facing ? ["facing"] : []), ...(written.length > 0 ? ["contact[*]"] : [])];
  const gaps = tables.map((table) => (table === "facing" && facing.hasGaps ? "facing.gap[*]" : `${table}.gap`));
  const laws = tables.map((table) => `${table}.law`);
  return { value: "all", label: "all contacts", contact: contacts[0], laws, changes: (gap) => entries(gaps, gap) };
}

const neighboursOf = ({ left, right }) => [left.side, right.side].filter(Boolean);

// One choice for every two neighbours that can meet.
function pairs({ buildings, contacts }, written, facing) {
  return buildings.slice(1).flatMap(({ name }, at) => {
    const isBetween = (contact) => neighboursOf(contact).join() === `${buildings[at].name},${name}`;
    const contact = contacts.find(isBetween);
    if (!contact) return [];
    const own = written.filter((one) => isBetween(one.contact)).map(({ path }) => path);
    const changes = (gap) => {
      if (!facing) return entries(own.map((path) => `${path}.gap`), gap);
      if (facing.hasGaps) return { [`facing.gap[${at + 1}]`]: gap };
      // What was one number becomes a list.
      return { "facing.gap": buildings.slice(1).map((_, other) => (other === at ? gap : contacts[0].gap)) };
    };
    const laws = facing ? ["facing.law"] : own.map((path) => `${path}.law`);
    return [{ value: `gap ${at + 1}`, label: `${buildings[at].name}, ${name}`, contact, laws, changes }];
  });
}
