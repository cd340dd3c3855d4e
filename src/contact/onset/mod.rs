//! The first step after an entry under a power law, whose force has no Taylor series at d = 0.
//!
//! With d = V t + ... the force goes as t^n, the motion as t^(n+2), the force then as t^(2n+1), and so on: all powers
//! that occur are i + beta j with whole i, j >= 0 and one beta of the law. So the solution is an ordinary power
//! series in two variables, x = t / scale and z = x^beta. It converges where a Taylor series does not exist.
//!
//! Writing d = x e, with e = V + ..., every law is a power of x times an analytic function of e:
//!
//! ```text
//! k d^n (1 + b d')      = x^n e^n (...)              n    = -1 + beta,    beta = n + 1
//! k d^1.5               = x^1.5 e^1.5                1.5  = -1 + 2 beta,  beta = 5/4
//! b d^0.25 d'           = (4/5) b (x^1.25 e^1.25)'   0.25 = -1 + beta
//! ```

mod block;
mod grid;
mod reading;

pub(crate) use block::OnsetBlock;
pub(crate) use grid::{Grid, GridPowers, GridTerms, MOST_TERMS, Products, derivatives};
pub(crate) use reading::OnsetReading;
