//! Exact response over an interval in which the load is linear in time [NigamJennings1969].
//!
//! For q'' + c q' + w^2 q = l0 + l1 t the state after h is
//!
//! ```text
//! q(h) = q + dqq q + dqv v + rq0 l0 + rq1 l1
//! v(h) = v + dvq q + dvv v + rv0 l0 + rv1 l1
//! ```
//!
//! Increments (the d's) are stored instead of the transition matrix itself: their rounding is relative to the change,
//! so a slow mode does not drift over thousands of intervals.

use nalgebra::DMatrix;

/// The eight numbers of one mode.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ModeIncrement {
    /// q from q.
    pub dqq: f64,
    /// q from v, s.
    pub dqv: f64,
    /// v from q, 1/s.
    pub dvq: f64,
    /// v from v.
    pub dvv: f64,
    /// q from a constant load, s^2.
    pub rq0: f64,
    /// q from the slope of the load, s^3.
    pub rq1: f64,
    /// v from a constant load, s.
    pub rv0: f64,
    /// v from the slope of the load, s^2.
    pub rv1: f64,
}

/// Largest w h (and c h) over which a power series in h is summed directly.
const SERIES_ANGLE: f64 = 0.5;

/// How often an interval `h`, s, is halved until a series reaches over it, and its length then.
fn halve(angle: f64, h: f64) -> (i32, f64) {
    let halvings = (libm::log2(angle / SERIES_ANGLE).ceil().max(0.0) as i32).min(1000);
    (halvings, libm::ldexp(h, -halvings))
}

impl ModeIncrement {
    /// For frequency `omega`, rad/s, damping `c` = 2 zeta omega, 1/s, and an interval `h`, s.
    ///
    /// Short intervals are summed as a series, which loses nothing to cancellation however small w h is; long ones
    /// take the closed form of an underdamped oscillator. Heavily damped modes double a short interval instead,
    /// which needs no distinction between under-, over- and critically damped and is stable as they decay.
    pub fn new(omega: f64, c: f64, h: f64) -> ModeIncrement {
        let angle = omega.max(c) * h;
        if angle <= SERIES_ANGLE {
            return Self::series(omega, c, h);
        }
        if c < 1.9 * omega {
            return Self::underdamped(omega, c, h);
        }
        let (doublings, mut short) = halve(angle, h);
        let mut increment = Self::series(omega, c, short);
        for _ in 0..doublings {
            increment = increment.twice(short);
            short *= 2.0;
        }
        increment
    }

    /// Power series in x = t/h of the four solutions that start from q, v, a constant and a sloped load.
    fn series(omega: f64, c: f64, h: f64) -> ModeIncrement {
        let (damping, stiffness) = (c * h, (omega * h) * (omega * h));
        // Sums of the coefficients beyond the start, and of their derivatives, at x = 1.
        let sum = |y0: f64, y1: f64, load0: f64, load1: f64| -> (f64, f64) {
            let (mut before, mut last) = (y0, y1);
            let (mut value, mut slope) = (y1, 0.0);
            for n in 0..24 {
                let k = n as f64;
                let load = if n == 0 {
                    load0
                } else if n == 1 {
                    load1
                } else {
                    0.0
                };
                let next = (load - damping * (k + 1.0) * last - stiffness * before) / ((k + 1.0) * (k + 2.0));
                value += next;
                slope += (k + 2.0) * next;
                (before, last) = (last, next);
            }
            (value, slope)
        };
        let (qq, vq) = sum(1.0, 0.0, 0.0, 0.0);
        let (qv, vv) = sum(0.0, 1.0, 0.0, 0.0);
        let (q0, v0) = sum(0.0, 0.0, 1.0, 0.0);
        let (q1, v1) = sum(0.0, 0.0, 0.0, 1.0);
        let h2 = h * h;
        ModeIncrement {
            dqq: qq,
            dqv: qv * h,
            dvq: vq / h,
            dvv: vv,
            rq0: q0 * h2,
            rq1: q1 * h2 * h,
            rv0: v0 * h,
            rv1: v1 * h2,
        }
    }

    /// Closed form for c < 2 omega, used where omega h is not small.
    fn underdamped(omega: f64, c: f64, h: f64) -> ModeIncrement {
        let (w2, b) = (omega * omega, 0.5 * c);
        let ratio = b / omega;
        let wd = omega * ((1.0 - ratio) * (1.0 + ratio)).sqrt();
        let decay = libm::exp(-b * h);
        let (sine, cosine) = libm::sincos(wd * h);
        let s = sine / wd;
        let (qq, qv) = (decay * (cosine + b * s), decay * s);
        let (vq, vv) = (-w2 * qv, decay * (cosine - b * s));
        let rq0 = (1.0 - qq) / w2;
        ModeIncrement {
            dqq: qq - 1.0,
            dqv: qv,
            dvq: vq,
            dvv: vv - 1.0,
            rq0,
            rq1: (h - c * rq0 - qv) / w2,
            rv0: qv,
            rv1: rq0,
        }
    }

