//! The effect of the contact forces on many modes over a window that takes the whole time between two samples: by the
//! forces at the nodes, with a matrix that is made once.

use crate::collocation::{AtNodes, Map, NodeCount, POWERS, Tables};
use crate::structure::{ImpulseResponse, LANES, Lane, MotionMut};

/// Matrices of one pair for windows of one length without a map.
#[derive(Clone, Debug)]
pub struct PreparedPush {
    /// s.
    length: f64,
    by_rule: [NodeMatrix; 2],
}

/// Node by node for each block of modes: displacement and velocity that a force of 1 N there takes away.
#[derive(Clone, Debug)]
struct NodeMatrix {
    rule: NodeCount,
    entries: Vec<[Lane; 2]>,
}

impl PreparedPush {
    /// For a pair with that row of the modal Jacobian.
    pub fn new(response: &ImpulseResponse, row: &[f64], length: f64) -> PreparedPush {
        let by_rule = [NodeCount::Eight, NodeCount::Twelve].map(|rule| NodeMatrix::new(response, row, length, rule));
        PreparedPush { length, by_rule }
    }

    /// Subtracts the effect of forces at the nodes of a whole window from a motion; returns whether it is prepared for
    /// that window.
    pub fn push(&self, (map, rule, length): (Map, NodeCount, f64), force: &AtNodes, motion: MotionMut) -> bool {
        let matrix = self.by_rule.iter().find(|matrix| matrix.rule == rule);
        let Some(matrix) = matrix.filter(|_| map == Map::Plain && length == self.length) else { return false };
        push(&matrix.entries, &force[..rule.count()], motion);
        true
    }
}

impl NodeMatrix {
    fn new(response: &ImpulseResponse, row: &[f64], length: f64, rule: NodeCount) -> NodeMatrix {
        let whole = &Tables::of(Map::Plain, rule).whole;
        let entry = |m: usize, j: usize| {
            let (mut moved, mut slowed, mut unit) = (0.0, 0.0, length);
            for (k, whole) in whole.iter().enumerate() {
                let moment = unit * whole[j];
                moved += response.term(k)[m] * moment;
                if k + 1 < POWERS {
                    slowed += (k + 1) as f64 * response.term(k + 1)[m] * moment;
                }
                unit *= length;
            }
            [row[m] * moved, row[m] * slowed]
        };
        let of_block = |c: usize, j: usize| {
            let of_modes: [[f64; 2]; LANES] = std::array::from_fn(|i| entry(LANES * c + i, j));
            [of_modes.map(|[moved, _]| moved), of_modes.map(|[_, slowed]| slowed)]
        };
        let entries = (0..row.len() / LANES).flat_map(|c| (0..rule.count()).map(move |j| (c, j)));
        NodeMatrix { rule, entries: entries.map(|(c, j)| of_block(c, j)).collect() }
    }
}

/// See [`PreparedPush::push`]. Returns the sum of all that is subtracted, which goes from block to block: else the
/// compiler takes four blocks at a time and spends its time sorting them.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn push(entries: &[[Lane; 2]], forces: &[f64], motion: MotionMut) -> Lane {
    match forces.len() {
        8 => push_blocks::<8>(entries, forces, motion),
        _ => push_blocks::<12>(entries, forces, motion),
    }
}

/// The same for `N` nodes, whose forces stay in registers.
#[inline(always)]
fn push_blocks<const N: usize>(entries: &[[Lane; 2]], forces: &[f64], MotionMut { q, v }: MotionMut) -> Lane {
    let mut sum = [0.0; LANES];
    let blocks = q.as_chunks_mut::<LANES>().0.iter_mut().zip(v.as_chunks_mut::<LANES>().0);
    let forces: &[f64; N] = forces.first_chunk().unwrap_or(&[0.0; N]);
    for (entries, (q, v)) in entries.as_chunks::<N>().0.iter().zip(blocks) {
        let (mut moved, mut slowed) = ([0.0; LANES], [0.0; LANES]);
        for j in 0..N {
            for i in 0..LANES {
                moved[i] += entries[j][0][i] * forces[j];
            }
            for i in 0..LANES {
                slowed[i] += entries[j][1][i] * forces[j];
            }
        }
        for i in 0..LANES {
            q[i] -= moved[i];
        }
        for i in 0..LANES {
            v[i] -= slowed[i];
        }
        for i in 0..LANES {
            sum[i] += slowed[i];
        }
    }
    sum
}
