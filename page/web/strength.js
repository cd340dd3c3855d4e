// How strong an impact is: by its force, or, where rigid floors exchange impulses, by that.

export const strengthOf = (impact) => impact.peak_force || impact.impulse || 0;

// Of several the strongest; null of none.
export function hardestOf(impacts) {
  return impacts.reduce((most, impact) => (most && strengthOf(most) >= strengthOf(impact) ? most : impact), null);
}

// The strength of the strongest, 0 of none.
export const mostOf = (impacts) => (impacts.length > 0 ? strengthOf(hardestOf(impacts)) : 0);

// s: where an impact ends, or the run, if it goes on until then.
export const endOf = (impact, run) => (Number.isFinite(impact.end_s) ? impact.end_s : run.stop);
