// Where floors and foundations are at any time of a run: between two rows a cubic through displacements and velocities.

// Of a gap, and of a link.
export const SIDES = ["left", "right"];

// From left to right.
export const namesOf = ({ layout }) => layout.buildings.map(({ name }) => name);

// How a building is drawn: one alone or the first of two as the left one, the other as the right one, each of a longer row
// as one of eight in turn.
const IN_TURN = 8;
export function kindOf(names, name) {
  const at = names.indexOf(name);
  return names.length <= SIDES.length ? SIDES[at] : `row-${(at % IN_TURN) + 1}`;
}

// The row before a time, of rows that are equally far apart but for the last one.
export function rowBefore(times, time) {
  let [low, high] = [0, times.length - 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  return low;
}

export class Motion {
  constructor(run) {
    this.run = run;
    const of = (building, name) => {
      // Below the floors the foundation, or the ground.
      const columns = [run.columns[`${building}.foundation.${name}`]];
      for (let i = 1; run.columns[`${building}.${name}[${i}]`]; i++) columns.push(run.columns[`${building}.${name}[${i}]`]);
      return columns;
    };
    this.buildings = namesOf(run.look).map((name) => ({
      displacements: of(name, "displacement"),
      velocities: of(name, "velocity"),
      rotation: run.columns[`${name}.foundation.rotation`],
      rotationRate: run.columns[`${name}.foundation.rotation_rate`],
    }));
  }

  // Of each building the displacements of its floors, m, the lowest first, before it that of the foundation, 0 for the
  // ground; and by how much each foundation has turned, rad.
  at(time) {
    const { time: times } = this.run;
    const row = rowBefore(times, time);
    const next = Math.min(row + 1, times.length - 1);
    const step = times[next] - times[row] || 1;
    const share = Math.min(1, Math.max(0, (time - times[row]) / step));
    const between = (column, velocity) => {
      if (!column) return 0;
      if (!velocity) return column[row] + share * (column[next] - column[row]);
      return cubic(share, column[row], column[next], step * velocity[row], step * velocity[next]);
    };
    return {
      floors: this.buildings.map(({ displacements, velocities }) =>
        displacements.map((column, floor) => between(column, velocities[floor])),
      ),
      turned: this.buildings.map(({ rotation, rotationRate }) => between(rotation, rotationRate)),
    };
  }

  // A column of the run at a time, by the line between two rows.
  value(name, time) {
    const column = this.run.columns[name];
    if (!column) return 0;
    const row = rowBefore(this.run.time, time);
    const next = Math.min(row + 1, column.length - 1);
    const share = (time - this.run.time[row]) / (this.run.time[next] - this.run.time[row] || 1);
    return column[row] + Math.min(1, Math.max(0, share)) * (column[next] - column[row]);
  }
}

// Hermite's cubic; slopes are those over the whole step.
function cubic(s, from, to, slopeFrom, slopeTo) {
  const t = 1 - s;
  return from * t * t * (1 + 2 * s) + to * s * s * (1 + 2 * t) + slopeFrom * s * t * t - slopeTo * s * s * t;
}
