// The engine's module: questions go in as bytes, answers come out as JSON, bytes and numbers (page/src/message.rs).

// Why there is no answer: sentences for a person, and the exception that the Python module raises for the same.
export class Refusal extends Error {
  constructor({ kind, problems }) {
    super(problems.join("\n"));
    this.name = kind;
    this.problems = problems;
  }
}

const CRASHED = "the engine has met a bug of its own, or has run out of memory";

const encoder = new TextEncoder();
const decoder = new TextDecoder();

export const bytesOf = (content) => {
  if (typeof content === "string") return encoder.encode(content);
  return content instanceof ArrayBuffer ? new Uint8Array(content) : content;
};

export class Asking {
  constructor(module) {
    this.module = module;
    this.exports = new WebAssembly.Instance(module, {}).exports;
  }

  // The answer to a question: `json` if it is that, else `bytes`; `numbers` beside it. The parts are bytes or texts.
  ask(header, parts = [], isFile = false) {
    try {
      return this.#ask(header, parts.map(bytesOf), isFile);
    } catch (error) {
      if (error instanceof Refusal) throw error;
      // What a panic leaves behind is not fit for another question.
      this.exports = new WebAssembly.Instance(this.module, {}).exports;
      throw new Refusal({ kind: "RuntimeError", problems: [`${CRASHED} (${error.message})`] });
    }
  }

  #ask(header, parts, isFile) {
    const { room, ask, answered } = this.exports;
    const all = [encoder.encode(JSON.stringify(header)), ...parts];
    const lengths = new Uint32Array([all.length, ...all.map((part) => part.length)]);
    const length = all.reduce((sum, part) => sum + part.length, lengths.byteLength);
    const at = room(length);
    let next = at;
    for (const part of [new Uint8Array(lengths.buffer), ...all]) {
      new Uint8Array(this.exports.memory.buffer, next, part.length).set(part);
      next += part.length;
    }
    const isWell = ask(at, length) === 1;
    // Memory may have moved while it grew: what is read is copied at once.
    const bytes = new Uint8Array(this.exports.memory.buffer, answered(0), answered(1)).slice();
    const numbers = new Uint8Array(this.exports.memory.buffer, answered(2), 8 * answered(3)).slice();
    if (!isWell) throw new Refusal(JSON.parse(decoder.decode(bytes)));
    const answer = isFile ? { bytes } : { json: JSON.parse(decoder.decode(bytes)) };
    return { ...answer, numbers: new Float64Array(numbers.buffer) };
  }
}
