// What leaves the page: files that the browser saves. Nothing is sent anywhere.

import { digits } from "./format.js";
import { element } from "./make.js";
import { said } from "./notice.js";
import { drawPicture } from "./picture.js";
import { sentence } from "./words.js";

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
    this.#on("save-fmu", (name) => this.#fmu(name));
    this.#on("save-report", async (name) =>
      download(`${name}.html`, await engine.report(state.scene, { records: runner.records() }), "text/html"),
    );
    this.#on("save-csv", (name) => this.#csv(name));
    this.#on("save-picture", async (name) => download(`${name}.png`, await this.#picture(), "image/png"));
    element("save-scene").addEventListener("click", async () => {
      download(`${(await runner.verdict()) ?? "scene"}.toml`, state.scene, "application/toml");
      said("The scene is saved.");
    });
  }

  // A button that is busy until its file is there.
  #on(id, act) {
    const button = element(id);
    button.addEventListener("click", async () => {
      const name = await this.runner.verdict();
      if (!name) return said("The scene has mistakes: the list under it says which. Nothing is saved.");
      button.disabled = true;
      button.setAttribute("aria-busy", "true");
      try {
        await act(name);
        said(`${button.textContent}: saved.`);
      } catch (error) {
        said(`${button.textContent}: ${sentence(error)}`);
      }
      button.removeAttribute("aria-busy");
      button.disabled = false;
    });
  }

  async #fmu(name) {
    const fmi = Number(element("fmi").value);
    const bytes = await this.engine.buildFmu(this.state.scene, { records: this.runner.records(), fmi });
    download(`${name}${fmi === 3 ? ".fmi3" : ""}.fmu`, bytes, "application/octet-stream");
  }

  async #csv(name) {
    const { engine, state, runner } = this;
    const options = { records: runner.records() };
    const isImpacts = element("csv-of").value === "impacts";
    const table = await (isImpacts ? engine.impactsCsv(state.scene, options) : engine.csv(state.scene, options));
    download(`${name}${isImpacts ? ".impacts" : ""}.csv`, table, "text/csv");
  }

  async #picture() {
    const { run, time } = this.state;
    if (!run) throw new Error("no run yet to make a picture of");
    const parts = [{ canvas: element("buildings"), title: `${run.look.name}, ${digits(time, 5)} s`, lines: [] }];
    for (const chart of document.querySelectorAll("#chart-list .chart")) {
      const [canvas, heading] = ["canvas", "h3"].map((tag) => chart.querySelector(tag));
      parts.push({ canvas, title: heading.textContent, lines: legendOf(chart) });
    }
    const words = `${element("happened").textContent.split(" Computed")[0]} ${element("scale").textContent}.`;
    return drawPicture(parts, words);
  }
}

// As it stands beside the chart.
function legendOf(chart) {
  return [...chart.querySelectorAll(".line-key")].map((key) => {
    const [line, label] = [key.querySelector("line"), key.parentElement.querySelector(".u-label").textContent];
    const dash = line.getAttribute("stroke-dasharray");
    return { label, stroke: line.getAttribute("stroke"), dash: dash === "none" ? [] : dash.split(" ").map(Number) };
  });
}
