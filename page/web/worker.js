// The engine beside the page: answers what takes long, in slices of about SLICE ms. To stop it is to end the worker.

import { Asking } from "./asking.js";

const SLICE = 40;
// Pieces of a job's first slice.
const FIRST = 8;

let asking = null;

onmessage = ({ data: { module, id, header, parts, isFile, isJob } }) => {
  if (module) {
    asking = new Asking(module);
    return;
  }
  try {
    const answer = asking.ask(header, parts, isFile);
    tell(id, { answer, isLast: !isJob });
    if (isJob) goOn(id);
  } catch (error) {
    postMessage({ id, refusal: { kind: error.name, problems: error.problems ?? [String(error.message)] } });
  }
};

// The slices of a job, each told as soon as it is there.
function goOn(id) {
  let pieces = FIRST;
  for (let isLast = false; !isLast; ) {
    const start = performance.now();
    const answer = asking.ask({ call: "goOn", pieces });
    isLast = answer.json.done;
    tell(id, { answer, isLast });
    const took = performance.now() - start;
    if (took < SLICE / 2) pieces *= 4;
    else if (took > 2 * SLICE) pieces = Math.max(1, Math.floor(pieces / 2));
  }
}

function tell(id, { answer, isLast }) {
  const transfer = [answer.numbers.buffer, ...(answer.bytes ? [answer.bytes.buffer] : [])];
  postMessage({ id, answer, isLast }, transfer);
}