    /// The increment over twice the interval `h` that this one is for.
    fn twice(&self, h: f64) -> ModeIncrement {
        let ModeIncrement { dqq, dqv, dvq, dvv, rq0, rq1, rv0, rv1 } = *self;
        ModeIncrement {
            dqq: 2.0 * dqq + (dqq * dqq + dqv * dvq),
            dqv: 2.0 * dqv + (dqq * dqv + dqv * dvv),
            dvq: 2.0 * dvq + (dvq * dqq + dvv * dvq),
            dvv: 2.0 * dvv + (dvq * dqv + dvv * dvv),
            rq0: 2.0 * rq0 + (dqq * rq0 + dqv * rv0),
            rv0: 2.0 * rv0 + (dvq * rq0 + dvv * rv0),
            // The second half of a slope is the slope and a constant h.
            rq1: 2.0 * rq1 + (dqq * rq1 + dqv * rv1) + h * rq0,
            rv1: 2.0 * rv1 + (dvq * rq1 + dvv * rv1) + h * rv0,
        }
    }
}

/// `out` += a matrix, column by column, times a vector.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn add_product(matrix: &[f64], vector: &[f64], out: &mut [f64]) {
    for (column, x) in matrix.chunks_exact(out.len().max(1)).zip(vector) {
        for (out, a) in out.iter_mut().zip(column) {
            *out += a * x;
        }
    }
}

/// The same for modes that damping couples: increment of (q, v) from (q, v, l0, l1), all vectors.
#[derive(Clone, Debug)]
pub struct CoupledIncrement {
    /// 2N x 4N.
    pub matrix: DMatrix<f64>,
}

impl CoupledIncrement {
    /// For frequencies `omega`, rad/s, and modal damping `c`, 1/s, over `h`, s: a series over a fraction of the
    /// interval, then doubled.
    pub fn new(omega: &[f64], c: &DMatrix<f64>, h: f64) -> CoupledIncrement {
        let fastest = omega.iter().fold(c.abs().row_sum().max(), |fastest, w| fastest.max(*w));
        let (doublings, mut short) = halve(fastest * h, h);
        let mut increment = Self::series(omega, c, short);
        for _ in 0..doublings {
            increment = increment.twice(short);
            short *= 2.0;
        }
        increment
    }

    /// Adds the increment of one building's (q, v), which begin at `offset`, to `out` = (dq, dv).
    pub fn step(&self, offset: usize, [q, v, load, slope]: [&[f64]; 4], out: &mut [f64]) {
        let n = self.matrix.nrows() / 2;
        out.fill(0.0);
        for (block, input) in [q, v, load, slope].into_iter().enumerate() {
            let columns = &self.matrix.as_slice()[block * n * out.len()..(block + 1) * n * out.len()];
            add_product(columns, &input[offset..offset + n], out);
        }
    }

    fn series(omega: &[f64], c: &DMatrix<f64>, h: f64) -> CoupledIncrement {
        let n = omega.len();
        let unit = DMatrix::<f64>::identity(n, n);
        let zero = DMatrix::<f64>::zeros(n, n);
        let damping = c * h;
        let mut matrix = DMatrix::zeros(2 * n, 4 * n);
        for block in 0..4 {
            // Start from q, from v, and from rest under the constant and the sloped load, in time units of h.
            let mut before = if block == 0 { unit.clone() } else { zero.clone() };
            let mut last = if block == 1 { unit.clone() } else { zero.clone() };
            let (mut value, mut slope) = (last.clone(), zero.clone());
            for k in 0..24_usize {
                let (k1, k2) = ((k + 1) as f64, (k + 2) as f64);
                let mut next = -(&damping * &last) * k1;
                for (i, w) in omega.iter().enumerate() {
                    let stiffness = (w * h) * (w * h);
                    for j in 0..n {
                        next[(i, j)] -= stiffness * before[(i, j)];
                    }
                }
                if block == k + 2 {
                    next += &unit;
                }
                next /= k1 * k2;
                value += &next;
                slope += &next * k2;
                before = std::mem::replace(&mut last, next);
            }
            let unit_of_time = [1.0, h, h * h, h * h * h][block];
            matrix.view_mut((0, block * n), (n, n)).copy_from(&(value * unit_of_time));
            matrix.view_mut((n, block * n), (n, n)).copy_from(&(slope * (unit_of_time / h)));
        }
        CoupledIncrement { matrix }
    }

    fn twice(&self, h: f64) -> CoupledIncrement {
        let n = self.matrix.nrows() / 2;
        let transition = self.matrix.columns(0, 2 * n);
        let mut matrix = &self.matrix * 2.0 + transition * &self.matrix;
        let constant = self.matrix.columns(2 * n, n) * h;
        let mut slope = matrix.columns_mut(3 * n, n);
        slope += constant;
        CoupledIncrement { matrix }
    }
}
