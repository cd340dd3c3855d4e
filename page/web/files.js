// Files that are dropped onto the page: a scene by its name, everything else is taken for a record.

import { MOST_LETTERS } from "./editor.js";
import { element } from "./make.js";
import { said } from "./notice.js";

export function startFiles(editor, ground) {
  const take = async (files) => {
    const scenes = files.filter(({ name }) => /\.toml$/i.test(name));
    await ground.take(files.filter((file) => !scenes.includes(file)));
    for (const file of scenes) await openScene(editor, file);
  };
  element("open-scene").addEventListener("change", async (event) => {
    for (const file of event.target.files) await openScene(editor, file);
    event.target.value = "";
  });
  // The veil is there while something is dragged, which leaves one element for another all the time.
  let inside = 0;
  const veil = (by) => {
    inside = by === 0 ? 0 : Math.max(0, inside + by);
    element("drop").hidden = inside === 0;
  };
  const hasFiles = (event) => [...(event.dataTransfer?.types ?? [])].includes("Files");
  document.addEventListener("dragenter", (event) => hasFiles(event) && veil(1));
  document.addEventListener("dragleave", (event) => hasFiles(event) && veil(-1));
  document.addEventListener("dragover", (event) => hasFiles(event) && event.preventDefault());
  document.addEventListener("drop", (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    veil(0);
    take([...event.dataTransfer.files]);
  });
}

async function openScene(editor, file) {
  if (file.size > 4 * MOST_LETTERS)
    return said(
      `${file.name} has ${Math.round(file.size / 1e6)} MB: expected a scene of at most ${MOST_LETTERS / 1e6} MB.`,
    );
  const bytes = new Uint8Array(await file.arrayBuffer());
  try {
    editor.open(new TextDecoder("utf-8", { fatal: true }).decode(bytes));
  } catch {
    said(`${file.name} is no text in UTF-8, which a scene is.`);
  }
}
