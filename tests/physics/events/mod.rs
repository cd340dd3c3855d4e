//! Are beginnings and ends of contacts found, each at its time, and nothing else taken for one?

mod beginnings_and_ends;
mod broad_phase;
mod entries_during_contact;
mod output_near_samples;
