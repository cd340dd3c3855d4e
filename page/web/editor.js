// The scene as text: lines with numbers, colours, and a mark where something is wrong or odd. The text itself is a
// textarea, as every keyboard and screen reader knows it; what is drawn under it shows the visible lines only,
// however long it is.

import { History } from "./history.js";
import { element, make, onceAFrame } from "./make.js";
import { partsOf } from "./highlight.js";
import { said } from "./notice.js";

const LINE = 20;
const LONGEST_LINE = 2000;
const MOST_FINDINGS = 100;
// Letters and lines: more of them no browser edits at a bearable pace.
export const MOST_LETTERS = 4e6;
const MOST_LINES_OF_TEXT = 50_000;

export class Editor {
  constructor(state) {
    Object.assign(this, { state, area: element("scene"), lines: [""], marks: new Map(), history: new History("") });
    this.gutter = document.querySelector(".gutter");
    this.under = document.querySelector(".under");
    this.draw = onceAFrame(() => this.#draw());
    this.area.addEventListener("input", () => this.#typed());
    this.area.addEventListener("scroll", () => this.#draw());
    this.area.addEventListener("beforeinput", (event) => this.#native(event));
    document.addEventListener("keydown", (event) => this.#key(event));
    element("undo").addEventListener("click", () => this.undo(-1));
    element("redo").addEventListener("click", () => this.undo(1));
    new ResizeObserver(this.draw).observe(this.area);
    state.on("findings", () => this.#findings());
  }

  // Why a text cannot be edited here; nothing where it can.
  tooLong(text) {
    const millions = (text.length / 1e6).toFixed(1);
    if (text.length > MOST_LETTERS)
      return `${millions} million letters: expected a scene of at most ${MOST_LETTERS / 1e6} million.`;
    return hasManyLines(text) ? `more than ${MOST_LINES_OF_TEXT} lines, which are too many for a scene.` : "";
  }

  // A text that takes the place of the one that is there; undo brings that back.
  write(text, kind) {
    const { area } = this;
    if (text === area.value) return;
    const { scrollTop, scrollLeft, selectionStart } = area;
    area.value = text;
    area.setSelectionRange(Math.min(selectionStart, text.length), Math.min(selectionStart, text.length));
    Object.assign(area, { scrollTop, scrollLeft });
    this.history.add(area.value, selectionStart, kind);
    this.#changed(kind);
  }

  // Another scene, from its beginning.
  open(text) {
    const problem = this.tooLong(text);
    if (problem) return said(`The text has ${problem} The scene before it stays.`);
    this.write(text, "open");
    this.area.setSelectionRange(0, 0);
    this.area.scrollTop = this.area.scrollLeft = 0;
  }

  // The text that was there before the first edit.
  begin(text) {
    this.area.value = text;
    this.history = new History(this.area.value);
    this.#changed("begin");
  }

  undo(by) {
    const step = this.history.go(by);
    if (!step) return;
    this.area.value = step.text;
    this.area.setSelectionRange(step.caret, step.caret);
    this.#changed("undo");
  }

  goTo(line) {
    const start = this.lines.slice(0, line - 1).reduce((sum, text) => sum + text.length + 1, 0);
    this.area.focus();
    this.area.setSelectionRange(start, start + (this.lines[line - 1]?.length ?? 0));
    this.area.scrollTop = Math.max(0, (line - 1) * LINE - this.area.clientHeight / 2);
    this.#draw();
  }

  #typed() {
    const problem = this.tooLong(this.area.value);
    if (problem) {
      this.area.value = this.state.scene;
      return said(`The text would have ${problem} The scene before it stays.`);
    }
    this.history.add(this.area.value, this.area.selectionStart, "typing");
    this.#changed("typing");
  }

  #changed(kind) {
    this.lines = this.area.value.split("\n");
    element("undo").disabled = !this.history.can(-1);
    element("redo").disabled = !this.history.can(1);
    this.state.scene = this.area.value;
    this.draw();
    this.state.tell("scene", kind);
  }

  // The menu of the browser has its own undo, which knows nothing of handles.
  #native(event) {
    const by = { historyUndo: -1, historyRedo: 1 }[event.inputType];
    if (!by) return;
    event.preventDefault();
    this.undo(by);
  }

  #key(event) {
    const letter = event.key.toLowerCase();
    if (!(event.ctrlKey || event.metaKey) || event.altKey || !["z", "y"].includes(letter)) return;
    if (event.target !== this.area && event.target.matches("input[type=number], input[readonly]")) return;
    event.preventDefault();
    this.undo(letter === "y" || event.shiftKey ? 1 : -1);
  }

  #findings() {
    const { problems, warnings } = this.state;
    this.marks = new Map();
    for (const { line } of warnings) this.marks.set(line, "warning");
    for (const { line } of problems) this.marks.set(line, "problem");
    const list = element("problems");
    list.replaceChildren();
    const all = [...problems.map((found) => [found, "problem"]), ...warnings.map((found) => [found, "warning"])];
    for (const [found, kind] of all.slice(0, MOST_FINDINGS)) this.#finding(list, found, kind);
    if (all.length > MOST_FINDINGS) make(list, "li", `and ${all.length - MOST_FINDINGS} more`);
    this.area.setAttribute("aria-invalid", problems.length > 0);
    this.draw();
  }

  #finding(list, { text, line }, kind) {
    const item = make(list, "li", "", { class: kind });
    const place = line && !text.startsWith("line ") ? `line ${line}: ` : "";
    const said = `${kind === "warning" ? "warning: " : ""}${place}${text}`;
    if (!line) make(item, "span", said);
    else make(item, "button", said).addEventListener("click", () => this.goTo(line));
  }

  #draw() {
    const { area, gutter, under } = this;
    const first = Math.max(0, Math.floor(area.scrollTop / LINE) - 2);
    const last = Math.min(this.lines.length, first + Math.ceil(area.clientHeight / LINE) + 5);
    const plain = this.lines.slice(first, last).some((line) => line.length > LONGEST_LINE);
    area.classList.toggle("plain", plain);
    under.hidden = plain;
    gutter.replaceChildren();
    under.replaceChildren();
    for (let line = first; line < last; line++) {
      const mark = this.marks.get(line + 1) ?? "";
      make(gutter, "div", mark ? { problem: "\u2715", warning: "\u25B2" }[mark] : String(line + 1), { class: mark });
      if (!plain) this.#drawLine(make(under, "div", "", { class: mark }), this.lines[line]);
    }
    const up = first * LINE - area.scrollTop;
    gutter.style.transform = `translateY(${up}px)`;
    under.style.transform = `translate(${-area.scrollLeft}px, ${up}px)`;
  }

  #drawLine(row, line) {
    for (const [look, text] of partsOf(line)) {
      if (look) make(row, "span", text, { class: look });
      else row.append(text);
    }
    if (!line) row.append("\u200B");
  }
}

function hasManyLines(text) {
  let count = 1;
  for (let at = text.indexOf("\n"); at >= 0 && count <= MOST_LINES_OF_TEXT; at = text.indexOf("\n", at + 1)) count++;
  return count > MOST_LINES_OF_TEXT;
}
