//! Two adjacent multi-storey buildings that collide in an earthquake, as a co-simulation unit of FMI 2.0 or 3.0.
//!
//! SI units everywhere: m, s, kg, N. "Left" and "right" are the two buildings and x points from left to right.
//! Displacements and velocities of floors are relative to the ground, accelerations are absolute. A penetration is
//! positive while two faces overlap and a contact force is positive in compression.
//!
//! # From equations to files
//!
//! | equation | file | source |
//! |---|---|---|
//! | M u" + C u' + K u = -M 1 a(t) + forces on the floors, in modal coordinates | `structure/equations.rs` | |
//! | natural frequencies and shapes; damping by ratios, Rayleigh, dashpots or matrix | `structure/modes.rs` | \[OgitaAishima2018\], [Chopra2001, section 11.4] |
//! | exact response to a load that is linear in time | `structure/propagator.rs` | \[NigamJennings1969\] |
//! | a(t), linear between the samples of the record | `engine/excitation/record.rs` | |
//! | penetration d = sum of weight u - gap over the row of a contact: u_left - u_right - gap for two floors | `engine/pairs/pair.rs` | |
//! | rows: columns move with the floors at their ends, N(s) = 3 s^2 - 2 s^3, and give them the force in the same shares; walls | `scene/contact_pair.rs` | [Przemieniecki1968, chapter 5] |
//! | levels of floors, and which ones face each other by them | `scene/levels.rs`, `scene/facing.rs` | |
//! | rigid contact (`stereomechanical`): impulse p = (1 + e) m V; floors held together by a reaction | `engine/rigid/impulses.rs`, `numerics/complementarity.rs` | \[Goldsmith1960\], [BarrosKhatami2013, eqs. 1, 2], \[Moreau1988\], \[LawsonHanson1974\] |
//! | contact force F(d, v): one file per law, with its source, range and defect | `contact/laws/` | in each file |
//! | a(e) of `hertz_damped` | `contact/damping_formula.rs` | at each formula |
//! | motion in contact as a power series in time | `engine/taylor/expansion.rs`, `structure/series/mod.rs`, `contact/taylor/mod.rs` | |
//! | a variable in which the motion near entries and releases is smooth | `numerics/time_map.rs` | |
//! | contact forces over a whole window from an integral equation, at Gauss nodes | `collocation/`, `engine/window/mod.rs`, `structure/impulse_response.rs` | \[Brunner2004\] |
//! | motion just after an entry, powers i + beta j of time | `engine/onset/series.rs`, `contact/onset/mod.rs` | |
//! | bounds of a curve by its cubic Hermite interpolant: no contact, first root, largest value | `engine/bounds/certificate.rs`, `numerics/roots/mod.rs` | \[BirkhoffPriver1967\] |
//! | storey shear V = r k d + (1 - r) k z, z = d - p, abs(z) <= V_y / k; yields and turns | `engine/yielding/mod.rs`, `engine/taylor/drifts.rs`, `engine/taylor/switches.rs` | [Chopra2001, chapter 7] |
//! | gravity on storeys that lean: k' = k (1 - theta), V_y' = V_y (1 - theta), r' = (r - theta) / (1 - theta), theta = P / (h k); collapse | `scene/p_delta.rs`, `engine/taylor/switches.rs` | [Eurocode2004, section 4.4.2.2] |
//! | foundations: drifts u_i - u_(i-1) - h_i phi, K - K_G as a sum of squares, damping beyond the motion of the foundation | `scene/foundation.rs`, `structure/soil.rs`, `structure/base_shear.rs` | |
//! | energy account; impulse, work and peak force of a contact | `engine/energy.rs`, `engine/follow.rs` | |
//! | largest displacements, drifts, accelerations and base shears in continuous time | `engine/peaks/mod.rs` | \[BirkhoffPriver1967\] |
//! | derivatives with respect to time, and to inputs at an instant | `engine/output/rates.rs`, `contact/rates.rs`, `engine/output/feedthrough.rs` | |
//! | Gauss-Legendre quadrature | `numerics/quadrature.rs` | [AbramowitzStegun1964, table 25.4] |
//!
//! Sources are cited as [Key, place]; the keys are those of `REFERENCES.bib`. "Seed paper" is \[BarrosKhatami2013\].
#![deny(unsafe_code)]
// What is `pub` is the public interface, but for modules of the engine that allow `unreachable_pub`. Tests are exempt.
#![warn(unreachable_pub)]

mod collocation;
pub mod contact;
pub mod description;
pub mod engine;
mod figures;
// Hidden: an importer finds these functions in the library of an FMU; they are public for the tests that link them.
#[doc(hidden)]
#[allow(unsafe_code)]
pub mod fmi;
mod numerics;
pub mod record;
pub mod scene;
pub mod slave;
// Hidden: parts of the engine, public for the tests that hold them against closed forms, and for the periods that the
// Python module draws.
#[doc(hidden)]
pub mod structure;
pub mod variables;
mod version;
pub mod warnings;

pub use version::FmiVersion;
