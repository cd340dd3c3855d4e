//! A small part of the grid of extremes: every run ends with its energy accounted for, or says what to change.
