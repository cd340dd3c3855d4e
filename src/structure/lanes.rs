//! Vectors of all modes or of all floors, in blocks of [`LANES`] numbers, and their sums of products in a fixed order.

/// Vectors of modes or floors are padded to a multiple of this.
pub const LANES: usize = 4;

/// A block of such a vector.
pub type Lane = [f64; LANES];

/// Up to so many blocks, 16 modes or floors, there is code for each number of blocks, which keeps its sums in
/// registers.
pub const FEW_BLOCKS: usize = 4;

/// The sum of products, 0 where its terms cancel but for rounding, and the sum of the magnitudes of its terms.
///
/// Two floors that move alike have a distance of 0 to rounding; the sign of that rounding must not decide what happens.
pub fn difference(row: &[f64], modal: &[f64]) -> (f64, f64) {
    let (mut sum, mut size) = ([0.0; LANES], [0.0; LANES]);
    for (row, q) in row.as_chunks::<LANES>().0.iter().zip(modal.as_chunks::<LANES>().0) {
        for i in 0..LANES {
            let product = row[i] * q[i];
            sum[i] += product;
            size[i] += product.abs();
        }
    }
    let [value, size] = [sum, size].map(from_left_to_right);
    if value.abs() <= 4.0 * f64::EPSILON * size { (0.0, size) } else { (value, size) }
}

/// Sum of products in a fixed order: one partial sum per lane, then the lanes from left to right.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    for (a, b) in a.as_chunks::<LANES>().0.iter().zip(b.as_chunks::<LANES>().0) {
        for i in 0..LANES {
            lanes[i] += a[i] * b[i];
        }
    }
    from_left_to_right(lanes)
}

/// The sum of one block.
#[inline(always)]
pub(super) fn from_left_to_right([a, b, c, d]: Lane) -> f64 {
    ((a + b) + c) + d
}
