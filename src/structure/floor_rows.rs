//! The shapes of all modes floor by floor: of a motion of many floors seldom more than a few are read.

use super::bodies::Body;

/// For each lane of a vector of all floors its row over the modes of its body, and the first of these modes.
#[derive(Clone, Debug)]
pub(super) struct FloorRows(Vec<(usize, Box<[f64]>)>);

impl FloorRows {
    /// Of these bodies, whose floors have so many lanes.
    pub(super) fn of(bodies: &[Body], lanes: usize) -> FloorRows {
        let mut rows = vec![(0, Box::default()); lanes];
        for body in bodies {
            for (row, shape) in rows[body.lanes.start..].iter_mut().zip(body.modes.shape.row_iter()) {
                *row = (body.range.start, shape.iter().copied().collect());
            }
        }
        FloorRows(rows)
    }

    /// The row of a lane over all modes, so many.
    pub(super) fn row(&self, lane: usize, modes: usize) -> Vec<f64> {
        let ((first, row), mut all) = (&self.0[lane], vec![0.0; modes]);
        all[*first..][..row.len()].copy_from_slice(row);
        all
    }

    /// The motion of one lane from a modal vector: as [`super::lane_matrix::LaneMatrix`] has it for many, to the last
    /// bit.
    #[inline]
    pub(super) fn at(&self, lane: usize, modal: &[f64]) -> f64 {
        let (first, row) = &self.0[lane];
        let modal = &modal[*first..][..row.len()];
        let ((pairs, last), (values, last_value)) = (row.as_chunks::<2>(), modal.as_chunks::<2>());
        let mut sums = [0.0; 2];
        for (row, value) in pairs.iter().zip(values) {
            for i in 0..2 {
                sums[i] += row[i] * value[i];
            }
        }
        let sum = sums[0] + sums[1];
        0.0 + match (last, last_value) {
            ([row], [value]) => sum + row * value,
            _ => sum,
        }
    }
}
