// Gap, strength, law and storeys: what a hand is quicker at than a keyboard. A handle shows what is in the scene, and
// writes it there; it holds nothing itself.

import { GRAVITY, digits } from "./format.js";
import { element, make } from "./make.js";
import { SIDES } from "./motion.js";

// mm to m, and back without the tail that binary numbers have.
const toMetres = (millimetres) => Number((millimetres / 1e3).toPrecision(12));
const toMillimetres = (metres) => Number((metres * 1e3).toPrecision(12));
const LEAST_RANGE = { gap: 0.2, scale: 3, pga: 10 };

export class Handles {
  // `change` writes values into the scene by path, and says whether it could.
  constructor(state, change) {
    Object.assign(this, { state, change, of: "all" });
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
      this.change({ [`${this.#contacts()}.law`]: element("law").value }, "law"),
    );
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
    const contacts = this.state.look?.layout.contacts ?? [];
    return (this.of === "all" ? contacts[0] : contacts[this.of - 1])?.gap ?? NaN;
  }

  setGap(gap) {
    this.change({ [`${this.#contacts()}.gap`]: gap }, "gap");
  }

  #contacts() {
    if (this.state.look?.facing) return "facing";
    return this.of === "all" ? "contact[*]" : `contact[${this.of}]`;
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
    // Shown at once: the next press counts from it.
    if (count >= 1 && this.change({ [`${side}.storeys`]: count }, "storeys")) shown.textContent = count;
  }

  show() {
    const { look } = this.state;
    if (!look) return;
    // A hand that moves a handle is ahead of what has been checked.
    this.isAhead = this.state.checked !== this.state.scene;
    this.#showGap(look);
    this.#showStrength(look);
    if (this.isAhead) return;
    for (const side of SIDES) element(`${side}-storeys`).textContent = look[side]?.floors ?? 0;
    for (const button of document.querySelectorAll("[data-side]")) {
      const { side, by } = button.dataset;
      button.disabled = !look[side] || (Number(by) < 0 && look[side].floors < 2);
    }
  }

  #showGap({ layout: { contacts }, facing }) {
    const gaps = contacts.map(({ gap }) => gap);
    const differ = gaps.some((gap) => gap !== gaps[0]);
    const choosable = !facing && contacts.length > 1;
    if (!choosable || !(this.of === "all" || this.of <= contacts.length)) this.of = "all";
    if (choosable && differ && this.of === "all" && element("gap-of").options.length !== contacts.length + 1)
      this.of = "1";
    this.#listGaps(choosable ? contacts.length : 0);
    const gap = this.gapNow();
    for (const id of ["gap", "gap-number", "law"]) element(id).disabled = contacts.length === 0;
    if (contacts.length === 0) return;
    showRange("gap", gap, LEAST_RANGE.gap, this.isAhead);
    showNumber("gap-number", toMillimetres(gap));
    element("gap").setAttribute("aria-valuetext", `${toMillimetres(gap)} mm`);
    element("law").value = (this.of === "all" ? contacts[0] : contacts[this.of - 1]).law;
  }

  #listGaps(count) {
    element("gap-of-label").hidden = count === 0;
    const list = element("gap-of");
    if (list.options.length !== count + 1) {
      list.replaceChildren();
      make(list, "option", "all contacts", { value: "all" });
      for (let contact = 1; contact <= count; contact++) make(list, "option", `contact ${contact}`, { value: contact });
    }
    list.value = this.of;
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
