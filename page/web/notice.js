// A line that says what has been done, or why not, for some seconds; screen readers hear it.

import { element } from "./make.js";

const SHOWN_FOR = 7000;

let hiding = 0;

export function said(text) {
  const line = element("saved");
  line.textContent = text;
  line.classList.add("shown");
  clearTimeout(hiding);
  hiding = setTimeout(() => line.classList.remove("shown"), SHOWN_FOR);
}
