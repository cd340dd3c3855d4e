// What the browser keeps from visit to visit, where it keeps anything: a file may be forbidden to, and room is limited.

const PREFIX = "pounding.";

export class Keep {
  get(name) {
    try {
      return localStorage.getItem(PREFIX + name);
    } catch {
      return null;
    }
  }

  // Whether it is kept.
  set(name, text) {
    try {
      localStorage.setItem(PREFIX + name, text);
      return true;
    } catch {
      this.drop(name);
      return false;
    }
  }

  drop(name) {
    try {
      localStorage.removeItem(PREFIX + name);
    } catch {
      // Nothing is kept, so nothing has to go.
    }
  }
}
