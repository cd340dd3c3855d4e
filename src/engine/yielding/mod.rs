//! Elements that yield, the columns of storeys and the springs of links that slip: bilinear, with kinematic hardening.
//!
//! With the drift d, the plastic drift p, the yield force V_y, the stiffness k and the post-yield ratio r,
//!
//! ```text
//! storey shear V = r k d + (1 - r) k z,   z = d - p,   |z| <= V_y / k
//! elastic: p' = 0        yielding in the sense s = 1 or -1: z = s V_y / k and p' = d', as long as s d' > 0
//! ```
//!
//! A plastic drift p moves the position in which a shear building rests by (1 - r) p in that storey, and does nothing
//! else; where links or soil act, that of all floors of the body (`lift.rs`). Relative to that position of rest an elastic building
//! obeys the same linear equations as one that never yields. So all motion in the engine is relative to it, gaps are those
//! in it, and an element stays elastic while its drift x relative to it keeps between -V_y/k + o and V_y/k + o. The middle o
//! is p less the drift at rest: r p in a building without links. Only while an element yields another force acts on the
//! body, (1 - r) k times the change of its drift since the step began; with it the motion is a power series in time
//! (`taylor/drifts.rs`). Where the step ends the rest position is moved.

pub(super) mod element;
mod lift;
