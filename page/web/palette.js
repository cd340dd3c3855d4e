// Colours and dashes: Okabe and Ito's and some of Tol's, which colour-blind eyes tell apart. Left is cold and solid, right warm
// and dashed or hatched; in a row each building has one of eight in turn, and every second one is dashed or hatched. The style
// sheet has the values, light and dark; what is drawn on a canvas asks here.

const NAMES = ["page", "card", "line", "ink", "quiet", "left", "right", "right-text", "flash", "flash-edge"];
const ROW = Array.from({ length: 8 }, (_, at) => `row-${at + 1}`);
const LINES = {
  left: ["--left", "--left-2", "--left-3", "--left-4"],
  right: ["--right", "--right-2", "--right-3", "--right-4"],
  others: ["--ink", "--line-1", "--line-2", "--line-3", "--line-4", "--line-5"],
  ...Object.fromEntries(ROW.map((name) => [name, [`--${name}`]])),
};
const DASHES = {
  left: [[], [2, 3], [12, 3, 2, 3]],
  right: [
    [8, 4],
    [4, 3],
    [8, 3, 2, 3],
  ],
  others: [[], [8, 4], [2, 3]],
};

let probe = null;
let known = new Map();

// A colour of the style sheet as canvas takes it.
export function colour(name) {
  const property = name.startsWith("--") ? name : `--${name}`;
  if (!known.has(property)) {
    probe ??= document.body.appendChild(Object.assign(document.createElement("span"), { hidden: true }));
    probe.style.color = `var(${property})`;
    known.set(property, getComputedStyle(probe).color);
  }
  return known.get(property);
}

export const colours = () => Object.fromEntries([...NAMES, ...ROW].map((name) => [name, colour(name)]));

export function forgetColours() {
  known = new Map();
}

// Colour and dash of the line in a place among those of its kind; where buildings of a row are drawn together, every second
// one is dashed, whichever it is.
export function lineLook(kind, place, building = 0) {
  const ofRow = building % 2 ? DASHES.right : DASHES.left;
  const [names, dashes] = [LINES[kind] ?? LINES.others, ROW.includes(kind) ? ofRow : (DASHES[kind] ?? DASHES.others)];
  return {
    stroke: colour(names[place % names.length]),
    dash: dashes[Math.floor(place / names.length) % dashes.length],
  };
}

// As the system has it until somebody presses the button, then light or dark in turn; the choice is kept where the
// browser keeps anything.
export function startTheme(button, keep, changed) {
  const system = matchMedia("(prefers-color-scheme: dark)");
  let choice = keep.get("theme") ?? "auto";
  const apply = () => {
    document.documentElement.dataset.theme = choice;
    button.title = `Colours: ${choice === "auto" ? "as the system has them" : choice}`;
    button.setAttribute("aria-label", button.title);
    forgetColours();
    changed();
  };
  button.addEventListener("click", () => {
    const dark = choice === "auto" ? system.matches : choice === "dark";
    choice = dark ? "light" : "dark";
    keep.set("theme", choice);
    apply();
  });
  system.addEventListener("change", apply);
  apply();
}
