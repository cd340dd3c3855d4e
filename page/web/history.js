// Undo and redo of the scene's text, for what is typed and what handles write alike. What follows quickly upon its
// like is one step: letters of a word, positions of a slider; so are all positions of one that is held.

const TOGETHER = 900;
const JOINING = ["typing", "gap", "strength"];
const MOST = 300;
const MOST_TEXT = 2e7;

// How often a pointer has been put down, and which of these times is going on: 0 while none is down.
let holds = 0;
let pressed = 0;
addEventListener("pointerdown", () => (pressed = ++holds), true);
for (const end of ["pointerup", "pointercancel"]) addEventListener(end, () => (pressed = 0), true);

export class History {
  constructor(text) {
    this.steps = [{ text, caret: 0 }];
    this.at = 0;
    this.last = { kind: "", when: 0, pressed: 0 };
  }

  add(text, caret, kind) {
    if (text === this.steps[this.at].text) return;
    const now = performance.now();
    const follows = now - this.last.when < TOGETHER || (pressed > 0 && pressed === this.last.pressed);
    const joins = JOINING.includes(kind) && kind === this.last.kind && follows && this.at > 0;
    this.steps.length = joins ? this.at : this.at + 1;
    this.steps.push({ text, caret });
    while (this.steps.length > MOST || (this.steps.length > 2 && this.#size() > MOST_TEXT)) this.steps.shift();
    this.at = this.steps.length - 1;
    this.last = { kind, when: now, pressed };
  }

  #size() {
    return this.steps.length * this.steps.at(-1).text.length;
  }

  // The step before or after; nothing where there is none.
  go(by) {
    if (!this.can(by)) return null;
    this.at += by;
    this.last = { kind: "", when: 0, pressed: 0 };
    return this.steps[this.at];
  }

  can(by) {
    return this.steps[this.at + by] !== undefined;
  }
}
