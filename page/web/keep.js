// What the browser keeps from visit to visit, where it keeps anything: a file may be forbidden to, and room is limited.

const PREFIX = "pounding.";
// Letters of records.
export const MOST_KEPT = 2e6;

export class Keep {
  // `place` keeps apart what belongs to different pages: browsers may take all files for one.
  constructor(place = "") {
    this.prefix = PREFIX + place;
  }

  get(name) {
    try {
      return localStorage.getItem(this.prefix + name);
    } catch {
      return null;
    }
  }

  // Whether it is kept.
  set(name, text) {
    try {
      localStorage.setItem(this.prefix + name, text);
      return true;
    } catch {
      this.drop(name);
      return false;
    }
  }

  drop(name) {
    try {
      localStorage.removeItem(this.prefix + name);
    } catch {
      // Nothing is kept, so nothing has to go.
    }
  }
}

// A short name for a text.
export function nameOf(text) {
  let name = 5381;
  for (let at = 0; at < text.length; at++) name = (Math.imul(name, 33) + text.charCodeAt(at)) | 0;
  return (name >>> 0).toString(36);
}
