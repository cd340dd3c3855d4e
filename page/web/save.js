// What leaves the page: files that the browser saves. Nothing is sent anywhere.

import { digits } from "./format.js";
import { element } from "./make.js";
import { said } from "./notice.js";
import { colour } from "./palette.js";
import { sentence } from "./words.js";

const MARGIN = 16;

export function download(name, content, type) {
  const address = URL.createObjectURL(new Blob([content], { type }));
  const link = document.createElement("a");
  Object.assign(link, { href: address, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

export class Save {
  constructor(state, engine, runner) {
    Object.assign(this, { state, engine, runner });
    this.#on("save-fmu", () => this.#fmu());
    this.#on("save-report", async (name) =>
      download(`${name}.html`, await engine.report(state.scene, { records: runner.records() }), "text/html"),
    );
    this.#on("save-csv", (name) => this.#csv(name));
    this.#on("save-picture", async (name) => download(`${name}.png`, await this.#picture(), "image/png"));
    element("save-scene").addEventListener("click", () => {
      download(`${state.look?.name ?? "scene"}.toml`, state.scene, "application/toml");
      said("The scene is saved.");
    });
  }

  // A button that is busy until its file is there.
  #on(id, act) {
    const button = element(id);
    button.addEventListener("click", async () => {
      if (!this.runner.isRight) return said("The scene has mistakes: the list under it says which. Nothing is saved.");
      button.disabled = true;
      button.setAttribute("aria-busy", "true");
      try {
        await act(this.state.look.name);
        said(`${button.textContent}: saved.`);
      } catch (error) {
        said(`${button.textContent}: ${sentence(error)}`);
      }
      button.removeAttribute("aria-busy");
      button.disabled = false;
    });
  }

  async #fmu() {
    const fmi = Number(element("fmi").value);
    const bytes = await this.engine.buildFmu(this.state.scene, { records: this.runner.records(), fmi });
    download(`${this.state.look.name}${fmi === 3 ? ".fmi3" : ""}.fmu`, bytes, "application/octet-stream");
  }

  async #csv(name) {
    const { engine, state, runner } = this;
    const options = { records: runner.records() };
    const isImpacts = element("csv-of").value === "impacts";
    const table = await (isImpacts ? engine.impactsCsv(state.scene, options) : engine.csv(state.scene, options));
    download(`${name}${isImpacts ? ".impacts" : ""}.csv`, table, "text/csv");
  }

  // The buildings, and below them all charts, as they are now.
  async #picture() {
    const { run, time } = this.state;
    if (!run) throw new Error("no run yet to make a picture of");
    const ratio = devicePixelRatio || 1;
    const parts = [{ canvas: element("buildings"), title: `${run.look.name}, ${digits(time, 5)} s` }];
    for (const chart of document.querySelectorAll("#chart-list .chart"))
      parts.push({ canvas: chart.querySelector("canvas"), title: chart.querySelector("h3").textContent });
    const line = 20 * ratio;
    const whole = document.createElement("canvas");
    whole.width = Math.max(...parts.map(({ canvas }) => canvas.width)) + 2 * MARGIN;
    whole.height = parts.reduce((sum, { canvas }) => sum + canvas.height + line, 2 * MARGIN + 2 * line);
    const pen = whole.getContext("2d");
    pen.fillStyle = colour("card");
    pen.fillRect(0, 0, whole.width, whole.height);
    pen.fillStyle = colour("ink");
    pen.font = `600 ${13 * ratio}px system-ui, sans-serif`;
    const words = `${element("happened").textContent.split(" Computed")[0]} ${element("scale").textContent}.`;
    let y = MARGIN;
    for (const { canvas, title } of parts) {
      pen.fillText(title, MARGIN, y + 14 * ratio);
      pen.drawImage(canvas, MARGIN, y + line);
      y += canvas.height + line;
    }
    pen.font = `${12 * ratio}px system-ui, sans-serif`;
    pen.fillText(words, MARGIN, y + line, whole.width - 2 * MARGIN);
    return new Promise((done) => whole.toBlob(done, "image/png"));
  }
}
