//! Two adjacent multi-storey buildings that collide in an earthquake, as an FMI 2.0 co-simulation unit.
//!
//! SI units everywhere: m, s, kg, N. "Left" and "right" are the two buildings and x points from left to right.
//! Displacements and velocities of floors are relative to the ground, accelerations are absolute. A penetration is
//! positive while two floors overlap and a contact force is positive in compression.
//!
//! # From equations to files
//!
//! | equation | file | source |
//! |---|---|---|
//! | M u" + C u' + K u = -M 1 a(t) + forces on the floors, in modal coordinates | `structure/mod.rs` | |
//! | natural frequencies and shapes; damping by ratios, Rayleigh or matrix | `structure/modes.rs` | \[OgitaAishima2018\], [Chopra2001, section 11.4] |
//! | exact response to a load that is linear in time | `structure/propagator.rs` | \[NigamJennings1969\] |
//! | a(t), linear between the samples of the record | `engine/ground.rs` | |
//! | penetration d = u_left - u_right - gap | `engine/model.rs` | |
//! | `stereomechanical`: impulse p = (1 + e) m V; floors held together by a reaction | `engine/rigid.rs`, `engine/complementarity.rs` | \[Goldsmith1960\], [BarrosKhatami2013, eqs. 1, 2], \[Moreau1988\], \[LawsonHanson1974\] |
//! | `linear`: F = k d | `contact/law.rs`, `contact/force.rs` | [BarrosKhatami2013, eq. 3] |
//! | `kelvin_voigt`: F = k d + c v, c = 2 xi sqrt(k m), xi = -ln e / sqrt(pi^2 + ln^2 e) | the same | \[Anagnostopoulos1988\], [BarrosKhatami2013, eqs. 4, 5] |
//! | `kelvin_voigt_no_tension`: F = max(0, k d + c v) | the same | \[Komodromos2007\], [BarrosKhatami2013, section 2.2] |
//! | `hertz`: F = k d^n | the same | \[Hertz1882\], \[Goldsmith1960\], [BarrosKhatami2013, eq. 6] |
//! | `jankowski`: F = k d^1.5 + 2 xi sqrt(k sqrt(d) m) v while v > 0 | the same | \[Jankowski2005\], \[Jankowski2006\], [BarrosKhatami2013, eqs. 7, 8] |
//! | `hertz_damped`: F = k d^n max(0, 1 + a v / V) | the same, a in `contact/damping_formula.rs` | \[Gonthier2004\], [BarrosKhatami2013, eqs. 9-11, 14] |
//! | motion in contact as a power series in time | `engine/contact_step.rs`, `structure/series.rs`, `contact/series.rs` | |
//! | motion just after an entry, powers i + beta j of time | `engine/onset_step.rs`, `contact/onset.rs` | |
//! | bounds of a curve by its cubic Hermite interpolant: no contact, first root, largest value | `engine/flight.rs`, `engine/roots.rs` | \[BirkhoffPriver1967\] |
//! | energy account; impulse, work and peaks of a contact | `engine/energy.rs`, `engine/advance.rs` | |
//! | Gauss-Legendre quadrature | `quadrature.rs` | [AbramowitzStegun1964, table 25.4] |
//!
//! Sources are cited as [Key, place]; the keys are those of `REFERENCES.bib`. "Seed paper" is \[BarrosKhatami2013\].
#![deny(unsafe_code)]

pub mod contact;
pub mod description;
pub mod engine;
#[allow(unsafe_code)]
mod fmi;
mod quadrature;
pub mod record;
pub mod scene;
pub mod slave;
pub mod structure;
pub mod variables;
