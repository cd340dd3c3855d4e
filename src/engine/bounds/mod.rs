//! What cannot happen. The engine has three ideas: buildings apart fly exactly; where a bound shows that nothing
//! happens, nothing is looked for; the rest is expanded into series and searched. This is the second.
//!
//! # One question
//!
//! A *row* over the modes makes a number of the motion, y = row . q: how far two floors have come nearer, the drift of
//! a storey, a displacement. Its *limit* is a gap, a yield drift, the peak so far. All bounds answer the same question:
//! **can y pass its limit before some time?** "No" is certain; "yes" is a guess, after which somebody looks closer. A
//! bound never changes a result, only the work: what cannot happen is left out of sight. One that is too sharp would
//! lose a contact in silence, one that is too wide costs a search in vain. `engine/tests/` holds each of them
//! against random motions that are evaluated densely, and against motions that come near it: mostly to nine tenths.
//!
//! Bounds know the motion and rows of numbers over it, and loads: no steps, systems or models. These ask.
//!
//! # The bounds
//!
//! e = sqrt(q'^2 + w^2 q^2) is the amplitude of a mode with the frequency w and the damping c. Only a load makes it
//! larger: the ground by at most A = |participation| S, S the integral of |ground acceleration|. t is a time from now
//! on, h the length of a stretch of motion, n the number of modes, W what the ground moves the row by.
//!
//! ```text
//! bound          y is at most                                        sharp where                          costs
//! ------------------------------------------------------------------------------------------------------------------
//! velocity       y + t sum |row| (e + A)                             all modes pass 0 together, t small   n for
//! acceleration   y + t (y' + |W| S + t/2 sum |row| (w + c) (e + A))  all modes turn together, t small     all three,
//! jerk           cubic by y, y', y'', sum |row| k (e + A), k ~ w^2   y rests, t small                     many t
//! together       limit times sum |row| (e + A) / (w limit)           one mode, any t                      n, all rows
//! push           e + h |load| + h^2 |load'| + sum |row| impulse      forces act at once                   n
//! oscillation    quasi-static y + sum |row| R, R radius about it     one mode without damping, any t      n
//! both ends      largest Bernstein coefficient of the cubic through  h w below 1; exact at the ends       2 n, and n
//!                values and rates + h^4/384 max |y''''|                                                   for all rows
//! terms          c0 + x max(c1, 0) + |c2| x^2 + |c3| x^3 + ...       all terms have one sign              the floors
//! chord          the larger end + h^2/8 max |y''|; it does not turn  h w below 1; exact where y does not  the floors
//!                if its ends differ by more than h^2/2 max |y''|     turn
//! span           the largest end of some flights + a chord's bound   as a chord                           the modes
//!
//! bound                                  file              who asks
//! ------------------------------------------------------------------------------------------------------------------
//! velocity, acceleration, jerk, together amplitude.rs      flight/broad_phase.rs: for 1 to 64 segments of the record
//! together, push                         amplitude.rs      window/elastic.rs: no storey yields in a window
//! oscillation                            oscillation.rs    system/limits.rs: for a flight or what is left of it
//! the same, four rows at a time          envelope.rs       peaks/flight.rs, peaks/search.rs
//! both ends                              certificate.rs    flight/mod.rs, flight/search.rs
//! the same, four rows at a time          cubic.rs          peaks/flight.rs
//! terms                                  terms.rs          taylor/reached.rs
//! chord                                  chord.rs          peaks/contact_bounds.rs: all floors over a step in contact;
//!                                                          peaks/links.rs and peaks/search.rs on their own
//! span                                   span.rs           peaks/fold.rs: many flights at once
//! ```
//!
//! What is watched for its peak is read late, many flights ([`flights`]) at once, in spans. The few flights that are left are
//! bounded in blocks of four rows, on a [`stretch`] of exact motion.
//!
//! Where damping couples modes, the oscillators of their complex modes stand for them (`structure/flight_modes.rs`), with rows
//! over q and q' (`quantities/flight_row.rs`): all bounds hold, with |A| + (w + c) |B| for |row|. Where there are none, coupled modes
//! exchange energy, and each gets the amplitude of all together ([`amplitude::share`]). Jerk is not bounded there, nor is
//! oscillation while the load changes.
//!
//! # Which one is asked when
//!
//! Apart: first the broad phase, which mostly needs one look for many segments. What it cannot exclude is tested by
//! both ends of the flight, then by oscillation (however long the flight is), and is then searched piece by piece,
//! again by both ends of each piece. While forces act: terms, then the search for a root. Within a window of contact
//! forces the second derivative is bounded instead (`window/certificate.rs`), and in a step just after an entry the
//! terms of its double series (`onset/certificate.rs`): these know forces, not rows alone.
//!
//! # Rules
//!
//! * A NaN never counts as below a limit: comparisons are written so that it ends with "may".
//! * Rounding is on the safe side: each sum gets a margin relative to its terms.
//! * What is stored (a penetration, a rate) is not a bound: it keeps its own order of sums.

pub mod amplitude;
pub mod certificate;
pub mod chord;
pub mod cubic;
pub mod envelope;
pub mod flights;
pub mod oscillation;
pub mod span;
pub mod stretch;
pub mod terms;
