// Gap, strength, law and storeys: what a hand is quicker at than a keyboard. A handle shows what is in the scene, and
// writes it there; it holds nothing itself.

import { GRAVITY, digits } from "./format.js";
import { gapChoices } from "./gaps.js";
import { element, make } from "./make.js";
import { SIDES } from "./motion.js";

// mm to m, and back without the tail that binary numbers have.
const toMetres = (millimetres) => Number((millimetres / 1e3).toPrecision(12));
const toMillimetres = (metres) => Number((metres * 1e3).toPrecision(12));
const LEAST_RANGE = { gap: 0.2, scale: 3, pga: 10 };

export class Handles {
  // `change` writes values into the scene by path, and says whether it could.
  constructor(state, change) {
    Object.assign(this, { state, change, of: "all", choices: [] });
    element("gap").addEventListener("input", () => this.setGap(Number(element("gap").value)));
    element("gap-number").addEventListener("change", () =>
      this.#typed("gap-number", (value) => this.setGap(toMetres(value))),
    );
    element("gap-of").addEventListener("change", () => this.#chooseGap());
    element("strength").addEventListener("input", () => this.#setStrength(Number(element("strength").value)));
    element("strength-number").addEventListener("change", () =>
      this.#typed("strength-number", (value) => this.#setStrength(value)),
    );
    element("law").addEventListener("change", () =>
      this.change(Object.fromEntries(this.#chosen().laws.map((path) => [path, element("law").value])), "law"),
    );
    element("storeys-of").addEventListener("change", () => this.show());
    for (const button of document.querySelectorAll("[data-side]"))
      button.addEventListener("click", () => this.#setStoreys(button.dataset));
    state.on("look", () => this.show());
  }

  listLaws(laws) {
    for (const { name, force } of laws)
      make(element("law"), "option", name.replaceAll("_", " "), { value: name, title: force });
  }

  // m, of the contacts that the handle is for.
  gapNow() {
    return this.#chosen()?.contact.gap ?? NaN;
  }

  setGap(gap) {
    const chosen = this.#chosen();
    if (chosen) this.change(chosen.changes(gap), "gap");
  }

  #chosen() {
    return this.choices.find(({ value }) => value === this.of);
  }

  #typed(id, set) {
    const value = element(id).valueAsNumber;
    if (Number.isFinite(value)) set(value);
    else this.show();
  }

  #chooseGap() {
    this.of = element("gap-of").value;
    this.show();
  }

  // A record turned round stays that.
  #setStrength(size) {
    const { ground } = this.state.look ?? {};
    if (!ground) return;
    const isPga = ground.pga !== null;
    const now = isPga ? ground.pga : ground.scale;
    const value = now < 0 ? -Math.abs(size) : size;
    this.change({ [isPga ? "ground.pga" : "ground.scale"]: value }, "strength");
  }

  #setStoreys({ side, by }) {
    const shown = element(`${side}-storeys`);
    const count = Number(shown.textContent) + Number(by);
    const path = this.#buildingAt(side).path;
    // Shown at once: the next press counts from it.
    if (count >= 1 && this.change({ [`${path}.storeys`]: count }, "storeys")) shown.textContent = count;
  }

  // That which the buttons of a side are for; those of a row are for the one that is chosen.
  #buildingAt(side) {
    const buildings = this.state.look?.buildings ?? [];
    return buildings.find(({ name, path }) => (side === "row" ? name === element("storeys-of").value : path === side));
  }

  show() {
    const { look } = this.state;
    if (!look) return;
    // A hand that moves a handle is ahead of what has been checked.
    this.isAhead = this.state.checked !== this.state.scene;
    this.#showGap(look);
    this.#showStrength(look);
    if (this.isAhead) return;
    this.#showStoreys(look);
  }

  #showStoreys({ buildings }) {
    const isRow = buildings[0].path !== "left";
    element("row-stepper").hidden = !isRow;
    if (isRow) listOptions(element("storeys-of"), buildings.map(({ name }) => ({ value: name, label: name })));
    for (const side of [...SIDES, "row"]) {
      if (side !== "row") element(`${side}-storeys`).parentElement.hidden = isRow;
      const floors = this.#buildingAt(side)?.floors ?? 0;
      element(`${side}-storeys`).textContent = floors;
      for (const button of document.querySelectorAll(`[data-side=${side}]`))
        button.disabled = floors === 0 || (Number(button.dataset.by) < 0 && floors < 2);
    }
  }

  #showGap({ layout: { contacts } }) {
    this.choices = gapChoices(this.state.look);
    const singles = this.choices.slice(1);
    const differ = contacts.some(({ gap }) => gap !== contacts[0].gap);
    const isNew = listOptions(element("gap-of"), this.choices);
    if (!this.#chosen()) this.of = "all";
    if (singles.length > 0 && differ && this.of === "all" && isNew) this.of = singles[0].value;
    element("gap-of-label").hidden = singles.length === 0;
    element("gap-of").value = this.of;
    for (const id of ["gap", "gap-number", "law"]) element(id).disabled = contacts.length === 0;
    if (contacts.length === 0) return;
    const { gap, law } = this.#chosen().contact;
    showRange("gap", gap, LEAST_RANGE.gap, this.isAhead);
    showNumber("gap-number", toMillimetres(gap));
    element("gap").setAttribute("aria-valuetext", `${toMillimetres(gap)} mm`);
    element("law").value = law;
  }

  #showStrength({ ground }) {
    for (const id of ["strength", "strength-number"]) element(id).disabled = !ground;
    element("strength-says").textContent = ground
      ? `peak ${digits(ground.peakInG, 3)} g = ${digits(ground.peakInG * GRAVITY, 3)} m/s\u00B2`
      : "no record in the scene";
    if (!ground) return;
    const isPga = ground.pga !== null;
    const value = isPga ? ground.pga : ground.scale;
    element("strength-unit").textContent = isPga ? "m/s\u00B2" : "\u00D7";
    showRange("strength", Math.abs(value), LEAST_RANGE[isPga ? "pga" : "scale"], this.isAhead);
    showNumber("strength-number", value);
    element("strength").setAttribute("aria-valuetext", element("strength-says").textContent);
  }
}

// Those of a list, written anew only where they are others; whether they are.
function listOptions(list, options) {
  if ([...list.options].map(({ text }) => text).join() === options.map(({ label }) => label).join()) return false;
  const { value } = list;
  list.replaceChildren();
  for (const option of options) make(list, "option", option.label, { value: option.value });
  if (options.some((option) => option.value === value)) list.value = value;
  return true;
}

// The range grows with what is in it, but not under a hand that moves it.
function showRange(id, value, least, isAhead) {
  const range = element(id);
  if (isAhead && document.activeElement === range) return;
  if (document.activeElement !== range || value > Number(range.max)) {
    const power = 10 ** Math.floor(Math.log10(Math.max(value, 1e-9)));
    const enough = [1, 2, 5, 10, 20].find((digit) => digit * power >= 1.5 * value) * power;
    range.max = Math.max(least, enough);
  }
  if (Number(range.value) !== value) range.value = value;
}

// Not what somebody is typing.
function showNumber(id, value) {
  if (document.activeElement !== element(id) || element(id).valueAsNumber !== value) element(id).value = value;
}
