// The page begins here: the engine is unpacked, the parts are made and know each other by the state only, and the first
// scene runs.
//
// state.js       what the page knows, and who is told when it changes
// engine.js      what the engine is asked (lane.js, asking.js, worker.js: how)
// runner.js      from text to run: checked, run, stopped, said
// editor.js      the scene as text (history.js, highlight.js); handles.js and gaps.js: what a hand is quicker at; files.js,
//                link.js, keep.js and packed.js: where a scene comes from and stays
// ground.js      records
// unsaid.js      what their files do not say
// stage.js       the buildings in motion (geometry.js, motion.js, drawing.js); player.js: the clock
// charts.js      charts over time (series.js: of what; pair.js: of which buildings); plots.js and xy.js: how any chart looks
// impacts.js, peaks.js, loops.js, study.js: the other results; tabs.js
// save.js        what leaves the page
// format.js, make.js, notice.js, palette.js, strength.js, words.js: shared by all

import { Charts } from "./charts.js";
import { Editor } from "./editor.js";
import { Engine, forScripts } from "./engine.js";
import { startFiles } from "./files.js";
import { Ground } from "./ground.js";
import { Handles } from "./handles.js";
import { Impacts } from "./impacts.js";
import { Keep, MOST_KEPT, nameOf } from "./keep.js";
import { fromLink, startLinks, textOf } from "./link.js";
import { Loops } from "./loops.js";
import { element, make, settled } from "./make.js";
import { startTheme } from "./palette.js";
import { Pair } from "./pair.js";
import { Peaks } from "./peaks.js";
import { Player } from "./player.js";
import { Runner } from "./runner.js";
import { said } from "./notice.js";
import { Save } from "./save.js";
import { Stage } from "./stage.js";
import { State } from "./state.js";
import { hardestOf } from "./strength.js";
import { Study } from "./study.js";
import { startTabs } from "./tabs.js";
import { sentence } from "./words.js";

const FIRST = "feup.toml";
// s before the first impact that the first picture begins, so that something happens.
const BEFORE_IMPACT = 0.6;

const state = new State();
const keep = new Keep();
const engine = new Engine();
// A page that has been made for a scene has a memory of its own.
const memory = engine.given ? new Keep(`${nameOf(engine.given.text)}.`) : keep;
window.pounding = forScripts(engine, () => state.records);

const editor = new Editor(state);
const runner = new Runner(state, engine);
const player = new Player(state);
const handles = new Handles(state, change);
const ground = new Ground(state, engine, (name) => change({ "ground.record": name }, "record"));
const study = new Study(state, engine, runner, {
  setGap: (gap) => handles.setGap(gap),
  gapNow: () => handles.gapNow(),
});
new Pair(state);
const charts = new Charts(state, player);
const loops = new Loops(state);
new Stage(state, player);
new Impacts(state);
new Peaks(state);
new Save(state, engine, runner);

// Values by path into the text, which keeps its comments; whether that went well.
function change(changes, kind) {
  try {
    editor.write(engine.edit(state.scene, changes), kind);
    return true;
  } catch (error) {
    said(`The scene cannot be changed that way: ${sentence(error)}`);
    handles.show();
    return false;
  }
}

startFiles(editor, ground);
startTheme(element("theme"), keep, () => state.tell("colours"));
startTabs(document.querySelector("[role=tablist]"), (panel) => {
  if (panel === "panel-study") study.draw();
  if (panel === "panel-spectrum") ground.draw();
  if (panel === "panel-loops") loops.redraw();
});
startWelcome();
state.on("scene", settled(keepScene, 500));
state.on("run", settled(startMotion, 0));
begin();

async function begin() {
  try {
    await engine.ready;
  } catch (error) {
    element("happened").textContent = `The engine does not start in this browser: ${error.message}`;
    return;
  }
  Object.assign(state.records, engine.records, keptRecords());
  listExamples();
  handles.listLaws(engine.laws);
  startLinks(state, runner, engine.records, (link) => brought(link) && editor.open(link.scene));
  const link = await fromLink();
  const isBrought = brought(link);
  state.tell("records");
  editor.begin(
    isBrought
      ? link.scene
      : (memory.get("scene") ?? engine.given?.text ?? engine.examples.find(({ file }) => file === FIRST).text),
  );
}

// Whether a link brings a scene; its records are kept with the others.
function brought(link) {
  if (link?.broken) said("The link holds no scene that can be read; the one before stays.");
  Object.assign(state.records, link?.records);
  return typeof link?.scene === "string";
}

// The scene that the page has been made for comes first.
function listExamples() {
  const list = element("example");
  const scenes = [...(engine.given ? [{ ...engine.given, description: engine.given.file }] : []), ...engine.examples];
  make(list, "option", "a scene of your own", { value: "" });
  scenes.forEach(({ name, description }, at) => make(list, "option", description || name, { value: at }));
  list.addEventListener("change", () => {
    if (list.value !== "") editor.open(scenes[list.value].text);
  });
  state.on("scene", () => {
    const at = scenes.findIndex(({ text }) => text === state.scene);
    list.value = at < 0 ? "" : at;
  });
}

// The scene, and records of one's own as long as there is room.
function keepScene() {
  memory.set("scene", state.scene);
  const own = Object.entries(state.records)
    .filter(([name, content]) => content !== engine.records[name])
    .map(([name, content]) => [name, textOf(content)]);
  const texts = JSON.stringify(Object.fromEntries(own.filter(([, text]) => text !== null)));
  if (texts.length <= MOST_KEPT) memory.set("records", texts);
  else memory.drop("records");
}

function keptRecords() {
  try {
    return JSON.parse(memory.get("records") ?? "{}");
  } catch {
    return {};
  }
}

// The first run moves by itself, from shortly before the first impact; for those who want no motion the hardest stands
// still.
let hasMoved = false;
function startMotion() {
  if (hasMoved) return;
  hasMoved = true;
  const { impacts } = state.run;
  if (matchMedia("(prefers-reduced-motion: reduce)").matches) {
    const hardest = hardestOf(impacts);
    state.seek(hardest?.peak_time_s || hardest?.start_s || 0);
    return;
  }
  state.seek(Math.max(0, (impacts[0]?.start_s ?? 0) - BEFORE_IMPACT));
  player.play();
}

function startWelcome() {
  element("welcome").hidden = keep.get("understood") !== null;
  element("understood").addEventListener("click", () => {
    element("welcome").hidden = true;
    keep.set("understood", "yes");
    element("run").focus();
  });
}
