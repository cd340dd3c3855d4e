// A scene in a link: its text, packed, behind the hash, which no server ever sees. A small record of one's own goes
// along.

import { MOST_LETTERS } from "./editor.js";
import { element } from "./make.js";
import { packText, unpackText } from "./packed.js";
import { said } from "./notice.js";

const MARK = "#scene=";
const MOST_RECORD = 3e4;

// What the link that has been opened brings: scene and records; nothing where it brings none.
export async function fromLink() {
  if (!location.hash.startsWith(MARK)) return null;
  try {
    const brought = JSON.parse(await unpackText(location.hash.slice(MARK.length), MOST_LETTERS));
    if (typeof brought.scene !== "string") throw new Error("no scene");
    const records = Object.entries(brought.records ?? {}).filter(([, content]) => typeof content === "string");
    return { scene: brought.scene, records: Object.fromEntries(records) };
  } catch {
    return { broken: true };
  }
}

// A link that is opened in the page as it is tells through `opened`; one that the scene has left behind goes from the
// address.
export function startLinks(state, runner, recordsOfPage, opened) {
  addEventListener("hashchange", async () => opened(await fromLink()));
  state.on("scene", (kind) => {
    if (kind !== "begin" && location.hash.startsWith(MARK)) history.replaceState(null, "", location.href.split("#")[0]);
  });
  const box = element("link-box");
  element("link").addEventListener("click", async () => {
    const { records, left } = small(runner.records(), recordsOfPage);
    const packed = await packText(JSON.stringify({ scene: state.scene, records }));
    const address = location.href.split("#")[0] + MARK + packed;
    history.replaceState(null, "", MARK + packed);
    element("link-text").value = address;
    const without =
      left.length > 0
        ? ` The record ${left.join(", ")} is too large for a link: send its file along, it is dropped into the page.`
        : "";
    element("link-says").textContent = [
      `It holds the whole scene, ${address.length} letters.`,
      "What stands from # on works behind the address of any copy of this page.",
      `Nothing is sent anywhere by making it.${without}`,
    ].join(" ");
    box.showModal();
    element("link-text").select();
  });
  element("copy-link").addEventListener("click", async () => {
    element("link-text").select();
    const copied = await navigator.clipboard?.writeText(element("link-text").value).then(
      () => true,
      () => false,
    );
    said(
      copied || document.execCommand("copy")
        ? "The link is copied."
        : "The browser does not let this file copy: press Ctrl+C.",
    );
    box.close();
  });
}

// Records that a link has room for, as text; the names of those that it has not.
function small(records, recordsOfPage) {
  const [kept, left] = [Object.create(null), []];
  for (const [name, content] of Object.entries(records)) {
    if (content === recordsOfPage[name]) continue;
    const text = textOf(content);
    if (text !== null && text.length <= MOST_RECORD) kept[name] = text;
    else left.push(name);
  }
  return { records: kept, left };
}

export function textOf(content) {
  if (typeof content === "string") return content;
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(content);
  } catch {
    return null;
  }
}
