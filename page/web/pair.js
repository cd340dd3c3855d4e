// Of which buildings of a row the charts show floors and storeys: those of the hardest impact, until somebody chooses two.

import { element, make } from "./make.js";
import { SIDES, namesOf } from "./motion.js";
import { hardestOf } from "./strength.js";

// From left to right; all of a scene of two.
export function chartedOf({ chosenBuildings, run }, look) {
  const names = namesOf(look);
  if (names.length <= 2) return names;
  const chosen = names.filter((name) => chosenBuildings.includes(name));
  return chosen.length > 0 ? chosen : ofHardest(names, look.layout.contacts, run);
}

// Without an impact those of the first contact; at a wall the neighbour goes along.
function ofHardest(names, contacts, run) {
  const contact = contacts[hardestOf(run?.impacts ?? [])?.contact - 1] ?? contacts[0];
  const [first, second] = SIDES.map((side) => names.indexOf(contact?.[side].side)).filter((at) => at >= 0);
  if (second !== undefined) return [names[first], names[second]];
  const from = Math.min(first ?? 0, names.length - 2);
  return names.slice(from, from + 2);
}

export class Pair {
  constructor(state) {
    Object.assign(this, { state, lists: [element("pair-first"), element("pair-second")], listed: "" });
    this.lists[0].addEventListener("change", () => this.#choose(true));
    this.lists[1].addEventListener("change", () => this.#choose(false));
    state.on("run", () => this.#show());
  }

  #show() {
    const { state, lists } = this;
    const names = namesOf(state.run.look);
    element("pair").hidden = names.length <= 2;
    if (names.length <= 2) return;
    if (this.listed !== names.join()) this.#list(names);
    const [first, second] = chartedOf(state, state.run.look);
    const isChosen = state.chosenBuildings.length > 0;
    lists[0].value = isChosen ? first : "";
    lists[1].value = second ?? first;
    lists[1].hidden = !isChosen;
  }

  #list(names) {
    this.state.chosenBuildings = [];
    this.listed = names.join();
    for (const list of this.lists) list.replaceChildren();
    make(this.lists[0], "option", "of the hardest impact", { value: "" });
    for (const list of this.lists) for (const name of names) make(list, "option", name, { value: name });
  }

  // With the first one its neighbour, until another is chosen.
  #choose(isFirst) {
    const { state, lists } = this;
    const [first, second] = lists.map(({ value }) => value);
    const names = namesOf(state.run.look);
    const at = names.indexOf(first);
    const beside = names[at + 1] ?? names[at - 1];
    state.chosenBuildings = first === "" ? [] : [first, isFirst && (second === first || lists[1].hidden) ? beside : second];
    this.#show();
    state.tell("buildings");
  }
}
