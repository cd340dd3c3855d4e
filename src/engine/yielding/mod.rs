//! Storeys that yield: bilinear, with kinematic hardening.
//!
//! With the drift d, the plastic drift p, the yield force V_y, the stiffness k and the post-yield ratio r,
//!
//! ```text
//! storey shear V = r k d + (1 - r) k z,   z = d - p,   |z| <= V_y / k
//! elastic: p' = 0        yielding in the sense s = 1 or -1: z = s V_y / k and p' = d', as long as s d' > 0
//! ```
//!
//! A plastic drift p moves the position in which a shear building rests by (1 - r) p in that storey, and does nothing else:
//! relative to that position of rest an elastic building obeys the same linear equations as one that never yields. So all
//! motion in the engine is relative to it, gaps are those in it, and a storey stays elastic while its drift x relative to
//! it keeps between -V_y/k + r p and V_y/k + r p. Only while a storey yields another force acts on the building, (1 - r) k
//! times the change of its drift since the step began; with it the motion is a power series in time
//! (`taylor/drifts.rs`). Where the step ends the rest position is moved.

pub(super) mod storey;
