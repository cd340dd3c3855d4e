// A worker with the engine, in which one question follows another.

import { Refusal } from "./asking.js";

export class Lane {
  #worker = null;
  #waiting = new Map();
  #next = 0;

  constructor(module, program) {
    Object.assign(this, { module, program });
  }

  // The last answer; a job's earlier ones go to `take` one by one.
  ask(question, take = () => {}) {
    const worker = (this.#worker ??= this.#start());
    const id = this.#next++;
    return new Promise((answer, refuse) => {
      this.#waiting.set(id, { answer, refuse, take });
      worker.postMessage({ id, ...question });
    });
  }

  get isBusy() {
    return this.#waiting.size > 0;
  }

  // Ends all that goes on, at once.
  stop(problem = "stopped", kind = "Stopped") {
    this.#worker?.terminate();
    this.#worker = null;
    const waiting = [...this.#waiting.values()];
    this.#waiting.clear();
    for (const { refuse } of waiting) refuse(new Refusal({ kind, problems: [problem] }));
  }

  #start() {
    const address = URL.createObjectURL(new Blob([this.program], { type: "text/javascript" }));
    const worker = new Worker(address);
    URL.revokeObjectURL(address);
    worker.postMessage({ module: this.module });
    worker.onmessage = ({ data }) => this.#hear(data);
    worker.onerror = (event) => {
      event.preventDefault();
      this.stop(`the engine has stopped unexpectedly (${event.message})`, "RuntimeError");
    };
    return worker;
  }

  #hear({ id, answer, isLast, refusal }) {
    const waiting = this.#waiting.get(id);
    if (!waiting) return;
    if (refusal || isLast) this.#waiting.delete(id);
    if (refusal) return waiting.refuse(new Refusal(refusal));
    if (isLast) return waiting.answer(answer);
    try {
      waiting.take(answer);
    } catch (error) {
      // Nobody would listen to the rest.
      this.#waiting.delete(id);
      waiting.refuse(error);
      this.stop();
    }
  }
}
